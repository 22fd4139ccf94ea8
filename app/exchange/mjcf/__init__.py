"""Machines as MJCF, for simulators that know loops and cables: a file for each kind of machine.

A file is called by the kind of its machine and has `write(profile) -> str`.
"""

from importlib import import_module
from pathlib import Path

from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.mechanisms.profile import DeviceProfile


def kinds() -> tuple[str, ...]:
    """Return the kinds of machine that can be written."""
    files = Path(__file__).parent.glob("*.py")
    return tuple(sorted(file.stem for file in files if file.stem != "__init__"))


def write_mjcf(profile: DeviceProfile) -> str:
    """Return a device profile as MJCF text.

    Raises:
        ConfigurationError: if no machine of its kind can be written.
        MechanismError: if the machine cannot stand in the pose in which it is written.
    """
    if profile.kind not in kinds():
        raise ConfigurationError(
            sentence(
                "device {name} is of kind {kind}; MJCF is written for kind {kinds} alone",
                name=profile.name,
                kind=profile.kind,
                kinds=", ".join(kinds()) or "(none)",
            )
        )
    module = import_module(f"{__name__}.{profile.kind}")
    return str(module.write(profile))
