"""An attempt replayed: its clock, the bar that scrubs it, and the views that follow it.

One moment rules them all: slices along the needle, 3D, bull's-eye and curves show the sample that
the clock stands at. Beside the needle may stand a ghost, dotted in slices and dashed in 3D.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import Final

import numpy as np
from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QComboBox,
    QHBoxLayout,
    QPushButton,
    QSizePolicy,
    QSlider,
    QStackedWidget,
    QStyle,
    QStyleOptionSlider,
    QVBoxLayout,
    QWidget,
)

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.session.motion import Alignment, NeedleMotion, beside, rows_beside
from app.session.review import Review
from app.views.debrief.curves import Line, curves_of
from app.views.debrief.met_marks import MetLayer, MetScene, places_of
from app.views.debrief.path_view import PathView
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import number, tr
from app.views.reading.layouts import BULLSEYE, IN_PLANE, PROBE, SCENE, Layout, ViewGrid
from app.views.scene.display import Display
from app.views.scene.guides import ABLATION, ablation_guides
from app.views.scene.orbit import Orbit
from app.views.scene.renderer import SceneRenderer
from app.views.scene.view import SceneView
from app.views.slices.canvas import SliceCanvas
from app.views.slices.layers import NeedleLayer
from app.views.slices.needle_source import NeedlePlanes, fill_needle_menu
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.plane import SlicePlane
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing
from app.views.slices.zones import ZonesLayer

TICK_MS: Final = 33
"""The replay moves on this often."""

SPEEDS: Final = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)

STEP_S, LEAP_S = 0.1, 2.0
"""What an arrow key moves, alone and with Shift [s]."""

AROUND_MM: Final = {PaneId.IN_PLANE: 110.0, PaneId.PROBE: 60.0}
"""Of the needle's surroundings the slices show so much at first."""

SCENE_HALF_MM: Final = 70.0
"""Half of what the 3D view shows at first."""

FOUR_VIEWS = Layout(
    "debrief",
    (
        (IN_PLANE, (0, 0, 1, 6)),
        (PROBE, (0, 6, 1, 6)),
        (SCENE, (1, 0, 1, 6)),
        (BULLSEYE, (1, 6, 1, 6)),
    ),
)

REPLAY_KEYS: Final = (
    Qt.Key.Key_Left,
    Qt.Key.Key_Right,
    Qt.Key.Key_Home,
    Qt.Key.Key_End,
    Qt.Key.Key_Space,
)
"""Keys that replay on this page, whatever has the keyboard."""


class Replayer(QObject):
    """The clock of a replay.

    Signals:
        moved(float): it stands at another time [s since the first sample].
        changed(): it runs, or stands still.

    Attributes:
        time: where it stands [s].
        end: the last sample [s].
        speed: seconds of the attempt a second.
    """

    moved = Signal(float)
    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.time, self.end, self.speed = 0.0, 0.0, 1.0
        self._at = 0.0
        self._timer = QTimer(self, interval=TICK_MS)
        self._timer.timeout.connect(self.advance)

    @property
    def is_playing(self) -> bool:
        """Return whether it runs."""
        return self._timer.isActive()

    def begin(self, end: float, at: float) -> None:
        """Take another attempt: its end, and where to stand first [s]."""
        self.pause()
        self.end = end
        self.seek(at)

    def seek(self, time: float) -> None:
        """Go to a time [s], kept within the attempt."""
        self.time = min(max(time, 0.0), self.end)
        self._at = monotonic()
        self.moved.emit(self.time)

    def step(self, seconds: float) -> None:
        """Stand still, and go so far on, or back."""
        self.pause()
        self.seek(self.time + seconds)

    def toggle(self) -> None:
        """Play, or pause; from the beginning again where it stands at the end."""
        if self.is_playing:
            self.pause()
            return
        if self.time >= self.end:
            self.seek(0.0)
        self._at = monotonic()
        self._timer.start()
        self.changed.emit()

    def pause(self) -> None:
        """Stand still; idempotent."""
        if self.is_playing:
            self._timer.stop()
            self.changed.emit()

    def advance(self) -> None:
        """Go on by what has passed since the last time; stand still at the end."""
        self.seek(self.time + self.speed * (monotonic() - self._at))
        if self.time >= self.end:
            self.pause()


class ScrubBar(QSlider):
    """A slider over the attempt in milliseconds that goes where one clicks."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMinimumWidth(120)
        self.setAccessibleName(tr("Place in the attempt"))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go there at once; dragging goes on from there."""
        if event.button() is Qt.MouseButton.LeftButton:
            option = QStyleOptionSlider()
            self.initStyleOption(option)
            part = QStyle.SubControl.SC_SliderHandle
            handle = self.style().subControlRect(
                QStyle.ComplexControl.CC_Slider, option, part, self
            )
            room = max(1, self.width() - handle.width())
            at = round(event.position().x() - 0.5 * handle.width())
            self.setValue(QStyle.sliderValueFromPosition(self.minimum(), self.maximum(), at, room))
        super().mousePressEvent(event)


class ReplayBar(QWidget):
    """Play, scrub, speed; what stands beside the needle, and how the slices lie.

    Signals:
        ghost_wanted(object): key of what is to stand beside; None for nothing.
        aligned(str): by what, an `Alignment`.
        laid(bool): whether slices lie along the planned path, else along the needle.
    """

    ghost_wanted = Signal(object)
    aligned = Signal(str)
    laid = Signal(bool)

    def __init__(self, replayer: Replayer, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._replayer = replayer
        self._shown: Callable[[float], float] = float
        self.play, self.slider, self.clock = QPushButton(self), ScrubBar(self), PlainLabel(self)
        self.speed, self.along = QComboBox(self), QComboBox(self)
        self.ghost, self.by = QComboBox(self), QComboBox(self)
        self._prepare()
        self._lay_out()
        self._connect()
        self._show_state()

    def begin(self, shown: Callable[[float], float] = float) -> None:
        """Take the attempt that the clock has now.

        Args:
            shown: turns a time of the replay into what the student's clock showed [s].
        """
        self._shown = shown
        self.setEnabled(self._replayer.end > 0.0)
        self.slider.blockSignals(True)
        self.slider.setRange(0, max(1, round(1e3 * self._replayer.end)))
        self.slider.blockSignals(False)
        self.show_time(self._replayer.time)

    def show_time(self, time: float) -> None:
        """Show where the clock stands [s]."""
        self.slider.blockSignals(True)
        self.slider.setValue(round(1e3 * time))
        self.slider.blockSignals(False)
        now, end = self._shown(time), self._shown(self._replayer.end)
        self.clock.setText(f"{number(now, '.1f')} / {number(end, '.1f')} s")

    def set_ghosts(self, choices: list[tuple[object, str]], chosen: object = None) -> None:
        """Offer what may stand beside the needle: keys with their words."""
        self.ghost.blockSignals(True)
        self.ghost.clear()
        for key, words in ((None, tr("nothing")), *choices):
            self.ghost.addItem(words, key)
        keys = [None, *(key for key, _ in choices)]
        self.ghost.setCurrentIndex(keys.index(chosen) if chosen in keys else 0)
        self.ghost.blockSignals(False)

    def show_alignment(self, possible: bool) -> None:
        """Let one choose by what a ghost is aligned; the ideal path has no time of its own."""
        self.by.setVisible(possible)

    def align_by(self, alignment: Alignment) -> None:
        """Choose by what a ghost is aligned."""
        self.by.setCurrentIndex(self.by.findData(alignment.value))

    def minimumSizeHint(self) -> QSize:
        """Return what it takes with its choices below one another."""
        parts = (self._lies, self._beside, self._first)
        return QSize(max(part.minimumSize().width() for part in parts), self._low)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Set the choices below one another where they have no room side by side."""
        super().resizeEvent(event)
        beside = self._lies.minimumSize().width() + self._beside.minimumSize().width()
        direction = QBoxLayout.Direction
        has_room = beside + self._choices.spacing() <= self.width()
        self._choices.setDirection(direction.LeftToRight if has_room else direction.TopToBottom)

    @property
    def _low(self) -> int:
        """Return the height of its rows as they are now [px]."""
        return super().minimumSizeHint().height()

    # --- inside -----------------------------------------------------------------------------------
    def _prepare(self) -> None:
        for speed in SPEEDS:
            text = {0.25: "¼ ×", 0.5: "½ ×"}.get(speed, number(speed, "g") + " ×")
            self.speed.addItem(text, speed)
        self.speed.setCurrentIndex(SPEEDS.index(1.0))
        self.speed.setToolTip(tr("How fast it is played"))
        self.along.addItem(tr("along the needle"), False)
        self.along.addItem(tr("along the planned path"), True)
        self.along.setToolTip(tr("Where the two slices lie"))
        self.by.addItem(tr("at the same time"), Alignment.TIME.value)
        self.by.addItem(tr("at the same depth"), Alignment.DEPTH.value)
        self.ghost.setToolTip(
            tr("What is shown beside the needle: dotted in slices and curves, dashed in 3D")
        )
        self.by.setToolTip(tr("By what the two attempts are brought together"))
        self.ghost.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.ghost.setMinimumContentsLength(16)
        self.set_ghosts([])
        self.show_alignment(False)
        self.play.setMinimumWidth(theme.px(84))
        self.play.setToolTip(
            tr("Space plays and pauses; the arrows go on and back, with Shift farther; Home, End")
        )
        self.clock.setMinimumWidth(theme.px(104))
        self.clock.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        for widget, name in (
            (self.speed, tr("Speed")),
            (self.along, tr("Slices")),
            (self.ghost, tr("Beside it")),
            (self.by, tr("Aligned")),
        ):
            widget.setAccessibleName(name)

    def _lay_out(self) -> None:
        first, self._choices = QHBoxLayout(), QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._lies, self._beside = QHBoxLayout(), QHBoxLayout()
        self._first = first
        for widget, stretch in ((self.play, 0), (self.slider, 1), (self.clock, 0), (self.speed, 0)):
            first.addWidget(widget, stretch)
        slices, ghost = PlainLabel(tr("Slices"), self), PlainLabel(tr("Beside it"), self)
        for label in (slices, ghost):
            label.setProperty("role", "dim")
        self._choices.setSpacing(theme.SPACING // 2)
        rows: tuple[tuple[QHBoxLayout, tuple[QWidget, ...]], ...] = (
            (self._lies, (slices, self.along)),
            (self._beside, (ghost, self.ghost, self.by)),
        )
        for row, parts in rows:
            for part in parts:
                row.addWidget(part, int(part is self.ghost))
            self._choices.addLayout(row, int(row is self._beside))
        self._lies.addStretch()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 2, 0, 2)
        column.setSpacing(4)
        column.addLayout(first)
        column.addLayout(self._choices)

    def _connect(self) -> None:
        replayer = self._replayer
        self.play.clicked.connect(replayer.toggle)
        self.slider.valueChanged.connect(self._scrub)
        self.speed.currentIndexChanged.connect(self._take_speed)
        self.along.currentIndexChanged.connect(
            lambda _: self.laid.emit(bool(self.along.currentData()))
        )
        self.ghost.currentIndexChanged.connect(
            lambda _: self.ghost_wanted.emit(self.ghost.currentData())
        )
        self.by.currentIndexChanged.connect(lambda _: self.aligned.emit(self.by.currentData()))
        replayer.moved.connect(self.show_time)
        replayer.changed.connect(self._show_state)

    def _take_speed(self, _: int) -> None:
        self._replayer.speed = float(self.speed.currentData())

    def _scrub(self, milliseconds: int) -> None:
        self._replayer.pause()
        self._replayer.seek(1e-3 * milliseconds)

    def _show_state(self) -> None:
        playing = self._replayer.is_playing
        self.play.setText(tr("❚❚ Pause") if playing else tr("▶ Play"))


@dataclass(frozen=True, slots=True, eq=False)
class Ghost:
    """What stands beside an attempt.

    Attributes:
        title: what its tip is called.
        review: the other attempt; None for the ideal path.
    """

    title: str
    review: Review | None = None


@dataclass(frozen=True, slots=True, eq=False)
class PlacedGhost:
    """A ghost brought together with an attempt.

    Attributes:
        needle: where it is at a sample of the attempt; None where it is nowhere.
        lines: its curves, in the order of the plots; None for a plot without one.
        track: its track on the pad, shape (n, 2).
    """

    needle: Callable[[int], NeedleOverlay | None]
    lines: tuple[Line | None, ...]
    track: FloatArray


def placed_ghost(review: Review, ghost: Ghost | None, by: Alignment) -> PlacedGhost:
    """Bring a ghost together with an attempt; the ideal path always by depth."""
    own, nothing = review.motion, np.empty((0, 2))
    if own is None or ghost is None:
        return PlacedGhost(lambda _: None, (), nothing)
    time = review.curves.time
    if ghost.review is None:
        straight = np.where(own.measured, 0.0, np.nan)
        return PlacedGhost(own.ideal, (None, (time, straight), (time, straight)), nothing)
    other = ghost.review.motion
    if other is None:
        return PlacedGhost(lambda _: None, (), nothing)
    rows = rows_beside(own, other, by)

    def needle(row: int) -> NeedleOverlay | None:
        found = other.needle(int(rows[row])) if rows[row] >= 0 else None
        return found if found is not None and found.valid else None

    lines: list[Line] = []
    for curve in curves_of(ghost.review):
        if by is Alignment.TIME:
            shift = float(own.time[own.begin]) - float(other.time[other.begin])
            lines.append((ghost.review.curves.time + shift, curve.values))
        else:
            lines.append((time, beside(curve.values, rows)))
    return PlacedGhost(needle, tuple(lines), ghost.review.track())


class GhostLayer:
    """A ghost over one slice: dotted, its tip a square."""

    def __init__(self, canvas: SliceCanvas) -> None:
        self._layer = NeedleLayer(canvas.drawing, theme.GHOST, theme.GHOST_TIP, z=2.5)
        self._needle: NeedleOverlay | None = None
        self._canvas = canvas
        canvas.add_layer(self, (self._layer.tip,))

    def set_needle(self, needle: NeedleOverlay | None, title: str) -> None:
        """Show another one; None shows none."""
        self._needle, self._layer.title = needle, title
        self._canvas.refresh()

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Put it where it belongs."""
        self._layer.place(self._needle, plane, index)

    def hide(self) -> None:
        """Show nothing."""
        self._layer.hide()


class ReplayViews(QWidget):
    """In-plane and probe's-eye slice, 3D and bull's-eye of the moment that is replayed.

    Slices and 3D are there once the CT of the attempt is; until then a line says what is missing.

    Signals:
        open_wanted(): the CT of the attempt is to be opened.

    Attributes:
        viewing: state of the two slices; their own, not that of the planning CT.
        panes: the two slices.
        scene: the 3D view; None until a CT was shown.
        path: the bull's-eye.
        met, met_scene: marks where the needle met something, over slices and 3D.
    """

    open_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing = Viewing(default_window(), self)
        self.planes = NeedlePlanes(self.viewing, self)
        ids = (PaneId.IN_PLANE, PaneId.PROBE)
        self.panes = tuple(SlicePane(self.viewing, pane, self) for pane in ids)
        self.ghosts = tuple(GhostLayer(pane.canvas) for pane in self.panes)
        self.met = tuple(MetLayer(pane.canvas) for pane in self.panes)
        self.zones = tuple(ZonesLayer(pane.canvas) for pane in self.panes)
        self.met_scene: MetScene | None = None
        self.scene: SceneView | None = None
        self.path = PathView(self)
        self.why, self.open = PlainLabel(self), QPushButton(tr("Open its CT…"), self)
        self._missing = self._notice()
        self._scene_place = QStackedWidget(self)
        panes: dict[str, QWidget] = {str(pane.pane): pane for pane in self.panes}
        self.grid = ViewGrid(
            panes | {SCENE: self._scene_place, BULLSEYE: self.path, "missing": self._missing}, self
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.grid)
        self._review: Review | None = None
        self._ghost_at: Callable[[int], NeedleOverlay | None] = lambda _: None
        self._ghost_title, self._fit_due, self._row = "", False, 0
        self._connect()
        self.show_missing("", False)

    # --- what is shown ----------------------------------------------------------------------------
    @property
    def motion(self) -> NeedleMotion | None:
        """Of the attempt that is shown."""
        return None if self._review is None else self._review.motion

    @property
    def has_ct(self) -> bool:
        """Return whether the CT of the attempt is shown."""
        return self.grid.shown is FOUR_VIEWS

    @property
    def is_settled(self) -> bool:
        """Return whether everything that there is has been drawn."""
        if not self.has_ct:
            return self.open.isVisibleTo(self)
        drawn = all(pane.canvas.is_settled for pane in self.panes)
        seen = self.scene is None or (not self.scene.picture().isNull() and self.scene.is_settled)
        return drawn and seen

    def show_review(self, review: Review | None) -> None:
        """Take another attempt; its CT comes by itself."""
        self._review, self._row = review, 0
        self.set_ghost(lambda _: None, "")
        if review is not None:
            self.path.show_review(review)
            for layer in self.zones:
                layer.set_shown(review.ablation)

    def show_ct(self, volume: Volume) -> None:
        """Show the CT that the attempt was made on, with its plan."""
        review = self._review
        if review is None:
            return
        if self.viewing.volume is not volume:
            self.viewing.set_volume(volume)
        scene = self._own_scene()
        scene.set_volume(volume)
        draft = DraftPlan.of(review.placed.plan)
        radii = tuple(ring / MILLIMETRE for ring in review.rings)
        self.viewing.set_needle(None)
        self.viewing.set_draft(draft)
        self.viewing.set_tolerances(radii)
        self.viewing.set_cursor(review.placed.plan.target_mm)
        scene.set_plan(draft)
        scene.set_tolerances(radii)
        ablation = review.ablation
        scene.set_guides(ABLATION, None if ablation is None else ablation_guides(ablation))
        self._mark_met(review)
        self._look_at_path(scene)
        self._fit_due = True
        if not self.has_ct:
            self.grid.arrange(FOUR_VIEWS)
        self.show_row(self._row)

    def show_missing(self, reason: str, offer: bool) -> None:
        """Say why there are neither slices nor 3D, and offer to open the CT."""
        self.why.setText(reason)
        self.open.setVisible(offer)
        self.viewing.set_needle(None)
        cells = (("missing", (0, 0, 1, 12)), (BULLSEYE, (1, 0, 2, 12)))
        self.grid.arrange(Layout("debrief without CT", cells))

    def show_row(self, row: int) -> None:
        """Show the moment of a sample in every view."""
        motion, self._row = self.motion, row
        if motion is None or not len(motion):
            return
        self.path.show_row(row)
        if not self.has_ct:
            return
        needle = motion.needle(row)
        self._show_target(motion, row)
        if needle is None or self.viewing.needle is None:
            self.viewing.set_needle(needle)
        else:
            self.viewing.follow_needle(needle)
        ghost = self._ghost_at(row)
        for layer in self.ghosts:
            layer.set_needle(ghost, self._ghost_title)
        if self.scene is not None:
            self.scene.set_needle(needle)
            self.scene.set_ghost(ghost)
        if self._fit_due:
            self._fit()

    def set_ghost(self, at: Callable[[int], NeedleOverlay | None], title: str) -> None:
        """Let another needle stand beside the own one: where it was at a sample of the own one."""
        self._ghost_at, self._ghost_title = at, title
        if self.motion is not None:
            self.show_row(self._row)

    def show_surfaces_of(self, other: SceneView) -> None:
        """Show surfaces and structures as another 3D view of the patient has them by now."""
        if self.scene is not None and self.has_ct:
            if self.scene.surfaces is not other.surfaces:
                self.scene.set_surfaces(other.surfaces)
            self.scene.set_structures(other.structures, other.legend)
        for pane in self.panes:
            pane.canvas.refresh()

    def lay_along_path(self, path: bool) -> None:
        """Lay the slices along the planned path, or along the needle."""
        (self.planes.show_path if path else self.planes.follow_needle)()
        self._fit()

    def suit_room(self) -> None:
        """Write everything in the present size of the text."""
        self.viewing.plan_changed.emit()  # names of marks are as large as the text
        self.viewing.needle_changed.emit()
        self._show_words()
        for pane in self.panes:
            pane.canvas.rewrite()

    def forget(self) -> None:
        """Let go of the CT: its patient leaves."""
        self.viewing.forget()
        if self.scene is not None:
            self.scene.set_needle(None)
            self.scene.set_ghost(None)
            self.scene.set_surfaces(None)
            self.scene.set_structures(())
            self.scene.set_plan(DraftPlan())
            self.scene.set_guides(ABLATION, None)
        for marks in (*self.met, self.met_scene):
            if marks is not None:
                marks.set_places(())

    def close_views(self) -> None:
        """Stop what makes pictures; idempotent."""
        self.viewing.pictures.close()
        if self.scene is not None:
            self.scene.close_renderer()

    # --- inside -----------------------------------------------------------------------------------
    def _notice(self) -> QWidget:
        notice = QWidget(self)
        self.why.setWordWrap(True)
        self.why.setAlignment(Qt.AlignmentFlag.AlignCenter)
        column = QVBoxLayout(notice)
        column.addStretch(1)
        column.addWidget(self.why)
        column.addWidget(self.open, 0, Qt.AlignmentFlag.AlignHCenter)
        column.addStretch(1)
        return notice

    def _own_scene(self) -> SceneView:
        """Return the 3D view; it is made when it is needed first."""
        if self.scene is None:
            self.scene = SceneView(SceneRenderer(), self)
            self.scene.set_display(Display(xray=True, organs=False))
            self.scene.maximise_wanted.connect(lambda: self.grid.toggle(self._scene_place))
            self.met_scene = MetScene(self.scene)
            self._scene_place.addWidget(self.scene)
            self.scene.installEventFilter(self)
        return self.scene

    def _mark_met(self, review: Review) -> None:
        places = places_of(review)
        for marks in (*self.met, self.met_scene):
            if marks is not None:
                marks.set_places(places)

    def _look_at_path(self, scene: SceneView) -> None:
        """Look across the path, the entry on top, from where as much of it as can be is seen."""
        plan = self._review.placed.plan if self._review is not None else None
        if plan is None:
            return
        way = (plan.target_mm - plan.entry_mm) / np.linalg.norm(plan.target_mm - plan.entry_mm)
        head = np.array([0.0, 0.0, 1.0]) if abs(way[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
        middle = 0.35 * plan.entry_mm + 0.65 * plan.target_mm
        half = max(SCENE_HALF_MM, 0.75 * plan.length_mm)
        facing = Orbit.towards(head - (head @ way) * way, -way, middle, half)
        scene.set_orbit(facing.turned(20.0, 12.0))

    def _show_target(self, motion: NeedleMotion, row: int) -> None:
        marks = None if self._review is None else self._review.targets(row)
        self.viewing.set_targets(marks)
        if self.scene is not None:
            self.scene.set_targets(marks)
        now = motion.target_mm(row)
        before = self.viewing.target_now_mm
        self.viewing.set_target_now(now)
        moved = (before is None) != (now is None) or (
            before is not None and now is not None and bool(np.abs(before - now).max() > 0.25)
        )
        if moved and self.scene is not None:
            self.scene.set_plan(self.viewing.shown_draft)

    def _fit(self) -> None:
        """Zoom both slices to the needle's surroundings, once they are laid."""
        for pane in self.panes:
            canvas = pane.canvas
            plane = canvas.plane
            if plane is None or canvas.height() < 20:
                return
            canvas.fit()
            camera = canvas.camera
            at = plane.point(self._middle_mm(), canvas.index) if self.planes.shows_path else None
            scale = min(canvas.width(), canvas.height()) / AROUND_MM[pane.pane]
            zoomed = camera.zoomed(scale / camera.scale, camera.x, camera.y)
            if at is not None:
                zoomed = type(camera)(at.x, at.y, zoomed.scale)
            canvas.set_camera(zoomed)
        self._fit_due = False

    def _middle_mm(self) -> np.ndarray:
        target = self.viewing.draft.target_mm
        return np.zeros(3) if target is None else np.asarray(target)

    def _connect(self) -> None:
        self.open.clicked.connect(self.open_wanted)
        for pane in self.panes:
            pane.maximise_wanted.connect(lambda pane=pane: self.grid.toggle(pane))
            pane.canvas.seen.connect(self._watch)
            pane.menu_parts.append(lambda menu: fill_needle_menu(menu, self.planes, self.viewing))
            for widget in (pane, pane.canvas):
                widget.installEventFilter(self)
        self.planes.changed.connect(self._show_words)
        self._show_words()

    def _watch(self) -> None:
        self.planes.set_watched(any(pane.isVisible() for pane in self.panes))
        if self._fit_due:
            QTimer.singleShot(0, self, self._fit)

    def _show_words(self) -> None:
        for pane in self.panes:
            pane.readouts.set_note(self.planes.words(), self.planes.laid_along)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Leave the keys of the replay to the page: here they are not the slices' own."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            plain = not event.modifiers() & ~Qt.KeyboardModifier.ShiftModifier
            if plain and event.key() in REPLAY_KEYS:
                event.ignore()
                return True
        return super().eventFilter(watched, event)
