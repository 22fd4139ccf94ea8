"""Signs finished attempts with the station's key, and tells what a signature says of a record.

Beside a record stands `<id>.sig`: digests of the record, of its score and of its exercise, what
lists show of them, an Ed25519 signature (RFC 8032) of all that, and an HMAC-SHA256 (RFC 2104) over
the whole with the key of this station. Earlier ones have the HMAC alone, and hold as well.
*verified* means: written by this station and unchanged since; *verified (station B)*: by the known
station B, as its public key tells. It does not mean that the owner of the disk could not forge it,
for whoever reads the key can sign. *revoked* is what a station signed that is trusted no longer.
*unsigned* is a record without a signature, or with that of a station that is not known here.
"""

from __future__ import annotations

import hashlib
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
from app.session.station import StationKey, signature_holds
from app.session.stations import known_stations
from app.session.summary import Summary, derive
from app.session.verify import SCORE_FILE

_VERSION: Final = 1


class Signed(StrEnum):
    """What a signature says of a record, or the instructor in its place."""

    VERIFIED = "verified"
    ALTERED = "altered"
    UNSIGNED = "unsigned"
    ADMITTED = "admitted"
    REVOKED = "revoked"


RECORD: Final = "record"
"""Purpose of the signatures of records."""

_BEYOND: Final = ("public", "ed25519")
"""What stands in the file beside the document that is signed, under the HMAC as well."""


@dataclass(frozen=True, slots=True)
class SignatureCheck:
    """A verdict with its reason.

    Attributes:
        verdict: of the signature.
        why: what was altered, or why it counts as unsigned; empty if it is verified.
        station: name of the known station that signed it; empty for this one.
    """

    verdict: Signed
    why: str = ""
    station: str = ""

    @property
    def word(self) -> str:
        """Return what lists say: the verdict, with the station if that is another one."""
        name = self.station
        return f"{self.verdict.value} (station {name})" if name else self.verdict.value

    def sentence(self) -> str:
        """Say it in one line."""
        return joined(": ", filter(None, (self.word, self.why)))


def vouched_for(verdict: str) -> bool:
    """Return whether a verdict, as lists say it, lets an attempt count where stations sign."""
    first = verdict.partition(" (")[0]
    return first in (Signed.VERIFIED, Signed.ADMITTED)


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
    return signature_text(_document(path, digest, summary, files, key.station), key)


def signature_text(document: Mapping[str, Any], key: StationKey) -> str:
    """Return the file of a signature: the document, signed and then sealed.

    Args:
        document: digests and what is shown; a signature that it has already is made anew.
        key: of this station.
    """
    bare = {name: value for name, value in document.items() if name not in (*_BEYOND, "hmac")}
    whole = bare | {"public": key.public, "ed25519": key.sign(RECORD, bare)}
    return json.dumps(whole | {"hmac": key.seal(whole)}, indent=1) + "\n"


def read_signature(path: Path, key: StationKey | None) -> tuple[dict[str, Any], SignatureCheck]:
    """Return the document of a record's signature, and what that is worth before any look at it.

    Args:
        path: the record.
        key: of this station.

    Returns:
        The document, empty where there is none or nobody vouches for it; the verdict is `verified`
        where the signature holds, whatever the record is now.
    """
    return _read(path, key)


def judge(path: Path, stored: Cached, key: StationKey | None) -> SignatureCheck:
    """Say for a list what the signature of a record says, from what is kept beside it.

    The record is not read: its digest is that of `stored`, which lists trust as long as the
    record's size and time are what they were. `judge_whole` reads it.
    """
    found, check = _read(path, key)
    if check.verdict not in (Signed.VERIFIED, Signed.REVOKED):
        return check
    with suppress(OSError):
        if not stored.is_of(path):  # signed after it was read, and looked at next time
            return SignatureCheck(
                Signed.UNSIGNED, sentence("the record was written while it was read")
            )
    if found["record"] != stored.sha256:
        return SignatureCheck(Signed.ALTERED, sentence("the record is not the one that was signed"))
    shown = shown_of(stored.summary)
    other = [name for name, value in found["shown"].items() if shown.get(name) != value]
    if _rules(stored.summary) != found["rules"] and file_digest(path) == found["record"]:
        # What the record gives by today's rules, if it is that, is the record's own word.
        fresh = shown_of(derive(open_recording(path)))
        other = [name for name in other if fresh.get(name) != shown.get(name)]
    if other:
        return SignatureCheck(
            Signed.ALTERED, sentence("the list shows another {key} than was signed", key=other[0])
        )
    return check


def judge_whole(path: Path, key: StationKey | None) -> SignatureCheck:
    """Say what the signature of a record says, reading the whole record.

    Raises:
        BrokenRecordingError: if it is none.
    """
    found, check = _read(path, key)
    if check.verdict not in (Signed.VERIFIED, Signed.REVOKED):
        return check
    if found["record"] == file_digest(path):
        return check
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
    return replace(summary, signature=judgement.word)


def _read(path: Path, key: StationKey | None) -> tuple[dict[str, Any], SignatureCheck]:
    """Return the signed document with what it is worth; empty where it is worth nothing."""
    try:
        document: dict[str, Any] = json.loads(read_at_most(signature_file(path)).decode("ascii"))
        seal = str(document.pop("hmac"))
        station, fields = str(document["station"]), (document["record"], document["shown"].items())
    except FileNotFoundError:
        return {}, SignatureCheck(Signed.UNSIGNED, sentence("no signature stands beside it"))
    except OSError as error:
        why = sentence("its signature cannot be read: {reason}", reason=error.strerror)
        return {}, SignatureCheck(Signed.UNSIGNED, why)
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return {}, SignatureCheck(Signed.ALTERED, sentence("its signature is damaged"))
    if key is None or station != key.station:
        check = _by_another(document, station, key)
        holds = check.verdict is not Signed.UNSIGNED
    else:
        check, holds = SignatureCheck(Signed.VERIFIED), False
        with suppress(ValueError, TypeError, RecursionError):
            holds = bool(fields) and key.has_sealed(document, seal)
        if not holds:
            check = SignatureCheck(Signed.ALTERED, sentence("its signature is not this station's"))
    if holds and document.get("id") != path.stem:
        check = SignatureCheck(
            Signed.ALTERED, sentence("the signature beside it is that of another attempt")
        )
    return (document if check.verdict in (Signed.VERIFIED, Signed.REVOKED) else {}), check


def _by_another(
    document: Mapping[str, Any], station: str, key: StationKey | None
) -> SignatureCheck:
    """Say what the signature of another station is worth: of a known one, what its key tells."""
    public, signature = (str(document.get(name, "")) for name in _BEYOND)
    one = known_stations().get(public) if key is not None else None
    if one is None or one.station != station:
        why = sentence("signed by another station ({station})", station=station[:16])
        return SignatureCheck(Signed.UNSIGNED, why)
    bare = {name: value for name, value in document.items() if name not in _BEYOND}
    if not signature_holds(public, RECORD, bare, signature):
        why = sentence("its signature is not that of the station {name}", name=one.name)
        return SignatureCheck(Signed.ALTERED, why)
    if one.revoked:
        why = sentence("the instructor has revoked the station that signed it")
        return SignatureCheck(Signed.REVOKED, why, one.name)
    return SignatureCheck(Signed.VERIFIED, "", one.name)


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
        "shown": shown_of(summary),
    }


def shown_of(summary: Summary) -> dict[str, Any]:
    """Return what a signature says of what lists show of an attempt."""
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
