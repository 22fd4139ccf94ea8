"""Sounds of an attempt: depth, target, path, scans, structures and breath, each seen as well.

Cues come from what may be shown (`shown_views.Shown.of`), so an ear is told no more than an eye. A
quantity that stays about a limit does not chatter: who was told that it was passed is told anew
only after it went back by a margin.

They are computed here, told apart by rhythm and direction and not by pitch alone, and played by
pygame-ce's mixer, which is part of the extra `gamepad`. Without it, or without a sound card,
everything is only seen.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from time import monotonic
from typing import Any, ClassVar, Final, Protocol

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from app.core.arrays import FloatArray
from app.core.events import Event
from app.core.extras import not_installed
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.session.machine import State
from app.session.snapshot import Snapshot
from app.views.kit.background import run_in_background
from app.views.kit.roles import EVERYBODY, Role
from app.views.kit.text import literal, tr, translated
from app.views.kit.verdict import StatusItem, Verdict
from app.views.shell.feature import Context, Feature

STEP: Final = 5.0 * MILLIMETRE
"""A needle that goes deeper is heard at every so many [m]."""

MARGIN: Final = 0.2
"""Share of a limit by which a quantity goes back before passing it counts again."""

REST: Final = 0.15
"""A breath rests where the target is back within this share of its way."""

MOVED: Final = 0.5
"""It has begun where the target has gone this share of its way."""

SMALLEST_BREATH: Final = 1.0 * MILLIMETRE
"""Motion of the target below this is no breath [m]."""

LISTENED: Final = frozenset({State.ALIGNING, State.INSERTING, State.HOLDING})
"""States in which the needle is heard."""


class CueKind(StrEnum):
    """What is told."""

    DEEPER = "deeper"
    AT_TARGET = "at_target"
    TOO_DEEP = "too_deep"
    OFF_PATH = "off_path"
    ON_PATH = "on_path"
    SCAN = "scan"
    BREACH = "breach"
    BREATH_RESTS = "breath_rests"
    TOUCHED = "touched"


@dataclass(frozen=True, slots=True)
class Cue:
    """One thing that is told.

    Attributes:
        kind: what.
        depth: of the tip beyond the skin [m]; NaN where nobody measures it.
        share: of the way to the target that is done, 0 to 1.
    """

    kind: CueKind
    depth: float = float("nan")
    share: float = 0.0


class Cues:
    """Finds the cues of one run in its snapshots, in their order."""

    def __init__(self, length: float, off_path: float, at_target: float, along: float) -> None:
        """Begin before the skin.

        Args:
            length: of the planned path [m].
            off_path: distance off the path from which the needle is off it [m].
            at_target: distance off the path within which the tip is at the target [m].
            along: the same along the path [m].
        """
        self._length, self._off_path = length, off_path
        self._at_target, self._along = at_target, along
        self.begin()

    def begin(self) -> None:
        """Forget what was told: another attempt begins."""
        self._step = 0
        self._off = self._arrived = self._deep = False
        self._farthest, self._moved = 0.0, False

    def of(self, snapshot: Snapshot, p_target_at_rest: FloatArray) -> tuple[Cue, ...]:
        """Return what is to be told of a moment, the most urgent first.

        Args:
            snapshot: as it may be shown.
            p_target_at_rest: the plan's target [m], shape (3,).
        """
        if snapshot.state not in LISTENED:
            self.begin()
            return ()
        breath = self._breath(float(np.linalg.norm(snapshot.p_target - p_target_at_rest)))
        if not snapshot.pose.measured:
            return breath
        return (*self._needle(snapshot), *breath)

    def _needle(self, snapshot: Snapshot) -> tuple[Cue, ...]:
        if snapshot.touch is not None:  # no path is to be kept to, and a touch is an event
            return ()
        offset, depth = snapshot.offset, snapshot.pose.depth
        share = min(max(1.0 - offset.remaining / self._length, 0.0), 1.0)
        kinds = []
        too_deep = offset.remaining < -self._along * (1.0 - MARGIN * self._deep)
        if too_deep and not self._deep:
            kinds.append(CueKind.TOO_DEEP)
        self._deep = too_deep
        off = offset.lateral > self._off_path * (1.0 - MARGIN * self._off)
        if off is not self._off and depth > 0.0:
            self._off = off
            kinds.append(CueKind.OFF_PATH if off else CueKind.ON_PATH)
        room = 1.0 + MARGIN * self._arrived
        arrived = offset.arrived(room * self._at_target, room * self._along)
        if arrived and not self._arrived:
            kinds.append(CueKind.AT_TARGET)
        self._arrived = arrived
        step = int(depth // STEP)
        if step > self._step:
            self._step = step
            if not kinds:
                kinds.append(CueKind.DEEPER)
        elif depth < (self._step - MARGIN) * STEP:
            self._step = max(step, 0)
        return tuple(Cue(kind, depth, share) for kind in kinds)

    def _breath(self, shift: float) -> tuple[Cue, ...]:
        self._farthest = max(self._farthest, shift)
        if self._farthest < SMALLEST_BREATH:
            return ()
        if shift > MOVED * self._farthest:
            self._moved = True
        elif self._moved and shift < REST * self._farthest:
            self._moved = False
            return (Cue(CueKind.BREATH_RESTS),)
        return ()


RATE: Final = 44_100
"""Samples a second."""

LOUDEST: Final = 0.6
"""Largest value of a sample before the volume."""

STEPS: Final = 12
"""Pitches from the skin to the target, a semitone apart."""

SHOWN_S: Final = 2.5
"""So long what was heard last is written in the status strip."""

VOLUMES: Final = {"quiet": 0.15, "medium": 0.4, "loud": 1.0}
KEY_ON, KEY_VOLUME = "sounds/on", "sounds/volume"

_WARNS: Final = frozenset({CueKind.OFF_PATH, CueKind.TOO_DEEP, CueKind.BREACH})
_OF_EVENTS: Final = {
    "scan": CueKind.SCAN,
    "breach": CueKind.BREACH,
    "touch": CueKind.TOUCHED,
}


def samples(cue: Cue) -> NDArray[np.int16]:
    """Return the sound of a cue, one channel of int16 at `RATE`, read-only."""
    return _samples(cue.kind, round(STEPS * cue.share) if cue.kind is CueKind.DEEPER else 0)


@lru_cache(maxsize=64)
def _samples(kind: CueKind, step: int) -> NDArray[np.int16]:
    parts = {
        CueKind.DEEPER: ((440.0 * 2.0 ** (step / STEPS), 0.07),),
        CueKind.AT_TARGET: ((659.0, 0.11), (988.0, 0.22)),
        CueKind.TOO_DEEP: ((494.0, 0.12), (330.0, 0.12), (220.0, 0.25)),
        CueKind.OFF_PATH: ((233.0, 0.09), (0.0, 0.05), (233.0, 0.09)),
        CueKind.ON_PATH: ((523.0, 0.09),),
        CueKind.SCAN: ((1760.0, 0.03), (0.0, 0.05), (1760.0, 0.03)),
        CueKind.BREACH: ((165.0, 0.13), (0.0, 0.05), (165.0, 0.13), (0.0, 0.05), (165.0, 0.2)),
        CueKind.TOUCHED: ((784.0, 0.08), (1175.0, 0.18)),
        CueKind.BREATH_RESTS: ((349.0, 0.18), (294.0, 0.3)),
    }[kind]
    whole = np.concatenate([_tone(pitch, seconds) for pitch, seconds in parts])
    found = np.round(32767.0 * LOUDEST * whole).astype(np.int16)
    found.setflags(write=False)
    return found


def _tone(pitch: float, seconds: float) -> FloatArray:
    """One tone that begins and ends without a click; silence at pitch 0 [Hz]."""
    t = np.arange(int(RATE * seconds)) / RATE
    wave = np.sin(2.0 * np.pi * pitch * t) + 0.25 * np.sin(4.0 * np.pi * pitch * t)
    edge = np.minimum(1.0, np.minimum(t, seconds - t) / 0.008)
    result: FloatArray = 0.8 * wave * edge * np.exp(-2.0 * t / seconds)
    return result


class Speaker(Protocol):
    """Plays sounds."""

    def play(self, cue: Cue, volume: float) -> None:
        """Begin a sound; returns at once."""

    def close(self) -> None:
        """Be silent; idempotent."""


class MixerSpeaker:
    """Plays through pygame-ce's mixer; a warning does not wait for what sounds already.

    Raises:
        OSError: if there is nothing to play on; says why.
    """

    def __init__(self) -> None:
        os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
        os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")  # Ctrl+C and SIGTERM stay ours
        try:
            self._mixer: Any = importlib.import_module("pygame").mixer
        except ImportError as error:
            raise not_installed(OSError, "pygame-ce, which plays sounds,", "gamepad") from error
        try:
            self._mixer.init(RATE, -16, 1, 512)
        except Exception as error:  # pygame.error: no card, or a busy one
            raise OSError(f"no sound: {error}") from error

    def play(self, cue: Cue, volume: float) -> None:
        """Begin a sound; returns at once."""
        sound = self._mixer.Sound(buffer=samples(cue).tobytes())
        sound.set_volume(volume)
        channel = self._mixer.find_channel(True)
        if channel is not None:
            channel.play(sound)

    def close(self) -> None:
        """Be silent; idempotent."""
        self._mixer.quit()


def words(cue: Cue) -> str:
    """Say what a sound means."""
    return {
        CueKind.DEEPER: tr("{depth:.0f} mm deep", depth=cue.depth / MILLIMETRE),
        CueKind.AT_TARGET: tr("at the target"),
        CueKind.TOO_DEEP: tr("too deep"),
        CueKind.OFF_PATH: tr("off the path"),
        CueKind.ON_PATH: tr("on the path again"),
        CueKind.SCAN: tr("control scan"),
        CueKind.BREACH: tr("near a structure"),
        CueKind.BREATH_RESTS: tr("the breath rests"),
        CueKind.TOUCHED: tr("target touched"),
    }[cue.kind]


class SoundsFeature(Feature):
    """Plays what is worth a sound, and shows it; *View, Sounds* mutes it and sets how loud.

    Attributes:
        is_on: whether it is heard; it is seen in any case.
        volume: name of how loud, one of `VOLUMES`.
    """

    topic: ClassVar[str] = "sounds"
    place: ClassVar[int] = 150
    roles: ClassVar[frozenset[Role]] = EVERYBODY

    make_speaker: ClassVar[Callable[[], Speaker]] = MixerSpeaker
    """Opens the sound card; may take a while."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._settings = context.shell.settings
        self._speaker: Speaker | None = None
        self._opening, self._why = False, ""
        self._cues: Cues | None = None
        self._last: tuple[float, Cue] | None = None
        self.is_on = str(self._settings.value(KEY_ON, "true")).lower() != "false"
        volume = str(self._settings.value(KEY_VOLUME, "medium"))
        self.volume = volume if volume in VOLUMES else "medium"
        controller = context.conductor.controller
        controller.attached.connect(self._take_run)
        controller.began.connect(lambda _: self._begin())
        controller.snapshot_taken.connect(self._listen)
        controller.event_seen.connect(self._take_event)
        controller.add_items(self.items)
        self.menu = SoundsMenu(context.shell.menu(tr("&View"), tr("Sounds")), self)

    def close(self) -> None:
        """Be silent; idempotent."""
        self._opening, self._cues = True, None  # nothing more is opened
        if self._speaker is not None:
            self._speaker.close()
            self._speaker = None

    def set_on(self, on: bool) -> None:
        """Be heard, or only seen, from now on; remembered."""
        self.is_on = on
        self._settings.setValue(KEY_ON, "true" if on else "false")
        if on:
            self._why = ""  # the card may be free by now
            self._open()

    def set_volume(self, volume: str) -> None:
        """Be so loud, one of `VOLUMES`; remembered. It is heard at once."""
        self.volume = volume
        self._settings.setValue(KEY_VOLUME, volume)
        self._play(Cue(CueKind.ON_PATH))

    @property
    def silence(self) -> str:
        """Return why nothing can be heard; empty while it can, or nobody has tried."""
        return self._why

    def items(self, _: Snapshot) -> tuple[StatusItem, ...]:
        """Write what was told last into the status strip, for those who do not hear it."""
        if self._last is None or monotonic() - self._last[0] > SHOWN_S:
            return ()
        cue = self._last[1]
        verdict = Verdict.WARNING if cue.kind in _WARNS else Verdict.GOOD
        help_text = tr("The last announcement, which can also be heard: View, Sounds.")
        return (StatusItem(verdict, "♪", words(cue), help_text),)

    # --- inside -------------------------------------------------------------------------------
    def _take_run(self) -> None:
        run = self.context.conductor.controller.run
        self._cues, self._last = None, None
        if run is not None:
            rings = run.rings
            self._cues = Cues(run.placed.length, rings[-1], rings[0], run.depth_tolerance)

    def _begin(self) -> None:
        self._last = None
        if self._cues is not None:
            self._cues.begin()
        if self.is_on:
            self._open()

    def _listen(self, snapshot: Snapshot) -> None:
        run = self.context.conductor.controller.run
        if self._cues is not None and run is not None:
            for cue in self._cues.of(snapshot, run.placed.p_target):
                self._tell(cue)

    def _take_event(self, event: Event) -> None:
        kind = _OF_EVENTS.get(event.kind)
        if kind is not None:
            self._tell(Cue(kind))

    def _tell(self, cue: Cue) -> None:
        self._last = (monotonic(), cue)
        self._play(cue)

    def _play(self, cue: Cue) -> None:
        if self.is_on and self._speaker is not None:
            self._speaker.play(cue, VOLUMES[self.volume])

    def _open(self) -> None:
        """Open the sound card beside the window, which it would hold."""
        if self._speaker is None and not self._opening and not self._why:
            self._opening = True
            run_in_background(self, self._opened, self._take_speaker, self._fail)

    def _opened(self, _: Progress) -> Speaker:
        with ONE_AT_A_TIME:
            return type(self).make_speaker()

    def _take_speaker(self, speaker: Speaker) -> None:
        self._opening, self._speaker = False, speaker

    def _fail(self, error: Exception) -> None:
        self._opening, self._why = False, translated(error)


class SoundsMenu:
    """*View, Sounds*: on or mute, and how loud."""

    def __init__(self, menu: QMenu, feature: SoundsFeature) -> None:
        self._feature = feature
        menu.setToolTipsVisible(True)
        self.on: QAction = menu.addAction(tr("Sounds of the attempt"))
        self.on.setCheckable(True)
        self.on.setChecked(feature.is_on)
        self.on.setShortcut(QKeySequence("Ctrl+M"))
        self.on.toggled.connect(feature.set_on)
        menu.addSeparator()
        group = QActionGroup(menu)
        self.volumes: dict[str, QAction] = {}
        names = {"quiet": tr("Quiet"), "medium": tr("Medium"), "loud": tr("Loud")}
        for volume, title in names.items():
            action = group.addAction(menu.addAction(title))
            action.setCheckable(True)
            action.setChecked(volume == feature.volume)
            action.triggered.connect(lambda _=False, volume=volume: feature.set_volume(volume))
            self.volumes[volume] = action
        menu.aboutToShow.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Say what cannot be heard, and why."""
        why = self._feature.silence
        self.on.setToolTip(
            literal(
                why
                or tr(
                    "Depth every 5 mm, the target, the path, scans, structures, the rest of a "
                    "breath. Everything that is heard is written in the status strip too."
                )
            )
        )
