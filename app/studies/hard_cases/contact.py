"""Hard cases of what happens along the needle: relaxing tissue, membranes, bone."""

from collections.abc import Callable
from functools import partial
from math import nan
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.simulation.effects import bone_contact, puncture, relaxation
from app.simulation.scene import TissueLayer
from app.studies.hard_cases.case import HardCase, analytic, answers, digits
from app.studies.hard_cases.scene import bound_to, memory_of

_Way = Callable[..., Any]

BONE: Final = TissueLayer("soft", 0.05), TissueLayer("bone", 0.1, rigid=True)


def _relaxing() -> tuple[HardCase, ...]:
    def called(given: tuple[float, ...], way: _Way) -> Any:
        return way(*given)

    return tuple(
        HardCase(
            subsystem="integrators",
            case=f"spring of relaxing tissue after {words}",
            given="2 mm stretched, 0.1 mm on, ticks of 1 ms",
            way=relaxation.exact,
            found=partial(called, digits(f"spring of relaxing tissue after {words}").given),
            reference=digits(f"spring of relaxing tissue after {words}"),
            unit="m",
            bound=1e-18,
            beyond=answers(
                "a tick of no duration only stretches it",
                lambda: relaxation.exact(2e-3, 1e-4, 0.0, 0.5) == 2e-3 + 1e-4,
            ),
        )
        for words in ("a millionth of its time", "a thousand times its time")
    )


def _under_bone() -> tuple[HardCase, ...]:
    def pair(given: tuple[float, ...], way: _Way) -> Any:
        stiffness, damping, mass, tick = given
        return way("exact", stiffness, damping, mass, tick)

    return tuple(
        HardCase(
            subsystem="integrators",
            case=f"bone of {stiffness:g} N/m under {mass:g} kg, exact over 1 ms",
            given="10 N·s/m",
            way=bone_contact.coefficients,
            found=partial(pair, digits(f"bone of {stiffness:g} N/m under {mass:g} kg").given),
            reference=digits(f"bone of {stiffness:g} N/m under {mass:g} kg"),
            unit="1",
            bound=1e-9 if stiffness > 1.0 else 1e-10,
            relative=True,
            beyond=answers("no stiffer than mass / tick²", _capped),
        )
        for stiffness, mass in ((1.0, 0.05), (4e4, 0.05), (5e5, 5.0))
    )


def _capped() -> bool:
    most = bone_contact.coefficients("exact", 0.05 / 1e-6, 10.0, 0.05, 1e-3)
    return bone_contact.coefficients("exact", 1e12, 10.0, 0.05, 1e-3) == most


def _at_bone(way: _Way, depths: list[float]) -> list[float]:
    memory = memory_of("bone_contact", {"damping": 0.0}, bound_to(*BONE, model="exact"))
    found = []
    for depth in depths:
        state = sv.empty_state()
        state[sv.PLANT_DEPTH], state[sv.DT] = depth, 1e-3
        way(state, memory)
        found.append(float(state[sv.AXIAL_FORCE]))
    return found


def _grazed_bone() -> HardCase:
    return HardCase(
        subsystem="effects",
        case="a tip 1 µm above bone feels nothing of it, not even when it leaves",
        given="1 µm above, 0.1 mm beyond and back",
        way=bone_contact.step,
        found=lambda way: _at_bone(way, [0.049999, 0.0501, 0.049999])[::2],
        reference=analytic("no force on the near side", (0.0, 0.0)),
        unit="N",
        bound=0.0,
        beyond=answers(
            "bounded for a depth of 1e300 m and NaN",
            lambda: bool(np.isfinite(_at_bone(bone_contact.step, [0.0, 1e300, nan, 0.06])).all()),
        ),
    )


def _membranes() -> HardCase:
    layers = TissueLayer("a", 0.02), TissueLayer("capsule", 0.1, puncture_force=2.0)

    def largest(way: _Way) -> Any:
        memory = memory_of("puncture", {}, bound_to(*layers))
        most = 0.0
        for k in range(4000):
            state = sv.empty_state()
            state[sv.PLANT_DEPTH] = 0.02 + 1e-5 * k + 1e-6 * (k % 2)
            state[sv.DT] = (0.0, 1e-3, 5e-3)[k % 3]
            way(state, memory)
            most = max(most, float(state[sv.AXIAL_FORCE]))
        return max(most - 2.0, 0.0) + max(1.9 - most, 0.0)

    def lost() -> bool:
        memory = memory_of("puncture", {}, bound_to(*layers))
        found = []
        for depth in (0.0, nan, 1e300, -1e300, 0.03):
            state = sv.empty_state()
            state[sv.PLANT_DEPTH], state[sv.DT] = depth, 1e-3
            puncture.step(state, memory)
            found.append(float(state[sv.AXIAL_FORCE]))
        return bool(np.isfinite(found).all())

    return HardCase(
        subsystem="effects",
        case="a membrane gives way at its force, whatever the ticks and the trembling",
        given="2 N, 40 mm pushed in with 1 µm of tremor, ticks of 0, 1 and 5 ms",
        way=puncture.step,
        found=largest,
        reference=analytic("at most 2 N, and at least 1.9 N of it felt", 0.0),
        unit="N",
        bound=1e-9,
        beyond=answers("bounded for depths of 1e300 m and NaN", lost),
    )


CASES: Final = (*_relaxing(), *_under_bone(), _grazed_bone(), _membranes())
"""Relaxation, bone, membranes."""
