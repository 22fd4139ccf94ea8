"""Who can consume what the simulation computes: device axes, the simulated hand, views, metrics.

Views and metrics declare in their own files what they read; whoever compiles hands them in.
"""

from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.core.state_vector import slots_named
from app.simulation.errors import SimulationError

DEVICE_AXES: Final[dict[str, tuple[str, ...]]] = {
    "lateral": slots_named("force"),
    "axial": slots_named("axial_force"),
}
"""What a device that can render along an axis reads."""


IN_WORDS: Final[dict[str, str]] = {
    "force": "the force across the needle",
    "axial_force": "the force along the needle",
    "target_shift": "the motion of the target",
    "tip_offset": "the bend of the needle",
    "tip_slope": "the bend of the needle",
    "root_curvature": "the bend of the needle",
    "bent_length": "the bend of the needle",
    "indentation": "how far the tip dimples the tissue",
    "punctures": "what the tip has punctured",
    "bone_contact": "whether the tip stands on bone",
    "bone_crossed": "how far the tip is beyond a bone's surface",
    "bone_push": "how bone pushes the tip aside",
    "tissue": "the tissue at the tip",
    "tissue_ahead": "the tissue beyond the wall in front of the tip",
    "wall": "the wall in front of the tip",
    "channel": "whether the tip goes where it has cut",
    "carried": "how breathing moves the tissue at the tip",
    "carried_share": "",
    "breath": "",
    "pictures": "the pictures of simulated cameras",
    "potential": "",
    "gain_work": "",
}
"""What a slot or vector holds, as the window says it; an account of energy is said nowhere."""


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
        pictures: whether simulated cameras take pictures of its needle; None: if it is simulated.
    """

    name: str
    renders: frozenset[str] = frozenset({"lateral"})
    simulated: bool = False
    pictures: bool | None = None

    def __post_init__(self) -> None:
        unknown = sorted(set(self.renders) - set(DEVICE_AXES))
        if unknown:
            raise SimulationError(
                sentence(
                    "device {name!r} renders {unknown_axis!r}; known axes are {device_axes}",
                    name=self.name,
                    unknown_axis=unknown[0],
                    device_axes=", ".join(DEVICE_AXES),
                )
            )

    def consumers(self) -> tuple[Consumer, ...]:
        """Device axes; the simulated hand and the tracker in simulated pictures, if they are."""
        axes = [
            Consumer(f"device {self.name} renders {axis} force", DEVICE_AXES[axis])
            for axis in sorted(self.renders)
        ]
        hand = [Consumer("the simulated hand feels it", ("axial_force",))]
        tracker = [Consumer("the tracker measures in pictures of simulated cameras", ("pictures",))]
        return (
            *axes,
            *(hand if self.simulated else []),
            *(tracker if self.takes_pictures else []),
        )

    @property
    def takes_pictures(self) -> bool:
        """Return whether simulated cameras take pictures of its needle."""
        return self.simulated if self.pictures is None else self.pictures
