"""The panes on a grid: two by two, or with the bull's-eye; any pane can have the whole room."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QGridLayout, QWidget

GAP_PX = 3
COLUMNS = 6

Cell = tuple[int, int, int]
"""Row, first column and width in columns, of `COLUMNS`."""

FOUR: tuple[Cell, ...] = ((0, 0, 3), (0, 3, 3), (1, 0, 3), (1, 3, 3))
FIVE: tuple[Cell, ...] = ((0, 0, 2), (0, 2, 2), (0, 4, 2), (1, 0, 2), (1, 2, 4))


class ViewGrid(QWidget):
    """Holds the panes in reading order and shows as many as the arrangement has cells."""

    def __init__(self, panes: Sequence[QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panes = tuple(panes)
        self._cells = FOUR
        self._maximised: QWidget | None = None
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(GAP_PX)
        for column in range(COLUMNS):  # equal shares, whatever the panes would like
            self._grid.setColumnStretch(column, 1)
            self._grid.setColumnMinimumWidth(column, 1)
        for row in range(2):
            self._grid.setRowStretch(row, 1)
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
        for number, pane in enumerate(self._panes):
            self._grid.removeWidget(pane)
            if number < len(cells):
                row, column, width = cells[number]
                self._grid.addWidget(pane, row, column, 1, width)
            pane.setVisible(number < len(cells))

    def toggle(self, pane: QWidget) -> None:
        """Give `pane` the whole room, or share it again."""
        if self._maximised is not None:
            self.arrange(self._cells)
        else:
            self._maximised = pane
            for other in self._panes:
                other.setVisible(other is pane)
        pane.setFocus()
