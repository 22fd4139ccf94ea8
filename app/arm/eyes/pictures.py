"""Pictures of a laparoscopic tool and a trocar on a table, with known truth.

The tool is the needle of the simulated cameras in other colours: its shaft is a polished cylinder
that tapers to the tip, its handle the band. The trocar is a flat ring round a dark hole, part of
what stands behind. Light, lens, rays and blur are those of `cameras`; noise and the reflections of
lamps are the effects of `picture_effects` and `obstacles`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.eyes.pose import ToolOutline
from app.arm.laparoscopy import (
    SURROUNDINGS,
    TABLE_TOP,
    TOOL_GREEN,
    TROCAR_BLUE,
    ToolBody,
    TrocarRing,
)
from app.core.arrays import FloatArray, frozen, read_only, unit
from app.core.compiled import njit
from app.core.units import MILLIMETRE
from app.tracking.cameras.camera import Image
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import CameraProfile, NeedleProfile, NeedleShape
from app.tracking.simulated.background import FINE, LIGHT_WORLD, HousingBox, sample_pattern
from app.tracking.simulated.cameras import NeedleRenderer, pixel_rays
from app.tracking.simulated.scene import MarkerScene

_BY_NAME: Final = {box.name: box for box in SURROUNDINGS}
TABLE: Final = tuple(
    HousingBox((box.low[0], box.low[1], min(box.low[2], lowest)), box.high, box.colour)
    for box, lowest in (
        (_BY_NAME["table"], np.inf),
        (_BY_NAME["tray"], np.inf),
        (_BY_NAME["skin"], TABLE_TOP),  # with its frame
    )
)
"""What tool and trocar lie on."""

_HOLE: Final = (24.0, 22.0, 22.0)

_BLUR_PX: Final = 0.7


def needle_profile(tool: ToolBody) -> NeedleProfile:
    """Return a tool as a needle whose band is the handle."""
    return NeedleProfile(
        length_mm=tool.length / MILLIMETRE,
        shaft_diameter_mm=tool.shaft_diameter / MILLIMETRE,
        point_length_mm=tool.point_length / MILLIMETRE,
        marker_offset_mm=(tool.length - 0.5 * tool.handle_length) / MILLIMETRE,
        marker_length_mm=tool.handle_length / MILLIMETRE,
        marker_diameter_mm=tool.handle_diameter / MILLIMETRE,
    )


def tool_outline(tool: ToolBody) -> ToolOutline:
    """Radius along a tool, as it is drawn."""
    shape = needle_profile(tool).shape
    handle, point = 2.0 * shape.half, shape.tip + shape.half - shape.point
    end = shape.tip + shape.half
    at = np.array([0.0, handle, handle, point, end])
    radius = np.array([shape.radius, shape.radius, shape.shaft, shape.shaft, 0.0])
    return ToolOutline(read_only(at), read_only(radius))


@dataclass(frozen=True, slots=True, eq=False)
class ToolScene:
    """Tools at one moment.

    Attributes:
        p_tip: tip [m], shape (3,).
        axis_world: unit vector from the handle to the tip, shape (3,).
        hidden: length at the tip that nobody sees, inside the body [m].
        others: further tools in view.
        visible: whether there is a tool.
    """

    p_tip: FloatArray
    axis_world: FloatArray
    hidden: float = 0.0
    others: tuple[ToolScene, ...] = ()
    visible: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_tip", frozen(self.p_tip, (3,), "tip"))
        object.__setattr__(self, "axis_world", frozen(unit(self.axis_world), (3,), "tool's axis"))

    @classmethod
    def through(cls, fulcrum: ArrayLike, axis: ArrayLike, depth: float) -> ToolScene:
        """Scene of a tool whose tip is `depth` [m] beyond the fulcrum, hidden from there on."""
        direction = unit(axis)
        return cls(frozen(fulcrum, (3,), "fulcrum") + depth * direction, direction, depth)


class ToolRenderer:
    """Draws tools and trocar as one camera sees them; no noise, no time.

    Args:
        model: the camera.
        tool: measures of every tool.
        trocar: None where there is none.
        blur_px: standard deviation of the picture of a point.
        seed: of the background's unevenness.
        table: what tool and trocar lie on.
    """

    def __init__(
        self,
        model: CameraModel,
        tool: ToolBody,
        trocar: TrocarRing | None = None,
        blur_px: float = _BLUR_PX,
        seed: int = 0,
        table: tuple[HousingBox, ...] = TABLE,
    ) -> None:
        self.model = model
        self._needle = NeedleRenderer(model, needle_profile(tool), blur_px, seed, table)
        self._shape = needle_profile(tool).shape
        self._colours = np.array([TOOL_GREEN, TOOL_GREEN])
        self._behind = self._needle.background
        if trocar is not None:
            self._draw_trocar(trocar, blur_px)

    def render(self, scene: ToolScene) -> Image:
        """Picture of a scene without noise, uint8 (height, width, 3), writable."""
        image = self._behind.copy()
        for one in (scene, *scene.others):
            if one.visible:
                self._needle.draw(image, self._placed(one), self._colours, self._seen(one))
        return image

    def _placed(self, scene: ToolScene) -> MarkerScene:
        return MarkerScene.from_tip(scene.p_tip, scene.axis_world, self._shape.tip)

    def _seen(self, scene: ToolScene) -> NeedleShape:
        """Shape that ends at the trocar."""
        if scene.hidden <= self._shape.point:
            return self._shape
        return self._shape._replace(tip=self._shape.tip - scene.hidden, point=1e-5)

    def _draw_trocar(self, trocar: TrocarRing, blur_px: float) -> None:
        normal = self.model.T_camera_world.rotate(trocar.normal_world)
        if float((self.model.centre - trocar.p_world) @ trocar.normal_world) <= 0.0:
            return  # the body hides it
        facing = float(trocar.normal_world @ LIGHT_WORLD[:3])
        draw_ring(
            self._behind,
            pixel_rays(self.model),
            sample_pattern(blur_px, FINE),
            self.model.T_camera_world @ trocar.p_world,
            normal,
            trocar.inner,
            trocar.outer,
            np.array([_HOLE, TROCAR_BLUE]) * (LIGHT_WORLD[3] + LIGHT_WORLD[4] * max(0.0, facing)),
        )


@njit
def draw_ring(
    image: Any, rays: Any, pattern: Any, c: Any, n: Any, inner: float, outer: float, colours: Any
) -> None:
    """Draw a flat ring and the hole in it over the picture, in place.

    Args:
        image: uint8 (H, W, 3).
        rays: normalised coordinates of the pixels, (H + 2, W + 2, 2), as for `draw_needle`.
        pattern: offsets of the rays of a pixel [px], (n, 2).
        c: centre in the camera's frame [m].
        n: unit normal there.
        inner: radius of the hole [m].
        outer: of the ring [m].
        colours: of hole and ring, (2, 3).
    """
    height = c[0] * n[0] + c[1] * n[1] + c[2] * n[2]
    count = pattern.shape[0]
    for v in range(image.shape[0]):
        for u in range(image.shape[1]):
            x, y = rays[v + 1, u + 1, 0], rays[v + 1, u + 1, 1]
            slope = x * n[0] + y * n[1] + n[2]
            if abs(slope) < 1e-6:
                continue
            t = height / slope
            reach = outer + 20.0 * t * abs(rays[v + 1, u + 2, 0] - x) / max(abs(slope), 0.05)
            if t <= 0.0 or np.hypot(np.hypot(t * x - c[0], t * y - c[1]), t - c[2]) > reach:
                continue
            xu = 0.5 * (rays[v + 1, u + 2, 0] - rays[v + 1, u, 0])
            yv = 0.5 * (rays[v + 2, u + 1, 1] - rays[v, u + 1, 1])
            hole, ring = 0, 0
            for i in range(count):
                px, py = x + pattern[i, 0] * xu, y + pattern[i, 1] * yv
                s = height / (px * n[0] + py * n[1] + n[2])
                gap = np.hypot(np.hypot(s * px - c[0], s * py - c[1]), s - c[2])
                hole += gap < inner
                ring += inner <= gap < outer
            rest = count - hole - ring
            for k in range(3):
                mixed = hole * colours[0, k] + ring * colours[1, k] + rest * image[v, u, k]
                image[v, u, k] = np.uint8(mixed / count + 0.5)


_SIDES: Final = ((-0.62, -0.55, 0.56), (0.62, -0.55, 0.56))


def eyes(
    image_size: tuple[int, int] = (640, 480),
    distance: float = 0.8,
    stands: tuple[tuple[float, float, float], tuple[float, float, float]] = _SIDES,
    looks_at: tuple[float, float, float] = (0.020, 0.0, 0.030),
) -> tuple[CameraModel, CameraModel]:
    """Return two cameras on stands that look down at the table, by default from both sides.

    Args:
        image_size: width and height [px]; the field of view stays the same.
        distance: from what they look at [m].
        stands: directions from there to the cameras, of any length.
        looks_at: the place that both look at [m].
    """
    width, height = image_size
    focal = 1.1 * width
    first, second = (
        CameraProfile(
            name=name,
            image_size=image_size,
            focal_px=(focal, focal),
            centre_px=(0.5 * (width - 1), 0.5 * (height - 1)),
            distortion=(-0.11, 0.14, 0.0004, -0.0003, 0.0),
            position_mm=_in_mm(looks_at + distance * unit(towards)),
            looks_at_mm=_in_mm(looks_at),
        ).model()
        for name, towards in zip(("left", "right"), stands, strict=True)
    )
    return first, second


def _in_mm(place: ArrayLike) -> tuple[float, float, float]:
    x, y, z = (np.asarray(place) / MILLIMETRE).tolist()
    return x, y, z
