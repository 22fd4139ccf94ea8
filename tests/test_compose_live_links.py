"""What a running trainer tells its links: the real loop, trainer and exercises, in virtual time."""

import threading
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.commands import link_options
from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.compose.watchers import open_watchers
from app.compose.watchers.links import JUMP, Links, LiveBoard, WallClock
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.errors import AcusError
from app.exchange.errors import LinkAddressError
from app.exchange.live.doors import Doors
from app.exchange.live.journal import LinkJournal
from app.exchange.moment import Validity
from app.exercises.scene import placed_plan_of
from app.imaging.body import find_body, nearest_skin
from app.imaging.scan_order import ScanOrder
from app.planning.plan import Plan
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix, without_point
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
ALL = {"igtl": "0", "rosbridge": "0", "foxglove": "0"}


class Run:
    """A run as the window has it; its cameras see what the plant does, unless they are hidden."""

    def __init__(self, folder, name="first-insertion"):
        exercise, self.clock = layered(name), VirtualClock(100.0)
        placed = placed_plan_of(exercise, device_of(exercise), PLAN)
        rig = build_rig(TrainerSetup(exercise, placed, sessions=folder, clock=self.clock))
        self.hidden = False
        self.trainer = Trainer(
            rig.loop, None, placed, exercise, rig.trainer._context, self.clock, self._measure
        )
        self.rig = SimpleNamespace(
            loop=rig.loop, profile=rig.profile, setup=rig.setup, trainer=self.trainer, own=rig
        )
        rig.loop.open()
        self.trainer.step()

    def _measure(self, now):
        if self.hidden:
            fix = without_point(FixStatus.OUT_OF_VIEW, (None, None), now, ("left",))
        else:
            state = self.rig.loop.latest()
            tip = self.rig.profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
            pixels = (np.zeros(2), np.zeros(2))
            fix = NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0)
        self.trainer.on_fix(fix)

    def go(self, seconds):
        for _ in range(round(seconds / 0.02)):
            self.trainer.step()


@pytest.fixture
def run(tmp_path):
    made = Run(tmp_path)
    yield made
    made.rig.own.close()


@pytest.fixture
def board():
    made = LiveBoard()
    made.open()
    yield made
    made.close()


def until(what, seconds=3.0):
    end = time.monotonic() + seconds
    while not (found := what()) and time.monotonic() < end:
        time.sleep(0.01)
    assert found
    return found


@pytest.mark.long("machine")
def test_the_board_tells_the_pose_that_is_recorded_and_its_age(run, board):
    assert not board.now().running
    board.attach(run, None)
    axis = run.rig.setup.placed.axis
    run.trainer.hand(float(axis[0]), float(axis[1]), 0.02)
    run.go(1.5)
    moment, pose = board.now(), run.trainer.snapshot().measured_pose
    needle = moment.needle
    assert needle.validity is Validity.OK
    np.testing.assert_array_equal(needle.p_tip, pose.p_tip)
    np.testing.assert_allclose(
        needle.p_hub, pose.p_straight - run.rig.profile.needle_length * pose.axis
    )
    assert needle.age == pytest.approx(run.clock.now() - pose.time, abs=1e-6)
    assert abs(needle.wall - (time.time() - needle.age)) < 0.1
    np.testing.assert_array_equal(moment.device.q, run.trainer.snapshot().device.q)
    np.testing.assert_allclose(moment.plan.p_entry, [0.0, -0.1, 0.0])
    on_fulcrum = moment.plan.T_world_patient @ moment.plan.p_entry
    np.testing.assert_allclose(on_fulcrum, run.rig.profile.fulcrum, atol=1e-12)


@pytest.mark.long("machine")
def test_a_needle_that_nobody_sees_is_out_of_view_and_one_that_stands_still_too_old(run, board):
    board.attach(run, None)
    run.go(0.5)
    run.hidden = True
    run.go(0.6)
    assert board.now().needle.validity is Validity.OUT_OF_VIEW
    run.clock.time += 1.0
    assert board.now().needle.validity is Validity.REQ_TIMEOUT


@pytest.mark.long("machine")
def test_under_control_scans_a_link_is_told_no_more_than_the_student(tmp_path, board):
    run = Run(tmp_path, "scans-only")
    try:
        board.attach(run, None)
        run.trainer.begin("student")
        run.go(0.6)
        moment = board.now()
        assert (moment.needle, moment.device) == (None, None)
        assert moment.running
        assert moment.plan is not None
        time.sleep(0.2)
        told = " ".join(event.message for event in board.events_after(0))
        assert "inserting" not in told
    finally:
        run.rig.own.close()


def test_skin_and_structures_are_told_where_the_exercise_shows_them(run, volume_of_phantom):
    ct = volume_of_phantom
    board = LiveBoard(surfaces=True)
    board.open()
    try:
        board.attach(run, ct)
        (skin,) = until(lambda: board.now().surfaces, 90.0)
        assert (skin.name, skin.skin) == ("skin", True)
        assert 1000 < len(skin.triangles) <= 6000
        body = find_body(ct)
        off = [nearest_skin(body, place) - place for place in 1e3 * skin.points[::200]]
        assert np.median(np.linalg.norm(off, axis=1)) < 2.5  # the coarse grid of the body
        assert board.now().surfaces is board.now().surfaces
        exercise = run.rig.setup.exercise.model_copy(update={"views": ()})
        run.rig.setup = replace(run.rig.setup, exercise=exercise)
        assert board.now().surfaces == ()
        board.detach(run)
        assert board.now().surfaces == ()
    finally:
        board.close()


def test_surfaces_that_nobody_asks_for_are_not_made(run, board, volume_of_phantom):
    board.attach(run, volume_of_phantom)
    time.sleep(0.3)
    assert board.now().surfaces == ()


@pytest.mark.long("machine")
def test_events_come_without_names_paths_and_pseudonyms(run, board):
    board.attach(run, None)
    run.trainer.begin("STUDENT-7F3A")
    run.go(0.4)
    run.trainer._running.say("state", "aborted: /home/jane/records/x.mcap is full", 101.0)
    run.trainer._running.say("recorder", "cannot write /home/jane", 101.0)
    run.trainer.scan()
    found = until(lambda: [e for e in board.events_after(0) if e.kind == "scan"] and
                  board.events_after(0))  # fmt: skip
    kinds = {event.kind for event in found}
    assert "recorder" not in kinds
    words = " ".join(event.message for event in found)
    assert "jane" not in words
    assert "7F3A" not in words
    assert [event.number for event in found] == sorted(event.number for event in found)


@pytest.mark.long("machine")
def test_a_control_scan_becomes_a_picture_with_the_needle_in_it(run, board, volume_of_phantom):
    board.attach(run, volume_of_phantom)
    run.trainer.begin("student")
    run.go(0.6)
    run.trainer.scan(ScanOrder(float(PLAN.entry_mm[2]), 3, 5.0))
    scan = until(lambda: board.now().scan, 20.0)
    assert scan.hu.shape[0] == 3
    assert scan.affine_mm[2, 3] == pytest.approx(PLAN.entry_mm[2] - 5.0)
    board.detach(run)
    assert board.now().scan is None


@pytest.fixture(scope="module")
def volume_of_phantom():
    from app.imaging.phantom.series import phantom_series
    from app.imaging.reading import load_ct

    return load_ct(phantom_series(1))


def test_another_run_is_not_let_go_with_the_one_before(run, board):
    other = SimpleNamespace(rig=run.rig)
    board.attach(run, None)
    board.attach(other, None)
    board.detach(run)
    assert board.now().running
    board.detach(other)
    assert not board.now().running


@pytest.mark.long("machine")
def test_a_plan_is_handed_to_whoever_may_take_it_and_to_nobody_during_an_attempt(run, board):
    points = np.zeros(3), np.ones(3)
    assert "instructor's window" in board.place(*points)
    taken = []
    board.on_plan = lambda *given: taken.append(given) or ""
    board.attach(run, None)
    assert board.place(*points) == ""
    run.trainer.begin("student")
    assert "an attempt is running" in board.place(*points)
    assert len(taken) == 1


def test_a_clock_that_is_set_moves_the_times_once_and_is_said():
    wall, steady, journal = [1000.0], [5.0], LinkJournal()
    clock = WallClock(journal, lambda: wall[0], lambda: steady[0])
    wall[0], steady[0] = 1000.4, 5.1
    assert clock.now() == pytest.approx(1000.1), "what is less than a jump is not followed"
    wall[0] += 3600.0
    assert clock.now() == pytest.approx(wall[0])
    assert "set by +36" in journal.last
    assert JUMP == 0.5


@pytest.mark.long("machine")
def test_the_attempt_is_the_same_to_the_bit_with_links_and_without(tmp_path):
    rows = []
    for links in (False, True):
        run = Run(tmp_path / str(links))
        watchers = open_watchers(ALL) if links else ()
        for watcher in watchers:
            watcher.began(run, None)
        stop = threading.Event()
        asking = threading.Thread(target=_ask, args=(watchers, stop))
        asking.start()
        try:
            run.trainer.begin("student")
            run.go(1.0)
            rows.append(np.array(run.rig.loop.latest().row))
        finally:
            stop.set()
            asking.join()
            for watcher in watchers:
                watcher.close()
            run.rig.own.close()
    same = [slot for slot in range(sv.SLOTS) if slot not in (sv.LATENESS, sv.TICK_COST, sv.MISSED)]
    np.testing.assert_array_equal(rows[0][same], rows[1][same])


def _ask(watchers, stop):
    while not stop.wait(0.001):
        for watcher in watchers:
            watcher.board.now()


# --- the options ----------------------------------------------------------------------------------
def test_nothing_is_opened_unless_it_is_asked_for():
    assert open_watchers({}) == ()


def test_a_token_in_the_environment_asks_for_nothing():
    assert link_options.opened(link_options.given(igtl=None, links_token="x" * 20)) == ()


def test_what_is_asked_for_listens_and_says_where():
    (links,) = open_watchers(ALL)
    try:
        lines = links.lines()
        assert [line.split(" at ")[0] for line in lines] == ["OpenIGTLink", "rosbridge", "Foxglove"]
        assert all("127.0.0.1:" in line for line in lines)
        assert [status.peers for status in links.statuses()] == [0, 0, 0]
    finally:
        links.close()
        links.close()


def test_elsewhere_than_here_a_token_is_made_and_told():
    links = open_watchers({"rosbridge": "0", "links-host": "*"})[0]
    try:
        assert "token" in links.lines()[-1]
        assert len(links.lines()[-1].split()[-1]) >= 16
    finally:
        links.close()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"links-host": "*"}, "of no use without a link"),
        ({"igtl": "70000"}, "port 70000 is not 0 to 65535"),
        ({"igtl": "0", "links-host": "0.0.0.0"}, "--links-allow"),
        ({"rosbridge": "0", "links-host": "no.such.invalid"}, "is not known"),
        ({"rosbridge": "0", "links-token": "short"}, "at least 16"),
        ({"nonsense": "1"}, "nothing in this program takes --nonsense"),
    ],
)
def test_options_that_cannot_be_used_are_refused_in_one_line(options, words):
    with pytest.raises(AcusError, match=words):
        open_watchers(options)


def test_one_link_that_cannot_be_had_leaves_none_open():
    first = Links({"igtl": 0}, Doors())
    first.open()
    port = first.servers[0].port
    try:
        with pytest.raises(LinkAddressError, match="in use"):
            Links({"rosbridge": 0, "igtl": port}, Doors()).open()
        assert not any(thread.name == "rosbridge" for thread in threading.enumerate())
    finally:
        first.close()
