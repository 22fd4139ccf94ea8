"""From the PACS into the library: retrieved, de-identified, and the originals deleted."""

from app.core.progress import Progress
from app.imaging.errors import SeriesRefusedError
from app.imaging.library import CtLibrary, Imported
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.errors import PacsDataError
from app.imaging.pacs.incoming import Incoming
from app.imaging.privacy.errors import PrivacyError
from app.imaging.scanning import scan_folder


def take(
    pacs: Pacs, study_uid: str, series_uid: str, library: CtLibrary, progress: Progress
) -> Imported:
    """Retrieve a series into the library, de-identified.

    After an error of the network or a cancel, what has come is kept aside for a day and not
    fetched again; after one of the data it is deleted.

    Raises:
        PacsError: it cannot be retrieved.
        SeriesRefusedError, PrivacyError: it can, but cannot be used or not be taken in.
        ImportFailedError: the library cannot be written.
        Cancelled: if `progress` was cancelled.
    """
    incoming = Incoming(pacs.settings, series_uid).open()
    try:
        pacs.retrieve(study_uid, series_uid, incoming, progress.part(0.0, 0.6))
        series = scan_folder(incoming.folder, progress.part(0.6, 0.65)).series
        if not series:
            raise PacsDataError(f"{pacs.settings.name} sent nothing that can be read")
        best = max(series, key=lambda one: (one.usable, len(one.slices)))
        imported = library.import_series(best, progress=progress.part(0.65, 1.0))
    except (PacsDataError, PrivacyError, SeriesRefusedError) as error:
        if not isinstance(error, PacsDataError) or incoming.problems:
            incoming.forget()
        raise
    incoming.forget()
    return imported
