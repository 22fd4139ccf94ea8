"""From the PACS into the library: retrieved, de-identified, and the originals deleted."""

from collections.abc import Sequence
from dataclasses import dataclass

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, SeriesRefusedError
from app.imaging.library import CtLibrary, Imported, ImportFailedError
from app.imaging.pacs.archive import Archive
from app.imaging.pacs.errors import PacsDataError
from app.imaging.pacs.incoming import Incoming
from app.imaging.privacy.burned_in import MaskBox
from app.imaging.privacy.errors import AnnotatedError, PrivacyError
from app.imaging.reading import offer
from app.imaging.scanning import scan_folder
from app.imaging.series import NO_REMEDY, Series


class RemedyWantedError(SeriesRefusedError):
    """What came opens only with a remedy that was not asked for; it is kept aside."""


@dataclass(frozen=True, slots=True)
class Fetched:
    """A series that has come, not yet de-identified: to be kept or forgotten.

    Attributes:
        series: its best one, where the archive sent several.
        incoming: its files, aside.
    """

    series: Series
    incoming: Incoming

    def forget(self) -> None:
        """Delete what has come; idempotent."""
        self.incoming.forget()


def fetch(
    pacs: Archive,
    study_uid: str,
    series_uid: str,
    progress: Progress,
    remedy: str | None = NO_REMEDY,
) -> Fetched:
    """Retrieve a series and set it aside.

    After an error of the network or a cancel, what has come is kept aside for a day and not
    fetched again, and so is a series that opens with a remedy that was not asked for; after an
    error of the data it is deleted.

    Args:
        pacs: from where.
        study_uid: of the study.
        series_uid: of the series.
        progress: told how far it is; cancels.
        remedy: with which it may be taken, if it cannot be opened as it is; None: whichever it
            takes.

    Raises:
        PacsError: it cannot be retrieved.
        RemedyWantedError: it can, but opens only with a remedy that was not asked for.
        SeriesRefusedError: it can, but not be used.
        Cancelled: if `progress` was cancelled.
    """
    incoming = Incoming(pacs.settings, series_uid, study_uid).open()
    try:
        pacs.retrieve(study_uid, series_uid, incoming, progress.part(0.0, 0.9))
        series = scan_folder(incoming.folder, progress.part(0.9, 1.0)).series
        if not series:
            incoming.forget()
            raise PacsDataError(
                sentence(
                    "{pacs_settings_name} sent nothing that can be read",
                    pacs_settings_name=pacs.settings.name,
                )
            )
        best = max(series, key=lambda one: _worth(one, remedy))
        _require_remedy(best, remedy)
    except RemedyWantedError:
        raise
    except (PacsDataError, SeriesRefusedError) as error:
        if not isinstance(error, PacsDataError) or incoming.problems:
            incoming.forget()
        raise
    return Fetched(best, incoming)


def _worth(series: Series, remedy: str | None) -> tuple[bool, bool, int]:
    """Return what counts in choosing among the series that came under one UID."""
    mended = bool(series.remedies) and remedy in (None, *series.remedies)
    return series.usable, mended, len(series.slices)


def _require_remedy(series: Series, remedy: str | None) -> None:
    if series.usable:
        return
    if not series.remedies:
        raise SeriesRefusedError(
            sentence("this series cannot be used: {series_reason}", series_reason=series.reason)
        )
    if remedy not in (None, *series.remedies):
        raise RemedyWantedError(
            sentence(
                "this series cannot be used as it is: {series_reason}{offer}; what has come "
                "is kept aside for a day and not fetched again",
                series_reason=series.reason,
                offer=offer(series),
            )
        )


def keep(
    fetched: Fetched,
    library: CtLibrary,
    progress: Progress,
    boxes: Sequence[MaskBox] = (),
    remedy: str = NO_REMEDY,
) -> Imported:
    """De-identify what was fetched into the library and delete the originals.

    They are deleted after a refusal too, but for one that boxes over the writing would mend, and
    kept after an error of the disk.

    Raises:
        SeriesRefusedError, PrivacyError: it must not be taken in.
        ImportFailedError: the library cannot be written.
        Cancelled: if `progress` was cancelled.
    """
    try:
        imported = library.import_series(fetched.series, boxes, progress, remedy)
    except AnnotatedError:
        raise
    except ImportFailedError as error:
        if isinstance(error.__context__, FileDamagedError):  # a repeated retrieval would keep it
            fetched.forget()
        raise
    except (PrivacyError, SeriesRefusedError):
        fetched.forget()
        raise
    fetched.forget()
    return imported


def take(
    pacs: Archive,
    study_uid: str,
    series_uid: str,
    library: CtLibrary,
    progress: Progress,
    boxes: Sequence[MaskBox] = (),
    remedy: str = NO_REMEDY,
) -> Imported:
    """Retrieve a series into the library, de-identified; see `fetch` and `keep` for the errors."""
    fetched = fetch(pacs, study_uid, series_uid, progress.part(0.0, 0.65), remedy)
    return keep(fetched, library, progress.part(0.65, 1.0), boxes, remedy)
