"""The library: CTs that were taken in, de-identified, whole or not at all.

An import is written into a staging folder, synced, read again and searched, and only then renamed
to its place. Whatever ends it (an error, a full disk, a cancel, a kill) leaves nothing in the
library; the staging of a process that died is swept away at the next search.
"""

import errno
import json
import os
import shutil
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from app.core import paths
from app.core.descriptors import hold, is_held
from app.core.files import sync, write_atomically
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import (
    FileDamagedError,
    ImagingError,
    SeriesRefusedError,
    SeriesUnknownError,
)
from app.imaging.privacy.burned_in import MaskBox
from app.imaging.privacy.report import LOCK, Deidentified, RemovalReport
from app.imaging.reading import offer
from app.imaging.scanning import scan_folder
from app.imaging.series import NO_REMEDY, Series
from app.imaging.worker.jobs import DEIDENTIFY
from app.imaging.worker.limits import MEMORY_BYTES, MOST_SECONDS, Allowance, size_of
from app.imaging.worker.pool import shared_worker

_PREFIX = ".staging-"
_SPARE_BYTES = 64 * 1024 * 1024
_YOUNG_S = 60.0


class ImportFailedError(ImagingError):
    """A series was not taken into the library; the message says why, and nothing was kept."""


@contextmanager
def staging(library: Path, series: Series) -> Iterator[Path]:
    """Folder beside the library's own for the files of an import; gone afterwards.

    Raises:
        ImportFailedError: if there is no room for the series, or writing fails.
    """
    try:
        library.mkdir(parents=True, exist_ok=True)
        sweep(library)
        _room(library, series)
        folder = Path(tempfile.mkdtemp(dir=library, prefix=_PREFIX))
    except OSError as error:
        raise ImportFailedError(
            sentence(
                "the library {library} cannot be written: {reason}",
                library=library,
                reason=_why(error),
            )
        ) from None
    lock = os.open(folder / LOCK, os.O_CREAT | os.O_RDWR)
    try:
        hold(lock)  # the process that writes there holds it as well
        yield folder
    except OSError as error:
        if isinstance(error, ImagingError):
            raise
        raise ImportFailedError(
            sentence("{reason}; nothing was kept", reason=_why(error))
        ) from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def publish(folder: Path, to: Path) -> None:
    """Rename to its place; the lock goes last, so that no sweep takes a living folder."""
    folder.chmod(0o700)
    sync(folder)
    os.rename(folder, to)
    (to / LOCK).unlink(missing_ok=True)
    sync(to.parent)


def discard(folder: Path) -> None:
    """Delete a folder of the library: first it leaves the library, then the disk."""
    gone = Path(tempfile.mkdtemp(dir=folder.parent, prefix=_PREFIX))
    os.rename(folder, gone / folder.name)
    shutil.rmtree(gone, ignore_errors=True)


def sweep(library: Path) -> int:
    """Delete what imports left that died; returns how many. Living ones hold their lock."""
    swept = 0
    for folder in library.glob(f"{_PREFIX}*"):
        if _abandoned(folder):
            shutil.rmtree(folder, ignore_errors=True)
            swept += 1
    return swept


def _room(library: Path, series: Series) -> None:
    """Ask before writing whether it will fit; a disk that fills meanwhile is met later."""
    try:
        needed = sum(path.stat().st_size for path in series.files)
    except OSError:
        raise ImportFailedError(
            sentence(
                "a file of the series is gone: the folder was moved or its medium taken out; "
                "nothing was kept"
            )
        ) from None
    free = shutil.disk_usage(library).free
    if free < needed + _SPARE_BYTES:
        raise ImportFailedError(
            sentence(
                "the disk of the library has {free:.0f} MB free, this series needs "
                "{needed:.0f} MB; make room, nothing was kept",
                free=free / 1e6,
                needed=(needed + _SPARE_BYTES) / 1e6,
            )
        )


def _why(error: OSError) -> str:
    if error.errno == errno.ENOSPC:
        return sentence("the disk of the library is full")
    return error.strerror or type(error).__name__


def _abandoned(folder: Path) -> bool:
    """Return whether nobody holds the lock of a folder any more; a kill lets go of it too."""
    try:
        lock = os.open(folder / LOCK, os.O_RDWR)
    except FileNotFoundError:  # just being made, or just being deleted
        try:
            return time.time() - folder.stat().st_mtime > _YOUNG_S
        except OSError:
            return False
    except OSError:
        return False
    try:
        return not is_held(lock)
    finally:
        os.close(lock)


_ABOUT = "about.json"
_COPIES = 6
"""Of its largest file the process that writes a series anew may have so many in memory."""


@dataclass(frozen=True, slots=True)
class LibraryEntry:
    """One CT of the library.

    Attributes:
        name: of its folder: pseudonym and a part of the new series UID.
        folder: to be opened like any other.
        label: series number, body part, kernel.
        files: how many.
        report: what was removed, as `RemovalReport.document` gives it.
        remedy: what must be asked for to open it; `NO_REMEDY` for one that opens as it is.
    """

    name: str
    folder: Path
    label: str
    files: int
    report: dict[str, Any]
    remedy: str = NO_REMEDY


@dataclass(frozen=True, slots=True)
class Imported:
    """What an import gave.

    Attributes:
        entry: what lies in the library now.
        report: what was removed.
        again: it lay there before and was kept.
        before: images of this series that lay there before.
        given: images of this series that were given.
    """

    entry: LibraryEntry
    report: RemovalReport
    again: bool
    before: int = 0
    given: int = 0

    @property
    def words(self) -> str:
        """Return what became of it, for people."""
        if self.again and self.given < self.before:
            return sentence(
                "all {stored_images} images of this series are in the library already; the "
                "{given_images} given are a part of them",
                stored_images=self.before,
                given_images=self.given,
            )
        if self.again:
            return sentence("was in the library already, image for image")
        if 0 < self.before < self.given:
            return sentence(
                "taken into the library, in place of {earlier_images} of its {new_images} images "
                "that lay there",
                earlier_images=self.before,
                new_images=self.given,
            )
        return sentence("taken into the library")


class CtLibrary:
    """CTs of this installation, each in a folder of its own.

    Args:
        folder: of all entries; the user's data folder where None.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or paths.data() / "ct"

    def entries(self) -> tuple[LibraryEntry, ...]:
        """List every CT, by name."""
        self.sweep()
        if not self.folder.is_dir():
            return ()
        found = (_entry(path) for path in sorted(self.folder.iterdir()) if path.is_dir())
        return tuple(entry for entry in found if entry is not None)

    def find(self, name: str) -> LibraryEntry:
        """Entry of a name.

        Raises:
            SeriesUnknownError: listing the names that there are.
        """
        entries = self.entries()
        for entry in entries:
            if entry.name == name:
                return entry
        valid = ", ".join(entry.name for entry in entries) or "nothing yet"
        raise SeriesUnknownError(
            sentence("no CT {name!r} in the library; it holds {valid}", name=name, valid=valid)
        )

    def remove(self, name: str) -> None:
        """Delete an entry: first it leaves the library, then the disk.

        Raises:
            SeriesUnknownError: if there is none.
        """
        discard(self.find(name).folder)

    def sweep(self) -> int:
        """Delete what imports left that died; returns how many. Living ones hold their lock."""
        return sweep(self.folder)

    def import_series(
        self,
        series: Series,
        boxes: Sequence[MaskBox] = (),
        progress: Progress | None = None,
        remedy: str = NO_REMEDY,
    ) -> Imported:
        """De-identify a series into the library.

        What lies there of the same series is compared image by image: the same are kept, a part is
        replaced by all, and of all a part changes nothing.

        Args:
            series: as the scan of a folder gave it.
            boxes: pixels to blacken; with them a copy that is there already is replaced.
            progress: told how far it is; cancels, leaving nothing.
            remedy: what will be asked for to open it, for a series that cannot be opened as it is.

        Raises:
            SeriesRefusedError: if the series is not usable as a volume, not even with the remedy.
            PrivacyError: if its pictures carry writing, or a written file is not clean.
            ImportFailedError: if a file cannot be read or written; the disk is full; or the library
                holds other images of this series, which the ones given do not contain.
            Cancelled: if `progress` was cancelled.
        """
        _require_openable(series, remedy)
        _require_one_patient(series)
        progress = progress or Progress()
        with staging(self.folder, series) as folder:
            made, given = _fill(folder, series, boxes, remedy, progress)
            place = self.folder / made.name
            before = _images(place) if place.is_dir() else frozenset()
            _require_comparable(made.name, before, given, masked=bool(boxes))
            again = place.is_dir() and not boxes and given <= before
            if not again:
                if place.is_dir():
                    discard(place)
                publish(folder, place)
        entry = self.find(made.name)
        progress.report(
            1.0, sentence("{files} files taken into the library", files=made.report.files)
        )
        return Imported(entry, made.report, again, len(before), len(given))


def _require_one_patient(series: Series) -> None:
    """Refuse what is not of one patient's study, by whatever way it came together."""
    owners = {header.identity.owner for header in series.slices}
    for name in ("PatientID", "StudyInstanceUID"):
        if len({dict(owner).get(name) for owner in owners}) > 1:
            raise SeriesRefusedError(
                sentence(
                    "this series is not taken into the library: {name} differs among its files, "
                    "and they would get one pseudonym; give the files of one patient's study "
                    "alone",
                    name=name,
                )
            )


def _require_openable(series: Series, remedy: str) -> None:
    if not series.slices:
        why = "only DICOM series are taken into the library; open this file"
        raise SeriesRefusedError(
            why
            if series.usable
            else sentence("{series_reason}; {reason}", series_reason=series.reason, reason=why)
        )
    if series.usable or (remedy in series.remedies):
        return
    raise SeriesRefusedError(
        sentence(
            "this series cannot be used: {series_reason}{offer}",
            series_reason=series.reason,
            offer=offer(series),
        )
    )


Images = frozenset[str]
"""New SOPInstanceUIDs of a series' images."""


def _require_comparable(name: str, before: Images, given: Images, masked: bool) -> None:
    """Refuse images that neither contain what lies there nor are a part of it."""
    if given >= before or (given < before and not masked):
        return
    raise ImportFailedError(
        sentence(
            "the library holds {stored_images} images of this series as {name}; of the "
            "{given_images} given {known_images} are among them and {images_not_given} of those "
            "there are not given: give all images of the series at once, or remove what lies "
            "there first (acus library remove {name}); nothing was changed",
            stored_images=len(before),
            name=name,
            given_images=len(given),
            known_images=len(given & before),
            images_not_given=len(before - given),
        )
    )


def _images(folder: Path) -> Images:
    """Images of an entry; those of one that does not list them are looked at."""
    try:
        about = json.loads((folder / _ABOUT).read_text(encoding="utf-8"))
        return frozenset(str(uid) for uid in about["images"])
    except (OSError, ValueError, KeyError, TypeError):
        return _found_in(folder)[0]


def _found_in(folder: Path) -> tuple[Images, str]:
    """Images of a folder of de-identified files, and the label of their series."""
    found = scan_folder(folder).series
    uids = frozenset(header.identity.sop_uid for one in found for header in one.slices)
    return uids, found[0].label if found else ""


def _fill(
    folder: Path, series: Series, boxes: Sequence[MaskBox], remedy: str, progress: Progress
) -> tuple[Deidentified, Images]:
    """Have every file written and verified by the worker process, and say what it is about."""
    headers = {header.path: header for header in series.slices}.values()
    there = tuple(replace(header, path=header.path.absolute()) for header in headers)
    largest = max(size_of(header.path) for header in there)
    arguments = (there, series.key, folder, tuple(boxes), paths.settings().absolute())
    allowed = Allowance(MOST_SECONDS, MEMORY_BYTES + _COPIES * largest)
    part = progress.part(0.0, 0.98)
    try:
        made = shared_worker().call(DEIDENTIFY, arguments, allowed, part)
    except FileDamagedError as error:
        raise ImportFailedError(sentence("{error}; nothing was kept", error=error)) from None
    progress.report(0.98, sentence("checking what was written"))
    images, label = _found_in(folder)  # of the new files: the old ones may say more
    about = {
        "label": label,
        "pseudonym": made.study,
        "images": sorted(images),
        "remedy": remedy if not series.usable else NO_REMEDY,
        "report": made.report.document(),
    }
    write_atomically(folder / _ABOUT, json.dumps(about, indent=1) + "\n")
    return made, images


def _entry(folder: Path) -> LibraryEntry | None:
    try:
        about = json.loads((folder / _ABOUT).read_text(encoding="utf-8"))
        count = sum(1 for _ in folder.glob("*.dcm"))
        remedy = str(about.get("remedy", NO_REMEDY))
        return LibraryEntry(
            folder.name, folder, str(about["label"]), count, dict(about["report"]), remedy
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
