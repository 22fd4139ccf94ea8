"""A needle that PLUS, Slicer or another program tracks and tells by OpenIGTLink."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from app.exchange.live.igtl_client import Address

if TYPE_CHECKING:
    from app.compose.tracked_needle import Tracked
    from app.device.control import Table
    from app.exercises.schema import Exercise
    from app.mechanisms.profile import DeviceProfile
    from app.planning.placement import PlacedPlan

DECLARATION: Final[dict[str, Any]] = {
    "title": "A needle that another program tracks, by OpenIGTLink",
    "noun": "a tracked needle",
}


def check(pictures: str) -> None:
    """Look at an address before a window opens.

    Raises:
        LinkAddressError: if it is none.
    """
    Address.of(pictures)


def source(pictures: str) -> Callable[[DeviceProfile], Tracked]:
    """Return what builds the needle that a server tells of: HOST, HOST:PORT, [IPV6]:PORT.

    Raises:
        LinkAddressError: if it is no address.
        ConfigurationError: if the settings file cannot be used.
    """
    from app.compose.tracked_needle import Tracked, load_tracked

    address, settings = Address.of(pictures), load_tracked()
    return lambda profile: Tracked(address, settings, profile)


def replay_table(
    exercise: Exercise,
    placed: PlacedPlan,
    profile: DeviceProfile,
    skill: str | None,
    seed: int,
    simulated: bool,
) -> Table:
    """Return the table of a tick whose joint angles come from a record."""
    from app.compose.pen import pen_table

    return pen_table(exercise, placed, profile, [], skill, seed, simulated)
