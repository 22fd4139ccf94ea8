"""What EAIK (subproblem decomposition, BSD-3-Clause) gives for the arm with joint 3 held at zero.

`EaikArm(arm).solutions(pose) -> joint angles (n, 7)`. EAIK is no part of any extra, as it brings a
window toolkit along; where it is not installed, it is left out by name.
"""

from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.mechanisms.arm import ArmProfile
from app.studies.errors import StudyError


def import_eaik() -> Any:
    """Import EAIK's robots by Denavit and Hartenberg's parameters.

    Raises:
        StudyError: if it is not installed.
    """
    try:
        from eaik.IK_DH import DhRobot
    except ImportError as error:
        raise StudyError("EAIK is not installed: pip install EAIK, beside Acus") from error
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
