"""Commissioning of a simulated robot on a virtual clock: what the routines find, and that they end
at zero torque."""

from dataclasses import replace

import numpy as np
import pytest
from device.commissioning_rig import (
    HOLD,
    HOME,
    INFO,
    UPRIGHT,
    Person,
    WiredLink,
    assert_quiet,
    commission,
    make,
    run,
)

from app.core import state_vector as sv
from app.device.commissioning.records import settle
from app.device.commissioning.results import RoutineName
from app.device.errors import CommissioningError


@pytest.fixture
def parts(tmp_path):
    link, bench, person = make(tmp_path)
    with bench:
        yield link, bench, person


def test_homing_finds_the_offsets_of_counters_that_began_anywhere(parts):
    link, bench, person = parts
    link.encoders[4:6] = 0.3, -0.2
    report = run(bench, person, RoutineName.HOMING)
    assert report.failure == ""
    count = 2 * np.pi / bench.profile.encoder.counts_per_turn
    assert report.result.offsets == pytest.approx((-0.3, 0.2), abs=count)
    bench.keep(report.result)
    link.hold(UPRIGHT)
    bench.advance(0.1)
    assert bench.loop.latest().q == pytest.approx(UPRIGHT, abs=count)


def test_the_jig_finds_the_same_offsets_as_the_stops(parts):
    link, bench, person = parts
    link.encoders[4:6] = 0.3, -0.2
    by_stops = run(bench, person, RoutineName.HOMING).result
    bench.keep(by_stops)
    by_jig = run(bench, person, RoutineName.OFFSETS).result
    assert by_jig.offsets == pytest.approx(by_stops.offsets, abs=4e-4)
    assert by_jig.reference == "jig"


@pytest.mark.parametrize("matrix", [(-1.0, 0, 0, 1), (1.0, 0, 0, -1), (1.0, 0, 0, 0.5)])
def test_homing_sees_encoders_that_count_wrongly_and_keeps_the_old_offsets(parts, matrix):
    link, bench, person = parts
    link.encoders[:4] = matrix
    report = run(bench, person, RoutineName.HOMING)
    assert "upright" in report.failure
    assert bench.corrections.offsets == (0.0, 0.0)


def test_homing_asks_to_hold_still(parts):
    _link, bench, person = parts

    def restless(report):
        return person(report)

    routine = bench.routine(RoutineName.HOMING)
    while not routine.step(bench.clock.now()).needs:
        bench.advance(0.01)
    routine.answer()
    bench.loop.inbox.write(hand_holds=1.0, hand_depth=-0.015)
    k = 0
    while not (report := routine.step(bench.clock.now())).done:
        k += 1
        bench.loop.inbox.write(hand_x=0.2 * np.sin(0.1 * k))
        bench.advance(0.01)
    assert "stand still" in report.failure
    assert_quiet(bench)


def test_a_right_robot_passes_the_sign_check_with_light_pulses_only(parts):
    _link, bench, person = parts
    bench.keep(run(bench, person, RoutineName.HOMING).result)
    since = bench.loop.latest().tick
    report = run(bench, person, RoutineName.SIGNS)
    assert report.failure == ""
    rows = bench.loop.rows(since)
    assert np.abs(rows[:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]).max() <= 0.03
    assert np.linalg.norm(rows[:, sv.FELT], axis=1).max() <= 0.3
    (ll, lr), (rl, rr) = report.result.response
    assert ll > abs(lr)
    assert rr > abs(rl)


@pytest.mark.parametrize(
    ("motors", "words"),
    [
        ((0.0, 1, 1, 0), "motors are swapped"),
        ((0.0, -1, 1, 0), "motors are swapped"),
        ((-1.0, 0, 0, 1), "left motor turns backwards"),
        ((1.0, 0, 0, -1), "right motor turns backwards"),
        ((0.0, 0, 0, 0), "no motor moves anything"),
        ((1.0, 0, 0, 0), "right motor moves nothing"),
        ((1.0, 1, 0, 0), "both motors move the same encoder"),
    ],
)
def test_the_sign_check_names_what_is_wrong_with_the_motors(parts, motors, words):
    link, bench, person = parts
    bench.keep(run(bench, person, RoutineName.HOMING).result)
    link.motors[:4] = motors
    report = run(bench, person, RoutineName.SIGNS)
    assert words in report.failure
    assert report.result is None


@pytest.mark.parametrize("joint", [9, 10])
def test_the_sign_check_names_a_blocked_joint(parts, joint):
    link, bench, person = parts
    bench.keep(run(bench, person, RoutineName.HOMING).result)
    link.motors[joint] = 1.0
    link.motors[7:9] = UPRIGHT
    report = bench.run(bench.routine(RoutineName.SIGNS, by_hand=False), person)
    assert "blocked" in report.failure
    assert_quiet(bench)


@pytest.mark.parametrize(
    ("encoders", "words"),
    [
        ((0.0, 1, 1, 0), "swapped"),
        ((-1.0, 0, 0, 1), "left encoder counts backwards"),
        ((1.0, 0, 0, -1), "right encoder counts backwards"),
        ((0.0, 0, 0, 0), "no encoder saw the left link move"),
    ],
)
def test_turning_the_links_by_hand_tells_wrong_encoders_before_any_torque(parts, encoders, words):
    link, bench, person = parts
    bench.keep(run(bench, person, RoutineName.HOMING).result)
    link.encoders[:4] = encoders
    since = bench.loop.latest().tick
    report = run(bench, person, RoutineName.SIGNS)
    assert words in report.failure
    assert not bench.loop.rows(since)[:, sv.TORQUE_LEFT].any()


@pytest.mark.long("machine")
def test_friction_comes_out_as_the_plant_has_it(parts):
    _link, bench, person = parts
    commission(bench, person)
    report = run(bench, person, RoutineName.FRICTION)
    truth = bench.profile.friction
    for side in (report.result.left, report.result.right):
        assert side.coulomb == pytest.approx(truth.coulomb, rel=0.05)
        assert side.viscous == pytest.approx(truth.viscous, rel=0.15)
        assert side.breakaway == pytest.approx(truth.coulomb, rel=0.2)
        assert side.residual < 2e-4


@pytest.mark.long("machine")
def test_friction_of_a_stuck_joint_is_refused(parts):
    link, bench, person = parts
    commission(bench, person)
    link.motors[10] = 1.0
    link.motors[8] = UPRIGHT[1]
    report = run(bench, person, RoutineName.FRICTION)
    assert "right joint does not keep" in report.failure


def test_latency_on_the_simulated_plant_is_within_two_ticks(parts):
    _link, bench, person = parts
    commission(bench, person)
    result = run(bench, person, RoutineName.LATENCY).result
    assert 0.0 <= result.dead_time <= 2e-3
    assert result.round_trip == (0.0, 0.0, 0.0)


@pytest.mark.promise("README.md: 1 N until the force scale is verified")
def test_a_right_force_scale_lifts_the_cap(parts):
    _link, bench, person = parts
    commission(bench, person)
    assert bench.clearance().force_cap == 1.0
    report = run(bench, person, RoutineName.FORCE)
    assert report.result.factor == pytest.approx(1.0, abs=0.01)
    assert report.result.verified
    bench.keep(report.result)
    assert bench.clearance().full
    assert bench.clearance().force_cap == bench.profile.limits.hand_force


def test_a_missing_gear_is_named_and_the_larger_forces_are_never_commanded(parts):
    link, bench, person = parts
    commission(bench, person)
    link.motors[:4] = 10.0, 0, 0, 10
    since = bench.loop.latest().tick
    report = run(bench, person, RoutineName.FORCE)
    assert "gear ratio 10:1 seems to be missing" in report.failure
    felt = np.linalg.norm(bench.loop.rows(since)[:, sv.FELT], axis=1)
    assert felt.max() == pytest.approx(0.2, rel=1e-6)
    assert bench.clearance().force_cap == 1.0


def test_the_scale_may_be_read_for_as_long_as_it_takes(parts):
    link, bench, person = parts
    commission(bench, person)
    routine = bench.routine(RoutineName.FORCE)
    slow = Person(link, bench)
    pushes = 0
    while not (report := routine.step(bench.clock.now())).done:
        if report.unit:
            for _ in range(300):  # three seconds of staring at the display
                routine.step(bench.clock.now())
                bench.advance(0.01)
            assert np.linalg.norm(bench.loop.latest().felt) > 0.19
            pushes += 1
        if report.needs:
            routine.answer(slow(report))
        bench.advance(0.01)
    assert pushes == 3
    assert report.failure == ""


@pytest.mark.promise("docs/hardware.md: Ctrl-C ends at zero torque at any moment")
@pytest.mark.parametrize(
    "step", [RoutineName.SIGNS, RoutineName.FRICTION, RoutineName.LATENCY, RoutineName.FORCE]
)
def test_cancelling_in_mid_pulse_ends_at_zero_torque(parts, step):
    _link, bench, person = parts
    commission(bench, person)
    routine = bench.routine(step)
    while not bench.loop.latest().torque.any():
        report = routine.step(bench.clock.now())
        if report.needs:
            routine.answer(person(report))
        bench.advance(0.01)
    routine.cancel()
    assert_quiet(bench)
    assert routine.report.done
    assert routine.step(bench.clock.now()).failure == "cancelled"
    routine.cancel()


def test_an_exception_of_whoever_runs_it_ends_at_zero_torque(parts):
    _link, bench, person = parts
    commission(bench, person)

    def fail_while_pushing(report):
        if bench.loop.latest().torque.any():
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        bench.run(bench.routine(RoutineName.FORCE), person, fail_while_pushing)
    assert_quiet(bench)


def test_encoders_that_go_stale_in_mid_pulse_end_the_routine_with_the_reason(parts):
    link, bench, person = parts
    commission(bench, person)
    routine = bench.routine(RoutineName.FORCE)
    while not (report := routine.step(bench.clock.now())).done:
        if report.needs and not report.unit:
            routine.answer(person(report))
        if report.unit:
            link.encoders[6] = 1.0
        bench.advance(0.01)
    assert "encoders" in report.failure
    assert_quiet(bench)


def test_a_routine_that_is_not_stepped_for_a_second_gives_no_force(parts):
    _link, bench, person = parts
    commission(bench, person)
    routine = bench.routine(RoutineName.FORCE)
    while not routine.report.unit:
        if routine.step(bench.clock.now()).needs and not routine.report.unit:
            routine.answer(person(routine.report))
        bench.advance(0.01)
    assert np.linalg.norm(bench.loop.latest().felt) > 0.19
    bench.advance(1.2)
    assert not bench.loop.latest().torque.any()


@pytest.mark.parametrize("value", [None, float("nan"), float("inf")])
def test_a_reading_that_is_no_number_is_refused_and_asked_again(parts, value):
    _link, bench, person = parts
    commission(bench, person)
    routine = bench.routine(RoutineName.FORCE)
    while not routine.report.unit:
        if routine.step(bench.clock.now()).needs and not routine.report.unit:
            routine.answer(person(routine.report))
        bench.advance(0.01)
    with pytest.raises(CommissioningError, match="not a number"):
        routine.answer(value)
    assert routine.report.unit == "g"
    routine.cancel()
    assert_quiet(bench)


def test_nothing_can_be_answered_while_nothing_is_asked(parts):
    with pytest.raises(CommissioningError, match="nothing is asked"):
        parts[1].routine(RoutineName.HOMING).answer()


@pytest.mark.promise("README.md: no force before homing and sign check")
@pytest.mark.parametrize(
    "step", [RoutineName.SIGNS, RoutineName.FRICTION, RoutineName.LATENCY, RoutineName.FORCE]
)
def test_nothing_pushes_before_homing_and_nothing_but_the_sign_check_before_it(parts, step):
    _link, bench, person = parts
    with pytest.raises(CommissioningError, match="homed"):
        bench.routine(step)
    bench.keep(run(bench, person, RoutineName.HOMING).result)
    if step is not RoutineName.SIGNS:
        with pytest.raises(CommissioningError, match="signs"):
            bench.routine(step)


def test_another_power_cycle_needs_homing_again(parts):
    link, bench, person = parts
    commission(bench, person)
    assert bench.clearance().homed == 1.0
    link.who = type(INFO)("icube", "A-001", "1.0", "acus 1", boot=8)
    assert bench.clearance().homed == 0.0
    with pytest.raises(CommissioningError, match="homed"):
        bench.routine(RoutineName.SIGNS)


def test_closing_the_bench_lets_go_of_the_link_and_can_be_repeated(tmp_path):
    link, bench, _ = make(tmp_path)
    bench.open()
    bench.open()
    assert link.opened == 1
    bench.close()
    bench.close()
    assert link.opened == 0
    with pytest.raises(CommissioningError, match="closed"):
        _ = bench.loop


def test_the_gauge_is_calibrated_by_weights(parts):
    link, bench, _person = parts
    hung = iter((0.0, 0.05, 0.1, 0.2))
    true = {"force": 0.0}

    def hang(report):
        true["force"] = next(hung) * 9.80665
        link.gauge[1] = 0.2 + 1.25 * true["force"]
        return 0.0

    link.gauge[0] = 1.0
    report = bench.run(bench.routine(RoutineName.GAUGE), hang)
    assert report.failure == ""
    assert report.result.zero == pytest.approx(0.2, abs=1e-9)
    assert report.result.scale == pytest.approx(0.8, abs=1e-9)
    bench.keep(report.result)
    link.gauge[1] = 0.2 + 1.25 * 0.7
    bench.advance(0.01)
    assert bench.loop.latest().row[sv.GAUGE_FORCE] == pytest.approx(0.7)


def test_a_board_without_a_gauge_says_so(parts):
    _link, bench, person = parts
    assert "measures no force" in run(bench, person, RoutineName.GAUGE).failure


def test_the_held_links_of_these_tests_really_stand(parts):
    link, bench, _person = parts
    link.hold(HOME)
    bench.advance(0.05)
    assert link.motors[HOLD] == 1.0
    assert bench.loop.latest().q == pytest.approx(HOME, abs=4e-4)
    assert isinstance(link, WiredLink)


def test_a_homing_that_fails_after_it_has_moved_the_boards_zero_takes_clearance_and_offsets(parts):
    """The offsets of the homing before do not fit the new zero: no force until homed again."""
    link, bench, person = parts

    def home():
        link.encoders[4:6] += HOME - bench.loop.latest().q + bench.corrections.offsets

    link.home = home
    link.encoders[4:6] = 0.3, -0.2
    commission(bench, person)
    assert bench.clearance().homed == 1.0

    def careless(report):
        value = person(report)
        if "against their stops" in report.needs:
            link.hold(UPRIGHT + [0.3, 0.3])
            bench.advance(0.1)
        return value

    assert bench.corrections.offsets != (0.0, 0.0)
    assert "upright" in run(bench, careless, RoutineName.HOMING).failure
    assert bench.corrections.offsets == (0.0, 0.0)
    assert bench.clearance().homed == 0.0
    commission(bench, person)
    assert bench.clearance().homed == 1.0
    link.hold(UPRIGHT)
    bench.advance(0.1)
    assert bench.loop.latest().q == pytest.approx(UPRIGHT, abs=4e-4)
    bench.undo(RoutineName.HOMING)
    assert bench.clearance().homed == 0.0


def test_a_homing_whose_zero_cannot_be_set_does_not_bring_back_the_offsets_of_the_one_before(parts):
    link, bench, person = parts
    link.encoders[4:6] = 0.3, -0.2
    commission(bench, person)
    assert bench.corrections.offsets != (0.0, 0.0)

    def home():
        raise CommissioningError("the board does not answer")

    link.home = home
    assert "does not answer" in run(bench, person, RoutineName.HOMING).failure
    assert bench.corrections.offsets == (0.0, 0.0)
    assert bench.clearance().homed == 0.0


@pytest.mark.promise(
    "docs/hardware.md: A sign check or force scale that fails takes the earlier one back"
)
def test_a_sign_check_that_fails_takes_the_clearance_of_the_one_before_away(parts):
    link, bench, person = parts
    commission(bench, person)
    bench.keep(bench.record.newest(RoutineName.SIGNS).result)  # passed twice: neither may be left
    link.motors[:4] = -1.0, 0, 0, 1
    said = settle(bench, RoutineName.SIGNS, run(bench, person, RoutineName.SIGNS))
    assert "turns backwards" in said
    assert "counts no more" in said
    assert bench.clearance().homed == 0.0
    link.motors[:4] = 1.0, 0, 0, 1
    assert settle(bench, RoutineName.SIGNS, run(bench, person, RoutineName.SIGNS)) == ""
    assert bench.clearance().homed == 1.0


@pytest.mark.promise(
    "docs/hardware.md: A sign check or force scale that fails takes the earlier one back"
)
def test_a_force_scale_that_fails_puts_the_cap_back_also_after_one_of_another_power_cycle(parts):
    link, bench, person = parts
    commission(bench, person)
    assert settle(bench, RoutineName.FORCE, run(bench, person, RoutineName.FORCE)) == ""
    link.who = replace(link.who, boot=8)
    commission(bench, person)
    assert bench.clearance().full
    link.motors[:4] = 20.0, 0, 0, 20.0
    failed = bench.routine(RoutineName.FORCE)
    report = bench.run(failed, Person(link, bench, [500.0]))
    assert "counts no more" in settle(bench, RoutineName.FORCE, report)
    assert bench.clearance().force_cap == 1.0


def test_a_homing_that_fails_says_nothing_of_checks(parts):
    link, bench, person = parts
    link.encoders[:4] = -1.0, 0, 0, 1
    assert "counts no more" not in settle(
        bench, RoutineName.HOMING, run(bench, person, RoutineName.HOMING)
    )
