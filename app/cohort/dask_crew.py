"""Workers of Dask distributed (extra `cohort`), on this computer or wherever a scheduler has them.

Dask sends functions and values as pickles, which run whatever they hold: who reaches the port of a
scheduler or worker runs programs there. So it is used on the loopback of this computer, or by TLS
with certificates on both sides; anything else is refused.
"""

from __future__ import annotations

import ipaddress
import logging
import socket
import time
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import islice
from typing import Any, Final, Self
from urllib.parse import urlsplit

from app.cohort.errors import CohortError
from app.cohort.running import Do, Made, call
from app.cohort.table import EXTRA
from app.cohort.versions import differences, versions
from app.core.errors import AcusError
from app.core.extras import not_installed
from app.core.messages import sentence
from app.core.progress import Progress

ANSWER_S: Final = 10.0
"""A scheduler answers in this time, and has a worker [s]."""

LOOK_S: Final = 0.2
"""So often is looked for cancelling and for what is done [s]."""

AHEAD: Final = 256
"""Parts that are handed out at a time; the scheduler need not hold a million."""

DESERTED_S: Final = 60.0
"""Without any worker the work is given up after this [s]."""

_KEPT: Final = sentence("what is done is kept: the same command goes on from there")


def distributed() -> Any:
    """Return Dask distributed.

    Raises:
        CohortError: if it is not installed; names the extra, and what goes without.
    """
    try:
        import distributed
    except ImportError as error:
        raise not_installed(
            CohortError, "distributed", EXTRA, sentence("use --local 1, which needs none")
        ) from error
    return distributed


def check_address(address: str) -> None:
    """Refuse an address by which pickles would go through a network in the open.

    Raises:
        CohortError: for that, or what is no address; says what would do.
    """
    parts = urlsplit(address if "://" in address else f"tcp://{address}")
    try:
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if not host or port is None or parts.scheme not in ("tcp", "tls"):
        raise CohortError(
            sentence(
                "{address!r} is no address of a scheduler: write tcp://127.0.0.1:8786, or "
                "tls://HOST:8786",
                address=address,
            )
        )
    if parts.scheme == "tcp" and not _is_loopback(host):
        raise CohortError(
            sentence(
                "{address} is not on this computer and not by TLS: Dask runs what it is sent, "
                "whoever sends it; use tls:// with certificates (docs/cohort.md)",
                address=address,
            )
        )


def _is_loopback(host: str) -> bool:
    try:
        found = {entry[4][0] for entry in socket.getaddrinfo(host, None)}
    except OSError:
        return False
    return bool(found) and all(ipaddress.ip_address(str(one)).is_loopback for one in found)


class DaskCrew(ABC):
    """What both have: a client, and how parts are handed out and come back.

    Attributes:
        workers: processes that work; 0 before they were asked for.
    """

    def __init__(self, name: str) -> None:
        self.workers = 0
        self._client: Any = None
        self._name = name

    @abstractmethod
    def _open(self) -> None:
        """Connect; sets the client."""

    def __enter__(self) -> Self:
        """Connect, and look whether everybody has this Acus.

        Raises:
            CohortError: if nobody answers or works, or somebody has another one.
        """
        distributed()
        try:
            _silence()
            self._open()
            self._look()
        except BaseException:
            self._close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        """Let everybody go."""
        self._close()

    def _look(self) -> None:
        """Ask every worker what it is, before it is given work."""
        known = self._client.scheduler_info(n_workers=-1)
        addresses = [known["address"], *known["workers"]]
        for address in addresses:
            check_address(address)
        if not known["workers"]:
            raise CohortError(
                sentence(
                    "the scheduler at {address} has no worker: start some (docs/cohort.md)",
                    address=self._name,
                )
            )
        answers = self._client.run(versions, on_error="return")
        for address, answer in answers.items():
            if isinstance(answer, BaseException):
                raise CohortError(
                    sentence(
                        "worker {address} has no Acus of this kind ({reason}): install the same "
                        "there as here",
                        address=address,
                        reason=words_of(answer),
                    )
                ) from answer
            if other := differences(answer):
                raise CohortError(
                    sentence(
                        "worker {address} has another Acus: {differences}; install the same there "
                        "as here",
                        address=address,
                        differences=", ".join(other),
                    )
                )
        self.workers = sum(one["nthreads"] for one in known["workers"].values())

    def results(
        self, todo: Sequence[tuple[Do, dict[str, Any]]], progress: Progress
    ) -> Iterator[tuple[int, Made]]:
        """Hand the parts out; yield each as it comes back.

        A worker that ends takes nothing with it: its parts are given to another one.
        """
        coming = distributed().as_completed(loop=self._client.loop)
        expected, looked = dict(versions()), time.monotonic()
        futures: dict[Any, int] = {}
        rest = enumerate(todo)
        try:
            while True:
                for place, (do, given) in islice(rest, AHEAD - len(futures)):
                    future = self._client.submit(call, do, given, expected, pure=False)
                    futures[future] = place
                    coming.add(future)
                if not futures:
                    return
                progress.check()
                batch = coming.next_batch(block=False)
                for future in batch:
                    yield futures.pop(future), self._made(future)
                if batch or self._has_workers():
                    looked = time.monotonic()
                elif time.monotonic() - looked > DESERTED_S:
                    raise self._deserted()
                if not batch:
                    time.sleep(LOOK_S)
        except BaseException:
            with suppress(Exception):
                self._client.cancel(list(futures), force=True)
            raise

    def _deserted(self) -> CohortError:
        return CohortError(
            sentence(
                "the scheduler at {address} has had no worker for {seconds:g} s: {kept}",
                address=self._name,
                seconds=DESERTED_S,
                kept=_KEPT,
            )
        )

    def _has_workers(self) -> bool:
        """Return whether anybody works; refuses to wait for a scheduler that has gone."""
        try:
            return bool(self._client.status == "running" and self._client.nthreads())
        except (OSError, RuntimeError, TimeoutError) as error:
            raise self._gone() from error

    def _made(self, future: Any) -> Made:
        from distributed.scheduler import KilledWorker

        if future.status == "cancelled":  # as all are when the scheduler has gone
            raise self._gone()
        try:
            made: Made = future.result()
        except KilledWorker as error:
            raise CohortError(
                sentence(
                    "several workers ended over the same part (out of memory?): {kept}", kept=_KEPT
                )
            ) from error
        except AcusError:
            raise
        except OSError as error:
            raise self._gone() from error
        return made

    def _gone(self) -> CohortError:
        return CohortError(
            sentence("the scheduler at {address} is gone: {kept}", address=self._name, kept=_KEPT)
        )

    def _close(self) -> None:
        if self._client is not None:
            with suppress(Exception):
                self._client.close(timeout=5.0)
            self._client = None


class LocalCrew(DaskCrew):
    """Processes of this computer, which end with this one.

    They and their scheduler speak by TLS with certificates made for this run: nobody else who works
    at this computer can send them anything.

    Args:
        number: of the processes.
    """

    def __init__(self, number: int) -> None:
        super().__init__(sentence("this computer"))
        self._number = number
        self._cluster: Any = None

    def _open(self) -> None:
        dask = distributed()
        self._cluster = dask.LocalCluster(
            n_workers=self._number,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            security=True,
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL,
        )
        self._client = dask.Client(self._cluster, set_as_default=False)

    def _close(self) -> None:
        super()._close()
        if self._cluster is not None:
            with suppress(Exception):
                self._cluster.close(timeout=10.0)
            self._cluster = None


class RemoteCrew(DaskCrew):
    """The workers of a scheduler; its certificates come from Dask's own configuration.

    Args:
        address: of the scheduler.
    """

    def __init__(self, address: str) -> None:
        super().__init__(address)
        self._address = address if "://" in address else f"tcp://{address}"

    def _open(self) -> None:
        dask = distributed()
        security = _certificates(dask) if self._address.startswith("tls://") else None
        parts = urlsplit(self._address)
        try:
            # Refused at once; Dask would try until its time is over.
            socket.create_connection((parts.hostname or "", parts.port or 0), ANSWER_S).close()
            self._client = dask.Client(
                self._address, timeout=ANSWER_S, security=security, set_as_default=False
            )
        except (OSError, TimeoutError, TypeError, ValueError, RuntimeError) as error:
            raise CohortError(
                sentence(
                    "no scheduler answers at {address} ({reason}): start one, or use --local",
                    address=self._name,
                    reason=words_of(error),
                )
            ) from error


def _certificates(dask: Any) -> Any:
    """Return how this computer shows itself by TLS, as Dask's configuration says.

    Raises:
        CohortError: if it names no certificates, or they cannot be read.
    """
    security = dask.Security(require_encryption=True)
    try:
        there = security.get_connection_args("client").get("ssl_context") is not None
    except (OSError, ValueError) as error:
        raise CohortError(
            sentence(
                "the certificates of Dask's configuration cannot be used ({reason}): see "
                "docs/cohort.md",
                reason=words_of(error),
            )
        ) from error
    if not there:
        raise CohortError(
            sentence(
                "Dask's configuration names no certificates for tls://: set "
                "DASK_DISTRIBUTED__COMM__TLS__CA_FILE and the client's (docs/cohort.md)"
            )
        )
    return security


def _silence() -> None:
    """Let Dask print nothing: what went wrong is said in one line."""
    for name in list(logging.root.manager.loggerDict):
        if name.partition(".")[0] == "distributed":  # each has a level of its own
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def words_of(error: BaseException) -> str:
    """Return the first line of what an error says, with the name of its kind."""
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}"[:200].rstrip(": ")
