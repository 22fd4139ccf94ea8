"""Hard cases of the ball joints: through the play in one step, trembling in it, encoder counts."""

from collections.abc import Callable, Mapping
from math import cos, nan, sin
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import ball_joint
from app.simulation.scene import Binding, Scene
from app.studies.hard_cases.case import HardCase, analytic, answers, digits
from app.studies.hard_cases.scene import memory_of

_Way = Callable[..., Any]
LEVER: Final = 0.14
PRINTED: Final = {"design": float(ball_joint.PRINTED)}


def joint(law: str, given: Mapping[str, float] | None = None) -> FloatArray:
    """Return a fresh parameters array of printed ball joints that follow a law."""
    return memory_of(
        "ball_joint", PRINTED | dict(given or {}), Binding(Scene(), sv.PLANT_DEPTH, law)
    )


def _tilted(way: _Way, memory: FloatArray, tilt: float) -> FloatArray:
    state = sv.empty_state()
    state[sv.AXIS_X], state[sv.AXIS_Z] = sin(tilt), -cos(tilt)
    state[sv.L_OUT], state[sv.DT] = LEVER, 1e-3
    way(state, memory)
    return state


def _through_the_play() -> HardCase:
    reference = digits("tilt of a ball joint from one edge of its play against the other")
    z, way_of_tilt, play, level, stiffness = reference.given

    def found(way: _Way) -> float:
        end = way((z, 0.0, 0.0), (-way_of_tilt, 0.0, 0.0), play, level, stiffness)
        return float(ball_joint.moment(end, play, level, stiffness)[0])

    def none() -> bool:
        free = ball_joint.creep((0.0, 0.0, 0.0), (1e300, 0.0, 0.0), play, level, 0.0)
        return not any(ball_joint.moment(free, play, level, 0.0))

    return HardCase(
        subsystem="integrators",
        case="ball joint tilted in one step off its play, through it and against the other edge",
        given="30 mrad, play ± 2.2 mrad, g = 40 mN·m, σ = 4 N·m/rad",
        way=ball_joint.creep,
        found=found,
        reference=reference,
        unit="N·m",
        bound=1e-14,
        beyond=answers("no moment without a stiffness", none),
    )


def _any_tilt() -> bool:
    found = []
    for law in ("kikuuwe", "dahl", "lugre"):
        memory = joint(law)
        for tilt in (0.0, 1.5, -1.5, nan, 5e-324, 1e-320, 0.3):
            found.append(_tilted(ball_joint.step, memory, tilt)[sv.FORCE])
    most = 1.3 * 2.0 * 0.4 * 5.0 * ball_joint.PRINTED_RADIUS / LEVER
    return bool(np.isfinite(found).all() and np.linalg.norm(found, axis=1).max() <= most + 1e-12)


def _trembling() -> tuple[HardCase, ...]:
    def given_out(way: _Way, law: str) -> float:
        """Most that a hub which trembles through the play gives out beyond what it stores [J]."""
        memory, before, work, least, most = joint(law), None, 0.0, 0.0, 0.0
        play = 2.0 * 1e-4 / 0.09
        for k in range(4000):
            # Into one edge first; then to and fro over both, by more and by less.
            tilt = 1e-4 * min(k, 100) - (k > 100) * play * (1.0 + sin(1.9 * k)) * (k % 7)
            state = _tilted(way, memory, tilt)
            now = -LEVER * state[sv.AXIS], state[sv.FORCE].copy()
            if before is not None:
                work += float(0.5 * (now[1] + before[1]) @ (now[0] - before[0]))
                least, most = min(least, work), max(most, work - least)
            before = now
        return max(most - ball_joint.energy_bound(memory), 0.0)

    return tuple(
        HardCase(
            subsystem="effects",
            case=f"a hand that trembles in the play of a ball joint gains nothing, {law}",
            given="4000 ticks, up to six plays a tick",
            way=ball_joint.step,
            found=lambda way, law=law: given_out(way, law),
            reference=analytic("given out - g²/(2σ) - g times the play ≤ 0", 0.0),
            unit="J",
            bound=0.0,
            beyond=answers("bounded by the level for any tilt and NaN", _any_tilt),
        )
        for law in ("kikuuwe", "dahl", "lugre")
    )


def _count_edge() -> HardCase:
    def changes(way: _Way) -> float:
        """Sign changes of the force in 2 s on the edge of an encoder count."""
        memory = joint("kikuuwe")
        random = np.random.default_rng(4)
        for k in range(200):
            _tilted(way, memory, ball_joint.COUNT * np.floor(0.5 * k))
        signs = []
        for _ in range(2000):
            tilt = ball_joint.COUNT * (99.0 + np.floor(random.normal(0.5, 0.3)))
            signs.append(np.sign(_tilted(way, memory, float(tilt))[sv.FORCE_X]))
        return float(np.count_nonzero(np.diff(signs)))

    return HardCase(
        subsystem="effects",
        case="a still hand on the edge of an encoder count keeps the sign of the joints' force",
        given="2 s, counts of 0.37 mrad, printed joint",
        way=ball_joint.step,
        found=changes,
        reference=analytic("no change", 0.0),
        unit="changes",
        bound=0.0,
        beyond=answers("bounded by the level for any tilt and NaN", _any_tilt),
    )


CASES: Final = (_through_the_play(), *_trembling(), _count_edge())
"""Ball joints."""
