"""The energy gauge: what the force laws store, what may still be let out, and the guard.

The passivity guard keeps a tank: every force law declares the energy it stores and how much it may
store at most; that is the tank's size. Energy let out at the motors' port is drawn from it. What a
law would let out beyond is taken out by the guard, which weakens or damps the force.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core import state_vector as sv
from app.session.snapshot import Snapshot
from app.views.kit import theme
from app.views.kit.text import listing, literal, tr
from app.views.kit.verdict import Verdict

LITTLE = 0.1
"""Share of the tank from which on there is little left."""


@dataclass(frozen=True, slots=True)
class EnergyFigures:
    """The energy of one moment; energies in J.

    Attributes:
        stored: what the force laws store now.
        tank: what may still be let out.
        bound: size of the tank; 0 while no guard accounts for energy.
        out: let out at the motors' port since arming; negative: taken in.
        scale: factor of the guard on the torques, 1 while it does not act.
        damping: that the guard adds [N·m·s/rad].
        loss: taken out by the guard since arming.
    """

    stored: float
    tank: float
    bound: float
    out: float
    scale: float
    damping: float
    loss: float

    @property
    def known(self) -> bool:
        """Return whether a guard accounts for the energy."""
        return self.bound > 0.0

    @property
    def acting(self) -> bool:
        """Return whether the guard takes energy out now."""
        return self.known and (self.scale < 1.0 or self.damping > 0.0)

    @property
    def share_left(self) -> float:
        """Share of the tank that may still be let out, 0…1."""
        return min(1.0, max(0.0, self.tank / self.bound)) if self.known else 0.0

    @property
    def share_stored(self) -> float:
        """Return what the laws store as a share of the tank, 0…1."""
        return min(1.0, max(0.0, self.stored / self.bound)) if self.known else 0.0


def energy_figures(snapshot: Snapshot) -> EnergyFigures | None:
    """Energy of a snapshot; None where the robot says nothing, or nothing finite."""
    if snapshot.device is None:
        return None
    slots = [
        sv.POTENTIAL,
        sv.ENERGY_TANK,
        sv.ENERGY_BOUND,
        sv.ENERGY_OUT,
        sv.GUARD_SCALE,
        sv.GUARD_DAMPING,
        sv.GUARD_LOSS,
    ]
    values = snapshot.device.row[slots]
    return EnergyFigures(*values.tolist()) if np.isfinite(values).all() else None


def millijoules(energy: float) -> str:
    """Say an energy [J]; a hand's springs store thousandths."""
    value = 1e3 * energy
    if abs(value) >= 1e3:
        return tr("{joules:.3g} J", joules=energy)
    return tr("{value:.1f} mJ", value=value) if abs(value) < 100 else tr("{v:.0f} mJ", v=value)


def guard_words(figures: EnergyFigures | None) -> tuple[Verdict, str]:
    """Verdict on the guard, and what it does, in words."""
    if figures is None or not figures.known:
        return Verdict.IDLE, tr("no energy account")
    if figures.acting:
        parts = []
        if figures.scale < 1.0:
            parts.append(tr("force at {share:.0f} %", share=100 * max(0.0, figures.scale)))
        if figures.damping > 0.0:
            parts.append(tr("damping added"))
        return Verdict.WARNING, tr("guard acts: {what}", what=listing(parts))
    if figures.share_left < LITTLE:
        return Verdict.WARNING, tr("tank nearly empty")
    return Verdict.GOOD, tr("guard at rest")


def gauge_help() -> str:
    """Say what the gauge shows and what to do."""
    return tr(
        "Energy of the robot's force. Filled: what the force laws store now, as springs do. Line: "
        "what may still be let out to the hand, of the most they have declared. When it runs out, "
        "the guard weakens or damps the force, so that the robot cannot run away; that is no "
        "fault. If it acts often, lower the assistance, or look at the loop's lateness."
    )


_ROW = 19
_BAR = 14
STORED_COLOUR = "#56b4e9"
LEFT_COLOUR = "#f0e442"


class GaugeMode(StrEnum):
    """When the gauge is on the page."""

    AUTO = "auto"
    """With a real robot, and in an attempt in which the guard has acted; among all details only."""
    SHOWN = "shown"
    HIDDEN = "hidden"


class EnergyGauge(QWidget):
    """One bar of the tank's size: the stored energy fills it, a pointer shows what is left."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._figures: EnergyFigures | None = None
        self._shown: tuple[object, ...] = ()
        self._mode, self._real, self._acted = GaugeMode.AUTO, False, False
        self._detailed = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setToolTip(literal(gauge_help()))
        self.show_energy(None)
        self._appear()

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(240, 3 * _ROW + _BAR + 10)

    def set_mode(self, mode: GaugeMode) -> None:
        """Say when the gauge is to be seen."""
        self._mode = mode
        self._appear()

    def set_detailed(self, detailed: bool) -> None:
        """Be there of its own accord among all details, or leave that to the robot's light."""
        self._detailed = detailed
        self._appear()

    def begin(self, real: bool) -> None:
        """Forget whether the guard acted; `real` says whether the robot is one of metal."""
        self._real, self._acted = real, False
        self._appear()

    def _appear(self) -> None:
        auto = self._mode is GaugeMode.AUTO and (self._real or self._acted)
        self.setVisible((auto and self._detailed) or self._mode is GaugeMode.SHOWN)

    def show_energy(self, figures: EnergyFigures | None) -> None:
        """Show a moment; None, or no energy account, shows dashes."""
        self._figures = figures
        if figures is not None and figures.acting and not self._acted:
            self._acted = True
            self._appear()
        known = figures is not None and figures.known
        shares = (round(figures.share_stored, 3), round(figures.share_left, 3)) if figures else ()
        shown = (known, *self.lines, *shares)
        if shown != self._shown:
            self._shown = shown
            self.setAccessibleName(tr("Energy") + ": " + ", ".join(self.lines))
            self.update()

    @property
    def lines(self) -> tuple[str, str, str, str]:
        """Return what is written: stored, left, guard, taken out."""
        figures = self._figures
        verdict, words = guard_words(figures)
        guard = f"{verdict.colour_and_symbol[1]} {words}"
        if figures is None or not figures.known:
            return tr("stored –"), tr("left –"), guard, tr("removed by the guard –")
        return (
            tr("stored {energy}", energy=millijoules(figures.stored)),
            tr(
                "left {tank} of {bound}",
                tank=millijoules(figures.tank),
                bound=millijoules(figures.bound),
            ),
            guard,
            tr("removed {energy}", energy=millijoules(figures.loss)),
        )

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw title with the loss, bar, figures, and what the guard does."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        stored, left, guard, loss = self.lines
        verdict, _ = guard_words(self._figures)
        title = tr("Energy of the force")
        painter.drawText(self._line(0), Qt.AlignmentFlag.AlignLeft, title)
        self._paint_bar(painter, QRectF(1, _ROW + 3, self.width() - 2, _BAR))
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        first, second = self._line(1, _BAR + 8), self._line(2, _BAR + 8)
        painter.setPen(QColor(theme.TEXT))
        painter.drawText(first, Qt.AlignmentFlag.AlignLeft, f"■ {stored}")
        painter.drawText(first, Qt.AlignmentFlag.AlignRight, f"▼ {left}")
        painter.setPen(QColor(theme.TEXT_DIM))
        painter.drawText(self._line(0), Qt.AlignmentFlag.AlignRight, loss)
        painter.setPen(QColor(verdict.colour_and_symbol[0]))
        painter.drawText(second, Qt.AlignmentFlag.AlignLeft, guard)

    def _line(self, number: int, below: int = 0) -> QRectF:
        return QRectF(0, number * _ROW + below, self.width(), _ROW)

    def _paint_bar(self, painter: QPainter, bar: QRectF) -> None:
        painter.setPen(QPen(QColor(theme.BORDER), 1.0))
        painter.setBrush(QColor("#0e1114"))
        painter.drawRoundedRect(bar, 3, 3)
        figures = self._figures
        if figures is None or not figures.known:
            return
        inside = bar.adjusted(1, 1, -1, -1)
        filled = QRectF(inside)
        filled.setWidth(inside.width() * figures.share_stored)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(STORED_COLOUR))
        painter.drawRoundedRect(filled, 2, 2)
        x = inside.left() + inside.width() * figures.share_left
        x = min(max(x, 6.0), self.width() - 6.0)  # full or empty, the pointer is seen whole
        painter.setPen(QPen(QColor(theme.BACKGROUND), 1.0))
        painter.setBrush(QColor(theme.TEXT))
        top = bar.top() - 4
        painter.drawPolygon(
            QPolygonF([QPointF(x - 6, top), QPointF(x + 6, top), QPointF(x, top + 8)])
        )
        painter.setPen(QPen(QColor(theme.TEXT), 2.0))
        painter.drawLine(QPointF(x, top + 6), QPointF(x, bar.bottom()))
