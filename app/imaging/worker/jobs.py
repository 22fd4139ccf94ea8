"""The table of jobs: whatever is parsed of a foreign file, and what comes of it.

What only one folder asks for is named there in the same way.

A job is a function of plain values, with the progress as its last argument. It runs in the child;
the program names it, and reads what comes back by the type that stands here, never by what the
child says that it is.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from app.imaging.header import SliceHeader
from app.imaging.nifti_file import NiftiHeader, NiftiValues
from app.imaging.privacy.report import Deidentified
from app.imaging.series import Ignored
from app.imaging.structures.structure import PlacedStructures
from app.imaging.worker.attachments import Attachments
from app.imaging.worker.limits import Allowance
from app.imaging.worker.values import plain

Result = TypeVar("Result")


@dataclass(frozen=True, slots=True)
class Job(Generic[Result]):
    """One kind of work.

    Attributes:
        place: `module:function`, imported by the child when it is first asked for.
        gives: type of what comes back: made of dataclasses, tuples, plain values and arrays.
    """

    place: str
    gives: Any


READ_HEADERS: Job[tuple[SliceHeader, ...] | Ignored] = Job(
    "app.imaging.header_reading:headers_in", tuple[SliceHeader, ...] | Ignored
)
LOAD_DECODERS: Job[None] = Job("app.imaging.rescaling:load_decoders", None)
FILL: Job[None] = Job("app.imaging.rescaling:fill", None)
NIFTI_HEADER: Job[NiftiHeader] = Job("app.imaging.nifti_file:nifti_header", NiftiHeader)
NIFTI_VALUES: Job[NiftiValues] = Job("app.imaging.nifti_file:nifti_values", NiftiValues)
DIRECTORY: Job[tuple[tuple[str, ...], ...]] = Job(
    "app.imaging.sources:named_files", tuple[tuple[str, ...], ...]
)
STRUCTURES: Job[PlacedStructures] = Job(
    "app.imaging.structures.parsing:parse_structures", PlacedStructures
)
DEIDENTIFY: Job[Deidentified] = Job(
    "app.imaging.privacy.deidentifying:deidentify_series", Deidentified
)
WRITE_SEG: Job[None] = Job("app.imaging.structures.dicom_seg:write_seg_file", None)
UNPACK: Job[tuple[tuple[str, str], ...]] = Job(
    "app.imaging.sources:unpack_into", tuple[tuple[str, str], ...]
)


@dataclass(frozen=True, slots=True)
class Task:
    """A job and what it is about.

    Attributes:
        job: which.
        message: what the child is told.
        attachments: arrays that go with it.
        allowed: what it may take.
    """

    job: Job[Any]
    message: Sequence[Any]
    attachments: Attachments
    allowed: Allowance

    @classmethod
    def of(cls, job: Job[Any], arguments: Sequence[Any], allowed: Allowance) -> "Task":
        """Task of a job with plain arguments, dataclasses, tuples and arrays of them."""
        attachments = Attachments()
        there = [plain(argument, attachments) for argument in arguments]
        return cls(job, [job.place, allowed.bytes, there, bool(attachments)], attachments, allowed)
