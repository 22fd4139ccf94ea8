"""The arm in other programs, to check Acus' kinematics against.

`PinocchioArm(published_arm())`, built from the published description, has `pose(q) -> ⁰T of the
flange` and `jacobian(q)`. `EaikArm(arm).solutions(pose) -> joint angles (n, 7)` is what EAIK
(subproblem decomposition, BSD-3-Clause) gives with joint 3 held at zero. EAIK is no part of any
extra, as it brings a window toolkit along; where it is not installed, it is left out by name.
"""

from typing import Any

import numpy as np

from app.arm.mechanics import ArmProfile, PublishedArm
from app.core.arrays import FloatArray
from app.core.extras import not_installed
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.studies.errors import StudyError


def import_pinocchio() -> Any:
    """Import Pinocchio.

    Raises:
        StudyError: if it is not installed; names the extra.
    """
    try:
        import pinocchio
    except ImportError as error:
        raise not_installed(StudyError, "Pinocchio", "arm") from error
    return pinocchio


class PinocchioArm:
    """Pinocchio's model of a published arm, its frames at the flange.

    Raises:
        StudyError: if Pinocchio is not installed.
    """

    def __init__(self, published: PublishedArm) -> None:
        self._pin = pin = import_pinocchio()
        self.model = pin.Model()
        parent = 0
        for joint in published.joints:
            place = joint.transform
            parent = self.model.addJoint(
                parent, pin.JointModelRZ(), pin.SE3(place.rotation, place.translation), joint.name
            )
            self.model.appendBodyToJoint(
                parent,
                pin.Inertia(joint.mass, np.array(joint.centre), np.diag(joint.inertia)),
                pin.SE3.Identity(),
            )
        end = published.flange.transform
        self._flange = self.model.addFrame(
            pin.Frame(
                "flange", parent, pin.SE3(end.rotation, end.translation), pin.FrameType.OP_FRAME
            )
        )
        self.data = self.model.createData()

    def pose(self, q: FloatArray) -> RigidTransform:
        """Pose of the flange in the base's frame at joint angles q [rad], shape (7,)."""
        placed = self.placed(q)
        return RigidTransform(placed.rotation, placed.translation)

    def placed(self, q: FloatArray) -> Any:
        """Return the same as Pinocchio's own SE3, valid until the next call."""
        self._pin.framesForwardKinematics(self.model, self.data, q)
        return self.data.oMf[self._flange]

    def target(self, pose: RigidTransform) -> Any:
        """Return a pose of the flange as Pinocchio's SE3."""
        return self._pin.SE3(pose.rotation, pose.translation)

    def jacobian(self, q: FloatArray) -> FloatArray:
        """Jacobian of the flange, shape (6, 7), in the base's axes: velocity, angular velocity."""
        pin = self._pin
        result: FloatArray = np.array(
            pin.computeFrameJacobian(
                self.model, self.data, q, self._flange, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
            )
        )
        return result

    def iterate(
        self, target: Any, start: FloatArray, steps: int, damping: float, close: float
    ) -> tuple[FloatArray, bool]:
        """Inverse kinematics as Pinocchio's own example does it: damped steps without limits.

        Args:
            target: pose of the flange, an SE3.
            start: joint angles [rad], shape (7,).
            steps: most steps.
            damping: added to J Jᵀ.
            close: size of the twist at which the pose is reached.

        Returns:
            Joint angles, and whether the pose is reached.
        """
        pin = self._pin
        q = start.copy()
        for _ in range(steps):
            off = self.placed(q).actInv(target)
            error = pin.log6(off).vector
            if np.linalg.norm(error) < close:
                return q, True
            j = pin.computeFrameJacobian(
                self.model, self.data, q, self._flange, pin.ReferenceFrame.LOCAL
            )
            j = -pin.Jlog6(off.inverse()) @ j
            v = -j.T @ np.linalg.solve(j @ j.T + damping * np.eye(6), error)
            q = pin.integrate(self.model, q, v)
        return q, False


def import_eaik() -> Any:
    """Import EAIK's robots by Denavit and Hartenberg's parameters.

    Raises:
        StudyError: if it is not installed.
    """
    try:
        from eaik.IK_DH import DhRobot
    except ImportError as error:
        raise StudyError(
            sentence("EAIK is not installed: pip install EAIK, beside Acus")
        ) from error
    return DhRobot


class EaikArm:
    """EAIK's robot, from standard parameters of the same chain.

    Raises:
        StudyError: if EAIK is not installed.
    """

    def __init__(self, arm: ArmProfile) -> None:
        # Standard (distal) parameters: α of the modified table moved one joint on, same d.
        quarter = 0.5 * np.pi
        alpha = np.array([-quarter, quarter, quarter, -quarter, -quarter, quarter, 0.0])
        lift = np.array([arm.pedestal, 0.0, arm.upper_arm, 0.0, arm.forearm, 0.0, 0.0])
        self._robot = import_eaik()(alpha, np.zeros(7), lift, [(2, 0.0)])

    def solutions(self, pose: RigidTransform) -> FloatArray:
        """All joint angles that it finds [rad], shape (n, 7); least squares ones left out."""
        found = self._robot.IK(pose.matrix())
        keep = ~np.array(found.is_LS, dtype=bool)
        result: FloatArray = np.array(found.Q, dtype=np.float64).reshape(-1, 7)[keep]
        return result
