"""Study: in how many substeps the simulated robot is integrated.

The robot `icube` with its needle, alone, held by a hand, and pressed against its tilt stop; the
place of the tool at every tick against the same equations in substeps of 1/256 ms. The method is of
the first order, so the reference is off by a 128th of what substeps of 0.5 ms are.
"""

from collections.abc import Callable
from math import radians, sin, sqrt
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.pantograph import stages
from app.mechanisms.pantograph.kernels import forward_kernel
from app.mechanisms.pantograph.profile import load_pantograph
from app.mechanisms.pantograph.stages import move
from app.simulation.plant import initial_plant, plant_stage
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Substeps of the simulated robot",
    "question": "In how many substeps of a tick must the simulated robot be integrated?",
    "reference": "the same equations in substeps of 1/256 ms, good to 0.001 mm",
}

_TICK: Final = 1e-3
_TICKS: Final = 400
REFERENCE: Final = 2.0**-8 * 1e-3  # [s]
_SUBSTEPS: Final = (1e-3, 0.5e-3, 0.25e-3, 0.125e-3, 0.0625e-3)
_SEEN_MM: Final = 0.1
_TORQUE: Final = 0.05  # [N·m]


@njit
def follow(
    state: FloatArray,
    p: FloatArray,
    links: FloatArray,
    torque: float,
    substep: float,
    track: FloatArray,
) -> None:
    """Run len(track) ticks with a torque that changes its sign every 50 ms; tool points (n, 2)."""
    for k in range(len(track)):
        push = torque if (k // 50) % 2 == 0 else -torque
        state[sv.TIME] += 1e-3
        state[sv.DT] = 1e-3
        state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = push, -0.5 * push
        move(state, p, substep)
        _, track[k, 0], track[k, 1] = forward_kernel(
            state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT], links[0], links[1], links[2], 1.0
        )


def prepared(setting: Setting, substep: float) -> Callable[[], FloatArray]:
    """Return what follows a setting and gives the tool points at every tick [m], (n, 2)."""
    profile, values = load_pantograph("icube"), setting.values
    _, _, parameters = plant_stage(profile, depth=0.060)
    state = sv.empty_state()
    for name, value in initial_plant(profile, (0.0, 0.0, -1.0), 0.060).items():
        state[sv.INDEX[name]] = value
    state[sv.HAND_HOLDS], state[sv.HAND_DEPTH] = values["hand"], 0.060
    state[sv.HAND_X] = state[sv.HAND_Y] = sin(radians(values["tilt_deg"])) / sqrt(2.0)
    track, links = np.empty((_TICKS, 2)), np.array(profile.pantograph.links)

    def run() -> FloatArray:
        follow(state.copy(), parameters.copy(), links, values["torque"], substep, track)
        return track

    return run


def _case(setting: Setting) -> Case:
    true = prepared(setting, REFERENCE)().copy()
    return Case(
        setting,
        lambda found: 1e3 * float(np.linalg.norm(found - true, axis=1).max()),
        _SEEN_MM,
    )


def _way(substep: float) -> Callable[[Case], Prepared]:
    return lambda case: Prepared(prepared(case.data, substep), _TICKS)


STUDY: Final = Study(
    error_label="largest error of the tool point in 0.4 s [mm]",
    ways=tuple(
        Way(
            f"{1e3 * h:g} ms",
            "linearly implicit Euler",
            _way(h),
            f"{round(_TICK / h)} substeps of a tick of 1 ms",
            h,
        )
        for h in _SUBSTEPS
    ),
    settings=(
        Setting("alone", {"hand": 0.0, "tilt_deg": 0.0, "torque": 0.02}),
        Setting("held by a hand", {"hand": 1.0, "tilt_deg": 0.0, "torque": _TORQUE}),
        Setting("turned by a hand", {"hand": 1.0, "tilt_deg": 20.0, "torque": 0.0}),
        Setting("against the stop", {"hand": 1.0, "tilt_deg": 60.0, "torque": 0.0}),
    ),
    case=_case,
    deadline=Limit(50e-6, "50 µs: 5 % of the 1 ms tick"),
    perception=Limit(_SEEN_MM, "0.1 mm on the screen"),
    default="0.5 ms",
    in_use=lambda: called(stages.plant_stage, "SUBSTEP"),
)
