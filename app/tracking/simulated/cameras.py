"""Simulated cameras that deliver pictures of the needle, as a real camera would.

The needle is ray traced (compiled). Every pixel is the mean over rays spread as the lens spreads a
point (see `sampling`), so edges are sub-pixel exact, and the distortion is that of the camera,
since the rays come from its inverse.

Conventions: camera frame; colours blue, green, red, white 255, or 65535 where what is drawn is
linear light; `light` holds the unit vector towards the light (3), the ambient and the diffuse
share, and white.
"""

from collections.abc import Callable, Sequence
from copy import copy
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.clock import Clock
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.paced_clock import PacedClock
from app.core.units import MILLISECOND
from app.tracking.cameras.camera import Camera, CameraFrame, Image
from app.tracking.errors import CameraError
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleProfile, NeedleShape, RigProfile
from app.tracking.simulated.background import (
    COARSE,
    HOUSING,
    LIGHT_WORLD,
    HousingBox,
    paint_background,
    sample_pattern,
)
from app.tracking.simulated.delivery import WHITE, light_of
from app.tracking.simulated.picture_effects import PictureEffect, draws_light, with_noise
from app.tracking.simulated.scene import MarkerScene, Scene

_HIGHLIGHT = 0.35


@njit
def _shaft_hit(dx: float, dy: float, a: Any, c: Any, shape: Any) -> Any:
    """Ray (dx, dy, 1) against shaft and point: (distance, position on the axis, hit)."""
    da = dx * a[0] + dy * a[1] + a[2]
    ac = a[0] * c[0] + a[1] * c[1] + a[2] * c[2]
    mx, my, mz = dx - da * a[0], dy - da * a[1], 1.0 - da * a[2]
    cx, cy, cz = c[0] - ac * a[0], c[1] - ac * a[1], c[2] - ac * a[2]
    mm = mx * mx + my * my + mz * mz
    mc = mx * cx + my * cy + mz * cz
    cc = cx * cx + cy * cy + cz * cz
    cone = shape[3] - shape[5]  # where the taper begins
    discriminant = mc * mc - mm * (cc - shape[0] * shape[0])
    if discriminant <= 0.0 or mm < 1e-12:
        return 0.0, 0.0, False  # the cone is thinner than the cylinder
    t = (mc - np.sqrt(discriminant)) / mm
    s = t * da - ac
    if shape[4] < s <= cone:
        return t, s, t > 0.0
    slope2 = (shape[0] / shape[5]) ** 2
    reach = shape[3] + ac
    qa = mm - slope2 * da * da
    qb = mc - slope2 * reach * da
    discriminant = qb * qb - qa * (cc - slope2 * reach * reach)
    if discriminant <= 0.0 or qa < 1e-12:
        return 0.0, 0.0, False
    t = (qb - np.sqrt(discriminant)) / qa
    s = t * da - ac
    return t, s, t > 0.0 and cone < s < shape[3]


@njit
def _band_hit(dx: float, dy: float, a: Any, c: Any, shape: Any) -> Any:
    """Ray against the band, a finite cylinder with end faces: (distance, face, hit).

    `face` is 0 for the side, +1 for the end towards the tip, -1 for the other end.
    """
    radius, half = shape[1], shape[2]
    da = dx * a[0] + dy * a[1] + a[2]
    ac = a[0] * c[0] + a[1] * c[1] + a[2] * c[2]
    mx, my, mz = dx - da * a[0], dy - da * a[1], 1.0 - da * a[2]
    cx, cy, cz = c[0] - ac * a[0], c[1] - ac * a[1], c[2] - ac * a[2]
    mm = mx * mx + my * my + mz * mz
    mc = mx * cx + my * cy + mz * cz
    discriminant = mc * mc - mm * (cx * cx + cy * cy + cz * cz - radius * radius)
    if discriminant < 0.0:
        return 0.0, 0, False
    if mm > 1e-12:
        t = (mc - np.sqrt(discriminant)) / mm
        if t > 0.0 and abs(t * da - ac) <= half:
            return t, 0, True
    if abs(da) < 1e-12:
        return 0.0, 0, False
    face = -1 if da > 0.0 else 1
    t = (ac + face * half) / da
    gap = (t * mx - cx) ** 2 + (t * my - cy) ** 2 + (t * mz - cz) ** 2
    return t, face, t > 0.0 and gap <= radius * radius


@njit
def _side_normal(t: float, dx: float, dy: float, a: Any, c: Any) -> Any:
    x, y, z = t * dx - c[0], t * dy - c[1], t - c[2]
    s = x * a[0] + y * a[1] + z * a[2]
    x, y, z = x - s * a[0], y - s * a[1], z - s * a[2]
    n = 1.0 / np.sqrt(x * x + y * y + z * z + 1e-30)
    return x * n, y * n, z * n


@njit
def _needle_colour(
    dx: float, dy: float, near_band: bool, a: Any, c: Any, shape: Any, colours: Any, light: Any
) -> Any:
    """Colour of the needle where the ray meets it: (blue, green, red, hit)."""
    t_shaft, s, shaft = _shaft_hit(dx, dy, a, c, shape)
    t_band, face, band = 0.0, 0, False
    if near_band:
        t_band, face, band = _band_hit(dx, dy, a, c, shape)
    if shaft and abs(s) < shape[2]:
        shaft = False  # inside the band
    if not shaft and not band:
        return 0.0, 0.0, 0.0, False
    if band and (not shaft or t_band < t_shaft):
        if face == 0:
            nx, ny, nz = _side_normal(t_band, dx, dy, a, c)
        else:
            nx, ny, nz = face * a[0], face * a[1], face * a[2]
        glow = light[3] + light[4] * max(0.0, nx * light[0] + ny * light[1] + nz * light[2])
        return colours[1, 0] * glow, colours[1, 1] * glow, colours[1, 2] * glow, True  # matte
    nx, ny, nz = _side_normal(t_shaft, dx, dy, a, c)
    facing = nx * light[0] + ny * light[1] + nz * light[2]
    glow = light[3] + light[4] * max(0.0, facing)
    mirror = -(
        (2.0 * facing * nx - light[0]) * dx
        + (2.0 * facing * ny - light[1]) * dy
        + (2.0 * facing * nz - light[2])
    )
    shine = max(0.0, mirror) if facing > 0.0 else 0.0
    shine = shine * shine / (dx * dx + dy * dy + 1.0)
    shine = shine * shine
    shine = shine * shine
    shine = shine * shine
    shine = light[5] * _HIGHLIGHT * shine * shine  # cosine to the power of 32: polished steel
    return (
        min(light[5], colours[0, 0] * glow + shine),
        min(light[5], colours[0, 1] * glow + shine),
        min(light[5], colours[0, 2] * glow + shine),
        True,
    )


@njit
def _nearness(dx: float, dy: float, a: Any, c: Any, shape: Any, margin: float) -> int:
    """0: the pixel sees nothing of the needle; 1: perhaps the shaft; 2: perhaps the band;
    3: nothing but one smooth part of either, so that one ray will do.
    """
    dd = dx * dx + dy * dy + 1.0
    da = dx * a[0] + dy * a[1] + a[2]
    dc = dx * c[0] + dy * c[1] + c[2]
    ac = a[0] * c[0] + a[1] * c[1] + a[2] * c[2]
    square = dd - da * da
    if square < 1e-3 * dd:  # along the axis: where both are nearest says nothing
        return 2
    t = (dc - da * ac) / square
    s = t * da - ac
    x, y, z = t * dx - c[0] - s * a[0], t * dy - c[1] - s * a[1], t - c[2] - s * a[2]
    blurred = margin * max(t, 1e-3)
    gap = np.sqrt(x * x + y * y + z * z)
    slack = (shape[1] + 2.0 * blurred) / np.sqrt(square)  # an oblique ray: s changes faster
    if t <= 0.0 or not shape[4] - slack < s < shape[3] + slack:
        return 0
    if abs(s) < shape[2] + slack and gap < shape[1] + blurred:
        inside = gap < shape[1] - blurred and abs(s) < shape[2] - slack
        return 3 if inside else 2
    if gap < shape[0] - blurred and s < shape[3] - shape[5] - slack:
        return 3
    return 1 if gap < shape[0] + blurred else 0


@njit
def row_spans(uv: Any, ok: Any, reach: float, width: int, height: int) -> Any:
    """Columns that a line through the pixels `uv`, (n, 2), widened by `reach`, touches per row.

    Pieces with an end that is not `ok`, (n,), are left out. Returns the
    first column and last column + 1, shape (height, 2); equal where the row is not touched.
    """
    spans = np.empty((height, 2), dtype=np.int64)
    spans[:, 0], spans[:, 1] = width, 0
    for i in range(uv.shape[0] - 1):
        if not (ok[i] and ok[i + 1]):
            continue
        left, right = min(uv[i, 0], uv[i + 1, 0]) - reach, max(uv[i, 0], uv[i + 1, 0]) + reach
        top, bottom = min(uv[i, 1], uv[i + 1, 1]) - reach, max(uv[i, 1], uv[i + 1, 1]) + reach
        if right < 0.0 or left > width or bottom < 0.0 or top > height:
            continue
        for v in range(int(max(0.0, top)), int(min(height - 1.0, bottom)) + 1):
            spans[v, 0] = min(spans[v, 0], int(max(0.0, left)))
            spans[v, 1] = max(spans[v, 1], int(min(width - 1.0, right)) + 1)
    return spans


@njit
def draw_needle(
    image: Any,
    rays: Any,
    spans: Any,
    fine: Any,
    coarse: Any,
    a: Any,
    c: Any,
    shape: Any,
    colours: Any,
    light: Any,
    margin: float,
) -> None:
    """Draw the needle over the picture, in place.

    Args:
        image: uint8 or uint16 (H, W, 3).
        rays: normalised coordinates of the pixels, (H + 2, W + 2, 2): one pixel more on each side.
        spans: first column and last column + 1 of what may change in each row, (H, 2).
        fine: offsets of the rays of a pixel at the band [px], (n, 2).
        coarse: the same elsewhere on the shaft.
        a: unit vector from hub to tip.
        c: centre of the band [m].
        shape: a `rig.NeedleShape`; as a tuple it stays in registers.
        colours: of shaft and band, (2, 3).
        light: see the module.
        margin: half width of what one pixel sees, in normalised coordinates.
    """
    axis, centre = (a[0], a[1], a[2]), (c[0], c[1], c[2])
    lamp = (light[0], light[1], light[2], light[3], light[4], light[5])
    for v in range(image.shape[0]):
        for u in range(spans[v, 0], spans[v, 1]):
            x, y = rays[v + 1, u + 1, 0], rays[v + 1, u + 1, 1]
            near = _nearness(x, y, axis, centre, shape, margin)
            if near == 0:
                continue
            xu = 0.5 * (rays[v + 1, u + 2, 0] - rays[v + 1, u, 0])
            yu = 0.5 * (rays[v + 1, u + 2, 1] - rays[v + 1, u, 1])
            xv = 0.5 * (rays[v + 2, u + 1, 0] - rays[v, u + 1, 0])
            yv = 0.5 * (rays[v + 2, u + 1, 1] - rays[v, u + 1, 1])
            pattern = fine if near == 2 else coarse
            n = 1 if near == 3 else pattern.shape[0]
            hits, blue, green, red = 0, 0.0, 0.0, 0.0
            for i in range(n):
                p, q = (0.0, 0.0) if near == 3 else (pattern[i, 0], pattern[i, 1])
                b, g, r, hit = _needle_colour(
                    x + p * xu + q * xv,
                    y + p * yu + q * yv,
                    near >= 2,
                    axis,
                    centre,
                    shape,
                    colours,
                    lamp,
                )
                hits += hit
                blue, green, red = blue + b, green + g, red + r
            if hits:
                rest = n - hits
                image[v, u, 0] = (blue + rest * image[v, u, 0]) / n + 0.5
                image[v, u, 1] = (green + rest * image[v, u, 1]) / n + 0.5
                image[v, u, 2] = (red + rest * image[v, u, 2]) / n + 0.5


_COLOURS = np.array([[172.0, 170.0, 168.0], [44.0, 26.0, 205.0]])
"""Shaft and band: blue, green, red."""


class NeedleRenderer:
    """Draws the needle before the cached background of one camera; no noise, no time.

    `boxes` are what stands behind it. With `light` it draws linear light, uint16, of which sRGB
    makes the colours.
    """

    def __init__(
        self,
        model: CameraModel,
        needle: NeedleProfile,
        blur_px: float,
        seed: int = 0,
        boxes: tuple[HousingBox, ...] = HOUSING,
        light: bool = False,
    ) -> None:
        self.model = model
        self._shape = needle.shape
        self._colours = light_of(_COLOURS) * (WHITE / 255.0) if light else _COLOURS
        self._behind = needle.band_distance
        self._fine = sample_pattern(blur_px)
        self._coarse = sample_pattern(blur_px, COARSE)
        self._rays = pixel_rays(model)
        farthest = float(np.hypot(*self._fine.T).max())
        self._margin = float(1.2 * farthest / model.intrinsics[:2].min())
        self._background = paint_background(model, self._rays, blur_px, seed, boxes, light)
        lamp = model.T_world_camera.rotation.T @ LIGHT_WORLD[:3]
        white = float(WHITE) if light else 255.0
        self._light = np.concatenate([lamp, LIGHT_WORLD[3:], [white]])
        self._compile()

    def even(self, grey: float) -> "NeedleRenderer":
        """Return the same camera before a background of one grey (0 to 255)."""
        other = copy(self)
        seen = grey if self._background.dtype == np.uint8 else light_of(grey) * (WHITE / 255.0)
        other._background = np.full_like(self._background, round(float(seen)))  # noqa: SLF001
        return other

    def band(self, scene: MarkerScene) -> Image:
        """Return where the band has a share of the pixel, uint8 (height, width): one there, else
        zero.
        """
        pictures = []
        for green in (0.0, 255.0):
            image = np.zeros_like(self._background)
            self.draw(image, scene, np.array([self._colours[0], [0.0, green, 0.0]]))
            pictures.append(image[..., 1])
        return np.asarray(pictures[0] != pictures[1], dtype=np.uint8)

    def render(self, scene: MarkerScene) -> NDArray[Any]:
        """Picture of a scene without noise, or its light, (height, width, 3), writable."""
        image = self._background.copy()
        if scene.visible:
            self.draw(image, scene)
            if self._behind is not None:
                self._draw_second(image, scene, self._behind)
        return image

    def _draw_second(self, image: NDArray[Any], scene: MarkerScene, behind: float) -> None:
        """Draw the piece of the needle round its second band anew, with the band there.

        Where both bands lie behind each other, seen along the needle, the second is in front.
        """
        shape = self._shape
        axis = self.model.T_camera_world.rotate(scene.axis_world)
        centre = self.model.T_camera_world @ scene.p_world - behind * axis
        moved = shape._replace(tip=shape.tip + behind, hub=shape.hub + behind)
        reach = shape.half + shape.radius
        spans = self._spans(centre, axis, np.linspace(-reach, reach, 9))
        for row in np.flatnonzero(spans[:, 0] < spans[:, 1]):
            columns = slice(*spans[row])
            image[row, columns] = self._background[row, columns]
        draw_needle(
            image,
            self._rays,
            spans,
            self._fine,
            self._coarse,
            axis,
            centre,
            moved,
            self._colours,
            self._light,
            self._margin,
        )

    def _compile(self) -> None:
        """Draw once, so that the kernels are ready before the first picture is due."""
        pose = self.model.T_world_camera
        self.render(MarkerScene(pose @ np.array([0.0, 0.0, 0.3]), pose.rotation[:, 1]))

    @property
    def background(self) -> NDArray[Any]:
        """Return what stands behind, (height, width, 3): a copy."""
        return self._background.copy()

    def draw(
        self,
        image: NDArray[Any],
        scene: MarkerScene,
        colours: FloatArray | None = None,
        shape: NeedleShape | None = None,
    ) -> None:
        """Draw the needle over a picture of this camera, in place.

        Args:
            image: of the type that it renders, (height, width, 3).
            scene: where it is.
            colours: of shaft and band, blue, green, red, (2, 3), if not its own.
            shape: of what is drawn, if not the whole needle.
        """
        shape = shape or self._shape
        axis = self.model.T_camera_world.rotate(scene.axis_world)
        centre = self.model.T_camera_world @ scene.p_world
        pieces = max(42, round((shape.tip - shape.hub) / 5e-3) + 2)
        along = np.linspace(shape.hub - 1e-3, shape.tip + 1e-3, pieces)
        spans = self._spans(centre, axis, along)
        draw_needle(
            image,
            self._rays,
            spans,
            self._fine,
            self._coarse,
            axis,
            centre,
            shape,
            self._colours if colours is None else colours,
            self._light,
            self._margin,
        )

    def _spans(self, centre: FloatArray, axis: FloatArray, along: FloatArray) -> Any:
        """Columns of each row that the needle may touch between positions `along` its axis [m].

        Pieces of 5 mm with an end behind the camera or beyond the fold are left out: the fold lies
        much further outside the image than such a piece is long.
        """
        width, height = self.model.image_size
        points = centre + along[:, None] * axis
        uv, ok = self.model.project_camera(points)
        nearest = points[ok, 2].min(initial=np.inf)
        reach = self._shape.radius * self.model.intrinsics[:2].max() / nearest + 3.0
        return row_spans(uv, ok, float(reach), width, height)


class Renderer(Protocol):
    """Draws scenes of one kind as one camera sees them."""

    model: CameraModel

    def render(self, scene: Any) -> NDArray[Any]:
        """Picture without noise, or its light, (height, width, 3), writable."""
        ...


class SimulatedCamera(Camera):
    """A camera whose pictures are rendered at the moment they are asked for.

    Picture k is captured at `skew + k / rate_hz` on the clock and delivered `latency` later. Who
    reads too slowly misses pictures, as with a real camera. By a `PacedClock` a picture is drawn
    as soon as it is captured, and time waits for whoever is late.
    """

    simulated = True

    def __init__(
        self,
        renderer: Renderer,
        scene: Callable[[float], Any],
        clock: Clock,
        rate_hz: float = 30.0,
        latency: float = 0.0,
        skew: float = 0.0,
        effects: Sequence[tuple[PictureEffect, Any]] = (),
        seed: int = 0,
    ) -> None:
        self.scene = scene
        self.skew = skew
        self.latency = latency
        self._renderer = renderer
        self._clock = clock
        self._rate = rate_hz
        self._effects = tuple(effects)
        self._seed = seed
        self._rng: np.random.Generator | None = None
        self._chain = self._effects
        self._last = -1

    def open(self) -> None:
        """Start with the next picture due; noise and effects start afresh."""
        self._rng = np.random.default_rng(self._seed)
        self._chain = tuple((effect, copy(memory)) for effect, memory in self._effects)
        self._last = self._due() - 1

    def read(self) -> CameraFrame:
        """Wait for the next picture on the clock."""
        if self._rng is None:
            raise CameraError(
                sentence(
                    "camera {renderer_model_name} is not open; call open() first",
                    renderer_model_name=self._renderer.model.name,
                )
            )
        number = max(self._last + 1, self._due())
        time = self.skew + number / self._rate
        ahead = self.latency if isinstance(self._clock, PacedClock) else 0.0
        self._clock.sleep_until(time + self.latency - ahead)
        self._last = number
        image = self._renderer.render(self.scene(time))
        for effect, parameters in self._chain:
            image = effect(image, parameters, self._rng)
        if ahead > 0.0:
            self._clock.sleep_until(time + ahead)
        return CameraFrame(image, time)

    def close(self) -> None:
        """End the stream."""
        self._rng = None

    def _due(self) -> int:
        """Return the number of the newest picture that could have been delivered by now."""
        return int(np.floor((self._clock.now() - self.latency - self.skew) * self._rate + 1e-6))


def simulated_cameras(
    rig: RigProfile,
    scene: Scene,
    clock: Clock,
    seed: int = 0,
    effects: Sequence[tuple[PictureEffect, Any]] = (),
) -> tuple[SimulatedCamera, SimulatedCamera]:
    """Both cameras of a rig, with its noise, latency and skew.

    `effects` on the light come before the noise; a tone curve counts photons in its place, and
    JPEG comes last.

    Tracing the backgrounds takes a moment: build them off the window's thread.
    """
    cameras = []
    for index, model in enumerate(rig.models):
        light = draws_light(effects)
        renderer = NeedleRenderer(model, rig.needle, rig.blur_px, seed + index, light=light)
        chain = with_noise(effects, model.image_size, rig.noise_grey, seed + 100 + index)
        latency, skew = rig.latency_ms * MILLISECOND, index * rig.skew_ms * MILLISECOND
        cameras.append(
            SimulatedCamera(
                renderer, scene, clock, rig.rate_hz, latency, skew, chain, seed + 200 + index
            )
        )
    return cameras[0], cameras[1]


def pixel_rays(model: CameraModel) -> FloatArray:
    """Normalised coordinates of all pixels and one more on each side, (H + 2, W + 2, 2)."""
    width, height = model.image_size
    v, u = np.mgrid[-1 : height + 1, -1 : width + 1]
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)
    rays, found = model.undistort(pixels)
    rays[~found] = 1e3  # beyond the fold: nothing of the needle lies there
    return rays.reshape(height + 2, width + 2, 2)
