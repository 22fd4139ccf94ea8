"""Which panes stand where: two by two, one large and three, six, the needle's own planes."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from app.exercises.reading import LayoutName
from app.views.kit.text import tr

COLUMNS = 12

AXIAL, SAGITTAL, CORONAL = "axial", "sagittal", "coronal"
IN_PLANE, IN_PLANE_90, PROBE = "in_plane", "in_plane_90", "probe"
SCENE, BULLSEYE = "scene", "bullseye"

Cell = tuple[int, int, int, int]
"""First row and column, height in the layout's rows and width in `COLUMNS`."""


@dataclass(frozen=True, slots=True)
class Layout:
    """An arrangement of panes.

    Attributes:
        name: what it is remembered by.
        cells: pane and place of each, in the order in which the keyboard goes through them.
    """

    name: str
    cells: tuple[tuple[str, Cell], ...]

    @property
    def panes(self) -> tuple[str, ...]:
        """Names of its panes."""
        return tuple(pane for pane, _ in self.cells)

    @property
    def rows(self) -> int:
        """Rows that its cells count in."""
        return max(row + height for _, (row, _, height, _) in self.cells)

    def mirrored(self) -> Layout:
        """Left and right exchanged, for the left-handed."""
        cells = [
            (pane, (row, COLUMNS - column - width, height, width))
            for pane, (row, column, height, width) in self.cells
        ]
        return replace(self, cells=tuple(cells))


_THIRDS: tuple[Cell, ...] = tuple((row, column, 1, 4) for row in (0, 1) for column in (0, 4, 8))
_SLICES = (AXIAL, SAGITTAL, CORONAL)

FOUR = Layout(
    LayoutName.FOUR,
    (
        (AXIAL, (0, 0, 1, 6)),
        (SAGITTAL, (0, 6, 1, 6)),
        (CORONAL, (1, 0, 1, 6)),
        (SCENE, (1, 6, 1, 6)),
    ),
)
FIVE = Layout(
    LayoutName.FOUR,
    (
        (AXIAL, (0, 0, 5, 4)),
        (SAGITTAL, (0, 4, 5, 4)),
        (CORONAL, (0, 8, 5, 4)),
        (SCENE, (5, 0, 6, 4)),
        (BULLSEYE, (5, 4, 6, 8)),
    ),
)
ONE_AND_THREE = Layout(
    LayoutName.ONE_AND_THREE,
    (
        (AXIAL, (0, 0, 3, 8)),
        (SAGITTAL, (0, 8, 1, 4)),
        (CORONAL, (1, 8, 1, 4)),
        (SCENE, (2, 8, 1, 4)),
    ),
)
ONE_AND_BULLSEYE = Layout(
    LayoutName.ONE_AND_THREE,
    (
        (AXIAL, (0, 0, 12, 6)),
        (SAGITTAL, (0, 6, 5, 3)),
        (CORONAL, (0, 9, 5, 3)),
        (BULLSEYE, (5, 6, 7, 6)),
    ),
)
SIX = Layout(
    LayoutName.SIX, tuple(zip((*_SLICES, IN_PLANE, IN_PLANE_90, SCENE), _THIRDS, strict=True))
)
SIX_AND_BULLSEYE = Layout(
    LayoutName.SIX,
    (
        *zip(_SLICES, ((0, 0, 5, 4), (0, 4, 5, 4), (0, 8, 5, 4)), strict=True),
        (IN_PLANE, (5, 0, 6, 3)),
        (IN_PLANE_90, (5, 3, 6, 3)),
        (BULLSEYE, (5, 6, 6, 6)),
    ),
)
NEEDLE = Layout(LayoutName.NEEDLE, ((IN_PLANE, (0, 0, 1, 6)), (PROBE, (0, 6, 1, 6))))
NEEDLE_AND_BULLSEYE = Layout(
    LayoutName.NEEDLE,
    (
        (IN_PLANE, (0, 0, 12, 6)),
        (PROBE, (0, 6, 5, 6)),
        (BULLSEYE, (5, 6, 7, 6)),
    ),
)

LAYOUTS: dict[str, tuple[Layout, Layout]] = {
    plain.name: (plain, guided)
    for plain, guided in (
        (FOUR, FIVE),
        (ONE_AND_THREE, ONE_AND_BULLSEYE),
        (SIX, SIX_AND_BULLSEYE),
        (NEEDLE, NEEDLE_AND_BULLSEYE),
    )
}
"""Each layout by its name, without and with the bull's-eye."""


def layout_title(name: str) -> str:
    """Name of a layout for people."""
    titles: dict[str, str] = {
        LayoutName.FOUR: tr("Two by two"),
        LayoutName.ONE_AND_THREE: tr("One large and three"),
        LayoutName.SIX: tr("Six: slices, needle's planes, 3D"),
        LayoutName.NEEDLE: tr("Needle: in-plane and probe's-eye"),
    }
    return titles.get(name, name)


def possible(panes: Collection[str]) -> tuple[str, ...]:
    """Names of the layouts for which every pane is there."""
    return tuple(
        name
        for name, both in LAYOUTS.items()
        if all(pane in panes for layout in both for pane in layout.panes)
    )


def chosen(name: str, bullseye: bool, mirrored: bool, panes: Iterable[str]) -> Layout:
    """Layout of this name; two by two where a pane of it is missing."""
    known = name if name in possible(tuple(panes)) else FOUR.name
    layout = LAYOUTS[known][int(bullseye)]
    return layout.mirrored() if mirrored else layout
