"""A stranger adds one of each thing in one file by following docs/extending.md, and no more.

Each example is taken from the page, saved in the user's own folder, and used.
"""

import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from device.law_rig import pose
from extending_page import example, files, folders_section, sections
from imaging.dicom_factory import Slices
from scoring_attempts import Attempt

from app.core import state_vector as sv
from app.core.arrays import unit
from app.mechanisms.pantograph import forward, inverse
from app.mechanisms.profile import VelocityMethod, load_profile

TESTED_ELSEWHERE = {
    "How to add a language": "tests/views/test_adding_a_language.py",
    "How to add a panel": "tests/views/test_adding_a_panel.py",
    "How to add a view": "tests/views/test_views_shown.py",
}
ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def save(tmp_path, monkeypatch):
    def saved(heading, folder):
        name, code = example(heading)
        path = tmp_path / folder / name
        path.parent.mkdir()
        path.write_text(code, encoding="utf-8")
        monkeypatch.setenv(f"ACUS_{folder.upper()}", str(path.parent))
        return path

    return saved


def test_every_how_to_of_the_page_has_a_test():
    text = Path(__file__).read_text(encoding="utf-8")
    missing = [name for name in sections() if f'"{name}"' not in text]
    assert missing == []
    assert all((ROOT / path).is_file() for path in TESTED_ELSEWHERE.values())


@pytest.mark.long("journey")
def test_the_folder_of_plugins_that_the_page_makes_is_listed(tmp_path):
    making, trying = re.findall(r"```sh\n(.*?)```", folders_section(), re.DOTALL)
    for parts in (
        files(sections()["How to add an effect"]),
        files(sections()["How to add a metric"]),
        files(folders_section()),
    ):
        for place, text in parts.items():
            path = tmp_path / "acus_mine" / place
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    acus = f'set -e\nacus() {{ "{sys.executable}" -m app "$@"; }}\n'
    explain = trying.splitlines()[0]  # the others take minutes: they are played below
    done = subprocess.run(
        ["bash", "-c", acus + making + explain],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    assert "✔ effect hand_tremor: Shaking side force" in done.stdout
    assert "✔ effect axial_drag: Drag along the needle" in done.stdout
    assert "✔ metric deepest_point: Deepest point" in done.stdout
    assert "✔ exercise steady-hand: With a shaking hand" in done.stdout
    assert "hand_tremor: Shaking side force\n    model    sine" in done.stdout
    assert (tmp_path / "acus_mine" / "exercises").is_dir()


@pytest.mark.long("journey")
def test_a_force_law_acts(save):
    from app.device.control import laws

    save("How to add a force law", "laws")
    profile = load_profile("icube")
    name, step, parameters = laws.stages_of({"upright_spring": {"stiffness": 3.0}}, profile)[0]
    state = pose((0.6, 0.0, -0.8), depth=0.05)
    step(state, parameters)
    assert name == "upright_spring"
    assert state[sv.FORCE] == pytest.approx([3.0 * 0.48, 0.0, 3.0 * 0.36])


def test_the_effect_along_the_needle_drags_at_its_speed_and_not_at_steps_of_a_measurement():
    code = files(sections()["How to add an effect"])["effects/axial_drag.py"]
    effect: dict[str, object] = {"__name__": "axial_drag"}
    exec(code.replace("@stage\n", ""), effect)  # as Python: it is not compiled
    for slot, largest in ((sv.PLANT_DEPTH, 2.0), (sv.DEPTH, 2.2)):
        binding = SimpleNamespace(depth_slot=slot)
        p, state = effect["parameters"]({"drag": 20.0}, binding), np.zeros(sv.SLOTS)
        state[sv.DT], forces = 1e-3, []
        for tick in range(600):  # 0.1 m/s; a measured depth comes with each picture, 60 a second
            seen = tick if slot == sv.PLANT_DEPTH else tick - tick % 16
            state[slot], state[sv.AXIAL_FORCE] = 1e-4 * seen, 0.0
            effect["step"](state, p)
            forces.append(state[sv.AXIAL_FORCE])
        assert np.mean(forces[300:]) == pytest.approx(2.0, rel=0.1)
        assert max(forces[300:]) < 1.6 * largest


@pytest.mark.long("journey")
def test_an_effect_is_simulated(save):
    from app.simulation.consumers import DevicePort
    from app.simulation.plan import compile
    from app.simulation.scene import EffectRequest, Scene

    save("How to add an effect", "effects")
    plan = compile(Scene(effects=(EffectRequest("hand_tremor"),)), DevicePort("icube"))
    state = sv.empty_state()
    state[sv.TIME] = 0.01
    for _, step, parameters in plan.stages():
        step(state, parameters)
    assert state[sv.FORCE_X] == pytest.approx(0.2 * np.sin(2.0 * np.pi * 0.09))


def test_a_metric_is_scored(save):
    from app.scoring.score import score, with_shown

    save("How to add a metric", "metrics")
    trajectory = Attempt(depth=0.003).trajectory()
    row = with_shown(score(trajectory), trajectory).row("deepest_point")
    assert (row.label, row.unit) == ("Deepest point", "mm")
    assert row.value == pytest.approx(trajectory.placed.length * 1e3 + 3.0)


@pytest.mark.long("journey")
def test_a_study_is_listed_without_running_it_and_answers(save):
    from app.studies.runner import run

    save("How to add a study", "studies")
    listed = subprocess.run(
        [sys.executable, "-m", "app", "study", "list"], capture_output=True, text=True, check=True
    )
    assert "sine_series              How many terms are enough?" in listed.stdout
    assert run("sine_series", repeats=1).too_coarse() == ("1 terms", "2 terms")


@pytest.fixture
def ask(tmp_path):
    """Save a file in a folder of plug-ins, and ask a program that has it."""

    def asked(place, text, *arguments, code=0):
        path = tmp_path / "acus_mine" / place
        path.parent.mkdir(parents=True)
        (tmp_path / "acus_mine" / "__init__.py").touch()
        path.write_text(text, encoding="utf-8")
        mine = {"ACUS_PLUGINS": str(tmp_path / "acus_mine"), "PYTHONPATH": str(ROOT)}
        done = subprocess.run(
            [sys.executable, *arguments],
            env=os.environ | mine | {"ACUS_SESSIONS": str(tmp_path / "sessions")},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == code, done.stdout + done.stderr
        return done.stdout

    return asked


def test_a_hard_case_holds_and_its_subsystem_stands_where_it_says(ask):
    name, code = example("How to add a hard case")
    program = (
        "from app.core import plugin_folders\n"
        "from app.studies.hard_cases.case import SUBSYSTEMS, tried\n"
        "place = SUBSYSTEMS.index('tilt')\n"
        "print(*SUBSYSTEMS[place - 1 : place + 2])\n"
        "cases = [case for file in plugin_folders.modules('hard_cases') for case in file.CASES]\n"
        "print([tried(case).trouble for case in cases if case.subsystem == 'tilt'])"
    )
    assert ask(f"hard_cases/{name}", code, "-c", program) == "kinematics tilt statics\n['']\n"


def test_a_command_answers_lines_and_json(ask):
    name, code = example("How to add a command")
    program = (
        "from app.commands import build\n"
        "for words in (['--help'], ['lengths', 'over', '30'], ['lengths', 'over', '--json']):\n"
        "    build()(words, standalone_mode=False)"
    )
    said = ask(f"commands/{name}", code, "-c", program)
    assert re.search(r"^  arm .*\n  lengths +How long attempts took\.$", said, re.MULTILINE)
    assert "\n0 attempts\n" in said
    assert '"longer": []' in said


def test_a_command_of_a_name_that_is_there_is_refused_and_the_programs_own_stays(ask):
    code = example("How to add a command")[1].replace('name="lengths"', 'name="session"')
    program = (
        "from app.commands import build; from app.core import plugin_folders\n"
        "build()(['session', '--help'], standalone_mode=False)\n"
        "print(*plugin_folders.refused.values())"
    )
    said = ask("commands/lengths.py", code, "-c", program)
    assert "Recorded attempts." in said
    assert "lengths.py: `acus session` is there already; rename it" in said


def test_a_device_profile_describes_a_robot_that_moves(save):
    from app.device.control.velocity import velocity_stage

    profile = load_profile(save("How to add a device profile", "profiles"))
    geometry = profile.pantograph
    p3 = geometry.fulcrum[:2] + (0.02, -0.01)
    assert forward(geometry, inverse(geometry, p3)) == pytest.approx(p3, abs=1e-12)
    assert profile.velocity is VelocityMethod.KALMAN
    chosen, of_another = velocity_stage(profile), velocity_stage(load_profile("icube"))
    assert chosen[1] is not of_another[1]


@pytest.mark.long("journey")
def test_a_marker_extractor_is_chosen_by_a_rig_and_finds_the_marker(save):
    from app.tracking.markers.choice import extractors
    from app.tracking.optics.rig import load_rig
    from app.tracking.simulated.cameras import NeedleRenderer
    from app.tracking.simulated.scene import MarkerScene

    save("How to add a marker extractor", "extractors")
    rig = load_rig("wide").model_copy(update={"extractor": "strongest_spot"})
    axis = unit(np.array([0.2, 0.1, -1.0]))
    tip = np.array([0.0, 0.16056, 0.090]) + 0.05 * axis
    scene = MarkerScene.from_tip(tip, axis, rig.needle.marker_offset)
    for number, (model, found) in enumerate(zip(rig.models, extractors(rig), strict=True)):
        renderer = NeedleRenderer(model, rig.needle, rig.blur_px, number).even(115)
        (fix,) = found.search(renderer.render(scene))
        assert fix.uv == pytest.approx(model.pixel(scene.p_world), abs=1.0)
        assert found.mask(renderer.render(scene)).sum() > 50


def test_an_unknown_extractor_is_refused_with_the_known_ones(save):
    from app.tracking.errors import TrackingError
    from app.tracking.markers.choice import extractors
    from app.tracking.optics.rig import load_rig

    save("How to add a marker extractor", "extractors")
    known = "ellipse, model_fit, outline_centroid, strongest_spot, thesis"
    with pytest.raises(TrackingError, match=f"no marker extractor 'magic'; there are {known}"):
        extractors(load_rig("wide"), "magic")


@pytest.mark.long("journey")
def test_a_remedy_is_offered_and_reads_a_ct(save, tmp_path):
    from app.exercises.schema import Exercise
    from app.exercises.writing import schema_document
    from app.imaging.reading import read_again, read_with
    from app.imaging.scanning import scan_folder

    save("How to add a CT remedy", "remedies")
    Slices(offsets=(0.0, 2.0, 4.0, 6.0, 9.0, 12.0)).write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    assert series.remedies == ("resample", "longest_run")
    volume = read_with(series, "longest_run")
    assert volume.size == (*series.size[:2], 4)
    assert volume.made == ("the longest even run: 4 of 6 slices",)
    again = read_again(series, volume.recipe)
    np.testing.assert_array_equal(again.hu, volume.hu)
    whole = schema_document()["$defs"]["Ct"]["properties"]["remedy"]["enum"]
    assert whole == ["none", "resample", "straighten", "halve", "longest_run"]
    ct = {"folder": str(tmp_path / "ct"), "remedy": "longest_run"}
    plan = {"entry_mm": [0, -90, 300], "target_mm": [5, -20, 300]}
    exercise = Exercise.model_validate({"id": "run", "title": "Run", "ct": ct, "plan": plan})
    assert exercise.ct.remedy == "longest_run"
    helped = subprocess.run(
        [sys.executable, "-m", "app", "ct", "digest", "--help"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert "halve (too large), longest_run (uneven slices)." in " ".join(helped.stdout.split())


@pytest.mark.long("journey")
def test_a_machine_points_the_needle_in_a_whole_attempt(tmp_path, monkeypatch):
    from machine_records import Made, make

    from app.compose.plugins import plugin_files
    from app.compose.recomputed import replay_recording
    from app.mechanisms.profile import kinds
    from app.planning.limits import ReachLimits
    from app.session.recording import read_recording
    from app.views.scene.robot import RobotShape

    for place, text in files(sections()["How to add a machine"]).items():
        path = tmp_path / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    monkeypatch.setenv("ACUS_MECHANISMS", str(tmp_path / "mechanisms"))
    assert "gimbal" in kinds()
    (listed,) = (one for one in plugin_files() if one.kind == "machine")
    assert (listed.name, listed.refused) == ("gimbal", "")
    assert "gimbal as a machine" in listed.title
    path = tmp_path / "profiles" / "bench_gimbal.yaml"
    profile = load_profile(path)
    axis = unit((0.3, -0.2, -0.9))
    assert profile.machine.axis(profile.machine.usable(axis)) == pytest.approx(axis)
    assert ReachLimits.of(profile).holds(axis)
    assert len(RobotShape.of(profile, profile.machine.usable(axis)).links()) == 2
    laws = {"fixture": {}, "compensation": {}, "impedance": {}}
    made = Made(str(path), laws, ("lateral_tissue",))
    recording = read_recording(make(made, tmp_path / "records"))
    report = replay_recording(recording)
    assert report.identical, report.sentences()
    assert np.abs(recording.inputs.column("torque_left")).max() > 1e-3
    assert not recording.inputs.column("fault").any()
