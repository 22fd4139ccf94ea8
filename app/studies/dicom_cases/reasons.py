"""Whether a refusal is right, by what pydicom says of the same file."""

from collections.abc import Callable, Sequence
from typing import Any

Fact = dict[str, Any]

_SECONDARY = "1.2.840.10008.5.1.4.1.1.7"


def justified(reason: str, facts: Sequence[Fact]) -> bool:
    """Whether the reason given for a refusal is true.

    Args:
        reason: in the program's words.
        facts: what pydicom says of the files; empty where it cannot read them.
    """
    for words, holds in _RULES:
        if words in reason:
            return holds(reason, facts)
    return False


def _modality(reason: str, facts: Sequence[Fact]) -> bool:
    said = reason.partition("modality")[2]
    return all((fact["modality"] or "none given") in said for fact in facts)


def _no_image(reason: str, facts: Sequence[Fact]) -> bool:
    return not facts or not any(fact["series"] for fact in facts)


def _damaged(reason: str, facts: Sequence[Fact]) -> bool:
    return not facts or any(not fact["pixels"] or None in fact["planes"] for fact in facts)


def _geometry(reason: str, facts: Sequence[Fact]) -> bool:
    return len(facts) > 1 or any(fact["frames"] > 1 for fact in facts)


def _any(holds: Callable[[Fact], bool]) -> Callable[[str, Sequence[Fact]], bool]:
    return lambda reason, facts: any(holds(fact) for fact in facts)


_RULES: tuple[tuple[str, Callable[[str, Sequence[Fact]], bool]], ...] = (
    ("not CT", _modality),
    ("not a DICOM file", _no_image),
    ("no SeriesInstanceUID", _no_image),
    ("empty file", _no_image),
    ("DICOM directory", lambda reason, facts: True),
    ("picture", _any(lambda fact: fact["samples"] != 1 or "MONO" not in fact["photometric"])),
    ("secondary capture", _any(lambda fact: fact["sop_class"].startswith(_SECONDARY))),
    ("localizer", _any(lambda fact: "LOCALIZER" in fact["image_type"])),
    ("perfusion", _any(lambda fact: "PERFUSION" in fact["image_type"])),
    ("frames are described", _any(lambda fact: None in fact["planes"])),
    ("truncated", _damaged),
    ("damaged", _damaged),
    ("no pixels", _any(lambda fact: not fact["pixels"])),
    ("Hounsfield", _any(lambda fact: not fact["rescale"])),
    ("ImagePositionPatient", _any(lambda fact: None in fact["planes"])),
    ("single slice", lambda reason, facts: len(facts) == 1 and facts[0]["frames"] == 1),
    ("doubled", _geometry),
    ("same position", _geometry),
    ("gap", _geometry),
    ("uneven", _geometry),
    ("mixed", _geometry),
    ("multi-frame", _any(lambda fact: fact["frames"] > 1)),
)
"""Words of a reason, and what must hold for it to be right."""
