"""Pairs without the marker: the housing, red cloth and an orange thing; whatever fix is false.

Half of the things lie anywhere in either picture; half are one thing in both pictures, near the
needle's line, where neither epipolar line nor robot contradict. Half of the arrangements begin
with a picture of the marker, so that one camera alone may be believed after it.
"""

from collections import Counter

import cv2
import numpy as np

from app.core.clock import VirtualClock
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import NeedleFix
from app.tracking.simulated.obstacles import ORANGE, RED_CLOTH, Patch, patch
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.simulated.scene import MarkerScene
from app.tracking.tracker import Tracker
from tests.bench.marker_trials import FULCRUM, Trials
from tests.tracking.camera_fakes import NoCamera

FRAMES = 5
"""Pictures of one arrangement, so that the tracker may follow what it took for the marker."""


class Hidden:
    """Arrangements of things and what the tracker says of them."""

    def __init__(self, seed: int = 1) -> None:
        self._trials = Trials(seed)
        self._rng, self._rig = self._trials.rng, self._trials.rig
        nothing = MarkerScene(FULCRUM, np.array([0.0, 0.0, -1.0]), visible=False)
        self._empty = [renderer.render(nothing) for renderer in self._trials.renderers]
        self._tiles = [
            NoiseTile.make(model.image_size, self._rig.noise_grey, seed + i)
            for i, model in enumerate(self._rig.models)
        ]

    def fixes(self, count: int) -> tuple[Counter, list[NeedleFix]]:
        """Look at `count` pairs; statuses, and the fixes that count."""
        said: Counter = Counter()
        false = []
        for start in range(0, count, FRAMES):
            scene = self._trials.scene()
            tracker = self._tracker(scene.axis_world)
            if self._rng.random() < 0.5:
                shown = [renderer.render(scene) for renderer in self._trials.renderers]
                tracker.process(*self._frames(shown, 0.0))
            pictures = self._arranged(scene)
            for k in range(1, 1 + min(FRAMES, count - start)):
                fix = tracker.process(*self._frames(pictures, k / self._rig.rate_hz))
                said[fix.status.value] += 1
                if fix.usable:
                    false.append(fix)
        return said, false

    def _tracker(self, axis: np.ndarray) -> Tracker:
        cameras = (NoCamera(), NoCamera())
        return Tracker(cameras, self._rig, VirtualClock(), lambda _: axis, FULCRUM)

    def _frames(self, pictures: list[np.ndarray], time: float) -> list[CameraFrame]:
        return [
            CameraFrame(noise(picture.copy(), tile, self._rng), time)
            for picture, tile in zip(pictures, self._tiles, strict=True)
        ]

    def _arranged(self, scene: MarkerScene) -> list[np.ndarray]:
        pictures, rng = [empty.copy() for empty in self._empty], self._rng
        for colour in (RED_CLOTH, RED_CLOTH, ORANGE):
            half, angle = np.exp(rng.uniform(np.log(4.0), np.log(80.0), 2)), rng.uniform(0, 180)
            near = rng.random() < 0.5
            about = scene.p_world + rng.normal(0.0, 3e-3, 3)
            for picture, model in zip(pictures, self._rig.models, strict=True):
                place = model.pixel(about) if near else rng.uniform([20, 20], [620, 460])
                put(picture, Patch(place, half, angle, colour), rng)
        return pictures


def put(picture: np.ndarray, thing: Patch, rng: np.random.Generator) -> None:
    """Put a thing into the picture, in place and only where it is."""
    reach = int(np.max(thing.half)) + 6
    u, v = np.rint(thing.uv).astype(int)
    rows = slice(max(0, v - reach), max(0, v + reach))
    columns = slice(max(0, u - reach), max(0, u + reach))
    piece = picture[rows, columns]
    if piece.size:
        at = thing.uv - [columns.start, rows.start]
        picture[rows, columns] = patch(
            piece, Patch(at, thing.half, thing.angle_deg, thing.colour), rng
        )


def main(count: int = 10_000) -> None:
    """Print what was said of `count` pairs."""
    cv2.setNumThreads(1)
    said, false = Hidden().fixes(count)
    print(f"  marker hidden, red cloth and orange in view: {count} pairs, {len(false)} fixes")
    print(f"    said: {dict(said)}")
    for fix in false[:10]:
        print(f"    {fix.status.value} {np.round(fix.p_tip_world * 1e3, 1)} mm {fix.pixels}")


if __name__ == "__main__":
    main()
