"""The trial of a force law: see `core.trial`.

It runs in a process of its own, where the package around this file is left out: that would compile
the whole loop.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core import paths, plugin_folders
from app.core import state_vector as sv
from app.core.errors import AcusError, ConfigurationError
from app.core.trial_states import STATES, StageTrial
from app.core.trial_watch import CALL, Watch
from app.device.control import laws
from app.device.control.law import KIND, Law, read_law
from app.mechanisms.profile import DeviceProfile, load_profile

_SHARES: Final = (None, 0.0, 1.0, 0.5, 0.02, 0.3)
"""Of the range of every parameter; None: its defaults."""


def run(path: Path, argument: str, watch: Watch) -> dict[str, Any]:
    """Try the law of a file; see `core.trial.Trial.verdict`."""
    law = read_law(path)
    module = replace(KIND, trial=None).load(law, after=lambda module: laws.check_step(module, law))
    watch.doing("parameters()", CALL)
    arrays = list(_arrays(law, module))
    if not arrays:
        return {"reason": f"{path}: parameters() answers for no values within the declared ranges"}
    writes = [sv.INDEX[name] for name in law.writes]
    reason = StageTrial(path, "step()", module.step, arrays, writes, watch).reason()
    return {"reason": reason, "states": STATES, "shortest": min(map(len, arrays))}


def _profiles(path: Path) -> Iterator[DeviceProfile]:
    """Yield the shipped robots, and those that come in the folder of plug-ins of the law."""
    shared = plugin_folders.folder_of(path)
    for place in (paths.resources(), *((shared.path,) if shared else ())):
        for file in sorted((place / "devices").glob("*.yaml")):
            with suppress(ConfigurationError):  # of somebody else's
                yield load_profile(file)


def _arrays(law: Law, module: Any) -> Iterator[Any]:
    """Arrays of parameters for the defaults, the ends and values between, of each robot."""
    rng = np.random.default_rng(1)
    for profile in _profiles(law.path):
        for share in _SHARES:
            given = {
                key: limit.minimum + share * (limit.maximum - limit.minimum)
                for key, limit in law.parameters.items()
                if share is not None
            }
            for key, limit in law.parameters.items():
                if limit.default is None and key not in given:
                    given[key] = rng.uniform(limit.minimum, limit.maximum)
            with suppress(AcusError):  # values that the law itself refuses
                array = module.parameters(law.checked(given, profile), profile)
                yield np.ascontiguousarray(array, dtype=np.float64).ravel()
