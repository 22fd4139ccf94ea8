"""How an exercise is read: window and layout that it begins with, and whether they stay."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field, field_validator, model_validator

from app.core.configuration import FieldText, Strict
from app.core.messages import sentence
from app.imaging.window import MINIMUM_WIDTH, PRESETS, WindowLevel

LARGEST_HU = 1e5


class LayoutName(StrEnum):
    """How the panes are arranged."""

    FOUR = "2x2"
    ONE_AND_THREE = "1+3"
    SIX = "6-up"
    NEEDLE = "needle"


class WindowPart(Strict):
    """A window by its numbers [HU]."""

    width: Annotated[float, Field(ge=MINIMUM_WIDTH, le=LARGEST_HU)]
    level: Annotated[float, Field(ge=-LARGEST_HU, le=LARGEST_HU)]


class SlabPart(Strict):
    """Thickness of the slices of every pane, and what of it is shown; 0 mm is one slice."""

    kind: Annotated[Literal["mean", "mip", "minip"], FieldText("Slab")] = "mean"
    thickness_mm: Annotated[float, Field(ge=0.0, le=100.0), FieldText("Thickness of the slab")] = (
        0.0
    )


class ReadingPart(Strict):
    """What a student begins with.

    Attributes:
        window: numbers, or in the file a preset's name; None leaves it to the student.
        slab: of the panes; None leaves it to the student.
        layout: of the panes; None leaves it to the student.
        locked: whether what is given here stays as it is.
    """

    window: Annotated[WindowPart | None, FieldText("Window of the CT")] = None
    slab: SlabPart | None = None
    layout: Annotated[LayoutName | None, FieldText("Layout of the panes")] = None
    locked: Annotated[bool, FieldText("Window, slab and layout stay as given here")] = False

    @field_validator("window", mode="before")
    @classmethod
    def _known_name(cls, window: object) -> object:
        if not isinstance(window, str):
            return window
        names = {_plain(name): name for name in PRESETS}
        if _plain(window) not in names:
            raise ValueError(
                sentence(
                    "there is no window {window!r}; there are: {presets}, or give "
                    "{{width: …, level: …}} in HU",
                    window=window,
                    presets=", ".join(PRESETS),
                )
            )
        preset = PRESETS[names[_plain(window)]]
        return {"width": preset.width, "level": preset.level}

    @model_validator(mode="after")
    def _something_to_lock(self) -> ReadingPart:
        if self.locked and self.window is None and self.slab is None and self.layout is None:
            raise ValueError(
                sentence("locked keeps window, slab and layout: give at least one of them")
            )
        return self

    @property
    def window_level(self) -> WindowLevel | None:
        """The window, if one is given."""
        return None if self.window is None else WindowLevel(self.window.width, self.window.level)


def _plain(name: str) -> str:
    """Let case and underscores make no difference."""
    return " ".join(name.replace("_", " ").casefold().split())
