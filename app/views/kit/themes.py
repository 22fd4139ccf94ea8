"""The colours of the window's two themes, as values; `theme` says which of them is shown."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import lru_cache


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours of everything but pictures, `#rrggbb`, each of them another, so that they map.

    Attributes:
        name: what it is remembered by.
        background, surface, raised, field: areas, from the lowest to what one types into.
        border, disabled: lines, and words that count for nothing now.
        text, dim: words, and those that matter less.
        accent, on_accent: what is chosen, and words on it.
        good, warning, bad: verdicts.
        entry, target, needle, tip, path, skin: words in the colour of a mark.
    """

    name: str
    background: str
    surface: str
    raised: str
    field: str
    border: str
    disabled: str
    text: str
    dim: str
    accent: str
    on_accent: str
    good: str
    warning: str
    bad: str
    entry: str
    target: str
    needle: str
    tip: str
    path: str
    skin: str

    def colours(self) -> Mapping[str, str]:
        """Return the colours by their names."""
        return {name: str(value) for name, value in asdict(self).items() if name != "name"}


DARK = Theme(
    "dark",
    background="#14171a",
    surface="#1d2125",
    raised="#282d33",
    field="#101316",
    border="#3a4149",
    disabled="#6b747c",
    text="#e8ecef",
    dim="#a5afb8",
    accent="#4aa3df",
    on_accent="#0b0d0f",
    good="#4cc38a",
    warning="#f2b134",
    bad="#ff6b5e",
    entry="#56b4e9",
    target="#e58fc2",
    needle="#ff9f1c",
    tip="#35d6ed",
    path="#8fc7ff",
    skin="#d8b59c",
)
"""For the reading room."""

LIGHT = Theme(
    "light",
    background="#f1f3f5",
    surface="#ffffff",
    raised="#e0e5ea",
    field="#fcfdfe",
    border="#87929d",
    disabled="#6f7a85",
    text="#0d1115",
    dim="#3f4a55",
    accent="#00588f",
    on_accent="#fefefe",
    good="#0a6638",
    warning="#7a4700",
    bad="#a81712",
    entry="#005b94",
    target="#96275f",
    needle="#8a4b00",
    tip="#006577",
    path="#1a5799",
    skin="#6d4426",
)
"""For a projector in a lit room; pictures stay on black."""

THEMES = {theme.name: theme for theme in (DARK, LIGHT)}

_COLOUR = re.compile(r"#[0-9a-fA-F]{6}\b")
_SIZE = re.compile(r"(font-size:\s*)(\d+)px")


@lru_cache(maxsize=1024)  # asked for every cell and mark
def translated(colour: str, wanted: Theme) -> str:
    """Colour of `wanted` that stands for this one of any theme; others stay as they are."""
    for known in THEMES.values():
        for name, value in known.colours().items():
            if value == colour.lower():
                return wanted.colours()[name]
    return colour


def restyled(sheet: str, wanted: Theme, zoom: float) -> str:
    """Style sheet in another theme's colours, its font sizes `zoom` times as large."""
    coloured = _COLOUR.sub(lambda found: translated(found.group(), wanted), sheet)
    return _SIZE.sub(lambda found: f"{found[1]}{round(int(found[2]) * zoom)}px", coloured)
