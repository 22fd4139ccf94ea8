"""The arm in Pinocchio, built from its published description: to check Acus' kinematics against.

`PinocchioArm(published_arm())` has `pose(q) -> ⁰T of the flange` and `jacobian(q)`.
"""

from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.core.extras import not_installed
from app.core.transform import RigidTransform
from app.mechanisms.arm.published import PublishedArm
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
