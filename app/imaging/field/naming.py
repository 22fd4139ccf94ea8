"""What a structure's kind and name say about its tissue."""

from __future__ import annotations

from typing import Final

from app.imaging.field.tissue_field import TissueKind
from app.imaging.structures.structure import Structure, StructureKind

SMALL_VESSEL: Final = "small vessel"
"""Name of vessels under 2 mm radius: a needle may meet them."""

LUNG_VESSEL: Final = "lung vessel"
"""Name of vessels and airway walls within the lung."""

EMPHYSEMA: Final = "emphysema"
"""Name of destroyed lung."""

BRONCHUS: Final = "bronchus"
"""Name of airways within the lung, wall and lumen."""

_WORDS: Final = {
    TissueKind.BONE: (
        "bone",
        "rib",
        "vertebra",
        "sternum",
        "pelvis",
        "scapula",
        "clavicle",
        "spine",
        "sacrum",
        "femur",
        "humerus",
        "hip",
    ),
    TissueKind.HEART: ("heart", "ventricle", "atrium", "myocard"),
    TissueKind.VESSEL: (
        "vessel",
        "vein",
        "vena",
        "artery",
        "arteries",
        "aorta",
        "arterial",
        "venous",
        "cava",
        "portal",
        "iliac",
    ),
    TissueKind.GUT: (
        "gut",
        "bowel",
        "colon",
        "intestin",
        "stomach",
        "duodenum",
        "rectum",
        "jejunum",
        "ileum",
        "esophagus",
        "oesophagus",
        "gas",
    ),
    TissueKind.LUNG: ("lung", "trachea", "bronch", "emphysem"),
    TissueKind.MUSCLE: ("muscle", "diaphragm", "autochthon", "psoas", "gluteus", "cartilage"),
    TissueKind.FAT: ("fat", "adipose"),
    TissueKind.SKIN: ("skin",),
}

_LESIONS: Final = ("nodule", "lesion", "tumour", "tumor", "metastasis", "cyst", "target")
_ORGANS: Final = (
    "liver",
    "kidney",
    "spleen",
    "pancreas",
    "gallbladder",
    "adrenal",
    "bladder",
    "prostate",
    "uterus",
    "thyroid",
    "brain",
)


def kind_of(structure: Structure) -> TissueKind:
    """Return the tissue that a structure marks; an organ of its name where nothing else is said."""
    by_kind = {StructureKind.BONE: TissueKind.BONE, StructureKind.VESSEL: TissueKind.VESSEL}
    if structure.kind in by_kind:
        return by_kind[structure.kind]
    words = structure.name.casefold().replace("_", " ")
    if any(word in words for word in _LESIONS):  # a lung nodule is no lung
        return TissueKind.ORGAN
    for kind, known in _WORDS.items():
        if any(_begins(words, word) for word in known):
            return kind
    return TissueKind.ORGAN


def name_of(structure: Structure) -> str:
    """Return the name by which a table of values is looked up: "liver" for "Liver_1"."""
    words = structure.name.casefold().replace("_", " ")
    if kind_of(structure) is TissueKind.ORGAN and not any(word in words for word in _LESIONS):
        for organ in _ORGANS:
            if organ in words:
                return organ
    return structure.name


def _begins(words: str, known: str) -> bool:
    """Return whether a word of a name begins like a known one: no "rib" in "tribasic"."""
    return any(word.startswith(known) for word in words.replace("-", " ").split())
