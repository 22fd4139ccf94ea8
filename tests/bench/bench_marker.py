"""The marker: error against the Cramér-Rao bound, coverage of the ellipsoid, false fixes.

Run as `python -m tests.bench.bench_marker [trials]` (10000 by default, some twenty minutes of one
core); `python -m tests.bench.hidden_marker` runs the last part alone.
"""

import sys
from collections import Counter

import numpy as np

from app.tracking.confidence import chi_square_quantile
from app.tracking.markers.cramer_rao import position_bound
from app.tracking.markers.extractor import Hint, Miss
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.simulated.scene import MarkerScene
from tests.bench import hidden_marker
from tests.bench.marker_trials import KINDS, Trials

SHARES = (0.5, 0.95, 0.99)


def bound(bench: Trials, count: int) -> None:
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


def coverage(bench: Trials, count: int) -> None:
    """Share of fixes whose 50, 95 and 99 % ellipsoids hold the truth, `count` pairs a kind."""
    print(f"ellipsoid of the tip, {count} pairs of each kind: share that held the truth")
    print(f"  {'kind':<10} {'accepted':>8} {'50 %':>7} {'95 %':>7} {'99 %':>7}  {'+-':>5}  refused")
    limits = [chi_square_quantile(share, 3) for share in SHARES]
    squares: dict[str, list[float]] = {kind: [] for kind in KINDS}
    refused: dict[str, Counter] = {kind: Counter() for kind in KINDS}
    for _ in range(count):
        for kind in KINDS:
            trial = bench.run(kind)
            if trial.accepted:
                squares[kind].append(trial.square)
                continue
            misses = [one.reason.value for one in trial.found if isinstance(one, Miss)]
            refused[kind][misses[0] if misses else trial.fix.status.value] += 1
    squares["all"] = [square for values in squares.values() for square in values]
    refused["all"] = sum(refused.values(), Counter())
    for kind, values in squares.items():
        held = [np.mean(np.array(values) <= limit) if values else np.nan for limit in limits]
        error = np.sqrt(0.95 * 0.05 / max(1, len(values)))
        table = " ".join(f"{share:7.1%}" for share in held)
        print(f"  {kind:<10} {len(values):>8} {table}  {error:5.1%}  {dict(refused[kind])}")


def main() -> None:
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    bench = Trials()
    bound(bench, max(20, trials // 50))
    coverage(bench, -(-trials // len(KINDS)))
    hidden_marker.main(trials)


if __name__ == "__main__":
    main()
