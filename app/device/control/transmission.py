"""From the wanted force at the hand to joint torques, within the limits of both."""

from dataclasses import dataclass
from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.depth_interval import shortest_lever
from app.device.control.vectors import shrink_kernel
from app.mechanisms.lever import ForceLaw, force_map_kernel, printed_force_kernel, torque_kernel
from app.mechanisms.profile import DeviceProfile


class _TransmissionPlaces(NamedTuple):
    """Limits of force [N] and torque [N·m], and whether the printed law is used."""

    hand_limit: int
    torque_limit: int
    printed: int


_AT: Final = numbered(_TransmissionPlaces)


@stage
def transmission_stage(state: FloatArray, p: FloatArray) -> None:
    """Write TORQUE_* and LIMIT_SCALE from FORCE_* and JOINT_*; keep the last torques in SENT_*.

    Only the part of the force across the needle can be delivered; that part is limited so that the
    hand feels no more than its limit at any depth that the needle can have (there the force is that
    of the estimate times L_out over the shortest lever), and becomes joint torques, to which those
    of JOINT_* are added. The sums are scaled together to the joints' limit, so that their direction
    stays.
    """
    state[sv.SENT_LEFT], state[sv.SENT_RIGHT] = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    fx, fy, fz = state[sv.FORCE_X], state[sv.FORCE_Y], state[sv.FORCE_Z]
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    along = fx * dx + fy * dy + fz * dz
    fx, fy, fz = fx - along * dx, fy - along * dy, fz - along * dz
    l_in, l_out = state[sv.L_IN], state[sv.L_OUT]
    scale = shrink_kernel(fx, fy, fz, p[_AT.hand_limit] * shortest_lever(state) / l_out)
    fx, fy, fz = scale * fx, scale * fy, scale * fz
    if p[_AT.printed] != 0.0:
        gx, gy = printed_force_kernel(fx, fy, fz, dx, dy, dz, l_in, l_out)
    else:
        gx, gy = force_map_kernel(fx, fy, fz, dx, dy, dz, l_in, l_out)
    left, right = torque_kernel(
        gx, gy, state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR]
    )
    left, right = left + state[sv.JOINT_LEFT], right + state[sv.JOINT_RIGHT]
    largest = max(abs(left), abs(right))
    factor = p[_AT.torque_limit] / largest if largest > p[_AT.torque_limit] else 1.0
    state[sv.LIMIT_SCALE] = scale * factor
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = factor * left, factor * right


@dataclass(frozen=True, slots=True)
class Transmission:
    """Force to torque with both limits.

    Attributes:
        hand_limit: largest force asked for at the hand [N].
        torque_limit: largest joint torque [N·m].
        law: virtual work, or the printed law for comparison.
    """

    hand_limit: float
    torque_limit: float
    law: ForceLaw = ForceLaw.VIRTUAL_WORK

    @classmethod
    def of(cls, profile: DeviceProfile, law: ForceLaw = ForceLaw.VIRTUAL_WORK) -> "Transmission":
        """Transmission with the limits of a device profile."""
        limits = profile.limits
        return cls(hand_limit=limits.hand_force, torque_limit=limits.joint_torque, law=law)

    def stage(self) -> Stage:
        """Return the stage for a loop's table."""
        printed = 1.0 if self.law is ForceLaw.PRINTED else 0.0
        parameters = packed(
            _AT, hand_limit=self.hand_limit, torque_limit=self.torque_limit, printed=printed
        )
        return Stage("transmission", transmission_stage, parameters)
