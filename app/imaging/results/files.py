"""The objects of an attempt into a folder: all of them or none, written by the worker."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final
from uuid import uuid4

import numpy as np

from app.core.errors import AcusError
from app.core.messages import sentence, sentence_of
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, brief
from app.imaging.results.attempt_facts import AttemptFacts
from app.imaging.results.errors import ResultsError
from app.imaging.structures.extras import extra
from app.imaging.structures.structure import PlacedStructure, StructureSet
from app.imaging.volume import Volume
from app.imaging.worker.jobs import Job
from app.imaging.worker.limits import MEMORY_BYTES, MOST_SECONDS, Allowance
from app.imaging.worker.pool import shared_worker

SEG, RTSTRUCT, PR, SR = "seg.dcm", "rtstruct.dcm", "gsps.dcm", "sr.dcm"
"""Names of the files."""

MADE_BY: Final = "Acus: "
"""With this the description of each series begins."""

_COPY_BYTES: Final = 16
_WRITE: Job[tuple[str, ...]] = Job("app.imaging.results.files:write_objects", tuple[str, ...])


def write_results(
    folder: Path,
    attempt: AttemptFacts,
    volume: Volume,
    structures: StructureSet,
    progress: Progress | None = None,
) -> tuple[Path, ...]:
    """Write an attempt's objects into a folder; those of the same names there are replaced.

    Without structures there is no SEG, and the structure set has the points alone.

    Args:
        folder: made where it is missing.
        attempt: what is told of it.
        volume: its CT.
        structures: on the CT.
        progress: reports, and may cancel; nothing is left behind then.

    Returns:
        The files.

    Raises:
        ResultsError: if the CT was not de-identified, is not slice for slice that of DICOM files,
            lacks what an object has to repeat, or the folder cannot be written.
        StructureFileError: if a file of the CT is gone or damaged.
        ExtraMissingError: without the extra `structures`.
        WorkerError: if the process that reads the CT's files cannot be started.
        Cancelled: if that was asked for.
    """
    headers = volume.series.slices
    if len(headers) != volume.size[2] or len(set(volume.series.files)) != volume.size[2]:
        raise ResultsError(
            sentence(
                "this CT is not slice for slice that of DICOM files (it was resampled, or comes "
                "from another format): objects can refer to none of its pictures"
            )
        )
    beside = folder.absolute().with_name(f".{folder.name}.{uuid4().hex}")
    plain = tuple(
        PlacedStructure(s.name, s.kind, s.colour, s.mask, s.corner, s.warn_mm) for s in structures
    )
    sources = tuple(header.path.absolute() for header in headers)
    affine = tuple(volume.affine_mm.ravel().tolist())
    room = Allowance(MOST_SECONDS, MEMORY_BYTES + _COPY_BYTES * (1 + len(plain)) * volume.hu.size)
    try:
        beside.mkdir(parents=True)
        arguments = (beside, sources, attempt, plain, volume.size, affine)
        names = shared_worker().call(_WRITE, arguments, room, progress or Progress())
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            os.replace(beside / name, folder / name)
    except FileDamagedError as error:
        raise ResultsError(sentence_of(error)) from error
    except OSError as error:
        if isinstance(error, AcusError):
            raise
        raise ResultsError(
            sentence(
                "{folder} cannot be written: {reason}",
                folder=folder,
                reason=error.strerror or error,
            )
        ) from error
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    return tuple(folder / name for name in names)


def write_objects(
    to: Path,
    sources: tuple[Path, ...],
    attempt: AttemptFacts,
    structures: tuple[PlacedStructure, ...],
    size: tuple[int, int, int],
    affine_mm: tuple[float, ...],
    progress: Progress,
) -> tuple[str, ...]:
    """Job of the worker: write the objects; returns the names of their files.

    Raises:
        ResultsError: as `write_results`.
        StructureFileError: if a file of the CT cannot be read.
        ExtraMissingError: without the extra `structures`.
    """
    highdicom = extra("highdicom", "DICOM objects")
    from app.imaging.results.contours import structure_set
    from app.imaging.results.presentation import presentation
    from app.imaging.results.report import report
    from app.imaging.structures.dicom_seg import read_headers, segmentation

    headers = read_headers(sources, progress.part(0.0, 0.5))
    _require_nobody(headers)
    affine = np.array(affine_mm).reshape(4, 4)
    makers: list[tuple[str, Callable[[], Any]]] = [
        (RTSTRUCT, lambda: structure_set(headers, attempt, structures, affine)),
        (PR, lambda: presentation(highdicom, headers, attempt, affine)),
        (SR, lambda: report(highdicom, headers, attempt)),
    ]
    if structures:
        uids = (
            attempt.uid("SEG series", headers[0].SeriesInstanceUID),
            attempt.uid("SEG", headers[0].SeriesInstanceUID),
        )
        makers.append((SEG, lambda: segmentation(headers, structures, size, uids)))
    for number, (name, make) in enumerate(makers):
        progress.report(0.5 + 0.5 * number / len(makers), name)
        try:
            found = make()
        except (AttributeError, TypeError, ValueError) as error:
            if isinstance(error, AcusError):
                raise
            raise ResultsError(
                sentence(
                    "this CT lacks what {name} has to repeat of it ({lacking})",
                    name=name,
                    lacking=getattr(error, "name", None) or brief(error),
                )
            ) from error
        _date(found, attempt, headers[0])
        found.save_as(to / name, enforce_file_format=True)
    return tuple(name for name, _ in makers)


def _require_nobody(headers: Sequence[Any]) -> None:
    """Refuse a CT that may still name its patient."""
    for header in headers:
        made = str(header.get("PatientID", "")).startswith("PHANTOM-")
        if made and header.get("ManufacturerModelName") == "procedural phantom":
            continue
        if header.get("PatientIdentityRemoved") != "YES":
            raise ResultsError(
                sentence(
                    "this CT was not de-identified, and objects that refer to it would name its "
                    "patient: import it first (`acus ct import`), and give the library's folder"
                )
            )


def _date(result: Any, attempt: AttemptFacts, header: Any) -> None:
    """Date an object by its attempt, and say that nobody is named in it."""
    day, time = attempt.moment[:8], attempt.moment[8:]
    result.InstanceCreationDate = result.SeriesDate = day
    result.InstanceCreationTime = result.SeriesTime = time
    for date, clock in (
        ("ContentDate", "ContentTime"),
        ("PresentationCreationDate", "PresentationCreationTime"),
    ):
        if date in result:
            setattr(result, date, day)
            setattr(result, clock, time)
    for element in result.iterall():  # what highdicom makes up anew each time
        if element.keyword == "ContributionDateTime":
            element.value = attempt.moment
        elif element.keyword == "DimensionOrganizationUID":
            element.value = attempt.uid("dimensions")
    result.SpecificCharacterSet = "ISO_IR 192"
    if result.Modality == "PR":
        result.Laterality = ""  # asked for, if only as not known
    result.SeriesDescription = f"{MADE_BY}{attempt.title}"[:64]
    result.PatientIdentityRemoved = "YES"
    result.DeidentificationMethod = header.get("DeidentificationMethod") or "made patient"
    if codes := header.get("DeidentificationMethodCodeSequence"):
        result.DeidentificationMethodCodeSequence = codes
