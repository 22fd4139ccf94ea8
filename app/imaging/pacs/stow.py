"""Objects of ours to an archive by the web: STOW-RS (PS3.18 10.5), in one request."""

from __future__ import annotations

import json
import ssl
from collections.abc import Sequence
from dataclasses import dataclass, field
from http.client import HTTPException
from pathlib import Path
from typing import Any, Final
from urllib.parse import urlsplit
from uuid import uuid4

from app.core.messages import sentence
from app.core.progress import Progress
from app.core.web import WebAnswer, basic, exchange, fault_of_address
from app.imaging.pacs.errors import PacsDataError, PacsRefusedError, PacsUnreachableError

_FAILED: Final = "00081198"
_TAKEN: Final = "00081199"
_REASON: Final = "00081197"
_DUPLICATE: Final = 0x0111


@dataclass(frozen=True, slots=True)
class WebArchive:
    """An archive that speaks DICOMweb.

    Attributes:
        url: of the service, before `/studies`.
        user: name that it knows us by; empty where it asks for none.
        password: that goes with it; in no message.
        seconds: that an answer may take.
    """

    url: str
    user: str = ""
    password: str = field(default="", repr=False)
    seconds: float = 60.0

    @property
    def name(self) -> str:
        """Return host and port, which messages call it by."""
        return urlsplit(self.url).netloc


def stow(archive: WebArchive, files: Sequence[Path], progress: Progress | None = None) -> int:
    """Send files of ours in one request; return how many were taken.

    Raises:
        PacsRefusedError: if it lets us not in, sends elsewhere, is none, or the address shows what
            is sent to a network.
        PacsUnreachableError: if it does not answer, or not to the end: send it again, an archive
            keeps an object once.
        PacsDataError: if it refuses objects; says how many and why.
        Cancelled: if that was asked for, before it is sent.
    """
    if fault := fault_of_address(archive.url):
        raise PacsRefusedError(sentence("archive: {fault}", fault=fault))
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
    } | basic(archive.user, archive.password)
    body = b"".join(parts) + b"--%b--\r\n" % mark.encode()
    where = f"{archive.url.rstrip('/').removesuffix('/studies')}/studies"
    try:
        answer = exchange("POST", where, headers, body, archive.seconds)
    except ssl.SSLCertVerificationError as error:
        raise PacsRefusedError(
            sentence(
                "{name} shows a certificate that is not trusted ({reason}): nothing was sent; ask "
                "who runs it, or name its authority by SSL_CERT_FILE",
                name=archive.name,
                reason=error.verify_message,
            )
        ) from error
    except (OSError, HTTPException) as error:
        raise PacsUnreachableError(
            sentence(
                "{name} does not answer, or not to the end, within {seconds:g} s: send it again, "
                "what it has taken is kept once",
                name=archive.name,
                seconds=archive.seconds,
            )
        ) from error
    return _taken(archive, answer, len(files))


def _taken(archive: WebArchive, answer: WebAnswer, count: int) -> int:
    status = answer.status
    if status in (401, 403):
        raise PacsRefusedError(
            sentence(
                "{name} does not let {user!r} in ({status}): give name and password again",
                name=archive.name,
                user=archive.user,
                status=status,
            )
        )
    if 300 <= status < 400:
        raise PacsRefusedError(
            sentence(
                "{name} sends on to {other}: it was not followed; if the archive is there, give "
                "that address",
                name=archive.name,
                other=answer.elsewhere,
            )
        )
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
    try:
        found = json.loads(answer.body)
    except (ValueError, RecursionError):
        return {}
    found = found[0] if isinstance(found, list) and found else found
    return found if isinstance(found, dict) else {}


def _items(document: dict[str, Any], tag: str) -> list[dict[str, Any]]:
    held = document.get(tag)
    values = held.get("Value", []) if isinstance(held, dict) else []
    return [one for one in values if isinstance(one, dict)] if isinstance(values, list) else []


def _number(item: dict[str, Any]) -> int:
    try:
        return int(item[_REASON]["Value"][0])
    except (KeyError, IndexError, TypeError, ValueError):
        return 0
