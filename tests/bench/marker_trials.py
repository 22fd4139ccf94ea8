"""Rendered pairs of the band with known truth: clean, partly hidden, under a highlight.

Only what an extractor looks at round the band is drawn, spoiled and made noisy, in one buffer per
camera, so that ten thousand pairs take minutes.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.choice import extractors
from app.tracking.markers.extractor import Hint, MarkerFix, Miss
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.obstacles import Finger, Highlight, finger, highlight
from app.tracking.simulated.scene import MarkerScene
from app.tracking.solver import FixSolver, SeenMarker

FULCRUM = np.array([0.0, 0.16056, 0.090])
KINDS = ("clean", "finger", "highlight")
Image = np.ndarray

_HALF = 72
"""Half the width of the part that is drawn [px]: the extractor's region and some room."""

_HINT_PX, _HINT_M = 1.0, 0.3e-3
"""Standard deviations of what is known of the band from the pictures before."""


class WindowRenderer(NeedleRenderer):
    """Draws the needle only near the band, into a buffer that it keeps."""

    _rows = slice(0, 0)

    def window(self, scene: MarkerScene) -> tuple[Image, tuple[slice, slice]]:
        """The whole picture (to be changed in the part only) and the part with the band."""
        height, width = self._background.shape[:2]
        u, v = np.rint(self.model.pixel(scene.p_world)).astype(int)
        part = (
            slice(max(0, v - _HALF), min(height, v + _HALF)),
            slice(max(0, u - _HALF), min(width, u + _HALF)),
        )
        if not hasattr(self, "_buffer"):
            self._buffer, self._changed = self._background.copy(), part
        self._buffer[self._changed] = self._background[self._changed]
        self._changed, self._rows = part, part[0]
        if scene.visible:
            self.draw(self._buffer, scene)
        return self._buffer, part

    def _spans(self, centre, axis, along):
        spans = super()._spans(centre, axis, along)
        if self._rows.stop:
            left, right = self._changed[1].start, self._changed[1].stop
            spans[: self._rows.start] = spans[self._rows.stop :] = 0
            spans[self._rows] = np.clip(spans[self._rows], left, right)
        return spans


@dataclass(frozen=True)
class Trial:
    """A pair: what was found in either picture, the fix if both gave one, its error [m]."""

    found: tuple[MarkerFix | Miss, MarkerFix | Miss]
    fix: NeedleFix | None
    error: np.ndarray

    @property
    def accepted(self) -> bool:
        """Whether the fix counts."""
        return self.fix is not None and self.fix.status is FixStatus.VALID

    @property
    def square(self) -> float:
        """Squared normalised error; chi-square with three degrees of freedom if honest."""
        return float(self.error @ np.linalg.solve(self.fix.covariance, self.error))


class Trials:
    """A rig with its renderers, extractors, solver and noise."""

    def __init__(self, seed: int = 1, rig: RigProfile | None = None) -> None:
        self.rig = rig if rig is not None else load_rig("wide")
        self.rng = np.random.default_rng(seed)
        self.renderers = [
            WindowRenderer(model, self.rig.needle, self.rig.blur_px, i)
            for i, model in enumerate(self.rig.models)
        ]
        self.fits = extractors(self.rig)
        self.solver = FixSolver(self.rig, FULCRUM)
        shape = (640, 800, 3)
        self._noise = self.rng.normal(0.0, self.rig.noise_grey, shape).astype(np.float32)
        cv2.setNumThreads(1)

    def scene(self) -> MarkerScene:
        """A needle anywhere in the rig's range that both cameras see."""
        limits, rng = self.rig.range, self.rng
        while True:
            depth = rng.uniform(limits.depth_min_mm, limits.depth_max_mm) * 1e-3
            tilt, azimuth = np.deg2rad(rng.uniform(0, limits.tilt_max_deg)), rng.uniform(0, 6.2832)
            across = np.sin(tilt)
            axis = np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])
            tip = FULCRUM + depth * axis
            scene = MarkerScene.from_tip(tip, axis, self.rig.needle.marker_offset)
            if all(model.sees(scene.p_world, 25.0)[0] for model in self.rig.models):
                return scene

    def noisy(self, image: Image) -> Image:
        """Add noise of the rig."""
        height, width = image.shape[:2]
        row = self.rng.integers(0, 641 - height)
        column = self.rng.integers(0, 801 - width)
        tile = self._noise[row : row + height, column : column + width]
        return np.clip(np.rint(image + tile), 0, 255).astype(np.uint8)

    def picture(self, camera: int, scene: MarkerScene, kind: str) -> Image:
        """Picture of a camera with the band clean or spoiled; valid until the next one."""
        renderer = self.renderers[camera]
        image, part = renderer.window(scene)
        origin = np.array([part[1].start, part[0].start])
        piece = image[part]
        if kind != "clean":
            piece = spoiled(piece, renderer.model.pixel(scene.p_world) - origin, kind, self.rng)
        image[part] = self.noisy(piece)
        return image

    def hint(self, camera: int, scene: MarkerScene) -> Hint:
        """What the pictures before say of the band."""
        about = scene.p_world + self.rng.normal(0.0, _HINT_M, 3)
        true = self.renderers[camera].model.pixel(scene.p_world)
        return Hint(true + self.rng.normal(0.0, _HINT_PX, 2), about, scene.axis_world)

    def run(self, kind: str) -> Trial:
        """One pair from scene to fix."""
        scene = self.scene()
        first, second = (
            fit.find(self.picture(i, scene, kind), self.hint(i, scene))
            for i, fit in enumerate(self.fits)
        )
        return self.judged(scene, first, second)

    def judged(self, scene: MarkerScene, first, second) -> Trial:
        """The fix of two finds, and its error."""
        if isinstance(first, Miss) or isinstance(second, Miss):
            return Trial((first, second), None, np.zeros(3))
        pair = (SeenMarker.of(first), SeenMarker.of(second))
        fix = self.solver.solve(pair, scene.axis_world, 0.0)
        true = scene.p_world + self.rig.needle.marker_offset * scene.axis_world
        return Trial((first, second), fix, fix.p_tip_world - true)


def spoiled(image: Image, true: np.ndarray, kind: str, rng: np.random.Generator) -> Image:
    """Cover the band from a side by a random share, or put a highlight near it."""
    if kind == "finger":
        angle = rng.uniform(0, 2 * np.pi)
        direction = np.array([np.cos(angle), np.sin(angle)])
        tip = true - rng.uniform(-6.0, 16.0) * direction
        return finger(image, Finger(tip, direction, rng.uniform(8.0, 30.0)), rng)
    place = true + rng.normal(0.0, 5.0, 2)
    spot = Highlight(place, rng.uniform(0.8, 3.0), rng.uniform(20.0, 250.0))
    return highlight(image, spot, rng)
