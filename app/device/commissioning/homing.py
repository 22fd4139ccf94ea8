"""Homing: the joint angles at a known pose, by the hard stops."""

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.device.commissioning.results import Homing, RoutineName
from app.device.commissioning.routine import Part, Routine, Script
from app.device.control.loop import Loop
from app.device.errors import CommissioningError
from app.mechanisms.errors import MechanismError
from app.mechanisms.profile import DeviceProfile

if TYPE_CHECKING:
    from app.device.control.corrections import Corrections

_UPRIGHT_DEG = 15.0


class HomingRoutine(Routine):
    """Bring both links to the profile's home pose; the encoders' offsets follow from it.

    The new offsets are used at once, so that the check afterwards sees them; if the routine ends
    without a result, those before come back, as far as their zero still stands.

    Args:
        loop, profile: as in `Routine`.
        corrections: in use; gets the new offsets.
        zero: makes the present pose the zero of the board's counters, where the board can.
    """

    NAME: ClassVar[RoutineName] = RoutineName.HOMING
    TITLE: ClassVar[str] = "Homing"
    REFERENCE: ClassVar[Literal["stops", "jig"]] = "stops"

    def __init__(
        self,
        loop: Loop,
        profile: DeviceProfile,
        corrections: "Corrections",
        zero: Callable[[], None] = lambda: None,
    ) -> None:
        super().__init__(loop, profile)
        self._corrections, self._zero = corrections, zero
        self._before = corrections.offsets

    def known(self) -> FloatArray:
        """Joint angles (left, right) at the reference pose [rad], shape (2,)."""
        return np.array(self._profile.encoder.home_offsets)

    def instruction(self) -> str:
        """Say what the user does to reach the reference pose."""
        left, right = np.degrees(self.known())
        return sentence(
            "move both links outwards against their stops"
            " (left {left:.1f}°, right {right:.1f}°), hold them there and confirm",
            left=left,
            right=right,
        )

    def _script(self) -> Script:
        self._before = self._corrections.offsets
        try:
            return (yield from self._find())
        except BaseException:
            self._corrections.set_offsets(*self._before)
            raise

    def _find(self) -> Script:
        self._disarm()
        known = self.known()
        self._require_pose(known, "the profile's reference pose")
        yield from self._ask(self.instruction())
        self._progress = 0.3
        yield from self._at_rest("keep it there")
        try:
            self._zero()
        finally:  # those of an earlier homing have gone with its zero, and must not come back
            self._before = self._corrections.offsets
        seen = yield from self._at_rest("measuring; keep it there")
        change = known - seen
        offsets = float(self._before[0] + change[0]), float(self._before[1] + change[1])
        self._corrections.set_offsets(*offsets)
        self._progress = 0.6
        yield from self._check()
        return Homing(
            step=RoutineName.OFFSETS if self.REFERENCE == "jig" else RoutineName.HOMING,
            reference=self.REFERENCE,
            offsets=offsets,
            change=(float(change[0]), float(change[1])),
        )

    def _check(self) -> Part:
        """Another pose, which tells wrong counts and directions: the needle upright by eye."""
        yield from self._ask("bring the needle upright by eye, hold it still and confirm")
        angles = yield from self._at_rest("checking; keep it there")
        tilt = self._require_pose(angles, "the pose with the needle upright")
        if tilt > _UPRIGHT_DEG:
            raise CommissioningError(
                sentence(
                    "{title}: with the needle upright the angles give a tilt of {tilt:.0f}° (at "
                    "most {upright_deg:g}° by eye); an encoder counts the wrong way or not at "
                    "all, the reference pose was not reached, or counts_per_turn "
                    "({encoder_counts_per_turn}) is wrong",
                    title=self.TITLE,
                    tilt=tilt,
                    upright_deg=_UPRIGHT_DEG,
                    encoder_counts_per_turn=self._profile.encoder.counts_per_turn,
                )
            )

    def _require_pose(self, angles: FloatArray, what: str) -> float:
        """Tilt of the needle [°] at joint angles that the links can take."""
        try:
            axis = self._profile.machine.axis(angles)
        except MechanismError as error:
            left, right = np.degrees(angles)
            raise CommissioningError(
                sentence(
                    "{title}: {pose} (left {left:.1f}°, right {right:.1f}°) is none that the"
                    " links can take: {error}; check home_offsets and the link lengths",
                    title=self.TITLE,
                    pose=what,
                    left=left,
                    right=right,
                    error=error,
                )
            ) from error
        return float(np.degrees(np.arctan2(np.hypot(*axis[:2]), -axis[2])))


class JigHomingRoutine(HomingRoutine):
    """The needle stands vertical in a jig: P_3 is under the fulcrum, so both angles are known."""

    NAME: ClassVar[RoutineName] = RoutineName.OFFSETS
    TITLE: ClassVar[str] = "Encoder offsets"
    REFERENCE: ClassVar[Literal["stops", "jig"]] = "jig"

    def known(self) -> FloatArray:
        """Joint angles that put P_3 under the fulcrum [rad], shape (2,)."""
        return self._profile.machine.usable((0.0, 0.0, -1.0))

    def instruction(self) -> str:
        """Say what the user does to reach the reference pose."""
        return sentence("put the needle into the jig that holds it vertical and confirm")

    def _check(self) -> Part:
        """Lean the needle: both encoders must agree on a pose within the joint's cone."""
        yield from self._ask("take the jig away, lean the needle to any side, hold and confirm")
        angles = yield from self._at_rest("checking; keep it there")
        tilt = self._require_pose(angles, "the pose with the needle leaning")
        limit = self._profile.tilt_limit_deg
        if tilt > limit + 3.0:
            raise CommissioningError(
                sentence(
                    "{title}: the angles give a tilt of {tilt:.0f}°, the ball joint allows"
                    " {limit:g}°; an encoder counts the wrong way, or the jig is not vertical",
                    title=self.TITLE,
                    tilt=tilt,
                    limit=limit,
                )
            )
