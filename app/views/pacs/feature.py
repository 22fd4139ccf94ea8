"""The PACS in the window: its browser, its configuration, and a series on its way from there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import tr
from app.views.pacs.panel import PacsPanel
from app.views.pacs.settings import PacsSettingsDialog
from app.views.series.intake import Candidate
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.imaging.pacs.query import FoundSeries
    from app.imaging.pacs.settings import PacsSettings
    from app.imaging.pacs.taking import Fetched
    from app.imaging.privacy.burned_in import MaskBox


def of_pacs(fetched: Fetched) -> Candidate:
    """Candidate of a series that was retrieved."""

    def take(boxes: Sequence[MaskBox], progress: Progress) -> Any:
        with ONE_AT_A_TIME:
            from app.imaging.library import CtLibrary
            from app.imaging.pacs.taking import keep
        return keep(fetched, CtLibrary(), progress, boxes, fetched.series.remedy)

    return Candidate(fetched.series, take, fetched.forget)


class PacsImport(QObject):
    """Searches the PACS and retrieves a series, beside the window.

    Signals:
        taking(Candidate): a series that was retrieved, to be looked through and taken in.
        failed(object): the error that kept a series out; nothing of it was kept.
    """

    taking = Signal(object)
    failed = Signal(object)

    def __init__(self, indicator: Indicator, window: QWidget) -> None:
        super().__init__(window)
        self._indicator, self._window = indicator, window
        self._task: BackgroundTask | None = None
        self.panel: PacsPanel | None = None
        self.configuration: PacsSettingsDialog | None = None

    def ask(self) -> None:
        """Open the browser of the PACS."""
        panel = PacsPanel(self._window)
        panel.wanted.connect(self.retrieve)
        panel.configure_wanted.connect(self.configure)
        panel.finished.connect(self._panel_closed)
        self.panel = panel
        panel.open()

    def configure(self) -> None:
        """Open the dialog in which PACS are entered; an open browser follows it."""
        dialog = PacsSettingsDialog(self.panel or self._window)
        if self.panel is not None:
            dialog.kept.connect(self.panel.fill_servers)
        dialog.finished.connect(dialog.deleteLater)
        self.configuration = dialog
        dialog.open()

    def retrieve(self, settings: PacsSettings, series: FoundSeries) -> None:
        """Retrieve a series."""
        self._task = run_in_background(
            self,
            lambda progress: _fetch(settings, series, progress),
            lambda fetched: self.taking.emit(of_pacs(fetched)),
            self.failed.emit,
            title=tr("Retrieving from {name}", name=settings.name),
            indicator=self._indicator,
        )

    def _panel_closed(self) -> None:
        if self.panel is not None:
            self.panel.deleteLater()
            self.panel = None


def _fetch(settings: PacsSettings, series: FoundSeries, progress: Progress) -> Fetched:
    with ONE_AT_A_TIME:
        from app.imaging.pacs.archive import archive_of
        from app.imaging.pacs.taking import fetch
    return fetch(archive_of(settings), series.study.uid, series.uid, progress, remedy=None)


class PacsFeature(Feature):
    """Two ways into the library of CTs; its messages are those of opened CTs."""

    place: ClassVar[int] = 20
    roles: ClassVar[frozenset[Role]] = STAFF
    help: ClassVar[str] = "reading.md#opening-a-ct"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        patients = context.patients
        self.pacs = PacsImport(context.shell.progress, context.shell.dialog_parent)
        self.pacs.taking.connect(patients.taking)
        self.pacs.failed.connect(patients.failed)
        patients.ways_in += [
            (tr("From the PACS…"), self.pacs.ask),
            (tr("Configure PACS…"), self.pacs.configure),
        ]
