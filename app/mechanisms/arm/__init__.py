"""The arm of the laparoscopic paper: seven joints, spherical shoulder and wrist, simulated only."""

from app.mechanisms.arm.kinematics import (
    ARM_BRANCHES,
    ArmBranch,
    ArmSingularity,
    ArmSolution,
    arm_angle,
    arm_branch,
    decoupled,
    forward,
    inverse,
    jacobian,
    link_frames,
)
from app.mechanisms.arm.least_squares import Iterated, iterate, starts
from app.mechanisms.arm.profile import ArmProfile, load_arm
from app.mechanisms.arm.published import PublishedArm, published_arm
from app.mechanisms.arm.redundancy import JointLimitError, feasible, solve
from app.mechanisms.arm.workspace import (
    ArmReach,
    NearestPose,
    SingularDistance,
    arm_singularity,
    nearest_pose,
    reach,
    tool_covariance,
)

__all__ = [
    "ARM_BRANCHES",
    "ArmBranch",
    "ArmProfile",
    "ArmReach",
    "ArmSingularity",
    "ArmSolution",
    "Iterated",
    "JointLimitError",
    "NearestPose",
    "PublishedArm",
    "SingularDistance",
    "arm_angle",
    "arm_branch",
    "arm_singularity",
    "decoupled",
    "feasible",
    "forward",
    "inverse",
    "iterate",
    "jacobian",
    "link_frames",
    "load_arm",
    "nearest_pose",
    "published_arm",
    "reach",
    "solve",
    "starts",
    "tool_covariance",
]
