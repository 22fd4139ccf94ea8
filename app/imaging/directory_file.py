"""A DICOMDIR, read in the worker process: which files it names."""

from pathlib import Path

import pydicom

from app.core.progress import Progress
from app.imaging.errors import FileDamagedError

_MOST_RECORDS = 1_000_000


def named_files(path: Path, progress: Progress) -> tuple[tuple[str, ...], ...]:
    """Job of the worker: names of the files that a DICOMDIR refers to, folder by folder.

    Raises:
        FileDamagedError: if it holds more records than any medium.
    """
    records = pydicom.dcmread(path, force=True).get("DirectoryRecordSequence") or []
    if len(records) > _MOST_RECORDS:
        raise FileDamagedError(f"it holds {len(records)} records")
    named = [record.get("ReferencedFileID") for record in records]
    return tuple(
        (each,) if isinstance(each, str) else tuple(map(str, each)) for each in named if each
    )
