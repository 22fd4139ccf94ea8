"""The slots of the loop's state: one flat float64 array that every stage of a tick shares.

Device and simulation both build on these names, and only on these; a stage is
`void(state[::1], parameters[::1])` (see `core.compiled`). The first `INPUTS` slots are copied at
the start of every tick from the inbox that other threads write, so they are also exactly what a
recording needs for a replay. All values are SI, in `world` unless said otherwise.

A slot is added by adding a line; nothing else counts them.
"""

from itertools import count
from typing import Final

import numpy as np

from app.core.arrays import FloatArray

_next = count()

# --- inputs: written by other threads through the inbox -------------------------------------------
ASSISTANCE: Final = next(_next)  # [-] 1 full guidance ... 0 nothing ... -1 full repulsion
ENABLED: Final = next(_next)  # [-] 1 while forces are armed
HEARTBEAT: Final = next(_next)  # [s] monotonic time of the window's last sign of life
PATH_X: Final = next(_next)  # [-] wanted needle direction, hub to tip, unit vector
PATH_Y: Final = next(_next)
PATH_Z: Final = next(_next)
TARGET_X: Final = next(_next)  # [m] target at rest (no breathing)
TARGET_Y: Final = next(_next)
TARGET_Z: Final = next(_next)
TRACKED_DEPTH: Final = next(_next)  # [m] depth of the tip beyond the fulcrum by the cameras
TRACKED_TIME: Final = next(_next)  # [s] capture time of that fix; 0 before the first
TRACKED_VARIANCE: Final = next(_next)  # [m²]
HAND_X: Final = next(_next)  # [-] x of the needle direction that the simulated hand wants
HAND_Y: Final = next(_next)  # [-] y of it
HAND_DEPTH: Final = next(_next)  # [m] depth that the simulated hand wants
HAND_HOLDS: Final = next(_next)  # [-] 1 while the simulated hand holds the needle
HOMED: Final = next(_next)  # [-] 1 once encoders are homed and signs checked in this power cycle
FORCE_CAP: Final = next(_next)  # [N] largest force at the hand that this device is cleared for
TEST_X: Final = next(_next)  # [N] force at the hub point that a service routine asks for
TEST_Y: Final = next(_next)
TEST_Z: Final = next(_next)
TEST_LEFT: Final = next(_next)  # [N·m] joint torques that a service routine asks for
TEST_RIGHT: Final = next(_next)
INPUTS: Final = next(_next)  # number of input slots (and a spare slot)

# --- time -----------------------------------------------------------------------------------------
TIME: Final = next(_next)  # [s] monotonic time of the tick
DT: Final = next(_next)  # [s] step that this tick integrates, clamped when late
TICK: Final = next(_next)  # [-] number of the tick
LATENESS: Final = next(_next)  # [s] wake-up after the deadline
MISSED: Final = next(_next)  # [-] deadlines missed so far
TICK_COST: Final = next(_next)  # [s] time that the stages of this tick took; 0 on a virtual clock
INPUT_FAULT: Final = next(
    _next
)  # [-] number of inputs that were not finite and kept their last value

# --- the wire: written by a link's read stages --------------------------------------------------
LINK_STATUS: Final = next(_next)  # [-] 0 fine, else a `device.links.link.LinkStatus`
LINK_REPLIES: Final = next(_next)  # [-] whole replies received so far
LINK_ERRORS: Final = next(_next)  # [-] frames dropped for a wrong checksum or length so far
LINK_LOST: Final = next(_next)  # [-] commands that were never answered so far
ROUND_TRIP: Final = next(_next)  # [s] from command to its answer, newest
BOARD_ERROR: Final = next(_next)  # [-] error that the board reports, 0 = none
GAUGE: Final = next(_next)  # [-] 1 while the board measures the force, else 0
GAUGE_FORCE: Final = next(_next)  # [N] force at the hub that its gauge measures, across the needle

# --- encoders and kinematics ----------------------------------------------------------------------
Q_LEFT: Final = next(_next)  # [rad] joint angles as the encoders give them
Q_RIGHT: Final = next(_next)
Q_TIME: Final = next(_next)  # [s] when the encoders were read
QD_LEFT: Final = next(_next)  # [rad/s] estimated velocities
QD_RIGHT: Final = next(_next)
KINEMATICS: Final = next(_next)  # [-] status of the forward kinematics, 0 = valid
P3_X: Final = next(_next)  # [m] tool point of the pantograph
P3_Y: Final = next(_next)
P3_VX: Final = next(_next)  # [m/s]
P3_VY: Final = next(_next)
J_XL: Final = next(_next)  # [m/rad] Jacobian dP3/dq, row x: left, right
J_XR: Final = next(_next)
J_YL: Final = next(_next)
J_YR: Final = next(_next)
AXIS_X: Final = next(_next)  # [-] needle direction, hub to tip
AXIS_Y: Final = next(_next)
AXIS_Z: Final = next(_next)
L_IN: Final = next(_next)  # [m] fulcrum to P3
L_OUT: Final = next(_next)  # [m] hub point to fulcrum
DEPTH: Final = next(_next)  # [m] tip beyond the fulcrum along the axis
DEPTH_SOURCE: Final = next(_next)  # [-] 1 tracked, 2 held, 0 model
HUB_X: Final = next(_next)  # [m] hub point P_u, where the hand is
HUB_Y: Final = next(_next)
HUB_Z: Final = next(_next)
HUB_VX: Final = next(_next)  # [m/s] its velocity perpendicular to the needle
HUB_VY: Final = next(_next)
HUB_VZ: Final = next(_next)
TIP_X: Final = next(_next)  # [m]
TIP_Y: Final = next(_next)
TIP_Z: Final = next(_next)
ANGLE_ERROR: Final = next(_next)  # [rad] between needle and path


# --- forces ---------------------------------------------------------------------------------------
FORCE_X: Final = next(_next)  # [N] wanted at the hub point: sum over force laws and effects
FORCE_Y: Final = next(_next)
FORCE_Z: Final = next(_next)
GUIDE_X: Final = next(_next)  # [N] the force laws' share of it
GUIDE_Y: Final = next(_next)
GUIDE_Z: Final = next(_next)
JOINT_LEFT: Final = next(_next)  # [N·m] joint torques wanted beside FORCE_*: compensation, service
JOINT_RIGHT: Final = next(_next)
POTENTIAL: Final = next(_next)  # [J] stored energy behind FORCE_*: sum over force laws and effects
GAIN_WORK: Final = next(_next)  # [J] share of POTENTIAL that changes of gain added in this tick
FRICTION_WORK: Final = next(_next)  # [J] let out in this tick for the joints' friction to take
AXIAL_FORCE: Final = next(_next)  # [N] tissue on needle along the axis; positive pushes the tip out
FELT_X: Final = next(_next)  # [N] at the hub point after all limits (estimated from torques)
FELT_Y: Final = next(_next)
FELT_Z: Final = next(_next)
TORQUE_LEFT: Final = next(_next)  # [N·m] joint torques sent
TORQUE_RIGHT: Final = next(_next)
SENT_LEFT: Final = next(_next)  # [N·m] those of the tick before, held by the motors until now
SENT_RIGHT: Final = next(_next)
LIMIT_SCALE: Final = next(_next)  # [-] 1 when no limit acts, else the factor on both torques
SAFETY_SCALE: Final = next(_next)  # [-] fade for stale encoders and arming ramp, 0...1
LET_GO_SCALE: Final = next(_next)  # [-] factor of the speed governor, 1 while the hand is calm
LET_GO: Final = next(_next)  # [-] 1 once the needle has run away, until the forces are disarmed
ENERGY_OUT: Final = next(_next)  # [J] let out at the motors' port since arming, negative: taken in
ENERGY_TANK: Final = next(_next)  # [J] what may still be let out
ENERGY_BOUND: Final = next(_next)  # [J] declared stored energy: the tank's size
GUARD_SCALE: Final = next(_next)  # [-] factor of the passivity controller on both torques
GUARD_DAMPING: Final = next(_next)  # [N·m·s/rad] damping that it adds
GUARD_LOSS: Final = next(_next)  # [J] taken out by it since arming
ARMING: Final = next(_next)  # [-] arming ramp, 0 disarmed ... 1 armed
FAULT: Final = next(_next)  # [-] code of the fault that holds the force at zero, 0 = none

# --- the simulated world --------------------------------------------------------------------------
TARGET_SHIFT_X: Final = next(_next)  # [m] displacement of the target now (breathing)
TARGET_SHIFT_Y: Final = next(_next)
TARGET_SHIFT_Z: Final = next(_next)
PLANT_Q_LEFT: Final = next(_next)  # [rad] true joint angles of the simulated robot
PLANT_Q_RIGHT: Final = next(_next)
PLANT_QD_LEFT: Final = next(_next)  # [rad/s]
PLANT_QD_RIGHT: Final = next(_next)
PLANT_DEPTH: Final = next(_next)  # [m] true depth of the tip
PLANT_DEPTH_RATE: Final = next(_next)  # [m/s]
PULL_X: Final = next(_next)  # [N] force of the simulated hand at the hub point
PULL_Y: Final = next(_next)
PULL_Z: Final = next(_next)
PUSH: Final = next(_next)  # [N] force of the simulated hand along the axis, positive inwards
TRAINEE_PHASE: Final = next(_next)  # [-] phase of the scripted trainee; 0 none, 9 done

SLOTS: Final = next(_next)
"""Length of the state vector."""

INDEX: Final[dict[str, int]] = {
    name.lower(): value
    for name, value in list(globals().items())
    if name.isupper()
    and not name.startswith("_")
    and isinstance(value, int)
    and name not in ("SLOTS", "INPUTS")
}
"""Slot name in lower case -> index."""


def empty_state() -> FloatArray:
    """Return a state of zeros, shape (SLOTS,)."""
    return np.zeros(SLOTS)
