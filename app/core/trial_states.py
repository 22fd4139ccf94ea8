"""What a compiled stage is given in a trial, and what is wrong with what it does there.

Ten thousand states in runs of twenty: a needle that a hand moves, then faults, odd numbers in some
slots and in all, with memory that goes on within a run. Every run follows from its number, so that
a state can be named by whoever knows its number.
"""

from __future__ import annotations

import sys
import traceback
import warnings
from collections.abc import Collection, Sequence
from pathlib import Path
from types import FrameType
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.trial_watch import SECONDS, Watch

RUN: Final = 20
STATES: Final = 10_000
"""States that a trial gives."""

ODD: Final = (
    *(np.nan, np.inf, -np.inf, 0.0, -0.0, 1.0, -1.0, 0.5, 1e6, -1e6, 2.0**31, -(2.0**63)),
    *(1e308, -1e308, 1e-308, 5e-324),
)
_CODES: Final = 20  # of faults and of statuses
_FAULTS: Final = (
    *("fault", "kinematics", "link_status", "board_error", "machine_fault", "encoder_fault"),
    *("input_fault", "let_go", "unbelieved"),
)


def run_of(number: int) -> tuple[FloatArray, list[str]]:
    """Return the states of a run, shape (RUN, SLOTS), and each in words."""
    rng = np.random.default_rng((2, number))
    states = rng.normal(0.0, 0.1, (RUN, sv.SLOTS))
    axis = rng.normal(size=3) - (0.0, 0.0, 3.0)
    if number % 4 == 0:  # as a hand moves it
        states = states[0] + np.cumsum(1e-2 * states, axis=0)
        axis = axis + np.cumsum(rng.normal(0.0, 1e-3, (RUN, 3)), axis=0)
    depth = rng.uniform(-0.03, 0.12)
    states[:, sv.AXIS] = axis / np.linalg.norm(axis, axis=-1, keepdims=True)
    states[:, sv.PATH] = 0.0, 0.0, -1.0
    states[:, sv.DEPTH], states[:, sv.L_OUT] = depth, 0.2 - depth
    states[:, sv.PLANT_DEPTH] = states[:, sv.DEPTH_LEAST] = states[:, sv.DEPTH_MOST] = depth
    states[:, sv.L_IN] = rng.uniform(0.09, 0.12)
    states[:, sv.Q] = states[:, sv.PLANT_Q] = rng.uniform(0.0, np.pi, 2)
    states[:, sv.DT] = 1e-3
    states[:, sv.TIME] = 10.0 ** rng.uniform(0.0, 5.0) + 1e-3 * np.arange(RUN)
    states[:, sv.TICK] = np.round(1e3 * states[:, sv.TIME])
    states[:, sv.ENABLED] = states[:, sv.ARMING] = 1.0
    states[:, sv.ASSISTANCE] = rng.uniform(-1.0, 1.0)
    faults = [sv.INDEX[name] for name in _FAULTS]
    states[:, faults] = 0.0
    states[:, list(sv.SUMS)] = 0.0
    said = ["an ordinary state"] * RUN
    if number % 4:
        first = (number - number // 4 - 1) * (RUN // 4)  # of its kind, over all such runs
        for k in range(1, RUN):
            said[k] = _spoil(states[k], rng, k % 4, first + k // 4, faults) or said[k]
    return states, said


def _spoil(
    state: FloatArray, rng: np.random.Generator, kind: int, number: int, faults: list[int]
) -> str:
    """Make a state a fault or odd; return it in words, or nothing where it stays as it is."""
    if kind == 1:
        code, which = number % _CODES, number // _CODES % (len(faults) + 1)
        slots = faults[which : which + 1] or faults
        state[slots] = code
        return f"code {code} in {_FAULTS[which] if which < len(faults) else 'every fault'}"
    if kind == 2:
        odd = np.unique(rng.integers(0, sv.SLOTS, rng.integers(1, 12)))
        state[odd] = rng.choice(ODD, len(odd))
        return ", ".join(f"{_name(slot)} = {state[slot]:g}" for slot in odd.tolist()[:4])
    if kind == 3:
        state[:] = rng.choice(ODD) if number % 2 else rng.choice(ODD, sv.SLOTS)
        return f"{state[0]:g} in every slot" if number % 2 else "odd numbers in every slot"
    return ""


def words(number: int) -> str:
    """Say what a state of the trial is, by its number."""
    return run_of(number // RUN)[1][number % RUN]


class StageTrial:
    """One compiled stage of a file on trial.

    Args:
        path: of the file, for messages.
        name: of the stage, likewise.
        function: compiled with `core.compiled.stage`.
        arrays: of parameters as it may get them; each run begins with a fresh copy of one.
        writes: slots that it may write.
        watch: ends the process where it does not return.
    """

    def __init__(
        self,
        path: Path,
        name: str,
        function: Any,
        arrays: Sequence[FloatArray],
        writes: Collection[int],
        watch: Watch,
    ) -> None:
        self.path, self.name, self.function = path, name, function
        self.arrays, self.writes, self.watch = arrays, sorted(writes), watch
        self._others = np.ones(sv.SLOTS, bool)
        self._others[self.writes] = False
        self._state, self._p = sv.empty_state(), arrays[0]
        self._where = ""

    def reason(self) -> str:
        """Give it all states; return what is wrong with it, or nothing."""
        self.watch.doing(self.name)
        self.watch.begin()
        for run in range(STATES // RUN):
            states, said = run_of(run)
            p = self.arrays[run % len(self.arrays)].copy()
            for k, state in enumerate(states):
                number = run * RUN + k
                self._state, self._p = state.copy(), p.copy()
                self._where = f"trial, state {number}: {said[k]}"
                self.watch.state(number)
                if found := self._called(state, p):
                    return found
            if self.watch.late():
                return self._refusal(
                    0,
                    f"took too long: {number + 1} calls of {STATES} in {SECONDS:g} s; a tick has"
                    " 1 ms for all that runs in it",
                )
        self.watch.rest()
        allocated = _allocated(self.function, run_of(0)[0][0], self.arrays[0].copy())
        if allocated > _allocated(_nothing(), sv.empty_state(), np.zeros(1)):
            self._where = f"trial, state 0: {words(0)}"
            return self._refusal(
                0,
                "allocates memory in a tick; use numbers, and keep what it must remember in its"
                " parameters",
            )
        return ""

    def _called(self, state: FloatArray, p: FloatArray) -> str:
        try:
            self.function(state, p)
        except Exception as error:
            text = f"{type(error).__name__}: {error}".rstrip(": ")
            line, more = self._as_python(error)
            sizes = f"the state has {sv.SLOTS} slots, its parameters are {len(p)} numbers"
            advice = sizes if isinstance(error, IndexError) else "return without a force instead"
            return self._refusal(line, f"raises {more or text}; {advice}")
        changed = state.view(np.int64) != self._state.view(np.int64)
        if not (changed & self._others).any():
            return ""
        slots = np.flatnonzero(changed & self._others)
        line, _ = self._as_python(None)
        return self._refusal(
            line,
            f"writes {_listed(slots.tolist())}, which it does not declare; it may write"
            f" {_listed(self.writes)}",
        )

    def _refusal(self, line: int, misdeed: str) -> str:
        place = f"{self.path}, line {line}" if line else str(self.path)
        return f"{place}: {self.name} {misdeed} ({self._where})"

    def _as_python(self, error: Exception | None) -> tuple[int, str]:
        """Run the state again as Python; return the line that goes wrong (0: unknown) and what it
        raises there, if that is of the same kind.

        Args:
            error: that the compiled code raised; None if it wrote what it must not.
        """
        function = getattr(self.function, "py_func", None)
        if function is None:
            return 0, ""
        state, p, lines = self._state.copy(), self._p.copy(), [0]
        before, file = self._state.view(np.int64), str(self.path)

        def follow(frame: FrameType, event: str, argument: Any) -> Any:
            if frame.f_code.co_filename != file:
                return None
            if error is None and ((state.view(np.int64) != before) & self._others).any():
                raise _WrittenError
            lines[0] = frame.f_lineno
            return follow

        self.watch.doing(f"{self.name}, as Python,")
        sys.settrace(follow)
        try:
            with np.errstate(all="ignore"), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                function(state, p)
        except _WrittenError:
            return lines[0], ""
        except Exception as again:
            sys.settrace(None)
            if type(again) is not type(error):
                return 0, ""
            frames = traceback.extract_tb(again.__traceback__)
            line = next((f.lineno or 0 for f in reversed(frames) if f.filename == file), 0)
            return line, f"{type(again).__name__}: {again}".rstrip(": ")
        finally:
            sys.settrace(None)
        return 0, ""


class _WrittenError(Exception):
    """A slot was written that must not be."""


def _allocated(function: Any, state: FloatArray, p: FloatArray) -> int:
    """Count the pieces of memory that a call takes; the first call is not counted."""
    from numba.core.runtime import rtsys

    function(state.copy(), p)
    before = rtsys.get_allocation_stats().alloc
    function(state, p)
    return int(rtsys.get_allocation_stats().alloc - before)


def _nothing() -> Any:
    from app.core.compiled import stage

    return stage(lambda state, parameters: None)


def _listed(slots: list[int]) -> str:
    names = [_name(slot) for slot in slots[:8]]
    more = f" and {len(slots) - 8} more" if len(slots) > 8 else ""
    return ", ".join(names) + more or "nothing"


def _name(slot: int) -> str:
    return _NAMES.get(slot, f"slot {slot}")


_NAMES: Final = {slot: name for name, slot in sv.INDEX.items()}
