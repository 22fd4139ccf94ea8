"""The sessions page: what was recorded, as a table to sort, open, export, delete and bring back.

The instructor also says here what is said of attempts (`remarks`), and sees what was deleted.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QSortFilterProxyModel,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLineEdit,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.core.progress import Progress
from app.session.abort_reasons import known_reason
from app.session.archive import UNDO_DAYS, deleted_at
from app.session.course import held_back
from app.session.header import TRASH
from app.session.interrupted import interrupted, recover
from app.session.people import NOTHING_SAID, People, Remarks
from app.session.store import SUFFIX, delete, list_sessions, restore
from app.session.summary import BROKEN, Summary
from app.views.debrief.remarks import RemarkActions, said_words
from app.views.debrief.score_words import facts_of, short_words, whose_words
from app.views.exercise.readouts import clock_text
from app.views.exercise.stages import state_word
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.background import run_in_background
from app.views.kit.names import NAMES
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.text import date_text, declared, literal, tr, tr_n, translated

Index = QModelIndex | QPersistentModelIndex
SORT_ROLE: Final = Qt.ItemDataRole.UserRole
SUMMARY_ROLE: Final = Qt.ItemDataRole.UserRole + 1
DATE, STUDENT, EXERCISE, SCORE, MADE, STATE, DURATION, SIGNED, NOTE = range(9)
_RIGHT: Final = frozenset({SCORE, DURATION})
_REMARK_CHARS, _MADE_PX = 48, 110
"""Characters of remarks that are to be seen, and what their neighbour keeps at least [px]."""
_RIGHTWARDS: Final = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_SIGNED_LOOKS: Final = {
    "verified": (theme.GOOD, "✔"),
    "altered": (theme.BAD, "✖"),
    "unsigned": (theme.TEXT_DIM, "•"),
    "admitted": (theme.GOOD, "▲"),
    "revoked": (theme.BAD, "✖"),
}
_STATE_LOOKS: Final = {
    "ended": (theme.TEXT, "✔"),
    "aborted": (theme.WARNING, "▲"),
    "unfinished": (theme.WARNING, "▲"),
    "broken": (theme.BAD, "✖"),
}


@dataclass(frozen=True, slots=True)
class Listed:
    """What the list shows.

    Attributes:
        summaries: of the attempts.
        held: title of the course that holds a result back, by id.
        said: what the instructor said, by id.
        deleted: when they were deleted [s since 1970], by id; empty where none is.
        cut: ids of those that were cut off and have no end yet.
    """

    summaries: Sequence[Summary] = ()
    held: Mapping[str, str] = field(default_factory=dict)
    said: Mapping[str, Remarks] = field(default_factory=dict)
    deleted: Mapping[str, float] = field(default_factory=dict)
    cut: frozenset[str] = frozenset()

    def for_student(self) -> "Listed":
        """Return it without what is not open before a result is released."""
        said = {
            name: Remarks(void=one.void) if name in self.held else one
            for name, one in self.said.items()
        }
        return replace(self, said=said)

    def remarks(self, summary: Summary, manages: bool, short: bool = False) -> list[str]:
        """Say what is to be known of an attempt, one line each; of who manages, more.

        Args:
            summary: of the attempt.
            manages: whether who is here may see every result.
            short: for a cell, which has little room; the whole stands in its tip.
        """
        said, held = self.said.get(summary.id, NOTHING_SAID), self.held.get(summary.id, "")
        days = UNDO_DAYS - (time.time() - self.deleted.get(summary.id, 0.0)) / 86400.0
        if short:
            told = (
                (
                    summary.id in self.deleted,
                    tr_n("{n} day left", "{n} days left", max(0, int(days))),
                ),
                (bool(said.void), tr("void: {why}", why=said.void)),
                (bool(said.comment), f"“{said.comment}”"),
                (bool(held) and manages, tr("not released")),
                (summary.id in self.cut, tr("cut off")),
            )
            return [words for so, words in told if so]
        lines = said_words(said, held if manages else "")
        if summary.id in self.cut:
            lines.append(tr("cut off: Recover closes it as it is"))
        if summary.id in self.deleted:
            lines.insert(
                0,
                tr_n(
                    "deleted; can be brought back for {n} day",
                    "deleted; can be brought back for {n} days",
                    int(days),
                )
                if days >= 1.0
                else tr("deleted; can be brought back until the trash is emptied"),
            )
        return lines


class SessionsModel(QAbstractTableModel):
    """Read-only table of summaries."""

    def __init__(self) -> None:
        super().__init__()
        self._summaries: tuple[Summary, ...] = ()
        self._listed = Listed()
        self._manages = True

    def set_listed(self, listed: Listed, manages: bool) -> None:
        """Replace all rows; of a result that is held no score is shown unless `manages`."""
        self.beginResetModel()
        self._listed = listed if manages else listed.for_student()
        self._summaries, self._manages = tuple(listed.summaries), manages
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return the number of sessions."""
        return 0 if parent.isValid() else len(self._summaries)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return the number of columns."""
        return 0 if parent.isValid() else NOTE + 1

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        """Titles of the columns, aligned as their cells."""
        if role == Qt.ItemDataRole.TextAlignmentRole and section in _RIGHT:
            return _RIGHTWARDS
        if orientation is not Qt.Orientation.Horizontal or role != Qt.ItemDataRole.DisplayRole:
            return None
        return (
            tr("Date"),
            tr("Student"),
            tr("Exercise"),
            tr("Score"),
            tr("Made with"),
            tr("State"),
            tr("Time"),
            tr("Signature"),
            tr("Remark"),
        )[section]

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Text, colour, alignment, sort key or the summary itself."""
        summary, column = self._summaries[index.row()], index.column()
        said = self._listed.said.get(summary.id, NOTHING_SAID)
        if column == SCORE and said.void and role == Qt.ItemDataRole.DisplayRole:
            return tr("void")
        if column == NOTE and role == Qt.ItemDataRole.DisplayRole:
            lines = self._listed.remarks(summary, self._manages, short=True)
            lines.append(cell_text(summary, column))
            return NAMES.without_names(" · ".join(" ".join(one.split()) for one in lines if one))
        if column == SCORE and summary.id in self._listed.held and not self._manages:
            course = self._listed.held[summary.id]
            told: dict[int, Any] = {
                Qt.ItemDataRole.DisplayRole: tr("held"),
                SORT_ROLE: -1.0,
                Qt.ItemDataRole.ToolTipRole: literal(
                    tr("The instructor releases this result of the course {course}.", course=course)
                ),
            }
            if role in told:
                return told[role]
        if role == Qt.ItemDataRole.DisplayRole:
            return cell_text(summary, column)
        if role == SORT_ROLE:
            return sort_key(summary, column)
        if role == SUMMARY_ROLE:
            return summary
        if role == Qt.ItemDataRole.ToolTipRole:
            known = summary.conditions
            under = [f"{name}: {value}" for name, value in facts_of(known)] if known else []
            remarks = self._listed.remarks(summary, self._manages)
            every = (
                summary.id,
                whose_words(known),
                *remarks,
                translated(known_reason(summary.reason)),
                *summary.problems,
                *under,
            )
            lines = [line for line in every if line]
            return literal(NAMES.without_names("\n".join(lines), files=True))
        if role == Qt.ItemDataRole.TextAlignmentRole and column in _RIGHT:
            return _RIGHTWARDS
        if role == Qt.ItemDataRole.ForegroundRole and column == SCORE and said.void:
            return QColor(theme.now(theme.WARNING))
        if role == Qt.ItemDataRole.ForegroundRole and column == STATE:
            return QColor(theme.now(_STATE_LOOKS.get(summary.state, (theme.TEXT, ""))[0]))
        if role == Qt.ItemDataRole.ForegroundRole and column == SIGNED:
            return QColor(
                theme.now(
                    _SIGNED_LOOKS.get(summary.signature.partition(" (")[0], (theme.TEXT, ""))[0]
                )
            )
        return None


def cell_text(summary: Summary, column: int) -> str:
    """Text of one cell."""
    if column == DATE:
        return date_text(summary.started)
    if column == STUDENT:
        return NAMES.shown(ACCESS.shown(summary.student))
    if column == EXERCISE:
        return exercise_text(summary)
    if column == SCORE:
        return score_text(summary)
    if column == MADE:
        return short_words(summary.conditions)
    if column == STATE:
        symbol = _STATE_LOOKS.get(summary.state, ("", "•"))[1]
        return f"{symbol} {state_word(summary.state)}"
    if column == DURATION:
        return "" if summary.state == BROKEN else clock_text(summary.duration)
    if column == SIGNED:
        return signature_word(summary.signature)
    remark = "; ".join(filter(None, (translated(known_reason(summary.reason)), *summary.problems)))
    return NAMES.without_names(remark, files=True)


def signature_word(verdict: str) -> str:
    """Say what the signature of a record says, with its symbol; nothing where nobody looked."""
    words = {
        "verified": tr("verified"),
        "altered": tr("altered"),
        "unsigned": tr("unsigned"),
        "admitted": tr("admitted"),
        "revoked": tr("revoked"),
    }
    kind, _, station = verdict.partition(" (station ")
    if kind not in words:
        return ""
    where = tr(" (station {name})", name=station.removesuffix(")")) if station else ""
    return f"{_SIGNED_LOOKS[kind][1]} {words[kind]}{where}"


def exercise_text(summary: Summary) -> str:
    """Title of the exercise, with its version from the second one on."""
    title = declared(summary.exercise_title) or summary.exercise_id
    known = summary.conditions
    if known is not None and known.drill:
        return tr("Drill: {title}", title=title)
    if known is None or known.version < 2:
        return title
    return tr("{title} (version {n})", title=title, n=known.version)


def score_text(summary: Summary) -> str:
    """Points with ✔ or ✖, `void`, a dash for an altered record, or nothing."""
    score = summary.score
    if summary.signature == "altered":
        return "—"
    if score is None:
        return ""
    if score.get("void_reason") or score.get("total") is None:
        return tr("void")
    return f"{'✔' if score.get('passed') else '✖'} {float(score['total']):.0f}"


def sort_key(summary: Summary, column: int) -> str | float:
    """Value that a column is sorted by; without a score below every score."""
    if column == DATE:
        return summary.started
    if column == SCORE:
        total = (summary.score or {}).get("total")
        return float(total) if total is not None else -1.0
    if column == DURATION:
        return summary.duration
    return cell_text(summary, column).casefold()


def listed(folder: Path, deleted: bool = False) -> Listed:
    """Return the records of a folder, or those deleted from it, with what is said of them.

    Raises:
        SessionError: if something cannot be read.
    """
    place = folder / TRASH if deleted else folder
    found = list_sessions(place)
    asked = (
        (one.id, one.student, one.exercise_id, one.conditions.version)
        for one in found
        if one.conditions is not None
    )
    since = {one.id: deleted_at(place / f"{one.id}{SUFFIX}") for one in found} if deleted else {}
    cut = frozenset() if deleted else frozenset(one.id for one in interrupted(place)[0])
    return Listed(found, held_back(asked), People().remarks(), since, cut)


class SessionsPage(QWidget):
    """A sortable, filterable list of the records in one folder.

    Signals:
        open_requested(Summary): show the debrief of a session.
        said(): the instructor said something of attempts.
        noted(str): something worked.
        export_requested(list[Summary]): write these as CSV.
        failed(str): something did not work, in one line.
        closed(): back to where the user came from.
    """

    open_requested = Signal(object)
    export_requested = Signal(object)
    failed = Signal(str)
    said = Signal()
    noted = Signal(str)
    closed = Signal()

    def __init__(self, folder: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._folder = folder
        self._deleted: list[str] = []
        self._listed, self._asked = Listed(), 0
        self._only: Callable[[Summary], bool] | None = None
        self.model = SessionsModel()
        self.proxy = QSortFilterProxyModel(self)
        self.proxy.setSourceModel(self.model)
        self.proxy.setSortRole(SORT_ROLE)
        self.proxy.setFilterKeyColumn(-1)
        self.proxy.setFilterCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.table = QTableView(self)
        self.table.setTabKeyNavigation(False)
        self.table.setAccessibleName(tr("Sessions"))
        self.search = QLineEdit(self)
        self._count = PlainLabel(self)
        self.back = FittingButton(tr("Back"), self)
        self.open_button = FittingButton(tr("Open"), self)
        self.export = FittingButton(tr("Export CSV"), self)
        self.delete_button = FittingButton(tr("Delete"), self)
        self.undo = FittingButton(tr("Undo delete"), self)
        self.trash = FittingButton(tr("Show deleted"), self)
        self.bring_back = FittingButton(tr("Bring back"), self)
        self.recover = FittingButton(tr("Recover"), self)
        self.everything = QPushButton(self)
        self._prepare_table()
        self.remarks = RemarkActions(
            self,
            lambda: [] if self._in_trash else self._readable(),
            lambda name: self._folder / f"{name}{SUFFIX}",
        )
        self._lay_out()
        self._connect()
        ACCESS.changed.connect(self._show_again)
        self._show_again()

    def refresh(self) -> None:
        """Read the folder again, beside the window."""
        self._asked += 1
        asked, deleted = self._asked, self._in_trash

        def take(result: Listed) -> None:
            if asked == self._asked:
                self.show_listed(result)

        run_in_background(self, lambda _: listed(self._folder, deleted), take, self._fail)

    def show_listed(self, result: Listed) -> None:
        """Show these sessions: those that who is here may see, and that are asked for."""
        self._listed = result
        chosen = {one.id for one in self.selected()}
        shown = [
            one
            for one in result.summaries
            if ACCESS.may_see(one.student) and (self._only is None or self._only(one))
        ]
        rows = replace(result, summaries=shown)
        self.model.set_listed(rows, ACCESS.may_manage)
        self._fit_columns()
        self._choose(chosen)
        self._enable()

    def show_summaries(self, summaries: Sequence[Summary]) -> None:
        """Show these sessions, of which nothing is said."""
        self.show_listed(Listed(tuple(summaries)))

    def show_only(self, only: Callable[[Summary], bool] | None, words: str = "") -> None:
        """Show some of the attempts, and say which; None shows all again."""
        self._only = only
        self.everything.setText(tr("{words}  ✕", words=words))
        self.everything.setToolTip(tr("Show all attempts again"))
        self.everything.setVisible(only is not None)
        self.search.clear()
        self.trash.setChecked(False)
        self._show_again()

    def _show_again(self) -> None:
        if self._in_trash and not ACCESS.may_manage:
            self.trash.setChecked(False)  # reads the others
            self._listed = Listed()
        self.show_listed(self._listed)

    @property
    def _in_trash(self) -> bool:
        return self.trash.isChecked()

    def _show_trash(self) -> None:
        """Show what was deleted, or what was not."""
        self.trash.setText(tr("Back to the attempts") if self._in_trash else tr("Show deleted"))
        self.show_listed(Listed())
        self.refresh()

    def _choose(self, names: set[str]) -> None:
        """Select rows by id."""
        selection, model = self.table.selectionModel(), self.proxy
        which = selection.SelectionFlag.Select | selection.SelectionFlag.Rows
        for row in range(model.rowCount()):
            index = model.index(row, 0)
            if index.data(SUMMARY_ROLE).id in names:
                selection.select(index, which)

    def _fit_columns(self) -> None:
        """Fit the columns to all sessions, also to those that the filter hides now."""
        self.proxy.setFilterFixedString("")
        self.table.resizeColumnsToContents()
        self.proxy.setFilterFixedString(self.search.text())
        self._leave_room()

    def _leave_room(self) -> None:
        """Leave remarks room to be read: what it was made with stands in the tip of each row."""
        rows = (self.model.index(row, NOTE) for row in range(self.model.rowCount()))
        longest = max((len(row.data() or "") for row in rows), default=0)
        wanted = min(longest, _REMARK_CHARS) * self.table.fontMetrics().averageCharWidth()
        others = sum(self.table.columnWidth(column) for column in range(NOTE))
        missing = wanted + 2 * theme.SPACING - (self.table.viewport().width() - others)
        made = self.table.columnWidth(MADE)
        if missing > 0 and made > _MADE_PX:
            self.table.setColumnWidth(MADE, max(_MADE_PX, made - missing))

    def selected(self) -> list[Summary]:
        """Return the selected sessions, from the top."""
        rows = sorted(self.table.selectionModel().selectedRows(), key=lambda index: index.row())
        return [row.data(SUMMARY_ROLE) for row in rows]

    def delete_selected(self) -> None:
        """Move the selected sessions to the trash folder; `undo_delete` brings them back."""
        if not ACCESS.may_manage or self._in_trash:
            return
        deleted = []
        try:
            for summary in self.selected():
                delete(self._folder, summary.id)
                deleted.append(summary.id)
        except AcusError as error:
            self.failed.emit(translated(error))
        if deleted:
            self._deleted = deleted
            words = tr("{n} deleted: Ctrl+Z here, or Show deleted, brings back", n=len(deleted))
            self.noted.emit(words)
            self.said.emit()
        self.refresh()

    def bring_selected_back(self) -> None:
        """Bring deleted sessions back that are selected among them."""
        if not ACCESS.may_manage or not self._in_trash:
            return
        names = [summary.id for summary in self.selected()]
        try:
            for name in names:
                restore(self._folder, name)
        except AcusError as error:
            self.failed.emit(translated(error))
        else:
            self.noted.emit(tr("{n} brought back", n=len(names)))
        self._deleted = [name for name in self._deleted if name not in names]
        self.said.emit()
        self.refresh()

    def recover_selected(self) -> None:
        """Close those of the selected attempts that were cut off; they stay as they stand."""
        ids = [summary.id for summary in self.selected() if summary.id in self._listed.cut]
        self.recover_these(ids)

    def recover_these(self, ids: Sequence[str]) -> None:
        """Close attempts that were cut off, beside the window."""

        def work(_: Progress) -> None:
            for name in ids:
                recover(self._folder, name)

        def done(_: None) -> None:
            self.noted.emit(tr("{n} recovered: listed as unfinished, without a score", n=len(ids)))
            self.said.emit()
            self.refresh()

        run_in_background(self, work, done, self._fail)

    def discard_these(self, ids: Sequence[str]) -> None:
        """Move attempts to the deleted ones."""
        if not ACCESS.may_manage:
            return
        try:
            for name in ids:
                delete(self._folder, name)
        except AcusError as error:
            self.failed.emit(translated(error))
        self._deleted = list(ids)
        self.noted.emit(tr("{n} discarded: Show deleted brings them back", n=len(ids)))
        self.refresh()

    def undo_delete(self) -> None:
        """Bring the sessions deleted last back."""
        if not ACCESS.may_manage:
            return
        try:
            while self._deleted:
                restore(self._folder, self._deleted[-1])
                self._deleted.pop()
        except AcusError as error:
            self.failed.emit(translated(error))
        self.said.emit()
        self.refresh()

    # --- inside -----------------------------------------------------------------------------------
    def _open(self, index: QModelIndex | None = None) -> None:
        chosen = [index.data(SUMMARY_ROLE)] if index is not None else self.selected()
        if len(chosen) != 1 or self._in_trash:
            return
        if chosen[0].state == BROKEN:
            self.failed.emit(chosen[0].reason)
        else:
            self.open_requested.emit(chosen[0])

    def _readable(self) -> list[str]:
        return [summary.id for summary in self.selected() if summary.state != BROKEN]

    def _enable(self) -> None:
        chosen, readable = self.selected(), self._readable()
        manage, deleted = ACCESS.may_manage, self._in_trash
        self.open_button.setEnabled(len(chosen) == 1 and len(readable) == 1 and not deleted)
        for widget in (self.export, self.delete_button, self.undo):
            widget.setVisible(manage and not deleted)
        self.trash.setVisible(manage)
        self.bring_back.setVisible(manage and deleted)
        self.bring_back.setEnabled(bool(chosen))
        cut = any(summary.id in self._listed.cut for summary in chosen)
        self.recover.setVisible(cut and not deleted)
        self.export.setEnabled(bool(readable) and manage and not deleted)
        self.delete_button.setEnabled(bool(chosen) and manage and not deleted)
        self.undo.setEnabled(bool(self._deleted) and manage)
        open_ = ("unsigned", "revoked")
        listed = self._listed.summaries
        unsigned = frozenset(s.id for s in listed if s.signature.partition(" (")[0] in open_)
        self.remarks.follow(self._listed.said, self._listed.held, unsigned)
        if deleted:
            self.remarks.button.hide()
        shown, total = self.proxy.rowCount(), self.model.rowCount()
        empty = tr("No sessions yet: begin an attempt, and it will be listed here.")
        if deleted:
            empty = tr("Nothing that was deleted is left.")
        elif self._only is not None:
            empty = tr("No attempt of these yet.")
        self._count.setText(
            empty if total == 0 else tr("{shown} of {total} sessions", shown=shown, total=total)
        )

    def _fail(self, error: Exception) -> None:
        self.failed.emit(translated(error))

    def _prepare_table(self) -> None:
        table = self.table
        table.setModel(self.proxy)
        table.setSortingEnabled(True)
        table.sortByColumn(DATE, Qt.SortOrder.DescendingOrder)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        table.setAlternatingRowColors(True)
        table.setShowGrid(False)
        table.setStyleSheet("QTableView::item { padding: 0px 5px; }")  # columns stand apart
        table.verticalHeader().hide()
        table.verticalHeader().setDefaultSectionSize(theme.CONTROL_HEIGHT)
        header = table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setSectionResizeMode(NOTE, QHeaderView.ResizeMode.Stretch)
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.search.setPlaceholderText(tr("Filter by student, exercise, date, state…"))
        self.search.setAccessibleName(self.search.placeholderText())
        self.search.setClearButtonEnabled(True)
        self.open_button.setProperty("role", "primary")
        self.open_button.setToolTip(tr("Debrief with replay (double click, or Enter)"))
        self.delete_button.setToolTip(
            literal(tr("To the deleted ones, for {n} days at least (Del)", n=UNDO_DAYS))
        )
        self.undo.setToolTip(tr("Bring the last deleted ones back (Ctrl+Z in the table)"))
        self.recover.setToolTip(
            tr("The program was killed in this attempt: keep what was recorded, as unfinished")
        )
        self.trash.setToolTip(tr("What was deleted, to be brought back"))
        self.trash.setCheckable(True)
        self.everything.hide()
        self._count.setProperty("role", "dim")
        self._count.setWordWrap(True)

    def _lay_out(self) -> None:
        title = PlainLabel(tr("Sessions"), self)
        title.setProperty("role", "title")
        top = QHBoxLayout()
        top.addWidget(title)
        top.addSpacing(2 * theme.MARGIN)
        top.addWidget(self.everything)
        top.addWidget(self.search, 1)
        bottom = QHBoxLayout()
        bottom.addWidget(self.back)
        bottom.addWidget(self._count, 1)
        for button in (
            self.recover,
            self.remarks.button,
            self.trash,
            self.bring_back,
            self.undo,
            self.delete_button,
            self.export,
            self.open_button,
        ):
            bottom.addWidget(button)
        page = QVBoxLayout(self)
        page.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        page.addLayout(top)
        page.addWidget(self.table, 1)
        page.addLayout(bottom)

    def _connect(self) -> None:
        self.search.textChanged.connect(self.proxy.setFilterFixedString)
        self.search.textChanged.connect(self._enable)
        self.table.selectionModel().selectionChanged.connect(self._enable)
        self.table.doubleClicked.connect(self._open)
        self.back.clicked.connect(self.closed)
        self.open_button.clicked.connect(lambda: self._open())
        self.export.clicked.connect(self._export)
        self.delete_button.clicked.connect(self.delete_selected)
        self.undo.clicked.connect(self.undo_delete)
        self.trash.toggled.connect(lambda _: self._show_trash())
        self.recover.clicked.connect(self.recover_selected)
        self.bring_back.clicked.connect(self.bring_selected_back)
        self.everything.clicked.connect(lambda: self.show_only(None))
        self.remarks.failed.connect(self._fail)
        self.remarks.noted.connect(self.noted)
        self.remarks.changed.connect(self.refresh)
        self.remarks.changed.connect(self.said)
        self.table.addActions(self.remarks.all)
        self.table.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        delete = QShortcut(QKeySequence(QKeySequence.StandardKey.Delete), self.table)
        delete.setContext(Qt.ShortcutContext.WidgetShortcut)
        delete.activated.connect(self.delete_selected)
        for key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            opens = QShortcut(QKeySequence(key), self.table)
            opens.setContext(Qt.ShortcutContext.WidgetShortcut)
            opens.activated.connect(lambda: self._open())
        self.table.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """In the table, keep the keys of undo from the window, whose own they are too."""
        keys = (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress)
        if not (isinstance(event, QKeyEvent) and event.type() in keys):
            return super().eventFilter(watched, event)
        if not event.matches(QKeySequence.StandardKey.Undo):
            return False
        event.accept()
        if event.type() == QEvent.Type.KeyPress:
            self.undo_delete()
        return True

    def _export(self) -> None:
        readable = [summary for summary in self.selected() if summary.state != BROKEN]
        if readable and ACCESS.may_manage:
            self.export_requested.emit(readable)
