"""Which drill an attempt calls for: what cost most, as far as it can be practised alone."""

from __future__ import annotations

import json
from typing import Final

from app.core.errors import AcusError
from app.exercises.drill import DrillKind
from app.exercises.guidance import Purpose
from app.exercises.parts import OF_OWN_PLANS
from app.exercises.schema import Exercise
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.result import Score
from app.session.along_path import AlongPath
from app.session.conditions import EXERCISE_FILE
from app.session.machine import State
from app.session.reasons import ACROSS, ALONG, AttemptEvidence, pushed_outside
from app.session.recording import Recording

_TIMES: Final = frozenset({"total_time", "aligning_time"})


def exercise_in(recording: Recording) -> Exercise | None:
    """Return the exercise that a record holds, on the built-in patient: which one it was of is no
    part of it. None where it is another version's, or damaged.
    """
    try:
        document = json.loads(recording.attachments[EXERCISE_FILE])
        return Exercise.model_validate(document | {"ct": {"phantom": {}}})
    except (KeyError, TypeError, ValueError, AcusError, RecursionError):
        return None


def drill_for(
    score: Score | None, past: AttemptEvidence, exercise: Exercise | None
) -> DrillKind | None:
    """Return the drill for what cost most; None where nothing did, or there is no drill for it.

    Args:
        score: of the attempt; None where nothing was judged.
        past: what its record holds.
        exercise: as the record holds it. An assessment is not practised on its own patient.
    """
    if score is None or not score.losses or exercise is None:
        return None
    if exercise.purpose is Purpose.ASSESSMENT:
        return None
    if exercise.touch is not None:
        return DrillKind.REPEAT
    metric, way = score.losses[0][1].name, past.way
    if metric in OF_OWN_PLANS:  # a drill is given its plan: what is to be practised is the whole
        return None
    if metric == "breath_offset" or (metric in ACROSS | ALONG and pushed_outside(past) is not None):
        return DrillKind.BREATH
    if metric == "angle_at_skin" or (metric in ACROSS and _begun_askew(past)):
        return DrillKind.ALIGN
    if metric == "depth_error":
        return DrillKind.DEPTH
    if metric in _TIMES and _mostly_aligning(way):
        return DrillKind.ALIGN
    return DrillKind.REPEAT


def _begun_askew(past: AttemptEvidence) -> bool:
    """Return whether the tilt at the skin was more than what passes as good."""
    row = past.way.at_skin()
    bands = past.tolerances.get("angle_at_skin") or past.tolerances.get("angle_error")
    good = (bands or DEFAULT_TOLERANCES["angle_error"]).good
    return row is not None and float(past.way.tilt_deg[row]) > good


def _mostly_aligning(way: AlongPath) -> bool:
    lasted = way.lasted()
    return lasted[State.ALIGNING.value] > 0.5 * sum(lasted.values())
