"""One request to a learning record store at a time, answered as a whole within its seconds.

What a store writes is repeated in messages only where it says which statement it refuses and why,
shortened.
"""

from __future__ import annotations

import json
import math
import ssl
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from http.client import HTTPException
from typing import Any, Final
from urllib.parse import urlencode

from app.core.messages import sentence
from app.core.web import basic, exchange
from app.exchange.lrs.errors import LrsError, UnreachableLrsError
from app.exchange.lrs.place import LrsPlace

_LONGEST_WAIT: Final = 86400.0
_PASSING: Final = (408, 425, 429)


@dataclass(frozen=True, slots=True)
class Reply:
    """What a store said: a body that is no JSON is None.

    Attributes:
        status: of HTTP.
        document: that JSON gives.
        excerpt: the beginning of the body, printable, in one line.
    """

    status: int
    document: Any
    excerpt: str


class Lrs:
    """A store at a place.

    Args:
        place: address, user and password.
    """

    def __init__(self, place: LrsPlace) -> None:
        self.place = place.checked()

    def about(self) -> None:
        """Ask whether it is there, and lets this station read.

        Raises:
            LrsError: as `request`, but where it does not answer: nothing is kept then that could be
                sent later; if it refuses, or what answers is no store.
        """
        try:
            reply = self.request("GET", {"limit": "1"})
        except UnreachableLrsError as error:
            raise LrsError(
                sentence(
                    "{name} does not answer, or cannot now: it was not connected; look at the "
                    "address and at the network, and try again",
                    name=self.place.name,
                )
            ) from error
        if reply.status != 200 or not isinstance(reply.document, Mapping):
            raise self._no_store(reply)

    def post(self, statements: Sequence[Mapping[str, Any]]) -> Reply:
        """Hand over statements; status 200, 204 (Ralph: nothing new), 400, 409 or 413.

        Raises:
            LrsError: as `request`; for any other answer.
        """
        body = json.dumps(statements, ensure_ascii=False, allow_nan=False).encode()
        reply = self.request("POST", {}, body)
        if reply.status not in (200, 204, 400, 409, 413):
            raise self._no_store(reply)
        return reply

    def held(self, name: str) -> Mapping[str, Any] | None:
        """Return the statement that it holds by an id, voided or not; None where it has none.

        Some stores (Ralph 5) answer with a list of one, or of none.

        Raises:
            LrsError: as `request`; for any other answer.
        """
        for key in ("statementId", "voidedStatementId"):
            reply = self.request("GET", {key: name})
            if reply.status == 200 and isinstance(reply.document, Mapping):
                some = reply.document.get("statements", [reply.document])
                for one in some if isinstance(some, list) else ():
                    if isinstance(one, Mapping) and str(one.get("id", "")).lower() == name:
                        return one
            elif reply.status != 404:
                raise self._no_store(reply)
        return None

    def request(self, method: str, query: Mapping[str, str], body: bytes | None = None) -> Reply:
        """Send one request and read its answer whole.

        Raises:
            UnreachableLrsError: if there is none in time, not all of it, or "not now".
            LrsError: if name or password are refused, it sends elsewhere, or its certificate is not
                trusted.
        """
        try:
            where = f"{self.place.endpoint}/statements" + (f"?{urlencode(query)}" if query else "")
            answer = exchange(method, where, self._headers(), body, self.place.seconds)
        except ssl.SSLCertVerificationError as error:
            raise LrsError(
                sentence(
                    "{name} shows a certificate that is not trusted ({reason}): nothing was sent; "
                    "ask who runs it, or name its authority by SSL_CERT_FILE",
                    name=self.place.name,
                    reason=error.verify_message,
                )
            ) from error
        except (OSError, HTTPException) as error:
            raise UnreachableLrsError(
                sentence(
                    "{name} does not answer, or not to the end, within {seconds:g} s: nothing is "
                    "lost, it is sent later",
                    name=self.place.name,
                    seconds=self.place.seconds,
                )
            ) from error
        status = answer.status
        if status in (401, 403):
            raise LrsError(
                sentence(
                    "{name} does not let {user!r} in ({status}): give name and password again, "
                    "`acus results lrs URL`",
                    name=self.place.name,
                    user=self.place.user,
                    status=status,
                )
            )
        if 300 <= status < 400:
            raise LrsError(
                sentence(
                    "{name} sends on to {other}: it was not followed; if the record store is "
                    "there, give that address",
                    name=self.place.name,
                    other=answer.elsewhere,
                )
            )
        if status >= 500 or status in _PASSING:
            raise UnreachableLrsError(
                sentence(
                    "{name} cannot take statements now ({status}): nothing is lost, it is sent "
                    "later",
                    name=self.place.name,
                    status=status,
                ),
                _seconds(answer.headers.get("Retry-After", "")),
            )
        try:
            document = json.loads(answer.body)
        except (ValueError, RecursionError):
            document = None
        return Reply(status, document, answer.excerpt)

    def _headers(self) -> dict[str, str]:
        return {
            "X-Experience-API-Version": "1.0.3",
            "Content-Type": "application/json",
            "Accept": "application/json",
        } | basic(self.place.user, self.place.password)

    def _no_store(self, reply: Reply) -> LrsError:
        return LrsError(
            sentence(
                "what answers at {endpoint} is no record store ({status}): give the address that "
                "stands before /statements",
                endpoint=self.place.endpoint,
                status=reply.status,
            )
        )


def _seconds(text: str) -> float:
    """Return what `Retry-After` asks for; 0 for a date, which few send, and for nonsense."""
    try:
        found = float(text)
    except ValueError:
        return 0.0
    return min(found, _LONGEST_WAIT) if math.isfinite(found) and found > 0.0 else 0.0
