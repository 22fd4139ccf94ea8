"""Time that waits for whoever is late: tried with a wall clock of the test's own."""

import threading
import time

import pytest

from app.core.paced_clock import BATCH, BEHIND, PacedClock


class Wall:
    """A wall clock that stands until it is told to go on."""

    def __init__(self) -> None:
        self.time = 50.0

    def __call__(self) -> float:
        return self.time


def passed(clock: PacedClock, step: float = 1e-3) -> float:
    """Let all time pass that may [s]."""
    total = 0.0
    while ticks := int(clock.grant(step) / step):
        clock.advance(ticks * step)
        total += ticks * step
    return total


@pytest.fixture
def wall() -> Wall:
    return Wall()


@pytest.fixture
def clock(wall: Wall) -> PacedClock:
    clock = PacedClock(5.0, wall)
    clock.start()
    return clock


def test_time_goes_with_the_wall_and_never_faster(clock: PacedClock, wall: Wall) -> None:
    assert passed(clock) == 0.0
    for _ in range(10):
        wall.time += 0.02
        assert passed(clock) == pytest.approx(0.02, abs=2e-3)
    assert clock.now() == pytest.approx(5.2, abs=2e-3)
    assert clock.lost == 0.0


def test_time_waits_for_whoever_holds_it_and_is_not_caught_up(
    clock: PacedClock, wall: Wall
) -> None:
    hold = clock.hold("cameras")
    hold.until(5.05)
    wall.time += 3.0
    assert passed(clock) == pytest.approx(0.05)
    assert clock.now() == pytest.approx(5.05)
    hold.release()
    assert passed(clock) <= BEHIND + 2e-3
    assert clock.lost == pytest.approx(2.9, abs=0.02)


def test_a_limit_between_two_ticks_is_passed_by_less_than_one(
    clock: PacedClock, wall: Wall
) -> None:
    """Else who waits for that moment, and holds time until then, would wait for ever."""
    hold = clock.hold("cameras")
    hold.until(5.0123)
    wall.time += 0.09
    assert passed(clock) == pytest.approx(0.013)
    assert clock.now() >= 5.0123


def test_the_last_to_be_done_decides(clock: PacedClock, wall: Wall) -> None:
    first, second = clock.hold("cameras"), clock.hold("trainer")
    wall.time += 0.08
    first.until(5.02)
    second.until(5.01)
    assert passed(clock) == pytest.approx(0.01)
    second.until(5.06)
    assert passed(clock) == pytest.approx(0.01)


def test_little_time_passes_at_once_so_that_a_hand_is_heard(clock: PacedClock, wall: Wall) -> None:
    wall.time += 0.09
    assert clock.grant(1e-3) <= BATCH + 1e-6


def test_who_sleeps_wakes_when_that_time_has_passed_or_nobody_lets_it_pass(
    clock: PacedClock, wall: Wall
) -> None:
    woken = threading.Event()

    def sleeper() -> None:
        clock.sleep(0.03)
        woken.set()

    thread = threading.Thread(target=sleeper)
    thread.start()
    wall.time += 0.02
    passed(clock)
    assert not woken.wait(0.15)
    wall.time += 0.02
    passed(clock)
    assert woken.wait(2.0)
    thread.join()
    clock.stop()
    began = time.monotonic()
    clock.sleep(1000.0)
    assert time.monotonic() - began < 1.0


def test_waiting_for_another_camera_takes_this_time_and_not_the_wall_s(
    clock: PacedClock, wall: Wall
) -> None:
    arrived, there = threading.Condition(), []
    result: list[bool] = []

    def tracker() -> None:
        with arrived:
            result.append(clock.wait_for(arrived, lambda: bool(there), 0.15))

    thread = threading.Thread(target=tracker)
    thread.start()
    time.sleep(0.3)  # longer than it waits; but no time has passed
    assert result == []
    with arrived:
        there.append(1)
        arrived.notify_all()
    thread.join(2.0)
    assert result == [True]
    there.clear()
    thread = threading.Thread(target=tracker)
    thread.start()
    for _ in range(20):
        wall.time += 0.02
        passed(clock)
    thread.join(2.0)
    assert result == [True, False]


def test_who_holds_time_and_is_never_heard_again_is_waited_for_no_more(
    clock: PacedClock, wall: Wall, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.core.paced_clock.PATIENCE", 0.05)
    clock.hold("cameras").until(5.0)
    wall.time += 0.02
    end = time.monotonic() + 2.0
    while clock.now() == 5.0 and time.monotonic() < end:
        passed(clock)
    assert clock.now() > 5.0


def test_a_part_that_hangs_is_given_up_though_another_is_heard_all_the_while(
    clock: PacedClock, wall: Wall, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.core.paced_clock.PATIENCE", 0.05)
    clock.hold("trainer").until(5.0)
    hand = clock.hold("hand")
    wall.time += 0.02
    end = time.monotonic() + 2.0
    while clock.now() == 5.0 and time.monotonic() < end:
        hand.until(clock.now() + 0.1)
        passed(clock)
    assert clock.now() > 5.0


def test_who_sleeps_until_a_moment_that_has_come_meanwhile_does_not_wait(
    clock: PacedClock, wall: Wall
) -> None:
    wall.time += 0.05
    passed(clock)
    began = time.monotonic()
    clock.sleep_until(5.02)
    assert time.monotonic() - began < 1.0


@pytest.mark.parametrize("times", [2, 20])
def test_a_wall_that_runs_faster_is_a_computer_that_is_slower(times: int) -> None:
    wall = Wall()
    clock = PacedClock(0.0, lambda: times * wall.time)
    clock.start()
    hold = clock.hold("cameras")
    for picture in range(1, 31):  # each takes this computer 40 ms
        hold.until(picture / 30.0)
        wall.time += 0.04
        passed(clock)
    assert clock.now() == pytest.approx(1.0, abs=2e-3)
    assert clock.lost > 0.5
