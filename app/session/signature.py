"""Signs finished attempts with the station's key, and tells what a signature says of a record.

Beside a record stands `<id>.sig`: digests of the record, of its score and of its exercise, what
lists show of them, and an HMAC-SHA256 (RFC 2104) over all that with the key of this station.
*verified* means: written by this station and unchanged since. It does not mean that the owner of
the disk could not forge it, for whoever reads the key can sign. *unsigned* is a record without a
signature, or with that of another station.
"""

from __future__ import annotations

import hashlib
import hmac
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any, Final

from app.core.files import read_at_most
from app.core.messages import joined, sentence
from app.session.conditions import EXERCISE_FILE
from app.session.recording import open_recording
from app.session.sidecar import Cached, file_digest
from app.session.station import StationKey
from app.session.summary import Summary, derive
from app.session.verify import SCORE_FILE

_VERSION: Final = 1


class Signed(StrEnum):
    """What a signature says of a record, or the instructor in its place."""

    VERIFIED = "verified"
    ALTERED = "altered"
    UNSIGNED = "unsigned"
    ADMITTED = "admitted"


@dataclass(frozen=True, slots=True)
class SignatureCheck:
    """A verdict with its reason.

    Attributes:
        verdict: of the signature.
        why: what was altered, or why it counts as unsigned; empty if it is verified.
    """

    verdict: Signed
    why: str = ""

    def sentence(self) -> str:
        """Say it in one line."""
        return joined(": ", filter(None, (self.verdict.value, self.why)))


def signature_file(path: Path) -> Path:
    """Return the file of a record's signature."""
    return path.with_suffix(".sig")


def signed(
    path: Path, digest: str, summary: Summary, files: Mapping[str, bytes], key: StationKey
) -> str:
    """Return the signature of a finished record, as it stands beside it.

    Args:
        path: the record.
        digest: its SHA-256, hexadecimal.
        summary: what lists show of it.
        files: its attachments by name.
        key: of this station.
    """
    document = _document(path, digest, summary, files, key.station)
    return json.dumps(document | {"hmac": key.seal(document)}, indent=1) + "\n"


def judge(path: Path, stored: Cached, key: StationKey | None) -> SignatureCheck:
    """Say for a list what the signature of a record says, from what is kept beside it.

    The record is not read: its digest is that of `stored`, which lists trust as long as the
    record's size and time are what they were. `judge_whole` reads it.
    """
    found = _read(path, key)
    if isinstance(found, SignatureCheck):
        return found
    with suppress(OSError):
        if not stored.is_of(path):  # signed after it was read, and looked at next time
            return SignatureCheck(
                Signed.UNSIGNED, sentence("the record was written while it was read")
            )
    if found["record"] != stored.sha256:
        return SignatureCheck(Signed.ALTERED, sentence("the record is not the one that was signed"))
    shown = _shown(stored.summary)
    other = [name for name, value in found["shown"].items() if shown.get(name) != value]
    if _rules(stored.summary) != found["rules"] and file_digest(path) == found["record"]:
        # What the record gives by today's rules, if it is that, is the record's own word.
        fresh = _shown(derive(open_recording(path)))
        other = [name for name in other if fresh.get(name) != shown.get(name)]
    if other:
        return SignatureCheck(
            Signed.ALTERED, sentence("the list shows another {key} than was signed", key=other[0])
        )
    return SignatureCheck(Signed.VERIFIED)


def judge_whole(path: Path, key: StationKey | None) -> SignatureCheck:
    """Say what the signature of a record says, reading the whole record.

    Raises:
        BrokenRecordingError: if it is none.
    """
    found = _read(path, key)
    if isinstance(found, SignatureCheck):
        return found
    if found["record"] == file_digest(path):
        return SignatureCheck(Signed.VERIFIED)
    files = open_recording(path).attachments
    for name, word in ((SCORE_FILE, "score"), (EXERCISE_FILE, "exercise")):
        if _digest(files.get(name)) != found[word]:
            return SignatureCheck(
                Signed.ALTERED,
                sentence("the {part} in it is not the one that was signed", part=word),
            )
    return SignatureCheck(Signed.ALTERED, sentence("the record is not the one that was signed"))


def judged(path: Path, stored: Cached, key: StationKey | None) -> Summary:
    """Return the summary of a record with the verdict of its signature.

    One that was altered has no score: nobody earned what it says now.
    """
    judgement, summary = judge(path, stored, key), stored.summary
    if judgement.verdict is Signed.ALTERED:
        problems = (*summary.problems, f"altered after it was signed: {judgement.why}")
        summary = replace(summary, score=None, problems=problems)
    return replace(summary, signature=judgement.verdict.value)


def _read(path: Path, key: StationKey | None) -> dict[str, Any] | SignatureCheck:
    """Return the signed document, or what can be said without it."""
    try:
        document: dict[str, Any] = json.loads(read_at_most(signature_file(path)).decode("ascii"))
        seal = str(document.pop("hmac"))
        station, fields = str(document["station"]), (document["record"], document["shown"].items())
    except FileNotFoundError:
        return SignatureCheck(Signed.UNSIGNED, sentence("no signature stands beside it"))
    except OSError as error:
        return SignatureCheck(
            Signed.UNSIGNED,
            sentence("its signature cannot be read: {reason}", reason=error.strerror),
        )
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return SignatureCheck(Signed.ALTERED, sentence("its signature is damaged"))
    if key is None or station != key.station:
        return SignatureCheck(
            Signed.UNSIGNED, sentence("signed by another station ({station})", station=station[:16])
        )
    with suppress(ValueError, TypeError, RecursionError):
        if fields and hmac.compare_digest(seal.encode(), key.seal(document).encode()):
            if document["id"] == path.stem:
                return document
            return SignatureCheck(
                Signed.ALTERED, sentence("the signature beside it is that of another attempt")
            )
    return SignatureCheck(Signed.ALTERED, sentence("its signature is not this station's"))


def _document(
    path: Path, digest: str, summary: Summary, files: Mapping[str, bytes], station: str
) -> dict[str, Any]:
    return {
        "version": _VERSION,
        "station": station,
        "id": path.stem,
        "record": digest,
        "score": _digest(files.get(SCORE_FILE)),
        "exercise": _digest(files.get(EXERCISE_FILE)),
        "rules": _rules(summary),
        "shown": _shown(summary),
    }


def _shown(summary: Summary) -> dict[str, Any]:
    score = summary.score or {}
    total = score.get("total")
    return {
        "student": summary.student,
        "exercise": summary.exercise_id,
        "state": summary.state,
        "total": None if total is None else f"{float(total):.6f}",
        "passed": score.get("passed"),
    }


def _rules(summary: Summary) -> int:
    return int((summary.score or {}).get("scoring_version", 0) or 0)


def _digest(data: bytes | None) -> str:
    return "" if data is None else hashlib.sha256(data).hexdigest()
