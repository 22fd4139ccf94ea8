"""The library: CTs that were taken in, de-identified, whole or not at all.

An import is written into a staging folder, synced, read again and searched, and only then renamed
to its place. Whatever ends it (an error, a full disk, a cancel, a kill) leaves nothing in the
library; the staging of a process that died is swept away at the next look.
"""

import errno
import fcntl
import json
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.core import paths
from app.core.files import sync, write_atomically
from app.core.progress import Cancelled, Progress
from app.imaging.errors import (
    FileDamagedError,
    ImagingError,
    SeriesRefusedError,
    SeriesUnknownError,
)
from app.imaging.privacy import dates
from app.imaging.privacy.actions import Rules
from app.imaging.privacy.burned_in import Box, check_numbers, of_picture
from app.imaging.privacy.errors import PrivacyError
from app.imaging.privacy.files import convert, read_original
from app.imaging.privacy.key import installation_key
from app.imaging.privacy.profile import profile
from app.imaging.privacy.pseudonyms import patient_pseudonym, pseudonym
from app.imaging.privacy.report import Report, Tally
from app.imaging.privacy.uids import UidMap
from app.imaging.privacy.verify import Secrets, verify
from app.imaging.scanning import scan_folder
from app.imaging.series import Series

_STAGING = ".staging-"
_LOCK = ".lock"
_ABOUT = "about.json"
_SPARE_BYTES = 64 * 1024 * 1024
_YOUNG_S = 60.0


class ImportFailedError(ImagingError):
    """A series was not taken into the library; the message says why, and nothing was kept."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One CT of the library.

    Attributes:
        name: of its folder: pseudonym and a part of the new series UID.
        folder: to be opened like any other.
        label: series number, body part, kernel.
        files: how many.
        report: what was removed, as `Report.document` gives it.
    """

    name: str
    folder: Path
    label: str
    files: int
    report: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Imported:
    """What an import gave: the entry, the report, and whether it had been there before."""

    entry: Entry
    report: Report
    again: bool


class CtLibrary:
    """CTs of this installation, each in a folder of its own.

    Args:
        folder: of all entries; the user's data folder where None.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or paths.data() / "ct"

    def entries(self) -> tuple[Entry, ...]:
        """List every CT, by name."""
        self.sweep()
        if not self.folder.is_dir():
            return ()
        found = (_entry(path) for path in sorted(self.folder.iterdir()) if path.is_dir())
        return tuple(entry for entry in found if entry is not None)

    def find(self, name: str) -> Entry:
        """Entry of a name.

        Raises:
            SeriesUnknownError: listing the names that there are.
        """
        entries = self.entries()
        for entry in entries:
            if entry.name == name:
                return entry
        valid = ", ".join(entry.name for entry in entries) or "nothing yet"
        raise SeriesUnknownError(f"no CT {name!r} in the library; it holds {valid}")

    def remove(self, name: str) -> None:
        """Delete an entry: first it leaves the library, then the disk.

        Raises:
            SeriesUnknownError: if there is none.
        """
        entry = self.find(name)
        gone = Path(tempfile.mkdtemp(dir=self.folder, prefix=_STAGING))
        os.rename(entry.folder, gone / entry.name)
        shutil.rmtree(gone, ignore_errors=True)

    def sweep(self) -> int:
        """Delete what imports left that died; returns how many. Living ones hold their lock."""
        swept = 0
        for folder in self.folder.glob(f"{_STAGING}*"):
            if _abandoned(folder):
                shutil.rmtree(folder, ignore_errors=True)
                swept += 1
        return swept

    def import_series(
        self, series: Series, boxes: Sequence[Box] = (), progress: Progress | None = None
    ) -> Imported:
        """De-identify a series into the library.

        Args:
            series: as the scan of a folder gave it.
            boxes: pixels to blacken; with them a copy that is there already is replaced.
            progress: told how far it is; cancels, leaving nothing.

        Raises:
            SeriesRefusedError: if the series is not usable as a volume.
            PrivacyError: if its pictures carry writing, or a written file is not clean.
            ImportFailedError: if a file cannot be read or written; the disk is full.
            Cancelled: if `progress` was cancelled.
        """
        if not series.usable:
            raise SeriesRefusedError(f"this series cannot be used: {series.reason}")
        if not series.slices:
            raise SeriesRefusedError("only DICOM series are taken into the library; open this file")
        progress = progress or Progress()
        with self._staging(series) as staging:
            report, name = _fill(staging, series, boxes, progress)
            again = (self.folder / name).is_dir() and not boxes
            if not again:
                self._publish(staging, name)
        entry = self.find(name)
        progress.report(1.0, f"{report.files} files taken into the library")
        return Imported(entry, report, again)

    @contextmanager
    def _staging(self, series: Series) -> Iterator[Path]:
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self.sweep()
            self._room(series)
            staging = Path(tempfile.mkdtemp(dir=self.folder, prefix=_STAGING))
        except OSError as error:
            raise ImportFailedError(
                f"the library {self.folder} cannot be written: {_why(error)}"
            ) from None
        lock = os.open(staging / _LOCK, os.O_CREAT | os.O_RDWR)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield staging
        except OSError as error:
            if isinstance(error, ImagingError):
                raise
            raise ImportFailedError(f"{_why(error)}; nothing was kept") from None
        finally:
            shutil.rmtree(staging, ignore_errors=True)
            os.close(lock)

    def _room(self, series: Series) -> None:
        """Ask before writing whether it will fit; a disk that fills meanwhile is met later."""
        try:
            needed = sum(path.stat().st_size for path in dict.fromkeys(series.files))
        except OSError:
            raise ImportFailedError(
                "a file of the series is gone: the folder was moved or its medium taken out; "
                "nothing was kept"
            ) from None
        free = shutil.disk_usage(self.folder).free
        if free < needed + _SPARE_BYTES:
            raise ImportFailedError(
                f"the disk of the library has {free / 1e6:.0f} MB free, this series needs "
                f"{(needed + _SPARE_BYTES) / 1e6:.0f} MB; make room, nothing was kept"
            )

    def _publish(self, staging: Path, name: str) -> None:
        """Rename to its place; the lock goes last, so that no sweep takes a living folder."""
        staging.chmod(0o755)
        sync(staging)
        if (self.folder / name).is_dir():
            self.remove(name)
        os.rename(staging, self.folder / name)
        (self.folder / name / _LOCK).unlink(missing_ok=True)
        sync(self.folder)


def _fill(
    staging: Path, series: Series, boxes: Sequence[Box], progress: Progress
) -> tuple[Report, str]:
    """Write and verify every file; returns the report and the entry's name."""
    headers = list({header.path: header for header in series.slices}.values())
    check_numbers(boxes, len(headers))
    rules = _counted(1, len(headers), lambda: _rules(headers[0]))
    secrets, tally = Secrets(rules.profile), Tally()
    digests = []
    for index, header in enumerate(headers):
        progress.report(0.7 * index / len(headers), f"file {index + 1} of {len(headers)}")
        drawn = of_picture(boxes, index + 1)
        write = _writer(header, staging / _file(index), rules, drawn, secrets, tally)
        digests.append(_counted(index + 1, len(headers), write))
    for index, digest in enumerate(digests):
        share = 0.7 + 0.3 * index / len(headers)
        progress.report(share, f"checking file {index + 1} of {len(headers)}")
        verify(staging / _file(index), secrets, rules.uids.old, digest)
    progress.report(0.99, "looking at what was written")
    report = tally.report()
    label = scan_folder(staging).series[0].label  # of the new files: the old ones may say more
    about = {"label": label, "pseudonym": rules.study, "report": report.document()}
    write_atomically(staging / _ABOUT, json.dumps(about, indent=1) + "\n")
    new_uid = rules.uids.new(f"{series.uid}#{series.part}" if series.part else series.uid)
    return report, f"{rules.study}-{int(new_uid.split('.')[-1]) % 16**6:06X}"


def _writer(
    header: Any, to: Path, rules: Rules, boxes: Sequence[Box], secrets: Secrets, tally: Tally
) -> Callable[[], str]:
    return lambda: convert(header, to, rules, boxes, secrets, tally)


def _counted(number: int, count: int, work: Callable[[], Any]) -> Any:
    """Name a file by its number: the names of files and folders may tell who the patient is."""
    try:
        return work()
    except Cancelled:
        raise
    except PrivacyError as error:
        raise type(error)(f"file {number} of {count}: {error}") from None
    except FileDamagedError as error:
        raise ImportFailedError(f"file {number} of {count}: {error}; nothing was kept") from None


def _rules(first: Any) -> Rules:
    original = read_original(first)
    key = installation_key()
    patient = str(original.get("PatientID", "") or "").strip(" \0")
    study = str(original.get("StudyInstanceUID", "") or "").strip(" \0")
    return Rules(
        profile(),
        UidMap(key),
        dates.shift_of(key, patient, study),
        patient_pseudonym(key, patient, study),
        pseudonym(patient, study),
    )


def _file(index: int) -> str:
    return f"{index + 1:06d}.dcm"


def _why(error: OSError) -> str:
    if error.errno == errno.ENOSPC:
        return "the disk of the library is full"
    return error.strerror or type(error).__name__


def _abandoned(folder: Path) -> bool:
    """Whether nobody holds the lock of a staging folder any more; a kill lets go of it too."""
    try:
        lock = os.open(folder / _LOCK, os.O_RDWR)
    except FileNotFoundError:  # just being made, or just being deleted
        return time.time() - folder.stat().st_mtime > _YOUNG_S
    except OSError:
        return False
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    finally:
        os.close(lock)
    return True


def _entry(folder: Path) -> Entry | None:
    try:
        about = json.loads((folder / _ABOUT).read_text(encoding="utf-8"))
        count = sum(1 for _ in folder.glob("*.dcm"))
        return Entry(folder.name, folder, str(about["label"]), count, dict(about["report"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
