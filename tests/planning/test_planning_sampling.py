"""Samples of a biopsy gun: what the notch holds, what the throw runs into, where to stop."""

import numpy as np
import pytest

from app.imaging.field import TissueField, TissueKind
from app.planning.errors import PlanError
from app.planning.membrane import membrane_on
from app.planning.sampling import Throw, core, lesion_code, notch_side, plan_sample
from tests.field_rig import ball, beyond, field_of_shapes

LONG, SHORT = Throw(20.0, 14.0, 6.0), Throw(10.0, 6.0, 4.0)
WAY = np.array([0.0, 1.0, 0.0])
CENTRE, RADIUS = (20.0, 40.0, 20.0), 6.0


def patient(*more: tuple[TissueKind, str, object], far: float = 64.0) -> TissueField:
    """Return muscle of 20 mm, an organ behind it up to 64 mm deep, and a round lesion in it."""
    return field_of_shapes(
        [
            (TissueKind.MUSCLE, "", beyond((0.0, 1.0, 0.0), 2.0)),
            (TissueKind.ORGAN, "liver", beyond((0.0, 1.0, 0.0), 20.3)),
            (TissueKind.FAT, "", beyond((0.0, 1.0, 0.0), far)),
            (TissueKind.ORGAN, "lesion", ball(CENTRE, RADIUS)),
            *more,  # type: ignore[list-item]
        ],
        (0.0, 0.0, 0.0),
        (41, 81, 41),
    )


def drawn_core(tip: np.ndarray, way: np.ndarray, side: np.ndarray, throw: Throw) -> np.ndarray:
    """Draw places in the half cylinder of a core, by its definition alone, shape (n, 3)."""
    random = np.random.default_rng(5)
    begin = throw.throw_mm - throw.dead_tip_mm - throw.notch_mm
    along = random.uniform(begin, begin + throw.notch_mm, 40_000)
    square = random.uniform(-throw.radius_mm, throw.radius_mm, (40_000, 2))
    inside = (np.hypot(*square.T) <= throw.radius_mm) & (square[:, 0] >= 0.0)
    across = np.cross(way, side)
    places = tip + along[:, None] * way + square[:, :1] * side + square[:, 1:] * across
    return np.asarray(places[inside])


@pytest.mark.parametrize("turned", [0.0, 90.0, 180.0, 270.0])
@pytest.mark.parametrize("aside", [0.0, 3.0, 5.6, 5.9, 8.0])
def test_lesion_in_a_core_is_what_a_drawn_core_holds_of_the_ball(
    aside: float, turned: float
) -> None:
    field = patient()
    tip = np.array([CENTRE[0] + aside, 33.0, CENTRE[2]])
    taken = core(field, tip, WAY, LONG, CENTRE, turned)
    places = drawn_core(tip, WAY, notch_side(WAY, turned), LONG)
    share = float((np.linalg.norm(places - CENTRE, axis=1) < RADIUS).mean())
    assert taken.lesion_mm == pytest.approx(share * LONG.notch_mm, abs=0.35)
    assert taken.lesion_share == pytest.approx(taken.lesion_mm / LONG.notch_mm)
    assert taken.hits == ()


def test_a_notch_turned_to_the_lesion_brings_more_of_it_than_one_turned_away() -> None:
    field = patient()
    tip = np.array([CENTRE[0] + 5.6, 33.0, CENTRE[2]])
    right, left = (core(field, tip, WAY, LONG, CENTRE, turned) for turned in (90.0, 270.0))
    assert left.lesion_mm > right.lesion_mm + 0.5


def test_the_notch_turns_clockwise_as_seen_from_the_hub() -> None:
    """A needle from the front: 0° is the head, 90° the patient's left; one from the right side: 0°
    is the front.
    """
    assert notch_side(WAY, 0.0) == pytest.approx([0.0, 0.0, 1.0])
    assert notch_side(WAY, 90.0) == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    from_the_right = np.array([1.0, 0.0, 0.0])
    assert notch_side(from_the_right, 0.0) == pytest.approx([0.0, -1.0, 0.0])
    assert notch_side(from_the_right, 90.0) == pytest.approx([0.0, 0.0, -1.0], abs=1e-12)
    random = np.random.default_rng(3)
    for way in random.normal(size=(50, 3)):
        for turned in (0.0, 37.0, 181.0):
            side = notch_side(way, turned)
            assert float(side @ way) == pytest.approx(0.0, abs=1e-9)
            assert np.linalg.norm(side) == pytest.approx(1.0)


@pytest.mark.long("statistics")
def test_no_depth_of_the_outer_needle_holds_more_lesion_than_the_planned_one() -> None:
    field = patient()
    entry = np.array([CENTRE[0] + 1.5, 4.0, CENTRE[2] - 1.0])
    target = np.array(CENTRE)
    way = (target - entry) / np.linalg.norm(target - entry)
    for throw in (LONG, SHORT):
        plan = plan_sample(field, entry, target, throw)
        depths = np.arange(15.0, 45.0, 0.5)
        held = [core(field, entry + d * way, way, throw, target).lesion_mm for d in depths]
        assert plan.lesion_mm == pytest.approx(max(held), abs=0.4)
        there = core(field, entry + plan.stop_mm * way, way, throw, target)
        assert there.lesion_mm == pytest.approx(max(held), abs=0.4)


def test_a_vessel_behind_the_lesion_is_told_for_the_long_throw_and_not_for_the_short_one() -> None:
    vessel = (TissueKind.VESSEL, "hepatic vein", ball((20.0, 52.0, 20.0), 3.0))
    field = patient(vessel)
    tip = (20.0, 34.0, 20.0)
    (hit,) = core(field, tip, WAY, LONG, CENTRE).hits
    assert (hit.name, hit.kind) == ("hepatic vein", TissueKind.VESSEL)
    assert hit.ahead_mm == pytest.approx(15.0, abs=0.2)
    assert hit.length_mm == pytest.approx(5.0, abs=0.2)
    assert core(field, tip, WAY, SHORT, CENTRE).hits == ()
    long, short = (plan_sample(field, (20.0, 4.0, 20.0), CENTRE, one) for one in (LONG, SHORT))
    assert [hit.name for hit in long.hits] == ["hepatic vein"], "warned before the needle goes in"
    assert short.hits == ()
    assert short.lesion_mm == pytest.approx(6.0, abs=0.3)


def test_a_throw_that_leaves_the_organ_is_told_and_a_small_vessel_is_not() -> None:
    small = (TissueKind.VESSEL, "small vessel", ball((20.0, 48.0, 20.0), 1.0))
    field = patient(small, far=50.0)
    (hit,) = core(field, (20.0, 34.0, 20.0), WAY, LONG, CENTRE).hits
    assert hit.leaves
    assert hit.ahead_mm == pytest.approx(16.0, abs=0.2)
    assert "leaves the organ 16.0 mm ahead" in hit.sentence


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ((20.0, 16.0, 6.0), "longer than the throw of 20 mm"),
        ((10.0, 0.0, 4.0), "all must be above 0"),
        ((float("nan"), 6.0, 4.0), "all must be above 0"),
        ((20.0, 14.0, -1.0), "all must be above 0"),
    ],
)
def test_a_throw_that_cannot_be_is_refused_by_name(numbers: tuple[float, ...], words: str) -> None:
    with pytest.raises(PlanError, match=words):
        Throw(*numbers)


def test_where_nobody_marked_a_lesion_no_sample_can_be_judged() -> None:
    field = patient()
    assert field.tissues[lesion_code(field, CENTRE)].name == "lesion"
    for nowhere in ((20.0, -20.0, 20.0), (500.0, 0.0, 0.0)):
        with pytest.raises(PlanError, match="nobody marked a lesion there"):
            lesion_code(field, nowhere)
    with pytest.raises(PlanError, match="no direction"):
        core(field, (20.0, 33.0, 20.0), (0.0, 0.0, 0.0), LONG, CENTRE)


@pytest.mark.parametrize("lean", [0.0, 0.3, 0.7])
def test_the_membrane_lies_where_the_organ_begins(lean: float) -> None:
    field = patient()
    way = np.array([lean, 1.0, 0.0])
    way /= np.linalg.norm(way)
    found = membrane_on(field, np.array([10.0, 4.0, 20.0]), way, CENTRE)
    assert found is not None
    assert not found.is_pleura
    assert found.depth_mm == pytest.approx(16.3 / way[1], abs=0.15)
    assert found.angle_deg == pytest.approx(np.degrees(np.arctan(lean)), abs=2.0)


def test_a_line_past_the_organ_has_no_membrane() -> None:
    assert membrane_on(patient(), (10.0, 4.0, 20.0), (0.0, -1.0, 0.0), CENTRE) is None
