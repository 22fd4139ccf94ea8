"""The loop's table of a recorded attempt, built again from what its record has attached."""

from __future__ import annotations

import json
from typing import Any

from app.compose.pen import pen_table
from app.compose.trainer import TrainerSetup, loop_table
from app.core.configuration import parse
from app.device.control import Table
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile
from app.session.errors import ReplayError
from app.session.recording import Recording
from app.session.replay import ReplayReport, is_simulated, replay


def replay_recording(recording: Recording) -> ReplayReport:
    """Recompute an attempt and compare it with its record; see `session.replay.replay`."""
    return replay(recording, replay_table)


def replay_table(recording: Recording) -> Table:
    """Build the table of a record's loop; its numbers are taken from the checkpoint later.

    Of a real robot the stages of its link are left out: what they read is given from the record,
    and nothing is sent.

    Raises:
        ReplayError: if an attachment is missing; names it.
        AcusError: if one cannot be used by this version.
    """
    exercise = parse(_exercise(recording), Exercise, "the record's exercise")
    profile = parse(_attached(recording, "device.json"), DeviceProfile, "the record's device")
    setup = TrainerSetup(
        exercise,
        recording.placed_plan(),
        skill=recording.metadata.get("trainee", {}).get("scripted") or None,
        seed=_seed(recording),
    )
    pen = recording.metadata.get("device", {}).get("pen")
    if pen:
        simulated = pen == "yes"
        return pen_table(
            exercise, setup.placed, profile, [], setup.skill, setup.seed, simulated=simulated
        )
    return loop_table(setup, profile, simulated=is_simulated(recording))


def _exercise(recording: Recording) -> Any:
    """Return the recorded exercise; a CT whose folder was left out is no part of the loop."""
    document = _attached(recording, "exercise.json")
    ct = document.get("ct") if isinstance(document, dict) else None
    if isinstance(ct, dict) and ct.get("phantom") is None and ct.get("folder") is None:
        return document | {"ct": ct | {"folder": "left-out"}}
    return document


def _attached(recording: Recording, name: str) -> Any:
    try:
        return json.loads(recording.attachments[name])
    except KeyError as error:
        raise ReplayError(f"this record cannot be replayed: it has no {name}") from error
    except (ValueError, RecursionError) as error:
        raise ReplayError(f"this record cannot be replayed: {name} is damaged: {error}") from error


def _seed(recording: Recording) -> int:
    text = recording.metadata.get("session", {}).get("seed", "")
    try:
        return int(text)
    except ValueError as error:
        raise ReplayError(f"this record cannot be replayed: its seed is {text!r}") from error
