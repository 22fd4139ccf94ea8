"""Which panes stand where: two by two, one large and three, six, the needle's own planes; the grid
that holds them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from PySide6.QtWidgets import QGridLayout, QSizePolicy, QWidget

from app.exercises.reading import LayoutName
from app.views.kit.text import tr

COLUMNS = 12

AXIAL, SAGITTAL, CORONAL = "axial", "sagittal", "coronal"
IN_PLANE, IN_PLANE_90, PROBE = "in_plane", "in_plane_90", "probe"
SCENE, BULLSEYE, SCAN = "scene", "bullseye", "scan"
ATTEMPT = "attempt"
"""Name of the layout of an attempt for which none was chosen."""

Cell = tuple[int, int, int, int]
"""First row and column, height in the layout's rows and width in `COLUMNS`."""


@dataclass(frozen=True, slots=True)
class Layout:
    """An arrangement of panes.

    Attributes:
        name: what it is remembered by.
        cells: pane and place of each, in the order in which the keyboard goes through them.
        columns: that its cells count in.
    """

    name: str
    cells: tuple[tuple[str, Cell], ...]
    columns: int = COLUMNS

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
            (pane, (row, self.columns - column - width, height, width))
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
        (AXIAL, (0, 0, 1, 3)),
        (SAGITTAL, (0, 3, 1, 3)),
        (CORONAL, (1, 0, 1, 3)),
        (SCENE, (1, 3, 1, 3)),
        (BULLSEYE, (0, 6, 2, 6)),
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
        (AXIAL, (0, 0, 7, 6)),
        (SAGITTAL, (7, 0, 5, 3)),
        (CORONAL, (7, 3, 5, 3)),
        (BULLSEYE, (0, 6, 12, 6)),
    ),
)
SIX = Layout(
    LayoutName.SIX, tuple(zip((*_SLICES, IN_PLANE, IN_PLANE_90, SCENE), _THIRDS, strict=True))
)
SIX_AND_BULLSEYE = Layout(
    LayoutName.SIX,
    (
        *zip(_SLICES, ((0, 0, 4, 4), (0, 4, 4, 4), (0, 8, 4, 4)), strict=True),
        (IN_PLANE, (4, 0, 7, 3)),
        (IN_PLANE_90, (4, 3, 7, 3)),
        (BULLSEYE, (4, 6, 7, 6)),
    ),
)
NEEDLE = Layout(LayoutName.NEEDLE, ((IN_PLANE, (0, 0, 1, 6)), (PROBE, (0, 6, 1, 6))))
NEEDLE_AND_BULLSEYE = Layout(
    LayoutName.NEEDLE,
    (
        (IN_PLANE, (0, 0, 7, 6)),
        (PROBE, (7, 0, 5, 6)),
        (BULLSEYE, (0, 6, 12, 6)),
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


ATTEMPT_COLUMNS, ATTEMPT_CT, ATTEMPT_ROWS = 26, 20, 12
"""Of an attempt: in all, and those of the CT, which has the rest's where there is no rest."""

_ATTEMPT: dict[str, tuple[tuple[str, Cell], ...]] = {
    LayoutName.FOUR: (
        (AXIAL, (0, 0, 12, 10)),
        (SAGITTAL, (0, 10, 6, 10)),
        (CORONAL, (6, 10, 6, 10)),
    ),
    LayoutName.ONE_AND_THREE: (
        (AXIAL, (0, 0, 12, 14)),
        (SAGITTAL, (0, 14, 6, 6)),
        (CORONAL, (6, 14, 6, 6)),
    ),
    LayoutName.SIX: (
        *zip(_SLICES, ((0, 0, 5, 7), (0, 7, 5, 6), (0, 13, 5, 7)), strict=True),
        (IN_PLANE, (5, 0, 7, 10)),
        (IN_PLANE_90, (5, 10, 7, 10)),
    ),
    LayoutName.NEEDLE: ((IN_PLANE, (0, 0, 12, 10)), (PROBE, (0, 10, 12, 10))),
    ATTEMPT: ((IN_PLANE, (0, 0, 12, 10)), (IN_PLANE_90, (0, 10, 12, 10))),
    SCAN: ((SCAN, (0, 0, 12, 20)),),
}
"""The CT's panes in an attempt by the layout that was chosen."""


def attempt_layout(name: str, beside: tuple[str, ...], mirrored: bool) -> Layout:
    """Arrange an attempt: the CT large, at most two panes in a column beside it.

    Args:
        name: of the layout whose slices are shown; `ATTEMPT` or an unknown one shows the two planes
            along the needle, `SCAN` the control scan.
        beside: the panes in the column, from the top; none gives the CT all of it.
        mirrored: whether the column stands on the left.
    """
    cells = _ATTEMPT.get(name, _ATTEMPT[ATTEMPT])
    columns = ATTEMPT_COLUMNS if beside else ATTEMPT_CT
    heights = (7, 5) if len(beside) > 1 else (ATTEMPT_ROWS,)
    top, width = 0, ATTEMPT_COLUMNS - ATTEMPT_CT
    column: list[tuple[str, Cell]] = []
    for pane, height in zip(beside, heights, strict=False):
        column.append((pane, (top, ATTEMPT_CT, height, width)))
        top += height
    layout = Layout(f"attempt {name}", (*cells, *column), columns)
    return layout.mirrored() if mirrored else layout


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


class ViewGrid(QWidget):
    """Holds the panes by name and shows those that the layout has a cell for."""

    def __init__(self, panes: Mapping[str, QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panes: dict[str, QWidget] = {}
        self._layout = FOUR
        self._rows, self._columns = 0, COLUMNS
        self._maximised: QWidget | None = None
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(0)
        for name, pane in panes.items():
            self.add(name, pane)
        self.arrange(FOUR)

    @property
    def names(self) -> tuple[str, ...]:
        """The panes that there are."""
        return tuple(self._panes)

    @property
    def maximised(self) -> QWidget | None:
        """The pane that has the whole room, if one has."""
        return self._maximised

    @property
    def shown(self) -> Layout:
        """The present layout."""
        return self._layout

    def pane(self, name: str) -> QWidget:
        """Return the pane of this name."""
        return self._panes[name]

    def add(self, name: str, pane: QWidget) -> None:
        """Take another pane; it is hidden until a layout has a cell for it."""
        # the cells give the sizes, whatever the panes would like
        pane.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
        pane.setParent(self)
        pane.setVisible(False)
        self._panes[name] = pane

    def remove(self, name: str) -> None:
        """Let go of a pane that was added; whoever takes it next shows it."""
        pane = self._panes.pop(name)
        self._grid.removeWidget(pane)
        if self._maximised is pane:
            self._maximised = None

    def arrange(self, layout: Layout) -> None:
        """Put panes into the layout's cells and hide the rest."""
        self._layout, self._maximised = layout, None
        # All of them leave before the first comes back: a grid that is laid out with some panes in
        # the columns of the layout before, while those are taken away, ends the program.
        for pane in self._panes.values():
            self._grid.removeWidget(pane)
        self._rows = max(self._rows, layout.rows)
        for row in range(self._rows):
            self._grid.setRowStretch(row, 1 if row < layout.rows else 0)
        self._columns = max(self._columns, layout.columns)
        for column in range(self._columns):
            self._grid.setColumnStretch(column, 1 if column < layout.columns else 0)
        cells = dict(layout.cells)
        for name, pane in self._panes.items():
            if name in cells:
                self._grid.addWidget(pane, *cells[name])
        for name, pane in self._panes.items():
            pane.setVisible(name in cells)
        self._set_tab_order(layout)

    def _set_tab_order(self, layout: Layout) -> None:
        """Let the Tab key go through the panes in reading order."""
        shown = [self._panes[name] for name in layout.panes if name in self._panes]
        for first, second in pairwise(shown):
            QWidget.setTabOrder(first, second)

    def toggle(self, pane: QWidget) -> None:
        """Give `pane` the whole room, or share it again."""
        if self._maximised is not None:
            self.arrange(self._layout)
        else:
            self._maximised = pane
            for other in self._panes.values():
                self._grid.removeWidget(other)
                other.setVisible(other is pane)
            self._grid.addWidget(pane, 0, 0, self._rows, self._columns)
        pane.setFocus()
