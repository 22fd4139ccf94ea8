"""Encoder offsets by a jig that holds the needle vertical."""

from typing import ClassVar, Literal

from app.core.arrays import FloatArray
from app.device.commissioning.errors import CommissioningError
from app.device.commissioning.homing import Homing
from app.device.commissioning.results import Step
from app.device.commissioning.routine import Part
from app.mechanisms.pantograph import inverse


class EncoderOffsets(Homing):
    """The needle stands vertical in a jig: P_3 is under the fulcrum, so both angles are known."""

    NAME: ClassVar[Step] = Step.OFFSETS
    TITLE: ClassVar[str] = "Encoder offsets"
    REFERENCE: ClassVar[Literal["stops", "jig"]] = "jig"

    def known(self) -> FloatArray:
        """Joint angles that put P_3 under the fulcrum [rad], shape (2,)."""
        geometry = self._profile.pantograph
        return inverse(geometry, geometry.fulcrum[:2])

    def instruction(self) -> str:
        """Say what the user does to reach the reference pose."""
        return "put the needle into the jig that holds it vertical and confirm"

    def _check(self) -> Part:
        """Lean the needle: both encoders must agree on a pose within the joint's cone."""
        yield from self._ask("take the jig away, lean the needle to any side, hold and confirm")
        angles = yield from self._at_rest("checking; keep it there")
        tilt = self._require_pose(angles, "the pose with the needle leaning")
        limit = self._profile.tilt_limit_deg
        if tilt > limit + 3.0:
            raise CommissioningError(
                f"{self.TITLE}: the angles give a tilt of {tilt:.0f}°, the ball joint allows"
                f" {limit:g}°; an encoder counts the wrong way, or the jig is not vertical"
            )
