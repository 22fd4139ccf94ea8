"""Survey: how finely must a field of tissue know the patient, and are layers enough?

Needles are pushed through built-in patients and a CT, by the effects along the needle themselves.
The reference is no field: the recipe's own distance functions at any point, and on the CT the
labels of its own voxels by the nearest, both followed at 0.05 mm; with breathing, the same motion
of tissue. First every way on straight needles tilted by up to 10° from the plan; side force and tip
there by the effect itself, the needle turned by 2°. Then the field in use on bent needles beside
the plan, in patients who breathe.
"""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import perf_counter, process_time
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.body import find_body
from app.imaging.field import FieldTissue, TissueField
from app.imaging.field.from_recipe import TABLE
from app.imaging.field.making import SPACING_MM, make
from app.imaging.field.storing import from_bytes, to_bytes
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.tissue import tissue_along
from app.imaging.volume import Volume
from app.planning.paths import demonstration_plan
from app.simulation.bound_field import BoundField
from app.simulation.effects import declaration, parameters_of
from app.simulation.effects.lateral_tissue import step
from app.simulation.scene import Binding, Scene, TissueLayer
from app.simulation.tissues import tissue_values
from app.studies import field_errors, field_paths
from app.studies.errors import StudyError
from app.studies.field_errors import (
    GRAZING_DEG,
    THIN_MM,
    CodesAt,
    Missing,
    PathErrors,
    describe,
)
from app.studies.field_paths import BEFORE_MM, STEP_MM, Codes, NeedleFeel, NeedlePath, PushingHand
from app.studies.findings import Findings, Sheet, Survey
from app.studies.references.recipe_points import RecipePoints
from app.studies.references.voxel_labels import VoxelLabels

DECLARATION: Final[dict[str, Any]] = {
    "title": "Tissue: layers along the plan against fields of labels in the patient",
    "question": "How finely must a field know the patient, and are layers enough?",
    "reference": "the built-in recipe's distance functions; a CT's labels on its own voxels",
}

SPACINGS_MM: Final = (3.0, 2.0, 1.0, 0.5)
PATIENTS: Final = (1, 3, 6, 11, 17, 1001, 1004)
_COMPARED: Final = (1, 6, 1001)
_PATHS: Final = 12
PATHS: Final = 400
"""Random paths where nobody says how many: two minutes of processor time."""

_MANY: Final = 10_000
_QUICK: Final = 16
_TURN: Final = np.radians(2.0)
_REACH_MM: Final = 102.0
_FELT: Final = 0.1  # [N]
PLACED_MM: Final = 0.3
_PEAK: Final = 0.05
_PROBE_MM: Final = 0.3
_LISTED: Final = 200
_AT_ORIGIN: Final = RigidTransform(np.eye(3), np.zeros(3))
_WAYS: Final = (
    *("way", "force RMS [N]", "force most [N]", "side force most [N]", "tip most [mm]"),
    *("place RMS [mm]", "place 95 % [mm]", "not there", "peak 95 % [%]", "look-up [ns]"),
    *("memory [MB]", "made in [s]", "loaded in [s]"),
)
_IN_USE: Final = (
    *(
        "patient",
        "paths",
        "force RMS [N]",
        "force 95 % [N]",
        "force worst [N]",
        "RMS, same membranes [N]",
    ),
    *("membranes", "place RMS [mm]", "place 95 % [mm]", "place worst [mm]"),
    *("peak RMS [%]", "peak 95 % [%]", "peak worst [%]"),
    *("boundaries not there", "not in the reference", "in one alone"),
)
_MISSING: Final = ("patient", "path", "at [mm]", "between", "thick [mm]", "grazing [°]", "reason")


@dataclass(frozen=True, slots=True, eq=False)
class _Subject:
    """Whom needles go through: his CT, plan [mm], and what the reference says lies where."""

    name: str
    volume: Volume
    entry: FloatArray
    target: FloatArray
    tissues: tuple[FieldTissue, ...]
    codes_at: CodesAt
    probe_mm: float = _PROBE_MM

    @property
    def values(self) -> tuple[TissueLayer, ...]:
        """Return the values of its tissues by code."""
        return tissue_values(self.tissues)

    def world_codes(self, p_world: FloatArray) -> Codes:
        """Return codes at points of the world [m], which is the patient's own."""
        return self.codes_at(p_world / MILLIMETRE)


@dataclass(slots=True, eq=False)
class _FieldWay:
    """What came of a way, and its costs."""

    errors: list[PathErrors] = field(default_factory=list)
    side: float = 0.0
    tip: float = 0.0
    costs: list[tuple[float, float, float, float]] = field(default_factory=list)


def _built_in(seed: int) -> _Subject:
    known = anatomy(seed)
    entry, target = np.array(known.entry_mm), np.array(known.lesion_mm)
    recipe = RecipePoints(seed)
    volume = load_ct(phantom_series(seed))
    return _Subject(f"patient {seed}", volume, entry, target, TABLE, recipe.codes_at)


def _chest(progress: Progress) -> _Subject | None:
    folder = Path(os.environ.get("ACUS_TEST_DATA", "../shared/data")) / "ct_chest_lidc0314"
    if not folder.is_dir():
        return None
    volume = load_ct(folder)
    body = find_body(volume)
    plan = demonstration_plan(volume, body)
    entry, target = np.array(plan.entry_mm), np.array(plan.target_mm)
    labels = VoxelLabels(volume, body, entry, _REACH_MM + 10.0, progress)
    probe = 1.5 * float(labels.spacing_mm.max())
    return _Subject("chest", volume, entry, target, labels.tissues, labels.codes_at, probe)


def _bound(made: TissueField, subject: _Subject) -> BoundField:
    return BoundField(made, _AT_ORIGIN, subject.target * MILLIMETRE)


def _no_field(subject: _Subject) -> TissueField:
    """Return a field of nothing with the reference's table: codes are told, not looked up."""
    nothing = np.zeros((2, 2, 2), np.uint8)
    return TissueField(nothing, nothing.astype(np.int8), np.eye(4), subject.tissues)


def _codes_by(own: Sequence[FieldTissue], other: Sequence[FieldTissue]) -> Codes:
    """Return codes of one table by those of another; what it has not is unknown."""
    codes = {(tissue.kind, tissue.name): tissue.code for tissue in own}
    return np.array([codes.get((t.kind, t.name), 0) for t in other], np.intp)


def _layers(subject: _Subject, n: int) -> Codes:
    """Codes by depth of the layers along the plan, an organ as the liver; for every path the same.

    Of kinds that the field has under several names the first is taken.
    """
    kinds = {str(t.kind): t.code for t in reversed(subject.tissues)}
    kinds["organ"] = next(t.code for t in subject.tissues if t.name == "liver")
    depths = (np.arange(n) + 0.5) * STEP_MM - BEFORE_MM
    codes = np.where(depths < 0.0, kinds["air"], kinds["organ"]).astype(np.intp)
    for run in tissue_along(subject.volume, subject.entry, subject.target):
        codes[(depths >= run.begin_mm) & (depths < run.end_mm)] = kinds[run.tissue.value]
    return codes


def _turned(codes: Codes, values: tuple[TissueLayer, ...], fresh: FloatArray) -> FloatArray:
    """Side force [N] and offset of the tip [m] once the needle that met `codes` is turned."""
    p, state = fresh.copy(), sv.empty_state()
    state[sv.DEPTH_SOURCE], state[sv.AXIS_Z] = 1.0, -1.0
    last = len(codes) - 1
    for k in (*range(0, last, 4), last):
        depth = (k + 0.5) * STEP_MM * MILLIMETRE
        state[sv.DEPTH] = state[sv.PLANT_DEPTH] = depth
        state[sv.L_OUT], state[sv.TISSUE] = 0.2 - depth, codes[k]
        step(state, p)
    for slot in sv.SUMS:
        state[slot] = 0.0
    state[sv.AXIS_X], state[sv.AXIS_Z] = np.sin(_TURN), -np.cos(_TURN)
    step(state, p)
    return np.array([np.linalg.norm(state[sv.FORCE]), *state[sv.TIP_OFFSET]])


def _fresh(values: tuple[TissueLayer, ...]) -> FloatArray:
    """Return the array of a needle that keeps what its bins were cut in, by these values."""
    scene = Scene(tissues=values, field=values)
    asked = declaration("lateral_tissue").checked({})
    return parameters_of("lateral_tissue", asked, Binding(scene, sv.PLANT_DEPTH, "field"))


def _look_up_ns(bound: BoundField, points: FloatArray) -> float:
    """Time of a look-up in the loop's own kernel [ns]."""
    from app.simulation.effects import tissue_field
    from app.simulation.tissue_walk import distances_of, labels_of, look_often

    scene = Scene(tissues=tissue_values(bound.tissue.tissues), field=bound)
    values = declaration("tissue_field").checked({})
    p = tissue_field.parameters(values, Binding(scene, sv.PLANT_DEPTH))
    times = []
    for _ in range(4):
        start = perf_counter()
        look_often(p, labels_of(p), distances_of(p), points)
        times.append(perf_counter() - start)
    return 1e9 * min(times) / len(points)


def _cut(felt: NeedleFeel, count: int) -> NeedleFeel:
    return NeedleFeel(*(getattr(felt, name)[:count] for name in NeedleFeel.__slots__))


def _straight(
    subject: _Subject, spacings: Sequence[float], report: Callable[[float, str], None]
) -> dict[str, _FieldWay]:
    """Compare every way on straight needles without breathing, by its name."""
    paths = field_paths.straight_paths(subject.entry, subject.target, _PATHS, PATIENTS[0])
    values, still = subject.values, np.zeros_like(paths[0].points)
    told, fresh = PushingHand(values, _bound(_no_field(subject), subject)), _fresh(values)
    references = [told.by_codes(path, subject.world_codes(path.points), still) for path in paths]
    counts = [field_errors.until_bone(felt.codes, subject.tissues) for felt in references]
    ways: dict[str, _FieldWay] = {}

    def add(name: str, felt_by: Sequence[NeedleFeel], *costs: float) -> None:
        way = ways[name] = _FieldWay()
        way.costs.append((costs[0], costs[1], costs[2], costs[3]))
        for felt, reference, count in zip(felt_by, references, counts, strict=True):
            one, other = _cut(felt, count), _cut(reference, count)
            way.errors.append(field_errors.compare(other, one, values))
            gap = _turned(one.codes, values, fresh) - _turned(other.codes, values, fresh)
            way.side = max(way.side, abs(float(gap[0])))
            way.tip = max(way.tip, float(np.linalg.norm(gap[1:])))

    start = process_time()
    along = _layers(subject, len(still))
    made_in = process_time() - start
    add("layers along the plan", [told.by_codes(p, along, still) for p in paths], 0, 0, made_in, 0)
    for number, spacing in enumerate(spacings):
        report(number / len(spacings), f"{subject.name}: field of {spacing:g} mm")
        start = process_time()
        made = make(subject.volume, (), subject.entry, _REACH_MM, spacing)
        made_in = process_time() - start
        content = to_bytes(made, small=False)
        start = perf_counter()
        from_bytes(content, check=False)
        loaded = perf_counter() - start
        bound, table = _bound(made, subject), _codes_by(subject.tissues, made.tissues)
        hand = PushingHand(tissue_values(made.tissues), bound)
        felt = [_renamed(hand.in_field(path), table) for path in paths]
        cost = _look_up_ns(bound, np.concatenate([path.points for path in paths]))
        add(f"field of {spacing:g} mm", felt, cost, made.megabytes, made_in, loaded)
        if spacing == SPACING_MM:
            nearest = [
                told.by_codes(path, table[_nearest(made, path.points / MILLIMETRE)], still)
                for path in paths
            ]
            add(f"field of {spacing:g} mm, nearest voxel", nearest, 0, 0.5 * made.megabytes, 0, 0)
    return ways


def _renamed(felt: NeedleFeel, table: Codes) -> NeedleFeel:
    return NeedleFeel(table[felt.codes], felt.force, felt.membrane, felt.punctures)


def _nearest(made: TissueField, points_mm: FloatArray) -> Codes:
    """Codes of the nearest voxels: what a field without distances would say."""
    ijk = np.rint(points_mm @ made.inverse_mm[:3, :3].T + made.inverse_mm[:3, 3]).astype(np.intp)
    i, j, k = np.clip(ijk, 0, np.array(made.labels.shape[::-1]) - 1).T
    return made.labels[k, j, i].astype(np.intp)


def _bent(
    subject: _Subject, count: int, report: Callable[[float, str], None]
) -> tuple[list[PathErrors], list[Missing], list[float]]:
    """Compare the field in use on random bent needles with breathing.

    The last are of membranes that lie too far off along a path: how far that is across them [mm].
    """
    report(0.0, f"{subject.name}: the field in use")
    made = make(subject.volume, (), subject.entry, _REACH_MM, SPACING_MM)
    bound, table, values = (
        _bound(made, subject),
        _codes_by(subject.tissues, made.tissues),
        subject.values,
    )
    hand = PushingHand(tissue_values(made.tissues), bound)
    told = PushingHand(values, _bound(_no_field(subject), subject))
    errors: list[PathErrors] = []
    missing: list[Missing] = []
    across: list[float] = []
    seed = sum(subject.name.encode())
    paths = field_paths.random_paths(subject.entry, subject.target, count, seed)
    back = _codes_by(made.tissues, subject.tissues)
    for number, path in enumerate(paths):
        report((number + 1) / (count + 1), f"{subject.name}: path {number + 1} of {count}")
        rest = bound.at_rest(
            path.points, path.breath, lambda points: back[subject.world_codes(points)]
        )
        codes = subject.world_codes(rest)
        length = field_errors.until_bone(codes, subject.tissues)
        part = NeedlePath(path.points[:length], path.ways[:length], path.breath[:length])
        reference = told.by_codes(part, codes[:length], (path.points - rest)[:length])
        found = field_errors.compare(reference, _renamed(hand.in_field(part), table), values)
        errors.append(found)
        known = (reference, part, rest / MILLIMETRE, subject.codes_at)
        told_of = (subject.tissues, subject.probe_mm)
        missing += [
            replace(describe(subject.name, number, k, *known, *told_of), is_parted=parted)
            for k, parted in found.missing
        ]
        far = np.flatnonzero(found.is_membrane & (found.places > PLACED_MM))
        slant = [
            describe(subject.name, number, int(found.samples[n]), *known, *told_of).grazing_deg
            for n in far
        ]
        across += (found.places[far] * np.cos(np.radians(slant))).tolist()
    return errors, missing, across


def _spread(values: Sequence[FloatArray]) -> tuple[float, float, float]:
    """Root mean square, 95 % and worst of what stands in several arrays; NaN for nothing."""
    every = np.abs(np.concatenate([np.empty(0), *values]))
    if not len(every):
        return float("nan"), float("nan"), float("nan")
    return float((every**2).mean() ** 0.5), float(np.percentile(every, 95.0)), float(every.max())


def _way_row(name: str, way: _FieldWay) -> tuple[str | float, ...]:
    force, places = _spread([e.force for e in way.errors]), _spread([e.places for e in way.errors])
    total = sum(len(e.places) + len(e.missing) for e in way.errors)
    lost = sum(len(e.missing) for e in way.errors)
    costs = np.mean(way.costs, axis=0)
    return (
        name,
        round(force[0], 4),
        round(force[2], 3),
        round(way.side, 4),
        round(1e3 * way.tip, 3),
        round(places[0], 3),
        round(places[1], 3),
        f"{lost} of {total}",
        round(100.0 * _spread([e.peaks for e in way.errors])[1], 1),
        round(float(costs[0])),
        *(round(float(cost), digits) for cost, digits in zip(costs[1:], (1, 2, 3), strict=True)),
    )


def _use_row(name: str, errors: Sequence[PathErrors]) -> tuple[str | float, ...]:
    membranes = [e.places[e.is_membrane] for e in errors]
    lost = sum(len(e.missing) for e in errors)
    total = lost + sum(len(e.places) for e in errors)
    return (
        name,
        len(errors),
        *(round(value, 4) for value in _spread([e.force for e in errors])),
        round(_spread([e.force for e in errors if not e.lost])[0], 4),
        sum(len(places) for places in membranes),
        *(round(value, 3) for value in _spread(membranes)),
        *(round(100.0 * value, 2) for value in _spread([e.peaks for e in errors])),
        f"{lost} of {total}",
        sum(e.unknown for e in errors),
        sum(e.lost for e in errors),
    )


def _goals(errors: Sequence[PathErrors], across: Sequence[float]) -> tuple[list[str], bool]:
    """Say which goals are met, and with which figures."""
    force = _spread([e.force for e in errors])[0]
    placed = np.concatenate([np.empty(0), *(e.places[e.is_membrane] for e in errors)])
    peaks = np.abs(np.concatenate([np.empty(0), *(e.peaks for e in errors)]))
    far, high = int((placed > PLACED_MM).sum()), int((peaks > _PEAK).sum())
    lost, alike = sum(e.lost for e in errors), [e for e in errors if not e.lost]
    same = _spread([e.force for e in alike])[0]
    lines = [
        f"Force: {force:.3f} N RMS farther than 1 mm from membranes (goal {_FELT:g}):"
        f" {'met' if force <= _FELT else 'MISSED'}; {same:.3f} N on the {len(alike)} needles on"
        " which the same membranes give way.",
        f"Place: {far} of {len(placed)} membranes lie farther than {PLACED_MM:g} mm off along the"
        f" path, {sum(off > PLACED_MM for off in across)} across themselves:"
        f" {'MISSED' if far else 'met'}.",
        f"Peak: {high} of {len(peaks)} differ by more than {100 * _PEAK:g} %, and {lost} give way"
        f" in one of the two alone: {'MISSED' if high or lost else 'met'}.",
    ]
    return lines, force <= _FELT and not (far or high or lost)


def _measured(
    compared: Sequence[int],
    patients: Sequence[int],
    spacings: Sequence[float],
    count: int,
    progress: Progress | None,
) -> Findings:
    report = progress or Progress()
    ways: dict[str, list[_FieldWay]] = {}
    for number, seed in enumerate(compared):
        part = report.part(0.3 * number / len(compared), 0.3 * (number + 1) / len(compared))
        for name, way in _straight(_built_in(seed), spacings, part.report).items():
            ways.setdefault(name, []).append(way)
    errors: dict[str, list[PathErrors]] = {}
    missing: list[Missing] = []
    across: dict[str, list[float]] = {}
    chest = _chest(report.part(0.3, 0.35))
    whom = (*patients, *((chest,) if chest is not None else ()))
    each = -(-count // len(whom))
    for number, who in enumerate(whom):
        part = report.part(*(0.35 + 0.65 * (number + n) / len(whom) for n in (0, 1)))
        subject = who if isinstance(who, _Subject) else _built_in(who)
        errors[subject.name], lost, across[subject.name] = _bent(subject, each, part.report)
        missing += lost
    built_in = [e for name, some in errors.items() if name != "chest" for e in some]
    rows = [_use_row(name, some) for name, some in errors.items()]
    rows.append(_use_row("built-in, all", built_in))
    joined = {name: _joined(some) for name, some in ways.items()}
    lines, met = _goals(
        built_in, [off for name, some in across.items() if name != "chest" for off in some]
    )
    lines = [
        f"{len(built_in)} bent needles with breathing through {len(patients)} built-in patients,"
        f" field of {SPACING_MM:g} mm:",
        *lines,
    ]
    if chest is None:
        lines.append("No chest: ACUS_TEST_DATA names the folder of the shared data.")
    else:
        lines.append(f"{each} through a chest whose labels are steps of whole voxels:")
        lines += _goals(errors["chest"], across["chest"])[0]
    listed = sorted(missing, key=lambda one: (one.patient == "chest", -one.thickness_mm))
    lines += [_of_missing("built-in", [m for m in listed if m.patient != "chest"])]
    lines += [_of_missing("chest", [m for m in listed if m.patient == "chest"])]
    if len(listed) > _LISTED:
        lines.append(
            f"Of {len(listed)} that are not there the {_LISTED} are listed, the thickest first."
        )
    sheets = (
        Sheet(
            "ways",
            "What needles meet, by each way",
            _WAYS,
            tuple(_way_row(*pair) for pair in joined.items()),
        ),
        Sheet("in_use", "The field in use on bent needles, with breathing", _IN_USE, tuple(rows)),
        Sheet(
            "missing",
            "Boundaries that it has not",
            _MISSING,
            tuple(map(_missing_row, listed[:_LISTED])),
        ),
    )
    return Findings(sheets, lines=tuple(lines), passed=met)


def _joined(ways: Sequence[_FieldWay]) -> _FieldWay:
    return _FieldWay(
        [error for way in ways for error in way.errors],
        max(way.side for way in ways),
        max(way.tip for way in ways),
        [cost for way in ways for cost in way.costs],
    )


def _of_missing(name: str, missing: Sequence[Missing]) -> str:
    reasons = ("thin", "grazed", "a third between", "small vessel", "")
    thin, grazed, parted, small, neither = (
        sum(one.reason == reason for one in missing) for reason in reasons
    )
    return (
        f"Boundaries not there, {name}: {len(missing)}; {thin} of tissue thinner than {THIN_MM:g}"
        f" mm, {grazed} met at more than {GRAZING_DEG:g}° from their normal, {parted} with a third"
        f" tissue between, {small} of vessels of less than 2 mm, {neither} for no such reason."
    )


def _missing_row(missing: Missing) -> tuple[str | float, ...]:
    place = (missing.patient, missing.path, missing.at_mm, missing.into)
    hard = (missing.thickness_mm, missing.grazing_deg, missing.reason or "none known")
    return (*place, *hard)


def _all(progress: Progress | None = None, paths: int = PATHS, full: bool = False) -> Findings:
    count = _MANY if full else paths
    return _measured(_COMPARED, PATIENTS, SPACINGS_MM, count, progress)


def _quick(progress: Progress | None = None, paths: int = _QUICK, full: bool = False) -> Findings:
    if full:
        raise StudyError(sentence("--full and --quick ask for both: leave one of them out"))
    return _measured(_COMPARED[1:2], _COMPARED[1:2], SPACINGS_MM[:3], paths, progress)


STUDY: Final = Survey(measure=_all, quick=_quick, options=("paths", "full"))
"""Layers and fields against the recipe, and a CT's own voxels."""
