"""Why points were lost: against attempts whose needle is led by plain geometry of the patient.

The path leads straight from the front to the back of a patient, 60 mm. The test moves tips in the
patient's own millimetres (left, back, head) and carries them into the robot's frame by axes that
it writes down itself.
"""

import re
from dataclasses import replace

import numpy as np
import pytest

from app.core.arrays import read_only
from app.core.messages import Sentence
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.met import Met
from app.scoring.metrics import available
from app.scoring.risks import RiskMark
from app.scoring.score import score
from app.scoring.tolerance import Tolerance
from app.session.along_path import AlongPath
from app.session.reasons import AttemptEvidence, reasons
from app.session.samples import Samples
from app.session.scored import trajectory

FULCRUM = np.array([0.0, 0.16056, 0.090])
ENTRY_MM, LENGTH_MM = np.array([-12.5, -98.0, 310.2]), 60.0
LEFT, BACK, HEAD = np.eye(3)
WORLD = {  # where left, back and head of the patient point to in the robot's frame
    PatientOrientation.SUPINE: np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], dtype=float),
    PatientOrientation.LEFT_DOWN: np.array([[0, 0, -1], [-1, 0, 0], [0, 1, 0]], dtype=float),
}
BANDS = {
    name: Tolerance.model_validate({"expert": e, "good": g, "pass": p, "weight": 1.0})
    for name, (e, g, p) in {
        "lateral_error": (1.0, 2.0, 4.0),
        "aligning_time": (10.0, 20.0, 40.0),
        "insertion_time": (30.0, 60.0, 90.0),
    }.items()
}


def recorded(time, state, tip_mm, orientation=PatientOrientation.SUPINE, shift_mm=None, felt=None):
    """Samples and plan of a needle through the entry with its tips at places in the patient."""
    plan = Plan(ENTRY_MM, ENTRY_MM + LENGTH_MM * BACK, "")
    placed = PlacedPlan.of(plan, Placement(orientation), FULCRUM)
    n, axes = len(time), WORLD[orientation]
    away = (tip_mm - ENTRY_MM) * 1e-3
    depth = np.copysign(np.linalg.norm(away, axis=1), away[:, 1])
    axis = away / np.where(np.abs(depth) > 1e-9, depth, np.inf)[:, None]
    axis[np.abs(depth) <= 1e-9] = BACK
    shift = np.zeros((n, 3)) if shift_mm is None else shift_mm * 1e-3
    target = FULCRUM + (LENGTH_MM * 1e-3 * BACK + shift) @ axes
    nothing = np.full((n, 3), np.nan)
    return (
        Samples(
            time=read_only(np.asarray(time, dtype=float)),
            state=np.array(state),
            valid=np.ones(n, bool),
            depth_source=np.full(n, "tracked"),
            depth=depth,
            tip=FULCRUM + away @ axes,
            axis=axis @ axes,
            target=target,
            hub=nothing,
            guide=nothing,
            felt=nothing if felt is None else felt,
            measured=np.full(n, np.nan),
        ),
        placed,
    )


def pushed(aside_mm, orientation=PatientOrientation.SUPINE, to_mm=LENGTH_MM, seconds=60.0):
    """Ten seconds before the skin, then an even push; the tip goes aside as a function of depth."""
    before, inside = np.arange(0.0, 10.0, 0.05), np.arange(0.0, seconds, 0.05)
    depths = np.concatenate([np.full(len(before), -15.0), to_mm * (inside + 0.05) / seconds])
    aside = np.array([aside_mm(d) if d > 0.0 else np.zeros(3) for d in depths])
    # along the path the tip is where the depth says, aside it is where the test says
    tips = ENTRY_MM + depths[:, None] * BACK + aside
    state = ["aligning"] * len(before) + ["inserting"] * len(inside)
    return recorded(np.arange(len(depths)) * 0.05 + 7.0, state, tips, orientation)


def ended(samples):
    """Return how far the tip ended beyond the target [mm], along the line from the entry to it."""
    if not len(samples.time):
        return None
    way = samples.target[-1] - FULCRUM
    return 1e3 * float((samples.tip[-1] - samples.target[-1]) @ way) / np.linalg.norm(way)


def evidence(samples, placed, **more):
    more = {"depth_error_mm": ended(samples), **more}
    return AttemptEvidence(AlongPath.of(samples, placed), BANDS, origin=7.0, **more)


def numbers(text):
    return [float(number) for number in re.findall(r"\d+\.?\d*", text)]


@pytest.mark.parametrize("orientation", list(WORLD))
@pytest.mark.parametrize(
    ("towards", "words"),
    [
        (-HEAD, "towards the feet"),
        (HEAD, "towards the head"),
        (LEFT, "to the patient's left"),
        (-LEFT, "to the patient's right"),
        (LEFT - HEAD, "to the patient's left and towards the feet"),
    ],
)
def test_it_is_told_between_which_depths_and_to_which_side_the_line_was_left(
    orientation, towards, words
):
    one = towards / np.linalg.norm(towards)
    samples, placed = pushed(lambda d: 5.0 * one if 20.0 <= d <= 45.0 else 0.0 * one, orientation)
    text = reasons("lateral_error", evidence(samples, placed))[0]
    assert text.startswith("You left the line between ")
    depths = np.hypot([20.0, 45.0], 5.0)  # of the tip, along the needle
    assert numbers(text) == pytest.approx([*depths, 5.0], abs=0.6)
    others = {"feet", "head", "left", "right"} - set(re.findall(r"feet|head|left|right", words))
    assert not others & set(re.findall(r"feet|head|patient's left|right", text.split("depth")[1]))


def test_what_stays_off_to_the_end_is_told_from_where_it_began():
    samples, placed = pushed(lambda d: 0.1 * d * LEFT)  # 2 mm off at 20 mm depth, 6 mm at the end
    text = reasons("lateral_error", evidence(samples, placed))[0]
    assert (
        text == "From 20 mm depth on you were off the line to the patient's left, by up to 6.0 mm."
    )


def test_the_tilt_at_the_skin_is_that_of_the_needle_there_with_its_side():
    angle = np.radians(2.5)
    samples, placed = pushed(lambda d: -np.tan(angle) * d * HEAD)
    (text,) = reasons("angle_at_skin", evidence(samples, placed))
    assert "2.5° off" in text
    assert "towards the feet" in text
    straight = reasons("angle_at_skin", evidence(*pushed(lambda _: 0.0 * HEAD)))
    assert straight == ("At the skin the needle was in line: 0.0° off.",)


def steered(at_skin_deg, end_mm, orientation=PatientOrientation.SUPINE):
    """A needle that turns about the entry: tilts at the skin [°], left and head, then steered so
    that it ends beside the target [mm].
    """
    depths = np.linspace(0.2, 60.0, 1200)
    slope = np.tan(np.radians(at_skin_deg))
    share = np.clip((depths - 15.0) / 45.0, 0.0, 1.0)[:, None]  # straight in, then turned
    aside = depths[:, None] * ((1.0 - share) * slope + share * np.array(end_mm) / 60.0)
    tips = ENTRY_MM + depths[:, None] * BACK + aside[:, :1] * LEFT + aside[:, 1:] * HEAD
    before = ENTRY_MM + np.linspace(-15.0, -0.2, 200)[:, None] * (
        BACK + slope[0] * LEFT + slope[1] * HEAD
    )
    tips = np.concatenate([before, tips])
    state = ["aligning"] * 200 + ["inserting"] * 1200
    return recorded(7.0 + 0.05 * np.arange(1400), state, tips, orientation)


@pytest.mark.parametrize("orientation", list(WORLD))
@pytest.mark.parametrize(
    ("left_deg", "head_deg", "words"),
    [
        (2.1, 0.0, "to the patient's left"),
        (-2.1, 0.0, "to the patient's right"),
        (0.0, -2.1, "towards the feet"),
        (1.485, 1.485, "and"),  # 2.1° in all
    ],
)
def test_the_tip_pointed_to_the_side_on_which_it_then_was(orientation, left_deg, head_deg, words):
    needle = steered((left_deg, head_deg), (1.0, 3.0), orientation)
    (text,) = reasons("angle_at_skin", evidence(*needle))
    assert "2.1° off" in text
    assert words in text
    assert ("left" in text) == (left_deg > 0.0)
    assert ("head" in text) == (head_deg > 0.0)


def test_a_tilt_at_the_skin_is_no_reason_for_an_end_on_another_side():
    def skin(needle, metric="lateral_error"):
        return [text for text in reasons(metric, evidence(*needle)) if "skin" in text]

    assert not skin(steered((2.1, 0.0), (1.0, 3.0)))  # to the left, but ended towards the head
    assert not skin(steered((2.1, 0.0), (-3.0, 0.0)))
    assert skin(steered((2.1, 0.0), (3.0, 1.0)))
    assert skin(steered((2.1, 0.0), (-3.0, 0.0)), "path_ratio")  # it cost way all the same


def test_nothing_is_told_of_a_skin_that_was_passed_while_nobody_saw_the_needle():
    samples, placed = steered((2.1, 0.0), (3.0, 0.0))
    depth = samples.depth * 1e3

    def skin(**changes):
        return reasons("angle_at_skin", evidence(replace(samples, **changes), placed))

    assert skin()
    # first seen 4 mm deep, 4 s after the skin
    assert not skin(depth_source=np.where((depth > 0) & (depth < 4), "model", "tracked"))
    assert skin(depth_source=np.where((depth > 0) & (depth < 0.4), "model", "tracked"))
    # pushed in while the attempt waited
    waited = np.where((depth > -1) & (depth < 3), "paused", samples.state)
    assert not skin(state=waited)


def test_short_of_the_target_and_beyond_it_are_told_with_the_moment():
    # 48 mm in 60 s after 10 s outside, then nothing more
    samples, placed = pushed(lambda _: 0.0 * HEAD, to_mm=48.0)
    (text,) = reasons("depth_error", evidence(samples, placed))
    assert text.startswith(
        "The tip stopped 12.0 mm short of the target; it came no deeper after 1:"
    )
    # 66 mm in 60 s: past 60 mm at 60/66 of 60 s after the 10 s outside
    samples, placed = pushed(lambda _: 0.0 * HEAD, to_mm=66.0)
    (text,) = reasons("depth_error", evidence(samples, placed))
    clock = 10.0 + 60.0 * 60.0 / 66.0
    assert text == (
        f"The tip ended 6.0 mm too deep: it passed the target's depth at 1:{int(clock - 60):02d}."
    )


def test_a_target_that_was_passed_and_left_again_is_told_as_that():
    depths = np.concatenate([np.linspace(0.5, 67.0, 600), np.linspace(67.0, 57.0, 100)])
    tips = ENTRY_MM + depths[:, None] * BACK
    samples, placed = recorded(7.0 + 0.1 * np.arange(700), ["inserting"] * 700, tips)
    (text,) = reasons("depth_error", evidence(samples, placed))
    assert text == (
        "The tip was 7.0 mm too deep at 0:59, then drawn back to 3.0 mm short of the target."
    )


def straight(depths_mm, states, blind=None, step=0.05):
    """Needle along the path, in states; `blind` says where no camera saw it."""
    depths = np.asarray(depths_mm, dtype=float)
    samples, placed = recorded(
        7.0 + step * np.arange(len(depths)), list(states), ENTRY_MM + depths[:, None] * BACK
    )
    if blind is None:
        return samples, placed
    return replace(samples, depth_source=np.where(blind, "model", "tracked")), placed


def test_a_needle_that_was_pushed_on_while_the_attempt_waited_ended_where_it_was_seen_last():
    # seen to 12 mm within 25 s, then lost; the attempt waits; pushed on to 51 mm, and seen there
    depths = np.concatenate([np.linspace(0.5, 12.0, 500), np.linspace(12.0, 51.0, 500)])
    blind = (np.arange(1000) >= 500) & (np.arange(1000) < 960)
    states = ["inserting"] * 540 + ["paused"] * 460
    (text,) = reasons("depth_error", evidence(*straight(depths, states, blind)))
    assert text.startswith(
        "The tip stopped 9.0 mm short of the target; it came no deeper after 0:4"
    )
    # where nobody saw it after 12 mm there is nothing to tell, whatever the score knows
    lost = np.arange(1000) >= 500
    assert reasons("depth_error", evidence(*straight(depths, states, lost))) == ()
    assert reasons("depth_error", evidence(*straight(depths, states), depth_error_mm=None)) == ()


def test_what_came_to_pass_while_nobody_looked_has_no_moment():
    depths = np.linspace(0.5, 66.0, 1000)
    blind = (depths > 55.0) & (depths < 64.0)
    (text,) = reasons("depth_error", evidence(*straight(depths, ["inserting"] * 1000, blind)))
    assert text == "The tip ended 6.0 mm too deep."
    depths = np.concatenate([np.linspace(0.5, 48.0, 500), np.full(500, 48.0)])
    blind = (np.arange(1000) > 600) & (np.arange(1000) < 800)
    (text,) = reasons("depth_error", evidence(*straight(depths, ["inserting"] * 1000, blind)))
    assert text == "The tip ended 12.0 mm short of the target."


@pytest.mark.long("machine")
def test_no_reason_on_depth_differs_from_the_scores_own_depth_error():
    """Two hundred needles pushed at random, lost and waited for at random."""
    told = 0
    for seed in range(200):
        random = np.random.default_rng(seed)
        places = np.concatenate([[0.5], random.uniform(10.0, 75.0, 4)])
        depths = np.interp(np.arange(600), np.linspace(0, 599, 5), places)
        blind, states = np.zeros(600, bool), np.full(600, "inserting", dtype="<U9")
        for flags in (blind, blind, states, states):
            begin = int(random.integers(20, 600))
            until = begin + int(random.integers(5, 150))
            flags[begin:until] = True if flags is blind else "paused"
        samples, placed = straight(depths, states, blind)
        row = next(
            row for row in score(trajectory(samples, placed)).rows if row.name == "depth_error"
        )
        past = evidence(samples, placed, depth_error_mm=row.value, depth_sd_mm=row.sd or 0.0)
        for text in reasons("depth_error", past):
            told += 1
            seen = float(depths[~blind][-1]) - 60.0  # the tip where it was seen last
            size = numbers(text)[-1 if "drawn back" in text else 0]
            assert size == pytest.approx(abs(seen), abs=0.051)
            assert ("ended" in text and "too deep" in text) == (seen > 0.0)
            assert row.value == pytest.approx(seen, abs=max(0.05, row.sd or 0.0))
    assert told > 100


def test_a_depth_error_that_is_not_where_the_needle_was_seen_last_has_no_reason():
    samples, placed = pushed(lambda _: 0.0 * HEAD, to_mm=48.0)
    for error, sd in ((-11.5, 0.4), (-12.6, 0.5), (5.0, 1.0)):
        past = evidence(samples, placed, depth_error_mm=error, depth_sd_mm=sd)
        assert reasons("depth_error", past) == ()
    near = evidence(samples, placed, depth_error_mm=-12.3, depth_sd_mm=0.5)
    assert "12.3 mm short" in reasons("depth_error", near)[0]


def test_the_stage_is_the_longest_against_its_band_not_the_longest():
    # aligning 10 s of 20 s that are good, inserting 120 s of 60 s
    samples, placed = pushed(lambda _: 0.0 * HEAD, seconds=120.0)
    (text,) = reasons("total_time", evidence(samples, placed))
    assert text == ("Inserting took longest against its band: 120 s, of which 60 s are good.")
    without = replace(evidence(samples, placed), tolerances={})
    assert reasons("total_time", without) == ("Inserting took longest: 120 of 130 s.",)


def test_a_push_while_the_breath_had_moved_the_target_is_told_with_its_share():
    time = np.arange(0.0, 60.0, 0.05)
    tips = ENTRY_MM + np.linspace(0.0, 60.0, len(time))[:, None] * BACK
    shift = np.where((time >= 30.0)[:, None], 8.0 * HEAD, 0.5 * HEAD)  # the second half: 30 mm
    samples, placed = recorded(time + 7.0, ["inserting"] * len(time), tips, shift_mm=shift)
    (text,) = reasons("breath_offset", evidence(samples, placed, gate_mm=2.0))
    assert text == (
        "You pushed 30 of 60 mm while the breath had moved the target by more than 2.0 mm."
    )
    assert text in reasons("lateral_error", evidence(samples, placed, gate_mm=2.0))
    assert not reasons("breath_offset", evidence(samples, placed, gate_mm=9.0))


def test_the_largest_force_is_told_where_and_when_it_was():
    time = np.arange(0.0, 40.0, 0.1)
    felt = np.zeros((len(time), 3))
    felt[300] = [0.0, 3.0, 4.0]  # at 30 s: 5 N
    tips = ENTRY_MM + time[:, None] * BACK  # a millimetre a second
    samples, placed = recorded(time + 7.0, ["inserting"] * len(time), tips, felt=felt)
    (text,) = reasons("peak_force", evidence(samples, placed))
    assert text == "The force was largest at 30 mm depth, at 0:30: 5.0 N."
    blind = replace(samples, depth_source=np.full(len(time), "model"))
    (text,) = reasons("peak_force", evidence(blind, placed))
    assert text == "The force was largest at 0:30: 5.0 N."


def test_what_was_met_and_what_came_near_are_told_with_place_and_moment():
    samples, placed = pushed(lambda _: 0.0 * HEAD)
    rib = Met("bone", "rib", 12.0, 0.0, ((0.0, 0.0, 0.0),) * 2, time=7.0 + 75.0)
    past = evidence(
        samples, placed, met=(rib,), risks=(RiskMark("aorta", 5.0, 2.5, 7.0 + 42.0, 33.0),)
    )
    assert reasons("bone_contacts", past) == ("rib touched at 12.0 mm, at 1:15.",)
    assert reasons("lung_crossed", past) == ()
    (text,) = reasons("risk_distance", past)
    assert "2.5 mm of aorta at 0:42" in text
    assert "33 mm depth" in text


def test_scans_are_told_by_where_the_needle_was():
    samples, placed = pushed(lambda _: 0.0 * HEAD)
    (text,) = reasons("control_scans", evidence(samples, placed, scans=(8.0, 9.0, 40.0)))
    assert text == "2 of 3 control scans were taken before the needle was in the skin."


# --- what the record does not hold is not stated ----------------------------------------------


def everything(past):
    return [text for name in available() for text in reasons(name, past)]


def hard_cases():
    samples, placed = pushed(lambda d: 0.2 * d * LEFT)
    n = len(samples.time)
    no = np.zeros(n, bool)
    nan3, nan = np.full((n, 3), np.nan), np.full(n, np.nan)
    yield "nothing measured", replace(samples, valid=no), placed
    yield "by the model alone", replace(samples, depth_source=np.full(n, "model")), placed
    yield "no numbers", replace(samples, tip=nan3, depth=nan, axis=nan3, target=nan3), placed
    yield "never in the skin", replace(samples, state=np.full(n, "aligning")), placed
    yield "only prepared", replace(samples, state=np.full(n, "withdrawing")), placed
    cut = {
        name: getattr(samples, name)[:0]
        for name in Samples.__dataclass_fields__
        if getattr(samples, name) is not None
    }
    yield "no samples", Samples(**cut), placed


@pytest.mark.parametrize("case", list(hard_cases()), ids=lambda case: case[0])
@pytest.mark.filterwarnings("error")
def test_nothing_is_told_of_line_depth_or_skin_that_nobody_measured(case):
    _, samples, placed = case
    texts = everything(evidence(samples, placed))
    assert not [text for text in texts if "mm" in text or "°" in text]
    assert not [text for text in texts if "nan" in text.lower() or "inf" in text]


def test_a_gap_in_what_was_measured_is_no_stretch():
    samples, placed = pushed(lambda d: 5.0 * LEFT if d >= 20.0 else 0.0 * LEFT)
    between = (samples.depth > 0.025) & (samples.depth < 0.040)
    blind = replace(samples, depth_source=np.where(between, "model", samples.depth_source))
    text = reasons("lateral_error", evidence(blind, placed))[0]
    depths = numbers(text)[:1] if text.startswith("From") else numbers(text)[:2]
    assert all(depth <= 25.5 or depth >= 39.5 for depth in depths)
    assert not (text.startswith("You left") and depths[0] < 26.0 and depths[1] > 39.0)


def test_a_needle_first_seen_deep_tells_nothing_of_the_skin():
    samples, placed = pushed(lambda d: 0.2 * d * LEFT)
    late = replace(
        samples, depth_source=np.where(samples.depth < 0.03, "model", samples.depth_source)
    )
    assert not [text for text in reasons("lateral_error", evidence(late, placed)) if "skin" in text]


def test_every_depth_and_distance_that_is_told_was_measured_at_some_sample():
    """Fifty needles that wander at random: whatever is stated lies within what was recorded."""
    for seed in range(50):
        random = np.random.default_rng(seed)
        sway = np.cumsum(random.normal(0.0, 0.4, (80, 3)), axis=0)
        samples, placed = pushed(lambda d, sway=sway: sway[int(d)] * [1.0, 0.0, 1.0])
        seen = random.random(len(samples.time)) > 0.3
        holes = replace(samples, depth_source=np.where(seen, samples.depth_source, "model"))
        for text in reasons("lateral_error", evidence(holes, placed)):
            assert isinstance(text, Sentence)
            if "line" not in text:
                continue
            inside = seen & (samples.depth > 0.0)
            deep = samples.depth[inside] * 1e3
            tips = (samples.tip[inside] - FULCRUM) @ WORLD[PatientOrientation.SUPINE].T * 1e3
            off = np.hypot(tips[:, 0], tips[:, 2])
            *depths, most = numbers(text)
            assert np.abs(off - most).min() < 0.06
            for depth in depths:
                assert np.abs(deep - depth).min() < 1.0


# --- stays in the body, and what counts ---------------------------------------------------------


def test_only_the_last_stay_in_the_body_is_looked_at():
    states = ["aligning"] * 5 + ["inserting"] * 20 + ["aligning"] * 5 + ["inserting"] * 30
    depths = [*[-10.0] * 5, *np.linspace(1.0, 40.0, 20), *[-10.0] * 5, *np.linspace(1.0, 50.0, 30)]
    samples, placed = straight(depths, states)
    assert AlongPath.of(samples, placed).stay().tolist() == list(range(30, 60))


@pytest.mark.parametrize(("first_mm", "seen"), [(8.0, True), (20.0, False)])
def test_a_stay_whose_first_depth_is_deep_tells_nothing_of_the_skin(first_mm, seen):
    depths = [*[-10.0] * 5, *np.linspace(first_mm, 50.0, 30)]
    way = AlongPath.of(*straight(depths, ["aligning"] * 5 + ["inserting"] * 30))
    assert (way.at_skin() is not None) == seen


def test_of_several_structures_the_one_that_came_nearest_to_its_limit_is_told():
    near, far = RiskMark("vein", 5.0, 1.0, 20.0, 30.0), RiskMark("aorta", 5.0, 4.0, 30.0, 40.0)
    past = evidence(*pushed(lambda _: 0.0 * HEAD), risks=(far, near))
    assert "1.0 mm of vein" in reasons("risk_distance", past)[0]


def test_tissue_that_is_too_short_or_unsure_to_count_is_not_told():
    at = ((0.0, 0.0, 0.0),) * 2
    short = Met("vessel", "vein", 12.0, 0.01, at, time=20.0)
    unsure = Met("vessel", "artery", 14.0, 6.0, at, time=21.0, confidence=0.01)
    sure = Met("vessel", "portal vein", 16.0, 6.0, at, time=22.0)
    past = evidence(*pushed(lambda _: 0.0 * HEAD), met=(short, unsure, sure))
    (text,) = reasons("vessels_touched", past)
    assert "portal vein" in text


@pytest.mark.parametrize("state", ["withdrawing", "paused", "ended"])
def test_a_force_while_the_attempt_does_not_run_is_not_told(state):
    felt = np.zeros((100, 3))
    felt[50], felt[80] = [0.0, 0.0, 2.0], [0.0, 0.0, 9.0]
    states = ["inserting"] * 70 + [state] * 30
    tips = ENTRY_MM + np.linspace(0.5, 60.0, 100)[:, None] * BACK
    past = evidence(*recorded(7.0 + 0.1 * np.arange(100), states, tips, felt=felt))
    assert reasons("peak_force", past)[0].endswith("at 0:05: 2.0 N.")


def test_what_the_cameras_cannot_tell_apart_from_the_line_has_not_left_it():
    needle = pushed(lambda d: 4.0 * LEFT if d > 20.0 else 0.0 * LEFT)  # 2 mm are good
    assert "off the line" in reasons("lateral_error", evidence(*needle))[0]
    unsure = reasons("lateral_error", evidence(*needle, unsure_mm=6.0))
    assert not [text for text in unsure if "off the line" in text]
