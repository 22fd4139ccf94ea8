from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scoring_attempts import Attempt, placed_plan

from app.planning.judged import JudgedPlan
from app.planning.lung_path.values import LungCrossing, LungPathReport
from app.planning.placement import PatientOrientation, Placement
from app.scoring import metrics
from app.scoring.ablation import AblationMark
from app.scoring.complications.answers import Kind
from app.scoring.complications.marks import ComplicationMarks, Demand
from app.scoring.errors import MetricUnavailableError, UnknownMetricError
from app.scoring.met import Met
from app.scoring.paths import raw_length, smooth_length
from app.scoring.procedure import Deposit, ProcedureMarks, SampleMark, TurningMark
from app.scoring.risks import RiskMark
from app.scoring.scans import ScanMark
from app.scoring.score import score
from app.scoring.touches import Touches
from app.scoring.trajectory import Phase, Trajectory

DEGREE = np.pi / 180.0
NAMES = sorted(metrics.available())


def value(name: str, trajectory: Trajectory) -> float:
    return metrics.find(name).compute(trajectory)


def test_every_file_in_the_folder_is_a_metric() -> None:
    expected = {"target_error", "lateral_error", "depth_error", "angle_error", "path_length"}
    assert expected <= set(NAMES)
    for metric in metrics.available().values():
        assert metric.title
        assert metric.definition


def test_an_unknown_metric_is_refused_with_the_names_that_exist() -> None:
    with pytest.raises(
        UnknownMetricError, match=r"no metric 'depht_error'; there are .*depth_error"
    ):
        metrics.find("depht_error")


def test_a_file_that_is_no_metric_cannot_be_used_and_says_why(
    tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "extra"  # type: ignore[operator]
    folder.mkdir()
    (folder / "half_a_metric.py").write_text("x = 1\n")
    monkeypatch.setattr(metrics, "__path__", [*metrics.__path__, str(folder)])
    fault = metrics.available()["half_a_metric"].fault
    assert "half_a_metric.py has no DECLARATION" in fault


LUNG = Met("lung", "", 20.0, 15.0, ((0, 0, 0), (0, 15, 0)), 0.3, 12.0, 1.0, before="muscle")
RIB = Met("bone", "rib", 12.0, 0.0, ((0, 0, 0), (0, 0, 0)), force_n=6.0)


REPORT = LungPathReport(
    entry_mm=(0.0, 0.0, 0.0),
    target_mm=(0.0, 60.0, 0.0),
    length_mm=60.0,
    unknown_mm=0.0,
    pleura=(LungCrossing(20.0, 12.0, (0.0, 20.0, 0.0)),),
    fissures=(),
    lung_mm=35.0,
    emphysema_mm=0.0,
    rib_below_mm=6.0,
    rib_above_mm=5.0,
    rib_below_at=None,
    rib_above_at=None,
    intercostal_mm=4.0,
    spine_mm=90.0,
    is_protected=True,
    vessels=(),
    bronchi=(),
)
STEPS = ProcedureMarks(
    deposits=(Deposit(1.0, 18.0, 2.0),),
    samples=(SampleMark(2.0, 6.0, True),),
    open_s=4.0,
    complications=ComplicationMarks(
        begun=((Kind.PNEUMOTHORAX, 1.0),),
        demands=(Demand(Kind.PNEUMOTHORAX, "small", 1, 1.0),),
        noticed=(3.0,),
        until=100.0,
    ),
    ablation=AblationMark(4.0, 6.0, 0.98),
    entry_error_mm=2.0,
    checked=0.5,
    turning=TurningMark(out=5.0, turned=9.0),
)


@pytest.mark.parametrize("name", NAMES)
def test_every_metric_is_finite_on_a_plain_attempt(name: str) -> None:
    base = Attempt(noise=1e-4, force=1.0).trajectory()
    facts = {
        "guide": base.felt,
        "target_shift": np.full_like(base.tip, 1e-3),
        "risks": (RiskMark("vessel", 3.0, 2.0, inside_s=0.0),),
        "clamped": np.zeros(len(base), dtype=bool),
        "touches": Touches(2, (float(base.time[-1]),)),
        "met": (RIB, LUNG),
        "planned": JudgedPlan(60.0, 80.0, 12.0, 5.0, "rib", 9.0, lung=REPORT),
        "scans": (ScanMark(float(base.time[5]), 10.0, 2.5),),
        "procedure": STEPS,
    }
    trajectory = Attempt(noise=1e-4, force=1.0).trajectory(**facts)
    assert np.isfinite(value(name, trajectory))


@pytest.mark.parametrize(
    "name", ["target_error", "planned_target_error", "lateral_error", "depth_error", "angle_error"]
)
def test_a_perfect_attempt_has_no_error(name: str) -> None:
    assert value(name, Attempt().trajectory()) == pytest.approx(0.0, abs=1e-9)


mm = st.floats(-30.0, 30.0)
angles = st.tuples(*[st.floats(-180.0, 180.0)] * 3)


@settings(derandomize=True, deadline=None, max_examples=40)
@given(mm, mm, st.sampled_from(list(PatientOrientation)), angles)
def test_lateral_and_depth_error_are_the_two_legs_of_the_target_error(
    lateral: float,
    depth: float,
    orientation: PatientOrientation,
    angle: tuple[float, float, float],
) -> None:
    placed = placed_plan(placement=Placement(orientation, angle))
    attempt = Attempt(lateral=lateral * 1e-3, depth=depth * 1e-3, rate=5.0)
    trajectory = attempt.trajectory(placed=placed)
    assert value("lateral_error", trajectory) == pytest.approx(abs(lateral), abs=1e-9)
    assert value("depth_error", trajectory) == pytest.approx(depth, abs=1e-9)
    assert value("target_error", trajectory) == pytest.approx(np.hypot(lateral, depth), abs=1e-9)


def test_the_depth_error_is_positive_beyond_the_target() -> None:
    assert value("depth_error", Attempt(depth=0.004).trajectory()) == pytest.approx(4.0)
    assert value("depth_error", Attempt(depth=-0.004).trajectory()) == pytest.approx(-4.0)


def test_a_moving_target_counts_where_it_is_at_the_end() -> None:
    base = Attempt().trajectory()
    shift = np.zeros((len(base), 3))
    shift[-1] = 0.006 * base.placed.axis
    moved = Attempt().trajectory(target_shift=shift)
    assert value("target_error", moved) == pytest.approx(6.0)
    assert value("depth_error", moved) == pytest.approx(-6.0)
    assert value("lateral_error", moved) == pytest.approx(0.0, abs=1e-9)
    assert value("planned_target_error", moved) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("tilt", [0.0, 1e-9, 1.0, 45.0, 90.0, 180.0])
def test_the_angle_error_is_exact_at_every_size(tilt: float) -> None:
    measured = value("angle_error", Attempt(tilt=tilt * DEGREE).trajectory())
    assert measured == pytest.approx(tilt, rel=1e-9, abs=1e-12)


def test_times_are_told_apart_by_phase() -> None:
    trajectory = Attempt(aligning=8.0, inserting=12.0, holding=4.0).trajectory()
    assert value("total_time", trajectory) == pytest.approx(24.0)
    assert value("aligning_time", trajectory) == pytest.approx(8.0)
    assert value("insertion_time", trajectory) == pytest.approx(16.0)
    assert value("holding_time", trajectory) == pytest.approx(4.0)


def test_a_straight_insertion_has_its_own_length_and_ratio_one() -> None:
    trajectory = Attempt(holding=0.02).trajectory()
    length = trajectory.placed.length * 1e3
    assert value("path_length", trajectory) == pytest.approx(length, rel=1e-3)
    assert value("path_length_raw", trajectory) == pytest.approx(length, rel=1e-3)
    assert value("path_ratio", trajectory) == pytest.approx(1.0, abs=1e-9)


def test_noise_inflates_the_raw_path_far_more_than_the_filtered_one() -> None:
    quiet, noisy = Attempt().trajectory(), Attempt(noise=1.5e-4).trajectory()
    truth = value("path_length", quiet)
    assert value("path_length_raw", noisy) > 3.0 * truth
    assert value("path_length", noisy) < 1.05 * truth


def test_a_detour_makes_the_path_longer() -> None:
    ratios = [value("path_ratio", Attempt(detour=d).trajectory()) for d in (0.0, 0.02, 0.04)]
    assert ratios[0] == pytest.approx(1.0, abs=1e-6)
    assert ratios[0] < ratios[1] < ratios[2]


def test_a_second_insertion_adds_to_the_path_and_not_to_the_gap_between() -> None:
    base = Attempt().trajectory()
    phase = np.array(base.phase)
    middle = int(np.searchsorted(base.time, 30.0))
    phase[middle : middle + 25] = Phase.ALIGNING
    cut = Attempt().trajectory(phase=phase)
    missing = np.linalg.norm(base.tip[middle + 25] - base.tip[middle - 1]) * 1e3
    raw = value("path_length_raw", base) - value("path_length_raw", cut)
    assert raw == pytest.approx(missing, rel=1e-9)


def test_the_smoothed_length_keeps_a_straight_path_at_any_sampling() -> None:
    rng = np.random.default_rng(3)
    time = np.sort(rng.uniform(0.0, 10.0, 400))
    points = np.outer(np.sort(rng.uniform(0.0, 0.1, 400)), [0.6, 0.0, 0.8])
    straight = np.linalg.norm(points[-1] - points[0])
    assert smooth_length(time, points) == pytest.approx(straight, rel=1e-12)
    assert raw_length(points) == pytest.approx(straight, rel=1e-12)


def test_mean_and_peak_force_are_those_of_the_whole_attempt() -> None:
    base = Attempt(aligning=10.0, inserting=10.0, holding=0.02).trajectory()
    felt = np.zeros((len(base), 3))
    felt[:, 0] = np.where(base.time < 10.0, 5.0, 0.1 * (base.time - 10.0))  # a ramp from 0 to 1 N
    trajectory = Attempt(aligning=10.0, inserting=10.0, holding=0.02).trajectory(felt=felt)
    assert value("peak_force", trajectory) == pytest.approx(5.0, abs=0.01)
    assert value("mean_force", trajectory) == pytest.approx(2.75, abs=0.02)


def test_a_force_felt_where_nobody_knew_the_depth_counts() -> None:
    base = Attempt(aligning=10.0, inserting=10.0, holding=0.02).trajectory()
    lost = (base.time > 12.0) & (base.time < 13.0)
    phase = np.where(lost, Phase.PAUSED, base.phase)
    felt = np.where(lost[:, None], (0.0, 0.0, 4.0), 0.0)
    trajectory = replace(base, felt=felt, phase=phase, depth_valid=~lost)
    assert value("peak_force", trajectory) == 4.0
    assert value("mean_force", trajectory) == pytest.approx(0.2, abs=0.01)


def test_the_mean_force_does_not_depend_on_the_sampling() -> None:
    base = Attempt().trajectory()
    inside = np.flatnonzero(base.inserted)
    keep = np.concatenate([np.flatnonzero(~base.inserted), inside[:500], inside[500::10]])
    felt = np.zeros((len(base), 3))
    felt[:, 1] = np.clip(base.time - 20.0, 0.0, None) * 0.1
    full = Attempt().trajectory(felt=felt)
    names = ("time", "tip", "axis", "depth", "felt", "phase", "depth_valid", "hub")
    thin = Attempt().trajectory(**{name: getattr(full, name)[keep] for name in names})
    assert value("mean_force", thin) == pytest.approx(value("mean_force", full), rel=1e-3)


def test_the_guidance_work_of_a_spring_is_the_energy_it_gave() -> None:
    """F = -K x along a path from x = 20 mm to 5 mm gives K/2 (x0² - x1²), whatever the speed."""
    base = Attempt().trajectory()
    share = np.clip((base.time - 20.0) / 20.0, 0.0, 1.0) ** 2
    x = 0.020 - 0.015 * share
    hub = np.zeros((len(base), 3))
    hub[:, 0] = x
    guide = -400.0 * hub
    trajectory = Attempt().trajectory(hub=hub, guide=guide)
    work = 0.5 * 400.0 * (0.020**2 - 0.005**2) * 1e3
    assert value("guidance_work", trajectory) == pytest.approx(work, rel=1e-6)


def test_a_closed_detour_against_a_spring_costs_no_work() -> None:
    base = Attempt().trajectory()
    hub = np.zeros((len(base), 3))
    hub[:, 0] = 0.01 * np.sin(2.0 * np.pi * np.clip((base.time - 20.0) / 20.0, 0.0, 1.0))
    trajectory = Attempt().trajectory(hub=hub, guide=-400.0 * hub)
    assert value("guidance_work", trajectory) == pytest.approx(0.0, abs=1e-9)


def test_guidance_that_was_not_recorded_gives_no_work_instead_of_zero() -> None:
    with pytest.raises(MetricUnavailableError, match="not recorded"):
        value("guidance_work", Attempt().trajectory())


def test_the_tracked_share_is_one_of_time_in_the_body() -> None:
    base = Attempt(aligning=10.0, inserting=10.0, holding=10.0).trajectory()
    valid = (base.time < 10.0) | (base.time >= 15.0)
    trajectory = Attempt(aligning=10.0, inserting=10.0, holding=10.0).trajectory(depth_valid=valid)
    assert value("tracking_valid", trajectory) == pytest.approx(75.0, abs=0.2)


def test_no_inserted_needle_means_no_accuracy() -> None:
    phase = np.full(2251, "aligning")
    trajectory = Attempt().trajectory(phase=phase)
    for name in ("target_error", "path_length", "peak_force", "tracking_valid", "mean_force"):
        with pytest.raises(MetricUnavailableError, match="never inserted"):
            value(name, trajectory)
    assert value("total_time", trajectory) > 0.0


def test_a_tip_that_ends_where_it_entered_has_no_path_ratio() -> None:
    base = Attempt().trajectory()
    tip = np.tile(base.placed.p_entry, (len(base), 1))
    with pytest.raises(MetricUnavailableError, match=r"ended 0\.00 mm from where it entered"):
        value("path_ratio", Attempt().trajectory(tip=tip))


@pytest.mark.parametrize("name", ["path_length", "path_length_raw", "path_ratio"])
def test_a_guessed_tip_between_two_measured_ones_does_not_lengthen_the_path(name: str) -> None:
    plain = Attempt().trajectory()
    blind = np.zeros(len(plain.time), dtype=bool)
    inside = np.flatnonzero(plain.inserted)
    blind[inside[len(inside) // 3 : len(inside) // 2]] = True
    tip = np.where(blind[:, None], plain.tip + 0.08 * plain.axis, plain.tip)
    guessed = Attempt().trajectory(tip=tip, depth_valid=~blind)
    assert value(name, guessed) == pytest.approx(value(name, plain), rel=0.02)


def test_a_depth_that_was_never_measured_has_no_path() -> None:
    plain = Attempt().trajectory()
    unseen = Attempt().trajectory(depth_valid=np.zeros(len(plain.time), dtype=bool))
    with pytest.raises(MetricUnavailableError, match="not measured"):
        value("path_length", unseen)


@pytest.mark.parametrize("name", ["mean_force", "peak_force", "guidance_work"])
def test_without_a_robot_there_is_no_figure_of_force(name: str) -> None:
    base = Attempt().trajectory()
    pen = replace(base, felt=None, guide=np.zeros((len(base), 3)))
    with pytest.raises(MetricUnavailableError, match="no robot"):
        value(name, pen)


def hidden_entry(begin, end, before=0.0):
    """An attempt whose needle nobody sees from `begin` to `end` [s]; it enters at 20 s, 40 s long.

    Out of sight it is taken for aligning, at the depth at which it was seen last.
    """
    base = Attempt(aligning=20.0, inserting=40.0, holding=0.0).trajectory()
    time = np.asarray(base.time)
    seen, out = (time < begin) | (time >= end), time < 20.0
    depth = np.where(out, before, base.depth)
    last = np.maximum.accumulate(np.where(seen, np.arange(len(time)), 0))
    phase = np.where(out | ~seen, Phase.ALIGNING, base.phase)
    return replace(base, depth=depth[last], phase=phase, depth_valid=seen)


def test_who_hides_the_needle_until_it_is_in_has_not_been_seen_inserting_it() -> None:
    assert value("tracking_valid", hidden_entry(19.0, 40.0)) == pytest.approx(100 * 20 / 41, abs=1)
    assert value("tracking_valid", hidden_entry(5.0, 15.0)) == 100.0  # seen again before the skin
    assert value("tracking_valid", hidden_entry(-1.0, 40.0)) == 100.0  # never visible yet
    tube = hidden_entry(5.0, 24.0, before=0.010)  # the marker went into the tube, and came out
    assert value("tracking_valid", tube) == 100.0
    older = replace(hidden_entry(19.0, 40.0), scoring_version=6)
    assert value("tracking_valid", older) == 100.0


def test_cameras_covered_from_the_first_moment_on_make_an_attempt_void():
    """The wide rig sees the marker from 30 mm above the skin on, the thesis' from 60 mm depth on:
    `depth_min_mm` and `hidden_mm` of resources/cameras.
    """
    covered = replace(hidden_entry(-1.0, 40.0), seen_from=-0.030)
    assert value("tracking_valid", covered) == pytest.approx(100 * 20 / 60, abs=1)
    judged = score(covered)
    assert judged.total is None
    assert "the tip was tracked for 3" in judged.void_reason
    assert judged.unseen
    in_the_tube = replace(hidden_entry(-1.0, 40.0), seen_from=0.060)
    assert value("tracking_valid", in_the_tube) == 100.0  # it came out at 30 mm: none could see it
    begun = replace(covered, phase=np.where(covered.time < 5.0, Phase.READY, covered.phase))
    assert value("tracking_valid", begun) == pytest.approx(100 * 20 / 55, abs=1)
    older = replace(covered, scoring_version=6)
    assert value("tracking_valid", older) == 100.0
