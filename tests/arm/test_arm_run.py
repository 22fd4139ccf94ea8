"""The arm's scene before the eyes: found by pictures only, fetched, brought; shown by the demo."""

import json
import subprocess
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from app.arm.eyes.pictures import ToolRenderer, ToolScene, eyes
from app.arm.mechanics import forward
from app.arm.run import (
    DEEPEST,
    PHASES,
    ArmRun,
    aimed,
    cameras,
    carry_out,
    demonstrate,
    look,
    pictures,
)
from app.arm.scene import ArmScene, CarryError, CarryFailure, RunningScene, ToolBody
from app.arm.studies.pick_place import AXIS_MM, TIP_MM
from app.core.arrays import angle_between
from app.core.progress import Cancelled, Progress
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.simulation.errors import SimulationError

ROOT = Path(__file__).resolve().parents[2]
needs_the_extra = pytest.mark.skipif(
    any(find_spec(name) is None for name in ("mujoco", "ompl", "ruckig")),
    reason="needs the extra arm: make extra NAME=arm",
)
MODELS = cameras()
SCENE = ArmScene.seeded(1)
AWAY = RigidTransform.from_translation([0.0, 0.0, -9.0])
BESIDE = RigidTransform.from_translation([0.0, 0.09, 0.0]) @ SCENE.T_world_tool
MIDDLE = RigidTransform.from_translation(SCENE.T_world_tool @ [0.0, 0.0, SCENE.tool.grip])
ACROSS = (
    MIDDLE
    @ RigidTransform.from_rotation(rotation_exp([0.0, 0.0, 1.2]))
    @ MIDDLE.inverse()
    @ SCENE.T_world_tool
)
FULCRUM = np.array([0.0, 0.16056, 0.090])
ENTRY_MM = np.array([12.0, -30.0, 40.0])


def placed(tilt, azimuth, depth):
    """A plan on the bench that leans from straight down, degrees, as deep as asked."""
    tilt, azimuth = np.radians((tilt, azimuth))
    axis = np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])
    lies = Placement()
    target = ENTRY_MM + lies.rotation.T @ axis * depth / MILLIMETRE
    return PlacedPlan.of(Plan(ENTRY_MM, target), lies, FULCRUM)


def inserted_as_planned(performance, plan, depth):
    """Whether the tool is where the plan says, in the bench's world, and still held."""
    direction, deep = performance.needle(performance.timeline.duration)
    last = performance.phases[-1]
    assert last.name == "insert"
    assert last.errors["tip_mm"] <= TIP_MM
    assert last.errors["axis_from_fulcrum_mm"] <= AXIS_MM
    assert np.degrees(angle_between(direction, plan.axis)) < 1.0
    assert abs(deep - depth) < 2.0 * MILLIMETRE
    assert performance.timeline.at(1e9).held


def acus(*words, code=""):
    """Run the command line, or lines of code."""
    call = ["-c", code] if code else ["-m", "app", *words]
    return subprocess.run(
        [sys.executable, *call], capture_output=True, text=True, check=False, cwd=ROOT, timeout=250
    )


@pytest.mark.long("machine")
def test_the_eyes_find_tool_and_trocar_in_the_pictures_of_the_scene():
    found = []
    for seed in range(5):
        scene = ArmScene.seeded(seed)
        pair = pictures(scene, scene.T_world_tool, MODELS, seed)
        found.append(look(scene, scene.T_world_tool, pair).errors)
    median = {name: np.median([errors[name] for errors in found]) for name in found[0]}
    assert median["tool_across_mm"] < 1.0
    assert median["tool_along_mm"] < 1.0
    assert median["tool_axis_deg"] < 1.0
    assert median["fulcrum_mm"] < 0.5


@pytest.mark.long("machine")
def test_the_longest_tool_is_whole_in_both_pictures_whichever_way_it_lies():
    for seed in range(8):
        scene = ArmScene.seeded(seed, ToolBody().reaching(DEEPEST))
        pair = pictures(scene, scene.T_world_tool, MODELS, seed)
        assert look(scene, scene.T_world_tool, pair).errors["tool_along_mm"] < 1.0


@pytest.mark.long("machine")
def test_pictures_repeat_themselves_and_hold_the_scene():
    scene = ArmScene.seeded(2)
    first = pictures(scene, scene.T_world_tool, MODELS, 2)
    again = pictures(scene, scene.T_world_tool, MODELS, 2)
    assert all((a == b).all() for a, b in zip(first, again, strict=True))
    far = RigidTransform(scene.T_world_tool.rotation, np.array([0.0, 3.0, 0.0]))
    other = pictures(scene, far, MODELS, 2)
    with pytest.raises(CarryError, match="no tool: nothing in the tool's colour") as caught:
        look(scene, far, other)
    assert caught.value.failure is CarryFailure.NOT_SEEN


@pytest.mark.long("machine")
def test_a_tool_in_line_with_both_cameras_is_not_reached_for():
    scene = ArmScene.seeded(24)
    beside = eyes(distance=0.9)
    pair = pictures(scene, scene.T_world_tool, beside, 24)
    with pytest.raises(CarryError, match="move a camera out of its line") as caught:
        look(scene, scene.T_world_tool, pair, beside)
    assert caught.value.failure is CarryFailure.NOT_SEEN


def drawn(*tools):
    """Pictures of both cameras with the tools of some poses on the table."""
    seen = [
        ToolScene(place @ [0.0, 0.0, SCENE.tool.length], place.rotate([0.0, 0.0, 1.0]))
        for place in tools
    ]
    shown = replace(seen[0], others=tuple(seen[1:]))
    renderers = (ToolRenderer(model, SCENE.tool, SCENE.trocar) for model in MODELS)
    first, second = (renderer.render(shown) for renderer in renderers)
    return first, second


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("tools", "words"),
    [
        ([AWAY], "no tool: nothing in the tool's colour"),
        ([SCENE.T_world_tool, BESIDE], "no tool: two tools: take one away"),
        ([SCENE.T_world_tool, ACROSS], "no tool: not one straight thing: two tools that cross"),
    ],
    ids=["none", "two apart", "two that cross"],
)
def test_no_tool_and_two_are_named_and_nothing_is_reached_for(tools, words):
    with pytest.raises(CarryError, match=words) as caught:
        look(SCENE, SCENE.T_world_tool, drawn(*tools), MODELS)
    assert caught.value.failure is CarryFailure.NOT_SEEN


def test_a_seed_aims_within_25_degrees_and_the_tool_reaches_so_deep():
    for seed in range(50):
        axis, depth = aimed(seed)
        assert np.degrees(angle_between(axis, [0.0, 0.0, -1.0])) <= 25.0
        assert 0.04 <= depth <= DEEPEST
    assert (aimed(3)[0] == aimed(3)[0]).all()
    assert (aimed(3)[0] != aimed(4)[0]).any()


@pytest.mark.long("machine")
@needs_the_extra
def test_the_tool_is_fetched_and_inserted_by_pictures_alone(tmp_path):
    told = []
    shown = demonstrate(1, tmp_path, told.append)
    assert shown.failure is None, shown.message
    assert tuple(phase.name for phase in shown.phases) == PHASES
    assert shown.phases[-1].errors["tip_mm"] <= TIP_MM
    assert shown.phases[-1].errors["axis_from_fulcrum_mm"] <= AXIS_MM
    assert shown.real_time > 0.0
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["note"] == "Simulation only: nothing here drives a real arm."
    assert [phase["name"] for phase in report["phases"]] == ["look", *PHASES]
    assert report["wanted"]["depth_mm"] == pytest.approx(shown.depth / MILLIMETRE)
    assert report["failure"] is None
    files = {path.name for path in tmp_path.glob("*.png")}
    assert {"0-look-left.png", "0-look-right.png"} <= files
    if not any(line.startswith("no pictures of the arm") for line in told):
        assert {f"{k + 1}-{name}.png" for k, name in enumerate(PHASES)} <= files
    assert any("times real time" in line for line in told)


@pytest.mark.long("machine")
@needs_the_extra
@pytest.mark.parametrize(("azimuth", "stands"), [(135.0, 0.0), (250.0, 90.0)])
def test_a_leaning_plan_is_carried_out_on_the_bench(azimuth, stands):
    plan = placed(25.0, azimuth, 0.08)
    performance = carry_out(plan, 1, stands)
    inserted_as_planned(performance, plan, 0.08)
    moved = performance.T_scene_world
    assert moved @ plan.p_entry == pytest.approx(performance.scene.trocar.p_world, abs=1e-12)
    assert moved.rotate([0.0, 0.0, 1.0]) == pytest.approx([0.0, 0.0, 1.0])
    turned = moved.inverse().rotate([1.0, 0.0, 0.0])
    assert np.degrees(np.arctan2(turned[1], turned[0])) == pytest.approx(stands)


@pytest.mark.long("machine")
@needs_the_extra
def test_a_timeline_is_what_the_scene_was_moment_by_moment():
    axis, depth = aimed(6)
    scene = ArmScene.seeded(6, ToolBody().reaching(depth), axis)
    arm_run, ends = ArmRun(scene, axis, depth, 6), {}

    def shown(running, name):
        ends[name] = (running.state, running.holding)

    arm_run.run(shown)
    line = arm_run.performance(RigidTransform.identity()).timeline
    assert line.names == PHASES
    assert np.diff(line.time) == pytest.approx(0.02, abs=1e-9)
    assert line.time[0] == 0.0
    for name in PHASES:
        state, held = ends[name]
        moment = line.at(state.time)
        assert moment.held is held
        assert moment.q == pytest.approx(state.q, abs=1e-3)
        assert moment.fingers == pytest.approx(state.fingers, abs=1e-3)
        apart = moment.T_scene_tool.translation - state.T_world_tool.translation
        assert np.linalg.norm(apart) < 1e-4
    begins = [line.begin(name) for name in PHASES]
    assert begins == sorted(begins)
    held = np.flatnonzero(line.held)
    arm, first = scene.arm, int(held[0])
    for k in held[::50]:  # the tool goes with the hand, where the arm's own kinematics has it
        hand = arm.tool_pose(forward(arm, line.q[k]))
        place = RigidTransform(line.R_tool[k], line.p_tool[k])
        at = hand.inverse() @ place @ [0.0, 0.0, scene.tool.grip]
        hand = arm.tool_pose(forward(arm, line.q[first]))
        begun = RigidTransform(line.R_tool[first], line.p_tool[first])
        before = hand.inverse() @ begun @ [0.0, 0.0, scene.tool.grip]
        assert np.linalg.norm(at - before) < 1.5e-3


@pytest.mark.long("machine")
@needs_the_extra
def test_the_same_plan_and_seed_are_carried_out_the_same():
    plan = placed(10.0, 60.0, 0.05)
    first, again = carry_out(plan, 3), carry_out(plan, 3)
    assert (first.timeline.q == again.timeline.q).all()
    assert (first.timeline.p_tool == again.timeline.p_tool).all()
    assert first.phases == again.phases


@pytest.mark.long("machine")
@needs_the_extra
@pytest.mark.parametrize(
    ("tilt", "azimuth", "depth", "failures"),
    [
        (45.0, 180.0, 0.08, {CarryFailure.NOT_SEEN}),  # the ring is seen edge on
        (58.0, 0.0, 0.118, {CarryFailure.UNREACHABLE, CarryFailure.COLLIDES}),
    ],
)
def test_where_it_cannot_stand_it_says_where_it_could_and_there_it_does(
    tilt, azimuth, depth, failures
):
    plan = placed(tilt, azimuth, depth)
    with pytest.raises(CarryError, match="stand elsewhere") as caught:
        carry_out(plan, 1)
    assert caught.value.failure in failures
    could = caught.value.could_stand_deg
    assert could is not None
    assert could % 45.0 == 0.0
    inserted_as_planned(carry_out(plan, 1, could), plan, depth)


def test_paths_too_deep_or_too_flat_are_refused_at_once():
    with pytest.raises(CarryError, match="by 150 mm; up to 120 mm it can") as caught:
        carry_out(placed(10.0, 0.0, 0.15), 1)
    assert caught.value.failure is CarryFailure.UNREACHABLE
    with pytest.raises(CarryError, match="leans 70° from straight down") as caught:
        carry_out(placed(70.0, 0.0, 0.08), 1)
    assert caught.value.failure is CarryFailure.UNREACHABLE
    assert caught.value.could_stand_deg is None


@pytest.mark.long("machine")
@needs_the_extra
def test_it_can_be_cancelled_at_any_time_and_says_how_far_it_is():
    plan, told = placed(10.0, 60.0, 0.05), []
    for share in (0.04, 0.1, 0.5):
        progress = Progress()

        def heard(fraction, text, progress=progress, share=share):
            told.append((fraction, text))
            if fraction >= share:
                progress.cancel()

        progress._listener = heard
        with pytest.raises(Cancelled):
            carry_out(plan, 3, progress=progress)
    words = {text for _, text in told}
    assert "the eyes look for tool and entry" in words
    assert "the arm's way is planned" in words
    assert "the hand closes on the tool" in words


@pytest.mark.long("machine")
def test_the_pictures_of_the_arm_show_it():
    pytest.importorskip("mujoco", reason="needs the extra arm: make extra NAME=arm")
    with RunningScene(ArmScene.seeded(1)) as running:
        try:
            image = running.picture((320, 240))
        except SimulationError as error:
            pytest.skip(str(error))
        away = np.radians([20.0, 30.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        running.follow(running.scene.home + np.linspace(0.0, 1.0, 500)[:, None] * away)
        moved = running.picture((320, 240))
    assert image.shape == (240, 320, 3)
    assert image.std() > 10.0
    assert (np.abs(image.astype(int) - moved).max(axis=2) > 30).mean() > 0.01


@pytest.mark.long("machine")
def test_without_the_extra_the_command_says_which_to_install():
    code = (
        "import sys; sys.modules['mujoco'] = None;"
        "sys.argv = ['acus', 'demo', '--device', 'arm', '--headless'];"
        "from app.__main__ import main; main()"
    )
    found = acus(code=code)
    assert found.returncode == 2
    assert found.stdout.strip() == "Simulation only: nothing here drives a real arm."
    assert "make extra NAME=arm" in found.stderr
    assert len(found.stderr.strip().splitlines()) == 1


@pytest.mark.long("machine")
def test_what_the_arm_cannot_show_is_refused():
    found = acus("demo", "--device", "arm", "--pen")
    assert found.returncode == 2
    assert "leave out --pen and --cameras" in found.stderr
