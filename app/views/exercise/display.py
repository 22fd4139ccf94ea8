"""What the exercise's widgets show of one look at the trainer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from app.exercises.parts import View
from app.session.machine import RUNNING, State
from app.session.snapshot import Snapshot
from app.views.exercise.axial_gauge import AxialGauge, axial_force
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.enable_words import enabling
from app.views.exercise.energy import energy_figures
from app.views.exercise.felt import force_limit
from app.views.exercise.loop_rates import LoopRates
from app.views.exercise.messages import MessageList
from app.views.exercise.panel import ExercisePanel
from app.views.exercise.readings import figures, hand_pose, pad_view, status_items, tracker_figures
from app.views.exercise.run import ExerciseRun
from app.views.exercise.status import StatusStrip
from app.views.exercise.status_items import StatusItem
from app.views.exercise.tracker_panel import TrackerPanel

STATUS_PERIOD: Final = 0.25
"""The status strip is refreshed this often [s]: words that flicker cannot be read."""

FIGURES_PERIOD: Final = 0.1
"""The panel's numbers are refreshed this often [s], and at once when the attempt goes on."""


@dataclass(frozen=True, slots=True, eq=False)
class ExerciseViews:
    """The widgets that the controller feeds."""

    bullseye: Bullseye
    panel: ExercisePanel
    status: StatusStrip
    tracker: TrackerPanel
    messages: MessageList
    gauge: AxialGauge


class ExerciseDisplay:
    """Fills the widgets.

    Attributes:
        rates: of the loop [Hz], and the share of deadlines it missed of late, at the last look.
        extra_items: further lines of the status strip, by whoever else watches; none by default.
    """

    def __init__(self, views: ExerciseViews) -> None:
        self._views = views
        self._status_time = self._figures_time = -1.0
        self._figured: tuple[object, ...] = ()
        self.rates = (0.0, 0.0)
        self.extra_items: list[Callable[[Snapshot], tuple[StatusItem, ...]]] = []
        self._rates = LoopRates()

    def begin(self) -> None:
        """Begin with another trainer."""
        self._rates, self._figured = LoopRates(), ()

    def show_run(self, run: ExerciseRun) -> None:
        """Draw what stays the same during an attempt; nothing of the needle where scans guide."""
        live, shows = run.shown.live, run.shown.shows
        self._views.bullseye.hide_needle(not shows(View.BULLSEYE), beside_scan=not live)
        self._views.bullseye.set_scene(run.scene(), run.interactive, run.is_real)
        self._views.panel.set_forceful(run.forceful)
        self._views.panel.set_guidance(None if live else run.guidance, run.placed.plan)
        self._views.panel.set_offsets(shows(View.BULLSEYE))

    def take_hand(self, snapshot: Snapshot) -> None:
        """Let the simulated hand go on from where the loop has it; draws nothing.

        While the needle is being brought out, the hand of the window goes with it.
        """
        bullseye = self._views.bullseye
        led = snapshot.state is State.WITHDRAWING
        hand = hand_pose(snapshot) if led or bullseye.hand is None else None
        if hand is not None:
            bullseye.take_hand(hand)

    def show(self, run: ExerciseRun, snapshot: Snapshot, now: float, late: float) -> None:
        """Show a snapshot.

        Args:
            run: whose it is.
            snapshot: of its trainer.
            now: time of the look [s].
            late: since the look before [s].
        """
        limit = force_limit(snapshot, run.profile.limits.hand_force)
        self._show_panel(snapshot, limit, not run.shown.live, now)
        self._show_pad(run, snapshot, limit)
        rate, missing = self.rates = self._rates.read(snapshot, now)
        self._show_tracker(run, snapshot, now)
        if now - self._status_time >= STATUS_PERIOD:
            self._status_time = now
            items = status_items(snapshot, rate, missing, late)
            extra = (item for more in self.extra_items for item in more(snapshot))
            self._views.status.show_items((*extra, *items))

    def _show_panel(self, snapshot: Snapshot, limit: float, hidden: bool, now: float) -> None:
        views = self._views
        views.bullseye.source.set_locked(snapshot.state in RUNNING)
        views.panel.withdrawal.show_snapshot(snapshot)
        views.panel.enable.show_enabling(enabling(snapshot, views.panel.enable.is_held))
        figured = snapshot.state, hidden
        if figured == self._figured and 0.0 <= now - self._figures_time < FIGURES_PERIOD:
            return
        self._figured, self._figures_time = figured, now
        views.panel.show_figures(figures(snapshot, limit, hidden))
        views.panel.energy.show_energy(energy_figures(snapshot))

    def _show_pad(self, run: ExerciseRun, snapshot: Snapshot, limit: float) -> None:
        bullseye = self._views.bullseye
        view = pad_view(snapshot, run.profile.geometry.needle_length, limit)
        if view is not None:
            bullseye.show_view(view)
        if run.shown.shows(View.FORCE_GAUGE):
            self._views.gauge.show_force(axial_force(snapshot))

    def _show_tracker(self, run: ExerciseRun, snapshot: Snapshot, now: float) -> None:
        tracker = self._views.tracker
        if tracker.due(now):
            wanted = tracker.overlays
            may = run.inspect is not None and run.shown.shows(View.CAMERAS)
            seen = run.inspect(wanted.mask, wanted.epipolar) if may and run.inspect else None
            tracker.show_tracker(seen, tracker_figures(snapshot), now)
