"""A recorded attempt's loop, built again from what its record has attached, and computed anew."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, Final

from app.compose import effect_models
from app.compose.exercise_field import recorded_field
from app.compose.needle_sources import recorded_table
from app.compose.trainer import TrainerSetup, loop_table
from app.core.configuration import parse
from app.core.messages import sentence
from app.device.control import Table
from app.exercises.schema import Exercise
from app.mechanisms.profile import parse_profile
from app.session.effect_models import ModelChoice
from app.session.errors import ReplayError
from app.session.recording import Recording
from app.session.replay import ReplayReport, is_simulated, replay


def replay_recording(recording: Recording) -> ReplayReport:
    """Recompute an attempt and compare it with its record; see `session.replay.replay`."""
    return replay(recording, replay_table, _changed_table)


def _changed_table(
    recording: Recording, running: Table, choices: Sequence[ModelChoice]
) -> effect_models.Exchange:
    """Build the table that a replay goes on with after the last of `choices`."""
    fresh = replay_table(recording, choices)
    return effect_models.exchange(running, fresh, choices[-1].effect)


def replay_table(recording: Recording, choices: Sequence[ModelChoice] = ()) -> Table:
    """Build the table of a record's loop; its numbers are taken from the checkpoint later.

    Of a real robot the stages of its link are left out: what they read is given from the record,
    and nothing is sent. `choices` are models of effects that were chosen while it ran.

    Raises:
        ReplayError: if an attachment is missing; names it.
        AcusError: if one cannot be used by this version.
    """
    exercise = as_then(parse(_exercise(recording), Exercise, "the record's exercise"), recording)
    for choice in choices:
        exercise = effect_models.with_model(exercise, choice.effect, choice.model)
    profile = parse_profile(_attached(recording, "device.json"), "the record's device")
    setup = TrainerSetup(
        exercise,
        recording.placed_plan(),
        skill=recording.metadata.get("trainee", {}).get("scripted") or None,
        seed=_seed(recording),
        tissues=recorded_field(recording),
    )
    of_source = recorded_table(
        recording.metadata, exercise, setup.placed, profile, setup.skill, setup.seed
    )
    if of_source is not None:
        return of_source
    return loop_table(setup, profile, simulated=is_simulated(recording))


_BEFORE: Final = {"punctures": {"shaft_friction": "dahl"}}
"""Slot -> effects whose default model was another one before there was that slot."""


def as_then(exercise: Exercise, recording: Recording) -> Exercise:
    """Return a record's exercise with the models that its effects had by default then."""
    start, effects = recording.inputs.checkpoint, dict(exercise.effects)
    for slot, models in _BEFORE.items():
        for name in models.keys() & effects.keys():
            if start is not None and slot not in start.slots and not effects[name].model:
                effects[name] = effects[name].model_copy(update={"model": models[name]})
    return exercise.model_copy(update={"effects": effects})


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
        raise ReplayError(
            sentence("this record cannot be replayed: it has no {name}", name=name)
        ) from error
    except (ValueError, RecursionError) as error:
        raise ReplayError(
            sentence(
                "this record cannot be replayed: {name} is damaged: {error}", name=name, error=error
            )
        ) from error


def _seed(recording: Recording) -> int:
    text = recording.metadata.get("session", {}).get("seed", "")
    try:
        return int(text)
    except ValueError as error:
        raise ReplayError(
            sentence("this record cannot be replayed: its seed is {seed!r}", seed=text)
        ) from error
