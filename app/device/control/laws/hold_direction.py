"""Let the robot bring the needle to the path's direction and hold it there: it pushes nobody.

A robot with brakes or winches turns its guide to the path, at a bounded rate and not against a hand
that resists, and stands; the student slides the needle. Guidance by force is then not asked of it:
forces of other laws act where this one asks for nothing, at a dial of 0 or below.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.mechanisms.profile import DeviceProfile

DECLARATION: Final[dict[str, Any]] = {
    "title": "Direction held by the robot",
    "reads": ("assistance", "path"),
    "writes": ("hold",),
    "energy": (
        "dissipative",
        "no force of its own: what a hand stores in held cables it gets back, and reeling at a"
        " bounded rate stops at the force that the hand is cleared for",
    ),
    "parameters": {
        "from_dial": (0.05, "", 0.0, 1.0, "assistance from which the direction is held"),
    },
}


class _Places(NamedTuple):
    """Assistance from which it asks."""

    from_dial: int


_AT: Final = numbered(_Places)


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array."""
    return packed(_AT, from_dial=values["from_dial"])


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return 0: nothing of it leaves through torques [J]."""
    return 0.0


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Ask for the direction to be held."""
    if state[sv.ASSISTANCE] > p[_AT.from_dial]:
        state[sv.HOLD] += 1.0
