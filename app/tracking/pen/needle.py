"""From the pose of the cube and that of the sheet in one picture to the needle in world.

With T = T_world_base · T_camera_base⁻¹ · T_camera_body the camera's own place drops out, and with
it most of what its focal length is wrong by: both poses change alike. To first order a twist δ of
the body in the camera's frame is that of the body less that of the sheet, and

    tip: dp = R_world_camera (ρ + ω x p_camera) + R_world_body dp_body,
    direction: dd = R_world_camera (ω x d_camera) + R_world_body dd_body.
"""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, frozen, read_only, unit
from app.core.messages import sentence
from app.core.rotation import skew
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.confidence import chi_square_quantile, covariance_radius
from app.tracking.pen.body import TipProfile
from app.tracking.pen.pose import BoardPose


@dataclass(frozen=True, slots=True, eq=False)
class PenTip:
    """Tip and shaft in the body's frame.

    Attributes:
        p_tip: tip [m], shape (3,).
        axis: unit direction towards the tip, shape (3,).
        covariance: of tip [m²] and direction, shape (6, 6); nothing along the direction.
        calibrated: whether it was measured.
    """

    p_tip: FloatArray
    axis: FloatArray
    covariance: FloatArray
    calibrated: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_tip", frozen(self.p_tip, (3,), "tip"))
        object.__setattr__(self, "axis", frozen(unit(self.axis), (3,), "axis"))
        object.__setattr__(self, "covariance", frozen(self.covariance, (6, 6), "tip covariance"))

    @classmethod
    def of(cls, profile: TipProfile) -> "PenTip":
        """Take a profile's tip."""
        axis = unit(profile.axis)
        covariance = np.zeros((6, 6))
        covariance[:3, :3] = np.array(profile.covariance_mm2) * MILLIMETRE**2
        across = np.eye(3) - np.outer(axis, axis)
        covariance[3:, 3:] = (profile.axis_sd_deg * DEGREE) ** 2 * across
        return cls(np.array(profile.position_mm) * MILLIMETRE, axis, covariance, profile.calibrated)


@dataclass(frozen=True, slots=True, eq=False)
class PenNeedle:
    """The needle by one picture, in world.

    Attributes:
        T_world_body: pose of the cube.
        T_world_camera: pose of the webcam, by the sheet.
        p_tip: tip [m], shape (3,).
        axis: unit direction towards the tip, shape (3,).
        covariance: of tip [m²] and direction, shape (6, 6).
    """

    T_world_body: RigidTransform
    T_world_camera: RigidTransform
    p_tip: FloatArray
    axis: FloatArray
    covariance: FloatArray

    @property
    def tip_covariance(self) -> FloatArray:
        """Covariance of the tip [m²], shape (3, 3)."""
        return self.covariance[:3, :3]

    def tip_radius(self, probability: float = 0.95) -> float:
        """Radius [m] round the tip that holds the true one with `probability`."""
        return covariance_radius(self.tip_covariance, probability)

    def axis_cone(self, probability: float = 0.95) -> float:
        """Half angle [rad] of a cone that holds the true direction with at least `probability`."""
        largest = max(0.0, float(np.linalg.eigvalsh(self.covariance[3:, 3:])[-1]))
        return float(np.sqrt(chi_square_quantile(probability, 2) * largest))

    def depth(self, fulcrum: FloatArray) -> tuple[float, float]:
        """Depth of the tip beyond the fulcrum along the shaft [m], and its variance [m²]."""
        offset = self.p_tip - fulcrum
        by = np.concatenate([self.axis, offset - (offset @ self.axis) * self.axis])
        return float(offset @ self.axis), float(by @ self.covariance @ by)

    def beside(self, fulcrum: FloatArray) -> tuple[FloatArray, float]:
        """Return how the shaft's line passes the fulcrum: vector from it [m], and the length's
        deviation.

        The vector is the part of tip - fulcrum across the shaft; its standard deviation [m] is
        taken along it.
        """
        offset = self.p_tip - fulcrum
        along = float(offset @ self.axis)
        vector = offset - along * self.axis
        length = float(np.linalg.norm(vector))
        across = np.eye(3) - np.outer(self.axis, self.axis)
        jacobian = np.hstack([across, -along * across])
        covariance = jacobian @ self.covariance @ jacobian.T
        if length < 1e-9:
            return vector, float(np.sqrt(np.trace(covariance) / 2.0))
        direction = vector / length
        return vector, float(np.sqrt(direction @ covariance @ direction))

    @property
    def words(self) -> str:
        """Return how well it is known, for people."""
        return sentence(
            "tip within ± {tip_radius_mm:.1f} mm (95 %), axis within ± {axis_cone_deg:.1f}°",
            tip_radius_mm=self.tip_radius() / MILLIMETRE,
            axis_cone_deg=self.axis_cone() / DEGREE,
        )


def solve_needle(
    body: BoardPose,
    base: BoardPose,
    T_world_base: RigidTransform,
    tip: PenTip,
    parameter_covariance: FloatArray,
) -> PenNeedle:
    """Needle in world of two poses that were found in one picture.

    Args:
        body: pose of cube or ring.
        base: pose of the sheet.
        T_world_base: place of the sheet.
        tip: of the pen.
        parameter_covariance: of the camera's parameters, shape (m, m).
    """
    T_world_camera = T_world_base @ base.T_camera_board.inverse()
    T_world_body = T_world_camera @ body.T_camera_board
    relative = body.sensitivity - base.sensitivity
    twist = body.covariance + base.covariance + relative @ parameter_covariance @ relative.T
    p_camera, d_camera = body.T_camera_board @ tip.p_tip, body.T_camera_board.rotate(tip.axis)
    jacobian = np.zeros((6, 6))
    jacobian[:3, :3], jacobian[:3, 3:] = np.eye(3), -skew(p_camera)
    jacobian[3:, 3:] = -skew(d_camera)
    seen, built = np.zeros((6, 6)), np.zeros((6, 6))
    for block in (slice(0, 3), slice(3, 6)):
        seen[block, block] = T_world_camera.rotation
        built[block, block] = T_world_body.rotation
    seen = seen @ jacobian
    covariance = seen @ twist @ seen.T + built @ tip.covariance @ built.T
    return PenNeedle(
        T_world_body,
        T_world_camera,
        read_only(T_world_body @ tip.p_tip),
        read_only(unit(T_world_body.rotate(tip.axis))),
        read_only(0.5 * (covariance + covariance.T)),
    )
