"""Survey: how finely must a field of tissue know the patient, and are layers enough?

Needles through built-in patients, tilted by up to 10° from the plan. What each meets by layers
along the plan and by fields of 3, 2, 1 and 0.5 mm is held against the patient's own recipe: its
labels on voxels of 0.25 mm, followed at 0.05 mm. Force along the needle: friction of what is
inserted, cutting at the tip, by the published values. Side force and tip: the needle is pushed in
straight through what each way says it meets, by the effect itself, and turned by 2° there.
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter, process_time
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.progress import Progress
from app.core.rotation import rotation_exp
from app.core.units import MILLIMETRE
from app.imaging.field import TissueField
from app.imaging.field.from_recipe import field_of_recipe
from app.imaging.field.grid import FieldGrid
from app.imaging.field.making import make
from app.imaging.field.storing import from_bytes, to_bytes
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.tissue import tissue_along
from app.imaging.volume import Volume
from app.simulation.effects import declaration, parameters_of
from app.simulation.effects.lateral_tissue import step
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.scene import Binding, Scene, TissueLayer
from app.simulation.tissues import tissue_values
from app.studies.findings import Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Tissue: layers along the plan against fields of labels in the patient",
    "question": "How finely must a field know the patient, and are layers enough?",
    "reference": "the built-in patient's recipe on voxels of 0.25 mm, followed at 0.05 mm",
}

SPACINGS_MM: Final = (3.0, 2.0, 1.0, 0.5)
_PATIENTS: Final = (1, 6, 1001)
_PATHS: Final = 12
_TILT: Final = np.radians(10.0)
_LONG_MM: Final = 100.0
_FOLLOWED_MM: Final = 0.05
_FINE_MM: Final = 0.25
_NEAR_MM: Final = 1.0  # of a boundary of the reference: there the place of it is judged
_TURN: Final = np.radians(2.0)
_REACH_MM: Final = 102.0
_FELT: Final = 0.1  # [N]
_PLACED_MM: Final = 0.3
_COLUMNS: Final = (
    *("way", "force RMS [N]", "force most [N]", "side force most [N]", "tip most [mm]"),
    *("place of a boundary, median [mm]", "95 % [mm]", "not there", "look-up [ns]"),
    *("memory [MB]", "made in [s]", "loaded in [s]"),
)

Codes = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class _Met:
    """What a way says that paths meet: codes every 0.05 mm, shape (paths, n); and its costs."""

    codes: Codes
    look_up_ns: float = 0.0
    megabytes: float = 0.0
    made_s: float = 0.0
    loaded_s: float = 0.0


def _paths(entry: FloatArray, target: FloatArray, seed: int) -> FloatArray:
    """Directions about the plan's, shape (paths, 3); the first is its own."""
    rng, way = np.random.default_rng(seed), unit(target - entry, "plan")
    found = [way]
    while len(found) < _PATHS:
        turn = rng.normal(size=3)
        turn -= (turn @ way) * way
        found.append(rotation_exp(rng.uniform(0.0, _TILT) * unit(turn, "turn")) @ way)
    return np.array(found)


def _by_field(field: TissueField, points: FloatArray, table: Codes) -> Codes:
    codes: Codes = table[field.codes_at(points.reshape(-1, 3))].reshape(points.shape[:2])
    return codes


def _look_up_ns(field: TissueField, points: FloatArray) -> float:
    """Time of a look-up in the loop's own kernel [ns]."""
    from app.core.transform import RigidTransform
    from app.simulation.bound_field import BoundField
    from app.simulation.effects import tissue_field
    from app.simulation.tissue_walk import distances_of, labels_of, look_often

    bound = BoundField(field, RigidTransform(np.eye(3), np.zeros(3)), np.zeros(3))
    scene = Scene(tissues=tissue_values(field.tissues), field=bound)
    values = declaration("tissue_field").checked({})
    p = tissue_field.parameters(values, Binding(scene, sv.PLANT_DEPTH))
    places = np.ascontiguousarray(points.reshape(-1, 3) * MILLIMETRE)
    times = []
    for _ in range(4):
        start = perf_counter()
        look_often(p, labels_of(p), distances_of(p), places)
        times.append(perf_counter() - start)
    return 1e9 * min(times) / len(places)


def _layers(volume: Volume, entry: FloatArray, target: FloatArray, tissues: Any, n: int) -> Codes:
    """Codes by depth of the layers along the plan, an organ as the liver; for every path the same.

    Of kinds that the field has under several names the first is taken.
    """
    kinds = {str(t.kind): t.code for t in reversed(tissues)}
    kinds["organ"] = next(t.code for t in tissues if t.name == "liver")
    depths = (np.arange(n) + 0.5) * _FOLLOWED_MM
    codes = np.full(n, kinds["organ"], np.intp)
    for run in tissue_along(volume, entry, target):
        codes[(depths >= run.begin_mm) & (depths < run.end_mm)] = kinds[run.tissue.value]
    return np.tile(codes, (_PATHS, 1))


def _forces(codes: Codes, values: tuple[TissueLayer, ...]) -> FloatArray:
    """Force along the needle at every depth of a path [N]."""
    friction = np.array([tissue.friction for tissue in values])
    cut = np.array([tissue.toughness for tissue in values]) * OUTER_DIAMETER[18]
    inserted = np.cumsum(friction[codes], axis=-1) * _FOLLOWED_MM * MILLIMETRE
    return np.asarray(inserted + cut[codes])


def _turned(codes: Codes, values: tuple[TissueLayer, ...], fresh: FloatArray) -> FloatArray:
    """Side force [N] and offset of the tip [m] once the needle that met `codes` is turned."""
    p, state = fresh.copy(), sv.empty_state()
    state[sv.DEPTH_SOURCE], state[sv.AXIS_Z] = 1.0, -1.0
    last = len(codes) - 1
    for k in (*range(0, last, 4), last):
        depth = (k + 0.5) * _FOLLOWED_MM * MILLIMETRE
        state[sv.DEPTH] = state[sv.PLANT_DEPTH] = depth
        state[sv.L_OUT], state[sv.TISSUE] = 0.2 - depth, codes[k]
        step(state, p)
    for slot in sv.SUMS:
        state[slot] = 0.0
    state[sv.AXIS_X], state[sv.AXIS_Z] = np.sin(_TURN), -np.cos(_TURN)
    step(state, p)
    return np.array([np.linalg.norm(state[sv.FORCE]), *state[sv.TIP_OFFSET]])


def _boundaries(codes: Codes) -> list[tuple[int, int, int]]:
    """Return where tissues of one path begin: (sample, code before, code)."""
    at = np.flatnonzero(np.diff(codes)) + 1
    return [(int(k), int(codes[k - 1]), int(codes[k])) for k in at]


def _placed(reference: Codes, codes: Codes) -> tuple[list[float], int, int]:
    """Return how far boundaries lie off the reference's [mm]; how many are not there, of all."""
    off, missing, total = [], 0, 0
    for one, other in zip(reference, codes, strict=True):
        there = _boundaries(other)
        for k, before, code in _boundaries(one):
            total += 1
            same = [abs(k - m) for m, a, b in there if (a, b) == (before, code)]
            if same and min(same) * _FOLLOWED_MM < 3.0:
                off.append(min(same) * _FOLLOWED_MM)
            else:
                missing += 1
    return off, missing, total


def _far(reference: Codes) -> NDArray[np.bool_]:
    """Return which samples are farther than a millimetre from every boundary of the reference."""
    near = np.zeros(reference.shape, bool)
    reach = round(_NEAR_MM / _FOLLOWED_MM)
    for row, codes in zip(near, reference, strict=True):
        for k, _, _ in _boundaries(codes):
            row[max(0, k - reach) : k + reach] = True
    return ~near


def _patient(seed: int, report: Callable[[float, str], None]) -> dict[str, tuple[_Met, _Met, Any]]:
    """Return by way what paths through a patient meet, what the recipe says, and the tissues."""
    known = anatomy(seed)
    entry, target = np.array(known.entry_mm), np.array(known.lesion_mm)
    depths = (np.arange(round(_LONG_MM / _FOLLOWED_MM)) + 0.5) * _FOLLOWED_MM
    points = entry + depths[:, None] * _paths(entry, target, seed)[:, None, :]
    report(0.0, f"patient {seed}: the recipe on voxels of {_FINE_MM:g} mm")
    low = points.reshape(-1, 3).min(axis=0) - 1.0
    size = np.ceil((points.reshape(-1, 3).max(axis=0) + 1.0 - low) / _FINE_MM).astype(int) + 1
    affine = np.diag([_FINE_MM, _FINE_MM, _FINE_MM, 1.0])
    affine[:3, 3] = low
    x, y, z = (int(number) for number in size)
    grid = FieldGrid((z, y, x), affine, _FINE_MM, None, 0.0)
    fine = field_of_recipe(seed, grid, Progress())
    ijk = np.rint((points.reshape(-1, 3) - low) / _FINE_MM).astype(int)
    labels = fine.labels[ijk[:, 2], ijk[:, 1], ijk[:, 0]].astype(np.intp)
    reference = _Met(labels.reshape(points.shape[:2]))
    names = {(t.kind, t.name): t.code for t in fine.tissues}
    volume = load_ct(phantom_series(seed))
    report(0.3, f"patient {seed}: layers along the plan")
    start = process_time()
    along = _layers(volume, entry, target, fine.tissues, len(depths))
    found = {"layers along the plan": _Met(along, 0.0, 0.0, process_time() - start)}
    for number, spacing in enumerate(SPACINGS_MM):
        report(0.4 + 0.15 * number, f"patient {seed}: field of {spacing:g} mm")
        start = process_time()
        field = make(volume, (), entry, _REACH_MM, spacing)
        made = process_time() - start
        content = to_bytes(field, small=False)
        start = perf_counter()
        from_bytes(content, check=False)
        loaded = perf_counter() - start
        table = np.array([names.get((t.kind, t.name), 0) for t in field.tissues], np.intp)
        codes = _by_field(field, points, table)
        cost = _look_up_ns(field, points)
        found[f"field of {spacing:g} mm"] = _Met(codes, cost, field.megabytes, made, loaded)
    return {way: (met, reference, fine.tissues) for way, met in found.items()}


def _measured(patients: tuple[int, ...], progress: Progress | None) -> Findings:
    report = progress or Progress()
    by_way: dict[str, list[tuple[_Met, _Met, Any]]] = {}
    for number, seed in enumerate(patients):
        part = report.part(number / len(patients), (number + 1) / len(patients))
        for way, met in _patient(seed, part.report).items():
            by_way.setdefault(way, []).append(met)
    rows = tuple(_row(way, met) for way, met in by_way.items())
    default = next(row for row in rows if row[0] == "field of 1 mm")
    holds = float(default[1]) <= _FELT and float(default[5]) <= _PLACED_MM
    lines = (
        f"{_PATHS * len(patients)} needles of {_LONG_MM:g} mm through {len(patients)} built-in"
        f" patients, up to {np.degrees(_TILT):.0f}° from the plan.",
        f"In use: a field of 1 mm, {default[1]:.3f} N RMS farther than a millimetre from boundaries"
        f" ({_FELT:g} N is felt), boundaries within {default[6]:.2f} mm (95 %).",
    )
    sheet = Sheet("ways", "What needles meet, by each way", _COLUMNS, rows)
    return Findings((sheet,), lines=lines, passed=holds)


def _row(way: str, met: list[tuple[_Met, _Met, Any]]) -> tuple[str | float, ...]:
    square, most, count, side, tip = 0.0, 0.0, 0, 0.0, 0.0
    off: list[float] = []
    missing = total = 0
    for one, reference, tissues in met:
        values = tissue_values(tissues)
        gap = _forces(one.codes, values) - _forces(reference.codes, values)
        far = _far(reference.codes)
        square += float((gap[far] ** 2).sum())
        count += int(far.sum())
        most = max(most, float(np.abs(gap[far]).max()))
        fresh = _fresh(values)
        for a, b in zip(one.codes, reference.codes, strict=True):
            change = _turned(a, values, fresh) - _turned(b, values, fresh)
            side, tip = max(side, abs(change[0])), max(tip, float(np.linalg.norm(change[1:])))
        placed, lost, all_of_them = _placed(reference.codes, one.codes)
        off, missing, total = [*off, *placed], missing + lost, total + all_of_them
    middle, high = np.percentile(off, (50.0, 95.0)) if off else (np.nan, np.nan)
    costs = [
        round(float(np.mean([getattr(one, name) for one, _, _ in met])), digits)
        for name, digits in (("look_up_ns", 0), ("megabytes", 1), ("made_s", 2), ("loaded_s", 3))
    ]
    errors = (round((square / max(count, 1)) ** 0.5, 4), round(most, 3), round(float(side), 4))
    places = (round(float(middle), 3), round(float(high), 3), f"{missing} of {total}")
    return (way, *errors, round(1e3 * tip, 3), *places, *costs)


def _fresh(values: tuple[TissueLayer, ...]) -> FloatArray:
    """Return the array of a needle that keeps what its bins were cut in, by these values."""
    scene = Scene(tissues=values, field=values)
    asked = declaration("lateral_tissue").checked({})
    return parameters_of("lateral_tissue", asked, Binding(scene, sv.PLANT_DEPTH, "field"))


def _all(progress: Progress | None = None) -> Findings:
    return _measured(_PATIENTS, progress)


def _quick(progress: Progress | None = None) -> Findings:
    return _measured(_PATIENTS[1:2], progress)


STUDY: Final = Survey(measure=_all, quick=_quick)
"""Layers and fields against the recipe."""
