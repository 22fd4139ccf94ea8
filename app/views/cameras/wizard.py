"""The calibration wizard: board, pictures, result, place, save; and its first page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

from PySide6.QtCore import QStandardPaths, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QFileDialog,
    QHBoxLayout,
    QMessageBox,
    QSizePolicy,
    QWidget,
)

from app.core.errors import AcusError
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.tracking.calibration.board_layout import PAPERS, lay_out
from app.tracking.calibration.boards import Board, BoardKind, dictionary_names
from app.tracking.calibration.camera_pair import OpenCamera, OpenPair
from app.tracking.calibration.job import CalibrationJob
from app.views.cameras.board_page import paint_sheet, write_board
from app.views.cameras.wizard_capture import CapturePage
from app.views.cameras.wizard_result import ResultPage, WorldPage
from app.views.cameras.wizard_save import SavePage
from app.views.kit.form import Form
from app.views.kit.parts import PlainLabel, button, column, label
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict, tell
from app.views.kit.wizard import Wizard


class SheetView(QWidget):
    """The sheet of paper with the board, small."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._board: Board | None = None
        self._paper, self.fits = "A4", False
        self.setMinimumSize(260, 220)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_board(self, board: Board | None, paper: str) -> str:
        """Show a board on paper; returns why it does not fit, empty if it does."""
        self._board, self._paper, self.fits = board, paper, False
        self.update()
        if board is None:
            return ""
        try:
            lay_out(board, PAPERS[paper])
        except AcusError as error:
            return translated(error)
        self.fits = True
        return ""

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the sheet."""
        if self._board is None or not self.fits:
            return
        sheet = lay_out(self._board, PAPERS[self._paper])
        scale = min(self.width() / sheet.width_mm, self.height() / sheet.height_mm) * 0.97
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(
            0.5 * (self.width() - scale * sheet.width_mm),
            0.5 * (self.height() - scale * sheet.height_mm),
        )
        painter.fillRect(
            0, 0, round(scale * sheet.width_mm), round(scale * sheet.height_mm), QColor("white")
        )
        painter.setPen(Qt.PenStyle.NoPen)
        paint_sheet(painter, self._board, sheet, scale)


_COMMON: Final = ("DICT_4X4_50", "DICT_4X4_100", "DICT_5X5_50", "DICT_5X5_100", "DICT_6X6_250")


class BoardPage(QWidget):
    """Chooses a board.

    Signals:
        changed(): another board was chosen, or what is chosen cannot be one.
        chosen(str): a board that can be, as `parse_board` reads it.
    """

    changed = Signal()
    chosen = Signal(str)

    def __init__(self, job: CalibrationJob, parent: QWidget) -> None:
        super().__init__(parent)
        self._job, self.valid = job, True
        self.state, self._spec = label(), label(role="dim")
        self.sheet = SheetView(self)
        self.print = button(tr("Save as PDF to print…"), "primary")
        self._lay_out(self._make_form())
        self._show(job.board)
        self._connect()
        self._changed()

    @property
    def title(self) -> str:
        """Return what stands in the wizard's list."""
        return tr("Board")

    @property
    def verdict(self) -> Verdict:
        """Return how the page stands."""
        return Verdict.GOOD if self.valid else Verdict.BAD

    def save(self, path: Path) -> None:
        """Write the PDF; what is wrong is shown."""
        try:
            write_board(path, self._job.board, PAPERS[self.paper.currentText()])
        except AcusError as error:
            tell(self.state, Verdict.BAD, translated(error))
            return
        words = tr("written to {file}: print it at 100 % and measure the line of 100 mm", file=path)
        tell(self.state, Verdict.GOOD, words)

    def _changed(self) -> None:
        charuco = self.kind.currentData() == BoardKind.CHARUCO  # Qt hands out a plain text
        for name in ("marker", "dictionary"):
            self.form.show_row(charuco, name)
        counts = tr("Squares") if charuco else tr("Inner corners")
        self.form.names["columns",].setText(counts)
        try:
            board = self._board(charuco)
        except AcusError as error:
            self.valid = False
            self.sheet.show_board(None, "")
            self._spec.setText("")
            tell(self.state, Verdict.BAD, translated(error))
        else:
            self.valid = True
            self._job.set_board(board)
            self._spec.setText(board.spec)
            self._show_sheet(board)
            self.chosen.emit(board.spec)
        self.print.setEnabled(self.valid and self.sheet.fits)
        self.changed.emit()

    def _show_sheet(self, board: Board) -> None:
        problem = self.sheet.show_board(board, self.paper.currentText())
        width, height = (side / MILLIMETRE for side in board.size)
        if problem:
            words = tr(
                "{why}. A board that you have already can be used all the same.", why=problem
            )
            tell(self.state, Verdict.WARNING, words)
        elif board.ambiguous:
            tell(
                self.state,
                Verdict.WARNING,
                tr(
                    "This board looks the same after half a turn. The program mends what it can; a "
                    "ChArUco board needs no mending."
                ),
            )
        else:
            tell(self.state, Verdict.GOOD, tr("{w:.0f} × {h:.0f} mm", w=width, h=height))

    def _board(self, charuco: bool) -> Board:
        square = self.square.value() * MILLIMETRE
        columns, rows = self.columns.value(), self.rows.value()
        if not charuco:
            return Board(BoardKind.CHECKERBOARD, columns, rows, square)
        marker, name = self.marker.value() * MILLIMETRE, self.dictionary.currentText()
        return Board(BoardKind.CHARUCO, columns - 1, rows - 1, square, marker, name)

    def _show(self, board: Board) -> None:
        charuco = board.kind is BoardKind.CHARUCO
        self.kind.setCurrentIndex(self.kind.findData(board.kind))
        self.columns.setValue(board.columns + charuco)
        self.rows.setValue(board.rows + charuco)
        self.square.setValue(board.square / MILLIMETRE)
        if charuco:
            self.marker.setValue(board.marker / MILLIMETRE)
            self.dictionary.setCurrentText(board.dictionary)

    def _ask(self) -> None:
        folder = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)
        start = str(Path(folder) / "acus-board.pdf")
        answer, _ = QFileDialog.getSaveFileName(
            self, tr("Save the board"), start, tr("PDF (*.pdf)")
        )
        if answer:
            path = Path(answer)
            self.save(path if path.suffix else path.with_suffix(".pdf"))

    def _make_form(self) -> Form:
        self.form = form = Form(parent=self)
        kinds = (
            (BoardKind.CHARUCO, tr("ChArUco (recommended)")),
            (BoardKind.CHECKERBOARD, tr("Checkerboard")),
        )
        self.kind = form.choice("kind", title=tr("Kind"), among=kinds)
        counts = (3, 60, 3)
        with form.together(title=tr("Squares")) as line:
            self.columns = form.count("columns", within=counts)
            line.addWidget(PlainLabel("×"))
            self.rows = form.count("rows", within=counts)
            line.addStretch(1)
        side, marker = (0.5, 500.0, 20.0), (0.5, 500.0, 15.0)
        self.square = form.number("square", title=tr("Side of a square"), unit="mm", within=side)
        self.marker = form.number("marker", title=tr("Side of a marker"), unit="mm", within=marker)
        names = (*_COMMON, *(name for name in dictionary_names() if name not in _COMMON))
        among = [(name, name) for name in names]
        self.dictionary = form.choice("dictionary", title=tr("Markers"), among=among)
        self.dictionary.setCurrentText("DICT_5X5_100")
        papers = [(name, name) for name in PAPERS]
        self.paper = form.choice("paper", title=tr("Paper"), among=papers)
        return form

    def _lay_out(self, form: Form) -> None:
        rows = column(self, tr("Which board do you have?"))
        rows.addWidget(
            label(
                tr(
                    "A flat board with squares of a known size. ChArUco may be seen in part and "
                    "always says which way round it lies."
                ),
                "dim",
            )
        )
        rows.addWidget(
            label(
                tr(
                    "Measure the line of 100 mm below the board, and type the squares as they are: "
                    "a print at 97 % leaves every residual as good as it was, and makes all that "
                    "is measured 3 % too long."
                )
            )
        )
        beside = QHBoxLayout()
        form.rows.addStretch(1)
        beside.addWidget(form)
        beside.addWidget(self.sheet, 1)
        rows.addLayout(beside, 1)
        rows.addWidget(self.state)
        last = QHBoxLayout()
        last.addWidget(self.print)
        last.addWidget(self._spec, 1)
        rows.addLayout(last)

    def _connect(self) -> None:
        self.form.edited.connect(lambda *_: self._changed())
        self.print.clicked.connect(self._ask)


Step = BoardPage | CapturePage | ResultPage | WorldPage | SavePage


class CalibrationWizard(Wizard):
    """Leads through the calibration of two cameras; nothing in it blocks the window.

    Signals:
        used(): another calibration is in use.

    Args:
        job: what is calibrated, and where it is kept.
        open_pair: opens the real cameras; None if none are chosen: folders only.
        parent: window.
    """

    used = Signal()

    def __init__(
        self, job: CalibrationJob, open_pair: OpenPair | None = None, parent: QWidget | None = None
    ) -> None:
        super().__init__(tr("Calibration of the cameras"), (940, 620), 150, parent)
        self.job = job
        self.board_page = BoardPage(job, self)
        self.capture_page = CapturePage(job, open_pair, self)
        self.result_page = ResultPage(job, self)
        self.world_page = WorldPage(job, self._after_capture(open_pair), self)
        self.save_page = SavePage(job, self)
        self.steps: tuple[Step, ...] = (
            self.board_page,
            self.capture_page,
            self.result_page,
            self.world_page,
            self.save_page,
        )
        self.add_pages(self.steps)
        self._connect()
        self.show_page(0)

    @property
    def busy(self) -> bool:
        """Return whether a page works."""
        return any(page.running for page in self.steps if not isinstance(page, BoardPage))

    def marks(self) -> tuple[tuple[Verdict, str], ...]:
        """Return how each page stands, and its title."""
        return tuple((page.verdict, page.title) for page in self.steps)

    def enter(self, number: int) -> None:
        """Prepare a page that is shown now."""
        page = self.steps[number]
        if isinstance(page, ResultPage | WorldPage | SavePage):
            page.enter()

    def lacks(self, number: int) -> str:
        """Say what a page must have before the next one makes sense; empty if it has it."""
        if not self.board_page.valid:
            return tr("Choose a board that can be")
        page = self.steps[number]
        if page is self.capture_page and not self.job.pairs:
            return tr(
                "Take or open pictures first. To place or to import a calibration without any, "
                "choose the page in the list."
            )
        if page is self.result_page and self.job.result is None:
            return tr("There is no result yet")
        return ""

    def finish(self) -> None:
        """Close after the last page, by the way that asks."""
        self.reject()

    def reject(self) -> None:
        """Close by Escape or by the window's cross; what is not kept yet is asked about."""
        if not (self.job.unsaved or self.capture_page.found) or self._may_go():
            super().reject()

    def done(self, code: int) -> None:
        """Close by any way: what works is stopped, the cameras are let go."""
        self.capture_page.end()
        self.result_page.stop()
        self.world_page.stop()
        super().done(code)

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are let go; for other threads."""
        waits = (self.capture_page.closed(), self.world_page.closed())
        return lambda: [wait() for wait in waits]

    def _after_capture(self, open_pair: OpenPair | None) -> OpenPair | None:
        """Open the cameras once the page before has let them go: one port is opened once."""
        if open_pair is None:
            return None
        closed = self.capture_page.closed

        def open_after(progress: Progress) -> Sequence[OpenCamera]:
            closed()()
            return open_pair(progress)

        return open_after

    def _may_go(self) -> bool:
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self,
            tr("Unsaved calibration"),
            tr("Pictures and calibration are not saved and will be lost. Close all the same?"),
            buttons.Discard | buttons.Cancel,
            buttons.Cancel,
        )
        return answer == buttons.Discard

    def _board_changed(self) -> None:
        self.capture_page.forget()
        self.refresh()

    def _saved(self) -> None:
        self.refresh()
        self.used.emit()

    def _connect(self) -> None:
        self.board_page.changed.connect(self._board_changed)
        for page in (self.capture_page, self.result_page, self.world_page):
            page.changed.connect(self.refresh)
        self.save_page.began.connect(self.refresh)
        self.save_page.changed.connect(self._saved)
