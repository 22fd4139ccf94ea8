"""What stands in for pictures in a trial: noise and misses of the marker in delivered pictures.

Run as `python -m tests.bench.bench_sampled_cameras [pairs] [--seed N] [--rig wide]`: the tables of
`app/tracking/simulated/sampled.py`, measured in pictures as the rig's simulated cameras deliver
them (light, photons, tone curve, JPEG), each band followed from where it was known before. 165
pairs a row by default, twelve rows: about ten minutes of one core.
"""

import argparse

import cv2
import numpy as np

from app.simulation.consumers import DevicePort
from app.simulation.effects import declaration
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Scene
from app.tracking.markers.choice import extractors
from app.tracking.markers.extractor import Hint, MarkerFix
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.picture_effects import draws_light, picture_effects, with_noise
from app.tracking.simulated.sampled import (
    ACROSS_PX,
    ALONG_PX,
    DIMMER,
    MISSED,
    WIDER,
)
from app.tracking.simulated.scene import MarkerScene
from tests.bench.marker_trials import FULCRUM

_HINT_PX, _HINT_M = 1.0, 0.3e-3


class Followed:
    """Bands of a rig in pictures as its simulated cameras deliver them."""

    def __init__(self, rig: RigProfile, seed: int) -> None:
        self.rig, self.rng = rig, np.random.default_rng(seed)
        self.finders = extractors(rig)
        light = draws_light(picture_effects(asked(rig)))
        self.renderers = [
            NeedleRenderer(model, rig.needle, rig.blur_px, i, light=light)
            for i, model in enumerate(rig.models)
        ]

    def scene(self) -> MarkerScene:
        """A needle at a depth and tilt of the trials that both cameras see."""
        rng, limits = self.rng, self.rig.range
        while True:
            depth = 1e-3 * rng.uniform(max(-15.0, limits.depth_min_mm), limits.depth_max_mm)
            tilt, turn = np.deg2rad(rng.uniform(0.0, limits.tilt_max_deg)), rng.uniform(0.0, 6.2832)
            across = np.sin(tilt)
            axis = np.array([across * np.cos(turn), across * np.sin(turn), -np.cos(tilt)])
            scene = MarkerScene.from_tip(
                FULCRUM + depth * axis, axis, self.rig.needle.marker_offset
            )
            if all(model.sees(scene.p_world, 25.0)[0] for model in self.rig.models):
                return scene

    def errors(self, pairs: int, **more: dict[str, float]) -> tuple[np.ndarray, float]:
        """Errors along and across the needle [px], (n, 2), and the share of pictures found."""
        effects, seen, count = asked(self.rig, more), [], 0
        for _ in range(pairs):
            scene = self.scene()
            for finder, renderer in zip(self.finders, self.renderers, strict=True):
                found = finder.find(
                    self._picture(renderer, scene, effects), self._hint(renderer, scene)
                )
                count += 1
                if isinstance(found, MarkerFix):
                    ends = scene.p_world + np.outer([0.0, 1e-3], scene.axis_world)
                    at, on = (renderer.model.pixel(p) for p in ends)
                    along = (on - at) / np.linalg.norm(on - at)
                    off = found.uv - at
                    seen.append([off @ along, off @ [-along[1], along[0]]])
        return np.array(seen).reshape(-1, 2), len(seen) / count

    def _picture(self, renderer: NeedleRenderer, scene: MarkerScene, effects: dict) -> np.ndarray:
        chain = with_noise(
            picture_effects(effects),
            renderer.model.image_size,
            self.rig.noise_grey,
            int(self.rng.integers(1 << 30)),
        )
        image = renderer.render(scene)
        for effect, memory in chain:
            image = effect(image, memory, self.rng)
        return image

    def _hint(self, renderer: NeedleRenderer, scene: MarkerScene) -> Hint:
        about = scene.p_world + self.rng.normal(0.0, _HINT_M, 3)
        at = renderer.model.pixel(scene.p_world) + self.rng.normal(0.0, _HINT_PX, 2)
        return Hint(at, about, scene.axis_world)


def asked(rig: RigProfile, more: dict[str, dict[str, float]] | None = None) -> dict:
    """Effects on the pictures of a rig, and more of them, as a trainer hands them over."""
    wanted = [EffectRequest(n, part.parameters, part.model) for n, part in rig.pictures.items()]
    for name, values in (more or {}).items():
        model = "gradient" if "gradient" in declaration(name).models else ""
        wanted.append(EffectRequest(name, values, model))
    return compile(Scene(effects=tuple(wanted)), DevicePort("icube", pictures=True)).pictures()


def robust(errors: np.ndarray) -> np.ndarray:
    """1.48 times the median of the absolute error, per column."""
    return 1.4826 * np.median(np.abs(errors), axis=0) if len(errors) else np.full(2, np.nan)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pairs", nargs="?", type=int, default=165)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rig", default="wide")
    chosen = parser.parse_args()
    cv2.setNumThreads(1)
    rig = load_rig(chosen.rig)
    bench = Followed(rig, chosen.seed)
    delivered = sorted(rig.pictures) or "as drawn"
    print(f"rig {rig.name}, delivered {delivered}, {chosen.pairs} pairs a row")
    usual, share = bench.errors(chosen.pairs)
    if not len(usual):
        raise SystemExit("  the marker is found in none of them")
    base, whole = robust(usual), np.sqrt(np.mean(usual**2, axis=0))
    for way, sd, rms, used in zip(
        ("along", "across"), base, whole, (ALONG_PX, ACROSS_PX), strict=True
    ):
        print(f"  {way} the needle {sd:.4f} px (in use {used}), RMS {rms:.4f} px")
    print(f"  missed {1.0 - share:.4f} (in use {MISSED})")
    for name, table in (("WIDER", WIDER), ("DIMMER", DIMMER)):
        print(f"  {name}: value, found (in use), noise (in use)")
        for value, found, noise in zip(*table, strict=True):
            if value == 1.0:
                continue
            if name == "WIDER":
                defocus = rig.blur_px * np.sqrt(value**2 - 1.0)
                more = {"camera_blur": {"defocus": defocus, "motion": 0.0}}
            else:
                more = {"camera_light": {"level": value, "gradient": 0.0, "flicker": 0.0}}
            errors, seen = bench.errors(chosen.pairs, **more)
            factor = float(np.sqrt(np.mean((robust(errors) / base) ** 2)))
            print(f"    {value:5.2f}  {seen:6.3f} ({found:.2f})  {factor:6.2f} ({noise:.2f})")


if __name__ == "__main__":
    main()
