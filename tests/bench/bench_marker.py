"""The marker: error against the Cramér-Rao bound, coverage of the ellipsoid, false finds.

Run as `python -m tests.bench.bench_marker [trials]` (10000 by default, a quarter of an hour).
"""

import sys
from collections import Counter

import numpy as np

from app.tracking.confidence import chi_square_quantile
from app.tracking.fix import FixStatus
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.cramer_rao import position_bound
from app.tracking.markers.extractor import Hint, MarkerFix, Miss
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.obstacles import (
    ORANGE,
    RED_CLOTH,
    Finger,
    Highlight,
    Patch,
    finger,
    highlight,
    patch,
)
from app.tracking.simulated.scene import MarkerScene
from app.tracking.solver import FixSolver, Sighting

FULCRUM = np.array([0.0, 0.16056, 0.090])
Image = np.ndarray


class Bench:
    """A rig with its renderers and noise."""

    def __init__(self, seed: int = 1) -> None:
        self.rig: RigProfile = load_rig("wide")
        self.rng = np.random.default_rng(seed)
        self.renderers = [
            NeedleRenderer(m, self.rig.needle, self.rig.blur_px, i)
            for i, m in enumerate(self.rig.models)
        ]
        self.fits = extractors(self.rig, ExtractorName.MODEL_FIT)
        self.solver = FixSolver(self.rig, FULCRUM)
        self._noise = self.rng.normal(0.0, self.rig.noise_grey, (640, 800, 3)).astype(np.float32)

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
        row, column = self.rng.integers(0, 160, 2)
        height, width = image.shape[:2]
        tile = self._noise[row : row + height, column : column + width]
        return np.clip(np.rint(image + tile), 0, 255).astype(np.uint8)


def bound(bench: Bench, count: int) -> None:
    """Root mean square error over the root mean square bound."""
    print("error over the Cramér-Rao bound of the position alone, rig wide, noise 4, blur 0.7 px")
    for background in ("even", "housing"):
        squares: dict[str, list[float]] = {"model_fit": [], "outline_centroid": []}
        bounds = []
        for _ in range(count):
            scene = bench.scene()
            for renderer, fit in zip(bench.renderers, bench.fits, strict=True):
                seen = renderer.even(115) if background == "even" else renderer
                model, true = renderer.model, renderer.model.pixel(scene.p_world)

                def at(p_world, seen=seen, scene=scene):
                    return seen.render(MarkerScene(p_world, scene.axis_world))

                shape = bench.rig.needle.shape
                shift = centroid_shift(model, shape, scene.p_world, scene.axis_world)
                image = bench.noisy(seen.render(scene))
                hint = Hint(true + bench.rng.normal(0, 3, 2), scene.p_world, scene.axis_world)
                found, coarse = fit.find(image, hint), fit.coarse.find(image, hint)
                if isinstance(found, Miss) or isinstance(coarse, Miss):
                    continue
                least = position_bound(at, seen.band(scene), model, scene.p_world, 4.0)
                bounds.append(np.trace(least))
                squares["model_fit"].append(float(np.sum((found.uv - true) ** 2)))
                squares["outline_centroid"].append(float(np.sum((coarse.uv - shift - true) ** 2)))
        for name, values in squares.items():
            ratio = np.sqrt(np.array(values) / np.array(bounds))
            print(
                f"  {background:<8} {name:<17} RMS {np.sqrt(np.mean(values)):.4f} px   "
                f"over the bound {np.sqrt(np.mean(values) / np.mean(bounds)):.2f}   "
                f"median of ratios {np.median(ratio):.2f}   n {len(values)}"
            )


def spoiled(bench: Bench, image: Image, true: np.ndarray, kind: str) -> Image:
    """Cover the band from a side by a random share, or put a highlight near it."""
    rng = bench.rng
    if kind == "finger":
        angle = rng.uniform(0, 2 * np.pi)
        direction = np.array([np.cos(angle), np.sin(angle)])
        tip = true - rng.uniform(-6.0, 16.0) * direction
        return finger(image, Finger(tip, direction, rng.uniform(8.0, 30.0)), rng)
    place = true + rng.normal(0.0, 5.0, 2)
    spot = Highlight(place, rng.uniform(0.8, 3.0), rng.uniform(20.0, 250.0))
    return highlight(image, spot, rng)


def coverage(bench: Bench, kind: str, count: int) -> None:
    """Share of fixes whose 95 % ellipsoid holds the truth."""
    limit = chi_square_quantile(0.95, 3)
    inside, used, misses = 0, 0, Counter()
    for _ in range(count):
        scene = bench.scene()
        sightings = []
        for renderer, fit in zip(bench.renderers, bench.fits, strict=True):
            true = renderer.model.pixel(scene.p_world)
            image = renderer.render(scene)
            if kind != "clean":
                image = spoiled(bench, image, true, kind)
            hint = Hint(true, scene.p_world, scene.axis_world)
            found = fit.find(bench.noisy(image), hint)
            if isinstance(found, Miss):
                misses[found.reason.value] += 1
            else:
                sightings.append(Sighting.of(found))
        if len(sightings) < 2:
            continue
        fix = bench.solver.solve((sightings[0], sightings[1]), scene.axis_world, 0.0)
        if fix.status is not FixStatus.VALID:
            misses[fix.status.value] += 1
            continue
        used += 1
        error = fix.p_tip_world - scene.p_world - bench.rig.needle.marker_offset * scene.axis_world
        inside += float(error @ np.linalg.solve(fix.covariance, error)) <= limit
    share = inside / max(used, 1)
    print(f"  {kind:<9} held {share:.1%} of {used} accepted of {count}; refused: {dict(misses)}")


def false_finds(bench: Bench, count: int) -> None:
    """Finds with the marker hidden, red cloth and an orange thing in view."""
    false, rng = Counter(), bench.rng
    for _ in range(count):
        scene = bench.scene()
        found = []
        for renderer, fit in zip(bench.renderers, bench.fits, strict=True):
            image = renderer.render(MarkerScene(scene.p_world, scene.axis_world, False))
            for colour in (RED_CLOTH, ORANGE):
                place = rng.uniform([40, 40], [600, 440])
                half = np.exp(rng.uniform(np.log(4.0), np.log(80.0), 2))
                thing = Patch(place, half, rng.uniform(0, 180), colour)
                image = patch(image, thing, rng)
            image = bench.noisy(image)
            finds = [f for f in fit.search(image) if isinstance(f, MarkerFix)]
            closer = [fit.find(image, Hint(f.uv, None, scene.axis_world)) for f in finds]
            found.append([f for f in closer if isinstance(f, MarkerFix)])
        false["pictures with a find"] += sum(bool(one) for one in found)
        for first in found[0]:
            for second in found[1]:
                pair = (Sighting.of(first), Sighting.of(second))
                fix = bench.solver.solve(pair, scene.axis_world, 0.0)
                false["false fixes"] += fix.status is FixStatus.VALID
    print(f"  marker hidden, red cloth and orange in view: {count} pairs, {dict(false)}")


def main() -> None:
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    bench = Bench()
    bound(bench, max(20, trials // 50))
    print("95 % ellipsoid of the stereo point")
    for kind in ("clean", "finger", "highlight"):
        coverage(bench, kind, trials)
    false_finds(bench, trials)


if __name__ == "__main__":
    main()
