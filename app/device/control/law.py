"""Force laws as a kind of plug-in: what a law's file says about itself.

Apart from `control.laws`, which imports laws: the trial of a law in a process of its own reads its
declaration without the loop around it.
"""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.plugins import (
    ENERGY,
    PARAMETERS,
    SLOTS,
    TEXT,
    WRITES,
    PluginKind,
    StageDeclaration,
    complete,
)
from app.core.trial import Trial
from app.device.errors import LawError
from app.mechanisms.profile import DeviceProfile, load_profile, profile_names


@dataclass(frozen=True, slots=True, kw_only=True)
class Law(StageDeclaration):
    """A force law as its file declares it."""

    def checked(self, given: Mapping[str, float], profile: DeviceProfile) -> dict[str, float]:
        """Complete `given` with the defaults for a device and check every value.

        Raises:
            LawError: for an unknown name, or a value that is no number or out of range; if the law
                lets a robot hold a direction and this one cannot.
        """
        if "hold" in self.writes and not profile.holds_direction:
            able = ", ".join(_holding())
            raise LawError(
                sentence(
                    "law {name!r}: {profile_name} cannot hold a direction by itself, its motors"
                    " push; take the law 'fixture'",
                    name=self.name,
                    profile_name=profile.name,
                )
                + (able and sentence(", or a device that can, such as {able}", able=able))
            )
        return complete(KIND, self, given, profile)


def _holding() -> Iterator[str]:
    """Yield the profiles of robots that hold a direction by themselves."""
    for name in profile_names():
        with suppress(ConfigurationError):  # of somebody else's
            if load_profile(name).holds_direction:
                yield name


KIND: Final[PluginKind[Law]] = PluginKind(
    noun="a force law",
    declares=Law,
    fields={
        "title": TEXT,
        "reads": SLOTS,
        "writes": WRITES,
        "energy": ENERGY,
        "parameters": PARAMETERS,
    },
    error=LawError,
    package="app.device.control.laws",
    folder="laws",
    functions=("parameters", "energy_bound", "step"),
    trial=Trial("app.device.control.law_trial", bare=("app.device.control",)),
)


def read_law(path: Path) -> Law:
    """Read a law's declaration from its source.

    Raises:
        LawError: naming the file and what is missing, unknown or not a literal.
    """
    return KIND.read(path)
