"""Hard cases of a field of tissue: borders, padding, holes, walls lain along, membranes at one."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulation.field_rig import ALL, field_of, go, layered, scene_in, slab, stages_in, straight

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.parameters import Stage
from app.imaging.field import FieldTissue, TissueField, TissueKind

SETTINGS = settings(max_examples=60, deadline=None, derandomize=True)
PLACE = st.floats(-0.2, 0.2)
LOOKED = ("tissue", "tissue_ahead", "wall", "channel", "carried_share")
FORCES = [*range(sv.FORCE.start, sv.FORCE.stop), sv.AXIAL_FORCE, sv.POTENTIAL, sv.GAIN_WORK]


def holey() -> TissueField:
    """Return a small field with a hole of nobody's voxels, padding, and air all about it."""
    field = field_of(
        layered(("skin", 2.0), ("muscle", 6.0), ("organ", 10.0), ("lung", 30.0)),
        low=(-12.0, -12.0, -30.0),
        high=(12.0, 12.0, 6.0),
    )
    labels, distance = field.labels.copy(), field.distance.copy()
    labels[8:14, 8:16, 8:16], distance[8:14, 8:16, 8:16] = 0, 20
    labels[:, :2], distance[:, :2] = 0, 0  # padding: nobody's, and no distance at all
    return TissueField(labels, distance, field.affine_mm, field.tissues)


def everything(field: TissueField) -> list[Stage]:
    return stages_in(scene_in(field, *ALL))


def check(rows: FloatArray, codes: int) -> None:
    assert np.isfinite(rows).all()
    for name in LOOKED:
        assert np.isfinite(rows[:, sv.INDEX[name]]).all()
    assert ((rows[:, sv.TISSUE] >= 0) & (rows[:, sv.TISSUE] < codes)).all()
    assert ((rows[:, sv.TISSUE_AHEAD] >= 0) & (rows[:, sv.TISSUE_AHEAD] < codes)).all()
    length = np.linalg.norm(rows[:, sv.WALL_NORMAL], axis=1)
    assert (np.isclose(length, 1.0) | (length == 0.0)).all()
    assert np.abs(rows[:, sv.AXIAL_FORCE]).max() < 120.0
    assert np.abs(rows[:, sv.FORCE]).max() < 60.0


@pytest.fixture(scope="module")
def field() -> TissueField:
    return holey()


@pytest.fixture(scope="module")
def fresh(field: TissueField) -> list[Stage]:
    return everything(field)


def anew(stages: list[Stage]) -> list[Stage]:
    """Return the stages with memory of their own; one array may belong to two of them."""
    own = {id(s.parameters): s.parameters.copy() for s in stages}
    return [s._replace(parameters=own[id(s.parameters)]) for s in stages]


@SETTINGS
@given(st.lists(st.tuples(PLACE, PLACE, PLACE), min_size=2, max_size=12), st.floats(0.0, 0.05))
def test_at_borders_outside_in_padding_and_in_a_hole_all_is_finite(
    fresh: list[Stage], field: TissueField, corners: list[tuple[float, ...]], breath: float
) -> None:
    points = np.concatenate([np.linspace(a, b, 12) for a, b in itertools.pairwise(corners)])
    points *= [0.1, 0.1, 0.2]

    def breathe(k: int, state: FloatArray) -> None:
        state[sv.BREATH] = (0.3 * breath, 0.0, breath * np.sin(k))

    rows = go(anew(fresh), points, axis=(0.0, 0.0, -1.0), before=breathe)
    check(rows, len(field.tissues))


@SETTINGS
@given(
    st.sampled_from(["tip_x", "depth", "plant_depth", "axis_z", "l_out", "dt", "breath_x", "time"]),
    st.sampled_from([np.nan, np.inf, -np.inf, 1e300, -1e300]),
)
def test_what_is_no_number_for_a_tick_leaves_nothing_behind(
    fresh: list[Stage], field: TissueField, slot: str, value: float
) -> None:
    if slot == "axis_z" and np.isfinite(value):
        return  # no unit vector: kinematics gives none
    way = straight(-0.003, 0.025, 5e-4)

    def spoil(k: int, state: FloatArray) -> None:
        if k == 30:
            state[sv.INDEX[slot]] = value

    rows = go(anew(fresh), way, axis=(0.0, 0.0, -1.0), before=spoil)
    after = rows[31:]
    assert np.isfinite(after[:, FORCES]).all()
    assert np.isfinite(after[:, [sv.INDEX[name] for name in LOOKED]]).all()


@pytest.mark.parametrize("off", [0.0, 1e-9, 0.25e-3, -0.5e-3])
def test_a_needle_that_lies_along_a_boundary_feels_no_jump(off: float) -> None:
    field = field_of(
        [
            ("air", "", lambda p: p[:, 2]),
            ("fat", "", lambda p: np.minimum(-p[:, 2], -p[:, 0])),
            ("organ", "", lambda p: np.minimum(-p[:, 2], p[:, 0])),
        ]
    )
    tremble = 2e-6 * np.sin(np.arange(4000))
    way = straight(-0.002, 0.05, 0.052 / 3999)
    way[:, 0] = off + tremble
    rows = go(stages_in(scene_in(field, *ALL)), way, axis=(0.0, 0.0, -1.0))
    check(rows, 4)
    force = rows[:, sv.AXIAL_FORCE]
    deep = rows[:, sv.DEPTH] > 0.01
    assert np.abs(np.diff(force[deep])).max() < 0.7  # a capsule's, given way once


def test_two_membranes_in_one_place_are_told_one_after_the_other() -> None:
    def thin(p: FloatArray) -> FloatArray:
        return slab(-10.0, -10.0 - 1e-6)(p)

    field = field_of(
        [
            ("air", "", slab(100.0, 0.0)),
            ("skin", "", slab(0.0, -10.0)),
            ("muscle", "", thin),
            ("organ", "", slab(-10.0, -200.0)),
        ]
    )
    rows = go(stages_in(scene_in(field, *ALL)), straight(-0.002, 0.03, 1e-4))
    check(rows, 5)
    met = rows[(rows[:, sv.WALL] < 0.0) & (rows[:, sv.DEPTH] > 0.005)]
    assert set(met[:, sv.TISSUE]) in ({4.0}, {3.0, 4.0})
    assert met[:, sv.DEPTH] + met[:, sv.WALL] == pytest.approx(0.01, abs=6e-4)


def test_a_jump_of_the_measurement_ends_where_the_tip_is(field: TissueField) -> None:
    stages = everything(field)
    rows = go(
        stages, [[0, 0, 0.002], [0, 0, -0.029], [0.5, 0.5, 3.0], [0, 0, -0.012]], axis=(0, 0, -1)
    )
    check(rows, len(field.tissues))
    for _ in range(8):  # walls in between are told one a tick
        rows = go(stages, [[0, 0, -0.012]], axis=(0, 0, -1), state=rows[-1].copy())
    code = field.codes_at([[0.0, 0.0, -12.0]])[0]
    assert rows[-1, sv.TISSUE] == code


@SETTINGS
@given(st.integers(0, 2**31))
def test_any_bytes_are_a_field_that_gives_finite_forces(seed: int) -> None:
    rng = np.random.default_rng(seed)
    labels = rng.integers(0, 11, (6, 6, 6)).astype(np.uint8)
    table = tuple(FieldTissue(k, kind) for k, kind in enumerate(TissueKind))
    affine = np.diag([1.0, 1.0, 1.0, 1.0])
    affine[:3, 3] = -3.0
    distance = rng.integers(0, 127, labels.shape).astype(np.int8)
    field = TissueField(labels, distance, affine, table)
    way = straight(-0.004, 0.004, 1e-4) + rng.uniform(-0.002, 0.002, 3)
    check(go(stages_in(scene_in(field, *ALL)), way, axis=(0.0, 0.0, -1.0)), len(table))
