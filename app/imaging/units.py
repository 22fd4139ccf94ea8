"""What the values of a CT image are: Hounsfield units, or a map of something else.

RescaleType may be left out where the values are Hounsfield units, and only there; where
MultienergyCTAcquisition is YES it must be given (PS3.3 C.8.2.1, Type 1C). What is computed from a
scan (blood flow, effective atomic number, the share of a material) says so in ImageType
(PS3.3 C.8.2.1.1.1 and C.8.15.2.1.1.5; explained in PS3.17 JJJJ.3), makers in words of their own.
"""

import re
from collections.abc import Sequence
from functools import lru_cache
from typing import Final

from app.core.messages import sentence

_UNITS: Final = {
    "OD": "optical density",
    "US": "unspecified",
    "MGML": "mg/ml",
    "Z_EFF": "effective atomic number",
    "ED": "electron density",
    "EDW": "electron density relative to water",
    "HU_MOD": "modified Hounsfield units",
    "PCT": "percent",
}
"""RescaleType other than HU -> what it means (PS3.3 C.11.1.1.2)."""

_ONE_MATERIAL: Final = "map of one material"
_MAPS: Final = {
    "perfusion map": "R?CBF|R?CBV|R?MTT|TTP|TMAX|TTD|TTS|PBV|BLOOD_?(FLOW|VOLUME)|PERMEABILITY"
    "|MEAN_TRANSIT_TIME|TIME_TO_(PEAK|DRAIN|START|MAX)",
    "effective atomic number map": "EFF(ECTIVE)?_ATOMIC_NUM(BER)?|Z_?EFF(ECTIVE)?|ATOMIC_NUMBER",
    "electron density map": "(RELATIVE_)?ELECTRON_DENSITY|RHO_?E",
    "stopping power map": "(PROTON_)?STOPPING_POWER(_RATIO)?|SPR",
    _ONE_MATERIAL: "MAT_(SPECIFIC|FRACTIONAL|VALUE_BASED)|MATERIAL_DENSITY"
    "|((MD|MAP)_)?(IODINE|CALCIUM|WATER|FAT|URIC_ACID|XENON)"
    "(_(MAP|DENSITY|NO_WATER|OVERLAY|CONCENTRATION))?",
    "parametric map": "PARAMETRIC(_MAP)?",
    "diffusion map": "DIFFUSION(_MAP)?",
}
"""Name of a map -> words of ImageType that say so."""

_MAP_WORDS: Final = {
    name: re.compile(
        f"(?P<core>{words})" if name == _ONE_MATERIAL else f"(.*_)?(?P<core>{words})(_.*)?"
    )
    for name, words in _MAPS.items()
}
_PERFUSION: Final = re.compile("(.*_)?PERFUSION(_.*)?")
_HOUNSFIELD: Final = re.compile(
    r"VMI|MONO.*|VIRTUAL_MONO.*|MAT_REMOVED|MAT_MODIFIED|VNC|VIRTUAL_(NON_CONTRAST|UNENHANCED)|VUE"
)
"""Words of multi-energy images whose values are Hounsfield units all the same."""

_OTHER: Final = re.compile(r"[^A-Z0-9]+")


@lru_cache(maxsize=16)
def another_unit(
    image_type: tuple[str, ...], rescale_type: str, multi_energy: bool, unit: str = ""
) -> str:
    """Say why the values of a CT image are no Hounsfield units; empty if they are.

    Args:
        image_type: values of ImageType, or of FrameType.
        rescale_type: RescaleType; empty where it is not given.
        multi_energy: whether MultienergyCTAcquisition is YES.
        unit: code of what real world values are measured in, where the file gives one.
    """
    words = _words(image_type)
    if name := _map_named(words, rescale_type.upper()):
        inside = ", ".join(word[:16] for word in (*_flavour(words, name), unit) if word)
        return sentence(
            "{name}{inside}, no Hounsfield units",
            name=name,
            inside=f" ({inside})" if inside else "",
        )
    return _named_unit(words, rescale_type.upper(), multi_energy)


def caveat(image_type: Sequence[str]) -> str:
    """Say what else should be known of Hounsfield units of these kinds; empty mostly."""
    words = _words(image_type)
    if any(_MAP_WORDS[_ONE_MATERIAL].fullmatch(word) for word in words):
        return sentence(
            "by ImageType these are Hounsfield units of one material only, not of the body"
        )
    if "MAT_MODIFIED" in words:
        return sentence("by ImageType values were changed to make a material stand out")
    return ""


def _words(image_type: Sequence[str]) -> list[str]:
    return [_OTHER.sub("_", value.upper()).strip("_") for value in image_type]


def _map_named(words: Sequence[str], rescale_type: str) -> str:
    for name, pattern in _MAP_WORDS.items():
        if name == _ONE_MATERIAL and rescale_type == "HU":  # its attenuation (PS3.17 JJJJ.3)
            continue
        if any(pattern.fullmatch(word) for word in words):
            return name
    computed = "DERIVED" in words[:1] and rescale_type != "HU"  # pictures it is computed from: HU
    return "perfusion map" if computed and any(map(_PERFUSION.fullmatch, words)) else ""


def _flavour(words: Sequence[str], name: str) -> list[str]:
    """Word that says of which quantity it is a map; only one that is known is quoted."""
    if name not in _MAP_WORDS:
        return []
    cores = (found["core"] for word in words if (found := _MAP_WORDS[name].fullmatch(word)))
    return list(cores)[:1]


def _named_unit(words: Sequence[str], rescale_type: str, multi_energy: bool) -> str:
    if rescale_type not in ("", "HU"):
        named = _UNITS.get(rescale_type)
        what = f"{rescale_type} ({named})" if named else "another unit"
        return sentence(
            "no Hounsfield units: RescaleType is {unit_name}, where HU is read",
            unit_name=what,
        )
    if rescale_type or not multi_energy or any(map(_HOUNSFIELD.fullmatch, words)):
        return ""
    return sentence(
        "no Hounsfield units that the file vouches for: MultienergyCTAcquisition is YES, and "
        "then RescaleType must say what the values are; it is missing"
    )
