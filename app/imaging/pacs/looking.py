"""What a file that a PACS sent says that it is, read in the worker process."""

from pathlib import Path

import pydicom

from app.core.progress import Progress

_IDENTITY = (
    "SOPClassUID", "SOPInstanceUID", "SeriesInstanceUID", "StudyInstanceUID", "PatientID",
)  # fmt: skip


def identity(path: Path, progress: Progress) -> tuple[str, str, str, str, str]:
    """Job of the worker: class, instance, series, study and patient of a file, "" if not said."""
    head = pydicom.dcmread(path, stop_before_pixels=True, specific_tags=list(_IDENTITY))
    kind, instance, series, study, patient = (str(head.get(name, "") or "") for name in _IDENTITY)
    return kind, instance, series, study, patient
