"""What a file that a PACS sent says that it is, read in the worker process."""

from pathlib import Path

import pydicom

from app.core.progress import Progress

_IDENTITY = ("SOPClassUID", "SOPInstanceUID", "SeriesInstanceUID")


def identity(path: Path, progress: Progress) -> tuple[str, str, str]:
    """Job of the worker: SOP class, SOP instance and series of a file; empty where it is silent."""
    head = pydicom.dcmread(path, stop_before_pixels=True, specific_tags=list(_IDENTITY))
    kind, instance, series = (str(head.get(name, "")) for name in _IDENTITY)
    return kind, instance, series
