"""The page of the pen: choose and print it, see what the webcam sees, measure the tip, use it.

Chosen are the pen, the webcam, and where its lens is known from.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final, cast

from PySide6.QtCore import QSignalBlocker, QStandardPaths, QTimer, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QFileDialog,
    QGroupBox,
    QHBoxLayout,
    QMessageBox,
    QVBoxLayout,
    QWidget,
)

from app.core.documents import Where
from app.core.errors import AcusError
from app.tracking.calibration.board_layout import PAPERS
from app.tracking.pen.body import load_pen, shipped_pens
from app.tracking.pen.settings import PenSettings
from app.views.cameras.boxes import SizeBox, SourceBox
from app.views.cameras.live import LivePreview
from app.views.cameras.settings_dialog import QUIET_MS
from app.views.kit import theme
from app.views.kit.form import Form
from app.views.kit.parts import button, label, message_box, size_dialog
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict, tell
from app.views.pen.net_page import write_pen
from app.views.pen.status import PenStatus
from app.views.pen.tip_step import TipStep
from app.views.pen.words import Line, accuracy_line, known_lens_words, status_lines

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.tracking.pen.body import PenProfile
    from app.views.pen.port import PenPort
    from app.views.shell.services import RobotPort, Services


_ASK = "ask"
_GUESS = "guess"
_KNOWN = "known"

Lens = tuple[Path | None, str]
"""File of a calibration, None to guess; name of the camera in a calibration of two."""


class LensBox(QComboBox):
    """Guessed, or a calibration's file.

    Signals:
        changed(): another lens was chosen.
    """

    changed = Signal()

    def __init__(self, settings: PenSettings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._camera = settings.camera
        self.addItem(tr("guessed from the pictures' size"), _GUESS)
        self.addItem(tr("a calibration's file…"), _ASK)
        self._last = 0
        if settings.calibration is not None:
            self._add(settings.calibration, settings.camera)
        self.setToolTip(
            tr(
                "A guess is good for trying out. `acus calibrate mono --images FOLDER --out "
                "lens.yaml` measures the lens; of a calibrated pair of cameras either may be taken"
            )
        )
        self.activated.connect(self._chosen)

    def chosen(self) -> Lens:
        """Return file and camera; None for a guess."""
        data = self.itemData(self._last)
        if data in (_GUESS, _ASK):
            return None, self._camera
        file, camera = str(data).rsplit("|", 1)
        return Path(file), camera

    def set_simulated(self, on: bool) -> None:
        """Say of a simulated webcam that its lens is known, and let nothing be chosen."""
        self.setEnabled(not on)
        known = self.findData(_KNOWN)
        if on and known < 0:
            self.addItem(known_lens_words(), _KNOWN)
            self.setCurrentIndex(self.count() - 1)
        elif not on and known >= 0:
            self.setCurrentIndex(self._last)
            self.removeItem(known)

    def take(self, file: Path) -> None:
        """Use a calibration's file; of a pair its first camera, the others can be chosen."""
        names = _cameras(file)
        for name in names or (self._camera,):
            self._add(file, name, many=len(names) > 1)
        self._last = self.count() - max(1, len(names))
        self.setCurrentIndex(self._last)
        self.changed.emit()

    def _add(self, file: Path, camera: str, many: bool = False) -> None:
        title = f"{file.name}, {camera}" if many else file.name
        self.addItem(title, f"{file}|{camera}")
        self._last = self.count() - 1
        self.setCurrentIndex(self._last)

    def _chosen(self, index: int) -> None:
        if self.itemData(index) != _ASK:
            if index != self._last:
                self._last = index
                self.changed.emit()
            return
        self.setCurrentIndex(self._last)
        answer, _ = QFileDialog.getOpenFileName(
            self, tr("Calibration of the webcam"), "", tr("Calibrations (*.yaml *.yml)")
        )
        if answer:
            self.take(Path(answer))


def _cameras(file: Path) -> tuple[str, ...]:
    """Names of the cameras of a pair; empty for one camera or what is no calibration."""
    from app.core.configuration import read_yaml
    from app.core.errors import AcusError

    try:
        document = read_yaml(file)
    except AcusError:
        return ()  # said when it is used
    found = document.get("cameras") if isinstance(document, dict) else None
    if not isinstance(found, list):
        return ()
    return tuple(str(one["name"]) for one in found if isinstance(one, dict) and "name" in one)


class PenChoice(Form):
    """Pen, size, webcam, lens.

    Args:
        settings: the present ones.
        sources: webcams that are plugged in.
        parent: the page.

    Signals:
        changed(): the user chose something.
    """

    changed = Signal()

    def __init__(
        self, settings: PenSettings, sources: Sequence[RobotPort], parent: QWidget | None = None
    ) -> None:
        super().__init__(PenSettings, parent, spacing=theme.SPACING)
        self._settings = settings
        self._add_pen(settings)
        self.source = SourceBox(sources, self)
        self.source.show_source(settings.source)
        self.row(tr("&Webcam"), self.source)
        self.size_box = SizeBox(settings.size, self)
        self.size_box.setToolTip(tr("Width and height of the webcam's pictures"))
        self.row(tr("Pictures"), self.size_box)
        self.lens = LensBox(settings, self)
        self.row(tr("&Lens"), self.lens)
        self._add_print()
        self.written = label(role="dim")
        self.written.hide()
        self.rows.addWidget(self.written)
        self._connect()
        self._enable()

    def settings(self) -> PenSettings:
        """Return what is chosen.

        Raises:
            AcusError: if it cannot be used; says why.
        """
        name = str(self.body.currentData())
        edge, usual = round(self.edge.value(), 1), load_pen(name).body.edge_mm
        calibration, camera = self.lens.chosen()
        return self._settings.model_copy(
            update={
                "source": self.source.source(),
                "size": self.size_box.size_px(),
                "pen": name,
                "edge_mm": None if abs(edge - usual) < 0.05 else edge,
                "calibration": calibration,
                "camera": camera,
            }
        )

    def write(self, path: Path) -> None:
        """Write the net as a PDF; what is wrong is shown."""
        self.written.show()
        try:
            chosen = self.settings()
            pen = load_pen(chosen.pen)
            pen = pen if chosen.edge_mm is None else pen.resized(chosen.edge_mm)
            write_pen(path, pen, PAPERS[self.paper.currentText()])
        except AcusError as error:
            tell(self.written, Verdict.BAD, translated(error))
            return
        tell(
            self.written,
            Verdict.GOOD,
            tr(
                "written to {file}: print it at 100 %, check the line of 100 mm, cut, fold, glue",
                file=path.name,
            ),
        )

    def _ask(self) -> None:
        folder = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)
        start = str(Path(folder) / "acus-pen.pdf")
        answer, _ = QFileDialog.getSaveFileName(self, tr("Save the pen"), start, tr("PDF (*.pdf)"))
        if answer:
            path = Path(answer)
            self.write(path if path.suffix else path.with_suffix(".pdf"))

    def _enable(self) -> None:
        """Let size and lens be chosen where they are not known: a simulated webcam's are."""
        try:
            simulated = self.settings().simulated
        except AcusError:
            simulated = False  # said by the page
        self.size_box.setEnabled(not simulated)
        self.lens.set_simulated(simulated)

    def _take(self, where: Where) -> None:
        """Another pen: its own size; another paper is no other pen."""
        if where == ("pen",):
            with QSignalBlocker(self):
                self.edge.setValue(load_pen(str(self.body.currentData())).body.edge_mm)
        if where != ("paper",):
            self.changed.emit()

    def _add_pen(self, settings: PenSettings) -> None:
        names, usual = shipped_pens(), load_pen(settings.pen).body.edge_mm
        with self.together(title=tr("&Pen")) as line:
            among = [(name, name.capitalize()) for name in names]
            self.body = self.choice("pen", title=tr("&Pen"), among=among)
            self.edge = self.number("edge_mm", within=(10.0, 100.0, usual), decimals=1)
            line.setStretch(1, 1)
        if settings.pen not in names:
            self.body.addItem(Path(settings.pen).stem.capitalize(), settings.pen)
        self.body.setToolTip(
            tr("Cube: five faces, also seen from above. Ring: six faces round the shaft")
        )
        self.edge.setToolTip(tr("Edge of a face. Larger is more accurate, and heavier"))
        self.show_values(dict(settings))

    def _add_print(self) -> None:
        with self.together(title=tr("Print")) as line:
            papers = [(name, name) for name in PAPERS]
            self.paper = self.choice("paper", title=tr("Print"), among=papers)
            self.print = button(tr("Save as PDF to print…"))
            line.addWidget(self.print, 1)
        self.paper.setToolTip(tr("Paper of the printer"))
        self.print.setToolTip(tr("The net of the pen and the sheet for the table, at true size"))

    def _connect(self) -> None:
        self.edited.connect(lambda where, *_: self._take(where))
        for box in (self.source, self.size_box):
            box.currentTextChanged.connect(lambda _: self.changed.emit())
        self.lens.changed.connect(self.changed)
        self.changed.connect(self._enable)
        self.print.clicked.connect(lambda _=False: self._ask())


LOOK_MS: Final = 200
_SIDE: Final = 470
"""Width of the right column [px]."""


class PenDialog(QDialog):
    """Everything about the pen on one page; nothing in it blocks the window.

    Args:
        settings: the present ones.
        services: lists webcams, opens the pen.
        free: waits, in another thread, until nobody else has the webcam.
        used: whether the pen is the needle now.
        parent: the window.

    Signals:
        left(PenSettings, bool): the page was left with these; whether the pen is to be used.
    """

    left = Signal(object, bool)

    def __init__(
        self,
        settings: PenSettings,
        services: Services,
        free: Callable[[], object],
        used: bool,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Pen and webcam: a needle without a robot"))
        self._services, self._free, self._used = services, free, used
        self._pen: PenProfile | None = None
        self._live: PenPort | None = None
        self._opened: PenSettings | None = None
        self._refused = False
        self.preview, self.status, self.tip = LivePreview(self), PenStatus(self), TipStep(self)
        self.choice = PenChoice(settings, services.camera_sources(), self)
        self.use = button(tr("&Use the pen as needle"), "primary")
        self.back = button(tr("Back to the &robot"))
        self.again = button(tr("&Try again"))
        self.close_button = button(tr("Close"))
        self._quiet = QTimer(self, interval=QUIET_MS, singleShot=True)
        self._quiet.timeout.connect(self.reopen)
        self._timer = QTimer(self, interval=LOOK_MS)
        self._timer.timeout.connect(self.poll)
        self._lay_out()
        self._connect()
        self.reopen()
        self._timer.start()

    # --- what is seen -----------------------------------------------------------------------------
    def reopen(self) -> None:
        """Look at what is chosen now, beside the window."""
        self._quiet.stop()
        self.preview.stop()
        self._live, self._pen, self._refused = None, None, False
        try:
            settings = self.choice.settings()
            self._pen = settings.profile()
        except AcusError as error:
            self.tip.set_pen(None, None)
            self.status.show_status(Line(Verdict.BAD, translated(error)), ())
            self.use.setEnabled(False)
            return
        self.use.setEnabled(True)
        self._opened = settings
        self.tip.set_pen(settings, None)
        free, services = self._free, self._services

        def operation(progress: Progress) -> PenPort:
            free()
            return cast("PenPort", services.open_source("pen", settings, progress))

        self.preview.open(operation)
        self.poll()

    def poll(self) -> None:
        """Show how the pen is."""
        live, pen = self._live, self._pen
        if pen is None:
            return
        if live is None or self.preview.camera is None:
            why = tr("the webcam could not be opened") if self._refused else ""
            self.status.show_status(accuracy_line(None, why), status_lines(None, pen, None, 0.0))
            return
        seen, trouble = live.observed(), _trouble(live)
        simulated = self._opened is not None and self._opened.simulated
        lines = status_lines(None if trouble else seen, pen, live.webcam(), live.speed(), simulated)
        self.status.show_status(accuracy_line(seen, trouble), lines)

    def closed(self) -> Callable[[], object]:
        """Return what waits until the webcam is closed; for other threads."""
        return self.preview.closed()

    # --- leaving ----------------------------------------------------------------------------------
    def reject(self) -> None:
        """Escape stops a measurement that runs; else the page is left, the choice remembered."""
        if self.tip.running:
            self.tip.end(tr("stopped, nothing is changed"))
            return
        self._after_question(lambda: self._leave(self._used))

    def done(self, result: int) -> None:
        """Let go of the webcam, whichever way it ends."""
        self._quiet.stop()
        self._timer.stop()
        self.tip.set_pen(None, None)
        self.preview.stop()
        super().done(result)

    def _leave(self, use: bool) -> None:
        try:
            settings = self.choice.settings()
        except AcusError:
            settings = None  # what cannot be used is not remembered
        super().reject()
        if settings is not None:
            self.left.emit(settings, use)

    def _after_question(self, go_on: Callable[[], object]) -> None:
        """Ask about a tip that is measured and not saved, then go on."""
        found, opened = self.tip.found, self._opened
        if found is None or opened is None or opened.simulated:
            go_on()
            return
        buttons = QMessageBox.StandardButton
        box = message_box(self, tr("Measured tip"), tr("Save the measured tip?"))
        box.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)

        def answered(answer: int) -> None:
            box.deleteLater()
            if answer == buttons.Save:
                self.tip.keep()
            if answer == buttons.Discard or (answer == buttons.Save and self.tip.found is None):
                go_on()

        box.finished.connect(answered)
        box.open()

    # --- inside -----------------------------------------------------------------------------------
    def _take(self, live: PenPort) -> None:
        self._live = live
        self.tip.set_pen(self._opened, live)
        self.poll()

    def _refuse(self) -> None:
        self._refused = True
        self.poll()

    def _lay_out(self) -> None:
        self.use.setToolTip(tr("The next attempts are made with the pen, without a robot"))
        self.back.setToolTip(tr("The robot, or the simulated one, holds the needle again"))
        self.back.setVisible(self._used)
        self.use.setText(tr("&Use this pen") if self._used else tr("&Use the pen as needle"))
        self.use.setDefault(True)
        self.again.setToolTip(tr("Open the webcam again, for instance after plugging it in"))
        seen = QVBoxLayout()
        seen.setSpacing(theme.SPACING)
        seen.addWidget(self.preview, 1)
        seen.addWidget(self.status)
        side = QVBoxLayout()
        side.setSpacing(theme.SPACING)
        for title, part in ((tr("Which pen"), self.choice), (tr("Its tip"), self.tip)):
            box = QGroupBox(title, self)
            QVBoxLayout(box).addWidget(part)
            box.setFixedWidth(_SIDE)
            side.addWidget(box)
        side.addStretch(1)
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        pair.addLayout(seen, 1)
        pair.addLayout(side)
        buttons = QHBoxLayout()
        buttons.addWidget(self.again)
        buttons.addStretch(1)
        for one in (self.back, self.use, self.close_button):
            buttons.addWidget(one)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addLayout(pair, 1)
        column.addLayout(buttons)
        size_dialog(self, 1160, 690)

    def _connect(self) -> None:
        self.preview.opened.connect(self._take)
        self.preview.failed.connect(lambda _: self._refuse())
        self.choice.changed.connect(self._quiet.start)
        self.tip.kept.connect(self.reopen)
        self.again.clicked.connect(lambda _=False: self.reopen())
        self.use.clicked.connect(lambda _=False: self._after_question(lambda: self._leave(True)))
        self.back.clicked.connect(lambda _=False: self._after_question(lambda: self._leave(False)))
        self.close_button.clicked.connect(lambda _=False: self.reject())


def _trouble(live: PenPort) -> str:
    """Return what is wrong with webcam or tracker; empty without."""
    statistics = live.statistics()
    wrong = [one for one in statistics.cameras if one.state.value not in ("live", "waiting")]
    return statistics.fault or (wrong[0].text if wrong else "")
