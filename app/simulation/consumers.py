"""Who can consume what the simulation computes: device axes, the simulated hand, views, metrics."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from app.simulation.errors import SimulationError

_FORCE: Final = ("force_x", "force_y", "force_z")
_SHIFT: Final = ("target_shift_x", "target_shift_y", "target_shift_z")

DEVICE_AXES: Final[dict[str, tuple[str, ...]]] = {"lateral": _FORCE, "axial": ("axial_force",)}
"""What a device that can render along an axis reads."""

VIEW_READS: Final[dict[str, tuple[str, ...]]] = {
    "force_gauge": ("axial_force",),
    "target_motion": _SHIFT,
}
"""What views read beyond the needle's pose; a view that is not named here reads none of it."""

METRIC_READS: Final[dict[str, tuple[str, ...]]] = {
    "axial_force": ("axial_force",),
    "moving_target": _SHIFT,
}
"""What metrics read beyond the trajectory and the target at rest."""


@dataclass(frozen=True, slots=True)
class Consumer:
    """Somebody who reads slots: `label` as it stands in a sentence, `reads` in lower case."""

    label: str
    reads: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DevicePort:
    """The device as the compiler sees it.

    Attributes:
        name: of the profile.
        renders: axes it can push along, of `DEVICE_AXES`.
        simulated: whether robot and hand are simulated; then the hand feels the axial force too.
    """

    name: str
    renders: frozenset[str] = frozenset({"lateral"})
    simulated: bool = False

    def __post_init__(self) -> None:
        unknown = sorted(set(self.renders) - set(DEVICE_AXES))
        if unknown:
            raise SimulationError(
                f"device {self.name!r} renders {unknown[0]!r}; "
                f"known axes are {', '.join(DEVICE_AXES)}"
            )

    def consumers(self) -> tuple[Consumer, ...]:
        """Device axes, and the simulated hand if there is one."""
        axes = [
            Consumer(f"device {self.name} renders {axis} force", DEVICE_AXES[axis])
            for axis in sorted(self.renders)
        ]
        hand = [Consumer("the simulated hand feels it along the needle", ("axial_force",))]
        return (*axes, *(hand if self.simulated else []))


def view_consumers(views: Iterable[str | Consumer]) -> tuple[Consumer, ...]:
    """Consumers among the views, by name or given in full."""
    return tuple(
        view
        if isinstance(view, Consumer)
        else Consumer(f"view {view} shows it", VIEW_READS.get(view, ()))
        for view in views
    )


def metric_consumers(metrics: Iterable[str | Consumer]) -> tuple[Consumer, ...]:
    """Consumers among the metrics, by name or given in full."""
    return tuple(
        metric
        if isinstance(metric, Consumer)
        else Consumer(f"metric {metric} scores it", METRIC_READS.get(metric, ()))
        for metric in metrics
    )
