"""A bounds-checked trial of one force law, in a process of its own.

The file is run as a program: it compiles the law with every index checked (in a cache of its own),
and gives it ten thousand states: NaN, infinities, zeros, huge and tiny numbers in any slot, every
fault, with parameters at their defaults, ends and between. It prints why the law is refused, or
nothing. A law that does not return is ended by the clock, one that crashes takes nothing with it.

The package around this file is not imported there: that would compile the whole loop.
"""

import importlib.util
import json
import os
import signal
import sys
import time
import types
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

if TYPE_CHECKING:
    from app.device.control.law import Law

STATES: Final = 10_000
"""States that the trial gives."""

SECONDS: Final = 10
"""Processor time that they may take together, once the law is compiled [s]."""

_ODD: Final = (np.nan, np.inf, -np.inf, 0.0, -0.0, 1.0, -1.0, 1e308, -1e308, 1e-308, 0.5, 1e6)
_CODES: Final = 20  # of faults and of statuses


def _main(path: Path) -> dict[str, object]:
    root = Path(__file__).parent
    bare = types.ModuleType("app.device.control")
    bare.__path__ = [str(root)]
    import app.device

    sys.modules[bare.__name__] = app.device.control = bare  # type: ignore[attr-defined]
    from app.device.control.law import read_law

    law, module = read_law(path), _load(path)
    tables = list(_tables(law, module))
    if not tables:
        return {"reason": "its parameters() answers for no values within the declared ranges"}
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
    began, reason = time.monotonic(), _try(law, module.step, tables)
    return {"reason": reason, "states": STATES, "seconds": round(time.monotonic() - began, 3)}


def _load(path: Path) -> Any:
    specification = importlib.util.spec_from_file_location(f"law_{path.stem}", path)
    if specification is None or specification.loader is None:
        raise ImportError(f"{path} is no Python file")
    module = importlib.util.module_from_spec(specification)
    sys.modules[specification.name] = module
    specification.loader.exec_module(module)
    return module


def _tables(law: "Law", module: Any) -> Iterator[Any]:
    """Arrays of parameters for the defaults, the ends and values between, of each shipped robot."""
    from app.core.errors import AcusError
    from app.core.paths import resources
    from app.mechanisms.profile import load_profile

    rng = np.random.default_rng(1)
    for path in sorted((resources() / "devices").glob("*.yaml")):
        profile = load_profile(path)
        for share in (None, 0.0, 1.0, *rng.uniform(size=5)):
            given = {
                key: limit.minimum + share * (limit.maximum - limit.minimum)
                for key, limit in law.parameters.items()
                if share is not None
            }
            for key, limit in law.parameters.items():
                if limit.default is None and key not in given:
                    given[key] = rng.uniform(limit.minimum, limit.maximum)
            try:
                yield np.array(module.parameters(law.checked(given, profile), profile), float)
            except AcusError:  # values that the law itself refuses
                continue


def _try(law: "Law", step: Any, tables: list[Any]) -> str:
    from app.core import state_vector as sv

    rng, kept = np.random.default_rng(2), np.ones(sv.SLOTS, bool)
    kept[[sv.INDEX[name] for name in law.writes]] = False
    for k in range(STATES):
        state = _state(rng, k)
        before = state.view(np.int64).copy()
        try:
            step(state, tables[k % len(tables)])
        except Exception as error:
            return f"in the trial, state {k}: {type(error).__name__}: {error}"
        changed = np.flatnonzero((state.view(np.int64) != before) & kept)
        if len(changed):
            names = [name for name, slot in sv.INDEX.items() if slot in changed]
            return f"in the trial it wrote {', '.join(names)}, which it does not declare"
    return ""


def _state(rng: np.random.Generator, k: int) -> Any:
    from app.core import state_vector as sv

    state = rng.normal(0.0, 0.1, sv.SLOTS)
    axis = rng.normal(size=3) - (0.0, 0.0, 3.0)
    state[sv.AXIS] = axis / np.linalg.norm(axis)
    state[sv.PATH] = 0.0, 0.0, -1.0
    depth = rng.uniform(-0.03, 0.12)
    state[sv.DEPTH], state[sv.L_OUT], state[sv.L_IN] = depth, 0.2 - depth, rng.uniform(0.09, 0.12)
    state[sv.TIME], state[sv.DT] = 10.0 + 1e-3 * k, 1e-3
    state[sv.ENABLED], state[sv.ARMING], state[sv.ASSISTANCE] = 1.0, 1.0, rng.uniform(-1.0, 1.0)
    state[sv.KINEMATICS] = state[sv.FAULT] = 0.0
    state[list(sv.SUMS)] = 0.0
    kind = k % 4
    if kind == 1:
        state[sv.FAULT] = state[sv.KINEMATICS] = state[sv.LINK_STATUS] = k // 4 % _CODES
    elif kind == 2:
        odd = rng.integers(0, sv.SLOTS, rng.integers(1, 12))
        state[odd] = rng.choice(_ODD, len(odd))
    elif kind == 3:
        state[:] = rng.choice(_ODD) if k % 8 == 3 else rng.choice(_ODD, sv.SLOTS)
    return state


if __name__ == "__main__":
    try:
        verdict = _main(Path(sys.argv[1]))
    except Exception as error:
        verdict = {"reason": f"in the trial: {type(error).__name__}: {error}"}
    sys.stdout.write("\n" + json.dumps(verdict))
    sys.stdout.flush()
    os._exit(0)  # whatever the file has left running
