"""Pure geometry of the bull's-eye pad: needle direction ↔ two tilts ↔ a place on the pad.

The pad looks along the planned path, from the hub towards the target. Its plane is the one
through the target, perpendicular to the path; its axes are chosen from the patient, so that
sideways on the pad is a tilt within the axial plane ("in plane") and up is a tilt towards the head
("out of plane").

Tilts are the azimuthal equidistant coordinates of the direction about the path: the vector of
length θ (the angle to the path) that points where the tip goes. They are regular on the path
itself, where an azimuth would not exist, and one-to-one up to θ = π.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import asinh, atan2, cos, degrees, hypot, pi, sin, sinh, sqrt, tan
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit
from app.core.errors import NumericalError
from app.core.messages import sentence

_LEFT: Final = (1.0, 0.0, 0.0)  # LPS
_ANTERIOR: Final = (0.0, -1.0, 0.0)
_SUPERIOR: Final = (0.0, 0.0, 1.0)
_ALONG_THE_BODY: Final = 0.95
"""Above this |path · superior| the head direction no longer gives the pad a stable "up"."""


@dataclass(frozen=True, slots=True)
class PathFrame:
    """Right-handed frame of the pad in world; `right × up = -axis`: the path leads into the screen.

    Attributes:
        axis: wanted needle direction, hub to tip, unit, shape (3,).
        right, up: axes of the pad, unit, shape (3,).
        letters: patient directions at the pad's left, right, top and bottom edge.
        axial: True when `right` lies in the axial plane, so that "in plane" means the CT slice.
        R_world_patient: rotation of the patient, shape (3, 3).
    """

    axis: FloatArray
    right: FloatArray
    up: FloatArray
    letters: tuple[str, str, str, str]
    axial: bool
    R_world_patient: FloatArray

    def tilts(self, direction: ArrayLike) -> FloatArray:
        """Tilts of a needle direction against the path [rad], (3,) -> (2,): to the right, upwards.

        Exactly against the path, where every answer is equally right, the tilt is (π, 0).

        Raises:
            NumericalError: if the direction is not finite or has no length.
        """
        needle = unit(direction, "needle direction")
        a, b = float(needle @ self.right), float(needle @ self.up)
        sideways, along = hypot(a, b), float(needle @ self.axis)
        if sideways < 1e-150:
            return np.array([0.0 if along > 0.0 else pi, 0.0])
        return np.array([a, b]) * (atan2(sideways, along) / sideways)

    def ct_angles(self, direction: ArrayLike, near: float = 0.0) -> tuple[float, float]:
        """Angles of a needle direction in world against the CT's axial slices [°]: `ct_angles`."""
        return ct_angles(self.R_world_patient.T @ unit(direction, "needle direction"), near)

    def direction(self, tilts: ArrayLike) -> FloatArray:
        """Needle direction of two tilts [rad], (2,) -> unit (3,): the inverse of `tilts`."""
        a, b = frozen(tilts, (2,), "tilts")
        angle = hypot(a, b)
        sinc = sin(angle) / angle if angle > 1e-150 else 1.0
        return unit(cos(angle) * self.axis + sinc * (a * self.right + b * self.up))

    def offset(self, p_world: ArrayLike, p_entry: ArrayLike) -> FloatArray:
        """Lateral offset [m] of a point from the path's line, shape (2,): to the right, upwards."""
        delta = np.asarray(p_world, dtype=np.float64) - np.asarray(p_entry, dtype=np.float64)
        return np.array([delta @ self.right, delta @ self.up])


def path_frame(axis_world: ArrayLike, R_world_patient: ArrayLike) -> PathFrame:
    """Frame of the pad for a path [world] and a patient on the table.

    `up` is the patient's head direction seen along the path; for a path along the body, where
    that is undefined, the anterior direction.

    Raises:
        NumericalError: if the path has no direction.
    """
    axis = unit(axis_world, "path")
    rotation = frozen(R_world_patient, (3, 3), "patient rotation")
    superior = rotation @ _SUPERIOR
    axial = bool(abs(axis @ superior) <= _ALONG_THE_BODY)
    reference = superior if axial else rotation @ _ANTERIOR
    up = unit(reference - (reference @ axis) * axis)
    right = np.cross(axis, up)  # up × (-axis): the path points away from the viewer
    left, right_side, top, bottom = (
        direction_letters(rotation.T @ side) for side in (-right, right, up, -up)
    )
    edges = (left, right_side, top, bottom)
    return PathFrame(frozen(axis), frozen(right), frozen(up), edges, axial, rotation)


def ct_angles(direction_lps: ArrayLike, near: float = 0.0) -> tuple[float, float]:
    """In-plane and out-of-plane angle [°] of a needle, as one sets them at a CT.

    In-plane is the angle in the axial slice from the patient's left-right line, atan2(dy, dx)
    folded to ±90° about `near`, since a needle and its opposite lie on one line there; out-of-plane
    is atan2(dz, |(dx, dy)|), positive towards the head. The definitions are those of NeedlePath (3D
    Slicer).

    A needle that swings through ±90° reads on without a jump where `near` is the angle of its path:
    the fold is then where it would lie across that path. Along the body, where no line is left in
    the axial slice, the angle in it is `near`.

    Args:
        direction_lps: of the needle in the patient, shape (3,).
        near: middle of the range of the in-plane angle [°].

    Raises:
        NumericalError: if the direction is not finite or has no length.
    """
    x, y, z = unit(direction_lps, "needle direction").tolist()
    across = hypot(x, y)
    turn = degrees(atan2(y, x)) - near if across > 1e-12 else 0.0
    in_plane = near + 90.0 - (90.0 - turn) % 180.0
    return in_plane, degrees(atan2(z, across))


def direction_letters(direction_lps: ArrayLike) -> str:
    """Patient letters of a direction by falling share, those above 0.35: `L`, `AS`, ..."""
    shares = unit(direction_lps, "patient direction")
    pairs = ("RL", "AP", "IS")
    order = np.argsort(-np.abs(shares), kind="stable")
    return "".join(pairs[i][int(shares[i] > 0.0)] for i in order if abs(shares[i]) > 0.35)


@dataclass(frozen=True, slots=True)
class PadScale:
    """Radial scale of the pad: wide in the middle, where the millimetres count, and monotone.

    ρ(θ) = asinh(θ/θ₀) / asinh(π/2 / θ₀): 0 on the path, 1 at a right angle to it. Linear well
    inside θ₀ (the tolerance), logarithmic outside, so that both 1 mm and 80° have their place.

    Attributes:
        length: entry to target [m].
        tolerance: radius of the innermost ring [m].
    """

    length: float
    tolerance: float

    def __post_init__(self) -> None:
        if not (0.0 < self.length < 10.0 and 0.0 < self.tolerance < 10.0):
            raise NumericalError(
                sentence(
                    "pad scale needs a path length and a tolerance between 0 and 10 m, "
                    "got {length} and {tolerance}",
                    length=self.length,
                    tolerance=self.tolerance,
                )
            )

    @property
    def knee(self) -> float:
        """θ₀ [rad]: the angle at which the needle misses the target by the tolerance."""
        return atan2(self.tolerance, self.length)

    def radius(self, angle: float) -> float:
        """Place on the pad of an angle to the path [rad]; 1 is the rim."""
        return asinh(angle / self.knee) / asinh(0.5 * pi / self.knee)

    def radii(self, angles: FloatArray) -> FloatArray:
        """Places on the pad of many angles [rad], as `radius` gives them; NaN stays NaN."""
        result: FloatArray = np.arcsinh(angles / self.knee) / asinh(0.5 * pi / self.knee)
        return result

    def angle(self, radius: float) -> float:
        """Angle to the path [rad] of a place on the pad: the inverse of `radius`, at most π."""
        exponent = radius * asinh(0.5 * pi / self.knee)
        return self.knee * sinh(min(exponent, asinh(pi / self.knee)))

    def place(self, tilts: ArrayLike) -> FloatArray:
        """Place on the pad of two tilts, (2,) -> (2,)."""
        return _scaled(tilts, self.radius)

    def tilts(self, place: ArrayLike) -> FloatArray:
        """Tilts of a place on the pad, (2,) -> (2,): the inverse of `place`."""
        return _scaled(place, self.angle)

    def place_of_offset(self, offset: ArrayLike) -> FloatArray:
        """Place on the pad of a lateral offset [m] in the target's plane, (2,) -> (2,).

        The angle of an offset r is atan(r / length): the direction from the entry that pierces the
        target's plane there. So tip and direction share one scale and meet at the target, and
        every offset stays inside the rim.
        """
        return _scaled(offset, lambda r: self.radius(atan2(r, self.length)))

    def offset_of_angle(self, angle: float) -> float:
        """Offset [m] where a needle at this angle [rad] meets the target's plane; inf from π/2."""
        return self.length * tan(angle) if angle < 0.5 * pi else float("inf")


def _scaled(vector: ArrayLike, scale: Callable[[float], float]) -> FloatArray:
    a, b = frozen(vector, (2,), "pad vector")
    length = hypot(a, b)
    if length < 1e-150:
        return np.zeros(2)
    return np.array([a, b]) * (scale(length) / length)


def clamp_to_cone(direction: ArrayLike, limit: float) -> FloatArray:
    """Nearest direction whose tilt from straight down is within `limit` [rad], in [0, π/2).

    Raises:
        NumericalError: if the limit is outside [0, π/2) or the direction has no length.
    """
    if not 0.0 <= limit < 0.5 * pi:
        raise NumericalError(sentence("tilt limit {limit} rad is outside [0, π/2)", limit=limit))
    x, y, z = unit(direction, "needle direction")
    sideways = hypot(x, y)
    if atan2(sideways, -z) <= limit:
        return np.array([x, y, z])
    a, b = (x / sideways, y / sideways) if sideways > 1e-150 else (1.0, 0.0)
    return np.array([a * sin(limit), b * sin(limit), -cos(limit)])


def downward(x: float, y: float) -> FloatArray:
    """Return the unit direction with these horizontal components that points down, shape (3,)."""
    return np.array([x, y, -sqrt(max(0.0, 1.0 - x * x - y * y))])
