"""What a trial gives to a compiled stage, what it finds wrong, and what of it is remembered."""

from pathlib import Path

import numpy as np
import pytest
from numba.core.runtime import _nrt_python

from app.core import state_vector as sv
from app.core import trial as core_trial
from app.core.compiled import is_stage, njit, stage
from app.core.trial import Trial
from app.core.trial_states import RUN, STATES, StageTrial, run_of, words
from app.core.trial_watch import PAGE, Watch, doing_in

PUSH = (sv.FORCE_X,)


class Unwatched(Watch):
    """Says what a trial does; ends nothing, for it is the test's own process."""

    def __init__(self):
        super().__init__(bytearray(PAGE))

    def doing(self, what, seconds=1.0):
        self.what = what

    def state(self, number):
        self.number = number

    def begin(self):
        self._began = np.inf


def found(function, size=3, path="plugin.py", writes=PUSH):
    return StageTrial(path, "step()", function, [np.zeros(size)], writes, Unwatched()).reason()


@pytest.fixture(autouse=True)
def counted():
    """Memory is counted in the process of a trial; here too."""
    _nrt_python.memsys_enable_stats()


def test_the_states_hold_every_fault_each_odd_number_in_each_slot_and_follow_from_their_number():
    seen, said = [], set()
    for run in range(STATES // RUN):
        states, texts = run_of(run)
        seen.append(states)
        said |= set(texts)
    rows = np.concatenate(seen)
    assert rows.shape == (STATES, sv.SLOTS)
    for name in ("fault", "kinematics", "link_status", "machine_fault", "encoder_fault"):
        assert set(range(20)) <= set(rows[:, sv.INDEX[name]].tolist()), name
    for odd in (np.inf, -np.inf, 1e308, -1e308, 5e-324, 2.0**31):
        assert (rows == odd).any(axis=0).all()
    assert np.isnan(rows).any(axis=0).all()
    assert {"an ordinary state", "code 7 in fault", "code 3 in every fault"} <= said
    assert {"nan in every slot", "odd numbers in every slot"} <= said
    again, texts = run_of(17)
    assert np.array_equal(again, seen[17], equal_nan=True)
    assert words(17 * RUN + 3) == texts[3]


@stage
def pushes(state, p):
    state[sv.FORCE_X] += p[0] * state[sv.TIME]


@stage
def arms_itself(state, p):
    if state[sv.DEPTH] > 0.0:
        state[sv.FORCE_X] += 1.0
        state[sv.ENABLED] = 2.0


@stage
def writes_outside(state, p):
    p[int(1000.0 * abs(state[sv.AXIS_Z]))] = 1.0


@stage
def writes_far_outside(state, p):
    state[100_000] += 1.0


@stage
def writes_outside_in_one_fault(state, p):
    if state[sv.FAULT] == 7.0:
        p[30] = 1.0


@stage
def raises(state, p):
    if np.isinf(state[sv.TIME]):
        raise ValueError("time has no end")


@stage
def allocates(state, p):
    kept = np.zeros(3)
    kept[int(state[sv.ENABLED]) % 3] = state[sv.TIME]
    state[sv.FORCE_X] = kept[0] + kept[1] + kept[2]


@njit
def helper(state):
    state[sv.HEARTBEAT] = 5.0


@stage
def lets_another_write(state, p):
    state[sv.FORCE_X] += 1.0
    helper(state)


def line_of(text):
    lines = Path(__file__).read_text(encoding="utf-8").splitlines()
    return next(k for k, line in enumerate(lines, 1) if line.strip() == text)


def test_a_stage_that_does_what_it_says_passes():
    assert found(pushes) == ""


WRONG = {
    arms_itself: ("state[sv.ENABLED] = 2.0", "writes enabled, which it does not declare; it may"),
    writes_outside: (
        "p[int(1000.0 * abs(state[sv.AXIS_Z]))] = 1.0",
        "out of bounds for axis 0 with size 3; the state has",
    ),
    writes_far_outside: ("state[100_000] += 1.0", "index 100000 is out of bounds"),
    writes_outside_in_one_fault: ("p[30] = 1.0", "index 30 is out of bounds"),
    raises: ('raise ValueError("time has no end")', "raises ValueError: time has no end; return"),
    lets_another_write: ("helper(state)", "writes heartbeat, which it does not declare"),
}


@pytest.mark.parametrize("function", WRONG, ids=lambda function: function.__name__)
def test_what_is_wrong_is_said_with_file_line_state_and_what_is_valid(function):
    text, reason = WRONG[function]
    said = found(function, path=__file__)
    assert said.startswith(f"{__file__}, line {line_of(text)}: step() ")
    assert reason in said
    assert "(trial, state " in said


def test_a_stage_that_allocates_is_refused_though_it_does_no_harm():
    said = found(allocates)
    assert said.startswith("plugin.py: step() allocates memory in a tick; use numbers")


def test_a_fault_is_named_where_it_happens():
    assert "code 7 in fault" in found(writes_outside_in_one_fault)


def test_files_of_others_check_every_index_wherever_they_run():
    from app.device.control.table import give_back_stage

    assert pushes.targetoptions.get("boundscheck") is True
    assert helper.targetoptions.get("boundscheck") is True
    assert not give_back_stage.targetoptions.get("boundscheck")
    with pytest.raises(IndexError, match="out of bounds"):
        writes_far_outside(sv.empty_state(), np.zeros(3))
    assert is_stage(pushes)
    assert not is_stage(helper)
    assert not is_stage(found)


PROGRAM = """
import importlib.util, os, sys
from app.core.errors import AcusError

def run(path, argument, watch):
    watch.doing("work()")
    spec = importlib.util.spec_from_file_location("tried", path)
    module = sys.modules["tried"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {"reason": module.work(argument) or "", "states": 1}
"""


@pytest.fixture
def trial(tmp_path, monkeypatch):
    """A trial whose program lies beside the plug-in."""
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    (tmp_path / "a_program.py").write_text(PROGRAM)
    core_trial._in_memory.clear()
    return Trial("a_program")


ENDS = {
    "for_ever": ("while True: pass", "in the trial work() did not return within 1 s"),
    "crash": ("import ctypes; ctypes.string_at(0)", "work() ended its process by SIGSEGV"),
    "leaves": ("import os; os._exit(0)", "work() ended its process with code 0; it must return"),
    "ends": ("raise SystemExit(3)", "work() does not work: SystemExit: 3 (trial)"),
    "memory": ("return str(len(bytearray(1 << 40)))", "work() does not work: MemoryError"),
}


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", ENDS)
def test_whatever_a_file_does_costs_its_own_process_alone(trial, tmp_path, name):
    body, reason = ENDS[name]
    path = tmp_path / "plugin.py"
    path.write_text(f"def work(argument):\n    {body}\n")
    assert reason in trial.fault(path)
    assert trial.fault(path).startswith(f"{path}: ")


@pytest.mark.long("journey")
def test_a_verdict_is_remembered_until_the_file_or_one_that_it_imports_changes(trial, tmp_path):
    path, other = tmp_path / "plugin.py", tmp_path / "beside.py"
    other.write_text("ANSWER = ''\n")
    path.write_text(
        "from beside import ANSWER\nprint('noise')\n\ndef work(argument):\n"
        "    return ANSWER or argument\n"
    )
    assert trial.known(path) == {}
    assert trial.fault(path) == ""
    assert str(other) in trial.known(path)["files"]
    assert trial.known(path, "of another device") == {}
    assert trial.fault(path, "of another device") == "of another device"
    other.write_text("ANSWER = 'refused now'\n")
    assert trial.known(path) == {}
    assert trial.fault(path) == "refused now"


@pytest.mark.long("journey")
def test_the_verdict_of_a_trial_that_did_not_say_what_it_imported_is_in_memory_alone(
    trial, tmp_path
):
    """Kept on disk it would stand when the file beside it, which ended the process, is mended."""
    path, beside = tmp_path / "plugin.py", tmp_path / "helper_beside.py"
    beside.write_text("import os\nos._exit(3)\n")
    path.write_text("import helper_beside\n\ndef work(argument):\n    return argument\n")
    assert "ended its process with code 3" in trial.fault(path)
    assert "code 3" in trial.known(path)["reason"]
    assert not list((tmp_path / "cache").rglob("verdicts/*.json"))
    beside.write_text("")
    core_trial._in_memory.clear()  # another start of the program
    assert trial.fault(path) == ""
    assert len(list((tmp_path / "cache").rglob("verdicts/*.json"))) == 1


@pytest.mark.long("journey")
def test_a_refusal_is_known_whatever_the_argument_was_until_the_file_changes(trial, tmp_path):
    path = tmp_path / "plugin.py"
    path.write_text("def work(argument):\n    return argument\n")
    assert trial.fault(path) == trial.refusal(path) == ""
    assert trial.fault(path, "not on this device") == "not on this device"
    assert trial.refusal(path) == "not on this device"
    path.write_text("def work(argument):\n    return ''\n")
    assert trial.refusal(path) == ""
    path.write_text("def work(argument):\n    import os; os._exit(3)\n")
    assert trial.fault(path) == trial.refusal(path) != ""
    path.write_text("def work(argument):\n    return None\n")
    assert trial.refusal(path) == ""


def test_the_words_for_what_is_done_fit_the_page_however_long_they_are():
    page = bytearray(PAGE)
    watch = Watch(page)
    watch.doing("x" * 10_000)
    watch.rest()
    assert doing_in(page) == "x" * (PAGE - 17)
