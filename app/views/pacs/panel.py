"""The PACS' browser: search, see what is there, take a series into the library.

Names are shown to the instructor in front of the screen, so that the right patient is found; they
are never stored or logged.
"""

from __future__ import annotations

import re
from datetime import date, datetime
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError, ConfigurationError
from app.core.loading import ONE_AT_A_TIME
from app.core.messages import sentence
from app.core.progress import Progress
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.form import Form
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel, button, size_dialog
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.text import day, tr, translated

if TYPE_CHECKING:
    from app.imaging.pacs.query import FoundSeries, Query
    from app.imaging.pacs.settings import PacsSettings

Found = tuple["FoundSeries", int]
_ROLE = Qt.ItemDataRole.UserRole


class PacsPanel(QDialog):
    """Searches the configured PACS, reading only.

    Signals:
        wanted(PacsSettings, FoundSeries): take this series into the library.
        configure_wanted(): the PACS are to be entered or changed.
    """

    wanted = Signal(object, object)
    configure_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("PACS"))
        size_dialog(self, 980, 620)
        self._task: BackgroundTask | None = None
        self.strip = ProgressStrip(self)  # its own: the window's cannot be clicked meanwhile
        self.servers, self.note = QComboBox(self), PlainLabel(self)
        self.configure = button(tr("Configure…"))
        self.form = self._make_form()
        self.search = QPushButton(tr("Search"), self)
        self.take = QPushButton(tr("Take into the library, de-identified"), self)
        self.tree = self._make_tree()
        self._lay_out()
        self.fill_servers()
        self.search.clicked.connect(self.query)
        self.take.clicked.connect(self._want)
        self.configure.clicked.connect(self.configure_wanted)
        self.tree.itemSelectionChanged.connect(self._enable)
        self.finished.connect(lambda _: self._stop())
        self._enable()

    def query(self) -> None:
        """Search for what the fields say."""
        from app.imaging.pacs.query import Query

        settings = self.servers.currentData()
        try:
            query = Query(
                self.patient.text(), name_asked(self.name.text()), dates_asked(self.date.text())
            )
        except AcusError as error:
            self.note.setText(translated(error))
            return
        self._stop()
        self.search.setEnabled(False)
        self.note.setText(tr("Searching…"))
        self._task = run_in_background(
            self,
            lambda progress: _find(settings, query, progress),
            self.show_found,
            self._fail,
            self._stopped,
            title=tr("Searching {name}", name=settings.name),
            indicator=self.strip,
        )

    def selected(self) -> FoundSeries | None:
        """Series that is marked."""
        item = self.tree.currentItem()
        return None if item is None else item.data(0, _ROLE)

    def _make_tree(self) -> QTreeWidget:
        tree = QTreeWidget(self)
        tree.setAccessibleName(tr("Series"))
        columns = ("Patient", "ID", "Date", "Study", "Series", "Body part", "Pictures")
        tree.setHeaderLabels([tr(column) for column in columns])
        tree.setRootIsDecorated(False)
        tree.setAlternatingRowColors(True)
        tree.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        tree.header().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        tree.itemDoubleClicked.connect(lambda *_: self._want())
        return tree

    def _make_form(self) -> Form:
        form, hidden = Form(parent=self), NAMES.are_hidden
        with form.together(title=tr("PACS")) as line:
            line.addWidget(self.servers, 1)
            line.addWidget(self.configure)
        hint = tr("* and ? stand for unknown characters")
        self.patient = form.text("patient", title=tr("Patient ID"), hint=hint, secret=hidden)
        hint = tr("Family, Given; * and ? stand for unknown characters")
        self.name = form.text("name", title=tr("Name"), hint=hint, secret=hidden)
        hint = tr("{day}, or two days with a dash", day=day(date(2024, 2, 1)))
        self.date = form.text("date", title=tr("Date of the study"), hint=hint)
        return form

    def _lay_out(self) -> None:
        private = PlainLabel(tr("Names are shown here only; nothing of them is stored."), self)
        for label in (self.note, private):
            label.setProperty("role", "dim")
            label.setWordWrap(True)
        foot = QHBoxLayout()
        foot.addWidget(private, 1)
        foot.addWidget(self.search)
        foot.addWidget(self.take)
        self.search.setDefault(True)
        self.take.setAutoDefault(False)
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        column.addWidget(self.form)
        column.addWidget(self.note)
        column.addWidget(self.tree, 1)
        column.addWidget(self.strip)
        column.addLayout(foot)

    def fill_servers(self) -> None:
        """Read the configuration, at first and after it was changed."""
        from app.imaging.pacs.settings import configured

        chosen = self.servers.currentData()
        self.servers.clear()
        self.note.clear()
        try:
            for one in configured():
                self.servers.addItem(f"{one.name}  ({one.title}, {one.host}:{one.port})", one)
                if chosen is not None and one.name == chosen.name:
                    self.servers.setCurrentIndex(self.servers.count() - 1)
        except AcusError as error:
            self.note.setText(translated(error))
        else:
            if self.servers.count() == 0:
                self.note.setText(tr("No PACS is configured yet: press Configure…"))
        self._enable()

    def show_found(self, result: list[Found]) -> None:
        """List what a search has found."""
        self._stopped()
        self.tree.clear()
        for series, here in result:
            self.tree.addTopLevelItem(_row(series, here))
        self.note.setText(tr("{count} series", count=len(result)))
        first = self.tree.topLevelItem(0)
        if first is not None:
            self.tree.setCurrentItem(first)
        self._enable()

    def _fail(self, error: Exception) -> None:
        self._stopped()
        self.note.setText(
            translated(error) if isinstance(error, AcusError) else type(error).__name__
        )

    def _want(self) -> None:
        series = self.selected()
        if series is not None:
            self.wanted.emit(self.servers.currentData(), series)
            self.accept()

    def _enable(self) -> None:
        self.search.setEnabled(self.servers.count() > 0)
        self.take.setEnabled(self.selected() is not None)

    def _stopped(self) -> None:
        self.note.clear()
        self._enable()

    def _stop(self) -> None:
        if self._task is not None and self._task.is_running():
            self._task.cancel()
        self._task = None


def _find(settings: PacsSettings, query: Query, progress: Progress) -> list[Found]:
    with ONE_AT_A_TIME:
        from app.imaging.pacs.archive import archive_of
        from app.imaging.pacs.incoming import Incoming
    client = archive_of(settings)
    found: list[FoundSeries] = []
    studies = client.find_studies(query, progress.part(0.0, 0.2))
    for index, study in enumerate(studies):
        share = 0.2 + 0.8 * index / len(studies)
        found += client.find_series(study, progress=progress.part(share, 1.0))
    return [(series, Incoming(settings, series.uid).count()) for series in found]


def _row(series: FoundSeries, here: int) -> QTreeWidgetItem:
    """Line of the table; `here` is how many pictures an interrupted retrieval has left."""
    study = series.study
    count = "?" if series.instances is None else str(series.instances)
    if here:
        count = tr("{here} of {count} here, to be resumed", here=here, count=count)
    item = QTreeWidgetItem(
        [
            NAMES.shown(name_words(study.patient_name)),
            NAMES.shown(study.patient_id),
            date_words(study.date),
            NAMES.shown(study.description),
            f"{series.number}  {NAMES.shown(series.description)}".strip(),
            series.body_part,
            count,
        ]
    )
    item.setData(0, _ROLE, series)
    return item


_FORMS: Final = ("%Y%m%d", "%Y-%m-%d", "%d.%m.%Y", "%d/%m/%Y")
"""Ways to write a date that everybody may use; none of them can be taken for another."""

_DAY: Final = r"(?:\d{8}|\d{4}-\d{1,2}-\d{1,2}|\d{1,2}[./]\d{1,2}[./]\d{4})"
_RANGE: Final = re.compile(rf"({_DAY})?\s*(?:([-\u2013\u2014])\s*({_DAY})?)?")


def name_words(name: str) -> str:
    """Return a patient's name as "Family, Given Middle, Prefix, Suffix"; as it stands without `^`.

    Of a name in several scripts the first one is shown.
    """
    family, *given = (part.strip() for part in name.split("=")[0].split("^"))
    first = " ".join(part for part in given[:2] if part)
    return ", ".join(part for part in (family, first, *given[2:]) if part)


def name_asked(text: str) -> str:
    """Return what a PACS is asked for where somebody writes "Family, Given Middle"."""
    if "^" in text:
        return text.strip()
    family, _, given = (part.strip() for part in text.partition(","))
    return "^".join([family, *given.split()]) if given else family


def date_words(stored: str) -> str:
    """Return a date `YYYYMMDD` as the user's language writes it; as it stands if it is none."""
    try:
        return day(datetime.strptime(stored, "%Y%m%d").date())
    except ValueError:
        return stored


def dates_asked(text: str) -> str:
    """Return the dates that a PACS is asked for, `YYYYMMDD` or a range open at either end.

    Args:
        text: a day, or two with a dash between; `2024-02-01`, `1.2.2024`, `01/02/2024` (the day
            first) and `20240201` are all the same.

    Raises:
        ConfigurationError: if it is no date.
    """
    parts = _RANGE.fullmatch(text.strip())
    if parts is None:
        raise _no_date(text)
    first, dash, last = parts.groups()
    return (
        (_stored(first) if first else "") + ("-" if dash else "") + (_stored(last) if last else "")
    )


def _stored(text: str) -> str:
    for form in _FORMS:
        try:
            return datetime.strptime(text, form).strftime("%Y%m%d")
        except ValueError:
            continue
    raise _no_date(text)


def _no_date(text: str) -> ConfigurationError:
    example = day(date(2024, 2, 1))
    return ConfigurationError(
        sentence(
            "{text!r} is no date: write {day}, or two days with a dash", text=text, day=example
        )
    )
