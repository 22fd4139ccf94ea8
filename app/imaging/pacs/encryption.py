"""Encryption of the connections to a PACS and from it (DICOM PS3.15 annex B: TLS)."""

import socket
import ssl
from pathlib import Path
from typing import Any

from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.imaging.pacs.limits import RequestLimits, may_send
from app.imaging.pacs.settings import PacsSettings, TlsSettings

_HANDSHAKE_S = 10.0


class ListeningContext(ssl.SSLContext):
    """Encryption of connections that others open to us: strangers are not greeted, nor waited for.

    The library greets whoever connects, one after the other, for as long as it takes.
    """

    limits: RequestLimits
    settings: PacsSettings

    def wrap_socket(self, sock: socket.socket, *args: Any, **given: Any) -> ssl.SSLSocket:
        """Shake hands within a few seconds, with those who may send pictures."""
        try:
            address = str(sock.getpeername()[0])
            if not may_send(self.settings, address):
                self.limits.strangers[address] = None
                raise OSError("nobody whom we know")
            sock.settimeout(_HANDSHAKE_S)
            wrapped = super().wrap_socket(sock, *args, **given)
            wrapped.settimeout(None)
            return wrapped
        except BaseException:
            sock.close()
            raise


def client_context(settings: PacsSettings) -> ssl.SSLContext | None:
    """Return the context of the connections that we open; None where they are not encrypted.

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


def server_context(settings: PacsSettings, limits: RequestLimits) -> ListeningContext | None:
    """Return the context of the connections that C-MOVE makes the PACS open to us.

    Who connects must show a certificate that the same authority has signed.

    Raises:
        ConfigurationError: if we have no certificate of our own; or naming the file.
    """
    tls = settings.tls
    if tls is None:
        return None
    if not tls.certificate:
        raise ConfigurationError(
            sentence(
                "{settings_name}: C-MOVE with TLS needs a certificate of our own "
                "(tls: certificate, key); or retrieve with C-GET",
                settings_name=settings.name,
            )
        )
    context = ListeningContext(ssl.PROTOCOL_TLS_SERVER)
    context.limits, context.settings = limits, settings
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
        return sentence(
            "its certificate is not trusted: {error_verify_message}",
            error_verify_message=error.verify_message,
        )
    except ssl.SSLError as error:
        why = (error.reason or "").replace("_", " ").lower()
        return sentence(
            "no encrypted connection comes about ({reason}); is that its TLS port?",
            reason=why or "TLS error",
        )
    except TimeoutError:
        return sentence("it does not answer to TLS; is that its TLS port?")
    except OSError:
        return sentence("it closes the connection when TLS begins; is that its TLS port?")


def _trust(context: ssl.SSLContext, tls: TlsSettings) -> None:
    if not tls.authority:
        context.load_default_certs()
        return
    _readable(tls.authority, "authority")
    try:
        context.load_verify_locations(cafile=tls.authority)
    except (ssl.SSLError, OSError):
        raise _unusable(
            tls.authority, "authority", sentence("it holds no certificate in PEM")
        ) from None


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
        raise _unusable(file, name, sentence("it cannot be read: {reason}", reason=why)) from None


def _unusable(file: str, name: str, reason: str) -> ConfigurationError:
    return ConfigurationError(
        sentence("tls {name} {file}: {reason}", name=name, file=file, reason=reason)
    )
