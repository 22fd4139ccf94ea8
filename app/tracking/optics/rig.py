"""Rig profiles: two cameras, the needle they watch, and what they see of where it may be.

The band's centre lies in a cone through the fulcrum: any azimuth, any tilt up to the largest, any
depth of the range. It is sampled so that every part of the cone's angle and every depth counts the
same: the share that both cameras see is a share of directions and depths, not of volume.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Final, NamedTuple, Self

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from app.core import paths
from app.core.arrays import FloatArray, unit
from app.core.configuration import Strict, load
from app.core.messages import listed, sentence
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.errors import RigError
from app.tracking.optics.calibration import StereoCalibration, require_coefficients
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.lens import LensModel

Triple = tuple[float, float, float]

OFFSET_SD_MM: Final = 0.1
"""How exactly a band's place on a needle is measured, standard deviation [mm]: an estimate for
callipers and a band whose edges are put on by hand."""


class CameraProfile(Strict):
    """One camera as YAML gives it.

    Attributes:
        focal_px: fx, fy.
        centre_px: cx, cy; pixel (0, 0) is the centre of the upper left pixel.
        distortion: coefficients of `lens` in OpenCV's order: k1, k2, p1, p2, k3 of the usual one.
        lens: model of the distortion.
        position_mm: centre of projection in world.
        looks_at_mm: any point on the optical axis, in world.
        roll_deg: turn of the picture about the optical axis; at 0 the world's z points up in it.
    """

    name: str = Field(min_length=1)
    image_size: tuple[int, int]
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    distortion: tuple[float, ...]
    lens: LensModel = LensModel.BROWN
    position_mm: Triple
    looks_at_mm: Triple
    roll_deg: float = 0.0

    @model_validator(mode="after")
    def _counted(self) -> Self:
        require_coefficients(self.lens, self.distortion)
        return self

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
            self.lens,
        )

    def _pose(self) -> RigidTransform:
        position = np.array(self.position_mm) * MILLIMETRE
        line = np.array(self.looks_at_mm) * MILLIMETRE - position
        if np.hypot(line[0], line[1]) < 1e-6:
            raise RigError(
                sentence(
                    "camera {name}: looks_at_mm {looks_at_mm} lies straight above, below or "
                    "at position_mm {position_mm}; move it sideways: the roll needs that",
                    name=self.name,
                    looks_at_mm=self.looks_at_mm,
                    position_mm=self.position_mm,
                )
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
        marker_offset_sd_mm: standard deviation of that. Where it is not given it is `OFFSET_SD_MM`
            before cameras that were calibrated, and 0 before those of the profile: pictures that
            are rendered by a profile hold the needle of that profile.
        hidden_mm: from where to where the band's centre stands beyond the fulcrum while the tube
            hides it; None for a rig that sees it everywhere.
        second_marker_offset_mm: centre of a second band, like the first, behind the tip; further
            back than the first. Two bands give the needle's axis too. None for one band.
    """

    length_mm: float = Field(gt=0.0)
    shaft_diameter_mm: float = Field(gt=0.0)
    point_length_mm: float = Field(gt=0.0)
    marker_offset_mm: float = Field(ge=0.0)
    marker_offset_sd_mm: float | None = Field(default=None, ge=0.0, le=10.0)
    marker_length_mm: float = Field(gt=0.0)
    marker_diameter_mm: float = Field(gt=0.0)
    hidden_mm: tuple[float, float] | None = None
    second_marker_offset_mm: float | None = None

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.hidden_mm is not None and not self.hidden_mm[0] < self.hidden_mm[1]:
            raise ValueError(
                sentence(
                    "hidden_mm {hidden_mm} must name the smaller depth first, or be left "
                    "out where nothing hides the band",
                    hidden_mm=list(self.hidden_mm),
                )
            )
        second = self.second_marker_offset_mm
        least = self.marker_offset_mm + 1.5 * self.marker_length_mm
        if second is not None and not least <= second < self.length_mm:
            raise ValueError(
                sentence(
                    "second_marker_offset_mm {second} must lie between {least} (half a band's "
                    "length of bare shaft behind the first) and the needle's length of "
                    "{length_mm}",
                    second=second,
                    least=least,
                    length_mm=self.length_mm,
                )
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
    def shape(self) -> NeedleShape:
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


class PicturePart(Strict):
    """How an effect acts on pictures: which of its models, and what replaces its defaults."""

    model: str = ""
    parameters: dict[str, float] = Field(default_factory=dict)


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
        pictures: effects on the pictures of its simulated cameras, by their names, unless an
            exercise asks for one of them otherwise: what real ones do by themselves.
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
    pictures: dict[str, PicturePart] = Field(default_factory=dict)
    calibration: StereoCalibration | None = None

    @cached_property
    def models(self) -> tuple[CameraModel, CameraModel]:
        """Both cameras, in the profile's order."""
        if self.calibration is not None:
            return self.calibration.models()
        first, second = (camera.model() for camera in self.cameras)
        return first, second

    @property
    def marker_offset_variance(self) -> float:
        """Variance of the distance from the band's centre to the tip [m²]."""
        stated = self.needle.marker_offset_sd_mm
        usual = OFFSET_SD_MM if self.calibration is not None else 0.0
        return ((usual if stated is None else stated) * MILLIMETRE) ** 2

    def of_second_band(self) -> RigProfile | None:
        """Return this rig with the second band as its only one; None if there is none."""
        offset = self.needle.second_marker_offset_mm
        if offset is None:
            return None
        needle = self.needle.model_dump() | {"second_marker_offset_mm": None}
        changed = {"needle": needle | {"marker_offset_mm": offset}}
        return RigProfile.model_validate(
            self.model_dump() | changed | {"calibration": self.calibration}
        )

    def calibrated(self, calibration: StereoCalibration) -> RigProfile:
        """Return this rig with measured cameras, for every use and for the record.

        Raises:
            RigError: if the calibration has no world frame, or is of cameras with other names.
        """
        if calibration.world is None:
            raise RigError(
                sentence(
                    "calibration {calibration_id} has no world frame; lay the board at its known "
                    "place and run `acus calibrate world`",
                    calibration_id=calibration.id,
                )
            )
        names = tuple(camera.name for camera in calibration.cameras)
        wanted = tuple(camera.name for camera in self.cameras)
        if names != wanted:
            raise RigError(
                sentence(
                    "calibration {calibration_id} is of the cameras {names}; rig "
                    "{name} has {wanted}",
                    calibration_id=calibration.id,
                    names=", ".join(names),
                    name=self.name,
                    wanted=", ".join(wanted),
                )
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
                sentence(
                    "no camera rig is called {name_or_path!r}; there are {names}, "
                    "or give the path of a .yaml file",
                    name_or_path=str(name_or_path),
                    names=names,
                )
            )
    profile = load(path, RigProfile)
    _ = profile.models  # builds the cameras: an impossible pose is refused here, not later
    return profile


_DEPTHS: Final = 31
_TILTS: Final = 9
_AZIMUTHS: Final = 24


@dataclass(frozen=True, slots=True, eq=False)
class ViewCone:
    """The needle's cone in two pictures.

    Attributes:
        names: of the cameras.
        depth: of the tip at each sample [m], shape (n,).
        azimuth: of each sample [rad], shape (n,); 0 leans towards x.
        seen: whether each camera sees the whole band there, shape (n, 2).
        outlines: convex outline of the band's centres in each picture [px], (m, 2); may reach
            beyond the picture; empty if the camera looks another way.
    """

    names: tuple[str, str]
    depth: FloatArray
    azimuth: FloatArray
    seen: NDArray[np.bool_]
    outlines: tuple[FloatArray, FloatArray]

    @property
    def share(self) -> float:
        """Share of the samples that both cameras see, 0 to 1."""
        return float(self.seen.all(axis=1).mean())

    @property
    def shares(self) -> tuple[float, float]:
        """Share that each camera sees, 0 to 1."""
        left, right = self.seen.mean(axis=0)
        return float(left), float(right)

    def share_at(self, lowest: float, highest: float) -> float:
        """Share that both see between two depths [m]; 0 if no sample lies between them."""
        chosen = (self.depth >= lowest - 1e-9) & (self.depth <= highest + 1e-9)
        return float(self.seen[chosen].all(axis=1).mean()) if chosen.any() else 0.0

    def losses(self) -> tuple[str, ...]:
        """Say for each camera at which depths the band is lost; empty if both see all."""
        return tuple(
            text for i, name in enumerate(self.names) if (text := self._loss(i, name)) is not None
        )

    def _loss(self, index: int, name: str) -> str | None:
        lost = ~self.seen[:, index]
        if not lost.any():
            return None
        if lost.all():
            return sentence("{name} sees nothing of it: the camera looks another way", name=name)
        depths = np.unique(self.depth)
        gone = [d for d in depths if lost[self.depth == d].all()]
        part = [d for d in depths if d not in gone and lost[self.depth == d].any()]
        texts = []
        if gone:
            texts.append(f"everything at {_ranges(gone, depths)}")
        if part:
            texts.append(sentence("part of it at {ranges}", ranges=_ranges(part, depths)))
        return sentence("{name} loses {texts} mm depth", name=name, texts=listed(texts))


def view_cone(
    models: tuple[CameraModel, CameraModel],
    needle: NeedleProfile,
    reach: RangeProfile,
    fulcrum: FloatArray,
) -> ViewCone:
    """Project the cone into both pictures.

    Args:
        models: both cameras in world.
        needle: for the band's length and place.
        reach: depths and largest tilt.
        fulcrum: P_I in world [m], shape (3,).

    Raises:
        RigError: if the range is empty.
    """
    if reach.depth_max_mm < reach.depth_min_mm:
        raise RigError(
            sentence(
                "the range ends at {reach_depth_max_mm:g} mm, above its beginning at "
                "{reach_depth_min_mm:g} mm; swap depth_min_mm and depth_max_mm",
                reach_depth_max_mm=reach.depth_max_mm,
                reach_depth_min_mm=reach.depth_min_mm,
            )
        )
    depth, azimuth, axis = _samples(reach)
    half = 0.5 * needle.marker_length_mm * MILLIMETRE
    centre = fulcrum + (depth - needle.marker_offset)[:, None] * axis
    seen = np.stack(
        [m.sees(centre - half * axis) & m.sees(centre + half * axis) for m in models], axis=1
    )
    left, right = (_outline(model, centre) for model in models)
    names = (models[0].name, models[1].name)
    return ViewCone(names, depth, azimuth, seen, (left, right))


def _samples(reach: RangeProfile) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Depth, azimuth (n,) and direction (n, 3); equal parts of solid angle in the middle of each.

    The outermost ring lies on the rim, so that the outline is the cone's own.
    """
    lowest, highest = reach.depth_min_mm * MILLIMETRE, reach.depth_max_mm * MILLIMETRE
    depths = np.linspace(lowest, highest, _DEPTHS)
    cosines = np.linspace(1.0, np.cos(reach.tilt_max_deg * DEGREE), _TILTS)
    azimuths = np.linspace(0.0, 2.0 * np.pi, _AZIMUTHS, endpoint=False)
    depth, cosine, azimuth = (a.ravel() for a in np.meshgrid(depths, cosines, azimuths))
    sine = np.sqrt(np.maximum(0.0, 1.0 - cosine**2))
    axis = np.column_stack([sine * np.cos(azimuth), sine * np.sin(azimuth), -cosine])
    return depth, azimuth, axis


def _outline(model: CameraModel, points: FloatArray) -> FloatArray:
    uv, ok = model.project(points)
    if ok.sum() < 3:
        return np.empty((0, 2))
    hull = cv2.convexHull(uv[ok].astype(np.float32))
    return hull.reshape(-1, 2).astype(np.float64)


def _ranges(depths: list[float], all_depths: FloatArray) -> str:
    """Write depths [m] as ranges in mm: `-30 to 25, 110 to 120`."""
    index = [int(np.searchsorted(all_depths, d)) for d in depths]
    pieces: list[list[int]] = []
    for i in index:
        if pieces and i == pieces[-1][-1] + 1:
            pieces[-1].append(i)
        else:
            pieces.append([i])
    mm = all_depths / MILLIMETRE
    return ", ".join(
        f"{mm[p[0]]:.0f} to {mm[p[-1]]:.0f}" if len(p) > 1 else f"{mm[p[0]]:.0f}" for p in pieces
    )
