"""What the tracker measures, from where the marker truly is: no pictures are rendered.

Two ways, for attempts in virtual time. `SampledTracker` gives whole fixes by the tracker's own
solver, one after the other. `SampledDepth` is a stage of the loop: it writes the depth that would
be believed into the loop's inputs, with the noise that the first way has at that depth, and costs a
few nanoseconds a tick. `compose.trial` tabulates it with the first.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import dataclass
from math import hypot, inf
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.core.units import MILLIMETRE, MILLISECOND
from app.tracking.fix import NeedleFix
from app.tracking.health import Hiding
from app.tracking.markers.extractor import Centre
from app.tracking.optics.rig import RigProfile
from app.tracking.simulated.picture_effects import Blur, Light, Losses, picture_effects
from app.tracking.simulated.scene import MarkerScene, Scene
from app.tracking.solver import FixSolver, SeenMarker

ALONG_PX: Final = 0.016
ACROSS_PX: Final = 0.027
"""Standard deviation of a marker's centre in one picture [px], along the needle as it is seen and
across it: measured in 1000 pairs of rig `wide` as its cameras deliver them (photons, sRGB, JPEG),
at depths from -15 to 108 mm and tilts up to 40°. Robust figures (1.48 times the median): rare
pictures, further off across the needle (0.04 px with them), are not modelled."""

MISSED: Final = 0.01
"""Share of pictures in which the marker is not found though it is there: 12 of 1000 of them."""

NOISE_GREY: Final = 4.0
"""Noise by that rig's profile; the two grow with it in proportion."""

WIDER: Final = (
    (1.0, 1.4, 1.8, 2.2, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0),
    (1.0, 1.0, 0.99, 0.98, 0.96, 0.79, 0.56, 0.41, 0.03, 0.0),
    (1.0, 1.16, 1.43, 1.78, 2.1, 3.3, 4.8, 6.4, 20.0, 20.0),
)
"""Point spread over the lens' own; share of pictures in which the marker is found; noise of its
centre over the usual. Measured in 300 to 500 pairs a row, as they are delivered, of rig `wide`
(0.7 px), out of focus by 0.7 to 4.1 px."""

DIMMER: Final = (
    (0.1, 0.2, 0.3, 0.6, 1.0, 1.3, 1.6, 1.8, 2.0),
    (0.96, 0.97, 0.99, 1.0, 1.0, 1.0, 1.0, 0.91, 0.71),
    (2.8, 1.94, 1.55, 1.2, 1.0, 0.93, 0.85, 0.85, 0.82),
)
"""Brightness over the rig's; the same two, likewise: of less light fewer photons are counted; what
saturates is refused."""

PROCESSING: Final = 0.005
"""From a pair's arrival to its fix [s]: a followed pair takes 2 to 5 ms of one processor."""


@dataclass(frozen=True, slots=True, eq=False)
class Spoiled:
    """What effects on pictures make of a measurement, where no pictures are made.

    Attributes:
        losses: which pictures a camera loses; None if it loses none.
        found: share of the others in which the marker is still found.
        noise: factor on the noise of its centre.
    """

    losses: Losses | None = None
    found: float = 1.0
    noise: float = 1.0

    @classmethod
    def by(cls, effects: Mapping[str, FloatArray], blur_px: float) -> Spoiled:
        """Return what these do, as `picture_effects` takes them, to cameras of a lens' blur [px].

        By figures that were measured in rendered pictures of the rig `wide`: see `WIDER`, `DIMMER`.
        """
        losses, found, noise = None, 1.0, 1.0
        for _, made in picture_effects(effects):
            if isinstance(made, Losses):
                losses = made
            elif isinstance(made, Blur):
                wider = hypot(blur_px, made.spread) / blur_px
                found *= float(np.interp(wider, WIDER[0], WIDER[1]))
                noise *= float(np.interp(wider, WIDER[0], WIDER[2]))
            elif isinstance(made, Light):
                found *= float(np.interp(made.level, DIMMER[0], DIMMER[1]))
                noise *= float(np.interp(made.level, DIMMER[0], DIMMER[2]))
        return cls(losses, found, noise)

    def misses(self, seed: int) -> Callable[[], bool]:
        """Return what says of picture after picture of one camera whether the marker is missed."""
        random, losses = np.random.default_rng([seed, 8]), copy(self.losses)

        def missed() -> bool:
            lost = losses is not None and losses.next(random.random())
            return lost or (self.found < 1.0 and random.random() >= self.found)

        return missed


class SampledTracker:
    """Fixes as the tracker would give them, from where the marker truly is instead of pictures.

    The band's centre is projected into both cameras by their own models, Gaussian noise is added
    along and across the needle as the picture shows it, and the tracker's own solver makes the fix
    of it: status, covariance and a fix by one camera come from there. A camera does not see a band
    that leaves its picture or that the tube hides, and misses one of a hundred. Of a second camera
    that captures later (`skew_ms`) the tracker takes the pixel at the first's time, as this does.

    Args:
        rig: cameras and needle.
        fulcrum: P_I in world [m], shape (3,).
        scene: what stands before the cameras at a time.
        axis: the needle's direction by the robot at a time; None while it is not known.
        seed: of the noise.
        spoiled: by what acts on the pictures.
    """

    def __init__(
        self,
        rig: RigProfile,
        fulcrum: FloatArray,
        scene: Scene,
        axis: Callable[[float], FloatArray | None],
        seed: int = 0,
        spoiled: Spoiled | None = None,
    ) -> None:
        spoiled = spoiled or Spoiled()
        self._misses = [spoiled.misses(2 * seed + camera) for camera in range(2)]
        self._rig = rig
        self._models = rig.models
        self._fulcrum = fulcrum
        self._scene = scene
        self._axis = axis
        self._solver = FixSolver(rig, fulcrum)
        self._hiding = Hiding(rig.needle)
        self._random = np.random.default_rng([seed, 7])
        self._sd = np.array([ALONG_PX, ACROSS_PX]) * max(rig.noise_grey, 1.0) / NOISE_GREY
        self._sd *= spoiled.noise
        self._delay = rig.latency_ms * MILLISECOND + PROCESSING
        self._next = inf

    def begin(self, now: float) -> None:
        """Capture from `now` [s] on."""
        self._next = now

    def cover(self, until: float) -> None:
        """Let both cameras capture nothing before a time [s]; what is on its way still comes."""
        self._next = max(self._next, until)

    def due(self, now: float) -> list[NeedleFix]:
        """Return the fixes that have come since they were last asked for, at `now` [s]."""
        fixes = []
        while self._next + self._delay <= now + 1e-9:
            fixes.append(self.fix(self._next))
            self._next += 1.0 / self._rig.rate_hz
        return fixes

    def fix(self, time: float) -> NeedleFix:
        """Return the fix of pictures captured at a time [s]."""
        scene = self._scene(time)
        seen = (self._sighting(0, scene), self._sighting(1, scene))
        return self._hiding.judge(self._solver.solve(seen, self._axis(time), time))

    def noiseless(
        self, scene: MarkerScene, axis: FloatArray, cameras: tuple[bool, bool]
    ) -> NeedleFix:
        """Return the fix of pictures without noise; of `cameras` those that find the marker."""
        none = np.zeros(2)
        seen = [self._shown(k, scene, none) if found else None for k, found in enumerate(cameras)]
        return self._solver.solve((seen[0], seen[1]), axis, 0.0)

    def _sighting(self, camera: int, scene: MarkerScene) -> SeenMarker | None:
        noise = self._random.standard_normal(2)
        missed = (self._random.random() < MISSED) | self._misses[camera]()
        return None if missed else self._shown(camera, scene, noise)

    def _shown(self, camera: int, scene: MarkerScene, noise: FloatArray) -> SeenMarker | None:
        """Return what a camera shows; noise in standard deviations along and across the needle."""
        model = self._models[camera]
        if not scene.visible or self._hidden(scene):
            return None
        ends = (scene.p_world, scene.p_world + MILLIMETRE * scene.axis_world)
        uv, found = model.project(np.array(ends))
        (u, v), (u_on, v_on) = uv.tolist()
        width, height = model.image_size
        if not (found.all() and 0.0 <= u <= width - 1.0 and 0.0 <= v <= height - 1.0):
            return None
        length = hypot(u_on - u, v_on - v)
        c, s = ((u_on - u) / length, (v_on - v) / length) if length > 1e-9 else (1.0, 0.0)
        a, b = self._sd * noise
        var_a, var_b = self._sd**2
        mixed = c * s * (var_a - var_b)
        spread = [
            [c * c * var_a + s * s * var_b, mixed],
            [mixed, s * s * var_a + c * c * var_b],
        ]
        centre = np.array([u + c * a - s * b, v + s * a + c * b])
        return SeenMarker(centre, np.array(spread), Centre.BAND)

    def _hidden(self, scene: MarkerScene) -> bool:
        hidden = self._rig.needle.hidden_mm
        beyond = float((scene.p_world - self._fulcrum) @ scene.axis_world) / MILLIMETRE
        return hidden is not None and hidden[0] < beyond < hidden[1]


_DRAWS: Final = 1024
_MISSES: Final = -1.0  # a draw below any share
_WAITING: Final = 32
BOTH, FIRST, SECOND = 0, 1, 2
"""Columns of the table of `SampledDepth`: which cameras find the marker."""


class _SampledDepthPlaces(NamedTuple):
    """Constants, then memory; behind them the fixes on their way, the noise and the table."""

    period: int
    delay: int
    agreeing: int
    forgotten: int
    least: int
    step: int
    rows: int
    drawn: int = 0
    taken: int = 0
    given: int = 0
    next: int = 0
    last: int = 0
    agreed: int = 0
    depth: int = 0
    time: int = 0
    variance: int = 0


_AT: Final = numbered(_SampledDepthPlaces)
_QUEUE: Final = len(_AT)
_NOISE: Final = _QUEUE + 3 * _WAITING
_TABLE: Final = _NOISE + 3 * _DRAWS


@njit
def _capture(state: FloatArray, p: FloatArray) -> None:
    """Take both pictures: the true depth with the noise of the cameras that find the marker."""
    draw = _NOISE + 3 * (int(p[_AT.drawn]) % _DRAWS)
    p[_AT.drawn] += 1.0
    first, second = p[draw + 1] >= MISSED, p[draw + 2] >= MISSED
    depth = state[sv.PLANT_DEPTH]
    row = int((depth - p[_AT.least]) / p[_AT.step] + 0.5)
    row = min(max(row, 0), int(p[_AT.rows]) - 1)
    at = _TABLE + 6 * row
    which = BOTH if first and second else FIRST if first else SECOND
    if not (first or second) or not np.isfinite(p[at + 2 * which]):
        return
    waiting = _QUEUE + 3 * (int(p[_AT.taken]) % _WAITING)
    p[waiting] = depth + p[at + 2 * which] * p[draw]
    p[waiting + 1] = state[sv.TIME]
    p[waiting + 2] = p[at + 2 * which + 1]
    p[_AT.taken] += 1.0


@stage
def sampled_depth(state: FloatArray, p: FloatArray) -> None:
    """Write TRACKED_*: the newest believed depth, its time and its variance."""
    now = state[sv.TIME]
    if p[_AT.next] == 0.0:
        p[_AT.next] = now
    if now >= p[_AT.next] - 1e-9:
        p[_AT.next] += p[_AT.period]
        _capture(state, p)
    while p[_AT.given] < p[_AT.taken]:
        waiting = _QUEUE + 3 * (int(p[_AT.given]) % _WAITING)
        time = p[waiting + 1]
        if time + p[_AT.delay] > now + 1e-9:
            break
        p[_AT.given] += 1.0
        known = p[_AT.last] > 0.0 and time - p[_AT.last] <= p[_AT.forgotten]
        p[_AT.agreed] = min(p[_AT.agreed] + 1.0, p[_AT.agreeing]) if known else 0.0
        p[_AT.last] = time
        believed = p[_AT.agreed] >= p[_AT.agreeing]
        p[_AT.depth], p[_AT.variance] = p[waiting], p[waiting + 2]
        p[_AT.time] = time if believed else 0.0
    state[sv.TRACKED_DEPTH] = p[_AT.depth]
    state[sv.TRACKED_TIME] = p[_AT.time]
    state[sv.TRACKED_VARIANCE] = p[_AT.variance]


@dataclass(frozen=True, slots=True, eq=False)
class SampledDepth:
    """The cameras as a stage of the loop.

    Attributes:
        table: standard deviation of the noise [m] and stated variance [m²] of a depth, by which
            cameras find the marker (`BOTH`, `FIRST`, `SECOND`); infinite where there is no
            measurement; shape (n, 3, 2).
        least: depth of the table's first row [m].
        step: from a row to the next [m].
        period: from pair to pair [s].
        delay: from capture to fix [s].
        agreeing: depths that have to agree with a first one before one is believed.
        forgotten: time without any after which the next is a first one again [s].
    """

    table: FloatArray
    least: float
    step: float
    period: float
    delay: float
    agreeing: int
    forgotten: float

    def stage(self, seed: int, spoiled: Spoiled | None = None) -> Stage:
        """Return the stage, which begins to capture with its first tick; `seed` of its noise.

        Its table has the noise of spoiled pictures already; in which the marker is missed has not.
        """
        random = np.random.default_rng([seed, 7])
        noise = np.column_stack([random.standard_normal(_DRAWS), random.random((_DRAWS, 2))])
        for camera in range(2):
            missed = (spoiled or Spoiled()).misses(2 * seed + camera)
            noise[[missed() for _ in range(_DRAWS)], 1 + camera] = _MISSES
        behind = np.zeros(3 * _WAITING), noise.ravel(), self.table.ravel()
        parameters = packed(
            _AT,
            *behind,
            period=self.period,
            delay=self.delay,
            agreeing=float(self.agreeing),
            forgotten=self.forgotten,
            least=self.least,
            step=self.step,
            rows=float(len(self.table)),
        )
        return Stage("cameras", sampled_depth, parameters)


def cover(cameras: Stage, until: float) -> None:
    """Let the cameras of a stage of `SampledDepth` capture nothing before a time [s]."""
    cameras.parameters[_AT.next] = max(float(cameras.parameters[_AT.next]), until)
