"""What the needle met, as scoring sees it: words, what is forbidden, what counts."""

from types import SimpleNamespace

import pytest

from app.scoring.errors import TrajectoryError
from app.scoring.met import FORBIDDEN, Met, fails
from app.scoring.metrics import pleural_crossings


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
