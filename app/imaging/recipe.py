"""What was asked for on the way from files to a volume, as values: the same can be asked again."""

from dataclasses import dataclass

from app.imaging.series import Remedy


@dataclass(frozen=True, slots=True)
class Recipe:
    """How a series was read; `resampling.read_again` follows it.

    Attributes:
        remedy: what was asked for.
        factors: voxels along i, j and k that were averaged to one.
        spacing_mm: of the slices that were made; None where none were.
    """

    remedy: Remedy = Remedy.NONE
    factors: tuple[int, int, int] = (1, 1, 1)
    spacing_mm: float | None = None


AS_IT_IS = Recipe()
"""Read without asking for anything."""
