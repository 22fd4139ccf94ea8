"""How the 3D view shows what there is: as values that are set, remembered and handed on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

from PySide6.QtGui import QColor

from app.imaging.reformat import Frame
from app.imaging.window import WindowLevel
from app.planning.patient import Patient
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.themes import DARK, LIGHT, translated

Rgb = tuple[float, float, float]

LIGHT_BACKGROUND = "#eef2f5"
"""For projectors: black pictures drown in a lit room."""

ORGAN_COLOURS: Mapping[str, str] = {
    "lungs": "#a8d4ee",
    "heart": "#c23b4e",
    "liver": "#8a5230",
    "gallbladder": "#a9c93c",
    "stomach": "#e9b7c0",
    "spleen": "#5b3a86",
    "kidneys": "#178a72",
    "pancreas": "#f2dd62",
    "arteries": "#f4563e",
    "veins": "#2f62b8",
    "cartilage": "#b9c6a4",
    "lesion": "#f7f3ff",
}
"""Colours of organs: neighbours differ in lightness too, so that colour-blind people tell them."""

SEEN_INTO = {"lungs": 0.34, "liver": 0.5}
"""Opacity of organs that one looks into; others are solid."""


@dataclass(frozen=True, slots=True)
class Display:
    """What a user chooses of the 3D view; all of it is remembered.

    Attributes:
        light: on a light background, for projectors.
        xray: skin, bone and organs are faint; needle, path and target are never hidden.
        organs: organs stand in the picture, where the patient's are known.
        slices: so do the slices through the crosshair.
        cut: what is in front of the needle's plane is taken away; the CT is on the cut.
        volume: preset of the volume rendering; empty for surfaces.
        guides: what an exercise asks for stands in it: a grid on the skin, electrodes, zones.
    """

    light: bool = False
    xray: bool = False
    organs: bool = True
    slices: bool = False
    cut: bool = False
    volume: str = ""
    guides: bool = True

    def switched(self, part: str) -> Display:
        """Return it with a field that is on or off the other way round."""
        state = self.document()
        return Display(**(state | {part: not state[part]}))

    def document(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return asdict(self)

    @classmethod
    def of_document(cls, state: Mapping[str, Any]) -> Display:
        """Read what `document` wrote; what is missing or not known stays as it is usually."""
        found: dict[str, Any] = {}
        for part in fields(cls):
            value = state.get(part.name)
            if type(value) is type(part.default):
                found[part.name] = value
        return cls(**found)

    @property
    def background(self) -> str:
        """Colour behind everything, `#rrggbb`."""
        return LIGHT_BACKGROUND if self.light else theme.IMAGE_BACKGROUND

    @property
    def text(self) -> str:
        """Colour of words on it."""
        return LIGHT.text if self.light else theme.IMAGE_TEXT

    def colour(self, name: str) -> str:
        """Return what a mark's colour is on this background."""
        return translated(name, LIGHT if self.light else DARK)


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """A plane through a patient's CT, seen at a window."""

    patient: Patient
    frame: Frame
    window: WindowLevel

    def shows_the_same(self, other: Section) -> bool:
        """Return whether the other one gives the same picture at the same place."""
        if (self.patient, self.window) != (other.patient, other.window):
            return False
        pairs = (
            (getattr(self.frame, name), getattr(other.frame, name))
            for name in ("origin_mm", "right", "down")
        )
        return all((one == another).all() for one, another in pairs)


def rgb(name: str) -> Rgb:
    """Return `#rrggbb` as three floats in [0, 1]."""
    value = QColor(name)
    return value.redF(), value.greenF(), value.blueF()


def organ_title(name: str) -> str:
    """Name of an organ for people."""
    titles = {
        "lungs": tr("Lungs"),
        "heart": tr("Heart"),
        "liver": tr("Liver"),
        "gallbladder": tr("Gallbladder"),
        "stomach": tr("Stomach"),
        "spleen": tr("Spleen"),
        "kidneys": tr("Kidneys"),
        "pancreas": tr("Pancreas"),
        "arteries": tr("Arteries"),
        "veins": tr("Veins"),
        "lesion": tr("Lesion"),
        "cartilage": tr("Cartilage"),
    }
    return titles[name]
