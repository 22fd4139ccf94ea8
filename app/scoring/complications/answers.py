"""Answers to a complication, and which is right by its size and the patient's symptoms.

The table follows what guideline and reviews say in words; its limits in millimetres are those at
which they change their advice. A small pneumothorax without symptoms is watched, and the biopsy
goes on through the outer needle; a larger one is aspirated with the needle drawn back into the
pleural space; a large or symptomatic one, or one that comes back, is drained.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from app.core.messages import sentence

KSTR: Final = "Yoon et al. 2020, guideline of the Korean Society of Thoracic Radiology, PMC7817630"
REVIEW: Final = "review of pneumothorax after needle biopsy of the lung, 2021, PMC8001193"
CHAN: Final = "Chan et al. 2023, 102 aspirations, PMC10392636"
TAI: Final = "Tai et al. 2016, Radiology 279:287: grades of haemorrhage"

ASPIRATE_FROM_MM: Final = 20.0
"""Air of this depth is aspirated; of `DRAIN_FROM_MM` aspiration sufficed in half (CHAN)."""

DRAIN_FROM_MM: Final = 30.0


class Reaction(StrEnum):
    """What can be done."""

    GO_ON = "go_on"
    ASPIRATE = "aspirate"
    TURN = "turn"
    OXYGEN = "oxygen"
    DRAIN = "drain"
    STOP = "stop"


ANSWER_WORDS: Final = {
    Reaction.GO_ON: sentence("go on through the outer needle, and watch"),
    Reaction.ASPIRATE: sentence("withdraw into the pleural space and aspirate"),
    Reaction.TURN: sentence("turn the patient, puncture side down"),
    Reaction.OXYGEN: sentence("give oxygen"),
    Reaction.DRAIN: sentence("place a chest drain"),
    Reaction.STOP: sentence("stop and call for help"),
}


class AnswerWorth(StrEnum):
    """What an answer is worth."""

    RIGHT = "right"
    HELPS = "helps"
    """It does no harm and is not enough, or is more than is needed."""
    WRONG = "wrong"
    NOTHING_THERE = "nothing_there"
    """There is no complication."""


class Kind(StrEnum):
    """Which complication."""

    PNEUMOTHORAX = "pneumothorax"
    BLEEDING = "bleeding"


@dataclass(frozen=True, slots=True)
class GuidelineRow:
    """One row of the table.

    Attributes:
        name: for records.
        kind: of the complication.
        severity: 1 and up; within a kind a row of more severity follows on one of less.
        words: when it holds.
        right: answers that are right.
        helps: answers that do no harm and are not enough, or are more than is needed.
        source: who says so.
    """

    name: str
    kind: Kind
    severity: int
    words: str
    right: frozenset[Reaction]
    helps: frozenset[Reaction]
    source: str

    def verdict(self, answer: Reaction) -> AnswerWorth:
        """Return what an answer is worth."""
        if answer in self.right:
            return AnswerWorth.RIGHT
        return AnswerWorth.HELPS if answer in self.helps else AnswerWorth.WRONG


def _of(*answers: Reaction) -> frozenset[Reaction]:
    return frozenset(answers)


SMALL: Final = GuidelineRow(
    "small",
    Kind.PNEUMOTHORAX,
    1,
    sentence("pneumothorax of less than 20 mm, no symptoms"),
    _of(Reaction.GO_ON),
    _of(Reaction.OXYGEN, Reaction.TURN, Reaction.ASPIRATE, Reaction.STOP),
    f"{KSTR}; {REVIEW}",
)
MEDIUM: Final = GuidelineRow(
    "medium",
    Kind.PNEUMOTHORAX,
    2,
    sentence("pneumothorax of 20 mm or more"),
    _of(Reaction.ASPIRATE),
    _of(Reaction.OXYGEN, Reaction.TURN, Reaction.DRAIN, Reaction.STOP),
    f"{REVIEW}; {CHAN}",
)
LARGE: Final = GuidelineRow(
    "large",
    Kind.PNEUMOTHORAX,
    3,
    sentence(
        "pneumothorax of 30 mm or more, or one with a saturation below 92 %, or one that came back "
        "after aspiration"
    ),
    _of(Reaction.DRAIN),
    _of(Reaction.OXYGEN, Reaction.ASPIRATE, Reaction.STOP),
    f"{REVIEW}; {CHAN}",
)
BLOOD: Final = GuidelineRow(
    "blood",
    Kind.BLEEDING,
    1,
    sentence("blood about the needle's way, none coughed"),
    _of(Reaction.GO_ON),
    _of(Reaction.OXYGEN, Reaction.TURN, Reaction.STOP),
    f"{KSTR}; {TAI}",
)
MORE_BLOOD: Final = GuidelineRow(
    "more_blood",
    Kind.BLEEDING,
    2,
    sentence("blood coughed, or more than 2 cm about the needle's way"),
    _of(Reaction.TURN, Reaction.STOP),
    _of(Reaction.OXYGEN),
    f"{KSTR}; {TAI}",
)

TABLE: Final = (SMALL, MEDIUM, LARGE, BLOOD, MORE_BLOOD)

ROWS: Final = {row.name: row for row in TABLE}


def row_of_air(rim_mm: float, has_symptoms: bool, in_vain: bool) -> GuidelineRow:
    """Return the row of a pneumothorax.

    Args:
        rim_mm: largest depth of air between chest wall and lung.
        has_symptoms: whether the patient is short of air.
        in_vain: whether it was aspirated and came back.
    """
    if rim_mm >= DRAIN_FROM_MM or has_symptoms or (in_vain and rim_mm > 0.0):
        return LARGE
    return MEDIUM if rim_mm >= ASPIRATE_FROM_MM else SMALL


def row_of_blood(higher: bool, coughs: bool) -> GuidelineRow:
    """Return the row of a bleeding, by its grade and whether blood is coughed."""
    return MORE_BLOOD if higher or coughs else BLOOD
