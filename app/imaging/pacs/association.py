"""Connections to a PACS: opened for one request, watched for a cancel, always closed.

Encrypted ones are checked before they are used (`encryption`). The other end of C-MOVE is here too:
a storage service that stands only while a retrieval lasts.
"""

import logging
import socket
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from app.core.errors import ConfigurationError
from app.core.extras import not_installed
from app.core.messages import sentence
from app.core.progress import Cancelled, Progress
from app.imaging.pacs.encryption import client_context, server_context, shake_hands
from app.imaging.pacs.errors import (
    PacsDataError,
    PacsError,
    PacsRefusedError,
    PacsUnreachableError,
)
from app.imaging.pacs.incoming import COMPRESSED, PLAIN, STORAGE_CLASSES, Incoming, handler
from app.imaging.pacs.limits import RequestLimits, spool_to_own_folder
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.statuses import rejected, words


@contextmanager
def receiving(
    settings: PacsSettings, incoming: Incoming, counter: Any, limits: RequestLimits
) -> Iterator[None]:
    """Listen on our own port for what the PACS sends; only it may, and only to our title.

    Args:
        settings: of the PACS.
        incoming: takes the pictures.
        counter: told of each.
        limits: of the request.

    Raises:
        PacsError: if the port cannot be used.
        ConfigurationError: if the encryption cannot.
    """
    pynetdicom = network()
    made = entity(settings)
    made.require_called_aet = True
    made.require_calling_aet = [settings.title]
    for kind in STORAGE_CLASSES:
        made.add_supported_context(kind, [*PLAIN, *COMPRESSED])
    address, context = own_address(settings), server_context(settings, limits)
    handlers = [
        (pynetdicom.evt.EVT_CONN_OPEN, limits.accept),
        (pynetdicom.evt.EVT_C_STORE, handler(incoming, counter, limits)),
    ]
    try:
        made.start_server(
            (address, settings.own_port), block=False, evt_handlers=handlers, ssl_context=context
        )
    except OSError as error:
        raise PacsError(
            sentence(
                "port {settings_own_port} on {address} cannot be used to receive pictures: "
                "{error_strerror}; name another as own_port, or retrieve with C-GET",
                settings_own_port=settings.own_port,
                address=address,
                error_strerror=error.strerror or error,
            )
        ) from error
    try:
        yield
    finally:
        limits.end()
        made.shutdown()  # whoever is still connected is let go


_LOOK_S = 0.2


def network() -> Any:
    """Return pynetdicom, kept quiet: its log would print patients' data.

    Raises:
        ConfigurationError: if it is not installed; names the extra.
    """
    try:
        import pynetdicom
    except ImportError as error:
        what = "pynetdicom, which talks to a PACS,"
        raise not_installed(ConfigurationError, what, "pacs") from error
    from pynetdicom import _config, dimse_messages

    _config.STORE_RECV_CHUNKED_DATASET = True  # pictures to the disk, not to memory
    spool_to_own_folder(dimse_messages)
    _config.LOG_HANDLER_LEVEL = "none"
    _config.LOG_REQUEST_IDENTIFIERS = _config.LOG_RESPONSE_IDENTIFIERS = False
    log = logging.getLogger("pynetdicom")
    log.setLevel(logging.CRITICAL + 1)
    log.propagate = False
    return pynetdicom


def entity(settings: PacsSettings) -> Any:
    """Return the application entity of this program with the timeouts of a PACS."""
    made = network().AE(ae_title=settings.own_title)
    made.acse_timeout = made.dimse_timeout = settings.timeout_s
    made.network_timeout = made.connection_timeout = settings.timeout_s
    return made


@contextmanager
def association(
    settings: PacsSettings,
    contexts: Sequence[tuple[str, Sequence[str]]],
    progress: Progress,
    roles: Sequence[Any] = (),
    handlers: Sequence[Any] = (),
    limits: RequestLimits | None = None,
) -> Iterator[Any]:
    """Open an association; released afterwards, or aborted after an error or a cancel.

    Args:
        settings: of the PACS.
        contexts: abstract syntaxes and the transfer syntaxes proposed for each.
        progress: looked at five times a second; a cancel aborts at once.
        roles: role selections, for C-GET.
        handlers: pynetdicom's event handlers.
        limits: of the request; of this connection alone if left out.

    Raises:
        PacsUnreachableError: no connection, or it was lost.
        PacsDataError: it sent too much, or too slowly.
        PacsRefusedError: it does not accept this program.
        ConfigurationError: a file of the encryption cannot be used.
        Cancelled: if `progress` was cancelled.
    """
    limits = limits or RequestLimits(settings, progress)
    made = entity(settings)
    for abstract, transfer in contexts:
        made.add_requested_context(abstract, list(transfer) or None)
    progress.report(0.0, sentence("connecting to {name}", name=settings.name))
    _connect(settings)
    opened = (network().evt.EVT_CONN_OPEN, lambda event: own.append(event.assoc.dul.socket.socket))
    own: list[socket.socket] = []
    context = client_context(settings)
    linked = made.associate(
        settings.host,
        settings.port,
        ae_title=settings.title,
        ext_neg=list(roles),
        evt_handlers=[*handlers, opened, (network().evt.EVT_CONN_OPEN, limits.bind)],
        tls_args=None if context is None else (context, settings.host),
    )
    with _closed(own), _watched(linked, progress, limits) as cancelled:
        if not linked.is_established:
            raise _too_much(settings, limits) or _refused(settings, linked)
        try:
            yield linked
            if cancelled.is_set():
                raise Cancelled("cancelled")
        except Exception as error:
            if linked.is_established:
                linked.abort()
            if cancelled.is_set():
                raise Cancelled("cancelled") from None
            raise _too_much(settings, limits) or error from None
        if linked.is_established:
            linked.release()


@contextmanager
def _closed(sockets: list[socket.socket]) -> Iterator[None]:
    """Close sockets afterwards: pynetdicom forgets to where the other end has gone."""
    try:
        yield
    finally:
        for one in sockets:
            one.close()


def _too_much(settings: PacsSettings, limits: RequestLimits) -> PacsDataError | None:
    if not limits.problem:
        return None
    return PacsDataError(
        sentence(
            "{settings_name}: {limits_problem}; nothing was taken into the library",
            settings_name=settings.name,
            limits_problem=limits.problem,
        )
    )


@contextmanager
def _watched(linked: Any, progress: Progress, limits: RequestLimits) -> Iterator[threading.Event]:
    """Abort the association as soon as the user cancels or it is too much, even in silence."""
    over, cancelled = threading.Event(), threading.Event()

    def watch() -> None:
        while not over.wait(_LOOK_S):
            if limits.over():
                try:
                    progress.check()
                except Cancelled:
                    cancelled.set()
                linked.abort()
                linked.dimse.msg_queue.put((None, None))  # wakes whoever waits for an answer
                return

    thread = threading.Thread(target=watch, name="acus pacs watch", daemon=True)
    thread.start()
    try:
        yield cancelled
    finally:
        over.set()
        thread.join()


def require(linked: Any, status: Any, settings: PacsSettings, doing: str) -> int:
    """Return the status code of an answer.

    Raises:
        PacsUnreachableError: if none came.
        PacsError: if it says a failure.
    """
    if "Status" not in status:
        raise lost(settings, doing)
    code = int(status.Status)
    if code >> 12 in (0xA, 0xC) or code >> 8 in (0x01, 0x02):
        raise PacsError(
            sentence(
                "{settings_name} refused while {doing}: {refusal}",
                settings_name=settings.name,
                doing=doing,
                refusal=words(code),
            )
        )
    return code


def lost(settings: PacsSettings, doing: str) -> PacsUnreachableError:
    """Return the error for a connection that ended, or an answer that did not come."""
    return PacsUnreachableError(
        sentence(
            "{settings_name} gave no answer while {doing}: the connection was lost, or it was "
            "silent for {settings_timeout_s:g} s; nothing was taken into the library",
            settings_name=settings.name,
            doing=doing,
            settings_timeout_s=settings.timeout_s,
        )
    )


def _refused(settings: PacsSettings, linked: Any) -> PacsError:
    where = f"{settings.name} ({settings.host} port {settings.port})"
    if linked.is_rejected:
        why = rejected(linked.acceptor.primitive)
        return PacsRefusedError(
            sentence(
                "{where} rejects the connection of {settings_own_title} to {settings_title}: "
                "{reason}",
                where=where,
                settings_own_title=settings.own_title,
                settings_title=settings.title,
                reason=why,
            )
        )
    if linked.acceptor.primitive is not None:
        return PacsRefusedError(
            sentence("{where} supports nothing of what is needed for this request", where=where)
        )
    tls = settings.tls
    wish = (
        sentence("; perhaps it wants a certificate of our own (tls: certificate, key)")
        if tls is not None and not tls.certificate
        else sentence("; perhaps that port wants TLS")
        if tls is None
        else ""
    )
    return PacsUnreachableError(
        sentence(
            "{where} cannot be reached: something listens there, but it does not answer as a "
            "DICOM service{wish}",
            where=where,
            wish=wish,
        )
    )


def _connect(settings: PacsSettings) -> None:
    """Try the bare connection first: the operating system says why it fails, the library does not.

    Raises:
        PacsUnreachableError: saying why.
    """
    where = f"{settings.name} ({settings.host} port {settings.port}) cannot be reached"
    try:
        with socket.create_connection((settings.host, settings.port), settings.timeout_s) as tried:
            why = shake_hands(tried, settings)
    except socket.gaierror:
        why = "no computer of this name is known"
    except TimeoutError:
        why = f"no answer within {settings.timeout_s:g} s; a firewall, or the computer is off"
    except OSError as error:
        why = error.strerror or type(error).__name__
    if why:
        raise PacsUnreachableError(sentence("{where}: {reason}", where=where, reason=why))


def own_address(settings: PacsSettings) -> str:
    """Address on which C-MOVE's pictures are received: as configured, or towards the PACS.

    Raises:
        PacsUnreachableError: if no way leads there.
    """
    if settings.own_host:
        return settings.own_host
    try:
        family, kind, _, _, address = socket.getaddrinfo(
            settings.host, settings.port, type=socket.SOCK_DGRAM
        )[0]
        with socket.socket(family, kind) as probe:
            probe.connect(address)  # sends nothing: the system only looks which way it would go
            return str(probe.getsockname()[0])
    except OSError as error:
        raise PacsUnreachableError(
            sentence(
                "no way leads from this computer to {settings_host}: {error_strerror}",
                settings_host=settings.host,
                error_strerror=error.strerror or error,
            )
        ) from error
