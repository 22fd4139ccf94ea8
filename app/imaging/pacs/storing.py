"""Objects of ours to a PACS, by C-STORE.

What it has already (their UIDs are made of the attempt's) it keeps or replaces by the same; a
sending that broke off can be repeated.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.pacs.association import association
from app.imaging.pacs.errors import PacsDataError, PacsRefusedError, PacsUnreachableError
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.statuses import SUCCESS, words
from app.imaging.results.files import MADE_BY

_EXPLICIT: Final = "1.2.840.10008.1.2.1"
_THERE_ALREADY: Final = 0x0111
_TAKEN: Final = (SUCCESS, _THERE_ALREADY, 0xB000, 0xB006, 0xB007)
"""Done, there already, and the three warnings of PS3.4 B.2.3."""


def own_objects(folder: Path) -> tuple[Path, ...]:
    """Return the DICOM files of a folder, which this program has written of an attempt.

    Raises:
        PacsDataError: if there is no folder, or none of them in it; or one is another file, such
            as a CT with its names.
    """
    from pydicom import dcmread
    from pydicom.errors import InvalidDicomError

    if not folder.is_dir():
        raise PacsDataError(sentence("there is no folder {folder}", folder=folder))
    files = tuple(sorted(folder.glob("*.dcm")))
    if not files:
        raise PacsDataError(
            sentence(
                "{folder} holds no DICOM objects: give the folder that `acus session export ID "
                "--dicom FOLDER` has written",
                folder=folder,
            )
        )
    for path in files:
        try:
            header = dcmread(path, stop_before_pixels=True)
        except (OSError, InvalidDicomError) as error:
            raise PacsDataError(
                sentence("{file} cannot be read: {reason}", file=path, reason=str(error))
            ) from error
        if not str(header.get("SeriesDescription", "")).startswith(MADE_BY):
            raise PacsDataError(
                sentence("{file} is not an object of an attempt: nothing was sent", file=path)
            )
    return files


def store(settings: PacsSettings, files: Sequence[Path], progress: Progress | None = None) -> int:
    """Send files of ours, one after the other; return how many were taken.

    Raises:
        PacsRefusedError: if it does not accept this program, or takes no objects of such a kind.
        PacsUnreachableError: if it is not there, or was gone in the middle.
        PacsDataError: if it refuses an object; the message says how many it had taken.
        ConfigurationError: without the extra `pacs`.
        Cancelled: if that was asked for.
    """
    from pydicom import dcmread

    progress = progress or Progress()
    objects = [dcmread(path) for path in files]
    contexts = [(str(kind), (_EXPLICIT,)) for kind in dict.fromkeys(o.SOPClassUID for o in objects)]
    with association(settings, contexts, progress) as linked:
        for number, (path, one) in enumerate(zip(files, objects, strict=True)):
            progress.report(number / len(objects), path.name)
            _send(linked, one, path, settings, number, len(objects))
    return len(objects)


def _send(
    linked: Any, dataset: Any, path: Path, settings: PacsSettings, number: int, count: int
) -> None:
    accepted = {str(context.abstract_syntax) for context in linked.accepted_contexts}
    if str(dataset.SOPClassUID) not in accepted:
        raise PacsRefusedError(
            sentence(
                "{name} takes no objects of the kind of {file} ({kind}): its administrator can "
                "allow them; {taken} of {count} were taken",
                name=settings.name,
                file=path.name,
                kind=dataset.SOPClassUID.name,
                taken=number,
                count=count,
            )
        )
    try:
        status = linked.send_c_store(dataset)
    except AcusError:
        raise
    except (RuntimeError, ValueError, OSError) as error:  # the association has gone
        raise _gone(settings, path, number, count) from error
    if "Status" not in status:
        raise _gone(settings, path, number, count)
    if int(status.Status) not in _TAKEN:
        raise PacsDataError(
            sentence(
                "{name} refused {file}: {refusal}; {taken} of {count} were taken, and can be "
                "sent again",
                name=settings.name,
                file=path.name,
                refusal=words(int(status.Status)),
                taken=number,
                count=count,
            )
        )


def _gone(settings: PacsSettings, path: Path, number: int, count: int) -> PacsUnreachableError:
    return PacsUnreachableError(
        sentence(
            "{name} was gone, or silent for {seconds:g} s, when {file} was sent: {taken} of "
            "{count} were taken; send them again, it keeps each once",
            name=settings.name,
            seconds=settings.timeout_s,
            file=path.name,
            taken=number,
            count=count,
        )
    )
