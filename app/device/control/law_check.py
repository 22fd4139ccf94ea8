"""Whether somebody else's force law may run in the loop: by its text, then by a trial.

The verdict of a trial is kept by the digest of the file and of this program's kernels, so that a
start does not pay for it again.
"""

from __future__ import annotations

import hashlib
import json
import signal
import subprocess
from pathlib import Path
from typing import Any, Final

from app.core import compiled, paths
from app.core.child_process import environment, interpreter
from app.core.errors import AcusError
from app.core.files import write_atomically
from app.core.plugins import read_statements
from app.core.stage_check import Checked, RefusedStageError, check_stage
from app.device.control import law_trial
from app.device.control.law import Law
from app.device.errors import LawError

PATIENCE: Final = 120.0
"""Longest that a trial may take with its compilation [s]."""

_ENDED: Final = f"in the trial it did not return within {law_trial.SECONDS} s"


def check_text(law: Law) -> Checked:
    """Check a law's compiled functions by their text.

    Raises:
        LawError: with file, line and reason.
    """
    try:
        return check_stage(law.path, read_statements(law.path), law.writes)
    except RefusedStageError as refusal:
        raise LawError(str(refusal)) from refusal


def check(law: Law) -> Checked:
    """Check a law by its text and by a trial.

    Raises:
        LawError: with the file and why it is refused.
    """
    found = check_text(law)
    if reason := trial(law.path)["reason"]:
        raise LawError(f"{law.path}: {reason}")
    return found


def trial(path: Path) -> dict[str, Any]:
    """Verdict of the trial: `reason` (empty: accepted), `states` and `seconds` of a finished one.

    Taken from the cache where the same file has been tried by the same program.
    """
    if verdict := known(path):
        return verdict
    kept, verdict = _kept(path), _run(path)
    try:
        kept.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(kept, json.dumps(verdict).encode())
    except (OSError, AcusError):
        pass  # a cache that cannot be written: tried again next time
    return verdict


def known(path: Path) -> dict[str, Any]:
    """Verdict of a trial that was made before; empty if there was none."""
    try:
        verdict = json.loads(_kept(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    usable = isinstance(verdict, dict) and isinstance(verdict.get("reason"), str)
    return verdict if usable else {}


def _kept(path: Path) -> Path:
    digest = hashlib.sha256(compiled.kernels_digest().encode())
    digest.update(Path(law_trial.__file__).read_bytes())
    digest.update(path.read_bytes())
    return paths.cache() / "laws" / f"{digest.hexdigest()[:32]}.json"


def _run(path: Path) -> dict[str, Any]:
    own = paths.cache() / "trials" / compiled.kernels_digest()
    try:
        done = subprocess.run(
            [*interpreter(), law_trial.__file__, str(path)],
            env=environment(NUMBA_BOUNDSCHECK="1", NUMBA_CACHE_DIR=str(own)),
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return {"reason": f"in the trial it was not done after {PATIENCE:g} s"}
    if done.returncode != 0:
        ended = done.returncode == -getattr(signal, "SIGPROF", 0)
        why = f"in the trial its process ended with code {done.returncode}"
        return {"reason": _ENDED if ended else why}
    try:
        verdict: dict[str, Any] = json.loads(done.stdout.rsplit("\n", 1)[-1])
    except ValueError:
        verdict = {"reason": "in the trial its process ended without an answer"}
    return verdict
