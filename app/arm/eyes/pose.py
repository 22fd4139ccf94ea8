"""Where the tool lies in the robot's frame: from its outlines in two calibrated pictures.

The axis seen by a camera and the camera's centre span a plane; the shaft's line is where both
planes meet,

    n_k = a_k x b_k,   d ~ n₁ x n₂,   a_k = R_k (c_k, 1),   b_k = R_k (cos α_k, sin α_k, 0),

with the centre c_k and the angle α_k of the outline in normalised, undistorted coordinates (each
pixel with its area there). The ray through c_k meets the other camera's plane on that line: each
picture gives a place of the centre of mass, and the tool's is their weighted mean. Before that it
is freed of what makes it another point in each picture:

- Perspective draws the near end larger. With depth z along the line a pixel counts z³: two for the
  length of what it covers, one for its width.
- Seen aslant, at γ from the side, each disc of the tool shows as an ellipse that reaches r tan γ
  along the axis beyond its place, and γ differs from end to end. So one end of a rod reaches out
  further, and a thick handle gains on the shaft. Of a tool of known outline this is computed; any
  other is taken for a rod, and the difference counts as uncertain.

What is left is the centre of the outline's area seen from the side.

The covariance of (centre, direction) follows from those of c and α by the derivatives of these
formulas, to which comes what the calibration does not know. The line's direction has no sign of its
own: it points to the right in the first picture. Which end is the tip is told by the third moment
along the axis: the handle is the heavy end, and the tail is at the tip.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import cos, sin
from typing import Any, Final

import numpy as np

from app.arm.eyes.blob import AreaMoments, ToolBlob, moments
from app.core.arrays import FloatArray, cross, read_only
from app.core.rotation import skew
from app.core.transform import RigidTransform
from app.tracking.confidence import chi_square_quantile
from app.tracking.optics.camera_model import CameraModel
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty

LARGEST_SD: Final = 0.1
"""Standard deviation of the direction [rad] from which on two planes give no line."""

_SLICES: Final = 240
"""Pieces of a tool by which its outline is added up."""

_AGREE: Final = chi_square_quantile(1.0 - 1e-6, 1)
_LONG: Final = 1.2
"""Length over width from which on an outline has the shaft's axis: perspective stretches discs."""

_SKEWED: Final = 0.1
"""Least skewness along the axis, in both pictures, that tells the tip."""

_ENDS_PX: Final = 0.6
"""Standard deviation of the centre along the axis [px]: an end in the shade, or at a dark hole."""

_ASLANT: Final = 0.5
"""Standard deviation of the centre along the axis of a tool of unknown outline, over r tan γ."""

_FLATTEST: Final = 8.0
"""Largest tan γ that is counted with: steeper tools are all but round."""


class ToolStatus(StrEnum):
    """What became of two pictures of the tool."""

    FOUND = "found"
    ROUND = "round"  # a picture shows it end on: no principal axis
    DEGENERATE = "degenerate"  # it lies in the plane of both cameras: every slope fits
    BEHIND = "behind"  # the planes meet behind a camera
    INCONSISTENT = "inconsistent"  # the pictures show different things
    NO_RAY = "no_ray"  # pixels that belong to no direction


class TipEnd(StrEnum):
    """At which end of the axis the tip is."""

    AHEAD = "ahead"
    BEHIND = "behind"
    UNKNOWN = "unknown"  # both ends look alike


@dataclass(frozen=True, slots=True, eq=False)
class ToolOutline:
    """Radius of a tool along its axis, from the handle's end to the tip.

    Attributes:
        at: distance from the handle's end [m], shape (n,), increasing from 0.
        radius: there [m], shape (n,); linear between, a step where two places are the same.
    """

    at: FloatArray
    radius: FloatArray

    @property
    def length(self) -> float:
        """From the handle's end to the tip [m]."""
        return float(self.at[-1])

    @classmethod
    def rod(cls, length: float, radius: float) -> ToolOutline:
        """Return a plain rod [m]."""
        return cls(np.array([0.0, length]), np.array([radius, radius]))

    def centre(self, hidden: float = 0.0, view: tuple[float, float] | None = None) -> float:
        """Distance from the handle's end to the centre of the outline's area [m].

        Args:
            hidden: length at the tip that is not seen [m].
            view: of a camera: where it stands along the axis from the handle's end, and its
                distance from the axis [m]; None from the side.
        """
        places = np.linspace(0.0, max(self.length - hidden, 1e-6), _SLICES + 1)
        step = float(places[1])
        middles = places[1:] - 0.5 * step
        radii = np.interp(middles, self.at, self.radius)
        if view is None:
            return float(np.average(middles, weights=radii))
        slopes = np.clip(np.abs(middles - view[0]) / view[1], 1e-9, _FLATTEST)
        beyond = int(np.ceil(float((radii * slopes).max()) / step))
        seen = middles[0] + step * np.arange(-beyond, _SLICES + beyond)
        apart = (seen[:, None] - middles[None, :]) / slopes[None, :]
        widths = np.sqrt(np.maximum(radii[None, :] ** 2 - apart**2, 0.0).max(axis=1))
        return float(np.average(seen, weights=widths))


@dataclass(frozen=True, slots=True, eq=False)
class AxisSight:
    """The tool's axis as one camera sees it, in normalised coordinates.

    Attributes:
        T_world_camera: pose of the camera.
        centre: of the outline, shape (2,).
        angle: of the axis in (-π/2, π/2].
        spread: covariance of centre and angle, shape (3, 3).
    """

    T_world_camera: RigidTransform
    centre: FloatArray
    angle: float
    spread: FloatArray

    @property
    def along(self) -> FloatArray:
        """Direction of the axis in the picture, shape (2,)."""
        return np.array([cos(self.angle), sin(self.angle)])

    def plane(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return the plane through camera and axis, in world, and how it changes.

        Returns:
            Ray a of the centre, (3,), of third coordinate 1 in the camera's frame; normal a x b,
            (3,), not of length one; their derivatives by centre and angle, (3, 3) each.
        """
        R = self.T_world_camera.rotation
        along = R @ [*self.along, 0.0]
        turned = R @ [-self.along[1], self.along[0], 0.0]
        ray = R @ [*self.centre, 1.0]
        ray_by = np.column_stack([R[:, 0], R[:, 1], np.zeros(3)])
        normal_by = [cross(R[:, 0], along), cross(R[:, 1], along), cross(ray, turned)]
        return ray, cross(ray, along), ray_by, np.column_stack(normal_by)


@dataclass(frozen=True, slots=True, eq=False)
class ToolPose:
    """The tool in the robot's frame; numbers mean something only for `found`.

    Attributes:
        status: see `ToolStatus`.
        p_world: centre of its outline's area, on the axis [m], shape (3,).
        axis_world: unit vector along the shaft, to the right in the first picture, shape (3,).
        covariance: of centre [m] and direction together, shape (6, 6); rank 5.
        tip: at which end of `axis_world` the tip is.
        length: of the bar of the same extent along the axis [m].
        whole: False if a picture's edge cuts it: the centre is then uncertain along the axis.
        chi_square: how far both pictures' centres are apart along the axis, one degree of freedom.
        sights: what both cameras saw, for the fulcrum; empty without a line.
    """

    status: ToolStatus
    p_world: FloatArray
    axis_world: FloatArray
    covariance: FloatArray
    tip: TipEnd = TipEnd.UNKNOWN
    length: float = 0.0
    whole: bool = True
    chi_square: float = 0.0
    sights: tuple[AxisSight, ...] = ()

    @property
    def tip_axis_world(self) -> FloatArray | None:
        """Unit vector from the handle to the tip, shape (3,); None if it cannot be told."""
        if self.status is not ToolStatus.FOUND or self.tip is TipEnd.UNKNOWN:
            return None
        return self.axis_world if self.tip is TipEnd.AHEAD else -self.axis_world


@dataclass(frozen=True, slots=True, eq=False)
class _Outline:
    """Pixels of a blob in normalised coordinates, their weights, and their moments."""

    points: FloatArray
    weights: FloatArray
    moments: AreaMoments


def solve_tool(
    models: tuple[CameraModel, CameraModel],
    blobs: tuple[ToolBlob, ToolBlob],
    outline: ToolOutline | None = None,
    systematic_px: float = 0.05,
    uncertainty: CalibrationUncertainty | None = None,
) -> ToolPose:
    """Find the tool from its outlines in two pictures.

    Args:
        models: both cameras in the robot's frame.
        blobs: what each shows.
        outline: of the tool, if it is known.
        systematic_px: what calibration and outline leave besides noise, standard deviation of
            either end of the tool across itself, and of its centre [px].
        uncertainty: of a calibrated pair of cameras; adds what the calibration does not know.
    """
    first, second = (_seen(model, blob) for model, blob in zip(models, blobs, strict=True))
    if first is None or second is None:
        return _nothing(ToolStatus.NO_RAY)
    outlines = first, second
    sights = tuple(
        sight
        for model, blob, seen in zip(models, blobs, outlines, strict=True)
        if (sight := _sight(model, blob, seen, systematic_px)) is not None
    )
    if len(sights) < 2:
        return _nothing(ToolStatus.ROUND)
    line = _intersection(sights[0], sights[1])
    if line is None:
        return _nothing(ToolStatus.DEGENERATE)
    return _posed(line, sights, blobs, outlines, outline, uncertainty)


def axis_sight(model: CameraModel, blob: ToolBlob, systematic_px: float = 0.05) -> AxisSight | None:
    """Return the axis as one camera sees it; None for a round blob or one that has no rays."""
    seen = _seen(model, blob)
    return None if seen is None else _sight(model, blob, seen, systematic_px)


def _seen(model: CameraModel, blob: ToolBlob) -> _Outline | None:
    rays, found = model.undistort(blob.pixels)
    if not found.all():
        return None
    areas = model.pixel_areas(rays)
    measured = moments(rays, blob.shares, areas, blob.rim, blob.edge_px)
    return _Outline(rays, blob.shares * areas, measured)


def _sight(
    model: CameraModel, blob: ToolBlob, outline: _Outline, systematic_px: float
) -> AxisSight | None:
    seen = outline.moments
    if seen.angle is None or not seen.elongation > _LONG:
        return None
    sd = systematic_px / float(model.intrinsics[:2].min())
    spread = seen.spread + np.diag([sd**2, sd**2, 2.0 * (sd / seen.length) ** 2])
    end = 0.5 * seen.length if blob.cut else _ENDS_PX / float(model.intrinsics[:2].min())
    along = np.array([cos(seen.angle), sin(seen.angle)])
    spread[:2, :2] += end**2 * np.outer(along, along)
    return AxisSight(model.T_world_camera, seen.centre, seen.angle, read_only(spread))


@dataclass(frozen=True, slots=True, eq=False)
class _MeetingLine:
    """A line in world, and how it changes with (c_x, c_y, α) of both pictures.

    Attributes:
        axis: unit vector.
        axis_by: its derivative, (3, 6).
        places: where the ray of each picture's centre meets the line, (2, 3).
        places_by: their derivatives, (2, 3, 6).
        spread: covariance of the six numbers, (6, 6).
        normals: of both planes, (2, 3).
    """

    axis: FloatArray
    axis_by: FloatArray
    places: FloatArray
    places_by: FloatArray
    spread: FloatArray
    normals: FloatArray


def _intersection(first: AxisSight, second: AxisSight) -> _MeetingLine | None:
    """Return the line in which the planes of two sights meet; None where they hardly differ."""
    sights = first, second
    rays, normals = np.zeros((2, 3)), np.zeros((2, 3))
    rays_by, normals_by = np.zeros((2, 3, 6)), np.zeros((2, 3, 6))
    spread = np.zeros((6, 6))
    for k, sight in enumerate(sights):
        at = slice(3 * k, 3 * k + 3)
        rays[k], normals[k], rays_by[k][:, at], normals_by[k][:, at] = sight.plane()
        spread[at, at] = sight.spread
    both = cross(normals[0], normals[1])
    length = float(np.linalg.norm(both))
    if not length > 1e-12:
        return None
    axis = both / length
    both_by = skew(normals[0]) @ normals_by[1] - skew(normals[1]) @ normals_by[0]
    axis_by = (both_by - np.outer(axis, axis @ both_by)) / length
    sign = 1.0 if float(axis @ first.T_world_camera.rotation @ [*first.along, 0.0]) >= 0.0 else -1.0
    axis, axis_by = sign * axis, sign * axis_by
    if not _largest(axis_by @ spread @ axis_by.T) < LARGEST_SD**2:
        return None
    places, places_by = np.zeros((2, 3)), np.zeros((2, 3, 6))
    for k, sight in enumerate(sights):
        other, normal = sights[1 - k], normals[1 - k]
        offset = other.T_world_camera.translation - sight.T_world_camera.translation
        facing = float(normal @ rays[k])
        if abs(facing) < 1e-12:
            return None
        t = float(normal @ offset) / facing
        places[k] = sight.T_world_camera.translation + t * rays[k]
        t_by = (
            offset @ normals_by[1 - k] - t * (rays[k] @ normals_by[1 - k] + normal @ rays_by[k])
        ) / facing
        places_by[k] = np.outer(rays[k], t_by) + t * rays_by[k]
    return _MeetingLine(axis, axis_by, places, places_by, spread, normals)


def _posed(
    line: _MeetingLine,
    sights: tuple[AxisSight, ...],
    blobs: tuple[ToolBlob, ToolBlob],
    outlines: tuple[_Outline, _Outline],
    outline: ToolOutline | None,
    uncertainty: CalibrationUncertainty | None,
) -> ToolPose:
    for sight, place in zip(sights, line.places, strict=True):
        if not float((sight.T_world_camera.inverse() @ place)[2]) > 0.0:
            return _nothing(ToolStatus.BEHIND)
    profiles = [_along(line, k, sights[k], outlines[k]) for k in range(2)]
    whole = not any(blob.cut for blob in blobs)
    length = float(np.mean([profile.length for profile in profiles]))
    tip = _tip(profiles) if whole else TipEnd.UNKNOWN
    shifts, sds = np.array([_aslant(profile, outline, tip) for profile in profiles]).T
    shifts = np.array([profile.centre for profile in profiles]) - shifts
    by = np.einsum("j,kji->ki", line.axis, line.places_by)
    spread = by @ line.spread @ by.T + np.diag(sds**2)  # of both places along the axis
    gap = float(line.axis @ (line.places[0] - line.places[1])) + shifts[0] - shifts[1]
    chi_square = gap**2 / max(float(spread[0, 0] + spread[1, 1] - 2.0 * spread[0, 1]), 1e-300)
    if chi_square > _AGREE:
        return _nothing(ToolStatus.INCONSISTENT)
    weights = _best(spread)
    p_world = weights @ (line.places + np.outer(shifts, line.axis))
    changes = np.vstack([np.einsum("k,kji->ji", weights, line.places_by), line.axis_by])
    covariance = changes @ line.spread @ changes.T
    covariance[:3, :3] += float(weights**2 @ sds**2) * np.outer(line.axis, line.axis)
    if uncertainty is not None:
        covariance += _by_calibration(uncertainty, p_world, line.axis, length, sights)
    return ToolPose(
        ToolStatus.FOUND,
        read_only(p_world),
        read_only(line.axis),
        read_only(covariance),
        tip,
        length,
        whole,
        float(chi_square),
        sights,
    )


@dataclass(frozen=True, slots=True)
class _Profile:
    """How one picture's pixels lie along the line.

    Attributes:
        centre: of the area, from where the ray of the picture's centre meets the line [m].
        length: of the bar of the same variance [m].
        skewness: along the axis.
        extent: from the first to the last pixel [m].
        radius: of the bar of the same variance across [m].
        foot: where the camera stands along the axis, from that centre [m].
        distance: of the camera from the axis [m].
    """

    centre: float
    length: float
    skewness: float
    extent: float
    radius: float
    foot: float
    distance: float


def _along(line: _MeetingLine, k: int, sight: AxisSight, outline: _Outline) -> _Profile:
    """Carry one picture's pixels to the line and take their moments there."""
    R, origin = sight.T_world_camera.rotation, sight.T_world_camera.translation
    along = (outline.points - sight.centre) @ sight.along
    ray, step = R @ [*sight.centre, 1.0], R @ [*sight.along, 0.0]
    normal = line.normals[1 - k]
    place = line.places[k] - origin
    z = float(normal @ place) / (float(normal @ ray) + along * float(normal @ step))
    at = z * (float(line.axis @ ray) + along * float(line.axis @ step)) - float(line.axis @ place)
    weights = outline.weights * np.maximum(z, 0.0) ** 3
    total = float(weights.sum())
    mean = float(weights @ at) / total
    away = at - mean
    variance = float(weights @ away**2) / total
    narrow = float(np.linalg.eigvalsh(outline.moments.covariance)[0])
    return _Profile(
        mean,
        float(np.sqrt(12.0 * variance)),
        float(weights @ away**3) / total / variance**1.5,
        float(np.ptp(at)),
        float(np.sqrt(3.0 * narrow) * np.linalg.norm(place) / np.linalg.norm(ray)),
        -float(line.axis @ place) - mean,
        float(np.linalg.norm(place - float(line.axis @ place) * line.axis)),
    )


def _aslant(profile: _Profile, outline: ToolOutline | None, tip: TipEnd) -> tuple[float, float]:
    """By how much the view aslant moves the centre along the axis, and its deviation [m]."""
    slope = min(abs(profile.foot) / max(profile.distance, 1e-9), _FLATTEST)
    known = outline is not None and tip is not TipEnd.UNKNOWN
    rod = ToolOutline.rod(max(profile.extent - 2.0 * slope * profile.radius, 1e-3), profile.radius)
    tool = outline if outline is not None and known else rod
    hidden = tool.length - profile.extent + slope * float(tool.radius[0])
    if hidden > 0.1 * tool.length:  # an end that is cut off reaches out as the handle's does
        hidden += slope * float(np.interp(profile.extent, tool.at, tool.radius))
    hidden = min(max(0.0, hidden), 0.9 * tool.length) if known else 0.0
    sign = -1.0 if tip is TipEnd.BEHIND else 1.0
    true = tool.centre(hidden)
    shift = tool.centre(hidden, (true + sign * profile.foot, profile.distance)) - true
    return sign * shift, 0.1 * abs(shift) if known else _ASLANT * slope * profile.radius


def _tip(profiles: list[_Profile]) -> TipEnd:
    """Look for the long tail: the handle, the heavy end, is near the centre."""
    least, most = sorted(profile.skewness for profile in profiles)
    if least > _SKEWED:
        return TipEnd.AHEAD
    return TipEnd.BEHIND if most < -_SKEWED else TipEnd.UNKNOWN


def _best(spread: FloatArray) -> FloatArray:
    """Weights of the mean of least variance of two numbers with this covariance, (2,)."""
    first, second = spread[1, 1] - spread[0, 1], spread[0, 0] - spread[0, 1]
    total = first + second
    return np.array([0.5, 0.5]) if not total > 0.0 else np.array([first, second]) / total


def _by_calibration(
    uncertainty: CalibrationUncertainty,
    p_world: FloatArray,
    axis: FloatArray,
    length: float,
    sights: tuple[AxisSight, ...],
) -> FloatArray:
    """Covariance of centre and direction by the calibration alone, from both ends, (6, 6)."""
    ends = np.stack([p_world + 0.5 * length * axis, p_world - 0.5 * length * axis])
    seen = np.stack([sight.spread[:2, :2] for sight in sights])
    joint = uncertainty.joint(ends, np.stack([seen, seen]))
    across = (np.eye(3) - np.outer(axis, axis)) / length
    to_pose = np.block([[0.5 * np.eye(3), 0.5 * np.eye(3)], [across, -across]])
    return np.asarray(to_pose @ joint @ to_pose.T)


def _largest(covariance: FloatArray) -> float:
    return float(np.linalg.eigvalsh(covariance)[-1])


def _nothing(status: ToolStatus) -> ToolPose:
    zeros: Any = (read_only(np.zeros(3)), read_only(np.zeros(3)), read_only(np.zeros((6, 6))))
    return ToolPose(status, *zeros)
