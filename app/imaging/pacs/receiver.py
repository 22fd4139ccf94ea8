"""The other end of C-MOVE: a storage service that stands only while a retrieval lasts."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from app.imaging.pacs.association import entity, network, own_address
from app.imaging.pacs.errors import PacsError
from app.imaging.pacs.incoming import COMPRESSED, PLAIN, STORAGE_CLASSES, Incoming, handler
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.tls import server_context


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
