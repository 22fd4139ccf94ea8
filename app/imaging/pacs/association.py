"""Connections to a PACS: opened for one request, watched for a cancel, always closed.

Encrypted ones (DICOM PS3.15 annex B: TLS) are checked before they are used. The other end of C-MOVE
is here too: a storage service that stands only while a retrieval lasts.
"""

import logging
import socket
import ssl
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from app.core.errors import ConfigurationError
from app.core.extras import not_installed
from app.core.progress import Cancelled, Progress
from app.imaging.pacs.errors import PacsError, PacsRefusedError, PacsUnreachableError
from app.imaging.pacs.incoming import COMPRESSED, PLAIN, STORAGE_CLASSES, Incoming, handler
from app.imaging.pacs.settings import PacsSettings, TlsSettings
from app.imaging.pacs.statuses import rejected, words


def client_context(settings: PacsSettings) -> ssl.SSLContext | None:
    """Context of the connections that we open; None where they are not encrypted.

    Raises:
        ConfigurationError: naming the file that cannot be used.
    """
    tls = settings.tls
    if tls is None:
        return None
    context = ssl.create_default_context(ssl.Purpose.SERVER_AUTH)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    context.check_hostname = tls.check_name
    _trust(context, tls)
    if tls.certificate:
        _own(context, tls)
    return context


def server_context(settings: PacsSettings) -> ssl.SSLContext | None:
    """Context of the connections that C-MOVE makes the PACS open to us.

    Who connects must show a certificate that the same authority has signed.

    Raises:
        ConfigurationError: if we have no certificate of our own; or naming the file.
    """
    tls = settings.tls
    if tls is None:
        return None
    if not tls.certificate:
        raise ConfigurationError(
            f"{settings.name}: C-MOVE with TLS needs a certificate of our own "
            "(tls: certificate, key); or retrieve with C-GET"
        )
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    context.verify_mode = ssl.CERT_REQUIRED
    _trust(context, tls)
    _own(context, tls)
    return context


def shake_hands(connection: socket.socket, settings: PacsSettings) -> str:
    """Try the encryption on an open connection; return why it fails, empty where it does not.

    The network library would only say that there is no association.
    """
    context = client_context(settings)
    if context is None:
        return ""
    try:
        with context.wrap_socket(connection, server_hostname=settings.host):
            return ""
    except ssl.SSLCertVerificationError as error:
        return f"its certificate is not trusted: {error.verify_message}"
    except ssl.SSLError as error:
        why = (error.reason or "").replace("_", " ").lower()
        return f"no encrypted connection comes about ({why or 'TLS error'}); is that its TLS port?"
    except TimeoutError:
        return "it does not answer to TLS; is that its TLS port?"
    except OSError:
        return "it closes the connection when TLS begins; is that its TLS port?"


def _trust(context: ssl.SSLContext, tls: TlsSettings) -> None:
    if not tls.authority:
        context.load_default_certs()
        return
    _readable(tls.authority, "authority")
    try:
        context.load_verify_locations(cafile=tls.authority)
    except (ssl.SSLError, OSError):
        raise _unusable(tls.authority, "authority", "it holds no certificate in PEM") from None


def _own(context: ssl.SSLContext, tls: TlsSettings) -> None:
    _readable(tls.certificate, "certificate")
    if tls.key:
        _readable(tls.key, "key")
    try:
        # An empty password: OpenSSL would ask for one on the terminal and wait.
        context.load_cert_chain(tls.certificate, tls.key or None, password="")
    except ssl.SSLError as error:
        file, name = (tls.key, "key") if tls.key else (tls.certificate, "certificate")
        if error.reason == "KEY_VALUES_MISMATCH":
            why = f"it does not belong to the certificate {tls.certificate}"
        else:
            why = "certificate and key must be PEM, the key without a password"
        raise _unusable(file, name, why) from None


def _readable(file: str, name: str) -> None:
    try:
        with Path(file).open("rb"):
            pass
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or "no such file"
        raise _unusable(file, name, f"it cannot be read: {why}") from None


def _unusable(file: str, name: str, why: str) -> ConfigurationError:
    return ConfigurationError(f"tls {name} {file}: {why}")


@contextmanager
def receiving(settings: PacsSettings, incoming: Incoming, counter: Any) -> Iterator[None]:
    """Listen on our own port for what the PACS sends; only it may, and only to our title.

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
    address, context = own_address(settings), server_context(settings)
    handlers = [(pynetdicom.evt.EVT_C_STORE, handler(incoming, counter))]
    try:
        server = made.start_server(
            (address, settings.own_port), block=False, evt_handlers=handlers, ssl_context=context
        )
    except OSError as error:
        raise PacsError(
            f"port {settings.own_port} on {address} cannot be used to receive pictures: "
            f"{error.strerror or error}; name another as own_port, or retrieve with C-GET"
        ) from error
    try:
        yield
    finally:
        server.shutdown()


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
    from pynetdicom import _config

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
) -> Iterator[Any]:
    """Open an association; released afterwards, or aborted after an error or a cancel.

    Args:
        settings: of the PACS.
        contexts: abstract syntaxes and the transfer syntaxes proposed for each.
        progress: looked at five times a second; a cancel aborts at once.
        roles: role selections, for C-GET.
        handlers: pynetdicom's event handlers.

    Raises:
        PacsUnreachableError: no connection, or it was lost.
        PacsRefusedError: it does not accept this program.
        ConfigurationError: a file of the encryption cannot be used.
        Cancelled: if `progress` was cancelled.
    """
    made = entity(settings)
    for abstract, transfer in contexts:
        made.add_requested_context(abstract, list(transfer) or None)
    progress.report(0.0, f"connecting to {settings.name}")
    _connect(settings)
    opened = (network().evt.EVT_CONN_OPEN, lambda event: own.append(event.assoc.dul.socket.socket))
    own: list[socket.socket] = []
    context = client_context(settings)
    linked = made.associate(
        settings.host,
        settings.port,
        ae_title=settings.title,
        ext_neg=list(roles),
        evt_handlers=[*handlers, opened],
        tls_args=None if context is None else (context, settings.host),
    )
    with _closed(own), _watched(linked, progress) as cancelled:
        if not linked.is_established:
            raise _refused(settings, linked)
        try:
            yield linked
            if cancelled.is_set():
                raise Cancelled("cancelled")
        except Exception:
            if linked.is_established:
                linked.abort()
            if cancelled.is_set():
                raise Cancelled("cancelled") from None
            raise
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


@contextmanager
def _watched(linked: Any, progress: Progress) -> Iterator[threading.Event]:
    """Abort the association as soon as the user cancels, even while the PACS is silent."""
    over, cancelled = threading.Event(), threading.Event()

    def watch() -> None:
        while not over.wait(_LOOK_S):
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
        raise PacsError(f"{settings.name} refused while {doing}: {words(code)}")
    return code


def lost(settings: PacsSettings, doing: str) -> PacsUnreachableError:
    """Return the error for a connection that ended, or an answer that did not come."""
    return PacsUnreachableError(
        f"{settings.name} gave no answer while {doing}: the connection was lost, or it was silent "
        f"for {settings.timeout_s:g} s; nothing was taken into the library"
    )


def _refused(settings: PacsSettings, linked: Any) -> PacsError:
    where = f"{settings.name} ({settings.host} port {settings.port})"
    if linked.is_rejected:
        why = rejected(linked.acceptor.primitive)
        return PacsRefusedError(
            f"{where} rejects the connection of {settings.own_title} to {settings.title}: {why}"
        )
    if linked.acceptor.primitive is not None:
        return PacsRefusedError(f"{where} supports nothing of what is needed for this request")
    tls = settings.tls
    wish = (
        "; perhaps it wants a certificate of our own (tls: certificate, key)"
        if tls is not None and not tls.certificate
        else "; perhaps that port wants TLS"
        if tls is None
        else ""
    )
    return PacsUnreachableError(
        f"{where} cannot be reached: something listens there, but it does not answer as a DICOM "
        f"service{wish}"
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
        raise PacsUnreachableError(f"{where}: {why}")


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
            f"no way leads from this computer to {settings.host}: {error.strerror or error}"
        ) from error
