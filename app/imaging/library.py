"""The library: CTs that were taken in, de-identified, whole or not at all.

An import is written into a staging folder, synced, read again and searched, and only then renamed
to its place. Whatever ends it (an error, a full disk, a cancel, a kill) leaves nothing in the
library; the staging of a process that died is swept away at the next look.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from app.core import paths
from app.core.files import write_atomically
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, SeriesRefusedError, SeriesUnknownError
from app.imaging.privacy.burned_in import Box
from app.imaging.privacy.deidentified import Deidentified
from app.imaging.privacy.report import Report
from app.imaging.scanning import scan_folder
from app.imaging.series import Series
from app.imaging.staging import ImportFailedError as ImportFailedError  # named here for others
from app.imaging.staging import discard, publish, staging, sweep
from app.imaging.worker.jobs import DEIDENTIFY
from app.imaging.worker.limits import MEMORY_BYTES, MOST_SECONDS, Allowance, size_of
from app.imaging.worker.pool import shared_worker

_ABOUT = "about.json"
_COPIES = 6
"""Of its largest file the process that writes a series anew may have so many in memory."""


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
        discard(self.find(name).folder)

    def sweep(self) -> int:
        """Delete what imports left that died; returns how many. Living ones hold their lock."""
        return sweep(self.folder)

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
        with staging(self.folder, series) as folder:
            made = _fill(folder, series, boxes, progress)
            place = self.folder / made.name
            again = place.is_dir() and not boxes
            if not again:
                if place.is_dir():
                    discard(place)
                publish(folder, place)
        entry = self.find(made.name)
        progress.report(1.0, f"{made.report.files} files taken into the library")
        return Imported(entry, made.report, again)


def _fill(folder: Path, series: Series, boxes: Sequence[Box], progress: Progress) -> Deidentified:
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
        raise ImportFailedError(f"{error}; nothing was kept") from None
    progress.report(0.98, "looking at what was written")
    label = scan_folder(folder).series[0].label  # of the new files: the old ones may say more
    about = {"label": label, "pseudonym": made.study, "report": made.report.document()}
    write_atomically(folder / _ABOUT, json.dumps(about, indent=1) + "\n")
    return made


def _entry(folder: Path) -> Entry | None:
    try:
        about = json.loads((folder / _ABOUT).read_text(encoding="utf-8"))
        count = sum(1 for _ in folder.glob("*.dcm"))
        return Entry(folder.name, folder, str(about["label"]), count, dict(about["report"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
