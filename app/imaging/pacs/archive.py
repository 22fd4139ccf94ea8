"""The archive that settings lead to, by whichever way: DIMSE or DICOMweb."""

from typing import Protocol

from app.core.progress import Progress
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.incoming import Incoming
from app.imaging.pacs.query import FoundSeries, FoundStudy, Query
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.web_client import WebPacs


class Archive(Protocol):
    """What is asked of an archive; `Pacs` says what each does and raises."""

    settings: PacsSettings

    def echo(self, progress: Progress | None = None) -> float:
        """Ask whether it is there; return the time of the answer [s]."""

    def find_studies(self, query: Query, progress: Progress | None = None) -> list[FoundStudy]:
        """Return the studies that match, newest first."""

    def find_series(
        self, study: FoundStudy, modality: str = "CT", progress: Progress | None = None
    ) -> list[FoundSeries]:
        """Return the series of a study, by number."""

    def retrieve(
        self, study_uid: str, series_uid: str, incoming: Incoming, progress: Progress
    ) -> None:
        """Fetch what has not come yet of a series."""


def archive_of(settings: PacsSettings) -> Archive:
    """Return the archive of some settings.

    Raises:
        ConfigurationError: if its encryption cannot be used.
    """
    return WebPacs(settings) if settings.retrieve == "web" else Pacs(settings)
