"""An archive that speaks DICOMweb (PS3.18): one request and its answer, with errors in words."""

from __future__ import annotations

import json
import socket
import ssl
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.client import HTTPException
from typing import BinaryIO
from urllib.parse import urlsplit

from app.core.messages import sentence
from app.core.web import WebAnswer, basic, download, exchange, fault_of_address
from app.imaging.pacs.errors import PacsRefusedError, PacsUnreachableError


@dataclass(frozen=True, slots=True)
class WebArchive:
    """An archive that speaks DICOMweb.

    Attributes:
        url: of the service, before `/studies`.
        user: name that it knows us by; empty where it asks for none.
        password: that goes with it; in no message.
        seconds: that an answer may take.
        context: of the encryption; the system's where None.
        known_as: what messages call it; host and port where empty.
    """

    url: str
    user: str = ""
    password: str = field(default="", repr=False)
    seconds: float = 60.0
    context: ssl.SSLContext | None = field(default=None, repr=False)
    known_as: str = ""

    @property
    def name(self) -> str:
        """Return what messages call it."""
        return self.known_as or urlsplit(self.url).netloc

    def address(self, *parts: str) -> str:
        """Return the address of a resource below `/studies`."""
        return "/".join((self.url.rstrip("/").removesuffix("/studies"), "studies", *parts))

    def ask(
        self,
        method: str,
        address: str,
        headers: Mapping[str, str],
        body: bytes | None = None,
        over: Callable[[], bool] | None = None,
    ) -> WebAnswer:
        """Send a request and return its answer, of any status but those of a closed door.

        Raises:
            PacsRefusedError: if it lets us not in, sends elsewhere, its certificate is not
                trusted, or the address shows what is sent to a network.
            PacsUnreachableError: if it does not answer, or not to the end.
        """
        sent = dict(headers) | basic(self.user, self.password)
        with self._reached():
            answer = exchange(method, address, sent, body, self.seconds, over, self.context)
        return self._let_in(answer)

    def fetch(
        self,
        address: str,
        headers: Mapping[str, str],
        file: BinaryIO,
        over: Callable[[], bool],
        count: Callable[[int], None],
    ) -> WebAnswer:
        """Write what is large to a file; see `core.web.download`, and `ask` for the errors."""
        sent = dict(headers) | basic(self.user, self.password)
        with self._reached():
            answer = download(address, sent, file, self.seconds, over, count, self.context)
        return self._let_in(answer)

    @contextmanager
    def _reached(self) -> Iterator[None]:
        if fault := fault_of_address(self.url):
            raise PacsRefusedError(sentence("archive: {fault}", fault=fault))
        try:
            yield
        except ssl.SSLCertVerificationError as error:
            raise PacsRefusedError(
                sentence(
                    "{name} shows a certificate that is not trusted ({reason}): nothing was sent; "
                    "ask who runs it, or name its authority by SSL_CERT_FILE",
                    name=self.name,
                    reason=error.verify_message,
                )
            ) from error
        except (socket.gaierror, ConnectionRefusedError) as error:
            host = urlsplit(self.url).netloc
            raise PacsUnreachableError(
                sentence(
                    "{name} cannot be reached: no computer {host} is known",
                    name=self.name,
                    host=host,
                )
                if isinstance(error, socket.gaierror)
                else sentence(
                    "{name} cannot be reached: nothing listens at {host}", name=self.name, host=host
                )
            ) from error
        except (OSError, HTTPException) as error:
            raise PacsUnreachableError(
                sentence(
                    "{name} does not answer, or not to the end, within {seconds:g} s: try again, "
                    "what has been taken is kept once",
                    name=self.name,
                    seconds=self.seconds,
                )
            ) from error

    def _let_in(self, answer: WebAnswer) -> WebAnswer:
        if answer.status in (401, 403):
            raise PacsRefusedError(
                sentence(
                    "{name} does not let {user!r} in ({status}): give name and password again",
                    name=self.name,
                    user=self.user,
                    status=answer.status,
                )
            )
        if 300 <= answer.status < 400:
            raise PacsRefusedError(
                sentence(
                    "{name} sends on to {other}: it was not followed; if the archive is there, "
                    "give that address",
                    name=self.name,
                    other=answer.elsewhere,
                )
            )
        return answer


def document_of(answer: WebAnswer) -> object:
    """Return the JSON of an answer; None where it is none."""
    try:
        return json.loads(answer.body)
    except (ValueError, RecursionError):
        return None
