"""The profile of an arm: lengths, joint limits, where it stands and what it holds.

Frames: `base` is frame 0 of the paper's table, `wrist` its frame 7 with the origin at the wrist
centre, `flange` the same 126 mm further along z, `tool` the tool's centre point.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Final

import numpy as np
from pydantic import Field

from app.core.arrays import FloatArray, frozen
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.mechanisms.errors import MechanismError
from app.mechanisms.profile import Section

JOINTS: Final = 7
"""Joints of the arm."""

TWISTS: Final = (0.0, -0.5, 0.5, 0.5, -0.5, -0.5, 0.5)
"""α of the modified (Craig) table, frame i-1 to i, in half turns; every a is zero."""

PROFILES: Final = Path(__file__).resolve().parents[1] / "profiles" / "arms"
"""Folder of the arms that ship."""

ROOM_FOR_ROUNDING: Final = 1e-11
"""A joint this far beyond its limit stands at it [rad]."""


@dataclass(frozen=True, slots=True, eq=False)
class ArmProfile:
    """An arm with spherical shoulder and wrist and one elbow between them (7 joints, no offsets).

    Attributes:
        name: of its file.
        pedestal: d1, base to shoulder [m].
        upper_arm: d3, shoulder to elbow [m]; 0.42 (errata D1: the printed 0.36 is wrong).
        forearm: d5, elbow to wrist centre [m].
        flange: wrist centre to flange [m].
        lower, upper: joint limits [rad], shape (7,).
        speed: largest joint speeds [rad/s], shape (7,).
        acceleration: largest joint accelerations [rad/s²], shape (7,).
        jerk: largest joint jerks [rad/s³], shape (7,).
        torque: largest joint torques [N·m], shape (7,).
        resolution: standard deviation of a joint angle as its encoder says it [rad].
        repeatability: of the flange's place, as the data sheet says it (ISO 9283) [m].
        T_world_base: where the arm stands, the paper's ᵁT₀.
        T_flange_tool: what it holds.
        base_covariance, tool_covariance: of these two placements, of a small motion of the placed
            frame (shift [m], then turn [rad]) in its own axes, shape (6, 6): the error of hand and
            eye.

    Raises:
        MechanismError: if a length is not positive, or a joint's limits are not around zero.
    """

    name: str
    pedestal: float
    upper_arm: float
    forearm: float
    flange: float
    lower: FloatArray
    upper: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    jerk: FloatArray
    torque: FloatArray
    resolution: float
    repeatability: float
    T_world_base: RigidTransform
    T_flange_tool: RigidTransform
    base_covariance: FloatArray
    tool_covariance: FloatArray

    def __post_init__(self) -> None:
        for name in ("pedestal", "upper_arm", "forearm", "flange"):
            if not 0.0 < getattr(self, name) < float("inf"):
                raise MechanismError(
                    sentence(
                        "arm {name}: {quantity} is {length} m; a positive length is needed",
                        name=self.name,
                        quantity=name,
                        length=getattr(self, name),
                    )
                )
        for name in ("lower", "upper", "speed", "acceleration", "jerk", "torque"):
            object.__setattr__(self, name, frozen(getattr(self, name), (JOINTS,), name))
        for name in ("base_covariance", "tool_covariance"):
            object.__setattr__(self, name, frozen(getattr(self, name), (6, 6), name))
        if not (self.lower < 0.0).all() or not (self.upper > 0.0).all():
            raise MechanismError(
                sentence(
                    "arm {name}: limits {lower} to {upper} rad;"
                    " every joint must turn both ways from zero",
                    name=self.name,
                    lower=self.lower.tolist(),
                    upper=self.upper.tolist(),
                )
            )

    @property
    def lengths(self) -> tuple[float, float, float]:
        """Return (d1, d3, d5) [m]: what the kernels take."""
        return self.pedestal, self.upper_arm, self.forearm

    @property
    def T_wrist_flange(self) -> RigidTransform:
        """Flange in the frame of the wrist."""
        return RigidTransform.from_translation([0.0, 0.0, self.flange])

    @property
    def T_wrist_tool(self) -> RigidTransform:
        """Tool in the frame of the wrist, the paper's ⁷T_tcp."""
        return self.T_wrist_flange @ self.T_flange_tool

    def wrist_pose(self, T_world_tool: RigidTransform) -> RigidTransform:
        """Wrist in the base's frame for a pose of the tool: ⁰T₇ = ᵁT₀⁻¹ ᵁT_tcp ⁷T_tcp⁻¹."""
        return self.T_world_base.inverse() @ T_world_tool @ self.T_wrist_tool.inverse()

    def tool_pose(self, T_base_wrist: RigidTransform) -> RigidTransform:
        """Tool in the world for a pose of the wrist: ᵁT_tcp = ᵁT₀ ⁰T₇ ⁷T_tcp."""
        return self.T_world_base @ T_base_wrist @ self.T_wrist_tool

    def beyond(self, q: FloatArray) -> FloatArray:
        """Return how far each joint is beyond its limits [rad], shape of q (..., 7); 0 within."""
        return np.maximum(np.maximum(self.lower - q, q - self.upper), 0.0)

    def allows(self, q: FloatArray) -> bool:
        """Return whether joint angles [rad], shape (7,), are within the limits."""
        return bool((self.beyond(q) <= 0.0).all())


_Length = Annotated[float, Field(gt=0.0, le=2.0)]
_Degrees = Annotated[float, Field(ge=-360.0, le=360.0)]
_Limit = Annotated[float, Field(gt=0.0, le=360.0)]
_Spread = Annotated[float, Field(ge=0.0, le=1.0)]
_Place = Annotated[float, Field(ge=-10.0, le=10.0)]
_Rate = Annotated[float, Field(gt=0.0, le=1e6)]
_Seven = Annotated[tuple[_Limit, ...], Field(min_length=JOINTS, max_length=JOINTS)]

_SevenRates = Annotated[tuple[_Rate, ...], Field(min_length=JOINTS, max_length=JOINTS)]


class _LengthSection(Section):
    pedestal: _Length
    upper_arm: _Length
    forearm: _Length
    flange: _Length


class _JointSection(Section):
    limit_deg: _Seven
    speed_deg: _Seven
    acceleration_deg: _SevenRates
    jerk_deg: _SevenRates
    torque: _SevenRates
    resolution_deg: _Spread
    repeatability: _Spread


class _PlacementSection(Section):
    position: tuple[_Place, _Place, _Place]
    rotation_deg: tuple[_Degrees, _Degrees, _Degrees]
    position_std: _Spread
    rotation_std_deg: _Spread

    @property
    def transform(self) -> RigidTransform:
        return RigidTransform(rotation_exp(np.radians(self.rotation_deg)), np.array(self.position))

    @property
    def covariance(self) -> FloatArray:
        spread = [self.position_std] * 3 + [float(np.radians(self.rotation_std_deg))] * 3
        result: FloatArray = np.diag(np.square(spread))
        return result


class _ArmFile(Strict):
    name: str
    description: str
    lengths: _LengthSection
    joints: _JointSection
    base: _PlacementSection
    tool: _PlacementSection


def load_arm(name_or_path: str | Path = "iiwa14") -> ArmProfile:
    """Load a shipped arm by name, or any by the path of its YAML file.

    Raises:
        ConfigurationError: if there is none of that name, or the file is wrong.
    """
    path = Path(name_or_path)
    if path.suffix not in (".yaml", ".yml"):
        path = PROFILES / f"{name_or_path}.yaml"
        if not path.is_file():
            raise ConfigurationError(
                sentence(
                    "no arm {name_or_path!r}; there is iiwa14, or the path of a .yaml file",
                    name_or_path=str(name_or_path),
                )
            )
    file = load(path, _ArmFile)
    limit = np.radians(file.joints.limit_deg)
    return ArmProfile(
        name=file.name,
        pedestal=file.lengths.pedestal,
        upper_arm=file.lengths.upper_arm,
        forearm=file.lengths.forearm,
        flange=file.lengths.flange,
        lower=-limit,
        upper=limit,
        speed=np.radians(file.joints.speed_deg),
        acceleration=np.radians(file.joints.acceleration_deg),
        jerk=np.radians(file.joints.jerk_deg),
        torque=np.array(file.joints.torque),
        resolution=float(np.radians(file.joints.resolution_deg)),
        repeatability=file.joints.repeatability,
        T_world_base=file.base.transform,
        T_flange_tool=file.tool.transform,
        base_covariance=file.base.covariance,
        tool_covariance=file.tool.covariance,
    )
