"""The effects of the scene that runs: what each costs, why it is there, by which model it runs."""

from __future__ import annotations

from collections import deque
from typing import Final

from PySide6.QtCore import QRectF, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QComboBox, QFrame, QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from app.session.snapshot import Snapshot
from app.views.accuracy.budget import EffectCost, SceneCost, advice, in_words, lowering, too_much
from app.views.kit import theme
from app.views.kit.parts import button, label
from app.views.kit.text import declared, literal, tr, translated
from app.views.kit.verdict import Verdict, tell
from app.views.kit.wheel import wheel_scrolls

HUES: Final = ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#d55e00", "#0072b2")
"""Okabe and Ito's hues, one for each effect; its part of the bar also stands in its place."""

LATELY: Final = 10.0
"""Time over which missed deadlines are counted [s]."""

FRAME: Final = 1.0 / 60.0
"""A frame of the window has this long [s]."""

WARNING_LINES: Final = 3
"""Lines that the longest warning takes at the panel's width."""

PERIOD: Final = 0.5
"""Words are refreshed this often [s]."""


class BudgetBar(QWidget):
    """What a tick's work consists of: effects in their hues, all else in grey."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._parts: tuple[float, ...] = ()
        self._rest = 0.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(200, theme.px(18))

    def show_parts(self, parts: tuple[float, ...], whole: float) -> None:
        """Show times of effects within the time of a whole tick [s]."""
        self._parts, self._rest = parts, max(whole - sum(parts), 0.0)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the parts one after the other."""
        painter = QPainter(self)
        box, total = QRectF(self.rect()), sum(self._parts) + self._rest
        painter.fillRect(box, QColor(theme.RAISED))
        if total <= 0.0:
            return
        left = box.left()
        for number, part in enumerate((*self._parts, self._rest)):
            width = box.width() * part / total
            last = number == len(self._parts)
            colour = theme.TEXT_DIM if last else HUES[number % len(HUES)]
            painter.fillRect(QRectF(left, box.top(), max(width - 1.0, 1.0), box.height()), colour)
            left += width


class ShareLine(QWidget):
    """What one part of the program takes of the time that it has: words and a bar."""

    def __init__(self, words: str, tip: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words = words
        self._said, self._bar = label("", "dim"), BudgetBar(self)
        self.setToolTip(literal(tip))
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(2)
        rows.addWidget(self._said)
        rows.addWidget(self._bar)
        self.setVisible(False)

    def show_time(self, taken: float, period: float) -> None:
        """Show a time within the period that it has [s]; nothing where it was not measured."""
        self.setVisible(taken > 0.0)
        self._bar.show_parts((taken,), period)
        self._said.setText(
            tr(
                "{what} {taken:.1f} of {period:.0f} ms ({share:.0f} %)",
                what=self._words,
                taken=1e3 * taken,
                period=1e3 * period,
                share=100.0 * taken / period,
            )
        )


class EffectRow(QFrame):
    """One effect.

    Signals:
        chosen(str, str): effect and model.
    """

    chosen = Signal(str, str)

    def __init__(self, effect: EffectCost, hue: str, locked: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.effect = effect
        swatch = QFrame(self)
        swatch.setFixedSize(theme.px(12), theme.px(12))
        swatch.setStyleSheet(f"background: {hue};")
        self.models = QComboBox(self)
        for name in effect.models:
            cost = f" · {in_words(effect.costs[name])}" if name in effect.costs else ""
            self.models.addItem(f"{name}{cost}", name)
            tip = effect.models[name]
            self.models.setItemData(
                self.models.count() - 1, literal(tip), Qt.ItemDataRole.ToolTipRole
            )
        self.models.setCurrentIndex(max(self.models.findData(effect.model), 0))
        self.models.setEnabled(len(effect.models) > 1 and not locked and bool(effect.costs))
        on_pictures = tr(
            "Acts on the cameras' pictures: nothing of a tick; chosen before it begins"
        )
        self.models.setToolTip(
            literal(
                locked
                or (on_pictures if not effect.costs else "")
                or tr(
                    "By which model it is computed, and its time in a tick on this computer; "
                    "another one applies at once"
                )
            )
        )
        self.models.currentIndexChanged.connect(
            lambda _: self.chosen.emit(effect.name, self.models.currentData())
        )
        wheel_scrolls(self.models)
        head = QHBoxLayout()
        head.addWidget(swatch)
        head.addWidget(label(declared(effect.title)), 1)
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, theme.SPACING)
        rows.setSpacing(2)
        rows.addLayout(head)
        rows.addWidget(self.models)
        rows.addWidget(label(effect.why, "dim"))
        for warning in effect.warnings:
            line = label()
            tell(line, Verdict.WARNING, warning)
            rows.addWidget(line)

    def go_back(self) -> None:
        """Show the model that it has: the one that was chosen could not be had."""
        with QSignalBlocker(self.models):
            self.models.setCurrentIndex(max(self.models.findData(self.effect.model), 0))


class EffectsPanel(QWidget):
    """Scene and budget; shows nothing by itself.

    Signals:
        chosen(str, str): an effect shall be computed by a model.
        page_wanted(): what accuracy costs, in all of the program.
    """

    chosen = Signal(str, str)
    page_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows: list[EffectRow] = []
        self._scene: SceneCost | None = None
        self._shown = -1e9
        self._deadlines: deque[tuple[float, int, int]] = deque()
        self._state = label(tr("No exercise runs: begin one to see what it simulates."), "dim")
        self._tick, self._verdict = label(), label()
        self.bar = BudgetBar(self)
        self.lowering = button(tr("Lower it"))
        self.lowering.setToolTip(
            tr("Computes the effect that costs most by its cheapest model, at once")
        )
        self.lowering.clicked.connect(self._lower)
        # A warning comes and goes by itself: what is below stays where it is under the mouse.
        self._verdict.setAlignment(Qt.AlignmentFlag.AlignTop)
        kept = self.lowering.sizePolicy()
        kept.setRetainSizeWhenHidden(True)
        self.lowering.setSizePolicy(kept)
        self.page = button(tr("Cost of accuracy…"))
        self.page.setToolTip(tr("Error against time of every choice in the program"))
        self.page.clicked.connect(self.page_wanted)
        self._frame = ShareLine(
            tr("A frame of the window takes"),
            tr("From the newest state of the needle until all that shows it is painted"),
        )
        self._picture = ShareLine(
            tr("A pair of pictures takes"),
            tr("Finding the marker in both cameras' pictures and the needle from it"),
        )
        self._body = QVBoxLayout()
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        for widget in (self._state, self.bar, self._tick, self._verdict, self.lowering):
            column.addWidget(widget)
        for line in (self._frame, self._picture):
            column.addWidget(line)
        column.addLayout(self._body)
        column.addStretch(1)
        column.addWidget(self.page)
        self.clear()

    def clear(self, words: str = "") -> None:
        """Show no scene, and why."""
        self._scene = None
        self._deadlines.clear()
        self._fill((), {}, "")
        self._state.setText(words or tr("No exercise runs: begin one to see what it simulates."))
        self._state.setVisible(True)
        for widget in (self.bar, self._tick, self._verdict, self.lowering):
            widget.setVisible(False)
        for line in (self._frame, self._picture):
            line.setVisible(False)

    def show_scene(self, scene: SceneCost, locked: str) -> None:
        """Show the effects of the scene that runs.

        Args:
            scene: its effects.
            locked: why the models cannot be chosen; empty if they can.
        """
        self._scene = scene
        self._verdict.ensurePolished()
        line = self._verdict.fontMetrics().lineSpacing()
        self._verdict.setMinimumHeight(WARNING_LINES * line + line // 4)  # signs are taller
        self._fill(scene.effects, dict(scene.left_out), locked)
        self._state.setText(locked or ("" if scene.effects else tr("This scene has no effects.")))
        self._state.setVisible(bool(self._state.text()))
        self._shown = -1e9

    def _fill(self, effects: tuple[EffectCost, ...], left: dict[str, str], locked: str) -> None:
        while (item := self._body.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        self.rows = []
        for number, effect in enumerate(effects):
            row = EffectRow(effect, HUES[number % len(HUES)], locked, self)
            row.chosen.connect(self.chosen)
            self.rows.append(row)
            self._body.addWidget(row)
        for name, why in left.items():
            self._body.addWidget(label(f"{name.replace('_', ' ')}: {translated(why)}", "dim"))

    def go_back(self) -> None:
        """Show the models that the effects have."""
        for row in self.rows:
            row.go_back()

    def show_snapshot(self, snapshot: Snapshot, frame: float = 0.0) -> None:
        """Show what tick, frame and picture take; called at every poll.

        Args:
            snapshot: with the loop's and the tracker's figures.
            frame: time that the window needed for its last frames [s]; 0 if not measured.
        """
        timing, scene = snapshot.timing, self._scene
        if timing is None or scene is None:
            return
        now = snapshot.time
        if self._deadlines and now < self._deadlines[-1][0]:
            self._deadlines.clear()
        self._deadlines.append((now, timing.ticks, timing.missed))
        while len(self._deadlines) > 1 and self._deadlines[0][0] < now - LATELY:
            self._deadlines.popleft()
        if now - self._shown < PERIOD or not self.isVisible():
            return
        self._shown = now
        period, tick = 1.0 / timing.rate_hz, timing.cost
        _, ticks, missed = self._deadlines[0]
        due = timing.ticks - ticks + timing.missed - missed
        share = (timing.missed - missed) / due if due > 0 else 0.0
        parts = tuple(effect.cost for effect in scene.effects)
        self.bar.show_parts(parts, max(tick, sum(parts)))
        words = tr(
            "A tick takes {tick} of {period:.0f} µs ({share:.1f} %); {effects} of it for effects",
            tick=in_words(tick),
            period=1e6 * period,
            share=100.0 * tick / period,
            effects=in_words(sum(parts)),
        )
        self._tick.setText(words)
        trouble = advice(scene.effects, tick, period, share)
        good = tr("held at {rate:.0f} Hz on this computer", rate=timing.rate_hz)
        tell(self._verdict, Verdict.WARNING if trouble else Verdict.GOOD, trouble or good)
        best = lowering(scene.effects, period) if too_much(tick, period, share) else None
        self.lowering.setVisible(best is not None and any(r.models.isEnabled() for r in self.rows))
        for widget in (self.bar, self._tick, self._verdict):
            widget.setVisible(True)
        tracker = snapshot.tracker
        self._frame.show_time(frame, FRAME)
        pictures = tracker is not None and tracker.rate > 0.0
        self._picture.show_time(
            tracker.cost if tracker is not None else 0.0,
            1.0 / tracker.rate if tracker is not None and pictures else FRAME,
        )

    def _lower(self) -> None:
        best = lowering(self._scene.effects) if self._scene is not None else None
        if best is not None:
            self.chosen.emit(best.effect.name, best.model)
