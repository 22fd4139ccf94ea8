"""The panes on a grid, as a layout says; any pane can have the whole room."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from PySide6.QtWidgets import QGridLayout, QSizePolicy, QVBoxLayout, QWidget

from app.views.reading.layouts import COLUMNS, FOUR, Layout


class ViewGrid(QWidget):
    """Holds the panes by name and shows those that the layout has a cell for."""

    def __init__(self, panes: Mapping[str, QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panes: dict[str, QWidget] = {}
        self._layout = FOUR
        self._rows = 0
        self._maximised: QWidget | None = None
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(0)
        for column in range(COLUMNS):
            self._grid.setColumnStretch(column, 1)
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

    def arrange(self, layout: Layout) -> None:
        """Put panes into the layout's cells and hide the rest."""
        self._layout, self._maximised = layout, None
        self._rows = max(self._rows, layout.rows)
        for row in range(self._rows):
            self._grid.setRowStretch(row, 1 if row < layout.rows else 0)
        cells = dict(layout.cells)
        for name, pane in self._panes.items():
            self._grid.removeWidget(pane)
            if name in cells:
                self._grid.addWidget(pane, *cells[name])
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
            self._grid.addWidget(pane, 0, 0, self._rows, COLUMNS)
        pane.setFocus()


class Cell(QWidget):
    """Gives a widget whose texts wrap the size of its cell, not the height it would like."""

    def __init__(self, content: QWidget) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(content)

    def hasHeightForWidth(self) -> bool:
        """Return False: the grid's shares decide."""
        return False
