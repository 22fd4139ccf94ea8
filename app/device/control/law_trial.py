"""The trial of a force law: see `core.stage_trial`.

It runs in a process of its own, where the package around this file is left out: that would compile
the whole loop.
"""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from app.core import paths, plugin_folders
from app.core.errors import AcusError, ConfigurationError
from app.core.stage_trial import try_stage, values_tried
from app.core.trial_watch import Watch
from app.device.control import laws
from app.device.control.law import KIND, Law, read_law
from app.mechanisms.profile import DeviceProfile, load_profile


def run(path: Path, argument: str, watch: Watch) -> dict[str, Any]:
    """Try the law of a file; see `core.trial.Trial.verdict`."""
    return try_stage(KIND, read_law(path), laws.check_step, _arrays, watch)


def _profiles(path: Path) -> Iterator[DeviceProfile]:
    """Yield the shipped robots, and those that come in the folder of plug-ins of the law."""
    shared = plugin_folders.folder_of(path)
    for place in (paths.resources(), *((shared.path,) if shared else ())):
        for file in sorted((place / "devices").glob("*.yaml")):
            with suppress(ConfigurationError):  # of somebody else's
                yield load_profile(file)


def _arrays(law: Law, module: Any) -> Iterator[Any]:
    """Yield arrays of parameters for each robot."""
    for number, profile in enumerate(_profiles(law.path)):
        for values in values_tried(law.parameters, number):
            with suppress(AcusError):  # values that the law itself refuses
                yield module.parameters(law.checked(values, profile), profile)
