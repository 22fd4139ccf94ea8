"""Force laws, one file each. See 'How to add a force law' in docs/extending.md.

Only the laws that are asked for are imported (`core.plugins`). A law that is not the program's own
is tried before (`control.law_trial`).

A request names a law and the parameters that differ from its defaults: `{"fixture": {}}`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

import numpy as np

from app.core.compiled import is_stage
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.control.law import KIND, Law
from app.device.errors import LawError
from app.mechanisms.profile import DeviceProfile

Requests = Mapping[str, Mapping[str, float]]
"""Law -> parameters that replace its defaults."""


def law_names() -> tuple[str, ...]:
    """Names of all laws, sorted."""
    return KIND.names()


def declaration(name: str) -> Law:
    """Read what a law says about itself, without importing it.

    Raises:
        LawError: for an unknown name, listing the known ones; for a name that two files have; for
            a broken file, naming it and what is wrong.
    """
    return KIND.find(name)


def stages_of(requests: Requests, profile: DeviceProfile) -> list[Stage]:
    """Return (name, function, parameters) of the laws asked for, in their order.

    Raises:
        LawError: for an unknown law or parameter, a broken file, or values that make no sense.
    """
    return [_stage(name, given, profile) for name, given in requests.items()]


def energy_bounds(requests: Requests, profile: DeviceProfile) -> dict[str, float]:
    """Return the most energy that each law asked for can store on a device [J].

    Raises:
        LawError: as `stages_of`; if a law's own bound is no finite number of 0 or more.
    """
    return {name: _bound(name, given, profile) for name, given in requests.items()}


def energy_bound(requests: Requests, profile: DeviceProfile) -> float:
    """Return the most energy that all laws asked for can store together on a device [J].

    Raises:
        LawError: as `energy_bounds`.
    """
    return sum(energy_bounds(requests, profile).values())


def files() -> list[Path]:
    """Files of all laws: the program's own, appended folders', then the user's."""
    return KIND.files()


def _stage(name: str, given: Mapping[str, float], profile: DeviceProfile) -> Stage:
    law = declaration(name)
    values, module = law.checked(given, profile), _implementation(law)
    with KIND.blamed(law.path, "parameters() does not work"):
        array = np.ascontiguousarray(module.parameters(values, profile), dtype=np.float64)
    if array.ndim != 1 or array.size < _shortest(law):
        raise LawError(
            sentence(
                "{law_path}: parameters() gives an array of the shape {array_shape} for these "
                "values; give one of the shape (n,), and of {shortest} numbers at least, as it "
                "was tried",
                law_path=law.path,
                array_shape=array.shape,
                shortest=_shortest(law),
            )
        )
    return Stage(name, module.step, array)


def _bound(name: str, given: Mapping[str, float], profile: DeviceProfile) -> float:
    law = declaration(name)
    module, values = _implementation(law), law.checked(given, profile)
    with KIND.blamed(law.path, "energy_bound() does not work"):
        bound = float(module.energy_bound(values, profile))
    if not 0.0 <= bound < math.inf:
        raise LawError(
            sentence(
                "{law_path}: energy_bound is {bound} J; give a finite number of 0 or more",
                law_path=law.path,
                bound=bound,
            )
        )
    return bound


def is_own(law: Law) -> bool:
    """Return whether a law is one of the program's own."""
    return KIND.is_own(law.path)


def refused() -> dict[Path, str]:
    """Files of force laws that cannot be used, and why; they are left where they are."""
    return KIND.refused()


def check_step(module: ModuleType, law: Law) -> None:
    """Check that a law's step is compiled.

    Raises:
        LawError: if it is not.
    """
    if not is_stage(module.step):
        raise LawError(
            sentence(
                "{law_path}: step is not compiled; put @stage of core.compiled before it",
                law_path=law.path,
            )
        )


def _shortest(law: Law) -> int:
    """Length of the shortest array that a law was tried with; 0 for the program's own."""
    if is_own(law) or KIND.trial is None:
        return 0
    return int(KIND.trial.verdict(law.path).get("shortest", 0))


def _implementation(law: Law) -> ModuleType:
    """Import a law's file, once; one that is not the program's own is tried first."""
    return KIND.load(law, after=lambda module: check_step(module, law))
