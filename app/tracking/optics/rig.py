"""Rig profiles: two cameras, the needle they watch, and what they promise to see."""

from functools import cached_property
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np
from pydantic import Field, model_validator

from app.core import paths
from app.core.arrays import unit
from app.core.configuration import Strict, load
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.errors import RigError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.camera_model import CameraModel

Triple = tuple[float, float, float]


class CameraProfile(Strict):
    """One camera as YAML gives it.

    Attributes:
        focal_px: fx, fy.
        centre_px: cx, cy; pixel (0, 0) is the centre of the upper left pixel.
        distortion: k1, k2, p1, p2, k3 in OpenCV's order.
        position_mm: centre of projection in world.
        looks_at_mm: any point on the optical axis, in world.
        roll_deg: turn of the picture about the optical axis; at 0 the world's z points up in it.
    """

    name: str = Field(min_length=1)
    image_size: tuple[int, int]
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    distortion: tuple[float, float, float, float, float]
    position_mm: Triple
    looks_at_mm: Triple
    roll_deg: float = 0.0

    def model(self) -> CameraModel:
        """Build the camera.

        Raises:
            RigError: if the optical axis has no direction or is vertical (no roll reference).
        """
        return CameraModel(
            self.name,
            np.array([*self.focal_px, *self.centre_px]),
            np.array(self.distortion),
            self.image_size,
            self._pose(),
        )

    def _pose(self) -> RigidTransform:
        position = np.array(self.position_mm) * MILLIMETRE
        line = np.array(self.looks_at_mm) * MILLIMETRE - position
        if np.hypot(line[0], line[1]) < 1e-6:
            raise RigError(
                f"camera {self.name}: looks_at_mm {self.looks_at_mm} lies straight above, below or "
                f"at position_mm {self.position_mm}; move it sideways: the roll needs that"
            )
        z = unit(line)
        down = unit(np.array([0.0, 0.0, -1.0]) + z[2] * z)
        right = np.cross(down, z)
        roll = self.roll_deg * DEGREE
        x = np.cos(roll) * right + np.sin(roll) * down
        return RigidTransform(np.column_stack([x, np.cross(z, x), z]), position)


class NeedleProfile(Strict):
    """The needle and its red band, as the cameras see them.

    Attributes:
        length_mm: hub to tip.
        point_length_mm: over which the shaft tapers to the tip.
        marker_offset_mm: centre of the band behind the tip.
        hidden_mm: from where to where the band's centre stands beyond the fulcrum while the tube
            hides it; None for a rig that sees it everywhere.
        second_marker_offset_mm: centre of a second band, like the first, behind the tip; further
            back than the first. Two bands give the needle's axis too. None for one band.
    """

    length_mm: float = Field(gt=0.0)
    shaft_diameter_mm: float = Field(gt=0.0)
    point_length_mm: float = Field(gt=0.0)
    marker_offset_mm: float = Field(ge=0.0)
    marker_length_mm: float = Field(gt=0.0)
    marker_diameter_mm: float = Field(gt=0.0)
    hidden_mm: tuple[float, float] | None = None
    second_marker_offset_mm: float | None = None

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.hidden_mm is not None and not self.hidden_mm[0] < self.hidden_mm[1]:
            raise ValueError(
                f"hidden_mm {list(self.hidden_mm)} must name the smaller depth first, or be left "
                "out where nothing hides the band"
            )
        second = self.second_marker_offset_mm
        least = self.marker_offset_mm + 1.5 * self.marker_length_mm
        if second is not None and not least <= second < self.length_mm:
            raise ValueError(
                f"second_marker_offset_mm {second} must lie between {least} (half a band's length "
                f"of bare shaft behind the first) and the needle's length of {self.length_mm}"
            )
        return self

    @property
    def marker_offset(self) -> float:
        """Distance from the band's centre to the tip [m]."""
        return self.marker_offset_mm * MILLIMETRE

    @property
    def band_distance(self) -> float | None:
        """Distance between the centres of both bands [m]; None for one band."""
        if self.second_marker_offset_mm is None:
            return None
        return (self.second_marker_offset_mm - self.marker_offset_mm) * MILLIMETRE

    @cached_property
    def shape(self) -> "NeedleShape":
        """Its measures in metres."""
        return NeedleShape(
            0.5 * self.shaft_diameter_mm * MILLIMETRE,
            0.5 * self.marker_diameter_mm * MILLIMETRE,
            0.5 * self.marker_length_mm * MILLIMETRE,
            self.marker_offset,
            self.marker_offset - self.length_mm * MILLIMETRE,
            self.point_length_mm * MILLIMETRE,
        )


class NeedleShape(NamedTuple):
    """Shaft, band and point [m]; positions on the axis count from the band's centre to the tip."""

    shaft: float
    """Radius of the shaft."""
    radius: float
    """Radius of the band."""
    half: float
    """Half length of the band."""
    tip: float
    """Position of the tip."""
    hub: float
    """Position of the hub; negative."""
    point: float
    """Length over which the shaft tapers to the tip."""


class RangeProfile(Strict):
    """Where both cameras are meant to see the marker."""

    depth_min_mm: float
    depth_max_mm: float
    tilt_max_deg: float = Field(gt=0.0, lt=90.0)


class RigProfile(Strict):
    """Two cameras and what is known about their pictures.

    Attributes:
        rate_hz: pictures per second of each camera.
        noise_grey: standard deviation of a grey value [levels of 255].
        blur_px: standard deviation of the picture of a point.
        latency_ms: from capture to delivery (simulated cameras delay by it).
        skew_ms: capture of the second camera after the first (simulated cameras keep it).
        systematic_px: what calibration and marker centre leave besides noise, standard deviation
            per pixel axis; it enters every covariance.
        line_sd_mm: agreement of the needle line (by the robot) with the camera frame, per axis.
        extractor: how the marker is found in a picture: the name of a way in `tracking.markers` or
            of a file in the user's own folder.
        calibration: measured intrinsics and poses; they replace those of `cameras`.
    """

    name: str
    description: str
    cameras: tuple[CameraProfile, CameraProfile]
    needle: NeedleProfile
    range: RangeProfile
    rate_hz: float = Field(gt=0.0, le=1000.0)
    noise_grey: float = Field(ge=0.0)
    blur_px: float = Field(gt=0.0, le=5.0)
    latency_ms: float = Field(ge=0.0)
    skew_ms: float
    systematic_px: float = Field(ge=0.0)
    line_sd_mm: float = Field(gt=0.0)
    extractor: str = "model_fit"
    calibration: StereoCalibration | None = None

    @cached_property
    def models(self) -> tuple[CameraModel, CameraModel]:
        """Both cameras, in the profile's order."""
        if self.calibration is not None:
            return self.calibration.models()
        first, second = (camera.model() for camera in self.cameras)
        return first, second

    def of_second_band(self) -> "RigProfile | None":
        """Return this rig with the second band as its only one; None if there is none."""
        offset = self.needle.second_marker_offset_mm
        if offset is None:
            return None
        needle = self.needle.model_dump() | {"second_marker_offset_mm": None}
        changed = {"needle": needle | {"marker_offset_mm": offset}}
        return RigProfile.model_validate(
            self.model_dump() | changed | {"calibration": self.calibration}
        )

    def calibrated(self, calibration: StereoCalibration) -> "RigProfile":
        """Return this rig with measured cameras, for every use and for the record.

        Raises:
            RigError: if the calibration has no world frame, or is of cameras with other names.
        """
        if calibration.world is None:
            raise RigError(
                f"calibration {calibration.id} has no world frame; lay the board at its known "
                "place and run `acus calibrate world`"
            )
        names = tuple(camera.name for camera in calibration.cameras)
        wanted = tuple(camera.name for camera in self.cameras)
        if names != wanted:
            raise RigError(
                f"calibration {calibration.id} is of the cameras {', '.join(names)}; rig "
                f"{self.name} has {', '.join(wanted)}"
            )
        # A copy would take the cached models along.
        return RigProfile.model_validate(self.model_dump() | {"calibration": calibration})


def shipped_rigs() -> list[str]:
    """Names of the rig profiles that come with the program."""
    return sorted(path.stem for path in (paths.resources() / "cameras").glob("*.yaml"))


def load_rig(name_or_path: str | Path) -> RigProfile:
    """Load a shipped profile by name, or one from a file.

    Raises:
        RigError: if no profile has that name.
        ConfigurationError: if the file is not a valid profile; names field and value.
    """
    path = Path(name_or_path)
    if path.suffix not in {".yaml", ".yml"}:
        path = paths.resources() / "cameras" / f"{name_or_path}.yaml"
        if not path.is_file():
            names = ", ".join(shipped_rigs())
            raise RigError(
                f"no camera rig is called {str(name_or_path)!r}; there are {names}, "
                "or give the path of a .yaml file"
            )
    profile = load(path, RigProfile)
    _ = profile.models  # builds the cameras: an impossible pose is refused here, not later
    return profile
