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


class Answer(StrEnum):
    """What can be done."""

    GO_ON = "go_on"
    ASPIRATE = "aspirate"
    TURN = "turn"
    OXYGEN = "oxygen"
    DRAIN = "drain"
    STOP = "stop"


ANSWER_WORDS: Final = {
    Answer.GO_ON: sentence("go on through the outer needle, and watch"),
    Answer.ASPIRATE: sentence("withdraw into the pleural space and aspirate"),
    Answer.TURN: sentence("turn the patient, puncture side down"),
    Answer.OXYGEN: sentence("give oxygen"),
    Answer.DRAIN: sentence("place a chest drain"),
    Answer.STOP: sentence("stop and call for help"),
}


class Verdict(StrEnum):
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
class Row:
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
    right: frozenset[Answer]
    helps: frozenset[Answer]
    source: str

    def verdict(self, answer: Answer) -> Verdict:
        """Return what an answer is worth."""
        if answer in self.right:
            return Verdict.RIGHT
        return Verdict.HELPS if answer in self.helps else Verdict.WRONG


def _of(*answers: Answer) -> frozenset[Answer]:
    return frozenset(answers)


SMALL: Final = Row(
    "small",
    Kind.PNEUMOTHORAX,
    1,
    sentence("pneumothorax of less than 20 mm, no symptoms"),
    _of(Answer.GO_ON),
    _of(Answer.OXYGEN, Answer.TURN, Answer.ASPIRATE, Answer.STOP),
    f"{KSTR}; {REVIEW}",
)
MEDIUM: Final = Row(
    "medium",
    Kind.PNEUMOTHORAX,
    2,
    sentence("pneumothorax of 20 mm or more"),
    _of(Answer.ASPIRATE),
    _of(Answer.OXYGEN, Answer.TURN, Answer.DRAIN, Answer.STOP),
    f"{REVIEW}; {CHAN}",
)
LARGE: Final = Row(
    "large",
    Kind.PNEUMOTHORAX,
    3,
    sentence(
        "pneumothorax of 30 mm or more, or one with a saturation below 92 %, or one that came back "
        "after aspiration"
    ),
    _of(Answer.DRAIN),
    _of(Answer.OXYGEN, Answer.ASPIRATE, Answer.STOP),
    f"{REVIEW}; {CHAN}",
)
BLOOD: Final = Row(
    "blood",
    Kind.BLEEDING,
    1,
    sentence("blood about the needle's way, none coughed"),
    _of(Answer.GO_ON),
    _of(Answer.OXYGEN, Answer.TURN, Answer.STOP),
    f"{KSTR}; {TAI}",
)
MORE_BLOOD: Final = Row(
    "more_blood",
    Kind.BLEEDING,
    2,
    sentence("blood coughed, or more than 2 cm about the needle's way"),
    _of(Answer.TURN, Answer.STOP),
    _of(Answer.OXYGEN),
    f"{KSTR}; {TAI}",
)

TABLE: Final = (SMALL, MEDIUM, LARGE, BLOOD, MORE_BLOOD)

ROWS: Final = {row.name: row for row in TABLE}


def row_of_air(rim_mm: float, has_symptoms: bool, in_vain: bool) -> Row:
    """Return the row of a pneumothorax.

    Args:
        rim_mm: largest depth of air between chest wall and lung.
        has_symptoms: whether the patient is short of air.
        in_vain: whether it was aspirated and came back.
    """
    if rim_mm >= DRAIN_FROM_MM or has_symptoms or (in_vain and rim_mm > 0.0):
        return LARGE
    return MEDIUM if rim_mm >= ASPIRATE_FROM_MM else SMALL


def row_of_blood(higher: bool, coughs: bool) -> Row:
    """Return the row of a bleeding, by its grade and whether blood is coughed."""
    return MORE_BLOOD if higher or coughs else BLOOD
