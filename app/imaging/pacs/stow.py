"""Objects of ours to an archive by the web: STOW-RS (PS3.18 10.5), in one request."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final
from uuid import uuid4

from app.core.messages import sentence
from app.core.progress import Progress
from app.core.web import WebAnswer
from app.imaging.pacs.errors import PacsDataError
from app.imaging.pacs.web import WebArchive, document_of

_FAILED: Final = "00081198"
_TAKEN: Final = "00081199"
_REASON: Final = "00081197"
_DUPLICATE: Final = 0x0111


def stow(archive: WebArchive, files: Sequence[Path], progress: Progress | None = None) -> int:
    """Send files of ours in one request; return how many were taken.

    Raises:
        PacsRefusedError, PacsUnreachableError: as `WebArchive.ask`; send it again, an archive keeps
            an object once.
        PacsDataError: if it refuses objects; says how many and why.
        Cancelled: if that was asked for, before it is sent.
    """
    (progress or Progress()).report(0.0, archive.name)
    mark = uuid4().hex
    parts = [
        b"--%b\r\nContent-Type: application/dicom\r\n\r\n%b\r\n"
        % (mark.encode(), path.read_bytes())
        for path in files
    ]
    headers = {
        "Content-Type": f'multipart/related; type="application/dicom"; boundary={mark}',
        "Accept": "application/dicom+json",
    }
    body = b"".join(parts) + b"--%b--\r\n" % mark.encode()
    return _taken(archive, archive.ask("POST", archive.address(), headers, body), len(files))


def _taken(archive: WebArchive, answer: WebAnswer, count: int) -> int:
    status = answer.status
    document = _document(answer)
    taken = _items(document, _TAKEN)
    failed = [one for one in _items(document, _FAILED) if _number(one) != _DUPLICATE]
    if status in (200, 202, 409) and document and not failed:
        there = len(_items(document, _FAILED))
        if len(taken) + there == count:
            return count
    raise PacsDataError(
        sentence(
            "{name} took {taken} of {count} objects ({status}{reasons}): ask who runs it, and send "
            "them again",
            name=archive.name,
            taken=len(taken),
            count=count,
            status=status,
            reasons="".join(f", 0x{_number(one):04X}" for one in failed[:4]),
        )
    )


def _document(answer: WebAnswer) -> dict[str, Any]:
    result = document_of(answer)
    result = result[0] if isinstance(result, list) and result else result
    return result if isinstance(result, dict) else {}


def _items(document: dict[str, Any], tag: str) -> list[dict[str, Any]]:
    held = document.get(tag)
    values = held.get("Value", []) if isinstance(held, dict) else []
    return [one for one in values if isinstance(one, dict)] if isinstance(values, list) else []


def _number(item: dict[str, Any]) -> int:
    try:
        return int(item[_REASON]["Value"][0])
    except (KeyError, IndexError, TypeError, ValueError):
        return 0
