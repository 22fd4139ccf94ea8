"""`import acus`: the promised names and what they give. A change here is a breaking change."""

import inspect
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import acus
from app.scoring.rows import Row
from app.session.recording import read_recording
from tests.machine_records import FOLDER

ROOT = Path(acus.__file__).resolve().parents[1]
RECORD = FOLDER / "icube-fixture-tissue.mcap"

CLASSES = {
    "AcusError",
    "Event",
    "Exercise",
    "Kinematics",
    "Profile",
    "Record",
    "Replay",
    "Row",
    "Score",
    "Trial",
    "Verification",
    "Volume",
}

FUNCTIONS = {
    "exercise": "(name_or_path: 'str | Path') -> 'Exercise'",
    "exercises": "() -> 'tuple[Exercise, ...]'",
    "kinematics": "(profile: 'Profile | str | Path') -> 'Kinematics'",
    "phantom_ct": "(seed: 'int' = 1, *, slices: 'int' = 300, rows: 'int' = 512) -> 'Path'",
    "profile": "(name_or_path: 'str | Path') -> 'Profile'",
    "profiles": "() -> 'tuple[str, ...]'",
    "read_ct": "(folder: 'str | Path', series: 'str | None' = None) -> 'Volume'",
    "read_record": "(path: 'str | Path') -> 'Record'",
    "records": "(folder: 'str | Path | None' = None) -> 'tuple[Path, ...]'",
    "replay": "(path: 'str | Path') -> 'Replay'",
    "score": "(record: 'Record', exercise: 'Exercise | str | Path | None' = None) -> 'Score'",
    "skills": "() -> 'tuple[str, ...]'",
    "slice_plane": "(volume: 'Volume', centre_mm: 'ArrayLike', right: 'ArrayLike',"
    " down: 'ArrayLike', *, pixel_mm: 'float' = 1.0, columns: 'int' = 256, rows: 'int' = 256,"
    " interpolation: 'str' = 'trilinear', outside: 'float' = -1024.0) -> 'NDArray[np.float32]'",
    "try_exercise": "(exercise: 'Exercise | str | Path', skill: 'str' = 'expert',"
    " seed: 'int' = 1) -> 'Trial'",
    "verify": "(path: 'str | Path') -> 'Verification'",
}

MEMBERS = {
    "Event": {"data", "kind", "message", "time"},
    "Kinematics": {
        "centre",
        "forward",
        "inverse",
        "jacobian",
        "joint_ranges",
        "joint_torques",
        "reaches",
        "tip",
    },
    "Record": {
        "T_world_patient",
        "axis",
        "complete",
        "depth",
        "depth_source",
        "entry",
        "events",
        "force",
        "guidance",
        "id",
        "metadata",
        "phase",
        "problems",
        "target",
        "time",
        "tip",
        "tip_radius",
        "to_columns",
        "valid",
    },
    "Trial": {"exercise", "record", "score", "seed", "skill", "unscored"},
    "Volume": {
        "affine_mm",
        "hu",
        "made",
        "spacing_mm",
        "to_patient",
        "to_voxel",
        "unit",
        "value_at",
    },
}
"""Class -> all that it has."""

AT_LEAST = {
    "Replay": {"changes", "first_difference", "identical", "sentences", "ticks"},
    "Row": {"band", "label", "name", "note", "sd", "tolerance", "unit", "utility", "value"},
    "Score": {"document", "passed", "row", "rows", "total", "total_sd", "version", "void_reason"},
    "Verification": {"changes", "confirmed", "recomputed", "sentences", "written"},
}
"""Class of the program's own -> what of it is promised."""


def members(name):
    return {one for one in dir(getattr(acus, name)) if not one.startswith("_")}


def test_the_promised_names_and_arguments_are_these():
    assert set(acus.__all__) == {"__version__", *CLASSES, *FUNCTIONS}
    assert dir(acus) == sorted(acus.__all__)
    found = {name: str(inspect.signature(getattr(acus, name))) for name in FUNCTIONS}
    assert found == FUNCTIONS
    assert all(inspect.isclass(getattr(acus, name)) for name in CLASSES)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = acus.nothing


def test_the_promised_classes_have_these_members():
    assert {name: members(name) for name in MEMBERS} == MEMBERS
    assert [name for name in AT_LEAST if AT_LEAST[name] - members(name)] == []


def test_every_promised_name_is_explained():
    assert all(inspect.getdoc(getattr(acus, name)) for name in CLASSES | set(FUNCTIONS))
    assert (ROOT / "acus" / "py.typed").is_file()
    assert (ROOT / "app" / "py.typed").is_file()


IMPORT = """
import json, sys, time
before = time.process_time()
import acus
seconds = time.process_time() - before
acus.AcusError
heavy = {"numpy", "pydantic", "numba", "PySide6", "vtkmodules", "cv2"} & set(sys.modules)
print(json.dumps([seconds, sorted(heavy)]))
"""


def program(*arguments, check=True, **more):
    return subprocess.run(
        [sys.executable, *map(str, arguments)], capture_output=True, text=True, check=check, **more
    )


def test_importing_it_costs_nothing():
    own = os.environ | {"PYTHONPATH": str(ROOT)}
    runs = [json.loads(program("-c", IMPORT, env=own).stdout) for _ in range(3)]
    assert [heavy for _, heavy in runs] == [[], [], []]
    assert min(seconds for seconds, _ in runs) < 0.05


USED = """
import sys
import acus
record = acus.read_record(sys.argv[1])
acus.score(record)
acus.kinematics("icube")
acus.exercises()
print({"PySide6", "vtkmodules", "pyqtgraph", "cv2", "typer"} & set(sys.modules))
"""


@pytest.mark.long("journey")
def test_using_it_needs_no_window():
    own = os.environ | {"PYTHONPATH": str(ROOT)}
    assert program("-c", USED, RECORD, env=own).stdout.strip() == "set()"


def test_a_record_gives_what_the_program_reads():
    record, known = acus.read_record(RECORD), read_recording(RECORD)
    samples = known.samples
    for ours, theirs in (
        (record.tip, samples.tip),
        (record.axis, samples.axis),
        (record.depth, samples.depth),
        (record.force, samples.felt),
        (record.guidance, samples.guide),
        (record.time, samples.time - known.origin),
    ):
        np.testing.assert_array_equal(ours, theirs)
        assert not ours.flags.writeable
    assert [event.kind for event in record.events] == [event.kind for event in known.events]
    assert record.events[0].time == pytest.approx(0.0, abs=1e-9)
    assert record.events[-1].time <= float(record.metadata["result"]["duration_s"]) + 1e-9
    placed = known.placed_plan()
    entry = record.T_world_patient @ [*placed.plan.entry_mm * 1e-3, 1.0]
    assert entry[:3] == pytest.approx(record.entry, abs=1e-12)
    columns = record.to_columns()
    assert {values.shape for values in columns.values()} == {record.time.shape}
    np.testing.assert_array_equal(columns["tip_y_m"], record.tip[:, 1])


def test_a_record_hands_out_nothing_of_a_person():
    known, record = read_recording(RECORD), acus.read_record(RECORD)
    shown = json.dumps({name: dict(values) for name, values in record.metadata.items()})
    assert known.metadata["session"]["student"] == "tester"
    assert known.metadata["ct"]["pseudonym"] == "ct-1"
    assert "tester" not in shown + repr(record)
    assert "ct-1" not in shown + repr(record)


def test_a_score_has_the_written_values_and_is_judged_by_todays_or_other_rules():
    record = acus.read_record(RECORD)
    own, written = acus.score(record), acus.verify(RECORD).written
    values = {row.name: row.value for row in written.rows if row.tolerance}
    assert {row.name: row.value for row in own.rows if row.tolerance} == pytest.approx(values)
    assert written.total == pytest.approx(19.501686099885532)  # by the rules of its time
    assert own.total == 0.0  # it ended far from the target: what it was like does not count
    assert isinstance(own.rows[0], Row)
    other = acus.score(record, "scans-only")
    assert other.rules == acus.exercise("scans-only").rules
    assert {row.name for row in other.rows if row.tolerance} == set(
        acus.exercise("scans-only").tolerances
    )


def test_records_are_listed_and_verified_and_what_is_none_is_refused(tmp_path):
    assert acus.records(FOLDER) == tuple(sorted(FOLDER.glob("*.mcap")))
    assert acus.verify(FOLDER.parent / "records" / "20261120-080001-a001.mcap").confirmed
    with pytest.raises(acus.AcusError, match="not a folder"):
        acus.records(tmp_path / "none")
    with pytest.raises(acus.AcusError, match="cannot read"):
        acus.read_record(tmp_path / "none.mcap")


def test_a_replay_is_identical():
    report = acus.replay(RECORD)
    assert report.identical
    assert report.ticks >= 600


def test_an_unfinished_attempt_is_not_scored(tmp_path):
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(RECORD.read_bytes()[:-40_000])
    record = acus.read_record(cut)
    assert not record.complete
    with pytest.raises(acus.AcusError, match="was not finished"):
        acus.score(record)


@pytest.mark.long("machine")
def test_a_trial_is_a_record_that_scores_as_it_did():
    trial = acus.try_exercise("first-insertion", "expert", seed=2)
    assert (trial.exercise, trial.skill, trial.seed) == ("first-insertion", "expert", 2)
    assert acus.score(trial.record) == trial.score
    assert (np.diff(trial.record.time) > 0.0).all()
    assert set(trial.record.phase) == {"aligning", "inserting", "holding"}
    with pytest.raises(acus.AcusError, match="novice"):
        acus.try_exercise("first-insertion", "nobody")


@pytest.mark.parametrize("name", acus.profiles())
def test_kinematics_go_forth_and_back_and_torques_do_the_work_of_the_moment(name):
    machine = acus.kinematics(acus.profile(name))
    axis = np.array([0.12, -0.07, -1.0]) / np.linalg.norm([0.12, -0.07, -1.0])
    q = machine.inverse(axis)
    assert machine.forward(q) == pytest.approx(axis, abs=1e-9)
    assert machine.tip(q, 0.05) == pytest.approx(machine.centre + 0.05 * axis, abs=1e-10)
    step = 1e-6 * np.eye(2)
    rates = [(machine.forward(q + d) - machine.forward(q - d)) / 2e-6 for d in step]
    assert machine.jacobian(q) == pytest.approx(np.array(rates).T, abs=1e-6)
    moment = np.array([0.03, -0.02, 0.01])
    power = [moment @ np.cross(axis, rate) for rate in rates]
    assert machine.joint_torques(q, moment) == pytest.approx(power, abs=1e-7)
    assert not machine.reaches([0.0, 0.0, 1.0])
    with pytest.raises(acus.AcusError):
        machine.inverse([0.0, 0.0, 1.0])


@pytest.fixture(scope="module")
def ct():
    return acus.read_ct(acus.phantom_ct(seed=1, slices=12, rows=48))


def test_a_ct_has_its_places_and_a_plane_its_values(ct):
    assert ct.hu.shape == (12, 48, 48)
    assert ct.unit == "HU"
    ijk = np.array([[0, 0, 0], [20.5, 30.0, 4.25]])
    points = ct.to_patient(ijk)
    np.testing.assert_allclose(ct.to_voxel(points), ijk, atol=1e-9)
    np.testing.assert_allclose(points[1], (ct.affine_mm @ [*ijk[1], 1.0])[:3])
    assert ct.value_at(points[0]) == ct.hu[0, 0, 0]
    assert ct.value_at([9e3, 0.0, 0.0]) is None
    picture = acus.slice_plane(
        ct, points[1], [1.0, 0.2, 0.0], [0.0, 1.0, 0.6], pixel_mm=3.0, columns=61, rows=41
    )
    assert picture.shape == (41, 61)
    assert picture[20, 30] == pytest.approx(ct.value_at(points[1]), abs=0.01)
    right = np.array([1.0, 0.2, 0.0]) / np.hypot(1.0, 0.2)
    assert picture[20, 33] == pytest.approx(ct.value_at(points[1] + 9.0 * right), abs=0.01)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"interpolation": "linear"}, "nearest, trilinear, cubic"),
        ({"pixel_mm": 0.0}, "above 0"),
        ({"pixel_mm": float("nan")}, "above 0"),
        ({"columns": 0}, "no pixels"),
        ({"down": [2.0, 0.0, 0.0]}, "parallel"),
        ({"centre_mm": [np.nan, 0.0, 0.0]}, "finite"),
    ],
)
def test_a_plane_that_is_none_is_refused(ct, wrong, said):
    plane = {"centre_mm": [0.0, 0.0, 0.0], "right": [1.0, 0.0, 0.0], "down": [0.0, 1.0, 0.0]}
    with pytest.raises(acus.AcusError, match=said):
        acus.slice_plane(ct, **plane | wrong)


@pytest.fixture
def foreign(tmp_path):
    """A folder that holds another package `app`, which cannot be imported."""
    (tmp_path / "app" / "core").mkdir(parents=True)
    (tmp_path / "app" / "__init__.py").write_text("raise RuntimeError('another app')\n")
    (tmp_path / "app" / "__main__.py").write_text("raise SystemExit('another app')\n")
    return tmp_path


@pytest.fixture
def surroundings(foreign):
    """Environment in which the other one comes first."""
    return os.environ | {"PYTHONPATH": f"{foreign}{os.pathsep}{ROOT}"}


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "start",
    [("-m", "acus"), ("-c", "import sys; from acus.__main__ import main; sys.exit(main())")],
)
def test_another_app_in_the_way_does_not_matter_to_the_command(foreign, surroundings, start):
    done = program(*start, "exercise", "list", env=surroundings, cwd=foreign)
    assert "first-insertion" in done.stdout


TRIALS = """
import acus
print(acus.read_ct(acus.phantom_ct(slices=6, rows=32)).hu.shape)
from app.compose.first_start import COMMAND
print(COMMAND[1:])
from app.core.plugin_trial import import_fault
from pathlib import Path
print(repr(import_fault(Path("metric.py").resolve(), "app.scoring.metrics")))
"""


@pytest.mark.long("journey")
def test_another_app_in_the_way_does_not_matter_to_child_processes(foreign, surroundings):
    (foreign / "metric.py").write_text("from app.scoring.trajectory import Trajectory\n")
    done = program("-c", TRIALS, env=surroundings, cwd=foreign)
    shape, command, fault = done.stdout.splitlines()
    assert shape == "(6, 32, 32)"
    assert command == "('-P', '-W', 'ignore', '-m', 'app.compose.first_start')"
    assert fault == "''"


def test_another_app_that_was_imported_before_is_named(foreign, surroundings):
    (foreign / "app" / "__init__.py").write_text("")
    done = program("-c", "import app, acus", env=surroundings, cwd=foreign, check=False)
    assert done.returncode == 1
    last = done.stderr.splitlines()[-1]
    assert last.startswith("ImportError: another package named app is in use here")
    assert str(foreign / "app" / "__init__.py") in last


def test_the_installed_command_starts_here():
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert '[project.scripts]\nacus = "acus.__main__:main"\n' in text
    assert 'packages = ["app", "acus"]' in text
