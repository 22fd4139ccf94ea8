"""What lies about the tip: walls told one by one, breathing, cuts of before, and nothing copied."""

import gc
import time
import weakref

import numpy as np
import pytest
from simulation.field_rig import (
    LOOKS,
    SIMULATED,
    Distance,
    field_of,
    go,
    layered,
    scene_in,
    stages_in,
    straight,
)

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.device.control import Loop
from app.imaging.field import FieldTissue, TissueField, TissueKind
from app.simulation import tissue_walk as walk
from app.simulation.plan import compile
from app.simulation.tissues import tissue_values

POSE = RigidTransform(rotation_exp(np.array([0.3, -0.2, 0.5])), np.array([0.01, 0.02, 0.03]))


def ball(centre: FloatArray, radius: float) -> Distance:
    return lambda points: radius - np.linalg.norm(points - centre, axis=1)


def random_field(seed: int) -> TissueField:
    """Any codes beside any distances: the rule has to hold for what no maker would make, too."""
    rng = np.random.default_rng(seed)
    labels = rng.integers(0, 6, (7, 8, 9)).astype(np.uint8)
    table = tuple(FieldTissue(k, kind) for k, kind in enumerate(list(TissueKind)[:6]))
    affine = np.diag([1.0, 1.2, 0.8, 1.0])
    affine[:3, 3] = (-4.0, -5.0, -3.0)
    return TissueField(labels, rng.integers(0, 90, labels.shape).astype(np.int8), affine, table)


def test_the_loop_looks_up_what_scoring_and_pictures_look_up() -> None:
    field = random_field(1)
    memory = stages_in(scene_in(field, "tissue_field", pose=POSE))[1].parameters
    points = np.random.default_rng(2).uniform(-6.0, 6.0, (4000, 3))
    there = field.look_up(points)
    views = walk.labels_of(memory), walk.distances_of(memory)
    outside = 0
    for number, point in enumerate(1e-3 * points @ POSE.rotation.T + POSE.translation):
        code, other, inside, *normal = walk.at_rest(memory, *views, *point)
        assert code == there.code[number]
        if there.other[number] >= 0:
            assert other == there.other[number]
            assert 1e3 * inside == pytest.approx(there.wall_mm[number], abs=1e-9)
            np.testing.assert_allclose(normal, POSE.rotation @ there.normal[number], atol=1e-9)
        outside += code == 0 and other == 0
    assert outside > 100


THIN = (
    ("skin", 2.0),
    ("fat", 1.3),
    ("muscle", 0.9),
    ("organ", 1.4),
    ("vessel", 1.1),
    ("gut", 60.0),
)


@pytest.mark.long("machine")
@pytest.mark.parametrize("speed", [0.002, 0.1, 1.0])
def test_no_wall_is_jumped_over_and_each_is_told_once_at_its_place(speed: float) -> None:
    field = field_of(layered(*THIN), spacing=0.5)
    rows = go(stages_in(scene_in(field, "tissue_field")), straight(-0.003, 0.02, 1e-3 * speed))
    met = rows[rows[:, sv.WALL] < 0.0]
    assert met[:, sv.TISSUE].tolist() == [2, 3, 4, 5, 6, 7]
    np.testing.assert_array_equal(met[:, sv.TISSUE], met[:, sv.TISSUE_AHEAD])
    places = 1e3 * (met[:, sv.DEPTH] + met[:, sv.WALL])
    np.testing.assert_allclose(places, np.cumsum([0.0, 2.0, 1.3, 0.9, 1.4, 1.1]), atol=0.03)
    np.testing.assert_allclose(met[:, sv.WALL_NORMAL] @ [0.0, 0.0, -1.0], 1.0, atol=1e-3)


def test_a_wall_ahead_is_told_with_what_lies_behind_it_and_its_normal() -> None:
    tilt = np.array([np.sin(0.5), 0.0, -np.cos(0.5)])
    layers = layered(("fat", 20.0), ("bone", 60.0))
    layers[1] = ("fat", "", lambda p: np.minimum(-p[:, 2], 20.0 - p @ tilt))
    layers[2] = ("bone", "", lambda p: np.minimum(-p[:, 2], p @ tilt - 20.0))
    rows = go(stages_in(scene_in(field_of(layers), "tissue_field")), straight(0.015, 0.0225, 1e-4))
    ahead = rows[(rows[:, sv.TISSUE] == 2) & (rows[:, sv.WALL] < 0.9)]
    surface = 0.02 / np.cos(0.5)
    np.testing.assert_allclose(ahead[:, sv.DEPTH] + ahead[:, sv.WALL], surface, atol=3e-5)
    assert set(ahead[:, sv.TISSUE_AHEAD]) == {3.0}
    np.testing.assert_allclose(ahead[:, sv.WALL_NORMAL], np.tile(tilt, (len(ahead), 1)), atol=0.02)
    assert 0.0025 < ahead[0, sv.WALL] < 0.0031


@pytest.mark.long("machine")
def test_going_back_tells_no_wall_as_met() -> None:
    stages = stages_in(scene_in(field_of(layered(*THIN), spacing=0.5), "tissue_field"))
    state = sv.empty_state()
    go(stages, straight(-0.003, 0.02, 1e-3), state=state)
    back = go(stages, straight(0.02, -0.003, 3e-4), state=state)
    assert (back[:, sv.WALL] > 0.0).all()
    assert set(back[:, sv.TISSUE]) == {7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0}


def torso() -> TissueField:
    """Wall, then lung above and liver below it that breathe, then spine."""
    return field_of(
        [
            ("muscle", "", lambda p: -20.0 - p[:, 1]),
            ("lung", "", lambda p: np.minimum(p[:, 1] + 20.0, p[:, 2])),
            ("organ", "liver", lambda p: np.minimum(p[:, 1] + 20.0, -p[:, 2])),
            ("bone", "spine", lambda p: p[:, 1] - 60.0),
        ],
        low=(-20.0, -40.0, -60.0),
        high=(20.0, 80.0, 60.0),
        spacing=2.0,
    )


def test_what_rests_elsewhere_is_looked_up_to_two_tenths_of_a_millimetre() -> None:
    scene = scene_in(torso(), "tissue_field", target=(0.0, 0.01, -0.03))
    memory = stages_in(scene)[1].parameters
    views = walk.labels_of(memory), walk.distances_of(memory)
    rng = np.random.default_rng(4)
    moved = 0
    for _ in range(400):
        point = rng.uniform((-0.018, -0.038, -0.055), (0.018, 0.058, 0.055))
        breath = np.array([0.001, -0.004, -0.015]) * rng.uniform()
        seen = walk.tissue_at(memory, *views, *point, tuple(breath), 0.0)
        code, share = int(seen[0]), seen[6]
        rests = point - share * breath
        if share == 0.0:
            assert point[1] < -0.02 + 1e-6 or point[1] > 0.06 or code == 0
            continue
        moved += 1
        assert code == (2 if rests[2] > 0.0 else 3) or abs(rests[2]) < 1e-4

        if rests[1] > -0.0199 and abs(rests[2]) > 1e-3:
            exact = rests  # what lies here rests where it is carried from to here
            for _ in range(100):
                exact = point - walk.share_at(memory, code, *exact) * breath
            assert np.linalg.norm(exact - rests) < 2e-4
    assert moved > 200


def test_a_nodule_goes_along_with_the_lung_that_it_lies_in() -> None:
    centre = np.array([0.0, 20.0, 30.0])
    nodule = lambda p: 5.0 - np.linalg.norm(p - centre, axis=1)  # noqa: E731
    field = field_of(
        [
            ("muscle", "", lambda p: -20.0 - p[:, 1]),
            ("lung", "", lambda p: np.minimum(p[:, 1] + 20.0, -nodule(p))),
            ("organ", "nodule", nodule),
            ("bone", "spine", lambda p: p[:, 1] - 60.0),
        ],
        low=(-30.0, -40.0, -30.0),
        high=(30.0, 80.0, 60.0),
        spacing=2.0,
    )
    memory = stages_in(scene_in(field, "tissue_field", target=tuple(1e-3 * centre)))[1].parameters
    assert walk.share_at(memory, 3, *(1e-3 * centre)) == pytest.approx(1.0)
    assert walk.share_at(memory, 2, *(1e-3 * centre)) == pytest.approx(1.0, abs=0.02)


def test_what_is_judged_rests_where_the_loop_looks_it_up() -> None:
    scene = scene_in(torso(), "tissue_field", target=(0.0, 0.01, -0.03))
    memory = stages_in(scene)[1].parameters
    views = walk.labels_of(memory), walk.distances_of(memory)
    rng = np.random.default_rng(5)
    points = rng.uniform((-0.018, -0.038, -0.055), (0.018, 0.078, 0.055), (400, 3))
    breaths = np.array([0.001, -0.004, -0.015]) * rng.uniform(size=(400, 1))
    resting = scene.field.at_rest(points, breaths)
    for point, breath, rests in zip(points, breaths, resting, strict=True):
        seen = walk.tissue_at(memory, *views, *point, tuple(breath), 0.0)
        assert np.linalg.norm(point - seen[6] * breath - rests) < 2e-4
    stays = points[:, 1] < -0.021  # the wall
    assert stays.sum() > 20
    assert (resting[stays] == points[stays]).all()
    assert np.linalg.norm(resting - points, axis=1).max() > 0.008


def test_the_wall_stays_the_lung_changes_its_volume_and_the_spine_side_goes_less() -> None:
    scene = scene_in(torso(), "tissue_field", target=(0.0, 0.0, -0.03))
    memory = stages_in(scene)[1].parameters
    share = lambda code, *at: walk.share_at(memory, code, *at)  # noqa: E731
    assert share(1, 0.0, -0.03, 0.0) == 0.0 == share(4, 0.0, 0.07, 0.0)
    assert share(3, 0.0, 0.0, -0.03) == pytest.approx(1.0)  # the target goes along with all of it
    assert share(3, 0.0, 0.05, -0.03) < 0.7 < share(3, 0.0, -0.01, -0.03)
    base, middle, apex = (share(2, 0.0, 0.0, z) for z in (0.001, 0.03, 0.06))
    assert base > 0.9
    assert middle == pytest.approx(0.5, abs=0.05)
    assert apex == pytest.approx(0.0)


def test_tissue_that_breathes_past_a_tip_that_stands_is_told() -> None:
    stages = stages_in(scene_in(torso(), "tissue_field", target=(0.0, 0.0, -0.03)))
    stands = np.tile([0.0, 0.0, 0.004], (200, 1))

    def breathe(k: int, state: FloatArray) -> None:
        state[sv.BREATH] = (0.0, 0.0, 0.01 * np.sin(np.pi * k / 199))

    rows = go(stages, stands, axis=(0.0, 0.0, -1.0), before=breathe)
    assert set(rows[:, sv.TISSUE]) == {2.0, 3.0}  # the liver comes up to the tip, and goes again
    met = rows[rows[:, sv.WALL] < 0.0]
    assert met[:, sv.TISSUE].tolist() == [3.0]  # going away from the tip is the tip's going back
    np.testing.assert_allclose(
        rows[:, sv.CARRIED_Z], rows[:, sv.CARRIED_SHARE] * rows[:, sv.BREATH_Z]
    )


DOWN = (("skin", 2.0), ("organ", 100.0))


@pytest.mark.parametrize("tissue_speed", [-8.0, 3.0, 6.0])
def test_a_wall_that_breathes_along_does_not_hold_up_the_walk(tissue_speed: float) -> None:
    """Tissue goes along the needle [mm/s] that goes in at 10 mm/s: its wall is met once."""
    field = field_of(layered(("organ", 20.0), ("vessel", 100.0)))
    stages = stages_in(scene_in(field, "tissue_field"))

    def breathe(k: int, state: FloatArray) -> None:
        state[sv.BREATH_Z] = -1e-6 * tissue_speed * k

    rows = go(stages, straight(0.01, 0.045, 1e-5), axis=(0.0, 0.0, -1.0), before=breathe)
    codes = rows[:, sv.TISSUE]
    changes = np.flatnonzero(np.diff(codes)) + 1
    assert codes[changes].tolist() == [3.0]
    share = rows[changes[0], sv.CARRIED_SHARE]
    wall = 0.020 + share * 1e-6 * tissue_speed * changes[0]
    assert rows[changes[0], sv.DEPTH] == pytest.approx(wall, abs=6e-5)


def test_what_was_cut_is_a_channel_to_its_end_and_what_lies_beside_is_fresh() -> None:
    stages = stages_in(scene_in(field_of(layered(*DOWN)), "tissue_field"))
    state = sv.empty_state()
    first = go(stages, straight(-0.005, 0.04, 1e-4), state=state)
    assert not first[:, sv.CHANNEL].any()
    go(stages, straight(0.04, -0.005, 1e-3), state=state)
    again = go(stages, straight(-0.005, 0.05, 1e-4), state=state)
    depth, channel = again[:, sv.DEPTH], again[:, sv.CHANNEL] > 0.0
    assert channel[(depth > 1e-4) & (depth < 0.0397)].all()
    assert not channel[(depth < -1e-4) | (depth > 0.0402)].any()
    beside = straight(-0.005, 0.05, 1e-4) + [0.0026, 0.0, 0.0]  # two diameters of 18 G
    go(stages, straight(0.05, -0.005, 1e-3), state=state)
    assert not go(stages, beside, axis=(0.0, 0.0, -1.0), state=state)[:, sv.CHANNEL].any()
    near = straight(-0.005, 0.05, 1e-4) + [0.0011, 0.0, 0.0]
    go(stages, beside[::-1], axis=(0.0, 0.0, -1.0), state=state)
    rows = go(stages, near, axis=(0.0, 0.0, -1.0), state=state)
    assert rows[(rows[:, sv.DEPTH] > 1e-3) & (rows[:, sv.DEPTH] < 0.049), sv.CHANNEL].all()


def test_a_membrane_that_was_only_dimpled_is_not_cut() -> None:
    stages = stages_in(scene_in(field_of(layered(*DOWN)), "tissue_field"))
    state = sv.empty_state()

    def dimple(k: int, state: FloatArray) -> None:
        state[sv.INDENTATION] = max(state[sv.DEPTH], 0.0)

    pushed = straight(-0.002, 0.004, 1e-4)
    go(stages, np.concatenate([pushed, pushed[::-1]]), state=state, before=dimple)
    again = go(stages, pushed, state=state, before=dimple)
    assert not again[again[:, sv.DEPTH] > 0.0, sv.CHANNEL].any()


def test_cuts_are_known_in_the_tissue_s_own_place() -> None:
    stages = stages_in(scene_in(torso(), "tissue_field", target=(0.0, 0.0, -0.03)))
    state = sv.empty_state()
    way = straight(0.01, 0.04, 1e-4)
    go(stages, way, axis=(0.0, 0.0, -1.0), state=state)
    go(stages, way[::-1], axis=(0.0, 0.0, -1.0), state=state)

    def beside(k: int, state: FloatArray) -> None:
        state[sv.BREATH] = (0.006, 0.0, 0.0)

    rows = go(stages, way, axis=(0.0, 0.0, -1.0), state=state, before=beside)
    assert not rows[:, sv.CHANNEL].any()  # the hole has gone 6 mm aside
    go(stages, way[::-1], axis=(0.0, 0.0, -1.0), state=state, before=beside)
    shifted = way + [0.006, 0.0, 0.0]
    rows = go(stages, shifted, axis=(0.0, 0.0, -1.0), state=state, before=beside)
    assert rows[5:-20, sv.CHANNEL].all()


def test_the_memory_of_cuts_is_bounded_and_a_new_attempt_begins_without() -> None:
    stages = stages_in(scene_in(field_of(layered(*DOWN)), "tissue_field"))
    state, size = sv.empty_state(), len(stages[1].parameters)
    for number in range(60):  # 3.0 m of fresh cutting
        offset = [0.004 * (number % 8) - 0.014, 0.004 * (number // 8) - 0.014, 0.0]
        way = straight(-0.001, 0.05, 5e-4) + offset
        rows = go(stages, way, axis=(0.0, 0.0, -1.0), state=state)
        assert not rows[:, sv.CHANNEL].any()
        go(stages, way[::-1], axis=(0.0, 0.0, -1.0), state=state)
    rows = go(stages, way, axis=(0.0, 0.0, -1.0), state=state)
    assert rows[10:-5, sv.CHANNEL].all()
    assert len(stages[1].parameters) == size
    go(stages, way[:1], axis=(0.0, 0.0, -1.0), state=state)

    def arm(k: int, state: FloatArray) -> None:
        state[sv.ENABLED] = 1.0

    rows = go(stages, way, axis=(0.0, 0.0, -1.0), state=state, before=arm)
    assert not rows[:, sv.CHANNEL].any()


def test_no_checkpoint_holds_the_field_or_says_where_it_lies() -> None:
    field = field_of(layered(*DOWN), (-60.0, -60.0, -120.0), (60.0, 60.0, 20.0))  # 4 MB
    stages = stages_in(scene_in(field, "tissue_field", "lateral_tissue"))
    loop = Loop(stages, clock=VirtualClock(1.0))
    loop.open()
    loop.step(3)
    begin = time.perf_counter()
    checkpoint = loop.checkpoint()
    took = time.perf_counter() - begin
    loop.close()
    assert checkpoint.parameters.nbytes < 300_000
    assert took < 5e-3
    addresses = {float(field.labels.ctypes.data), float(field.distance.ctypes.data)}
    assert not addresses & set(checkpoint.parameters.tolist())


def test_the_field_lives_as_long_as_who_looks_into_it() -> None:
    scene = scene_in(field_of(layered(*DOWN)), "tissue_field")
    kept = weakref.ref(scene.field.tissue)
    stages = compile(scene, SIMULATED, [LOOKS]).stages()
    del scene
    gc.collect()
    assert kept() is not None
    assert go(stages, straight(0.001, 0.01, 1e-3))[-1, sv.TISSUE] == 3.0
    del stages
    gc.collect()
    assert kept() is None


def test_every_kind_of_tissue_has_values_and_only_bone_is_rigid() -> None:
    tissues = [FieldTissue(0, TissueKind.UNKNOWN)]
    tissues += [FieldTissue(k, kind, "a name") for k, kind in enumerate(list(TissueKind)[1:], 1)]
    values = tissue_values(tissues)
    assert [v.rigid for v in values] == [t.kind is TissueKind.BONE for t in tissues]
    assert values[0].puncture_force == 0.0
