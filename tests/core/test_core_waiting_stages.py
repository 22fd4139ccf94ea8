"""Stages of the program that wait: compiled when they are called, looked at or put into a table."""

import os
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest

from app.core import compiled
from app.core.child_process import environment, interpreter
from app.core.loading import COMPILED
from app.device.control import kernel
from tools import compile_kernels

from numba.core.errors import NumbaError  # isort: skip  (after core.compiled)

DRIVERS = "acus_protocol", "haply_protocol", "cable_protocol", "simulated", "transport"
IMPORTED = f"""
from app.core.loading import COMPILED
import app.device.control.velocity
from app.device.links import {", ".join(DRIVERS)}
print(COMPILED.count)
"""


def doubled(state, p):
    """Add a stage's parameter twice."""
    state[0] += 2.0 * p[0]


@pytest.fixture
def own(monkeypatch):
    """Files of these tests are the program's own, and nothing else waits."""
    monkeypatch.setattr(compiled, "_OWN", os.path.join(os.path.dirname(__file__), ""))
    monkeypatch.setattr(compiled, "_WAITING", [])


@pytest.fixture
def waiting(own):
    """A stage of the program that nobody has asked for."""
    return compiled.stage(doubled)


def test_estimators_and_wires_that_nobody_asks_for_are_not_compiled(tmp_path: Path) -> None:
    surroundings = environment(ACUS_CACHE=str(tmp_path))
    surroundings.pop("NUMBA_CACHE_DIR", None)
    command = [*interpreter(), "-c", IMPORTED]
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["0"]


def test_a_stage_is_one_before_it_is_compiled_and_for_one_signature_after(waiting) -> None:
    assert compiled.is_stage(waiting)
    assert type(waiting) is compiled._WaitingStage
    state = np.zeros(1)
    for _ in range(2):
        waiting(state, np.full(1, 3.0))
    assert state.tolist() == [12.0]
    assert type(waiting) is not compiled._WaitingStage
    assert waiting.signatures == [compiled.STAGE_SIGNATURE.args]
    assert compiled.is_stage(waiting)
    with pytest.raises(TypeError, match="No matching definition"):
        waiting(state, 3)


def test_what_looks_at_a_stage_finds_it_compiled(waiting) -> None:
    assert waiting.signatures == [compiled.STAGE_SIGNATURE.args]


def test_a_kernel_that_calls_a_stage_gets_its_one_signature(waiting) -> None:
    caller = compiled.njit(lambda state, p: waiting(state, p), cache=False)
    state = np.zeros(1)
    caller(state, np.ones(1))
    assert state.tolist() == [2.0]
    assert waiting.signatures == [compiled.STAGE_SIGNATURE.args]


def test_a_table_runs_a_stage_that_waited_until_it_was_put_there(waiting) -> None:
    stages, parameters, state = kernel.no_stages(), kernel.no_parameters(), np.zeros(1)
    kernel.append(stages, parameters, waiting, np.ones(1))
    count = COMPILED.count
    kernel.run_stages(state, stages, parameters)
    kernel.run_stages(state, stages, parameters)
    assert state.tolist() == [4.0]
    assert type(waiting) is not compiled._WaitingStage
    assert COMPILED.count - count <= 1  # `run_stages` itself, for Python


def test_a_stage_that_several_threads_ask_for_is_compiled_once(waiting) -> None:
    states = np.zeros((4, 1))
    threads = [threading.Thread(target=waiting, args=(one, np.ones(1))) for one in states]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert states.ravel().tolist() == [2.0] * 4
    assert len(waiting.signatures) == 1


def test_a_stage_that_cannot_be_compiled_says_which_and_says_it_again(own) -> None:
    def impossible(state, p):
        state[0] = "words"

    stage = compiled.stage(impossible)
    for _ in range(2):
        with pytest.raises(NumbaError, match="impossible"):
            stage(np.zeros(1), np.zeros(1))


def test_a_stage_of_somebody_else_is_compiled_at_once() -> None:
    assert type(compiled.stage(doubled)) is not compiled._WaitingStage


def test_who_fills_the_cache_compiles_what_waits(waiting) -> None:
    compile_kernels.import_module_of("json")
    assert type(waiting) is not compiled._WaitingStage
