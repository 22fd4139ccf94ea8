"""One plane through a volume in millimetres: x to the right and y down on the screen.

A pane shows one of a stack of parallel planes, told apart by a float `index`. Whatever its
direction and however it is turned, a plane is the place of its slice 0, the way from one slice to
the next, and where its values come from: the volume's own slices as they are (`is_native`), or
interpolation.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.imaging.orthogonal import OrthogonalSlicer, View, letters
from app.imaging.reformat import Frame
from app.imaging.volume import Volume
from app.views.slices.panes import PaneId
from app.views.slices.presentation import Presentation, Slab
from app.views.slices.slab import PlanePoint

HALF_SLAB_MM = 2.0
"""Half thickness of the slab [mm] within which needle and plan count as in the slice."""

FIELD_MM = 180.0
"""Width and height that a needle's pane shows at first."""

MOST_PIXELS = 1024
"""Columns or rows that a whole interpolated picture has at most."""

AS_IT_LIES = Presentation()
"""Neither turned nor thick."""

_CUBE = np.array(list(product((0.0, 1.0), repeat=3)))

Rect = tuple[float, float, float, float]
"""Left, top, width and height [mm]."""


@dataclass(frozen=True, slots=True, eq=False)
class SlicePlane:
    """Maps between LPS [mm] and a stack of parallel planes; compares by identity.

    Attributes:
        pane: where it is shown.
        volume: the CT.
        first: place and screen directions of slice 0.
        to_next_mm: from one slice to the next, LPS, shape (3,); slanted where a gantry was tilted.
        ahead: unit direction in which indices go up, along the normal, LPS, shape (3,).
        count: number of slices from one end of the volume to the other.
        step_mm: distance between slices of neighbouring indices [mm].
        half_slab_mm: half thickness of what counts as in the slice [mm].
        bounds_mm: rectangle that the volume fills in the plane.
        home_mm: rectangle that a pane shows at first.
        ends: indices at the two ends of the volume.
        slicer: where the volume's own slices come from; None for an interpolated plane.
        slices: how many of the volume's own slices a picture is made of.
        presentation: how the pane shows it, turned and thick; already part of all else.
        plain: the plane as it lies in the patient, neither turned nor thick; None for itself.
    """

    pane: PaneId
    volume: Volume
    first: Frame
    to_next_mm: FloatArray
    ahead: FloatArray
    count: int
    step_mm: float
    half_slab_mm: float
    bounds_mm: Rect
    home_mm: Rect
    ends: tuple[float, float]
    slicer: OrthogonalSlicer | None = None
    slices: int = 1
    presentation: Presentation = AS_IT_LIES
    plain: SlicePlane | None = None
    _axes: tuple[float, ...] = field(init=False)
    _next: tuple[float, float, float] = field(init=False)
    _per_mm: float = field(init=False)
    _axis: int = field(init=False)
    _frames: dict[float, Frame] = field(init=False)

    def __post_init__(self) -> None:
        axes = np.stack([self.first.right, self.first.down, self.ahead])
        origin, step = axes @ self.first.origin_mm, axes @ self.to_next_mm
        rows = np.column_stack([axes, -origin])
        object.__setattr__(self, "_axes", tuple(rows.ravel().tolist()))
        object.__setattr__(self, "_next", tuple(step.tolist()))
        object.__setattr__(self, "_per_mm", 1.0 / float(step[2]))
        object.__setattr__(self, "_axis", int(np.argmax(np.abs(self.ahead))))
        object.__setattr__(self, "_frames", {})

    @property
    def is_native(self) -> bool:
        """Return whether it shows the volume's own slices, at whole indices, not interpolated
        ones.
        """
        return self.slicer is not None

    @property
    def extent_mm(self) -> tuple[float, float]:
        """Width and height of the image [mm]."""
        return self.bounds_mm[2:]

    @property
    def thickness_mm(self) -> float:
        """Thickness of what a picture shows together [mm]; 0 where it is one slice, or a plane."""
        slab = self.presentation.slab
        if not slab:
            return 0.0
        return self.slices * self.step_mm if self.is_native else slab.thickness_mm

    @property
    def normal_axis(self) -> int:
        """Patient axis (0 left, 1 posterior, 2 superior) that the slices' normal follows most."""
        return self._axis

    @property
    def tilt_deg(self) -> float:
        """Angle between the slices' normal and the patient axis that it follows most [°]."""
        return float(np.degrees(np.arccos(min(1.0, np.abs(self.ahead).max()))))

    @property
    def finest_mm(self) -> float:
        """The volume's finest spacing [mm]."""
        return float(self.volume.spacing_mm.min())

    def towards(self, distance: float) -> str:
        """Patient letter of the side of the slice on which this signed distance lies."""
        axis = self.normal_axis
        positive = (self.ahead[axis] > 0) == (distance > 0)
        return "RLAPIS"[2 * axis + positive]

    def letters(self) -> tuple[str, str, str, str]:
        """Patient letters at the left, right, top and bottom edge."""
        return _letters(*(round(share, 3) for share in (*self._axes[:3], *self._axes[4:7])))

    # --- places -------------------------------------------------------------------------------
    def point(self, lps_mm: ArrayLike, index: float) -> PlanePoint:
        """Return where an LPS point [mm] appears in slice `index`, and how far ahead of it it is.

        Raises:
            NumericalError: if the point has not three coordinates.
        """
        at: Any = lps_mm.tolist() if isinstance(lps_mm, np.ndarray) else lps_mm
        try:
            p, q, r = at
        except (TypeError, ValueError):
            raise NumericalError(f"a point has three coordinates [mm], not {at}") from None
        a, b, c, d, e, f, g, h, i, j, k, m = self._axes  # plain numbers: small arrays are slow
        x, y, z = self._next
        return PlanePoint(
            a * p + b * q + c * r + d - index * x,
            e * p + f * q + g * r + h - index * y,
            i * p + j * q + k * r + m - index * z,
        )

    def lps_mm(self, x: float, y: float, index: float) -> FloatArray:
        """LPS point [mm] of a place in slice `index`, shape (3,)."""
        return self.first.lps_mm(x, y) + index * self.to_next_mm

    def frame(self, index: float) -> Frame:
        """Place and screen directions of slice `index`, in the coordinates of `point`."""
        known = self._frames.get(index)
        if known is None:  # asked for by every trace in the slice
            self._frames.clear()
            known = self.first.at(self.first.origin_mm + index * self.to_next_mm)
            self._frames[index] = known
        return known

    def index_at(self, lps_mm: ArrayLike) -> float:
        """Slice that shows an LPS point [mm]; of native ones the nearest there is, whole."""
        index = self.point(lps_mm, 0.0).distance * self._per_mm
        return self._whole(index) if self.is_native else index

    def kept(self, index: float, lps_mm: ArrayLike) -> float:
        """Slice nearest to `index` that there is straight ahead or behind of an LPS point [mm]."""
        if self.is_native:
            return self._whole(index)
        first, last = _inside(self.volume, np.asarray(lps_mm, np.float64), self.ahead)
        here = self.index_at(lps_mm)
        if not first <= last:  # the line passes by the volume
            first, last = ((end - here) * self.step_mm for end in self.ends)
        return min(max(index, here + first / self.step_mm), here + last / self.step_mm)

    def _whole(self, index: float) -> float:
        return float(round(min(max(index, 0.0), self.count - 1.0)))

    # --- values -------------------------------------------------------------------------------
    def image(self, index: float) -> NDArray[Any]:
        """Hounsfield units on `bounds_mm`, shape (rows, columns), in screen orientation.

        Native slices are handed out without a copy unless they are thick; other planes are
        interpolated at the volume's finest spacing.
        """
        if self.slicer is not None:
            turn, picture = self.presentation.turn, self._slices_at(self.slicer, round(index))
            if turn.mirrored:
                picture = picture[:, ::-1]
            return np.rot90(picture, -turn.quarters)  # its turns are counter-clockwise
        left, top, width, height = self.bounds_mm
        pixel = max(self.finest_mm, width / MOST_PIXELS, height / MOST_PIXELS)
        columns, rows = max(1, round(width / pixel)), max(1, round(height / pixel))
        return self.pixels(index, (left, top), pixel, columns, rows)

    def _slices_at(self, slicer: OrthogonalSlicer, middle: int) -> NDArray[Any]:
        view = View(self.pane)
        if self.slices == 1:
            return slicer.image(view, middle)
        from app.imaging.slab import slices_image  # compiled: loaded since there is a volume

        first = max(0, middle - (self.slices - 1) // 2)
        last = min(self.count, middle + self.slices // 2 + 1)
        return slices_image(slicer.images(view, first, last), self.presentation.slab.projection)

    def pixels(
        self, index: float, corner: tuple[float, float], pixel_mm: float, columns: int, rows: int
    ) -> NDArray[np.float32]:
        """Hounsfield units of any rectangle, trilinear, float32, shape (rows, columns).

        Args:
            index: of the slice.
            corner: left and top edge [mm].
            pixel_mm: size of a pixel.
            columns: width of the picture.
            rows: height of the picture.
        """
        from app.imaging.oblique import oblique_image  # compiled: loaded since there is a volume

        plane = self.frame(index).pixels(*corner, pixel_mm, columns, rows, 0.0)
        slab = self.presentation.slab
        if slab:
            from app.imaging.slab import slab_image

            return slab_image(self.volume, plane, slab.thickness_mm, slab.projection)
        return oblique_image(self.volume, plane)


def own_plane(slicer: OrthogonalSlicer, view: View) -> SlicePlane:
    """Axial, sagittal or coronal plane of a volume, right-angled and to scale in any case.

    Where a gantry tilt shears the volume's own pictures of the view, they are interpolated.
    """
    corner, ahead = (slicer.to_lps_mm(view, index, 0.0, 0.0) for index in (0.0, 1.0))
    to_next = ahead - corner
    if not slicer.is_right_angled(view):
        frame = Frame(corner, *slicer.straight_axes(view))
        return reformat_plane(slicer.volume, frame, PaneId(view), to_next)
    width, height = slicer.pixel_size_mm(view)
    rows, columns = slicer.shape(view)
    corner, right, down = (
        slicer.to_lps_mm(view, 0.0, *at) for at in ((-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5))
    )
    first = Frame.of(corner, right - corner, down - corner)
    step_mm, bounds = slicer.slice_spacing_mm(view), (0.0, 0.0, columns * width, rows * height)
    return SlicePlane(
        pane=PaneId(view),
        volume=slicer.volume,
        first=first,
        to_next_mm=frozen(to_next),
        ahead=frozen(first.normal * np.sign(first.normal @ to_next)),
        count=slicer.count(view),
        step_mm=step_mm,
        half_slab_mm=max(HALF_SLAB_MM, step_mm / 2),
        bounds_mm=bounds,
        home_mm=bounds,
        ends=(-0.5, slicer.count(view) - 0.5),
        slicer=slicer,
    )


def reformat_plane(
    volume: Volume,
    frame: Frame,
    pane: PaneId,
    ahead: ArrayLike | None = None,
    from_origin: bool = False,
) -> SlicePlane:
    """Lay planes parallel to a frame through a volume; their pictures are interpolated.

    Places (x, y) are those of the frame, so they stay while the frame turns about a point.

    Args:
        volume: the CT.
        frame: of the plane.
        pane: where it is shown.
        ahead: the side of the frame towards which indices go up; into the screen if None.
        from_origin: index 0 is the frame's own plane, not the first one in the volume.
    """
    normal = frame.normal
    sign = 1.0 if ahead is None or float(np.asarray(ahead) @ normal) >= 0.0 else -1.0
    along = volume.direction.T @ normal  # share of each voxel axis
    step_mm = float(np.linalg.norm(along * volume.spacing_mm))
    places = (_corners(volume) - frame.origin_mm) @ np.column_stack(
        [frame.right, frame.down, normal]
    )
    (left, top), (right, bottom) = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
    bounds = (float(left), float(top), float(right - left), float(bottom - top))
    heights = sign * places[:, 2]
    least, most = float(heights.min()), float(heights.max())
    zero = 0.0 if from_origin else least
    around_needle = (-FIELD_MM / 2, -FIELD_MM / 2, FIELD_MM, FIELD_MM)
    return SlicePlane(
        pane=pane,
        volume=volume,
        first=frame.moved(sign * zero),
        to_next_mm=frozen(sign * step_mm * normal),
        ahead=frozen(sign * normal),
        count=int((most - least) / step_mm) + 1,
        step_mm=step_mm,
        half_slab_mm=HALF_SLAB_MM,
        bounds_mm=bounds,
        home_mm=around_needle if from_origin else bounds,  # so that millimetres show
        ends=((least - zero) / step_mm, (most - zero) / step_mm),
    )


def presented(plane: SlicePlane, presentation: Presentation) -> SlicePlane:
    """Return a plane as a pane presents it: turned by quarters, mirrored, thick."""
    plain = plane.plain or plane
    if not presentation.turn and not presentation.slab:
        return plain
    slices, thickness = _thick(plain, presentation.slab)
    first, bounds = _turned(plain.first, plain.bounds_mm, presentation, plain.is_native)
    _, home = _turned(plain.first, plain.home_mm, presentation, plain.is_native)
    return replace(
        plain,
        first=first,
        bounds_mm=bounds,
        home_mm=home,
        half_slab_mm=max(plain.half_slab_mm, thickness / 2),
        slices=slices,
        presentation=presentation,
        plain=plain,
    )


def _thick(plain: SlicePlane, slab: Slab) -> tuple[int, float]:
    """Return how many whole slices a slab takes, and how thick it is [mm]."""
    if not plain.is_native:
        return 1, slab.thickness_mm
    slices = max(1, round(slab.thickness_mm / plain.step_mm)) if slab else 1
    return slices, slices * plain.step_mm


def _turned(
    frame: Frame, rect: Rect, presentation: Presentation, from_corner: bool
) -> tuple[Frame, Rect]:
    """Turn what is seen about the frame's origin, or so that its rectangle begins at (0, 0)."""
    turn = presentation.turn
    turned = frame.quarter(turn.quarters, turn.mirrored)
    left, top, width, height = rect
    corners = [frame.lps_mm(x, y) for x in (left, left + width) for y in (top, top + height)]
    places = np.array([turned.point(corner)[:2] for corner in corners])
    left, top = places.min(axis=0).tolist()
    width, height = np.ptp(places, axis=0).tolist()
    if from_corner:
        return turned.at(turned.lps_mm(left, top)), (0.0, 0.0, width, height)
    return turned, (left, top, width, height)


@lru_cache(maxsize=256)
def _letters(*directions: float) -> tuple[str, str, str, str]:
    """Letters at the edges of a plane, by its directions to the right and down."""
    right, down = np.array(directions[:3]), np.array(directions[3:])
    return letters(-right), letters(right), letters(-down), letters(down)


def _corners(volume: Volume) -> FloatArray:
    """Outer corners of the outermost voxels in LPS [mm], shape (8, 3)."""
    ends = _CUBE * volume.size - 0.5
    corners: FloatArray = ends @ volume.affine_mm[:3, :3].T + volume.affine_mm[:3, 3]
    return corners


def _inside(volume: Volume, start: FloatArray, direction: FloatArray) -> tuple[float, float]:
    """Distances [mm] from a point along a unit direction between which voxel centres enclose it."""
    at = volume.voxel(start)
    step = volume.inverse_mm[:3, :3] @ direction
    first, last = -np.inf, np.inf
    for position, rate, size in zip(at, step, volume.size, strict=True):
        if abs(rate) < 1e-12:
            if not -1e-6 <= position <= size - 1 + 1e-6:
                return np.inf, -np.inf
            continue
        one, other = sorted((-position / rate, (size - 1 - position) / rate))
        first, last = max(first, one), min(last, other)
    return float(first), float(last)
