"""What the needle met, as scoring sees it: words, what is forbidden, what counts."""

from types import SimpleNamespace

import pytest

from app.scoring.errors import MetricNotAskedError, TrajectoryError
from app.scoring.met import FORBIDDEN, Met, fails
from app.scoring.metrics import bone_force, pleural_crossings


def met(kind, name="", entered=12.0, length=3.0, **more):
    return Met(kind, name, entered, length, ((0, 0, 0), (0, length, 0)), **more)


def test_bone_is_touched_at_a_depth_and_the_first_time_is_told():
    twice = (met("bone", "rib", 12.0, 0.0), met("bone", "rib", 14.0, 0.0))
    assert fails(twice, ("bone",)) == ("rib touched at 12.0 mm",)
    assert fails(twice, ("lung",)) == ()
    assert met("bone", "", 12.0, 4.0, sd_mm=0.6).sentence == (
        "bone touched at 12.0 ± 0.6 mm, 4.0 mm crossed"
    )


@pytest.mark.parametrize(
    ("one", "forbidden"),
    [
        (met("lung"), True),
        (met("lung", holds_target=True), False),
        (met("lung", length=0.3), False),
        (met("vessel", "portal vein"), True),
        (met("vessel", "small vessel"), False),
        (met("vessel", "lung vessel"), False),
        (met("vessel", "bone or contrast", confidence=0.3), False),
        (met("bone", "rib", length=0.0), True),
        (met("gut", "colon"), True),
        (met("heart"), True),
        (met("organ", "liver"), False),
        (met("unknown"), False),
    ],
)
def test_what_a_new_exercise_forbids(one, forbidden):
    assert one.is_forbidden(FORBIDDEN) is forbidden


@pytest.mark.parametrize(
    ("parts", "crossings"),
    [
        (
            [
                met("lung", before="fat", after="organ", holds_target=True),
                met("organ", "nodule", holds_target=True),
            ],
            1,
        ),
        ([met("lung", before="fat", after="organ"), met("organ", "liver", holds_target=True)], 2),
        ([met("lung", before="fat", after="")], 1),
        (
            [
                met("lung", "right upper lobe", before="fat", after="lung"),
                met("lung", "right lower lobe", before="lung", after=""),
            ],
            1,
        ),
    ],
)
def test_no_pleura_lies_between_the_lung_and_the_nodule_in_it(parts, crossings):
    assert pleural_crossings.compute(SimpleNamespace(tissues_met=lambda: parts)) == crossings


def test_it_reads_back_what_it_wrote_and_refuses_what_is_no_number():
    one = met("lung", sd_mm=0.2, angle_deg=31.0, time=4.0, before="fat", after="organ")
    assert Met.of(one.document()) == one
    with pytest.raises(TrajectoryError, match="not finite"):
        met("lung", entered=float("nan"))
    with pytest.raises(TrajectoryError, match="no kind of tissue"):
        met("granite")


def test_a_force_is_told_where_one_was_felt_and_absent_is_not_zero():
    felt = met("bone", "rib", 12.0, 0.0, force_n=8.44)
    assert felt.sentence == "rib touched at 12.0 mm, 8.4 N"
    assert fails((felt,), ("bone",)) == ("rib touched at 12.0 mm, 8.4 N",)
    assert Met.of(felt.document()) == felt
    assert met("organ", "liver", force_n=0.0).sentence == "liver at 12.0 mm: 3.0 mm"
    older = {key: value for key, value in met("lung").document().items() if key != "force_n"}
    assert Met.of(older).force_n is None
    assert Met.of(older | {"force_n": None}).force_n is None
    with pytest.raises(TrajectoryError, match="not finite"):
        met("bone", force_n=float("inf"))


def test_the_force_on_bone_is_the_largest_and_no_metric_where_nobody_felt_it():
    felt = (met("bone", "rib", force_n=3.0), met("bone", "rib", force_n=9.0), met("organ", "liver"))
    assert bone_force.compute(SimpleNamespace(tissues_met=lambda: felt)) == 9.0
    for unfelt in ((met("bone", "rib", by="shaft"),), (met("organ", "liver", force_n=4.0),)):
        with pytest.raises(MetricNotAskedError, match="no bone was felt"):
            bone_force.compute(SimpleNamespace(tissues_met=lambda m=unfelt: m))
