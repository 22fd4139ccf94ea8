"""The slots of the loop's state: one flat float64 array that every stage of a tick shares.

Device and simulation both build on these names, and only on these; a stage is
`void(state[::1], parameters[::1])` (see `core.compiled`). The first `INPUTS` slots are copied at
the start of every tick from the inbox that other threads write, so they are also exactly what a
recording needs for a replay. All values are SI, in `world` unless said otherwise.

A slot is added by adding a line; nothing else counts them. What a slot belongs to is said in its
own line, never by its place: `_input`, `_sum`, `_scene`, `_machine` or an ordinary slot. Vectors
are slices that are named below their slots. Code loops over `SUMS` and slices by `AXIS`, never from
one slot to another. Lines may therefore be moved: nothing changes by it, or this import fails and
says why.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence

_given: list[int] = []
_inputs: list[int] = []
_sums: list[int] = []
_scene_slots: list[int] = []
_machine_slots: list[int] = []


def _places() -> Iterator[int]:
    while True:
        _given.append(len(_given))
        yield _given[-1]


_next = _places()


def _input() -> int:
    """Return the place of a new input; inputs are copied as one block, so they stand first."""
    slot = next(_next)
    if slot != len(_inputs):
        raise ImportError(
            sentence(
                "state_vector: the input at place {slot} stands below a slot that is none; move "
                "its line up among the inputs",
                slot=slot,
            )
        )
    _inputs.append(slot)
    return slot


def _sum() -> int:
    """Return the place of a new sum that force laws and effects add to in every tick."""
    _sums.append(next(_next))
    return _sums[-1]


def _scene() -> int:
    """Return the place of a new slot in which effects say what the simulated scene does."""
    _scene_slots.append(next(_next))
    return _scene_slots[-1]


def _machine() -> int:
    """Return the place of a new slot of a machine: its own stages, link or plant write it."""
    _machine_slots.append(next(_next))
    return _machine_slots[-1]


def _end_of_inputs() -> int:
    """Return the number of inputs; it takes no place itself."""
    if len(_given) != len(_inputs):
        raise ImportError(
            sentence("state_vector: INPUTS does not stand directly below the last input")
        )
    return len(_inputs)


def _vector(*slots: int) -> slice:
    """Return a vector's slots, which must stand one below the other in this order."""
    if slots != tuple(range(slots[0], slots[0] + len(slots))):
        raise ImportError(
            sentence(
                "state_vector: the parts of a vector lie at the places {slots}; put their lines "
                "one below the other, in the order x, y, z or left, right",
                slots=slots,
            )
        )
    return slice(slots[0], slots[-1] + 1)


# --- inputs: written by other threads through the inbox -------------------------------------------
ASSISTANCE: Final = _input()  # [-] 1 full guidance ... 0 nothing ... -1 full repulsion
ENABLED: Final = _input()  # [-] 1 while forces are armed
HEARTBEAT: Final = _input()  # [s] monotonic time of the window's last sign of life
PATH_X: Final = _input()  # [-] wanted needle direction, hub to tip, unit vector
PATH_Y: Final = _input()
PATH_Z: Final = _input()
TARGET_X: Final = _input()  # [m] target at rest (no breathing)
TARGET_Y: Final = _input()
TARGET_Z: Final = _input()
TRACKED_DEPTH: Final = _input()  # [m] depth of the tip beyond the fulcrum by the cameras
TRACKED_TIME: Final = _input()  # [s] capture time of that fix; 0 before the first
TRACKED_VARIANCE: Final = _input()  # [m²]
HAND_X: Final = _input()  # [-] x of the needle direction that the simulated hand wants
HAND_Y: Final = _input()  # [-] y of it
HAND_DEPTH: Final = _input()  # [m] depth that the simulated hand wants
HAND_HOLDS: Final = _input()  # [-] 1 while the simulated hand holds the needle
HOMED: Final = _input()  # [-] 1 once encoders are homed and signs checked in this power cycle
FORCE_CAP: Final = _input()  # [N] largest force at the hand that this device is cleared for
TEST_X: Final = _input()  # [N] force at the hub point that a service routine asks for
TEST_Y: Final = _input()
TEST_Z: Final = _input()
TEST_LEFT: Final = _input()  # [N·m] joint torques that a service routine asks for
TEST_RIGHT: Final = _input()
HOLD_BREATH: Final = _input()  # [-] 1 while the patient is asked to hold the breath
NEEDLE_ROLL: Final = _input()  # [rad] roll of the needle, clockwise seen from the hub
HAND_LEVEL: Final = _input()  # [-] level by which the simulated hand is unsteady; 0: steady
HAND_SEED: Final = _input()  # [-] whole number that its unsteadiness follows from
INPUTS: Final = _end_of_inputs()  # number of input slots

# --- time -----------------------------------------------------------------------------------------
TIME: Final = next(_next)  # [s] monotonic time of the tick
DT: Final = next(_next)  # [s] step that this tick integrates, clamped when late
TICK: Final = next(_next)  # [-] number of the tick
LATENESS: Final = next(_next)  # [s] wake-up after the deadline
MISSED: Final = next(_next)  # [-] deadlines missed so far
TICK_COST: Final = next(_next)  # [s] time that the stages of this tick took; 0 on a virtual clock
INPUT_FAULT: Final = next(_next)  # [-] inputs that were not finite and kept their last value

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
P3_X: Final = next(_next)  # [m] tool point: where the needle's line crosses z = 0
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
DEPTH_LEAST: Final = next(_next)  # [m] interval that holds the tip's depth: its lower end
DEPTH_MOST: Final = next(_next)  # [m] its deepest end: the shortest lever, the largest force
HUB_X: Final = next(_next)  # [m] hub point P_u, where the hand is
HUB_Y: Final = next(_next)
HUB_Z: Final = next(_next)
HUB_VX: Final = next(_next)  # [m/s] its velocity perpendicular to the needle
HUB_VY: Final = next(_next)
HUB_VZ: Final = next(_next)
TIP_X: Final = next(_next)  # [m] of the straight needle; the bent one's is TIP_OFFSET_* beside it
TIP_Y: Final = next(_next)
TIP_Z: Final = next(_next)
ANGLE_ERROR: Final = next(_next)  # [rad] between needle and path


# --- forces ---------------------------------------------------------------------------------------
FORCE_X: Final = _sum()  # [N] wanted at the hub point: sum over force laws and effects
FORCE_Y: Final = _sum()
FORCE_Z: Final = _sum()
GUIDE_X: Final = _sum()  # [N] the force laws' share of it
GUIDE_Y: Final = _sum()
GUIDE_Z: Final = _sum()
JOINT_LEFT: Final = _sum()  # [N·m] joint torques wanted beside FORCE_*: compensation, service
JOINT_RIGHT: Final = _sum()
POTENTIAL: Final = _sum()  # [J] stored energy behind FORCE_*: sum over force laws and effects
GAIN_WORK: Final = _sum()  # [J] share of POTENTIAL that changes of gain added in this tick
FRICTION_WORK: Final = _sum()  # [J] let out in this tick for the joints' friction to take
AXIAL_FORCE: Final = _sum()  # [N] tissue on needle along the axis; positive pushes the tip out
FELT_X: Final = next(_next)  # [N] at the hub point after all limits (estimated from torques)
FELT_Y: Final = next(_next)
FELT_Z: Final = next(_next)
FELT_MOST: Final = next(_next)  # [N] largest that it can be: at DEPTH_MOST
TORQUE_LEFT: Final = next(_next)  # [N·m] joint torques sent
TORQUE_RIGHT: Final = next(_next)
SENT_LEFT: Final = next(_next)  # [N·m] those of the tick before, held by the motors until now
SENT_RIGHT: Final = next(_next)
LIMIT_SCALE: Final = next(_next)  # [-] 1 when no limit acts, else the factor on both torques
SAFETY_SCALE: Final = next(_next)  # [-] fade for stale encoders and arming ramp, 0...1
LET_GO_SCALE: Final = next(_next)  # [-] factor of the speed governor, 1 while the hand is calm
GUIDANCE_LIMIT: Final = next(_next)  # [N] largest force at the hub point that can be had here
GUIDANCE_LIMITED_BY: Final = next(_next)  # [-] a `device.state.Limiter`
LET_GO: Final = next(_next)  # [-] 1 once the needle has run away, until the forces are disarmed
ENERGY_OUT: Final = next(_next)  # [J] let out at the motors' port since arming, negative: taken in
ENERGY_TANK: Final = next(_next)  # [J] what may still be let out
ENERGY_BOUND: Final = next(_next)  # [J] declared stored energy: the tank's size
GUARD_SCALE: Final = next(_next)  # [-] factor of the passivity controller on both torques
GUARD_DAMPING: Final = next(_next)  # [N·m·s/rad] damping that it adds
GUARD_LOSS: Final = next(_next)  # [J] taken out by it since arming
ARMING: Final = next(_next)  # [-] arming ramp, 0 disarmed ... 1 armed
FAULT: Final = next(_next)  # [-] code of the fault that holds the force at zero, 0 = none

# --- how the simulated tissue bends the needle, across the axis (see `core.bend`) -----------------
TIP_OFFSET_X: Final = _sum()  # [m] from the straight needle's tip to the bent one's
TIP_OFFSET_Y: Final = _sum()
TIP_OFFSET_Z: Final = _sum()
TIP_SLOPE_X: Final = _sum()  # [-] direction of the tip beyond the needle's own
TIP_SLOPE_Y: Final = _sum()
TIP_SLOPE_Z: Final = _sum()
ROOT_CURVATURE_X: Final = _sum()  # [1/m] at the fulcrum
ROOT_CURVATURE_Y: Final = _sum()
ROOT_CURVATURE_Z: Final = _sum()
BENT_LENGTH: Final = _sum()  # [m] depth of the tip that these belong to; 0 for a straight needle

# --- the simulated world --------------------------------------------------------------------------
TARGET_SHIFT_X: Final = _scene()  # [m] displacement of the target now (breathing)
TARGET_SHIFT_Y: Final = _scene()
TARGET_SHIFT_Z: Final = _scene()
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
GRIP_X: Final = next(_next)  # [-] x of the needle direction where the simulated hand is
GRIP_Y: Final = next(_next)
GRIP_DEPTH: Final = next(_next)  # [m] depth where it is: HAND_* at the speed of a hand
TRAINEE_PHASE: Final = next(_next)  # [-] phase of the scripted trainee; 0 none, 9 done

# --- later slots: at the end, so that the places in older records mean what they meant ------------
INDENTATION: Final = _scene()  # [m] how far the tip has pushed in what it has not yet pierced
PUNCTURES: Final = _scene()  # [-] membranes that the tip has punctured so far
BONE_CONTACT: Final = _scene()  # [-] 1 while the tip stands on bone

# --- what a machine's own stages say of it (see `mechanisms.remote_centre`) -----------------------
INERTIA_LEFT: Final = _machine()  # [kg·m²] mass matrix of what the joints move, without the needle
INERTIA_CROSS: Final = _machine()
INERTIA_RIGHT: Final = _machine()
MASS_LEFT: Final = _machine()  # [kg·m²] mass matrix with the needle at DEPTH
MASS_CROSS: Final = _machine()
MASS_RIGHT: Final = _machine()
BIAS_LEFT: Final = _machine()  # [N·m] centrifugal and Coriolis torques at QD_*
BIAS_RIGHT: Final = _machine()
DRIFT_X: Final = _machine()  # [m/s²] acceleration of P3 at QD_* while the joints do not accelerate
DRIFT_Y: Final = _machine()
WEIGHT_LEFT: Final = _machine()  # [N·m] torques that gravity asks for, the needle at DEPTH
WEIGHT_RIGHT: Final = _machine()
LINKS_POTENTIAL: Final = _machine()  # [J] of gravity in what the joints move, without the needle
HOLD: Final = _sum()  # [-] how many laws want the direction of the path held, beyond their forces
MACHINE_FAULT: Final = _machine()  # [-] code of a fault that the machine's own watch has found
HOLDING: Final = _machine()  # [-] 1 while winches hold the direction, 0 while they pull
TENSION_1: Final = _machine()  # [N] asked of the cables, in the order of the machine's actuators
TENSION_2: Final = _machine()
TENSION_3: Final = _machine()
TENSION_4: Final = _machine()
REEL_RATE_1: Final = _machine()  # [m/s] asked of the winches while they hold, reeling in positive
REEL_RATE_2: Final = _machine()
REEL_RATE_3: Final = _machine()
REEL_RATE_4: Final = _machine()
SHORTFALL_LEFT: Final = _machine()  # [N·m] torque that the cables cannot give within their limits
SHORTFALL_RIGHT: Final = _machine()
CABLE_1: Final = _machine()  # [N] tension measured: by a sensor, or by the motor's current
CABLE_2: Final = _machine()
CABLE_3: Final = _machine()
CABLE_4: Final = _machine()
REEL_1: Final = _machine()  # [m] cable that a winch has reeled in since it was switched on
REEL_2: Final = _machine()
REEL_3: Final = _machine()
REEL_4: Final = _machine()
PLANT_CABLE_1: Final = _machine()  # [N] tension as the simulated machine's gauges have it
PLANT_CABLE_2: Final = _machine()
PLANT_CABLE_3: Final = _machine()
PLANT_CABLE_4: Final = _machine()
PLANT_REEL_1: Final = _machine()  # [m] reeled in by its winches
PLANT_REEL_2: Final = _machine()
PLANT_REEL_3: Final = _machine()
PLANT_REEL_4: Final = _machine()
ENCODER_FAULT: Final = _machine()  # [-] code of the fault of an encoder, kept until homing
UNBELIEVED: Final = _machine()  # [-] readings of the encoders that were not believed so far

# --- the tissue about the tip, where the scene has a field of it --------------------------------
# In the tick in which the tip has crossed a wall forwards, WALL is negative and TISSUE_AHEAD what
# it is in now; several walls in one tick are told one a tick. In bone the wall is its surface.
TISSUE: Final = _scene()  # [-] code of the tissue at the tip, of the field's table; 0 unknown
TISSUE_AHEAD: Final = _scene()  # [-] code of the tissue beyond the wall in front of the tip
WALL: Final = _scene()  # [m] way along the needle to that wall; negative: behind; 1 for none near
WALL_X: Final = _scene()  # [-] its unit normal, out of TISSUE and into TISSUE_AHEAD
WALL_Y: Final = _scene()
WALL_Z: Final = _scene()
CHANNEL: Final = _scene()  # [-] 1 while the tip goes where this attempt has cut already
CARRIED_X: Final = _scene()  # [m] displacement of the tissue at the tip by breathing
CARRIED_Y: Final = _scene()
CARRIED_Z: Final = _scene()
CARRIED_SHARE: Final = _scene()  # [-] share of BREATH_* that it goes along with
BREATH_X: Final = _scene()  # [m] displacement by breathing of what goes along with all of it
BREATH_Y: Final = _scene()
BREATH_Z: Final = _scene()
BONE_CROSSED: Final = _scene()  # [m] way along the needle beyond the bone's surface; 0 outside
BONE_PUSH_X: Final = _scene()  # [N] of bone on the tip across the needle, along its surface
BONE_PUSH_Y: Final = _scene()
BONE_PUSH_Z: Final = _scene()

# --- the hand is off by this from where it is asked: weight, tremor, unrest, push and tilt --------
UNSTEADY_X: Final = next(_next)  # [-] added to HAND_X and HAND_Y
UNSTEADY_Y: Final = next(_next)
UNSTEADY_DEPTH: Final = next(_next)  # [m] added to HAND_DEPTH

SLOTS: Final = next(_next)
"""Length of the state vector."""

# --- blocks ---------------------------------------------------------------------------------------
SUMS: Final = tuple(_sums)
"""What force laws and effects add to: cleared before them in every tick, checked after them."""

SCENE: Final = tuple(_scene_slots)
"""What effects write beside them; nothing else can be written by a law or an effect."""

MACHINE: Final = tuple(_machine_slots)
"""What a machine's own stages, its link or its plant write; a record without them is of a machine
that has none of it, or computes it anew in every tick."""

PATH: Final = _vector(PATH_X, PATH_Y, PATH_Z)
TARGET: Final = _vector(TARGET_X, TARGET_Y, TARGET_Z)
TEST: Final = _vector(TEST_X, TEST_Y, TEST_Z)
Q: Final = _vector(Q_LEFT, Q_RIGHT)
QD: Final = _vector(QD_LEFT, QD_RIGHT)
P3: Final = _vector(P3_X, P3_Y)
P3_V: Final = _vector(P3_VX, P3_VY)
JACOBIAN: Final = _vector(J_XL, J_XR, J_YL, J_YR)
AXIS: Final = _vector(AXIS_X, AXIS_Y, AXIS_Z)
HUB: Final = _vector(HUB_X, HUB_Y, HUB_Z)
HUB_V: Final = _vector(HUB_VX, HUB_VY, HUB_VZ)
TIP: Final = _vector(TIP_X, TIP_Y, TIP_Z)
FORCE: Final = _vector(FORCE_X, FORCE_Y, FORCE_Z)
GUIDE: Final = _vector(GUIDE_X, GUIDE_Y, GUIDE_Z)
JOINT: Final = _vector(JOINT_LEFT, JOINT_RIGHT)
FELT: Final = _vector(FELT_X, FELT_Y, FELT_Z)
TORQUE: Final = _vector(TORQUE_LEFT, TORQUE_RIGHT)
TIP_OFFSET: Final = _vector(TIP_OFFSET_X, TIP_OFFSET_Y, TIP_OFFSET_Z)
TIP_SLOPE: Final = _vector(TIP_SLOPE_X, TIP_SLOPE_Y, TIP_SLOPE_Z)
ROOT_CURVATURE: Final = _vector(ROOT_CURVATURE_X, ROOT_CURVATURE_Y, ROOT_CURVATURE_Z)
WALL_NORMAL: Final = _vector(WALL_X, WALL_Y, WALL_Z)
CARRIED: Final = _vector(CARRIED_X, CARRIED_Y, CARRIED_Z)
BREATH: Final = _vector(BREATH_X, BREATH_Y, BREATH_Z)
BONE_PUSH: Final = _vector(BONE_PUSH_X, BONE_PUSH_Y, BONE_PUSH_Z)
TARGET_SHIFT: Final = _vector(TARGET_SHIFT_X, TARGET_SHIFT_Y, TARGET_SHIFT_Z)
PLANT_Q: Final = _vector(PLANT_Q_LEFT, PLANT_Q_RIGHT)
PLANT_QD: Final = _vector(PLANT_QD_LEFT, PLANT_QD_RIGHT)
PULL: Final = _vector(PULL_X, PULL_Y, PULL_Z)
INERTIA: Final = _vector(INERTIA_LEFT, INERTIA_CROSS, INERTIA_RIGHT)
MASS: Final = _vector(MASS_LEFT, MASS_CROSS, MASS_RIGHT)
BIAS: Final = _vector(BIAS_LEFT, BIAS_RIGHT)
DRIFT: Final = _vector(DRIFT_X, DRIFT_Y)
WEIGHT: Final = _vector(WEIGHT_LEFT, WEIGHT_RIGHT)
TENSION: Final = _vector(TENSION_1, TENSION_2, TENSION_3, TENSION_4)
REEL_RATE: Final = _vector(REEL_RATE_1, REEL_RATE_2, REEL_RATE_3, REEL_RATE_4)
SHORTFALL: Final = _vector(SHORTFALL_LEFT, SHORTFALL_RIGHT)
CABLE: Final = _vector(CABLE_1, CABLE_2, CABLE_3, CABLE_4)
REEL: Final = _vector(REEL_1, REEL_2, REEL_3, REEL_4)

INDEX: Final[dict[str, int]] = {
    name.lower(): value
    for name, value in list(globals().items())
    if name.isupper()
    and not name.startswith("_")
    and isinstance(value, int)
    and name not in ("SLOTS", "INPUTS")
}
"""Slot name in lower case -> index."""

_NAMES: Final = {index: name for name, index in INDEX.items()}

VECTORS: Final[dict[str, tuple[str, ...]]] = {
    name.lower(): tuple(_NAMES[slot] for slot in range(value.start, value.stop))
    for name, value in list(globals().items())
    if name.isupper() and isinstance(value, slice)
}
"""Vector name in lower case -> names of its slots."""


def slots_named(name: str) -> tuple[str, ...]:
    """Return the slots of a name in lower case: one slot, or those of a vector; none if unknown.

    What no vector is called is taken by its components: `hand` is hand_x and hand_y.
    """
    if name in INDEX:
        return (name,)
    return VECTORS.get(name) or tuple(
        slot for slot in (f"{name}_{axis}" for axis in "xyz") if slot in INDEX
    )


def empty_state() -> FloatArray:
    """Return a state of zeros, shape (SLOTS,)."""
    return np.zeros(SLOTS)
