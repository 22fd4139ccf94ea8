"""Breathing moves the target: Lujan's waveform with hysteresis, held on command, or varying.

    shift(t) = b(π t / T) · (A_SI inferior + A_LR left) + b(π t / T - φ) · A_AP anterior,
    b(x) = sin^{2n}(x).

Lujan 1999 writes -A cos^{2n}(π t / T - φ0); φ0 = π/2 starts at the end of exhalation, where the
organ rests longest and the CT is taken. The anterior part lags by φ, so the path is a loop: that is
the hysteresis, out by one way and back by another.
Median amplitudes of the liver: SI 11.9, AP 3.8, LR 1.3 mm.

The model `on_command` breathes the same way and holds the breath when HOLD_BREATH asks for it: the
breath is breathed out, both parts come to rest, and the organ settles within a second where this
hold has it. No two holds have it at the same place: the inter-quartile range of the diaphragm over
several holds is 4.2 mm, of a normal distribution with 3.1 mm (van Kesteren 2022, doi
10.1186/s13014-022-02068-5, who also gives 20 to 30 s for a hold). After `longest` the patient
breathes by himself, whatever is asked; a new hold has to be asked for anew.

No breath is like the one before: in the model `varying` breath k lasts T (1 + c_T y_k) and goes
A (1 + c_A x_k) far, with x and y each autoregressive of first order,

    x_k = ρ x_{k-1} + sqrt(1 - ρ²) ε_k,

drawn beforehand for 256 breaths by seed, so that a run is the same on every machine, and repeated
after them. ρ is 0.295 ± 0.148 of the tidal volume of 33 people at rest (Tobin 1995, doi
10.1164/ajrccm.152.6.8520764); the coefficient of variation of how far the chest goes is 0.18 (0.15
to 0.22), of the period 0.09 (0.08 to 0.12), to 0.23 and 0.11 unobserved (PMC6549521); over 15
minutes 0.33 of the volume and 0.21 of the frequency of 65 people (Tobin 1988). The time finds its
breath in the table, so it is exact at any time, and what is added goes over from one breath to the
next where it is 0: inferior and left at the border, the lagging anterior part φ later.

Driven by time, so declared active: it is not counted in energy balances.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.scene import SETTLING, Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Breathing moves the target",
    "reads": ("time", "dt", "hold_breath"),
    "writes": ("target_shift", "breath"),
    "consumers": ("view target_motion", "score of tip to target"),
    "needs": (),
    "models": {
        "lujan": "sin^2n, lagging along anterior (hysteresis: out one way, back another); exact in"
        " time",
        "on_command": "the same by steps; breathes out and holds on command, never at one place",
        "varying": "sin^2n, the same hysteresis, no breath as long or as deep as the one before;"
        " by seed, exact in time",
    },
    "energy": ("active", "driven by time"),
    "cost_class": "A",
    "parameters": {
        "superior_inferior": (0.0119, "m", 0.0, 0.06, "amplitude towards the feet"),
        "anterior_posterior": (0.0038, "m", 0.0, 0.03, "amplitude towards the front"),
        "left_right": (0.0013, "m", 0.0, 0.03, "amplitude towards the patient's left"),
        "period": (4.0, "s", 0.5, 60.0, "of one breath"),
        "shape": (2.0, "-", 1.0, 10.0, "n of sin^2n: higher rests longer at exhalation"),
        "anterior_lag": (
            0.392699,
            "rad",
            0.0,
            1.5708,
            "hysteresis: phase by which the anterior part lags",
        ),
        "longest": (20.0, "s", 1.0, 120.0, "of a hold; then he has to breathe (on_command)"),
        "spread": (0.003, "m", 0.0, 0.02, "standard deviation of where holds lie (on_command)"),
        "draws": (1.0, "-", 0.0, 1e6, "seed of the holds (on_command) or breaths (varying)"),
        "depth_variation": (0.18, "-", 0.0, 0.4, "sd over mean of how far breaths go (varying)"),
        "period_variation": (0.15, "-", 0.0, 0.4, "sd over mean of how long they last (varying)"),
        "likeness": (0.3, "-", 0.0, 0.99, "correlation of a breath with the one before (varying)"),
    },
    "published": {
        "superior_inferior": (
            0.0051,
            0.0171,
            "liver tracked in 14 patients, PMC5978939",
            (0.0119,),
        ),
        "anterior_posterior": (
            0.0009,
            0.0077,
            "liver tracked in 14 patients, PMC5978939",
            (0.0038,),
        ),
        "left_right": (0.0004, 0.004, "liver tracked in 14 patients, PMC5978939", (0.0013,)),
        "period": (
            2.18,
            6.67,
            "9 to 27.5 breaths a minute, 17.3 in the mean, doi 10.1186/1748-717X-8-248",
            (2.182, 3.468, 6.667),
        ),
        "shape": (1.0, 3.0, "Lujan 1999", (1.0, 3.0)),
        "depth_variation": (0.15, 0.33, "PMC6549521; 65 people at rest, Tobin 1988"),
        "period_variation": (0.08, 0.21, "PMC6549521; 65 people at rest, Tobin 1988"),
        "likeness": (0.147, 0.443, "33 people at rest, doi 10.1164/ajrccm.152.6.8520764"),
    },
}


class _BreathingPlaces(NamedTuple):
    """Constants, when the first breath began [s], and the two displacements [m]."""

    period: int
    shape: int
    lag: int
    start: int
    in_phase_x: int
    in_phase_y: int
    in_phase_z: int
    lagging_x: int
    lagging_y: int
    lagging_z: int


_AT: Final = numbered(_BreathingPlaces)


class _HoldingPlaces(NamedTuple):
    """What `on_command` has behind these: constants, memory; then where its holds lie [m].

    `mode` is one of the four below, `phase` the breath's [rad], `held` how long it is held [s],
    `eased` how far the organ has gone to where the hold has it, `number` the holds so far.
    """

    longest: int
    out_x: int
    out_y: int
    out_z: int
    mode: int = 0
    phase: int = 0
    held: int = 0
    eased: int = 0
    number: int = 0
    refused: int = 0


_BREATHES, _COMES_TO_REST, _HOLDS, _BEGINS = 0, 1, 2, 3
"""Modes: free; breathed out, the anterior part still on its way; held; the first breath after."""

_HOLD: Final = numbered(_HoldingPlaces, len(_AT))
_DRAWS: Final = len(_AT) + len(_HOLD)
_PLACES: Final = 32  # holds before their places repeat
_MOST_SD: Final = 2.0  # a patient who was told how does not hold further off

BREATHS: Final = 256
"""Breaths of `varying` before they repeat."""

_FURTHEST_SD: Final = 2.0  # no breath is shorter, longer, shallower or deeper than so many of them
_ENDS: Final = len(_AT)
_DEPTHS: Final = _ENDS + BREATHS
"""Places of `varying` behind the constants: when each breath ends [s], and how far it goes [-]."""


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array; breathing starts at exhalation at its first tick."""
    left, posterior, superior = binding.scene.R_world_patient.T
    in_phase = values["left_right"] * left - values["superior_inferior"] * superior
    lagging = -values["anterior_posterior"] * posterior
    waveform = packed(
        _AT,
        period=values["period"],
        shape=values["shape"],
        lag=values["anterior_lag"],
        start=np.nan,
        in_phase_x=in_phase[0],
        in_phase_y=in_phase[1],
        in_phase_z=in_phase[2],
        lagging_x=lagging[0],
        lagging_y=lagging[1],
        lagging_z=lagging[2],
    )
    drawn = _drawn(values)
    if binding.model == "varying":
        return np.concatenate([waveform, *drawn])
    way = in_phase + lagging
    length = float(np.linalg.norm(way))
    out = way / length if length > 0.0 else -superior
    holds = np.random.default_rng([int(values["draws"]), 9]).standard_normal(_PLACES)
    places = values["spread"] * np.clip(holds, -_MOST_SD, _MOST_SD)
    holding = packed(
        _HOLD, places, longest=values["longest"], out_x=out[0], out_y=out[1], out_z=out[2]
    )
    return np.concatenate([waveform, holding]) if binding.model == "on_command" else waveform


def _drawn(values: Mapping[str, float]) -> tuple[FloatArray, FloatArray]:
    """Return when each breath of `varying` ends [s], and how far it goes over the mean."""
    random = np.random.default_rng([int(values["draws"]), 11])
    new = random.standard_normal((BREATHS, 2))
    rho, course = values["likeness"], np.empty((BREATHS, 2))
    course[0] = new[0]
    for k in range(1, BREATHS):
        course[k] = rho * course[k - 1] + np.sqrt(1.0 - rho * rho) * new[k]
    course = np.clip(course, -_FURTHEST_SD, _FURTHEST_SD)
    lasts = values["period"] * (1.0 + values["period_variation"] * course[:, 0])
    return np.cumsum(lasts), 1.0 + values["depth_variation"] * course[:, 1]


@njit
def lujan(phase: float, shape: float) -> float:
    """sin^{2n}(phase), in [0, 1]; for a whole n by multiplying, four times faster than a power."""
    square = np.sin(phase) ** 2
    if shape != np.floor(shape):
        return square**shape
    result = square
    for _ in range(int(shape) - 1):
        result *= square
    return result


@njit
def _let_pass(p: FloatArray, asked: bool, dt: float) -> None:
    """Go on by `dt` [s]: the breath's phase, its mode, and how far the hold's place is reached."""
    mode = p[_HOLD.mode]
    if not asked:
        p[_HOLD.refused] = 0.0
    wish = asked and p[_HOLD.refused] == 0.0
    if mode == _HOLDS:
        p[_HOLD.held] += dt
        if p[_HOLD.held] >= p[_HOLD.longest]:
            p[_HOLD.refused] = 1.0
        if not wish or p[_HOLD.refused] > 0.0:
            p[_HOLD.mode], p[_HOLD.phase] = _BEGINS, 0.0
        p[_HOLD.eased] = min(1.0, p[_HOLD.eased] + dt / SETTLING)
        return
    p[_HOLD.eased] = max(0.0, p[_HOLD.eased] - dt / SETTLING)
    p[_HOLD.phase] += np.pi * dt / p[_AT.period]
    phase = p[_HOLD.phase]
    if mode == _COMES_TO_REST:
        if phase >= p[_AT.lag] and p[_HOLD.eased] == 0.0:
            p[_HOLD.mode], p[_HOLD.held] = _HOLDS, 0.0
            p[_HOLD.number] += 1.0
    elif phase >= np.pi:
        p[_HOLD.phase] = phase - np.pi
        p[_HOLD.mode] = _COMES_TO_REST if wish else _BREATHES


@njit
def _on_command(state: FloatArray, p: FloatArray) -> None:
    """Add where the target is now, after letting the time of this tick pass."""
    dt = state[sv.DT]
    if np.isfinite(dt) and dt > 0.0:
        _let_pass(p, state[sv.HOLD_BREATH] > 0.5, dt)
    mode, phase, shape = p[_HOLD.mode], p[_HOLD.phase], p[_AT.shape]
    behind = phase - p[_AT.lag]
    in_phase, lagging = lujan(phase, shape), lujan(behind, shape)
    if mode == _COMES_TO_REST or mode == _HOLDS:  # noqa: SIM109  (compiled)
        in_phase = 0.0
    if (mode == _BEGINS and behind < 0.0) or (mode == _COMES_TO_REST and behind > 0.0):
        lagging = 0.0
    if mode == _HOLDS:
        lagging = 0.0
    s = p[_HOLD.eased]
    draw = max(0, int(p[_HOLD.number]) - 1) % _PLACES
    away = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s) * p[_DRAWS + draw]
    for axis in range(3):
        state[sv.TARGET_SHIFT_X + axis] += (
            in_phase * p[_AT.in_phase_x + axis]
            + lagging * p[_AT.lagging_x + axis]
            + away * p[_HOLD.out_x + axis]
        )


@njit
def _varying(state: FloatArray, p: FloatArray, since: float) -> None:
    """Add where the target is `since` the first breath began [s], each breath of its own."""
    since -= np.floor(since / p[_DEPTHS - 1]) * p[_DEPTHS - 1]
    breath, beyond = 0, BREATHS - 1
    while breath < beyond:  # the first breath that ends later
        middle = (breath + beyond) // 2
        if p[_ENDS + middle] > since:
            beyond = middle
        else:
            breath = middle + 1
    begins = p[_ENDS + breath - 1] if breath > 0 else 0.0
    phase = np.pi * (since - begins) / (p[_ENDS + breath] - begins)
    behind = phase - p[_AT.lag]
    last = breath if behind >= 0.0 else (breath + BREATHS - 1) % BREATHS
    in_phase = p[_DEPTHS + breath] * lujan(phase, p[_AT.shape])
    lagging = p[_DEPTHS + last] * lujan(behind, p[_AT.shape])
    for axis in range(3):
        state[sv.TARGET_SHIFT_X + axis] += (
            in_phase * p[_AT.in_phase_x + axis] + lagging * p[_AT.lagging_x + axis]
        )


@njit
def displace(state: FloatArray, parameters: FloatArray) -> None:
    """Add the displacement of the target to TARGET_SHIFT_*: by command, by a course or a rhythm."""
    if len(parameters) == _DRAWS + _PLACES:
        _on_command(state, parameters)
        return
    time = state[sv.TIME]
    if not np.isfinite(time):
        return
    if np.isnan(parameters[_AT.start]):
        parameters[_AT.start] = time
    if len(parameters) > _DEPTHS:
        _varying(state, parameters, time - parameters[_AT.start])
        return
    breaths = (time - parameters[_AT.start]) / parameters[_AT.period]
    phase = np.pi * (breaths - np.floor(breaths))  # one breath: hours lose no digits
    in_phase = lujan(phase, parameters[_AT.shape])
    lagging = lujan(phase - parameters[_AT.lag], parameters[_AT.shape])
    for axis in range(3):
        state[sv.TARGET_SHIFT_X + axis] += (
            in_phase * parameters[_AT.in_phase_x + axis]
            + lagging * parameters[_AT.lagging_x + axis]
        )


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the displacement of the target to TARGET_SHIFT_*, and say it in BREATH_*."""
    before = (state[sv.TARGET_SHIFT_X], state[sv.TARGET_SHIFT_Y], state[sv.TARGET_SHIFT_Z])
    displace(state, parameters)
    for axis in range(3):
        state[sv.BREATH_X + axis] = state[sv.TARGET_SHIFT_X + axis] - before[axis]
