"""The marker: error against two Cramér-Rao bounds, coverage of the ellipsoid, false fixes.

Run as `python -m tests.bench.bench_marker [trials] [--seed N] [--part bound|coverage|hidden]`:
10000 trials by default, some forty minutes of one core. Pieces of a run have seeds of their own:
their pairs are others. `python -m tests.bench.hidden_marker` runs the last part alone.
"""

import argparse
from collections import Counter

import numpy as np

from app.studies.marker import joint_bound, position_bound
from app.tracking.confidence import chi_square_quantile
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Centre, Hint, MarkerFix, Miss
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.simulated.scene import MarkerScene
from tests.bench import hidden_marker
from tests.bench.marker_trials import KINDS, Trials

SHARES = (0.5, 0.95, 0.99)
PARTS = ("bound", "coverage", "hidden")
NAMES = (ExtractorName.MODEL_FIT, ExtractorName.OUTLINE_CENTROID, ExtractorName.ELLIPSE)


def bound(bench: Trials, count: int) -> None:
    """Root mean square error over the root mean square of both bounds, and medians of ratios."""
    print(
        "error over the Cramér-Rao bounds, rig wide, noise 4, blur 0.7 px: of the position alone,"
    )
    print("and beside the unknowns of the fit (shading, colours, width, length)")
    rig, shape = bench.rig, bench.rig.needle.shape
    finders = {name: extractors(rig, name) for name in NAMES}
    for background in ("even", "housing"):
        rows: dict[str, list[tuple[float, float, float]]] = {name: [] for name in NAMES}
        for _ in range(count):
            scene = bench.scene()
            for camera, renderer in enumerate(bench.renderers):
                seen = renderer.even(115) if background == "even" else renderer
                model, true = renderer.model, renderer.model.pixel(scene.p_world)

                def at(p_world, seen=seen, scene=scene):
                    return seen.render(MarkerScene(p_world, scene.axis_world))

                shift = centroid_shift(model, shape, scene.p_world, scene.axis_world)
                image = bench.noisy(seen.render(scene))
                hint = Hint(true + bench.rng.normal(0, 3, 2), scene.p_world, scene.axis_world)
                alone = position_bound(at, seen.band(scene), model, scene.p_world, 4.0)
                joint = joint_bound(
                    at, model, shape, rig.blur_px, scene.p_world, scene.axis_world, 4.0
                )
                for name in NAMES:
                    found = finders[name][camera].find(image, hint)
                    if isinstance(found, MarkerFix):
                        off = shift if found.centre is Centre.OUTLINE else 0.0
                        square = float(np.sum((found.uv - off - true) ** 2))
                        rows[name].append((square, float(np.trace(alone)), float(np.trace(joint))))
        for name, values in rows.items():
            print(f"  {background:<8} {name.value:<17} {compared(np.array(values))}")


def compared(values: np.ndarray) -> str:
    """Squares of errors and of both bounds, (n, 3), as a line."""
    square, alone, joint = values.T
    root = np.sqrt(np.mean(values, axis=0))
    return (
        f"RMS {root[0]:.4f} px   over the bound: position alone {root[0] / root[1]:.2f} "
        f"(median {np.median(np.sqrt(square / alone)):.2f})   joint {root[0] / root[2]:.2f} "
        f"(median {np.median(np.sqrt(square / joint)):.2f})   n {len(values)}"
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
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("trials", nargs="?", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--part", choices=PARTS, action="append")
    chosen = parser.parse_args()
    parts, trials = chosen.part or PARTS, chosen.trials
    if "bound" in parts:
        bound(Trials(chosen.seed), max(20, trials // 50))
    if "coverage" in parts:
        coverage(Trials(chosen.seed), -(-trials // len(KINDS)))
    if "hidden" in parts:
        hidden_marker.main(trials)


if __name__ == "__main__":
    main()
