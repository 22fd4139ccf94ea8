"""Which steps of an intervention an exercise teaches: read off what it asks for, told to people."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from app.core.messages import sentence
from app.exercises.guidance import GuidanceMode
from app.exercises.schema import Exercise


def _has(part: str) -> Callable[[Exercise], bool]:
    return lambda exercise: getattr(exercise.procedure, part, None) is not None


STEPS: Final[tuple[tuple[str, str, Callable[[Exercise], bool]], ...]] = (
    ("checklist", sentence("checklist: consent and coagulation"), _has("checklist")),
    ("own_path", sentence("choosing the path"), lambda exercise: exercise.is_own_plan),
    (
        "lung_path",
        sentence("the path report of a lung biopsy"),
        lambda exercise: exercise.asks_lung_path,
    ),
    ("grid", sentence("the entry by a marker grid"), _has("grid")),
    (
        "control_scans",
        sentence("the way in by control scans"),
        lambda exercise: exercise.guidance_mode is GuidanceMode.CONTROL_CT,
    ),
    ("anaesthetic", sentence("local anaesthetic down to the membrane"), _has("anaesthetic")),
    (
        "pause",
        sentence("the pause before the membrane"),
        lambda exercise: "pause_before_pleura" in exercise.tolerances,
    ),
    ("biopsy", sentence("samples through a coaxial needle"), _has("biopsy")),
    ("complications", sentence("noticing and answering complications"), _has("complications")),
    ("ablation", sentence("several electrodes and the generator"), _has("ablation")),
    ("rollover", sentence("turning the patient puncture side down"), _has("rollover")),
)
"""Name, words and test of each step, in the order in which they are done."""

NOTHING: Final = sentence("no step of an intervention: the way of the needle, or tool, alone")


def taught(exercise: Exercise) -> tuple[str, ...]:
    """Return the names of the steps that an exercise teaches, in their order."""
    return tuple(name for name, _, asks in STEPS if asks(exercise))


def taught_words(exercise: Exercise) -> tuple[str, ...]:
    """Say which steps an exercise teaches, one each; that there is none where there is none."""
    return tuple(words for _, words, asks in STEPS if asks(exercise)) or (NOTHING,)
