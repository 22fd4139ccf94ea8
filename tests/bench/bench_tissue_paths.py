"""The side force of tissue on random paths through the built-in patients, beside a fine reference.

Entries all over the skin, targets inside, layers from the CT, needles of four gauges, insertions of
30 to 150 mm (or to the bone), then a turn of 1 to 8 degrees about the fulcrum. The reference are
400 cubic Hermite elements over the same layers. A liver simulator was published with 0.12 N RMS
over 31 222 paths.

Run as `make bench BENCH=tissue_paths`. To keep: every error at most 0.1 N, or 10 % of the force.
"""

from math import asin

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.exercises.parts import LayerPart
from app.exercises.tissue import layers_along
from app.imaging.body import find_body
from app.imaging.errors import ImagingError
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.skin import skin_points
from app.planning.plan import Plan
from app.simulation.effects import lateral_tissue as effect
from app.simulation.needles import OUTER_DIAMETER, bending_stiffness
from app.studies.lateral_tissue import _insert_and_turn, hermite_moment

PATHS, PATIENTS = 10_000, (1, 7, 14, 1001)
GAUGES = (17, 18, 20, 22)
LENGTH, ELEMENTS, PUSH = 0.2, 400, 0.05e-3


def forces(
    layers: tuple[LayerPart, ...], gauge: int, depth: float, turn: float
) -> tuple[float, float]:
    """Force at the hub by the program and by the reference [N]."""
    ends = 1e-3 * np.cumsum([layer.thickness_mm for layer in layers])
    stiffness = 1e3 * np.array([layer.side_stiffness_kpa for layer in layers])
    ei, lever = bending_stiffness(OUTER_DIAMETER[gauge]), LENGTH - depth
    state = sv.empty_state()
    state[sv.L_OUT], state[sv.DEPTH_SOURCE] = lever, 1.0
    memory = effect.empty(ends, stiffness, 1.0 / ei, 1e-3)
    ticks = round(depth / PUSH) + 1
    found = _insert_and_turn(effect.step, state, memory, depth, asin(turn), ticks)
    reference = hermite_moment(
        over_elements(ends, stiffness, depth),
        ei,
        depth,
        turn,
        np.empty((2 * ELEMENTS, 4)),
        np.empty(2 * ELEMENTS),
    )
    return found / lever, reference / lever


def over_elements(ends: FloatArray, stiffness: FloatArray, depth: float) -> FloatArray:
    """Mean stiffness over each element, so that layers end where they do."""
    edges = np.linspace(0.0, depth, ELEMENTS + 1)
    starts = np.concatenate([[0.0], ends[:-1]])
    reach = np.minimum(edges[1:, None], ends) - np.maximum(edges[:-1, None], starts)
    result: FloatArray = (np.clip(reach, 0.0, None) * stiffness).sum(axis=1) / np.diff(edges)
    return result


def main() -> None:
    """Print errors by gauge, and how many paths miss the bound."""
    rng = np.random.default_rng(1)
    found: list[tuple[int, float, float]] = []
    for seed in PATIENTS:
        volume = load_ct(phantom_series(seed))
        skin = skin_points(find_body(volume))
        done = 0
        while done < PATHS // len(PATIENTS):
            number = rng.integers(len(skin))
            entry, outward = skin.points_mm[number], skin.outward[number]
            away = rng.normal(size=3)
            way = -outward + 0.5 * away / np.linalg.norm(away)
            target = entry + 150.0 * way / np.linalg.norm(way)
            try:
                layers = layers_along(volume, Plan(entry, target))
            except ImagingError:
                continue
            rigid = layers[-1].rigid
            soft = sum(layer.thickness_mm for layer in layers[: -1 if rigid else None])
            deepest = min(0.15, 1e-3 * soft)
            if deepest < 0.03:
                continue
            gauge = int(rng.choice(GAUGES))
            depth, turn = rng.uniform(0.03, deepest), np.deg2rad(rng.uniform(1.0, 8.0))
            found.append((gauge, *forces(layers, gauge, depth, turn)))
            done += 1
        print(f"patient {seed}: {done} paths", flush=True)
    table = np.array(found)
    for gauge in GAUGES:
        report(f"{gauge} G", table[table[:, 0] == gauge])
    report("all", table)


def report(name: str, rows: FloatArray) -> None:
    """Print errors of some paths."""
    error, true = np.abs(rows[:, 1] - rows[:, 2]), rows[:, 2]
    missed = np.count_nonzero(error > np.maximum(0.1, 0.1 * true))
    print(
        f"{name:>5}: {len(rows)} paths, force {true.mean():.2f} N (most {true.max():.1f}); error "
        f"RMS {np.sqrt(np.mean(error**2)):.5f} N, most {error.max():.4f} N; beyond 0.1 N and 10 %: "
        f"{missed}"
    )


if __name__ == "__main__":
    main()
