"""What the pictures of a control scan look like, as a value: ends, noise, and another breath."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from app.imaging.skin_grid import GridSpec, spec_of


class NeedleEnds(StrEnum):
    """How a scan draws the ends of the needle, and the dark bands beyond them."""

    PLAIN = "plain"
    """Both ends of the piece in a slice alike."""
    DRAWN = "drawn"
    """The tip as it is ground, a shaft that leaves the slice tapering, each with its own band."""


class BreathPicture(StrEnum):
    """How another breath than the planning CT's changes the picture."""

    WHOLE = "whole"
    """All of it moves, skin and bones too."""
    LAYERS = "layers"
    """Organs and lung move, each by its share; the wall of the body stays."""


@dataclass(frozen=True, slots=True)
class ScanLook:
    """What the pictures of a scan look like beside its slices and its needle.

    Attributes:
        streak: whether the metal leaves its dark bands.
        ends: how the needle's ends are drawn.
        breath: how another breath changes the picture.
        target_mm: of the plan, LPS: it goes along with all of the breath; where layers ask for it.
        noise_hu: standard deviation of what is added to the planning CT's own noise.
        noise_seed: of that noise.
        grid: of metal on the skin; None for none.
    """

    streak: bool = False
    ends: NeedleEnds = NeedleEnds.PLAIN
    breath: BreathPicture = BreathPicture.WHOLE
    target_mm: tuple[float, float, float] | None = None
    noise_hu: float = 0.0
    noise_seed: int = 0
    grid: GridSpec | None = None

    def document(self) -> dict[str, object]:
        """Return JSON-ready values of what is not as usual; `look_of` reads them back."""
        usual, made = ScanLook(), {}
        for name in ("ends", "breath", "target_mm", "noise_hu", "noise_seed"):
            value = getattr(self, name)
            if value != getattr(usual, name):
                made[name] = list(value) if isinstance(value, tuple) else value
        return made if self.grid is None else made | {"grid": self.grid.document()}


def look_of(streak: bool, document: Mapping[str, Any]) -> ScanLook:
    """Read `ScanLook.document` back.

    Raises:
        LookupError, TypeError, ValueError: if it is damaged.
    """
    target = document.get("target_mm")
    x, y, z = (0.0, 0.0, 0.0) if target is None else map(float, target)
    return ScanLook(
        streak,
        NeedleEnds(document.get("ends", NeedleEnds.PLAIN)),
        BreathPicture(document.get("breath", BreathPicture.WHOLE)),
        None if target is None else (x, y, z),
        float(document.get("noise_hu", 0.0)),
        int(document.get("noise_seed", 0)),
        None if (grid := document.get("grid")) is None else spec_of(grid),
    )
