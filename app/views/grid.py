"""The panes on a grid: two by two, or with the bull's-eye; any pane can have the whole room."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QGridLayout, QSizePolicy, QWidget

GAP_PX = 3
ROWS, COLUMNS = 11, 12

Cell = tuple[int, int, int, int]
"""First row and column, height in `ROWS` and width in `COLUMNS`."""

FOUR: tuple[Cell, ...] = ((0, 0, 1, 6), (0, 6, 1, 6), (1, 0, 1, 6), (1, 6, 1, 6))
FIVE: tuple[Cell, ...] = (
    (0, 0, 5, 4),
    (0, 4, 5, 4),
    (0, 8, 5, 4),
    (5, 0, 6, 4),
    (5, 4, 6, 8),
)


class ViewGrid(QWidget):
    """Holds the panes in reading order and shows as many as the arrangement has cells."""

    def __init__(self, panes: Sequence[QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panes = tuple(panes)
        self._cells = FOUR
        self._maximised: QWidget | None = None
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(0)
        for pane in panes:  # the cells give the sizes, whatever the panes would like
            pane.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
        for column in range(COLUMNS):
            self._grid.setColumnStretch(column, 1)
        self.arrange(FOUR)

    @property
    def maximised(self) -> QWidget | None:
        """The pane that has the whole room, if one has."""
        return self._maximised

    @property
    def cells(self) -> tuple[Cell, ...]:
        """The present arrangement."""
        return self._cells

    def arrange(self, cells: tuple[Cell, ...]) -> None:
        """Put the first panes into these cells and hide the rest."""
        self._cells, self._maximised = cells, None
        rows = max(row + height for row, _, height, _ in cells)
        for row in range(ROWS):
            self._grid.setRowStretch(row, 1 if row < rows else 0)
        for number, pane in enumerate(self._panes):
            self._grid.removeWidget(pane)
            if number < len(cells):
                self._grid.addWidget(pane, *cells[number])
            pane.setVisible(number < len(cells))

    def toggle(self, pane: QWidget) -> None:
        """Give `pane` the whole room, or share it again."""
        if self._maximised is not None:
            self.arrange(self._cells)
        else:
            self._maximised = pane
            for other in self._panes:
                self._grid.removeWidget(other)
                other.setVisible(other is pane)
            self._grid.addWidget(pane, 0, 0, ROWS, COLUMNS)
        pane.setFocus()
