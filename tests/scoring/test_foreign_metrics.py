"""Whatever somebody else's metric does costs its own row; the program's own names stay its own."""

import json
import time
from pathlib import Path

import pytest
from scoring.scoring_attempts import Attempt
from typer.testing import CliRunner

from app.commands import build
from app.compose.plugins import refused_files
from app.core import plugin_trial
from app.core.plugin_trial import import_fault
from app.imaging.worker.limits import Allowance
from app.scoring import foreign
from app.scoring.metrics import available, find
from app.scoring.score import score, with_shown
from app.scoring.tolerance import Tolerance
from app.simulation import effects
from app.simulation.errors import SimulationError

DECLARED = """
DECLARATION = {"title": "T", "unit": "mm", "higher_is_better": False, "reads": ()}
"""
COMPUTES = f"""{DECLARED}
def compute(trajectory):
    return 4.5


def deviation(trajectory):
    return 0.25
"""
HARMFUL = {
    "leaves_at_import": ("import sys\nsys.exit(0)", "", "cannot be imported: it ends the program"),
    "ends_at_import": ("import os\nos._exit(0)", "", "ended with code 0"),
    "raises": ("", "raise ZeroDivisionError('no')", "compute() fails: ZeroDivisionError: no"),
    "leaves": ("", "raise SystemExit(3)", "compute() fails: it ends the program (SystemExit: 3)"),
    "interrupts": ("", "raise KeyboardInterrupt", "compute() fails: KeyboardInterrupt"),
    "ends": ("import os", "os._exit(7)", "ended with code 7"),
    "crashes": ("import ctypes", "ctypes.string_at(0)", "was ended by SIGSEGV"),
    "computes_for_ever": ("", "while True: pass", "took longer than 0.4 s of computing"),
    "waits_for_ever": ("import time", "time.sleep(1e6)", "waited longer than 2 s"),
    "takes_memory": ("", "return len(bytearray(1 << 40))", "compute() fails: MemoryError"),
    "gives_nothing": ("", "return None", "compute() fails: TypeError"),
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    for kind in ("metrics", "effects", "extractors", "remedies", "studies", "laws", "mechanisms"):
        (tmp_path / kind).mkdir()
        monkeypatch.setenv(f"ACUS_{kind.upper()}", str(tmp_path / kind))
    monkeypatch.setattr(foreign, "LIMIT", Allowance(0.4, 1 << 30, 2.0))
    monkeypatch.setattr(plugin_trial, "MOST", 1)
    return tmp_path


def save(folder: Path, name: str, head: str = "", body: str = "return 4.5") -> Path:
    path = folder / "metrics" / f"{name}.py"
    path.write_text(f"{head}\n{DECLARED}\n\ndef compute(trajectory):\n    {body}\n")
    return path


@pytest.mark.long("statistics")
def test_whatever_a_metric_does_costs_its_own_row_which_names_it_and_says_what(
    folder: Path,
) -> None:
    for name, (head, body, _) in HARMFUL.items():
        save(folder, name, head, body or "return 1.0")
    (folder / "metrics" / "fine.py").write_text(COMPUTES)
    trajectory = Attempt().trajectory()
    alone = score(trajectory)
    found = with_shown(alone, trajectory)
    assert found.rows[: len(alone.rows)] == alone.rows
    assert (found.total, found.passed) == (alone.total, alone.passed)
    for name, (_, _, words) in HARMFUL.items():
        row = found.row(name)
        assert row.value is None
        assert words in row.note, name
        assert f"{name}.py" in row.note
    assert (found.row("fine").value, found.row("fine").sd) == (4.5, 0.25)


@pytest.mark.long("statistics")
def test_what_cost_its_process_once_is_not_run_again_before_it_is_changed(folder: Path) -> None:
    path = save(folder, "waits", "import time", "time.sleep(1e6)")
    trajectory = Attempt().trajectory()
    assert "waited longer" in with_shown(score(trajectory), trajectory).row("waits").note
    started = time.monotonic()
    assert "waited longer" in with_shown(score(trajectory), trajectory).row("waits").note
    assert time.monotonic() - started < 1.0
    path.write_text(COMPUTES)
    assert with_shown(score(trajectory), trajectory).row("waits").value == 4.5


def test_a_metric_that_counts_and_ends_its_process_leaves_the_others_their_score(
    folder: Path,
) -> None:
    save(folder, "ends", "import os", "os._exit(7)")
    limits = {"expert": 1.0, "good": 2.0, "pass": 3.0, "weight": 1.0}
    tolerances = {"target_error": Tolerance(**limits), "ends": Tolerance(**limits)}
    found = score(Attempt().trajectory(), tolerances)
    assert found.total is not None
    assert "ended with code 7" in found.row("ends").note


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("metrics", "target_error"),
        ("metrics", "available"),
        ("metrics", "KIND"),
        ("extractors", "choice"),
        ("extractors", "ellipse"),
        ("remedies", "halve"),
        ("studies", "runner"),
        ("laws", "fixture"),
        ("effects", "breathing"),
    ],
)
def test_a_name_of_the_programs_own_cannot_be_taken(folder: Path, kind: str, name: str) -> None:
    path = folder / kind / f"{name}.py"
    path.write_text("raise SystemExit\n")
    (refused,) = refused_files()
    assert refused.path == path
    assert f"{name!r} is a name of the program's own; rename the file" in refused.refused
    assert score(Attempt().trajectory()).row("target_error").value is not None
    assert all(metric.is_own and not metric.fault for metric in available().values())
    assert find("target_error").is_own


def test_a_machine_of_the_programs_own_cannot_be_taken(folder: Path) -> None:
    (folder / "mechanisms" / "pantograph").mkdir()
    (refused,) = refused_files()
    assert "'pantograph' is a name of the program's own; rename the folder" in refused.refused


@pytest.mark.long("statistics")
def test_the_list_imports_each_file_in_a_process_of_its_own_and_says_what_rights_it_has(
    folder: Path,
) -> None:
    save(folder, "leaves", "import sys\nsys.exit(0)")
    save(folder, "ends", "import os\nos._exit(0)")
    save(folder, "computes_for_ever", "while True: pass")
    save(folder, "prints", "print('noise')")
    answer = CliRunner().invoke(build(), ["plugin", "list"])
    assert answer.exit_code == 3
    marks = {line.split(":")[0].split()[-1]: line for line in answer.stdout.splitlines()}
    assert marks["prints"].startswith("✔")
    assert marks["leaves"].startswith("✖")
    assert "it ends the program (SystemExit)" in marks["leaves"]
    assert "its process ended with code 0" in marks["ends"]
    assert "it had not come back after 1 s of computing" in marks["computes_for_ever"]
    assert "run with all your rights" in answer.stdout
    told = " ".join(CliRunner().invoke(build(), ["plugin", "--help"]).stdout.split())
    assert "They run with all your rights" in told
    rows = json.loads(CliRunner().invoke(build(), ["plugin", "list", "--json"]).stdout)
    assert "run with all your rights" not in json.dumps(rows)


EFFECT = """
from app.core.compiled import stage

DECLARATION = {
    "title": "T", "reads": (), "writes": ("force",), "consumers": ("hand",), "needs": (),
    "models": {"one": "x"}, "energy": ("active", "x"), "cost_class": "cheap", "parameters": {},
}


@stage
def step(state, parameters):
    pass


def parameters(values, binding):
    raise SystemExit
"""


@pytest.mark.long("statistics")
@pytest.mark.parametrize("line", ["raise SystemExit", "import os; os._exit(0)", "1 / 0"])
def test_an_effect_that_ends_the_program_at_import_is_refused_before_it_does(
    folder: Path, line: str
) -> None:
    (folder / "effects" / "mine.py").write_text(f"{EFFECT}\n{line}\n")
    with pytest.raises(SimulationError, match=r"mine\.py"):
        effects.load(effects.KIND.read(folder / "effects" / "mine.py"))


@pytest.mark.long("statistics")
def test_an_effect_whose_parameters_end_the_program_is_refused_by_name(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plugin_trial, "MOST", 6)  # it compiles, on a busy computer too
    (folder / "effects" / "mine.py").write_text(EFFECT)
    with pytest.raises(
        SimulationError, match=r"mine\.py: parameters\(\) does not work: SystemExit"
    ):
        effects.parameters_of("mine", {}, None)  # type: ignore[arg-type]


@pytest.mark.long("statistics")
def test_a_file_that_loops_at_import_costs_five_seconds_and_longer_on_a_slow_computer_alone(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert plugin_trial.SECONDS == 5
    loops = folder / "loops.py"
    loops.write_text("while True: pass")
    monkeypatch.setattr(plugin_trial, "SECONDS", 1)
    monkeypatch.setattr(plugin_trial, "MOST", 2)
    for times, taken in ((0, 1), (1000, 2)):  # numpy comes in no time, or takes its own
        monkeypatch.setattr(plugin_trial, "_failed", {})
        monkeypatch.setattr(plugin_trial, "TIMES", times)
        fault = import_fault(loops, "app")
        assert fault.startswith(f"it had not come back after {taken} s of computing; if it only")


@pytest.mark.long("statistics")
def test_a_machine_which_is_compiled_at_its_import_may_take_four_times_as_long(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plugin_trial, "SECONDS", 1)
    monkeypatch.setattr(plugin_trial, "MOST", 1)
    (folder / "slow").mkdir()
    machine = folder / "slow" / "machine.py"
    machine.write_text("import time\nwhile time.process_time() < 3.5: pass")
    assert import_fault(machine, "app") != ""
    monkeypatch.setattr(plugin_trial, "_failed", {})
    assert import_fault(machine, "app.mechanisms", folder) == ""


@pytest.mark.long("statistics")
def test_a_file_that_was_fine_is_not_tried_again_and_one_that_failed_is(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fine, broken = folder / "fine.py", folder / "broken.py"
    fine.write_text("x = 1")
    broken.write_text("import nothing_of_this_name")
    assert import_fault(fine, "app") == ""
    assert "ModuleNotFoundError" in import_fault(broken, "app")
    monkeypatch.setattr(plugin_trial, "_failed", {})
    monkeypatch.setattr(plugin_trial, "_tried", lambda *_: "tried again")
    assert import_fault(fine, "app") == ""
    assert import_fault(broken, "app") == "tried again"
    fine.write_text("x = 2")
    assert import_fault(fine, "app") == "tried again"
