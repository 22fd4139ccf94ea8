"""One meaning of "off the path": panel, bull's-eye, slices, record and score of the same ticks."""

import os
import re

import numpy as np
import pytest

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PySide6.QtWidgets import QApplication

from app.compose.trainer import TrainerSetup, build_rig
from app.core import state_vector as sv
from app.core.bend import Bend
from app.core.clock import VirtualClock
from app.exercises.parts import NeedlePart
from app.exercises.scene import device_of, placed_plan_of
from app.planning.off_path import offset, path_to
from app.planning.plan import Plan
from app.session.curves import curves
from app.session.pad.readings import needle_line
from app.session.pad.view import NeedleLine, depth_tolerance, rings
from app.session.recording import read_recording
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.conductor import LiveNeedle
from app.views.exercise.readings import figures
from app.views.exercise.run import ExerciseRun
from app.views.exercise.target_motion import TargetMotion
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")


class Kept:
    """Takes what slices and 3D view are given."""

    def __init__(self):
        self.needle = self.target = self.draft = None
        self.viewing = self.scene = self

    @property
    def target_now_mm(self):
        return self.target

    def set_needle(self, needle):
        self.needle = needle

    follow_needle = set_needle

    def set_target_now(self, target):
        self.target = target

    @property
    def shown_draft(self):
        return self.target

    def set_plan(self, draft):
        self.draft = draft

    def set_robot(self, *_):
        pass


def attempt(exercise, sessions, seconds=9.0, steer=None, change=None):
    """Drive the whole trainer in virtual time; yields each moment, then its record."""
    chosen = layered(exercise).model_copy(update=change or {})
    placed = placed_plan_of(chosen, device_of(chosen), PLAN)
    clock = VirtualClock(100.0)
    skill = None if steer else "expert"
    rig = build_rig(TrainerSetup(chosen, placed, skill=skill, sessions=sessions, clock=clock))

    def measure(now):
        state = rig.loop.latest()
        tip = rig.profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    trainer = Trainer(rig.loop, None, placed, chosen, rig.trainer._context, clock, measure)
    run = ExerciseRun(
        trainer, placed, rig.profile, rings=rings(chosen.tolerances),
        depth_tolerance=depth_tolerance(chosen.tolerances),
    )  # fmt: skip
    rig.loop.open()
    trainer.step()
    trainer.begin("tester")
    moments = []
    while clock.now() < 100.0 + seconds:
        if steer is not None:
            steer(trainer, clock.now() - 100.0)
        moments.append(trainer.step())
        if moments[-1].device.row[sv.TRAINEE_PHASE] == 9.0:
            break
    result = trainer.end()
    rig.loop.close()
    return run, moments, result


@pytest.fixture(scope="module")
def application():
    return QApplication.instance() or QApplication([])


def said(text):
    """Millimetres in a line of words."""
    return float(re.search(r"[-+]?\d+\.\d", text)[0])


@pytest.mark.long("journey")
@pytest.mark.parametrize("exercise", ["first-insertion", "breathing-liver"])
def test_panel_bullseye_slices_record_and_score_say_the_same_of_a_tick(
    exercise, tmp_path, application
):
    run, snapshots, result = attempt(exercise, tmp_path)
    widget, kept = Bullseye(), Kept()
    widget.set_scene(run.scene(), interactive=False)
    live, motion = LiveNeedle(kept), TargetMotion(kept)
    moved = 0.0
    for snapshot in snapshots[50::40]:
        if not snapshot.pose.measured:
            continue
        panel = figures(snapshot, 5.0)
        widget.show_view(needle_line(snapshot))
        motion.show(run, snapshot)
        live.show(run, snapshot)
        away = said(widget._lateral.text())
        assert away == pytest.approx(1e3 * panel.lateral, abs=0.051)
        # The tip's mark on the slices, against entry and target as the slices have them.
        target = run.placed.plan.target_mm if kept.target is None else kept.target
        way = target - run.placed.plan.entry_mm
        way = way / np.linalg.norm(way)
        beyond = kept.needle.tip_mm - target
        beside = np.linalg.norm(beyond - (beyond @ way) * way)
        assert beside == pytest.approx(1e3 * panel.lateral, abs=1e-6)
        assert -beyond @ way == pytest.approx(1e3 * panel.to_target, abs=1e-6)
        moved = max(moved, float(np.abs(target - run.placed.plan.target_mm).max()))
    assert (moved > 3.0) == (exercise == "breathing-liver")
    recording = read_recording(result.record)
    kept_curves = curves(recording.samples, recording.placed_plan())
    final = result.trajectory.final()
    assert result.score.row("lateral_error").value == pytest.approx(
        1e3 * result.trajectory.offset(final).lateral, abs=1e-12
    )
    last = int(np.searchsorted(recording.samples.time, result.trajectory.time[final]))
    assert 1e3 * kept_curves.lateral[last] == pytest.approx(
        result.score.row("lateral_error").value, abs=1e-6
    )
    assert np.degrees(kept_curves.angle[last]) == pytest.approx(
        result.score.row("angle_error").value, abs=1e-6
    )


@pytest.mark.long("journey")
@pytest.mark.parametrize("gauge", [18, 22])
def test_a_bent_needle_is_one_needle_for_panel_slices_record_and_score(
    gauge, tmp_path, application
):
    chosen = layered("first-insertion")
    placed = placed_plan_of(chosen, device_of(chosen), PLAN)

    def steer(trainer, time):  # straight in, then the hub is turned by 4°
        depth = min(-0.015 + 0.03 * time, 0.055)
        tilt = np.radians(4.0) * min(max(time - 3.0, 0.0), 1.0)
        axis = placed.axis + np.tan(tilt) * np.array([0.0, 1.0, 0.0])
        axis = axis / np.linalg.norm(axis)
        trainer.assistance(0.0)
        trainer.hand(float(axis[0]), float(axis[1]), depth)

    needle = {"needle": NeedlePart(gauge=gauge), "locks": ()}
    run, snapshots, result = attempt("first-insertion", tmp_path, 5.0, steer, needle)
    last = snapshots[-1]
    pose = last.measured_pose
    assert pose.bend is not None
    beside = np.linalg.norm(pose.p_tip - pose.p_straight)
    assert 1e-3 < beside < 5e-3
    assert np.linalg.norm(pose.curve[-1] - pose.p_tip) < 1e-15
    assert np.linalg.norm(pose.curve[0] - run.placed.p_entry) < 1e-6
    # The needle, tilted, has bent back: nearer to its channel than the straight line says.
    straight = offset(pose.p_straight, pose.axis, run.placed, last.p_target)
    assert last.offset.lateral < 0.7 * straight.lateral
    kept, panel, view = Kept(), figures(last, 5.0), needle_line(last)
    LiveNeedle(kept).show(run, last)
    way = run.placed.plan.direction
    beyond = kept.needle.tip_mm - run.placed.plan.target_mm
    assert np.linalg.norm(beyond - (beyond @ way) * way) == pytest.approx(1e3 * panel.lateral)
    assert len(kept.needle.points_mm) > 5
    assert view.offset.lateral == panel.lateral
    recording = read_recording(result.record)
    row = np.flatnonzero(np.isfinite(recording.samples.tip).all(axis=1))[-1]
    bend = Bend.of_numbers(recording.samples.bend[row])
    depth, axis = recording.samples.depth[row], recording.samples.axis[row]
    np.testing.assert_allclose(
        recording.samples.tip[row], run.placed.p_entry + depth * axis + bend.at(depth), atol=1e-6
    )
    away = result.trajectory.offset(result.trajectory.final()).lateral
    assert away == pytest.approx(last.offset.lateral, abs=3e-4)  # the shown pose is a moment ahead
    assert result.score.row("lateral_error").value == pytest.approx(1e3 * away, abs=1e-9)


@pytest.mark.long("journey")
def test_without_the_tissue_the_needle_is_straight_to_the_last_bit(tmp_path, application):
    run, snapshots, result = attempt("first-insertion", tmp_path, 4.0, change={"effects": {}})
    for snapshot in snapshots[::20]:
        pose, row = snapshot.measured_pose, snapshot.device.row
        assert pose.bend is None
        assert not row[sv.TIP_OFFSET].any()
        assert row[sv.BENT_LENGTH] == 0.0
        assert pose.p_straight is pose.p_tip
        assert pose.tip_axis is pose.axis
    assert read_recording(result.record).samples.bend is None
    assert run.placed is not None


@pytest.mark.long("journey")
def test_at_target_is_said_only_within_the_tolerance_across_too(tmp_path, application):
    widget, texts = Bullseye(), []

    def steer(trainer, time):  # 5° beside the path, as deep as the target
        axis = placed.axis + np.array([0.075, 0.0, 0.0])
        axis = axis / np.linalg.norm(axis)
        depth = min(-0.015 + 0.04 * max(0.0, time - 1.0), placed.length / (axis @ placed.axis))
        trainer.hand(float(axis[0]), float(axis[1]), depth)

    chosen = layered("first-insertion")
    placed = placed_plan_of(chosen, device_of(chosen), PLAN)
    run, snapshots, _ = attempt("first-insertion", tmp_path, seconds=5.0, steer=steer)
    widget.set_scene(run.scene(), interactive=False)
    for snapshot in snapshots[::10]:
        widget.show_view(needle_line(snapshot))
        texts.append((widget._remaining.text(), snapshot.offset))
    near = [(text, off) for text, off in texts if abs(off.remaining) < run.depth_tolerance]
    assert near, "the needle came as deep as the target"
    assert all(off.lateral > run.rings[0] for _, off in near)
    assert not any("at target" in text for text, _ in texts)


@pytest.mark.long("journey")
def test_rings_and_target_stand_where_breathing_has_the_target(tmp_path, application):
    run, snapshots, _ = attempt("breathing-liver", tmp_path, seconds=6.0)
    scene = run.scene()
    farthest = max(snapshots, key=lambda s: float(np.linalg.norm(s.p_target - run.placed.p_target)))
    entry, target, depth = run.placed.p_entry, farthest.p_target, 0.02

    def dot(to):
        axis = (to - entry) / np.linalg.norm(to - entry)
        away = offset(entry + depth * axis, axis, run.placed, target)
        return NeedleLine(axis, away, depth, True).dot(scene)

    # A needle that points at the target as it is now has its dot in the middle of the rings.
    assert np.allclose(dot(target), 0.0, atol=1e-9)
    assert np.linalg.norm(dot(run.placed.p_target)) > 0.1


def test_a_target_at_rest_has_the_planned_path_to_the_last_bit():
    chosen = layered("first-insertion")
    placed = placed_plan_of(chosen, device_of(chosen), PLAN)
    assert (path_to(placed, placed.p_target) == placed.axis).all()
    many = np.array([placed.p_target, placed.p_target + [0.0, 0.01, 0.0], [np.nan] * 3])
    paths = path_to(placed, many)
    assert (paths[[0, 2]] == placed.axis).all()
    assert paths[1] @ (many[1] - placed.p_entry) == pytest.approx(
        np.linalg.norm(many[1] - placed.p_entry)
    )
    at_entry = offset(placed.p_entry, placed.axis, placed, many[1])
    assert at_entry.lateral < 1e-15, "the entry is on every path"
    assert at_entry.remaining == pytest.approx(np.linalg.norm(many[1] - placed.p_entry))
