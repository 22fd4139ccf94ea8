"""The virtual fixture as a value: guidance and repulsion of a loop that a test makes itself."""

from dataclasses import asdict, dataclass
from math import pi

from app.core.parameters import Stage
from app.device.control.laws.fixture import pack, step
from app.mechanisms.profile import DeviceProfile


@dataclass(frozen=True, slots=True)
class VirtualFixture:
    """Guidance and repulsion with one dial, the input `ASSISTANCE`; see `laws.fixture`.

    Attributes:
        stiffness: force at the hub per angle error [N/rad].
        damping: against the hub's velocity across the needle [N·s/m].
        limit: largest force at the hand [N].
        dial_rate: how fast the assistance follows its dial [1/s], so that a click on the dial's
            end does not jerk the hand. Disarming is the way to zero at once.
        repulsion: largest force of the repulsion [N].
        reach: angle at which the repulsion has ended [rad].
        fade_from, fade_to: speed along the repulsion from which it fades, and has ended [m/s].
        tilt_limit: the repulsion ends within it [rad].
    """

    stiffness: float
    damping: float
    limit: float
    dial_rate: float = 4.0
    repulsion: float = 1.5
    reach: float = 0.42
    fade_from: float = 0.05
    fade_to: float = 0.20
    tilt_limit: float = pi

    @classmethod
    def of(cls, profile: DeviceProfile) -> "VirtualFixture":
        """Fixture with the defaults of a device profile."""
        section = profile.fixture
        return cls(
            section.stiffness,
            section.damping,
            profile.limits.hand_force,
            tilt_limit=profile.tilt_limit,
        )

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        return Stage("fixture", step, pack(asdict(self), self.tilt_limit))
