"""What a student chooses for a control scan beside its slices, where the exercise offers it."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QGridLayout,
    QProgressBar,
    QWidget,
)

from app.exercises.guidance import GuidancePart, ScanChoice
from app.imaging.scan_order import MOST_TILT_DEG
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, number, tr

TILT_STEP_DEG = 2.5


class ScanChoices(QWidget):
    """Tube current, tilt of the gantry, leaving the room; each hidden unless it can be chosen.

    Signals:
        changed(): another tilt, and so other slices.
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._guidance = GuidancePart()
        self.current, self.tilt = QComboBox(self), QDoubleSpinBox(self)
        self.leaves = QCheckBox(tr("Leave the room"), self)
        self.way = QProgressBar(self)
        self._current_name = PlainLabel(tr("Current"), self)
        self._tilt_name = PlainLabel(tr("Gantry"), self)
        self._prepare()
        self._lay_out()
        self.set_guidance(self._guidance)

    def set_guidance(self, guidance: GuidancePart) -> None:
        """Offer what an exercise does, with what it proposes."""
        self._guidance, proposed = guidance, guidance.choice
        with QSignalBlocker(self.current):
            self.current.clear()
            for ma in guidance.tube_current:
                self.current.addItem(tr("{ma} mA", ma=number(ma, "g")), ma)
            self.current.setCurrentIndex(self.current.findData(proposed.tube_current_ma))
        self.leaves.setChecked(proposed.leaves)
        with QSignalBlocker(self.tilt):
            self.tilt.setValue(0.0)
        seconds = guidance.leave_room_s
        if seconds is not None:
            self.leaves.setToolTip(
                literal(
                    tr(
                        "Leaving and coming back take {seconds:g} s of the attempt; who stays "
                        "saves them, and his hand gets its share of the scattered radiation (a "
                        "teaching estimate)",
                        seconds=seconds,
                    )
                )
            )
        for widget, offered in (
            (self.current, bool(guidance.tube_current)),
            (self._current_name, bool(guidance.tube_current)),
            (self.tilt, guidance.gantry_tilt),
            (self._tilt_name, guidance.gantry_tilt),
            (self.leaves, seconds is not None),
        ):
            widget.setVisible(offered)
        self.way.hide()
        self.setVisible(bool(guidance.tube_current) or guidance.gantry_tilt or seconds is not None)

    @property
    def choice(self) -> ScanChoice:
        """Return what is chosen now."""
        offered = self._guidance
        current = self.current.currentData() if offered.tube_current else None
        leaves = offered.leave_room_s is not None and self.leaves.isChecked()
        return ScanChoice(current, leaves)

    @property
    def tilt_deg(self) -> float:
        """Return by how much the gantry is tilted [°]."""
        return self.tilt.value() if self._guidance.gantry_tilt else 0.0

    def show_out(self, left: float | None) -> None:
        """Show how long it takes until the student is back [s]; None while he is in the room."""
        self.way.setVisible(left is not None)
        whole = self._guidance.leave_room_s
        if left is None or whole is None:
            return
        self.way.setValue(round(1e3 * (1.0 - min(1.0, left / whole))))
        where = tr("leaving") if left > 0.5 * whole else tr("coming back")
        self.way.setFormat(tr("{where}: {left:.0f} s", where=where, left=left))

    def _prepare(self) -> None:
        self.current.setAccessibleName(tr("Tube current"))
        self.current.setToolTip(
            tr(
                "Noise of the picture goes as one over the square root of the current, the dose "
                "goes as the current"
            )
        )
        self.tilt.setRange(-MOST_TILT_DEG, MOST_TILT_DEG)
        self.tilt.setSingleStep(TILT_STEP_DEG)
        self.tilt.setDecimals(1)
        self.tilt.setSuffix(tr("°"))
        self.tilt.setAccessibleName(tr("Gantry tilt"))
        self.tilt.setToolTip(
            tr(
                "Tilt of the gantry: + leans the front of the slices towards the head. Slices, and "
                "what of the needle lies in them, go along"
            )
        )
        self.way.setRange(0, 1000)
        self.way.setTextVisible(True)
        self.way.setFixedHeight(14)
        for widget in (self.current, self.tilt):
            widget.setFocusPolicy(Qt.FocusPolicy.StrongFocus)  # no wheel by chance
        self.leaves.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.tilt.valueChanged.connect(lambda _: self.changed.emit())

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(4)
        grid.addWidget(self._current_name, 0, 0)
        grid.addWidget(self.current, 0, 1)
        grid.addWidget(self._tilt_name, 1, 0)
        grid.addWidget(self.tilt, 1, 1)
        grid.addWidget(self.leaves, 2, 0, 1, 2)
        grid.addWidget(self.way, 3, 0, 1, 2)
        grid.setColumnStretch(1, 1)
