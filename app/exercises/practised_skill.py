"""Which skill an exercise practises, by what it says: the start page's map groups by it.

No exercise names its skill, so that those of one's own stand in the map as well. What the exercise
asks for most decides: another machine, then the plan or the control scans that lead, then what must
not be come near, then the breath; what is left is practised by the hand alone.
"""

from __future__ import annotations

from enum import StrEnum
from functools import lru_cache
from pathlib import Path
from typing import Final

from app.core import paths, plugin_folders
from app.core.configuration import parse_yaml, read_text
from app.core.errors import ConfigurationError
from app.exercises.guidance import GuidanceMode
from app.exercises.schema import Exercise
from app.mechanisms.profile.device import DEFAULT_KIND

KEPT_CLEAR: Final = "forbidden_region"
"""Law by which a robot keeps the needle out of a region."""


class PractisedSkill(StrEnum):
    """What an exercise practises most, in the order in which the map shows them."""

    HAND = "hand"
    BREATH = "breath"
    CLEARANCE = "clearance"
    PLAN = "plan"
    PROCEDURE = "procedure"
    MACHINE = "machine"


def practised_skill(exercise: Exercise) -> PractisedSkill:
    """Return the skill that an exercise practises most."""
    if exercise.touch is not None or _kind(exercise.device) != DEFAULT_KIND:
        return PractisedSkill.MACHINE
    if exercise.procedure is not None:
        return PractisedSkill.PROCEDURE
    if exercise.is_own_plan or exercise.guidance_mode is GuidanceMode.CONTROL_CT:
        return PractisedSkill.PLAN
    if KEPT_CLEAR in exercise.laws or any(part.risks for part in exercise.structures):
        return PractisedSkill.CLEARANCE
    return PractisedSkill.BREATH if "breathing" in exercise.effects else PractisedSkill.HAND


def is_lesson(exercise: Exercise) -> bool:
    """Return whether an exercise is one of the lessons; those of research machines are none."""
    return practised_skill(exercise) is not PractisedSkill.MACHINE


@lru_cache(maxsize=64)
def _kind(device: str) -> str:
    """Return what kind of machine a profile, named or given by its path, says that it is."""
    shared = (folder.path for folder in plugin_folders.folders())
    files = [place / "devices" / f"{device}.yaml" for place in (paths.resources(), *shared)]
    file = next((one for one in files if one.is_file()), Path(device))
    try:
        content = parse_yaml(read_text(file), device)
    except ConfigurationError:
        return DEFAULT_KIND  # whoever begins the exercise is told what is wrong with its device
    return str(content.get("kind", DEFAULT_KIND)) if isinstance(content, dict) else DEFAULT_KIND
