"""What the daily check is judged by: plain values, gathered by whoever has the trainer."""

from dataclasses import dataclass

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.device.readiness import ForceClearance
from app.tracking.picture_quality import PictureQuality


@dataclass(frozen=True, slots=True)
class RobotFacts:
    """The robot now.

    Attributes:
        simulated: whether it is.
        ticking: whether the loop runs.
        homed, signs: whether that was done in this power cycle.
        clearance: how much force it is cleared for; None where nobody tells.
        fault: what holds the force at zero; empty without.
        encoder_age: age of the joint angles [s].
    """

    simulated: bool
    ticking: bool
    homed: bool
    signs: bool
    clearance: ForceClearance | None
    fault: str
    encoder_age: float


@dataclass(frozen=True, slots=True)
class CameraFacts:
    """One camera now.

    Attributes:
        name: in the rig.
        trouble: what is wrong with the stream; empty for pictures that come.
        rate: pictures a second.
        wanted_rate: of the rig's profile.
        quality: of the newest picture; None without one.
        miss: why the marker is not found in it; empty where it is.
    """

    name: str
    trouble: str
    rate: float
    wanted_rate: float
    quality: PictureQuality | None
    miss: str


@dataclass(frozen=True, slots=True, eq=False)
class TouchFacts:
    """A known point that the tip touched.

    Attributes:
        name: of the point.
        p_known: where it is [m], shape (3,), world.
        p_measured: where the cameras had the tip [m], shape (3,).
        radius: 95 % radius of the measured point [m].
        tolerance: distance [m] up to which all is well.
    """

    name: str
    p_known: FloatArray
    p_measured: FloatArray
    radius: float
    tolerance: float = 1.5 * MILLIMETRE

    @property
    def distance(self) -> float:
        """Between both [m]."""
        return float(((self.p_measured - self.p_known) ** 2).sum() ** 0.5)


@dataclass(frozen=True, slots=True, eq=False)
class DailyFacts:
    """Everything at one moment.

    Attributes:
        robot: now.
        cameras: in the rig's order; empty without any.
        residual_px: of the newest fix with a point; None without.
        status: of the newest fix, for people; empty when both cameras give a point.
        radius: 95 % radius of the tip [m]; None without a point.
        touch: None until a point was touched.
        touch_failure: why the last touch could not be used; empty otherwise.
    """

    robot: RobotFacts
    cameras: tuple[CameraFacts, ...]
    residual_px: float | None
    status: str
    radius: float | None
    touch: TouchFacts | None = None
    touch_failure: str = ""
