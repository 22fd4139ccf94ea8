"""Simulated cameras that deliver pictures of the needle, as a real camera would."""

from collections.abc import Callable, Sequence
from copy import copy
from typing import Any, Protocol

import numpy as np

from app.core.arrays import FloatArray
from app.core.clock import Clock
from app.core.units import MILLISECOND
from app.tracking.cameras.camera import Camera, CameraFrame, Image
from app.tracking.errors import CameraError
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleProfile, RigProfile
from app.tracking.simulated.background import COARSE, LIGHT_WORLD, paint_background, sample_pattern
from app.tracking.simulated.needle_kernels import draw_needle, row_spans
from app.tracking.simulated.picture_effects import NoiseTile, PictureEffect, noise
from app.tracking.simulated.scene import MarkerScene, Scene

_COLOURS = np.array([[172.0, 170.0, 168.0], [44.0, 26.0, 205.0]])
"""Shaft and band: blue, green, red."""


class NeedleRenderer:
    """Draws the needle before the cached background of one camera; no noise, no time."""

    def __init__(
        self, model: CameraModel, needle: NeedleProfile, blur_px: float, seed: int = 0
    ) -> None:
        self.model = model
        self._shape = needle.shape
        self._behind = needle.band_distance
        self._fine = sample_pattern(blur_px)
        self._coarse = sample_pattern(blur_px, COARSE)
        self._rays = _pixel_rays(model)
        farthest = float(np.hypot(*self._fine.T).max())
        self._margin = float(1.2 * farthest / model.intrinsics[:2].min())
        self._background = paint_background(model, self._rays, blur_px, seed)
        light = model.T_world_camera.rotation.T @ LIGHT_WORLD[:3]
        self._light = np.concatenate([light, LIGHT_WORLD[3:]])
        self._compile()

    def even(self, grey: float) -> "NeedleRenderer":
        """Return the same camera before a background of one grey."""
        other = copy(self)
        other._background = np.full_like(self._background, round(grey))  # noqa: SLF001
        return other

    def band(self, scene: MarkerScene) -> Image:
        """Where the band has a share of the pixel, uint8 (height, width): one there, else zero."""
        pictures = []
        for green in (0.0, 255.0):
            image = np.zeros_like(self._background)
            self._draw(image, scene, np.array([_COLOURS[0], [0.0, green, 0.0]]))
            pictures.append(image[..., 1])
        return np.asarray(pictures[0] != pictures[1], dtype=np.uint8)

    def render(self, scene: MarkerScene) -> Image:
        """Picture of a scene without noise, uint8 (height, width, 3), writable."""
        image = self._background.copy()
        if scene.visible:
            self._draw(image, scene)
            if self._behind is not None:
                self._draw_second(image, scene, self._behind)
        return image

    def _draw_second(self, image: Image, scene: MarkerScene, behind: float) -> None:
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
            image, self._rays, spans, self._fine, self._coarse, axis, centre,
            moved, _COLOURS, self._light, self._margin,
        )  # fmt: skip

    def _compile(self) -> None:
        """Draw once, so that the kernels are ready before the first picture is due."""
        pose = self.model.T_world_camera
        self.render(MarkerScene(pose @ np.array([0.0, 0.0, 0.3]), pose.rotation[:, 1]))

    def _draw(self, image: Image, scene: MarkerScene, colours: FloatArray = _COLOURS) -> None:
        axis = self.model.T_camera_world.rotate(scene.axis_world)
        centre = self.model.T_camera_world @ scene.p_world
        along = np.linspace(self._shape.hub - 1e-3, self._shape.tip + 1e-3, 42)
        spans = self._spans(centre, axis, along)
        draw_needle(
            image, self._rays, spans, self._fine, self._coarse, axis, centre,
            self._shape, colours, self._light, self._margin,
        )  # fmt: skip

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

    def render(self, scene: Any) -> Image:
        """Picture without noise, uint8 (height, width, 3), writable."""
        ...


class SimulatedCamera(Camera):
    """A camera whose pictures are rendered at the moment they are asked for.

    Picture k is captured at `skew + k / rate_hz` on the clock and delivered `latency` later. Who
    reads too slowly misses pictures, as with a real camera.
    """

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
        self._last = -1

    def open(self) -> None:
        """Start with the next picture due; the noise starts afresh."""
        self._rng = np.random.default_rng(self._seed)
        self._last = self._due() - 1

    def read(self) -> CameraFrame:
        """Wait for the next picture on the clock."""
        if self._rng is None:
            raise CameraError(f"camera {self._renderer.model.name} is not open; call open() first")
        number = max(self._last + 1, self._due())
        time = self.skew + number / self._rate
        self._clock.sleep(time + self.latency - self._clock.now())
        self._last = number
        image = self._renderer.render(self.scene(time))
        for effect, parameters in self._effects:
            image = effect(image, parameters, self._rng)
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
    """Both cameras of a rig, with its noise, latency and skew; `effects` come before the noise.

    Tracing the backgrounds takes a moment: build them off the window's thread.
    """
    cameras = []
    for index, model in enumerate(rig.models):
        renderer = NeedleRenderer(model, rig.needle, rig.blur_px, seed + index)
        chain = list(effects)
        if rig.noise_grey > 0.0:
            tile = NoiseTile.make(model.image_size, rig.noise_grey, seed + 100 + index)
            chain.append((noise, tile))
        latency, skew = rig.latency_ms * MILLISECOND, index * rig.skew_ms * MILLISECOND
        cameras.append(
            SimulatedCamera(
                renderer, scene, clock, rig.rate_hz, latency, skew, chain, seed + 200 + index
            )
        )
    return cameras[0], cameras[1]


def _pixel_rays(model: CameraModel) -> FloatArray:
    """Normalised coordinates of all pixels and one more on each side, (H + 2, W + 2, 2)."""
    width, height = model.image_size
    v, u = np.mgrid[-1 : height + 1, -1 : width + 1]
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)
    rays, found = model.undistort(pixels)
    rays[~found] = 1e3  # beyond the fold: nothing of the needle lies there
    return rays.reshape(height + 2, width + 2, 2)
