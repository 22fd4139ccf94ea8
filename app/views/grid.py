"""Four panes, two by two; any of them can have the whole room."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QGridLayout, QWidget

GAP_PX = 3


class ViewGrid(QWidget):
    """Holds the panes in reading order."""

    def __init__(self, panes: Sequence[QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panes = tuple(panes)
        self._maximised: QWidget | None = None
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(GAP_PX)
        for number, pane in enumerate(panes):
            grid.addWidget(pane, *divmod(number, 2))
        for line in range(2):  # equal halves, whatever the panes would like
            grid.setRowStretch(line, 1)
            grid.setColumnStretch(line, 1)

    @property
    def maximised(self) -> QWidget | None:
        """The pane that has the whole room, if one has."""
        return self._maximised

    def toggle(self, pane: QWidget) -> None:
        """Give `pane` the whole room, or share it again."""
        self._maximised = None if self._maximised is pane else pane
        for other in self._panes:
            other.setVisible(self._maximised in (None, other))
        pane.setFocus()
