"""Offers attempts that lie in the source tree, where earlier versions kept them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QMenu, QMessageBox, QWidget

from app.session.elsewhere import Elsewhere, elsewhere, gather, signed_here
from app.session.people import People
from app.views.kit.background import run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.names import NAMES
from app.views.kit.text import literal, tr, tr_n


class Gathering(QObject):
    """An entry of the menu that is there while there is something to bring.

    Args:
        menu: of the sessions.
        folder: of the records.
        window: a question stands over it.
        after: is done once attempts have come.

    Signals:
        noted(str): what lies elsewhere, and what has come.
        failed(object): the error that kept it from coming.
    """

    noted = Signal(str)
    failed = Signal(object)

    def __init__(
        self, menu: QMenu, folder: Path, window: QWidget, after: Callable[[], object]
    ) -> None:
        super().__init__(window)
        self._folder, self._window, self._after = folder, window, after
        self._found: Elsewhere | None = None
        self._count, self._looked, self._busy = 0, False, False
        (self.entry,) = add_entries(menu, [(tr("Bring earlier attempts here…"), "", self.ask)])
        self.entry.setVisible(False)

    def look(self) -> None:
        """Look beside the window, once, and say what was found."""
        if not self._looked:
            self._looked = True
            run_in_background(
                self, lambda _: self._search(), lambda both: self._show(*both), self._nothing
            )

    def ask(self) -> None:
        """Ask whether they are to come."""
        found, buttons = self._found, QMessageBox.StandardButton
        if found is None or self._busy:
            return
        text = tr(
            "Attempts of this station lie in {there}, where earlier versions kept them: {n}. Bring "
            "them to {here}? They are then no more in the other folder.",
            n=self._count,
            there=NAMES.shown(str(found.folder)),
            here=NAMES.shown(str(self._folder)),
        )
        answer = QMessageBox.question(
            self._window,
            tr("Earlier attempts"),
            literal(text),
            buttons.Yes | buttons.No,
            buttons.Yes,
        )
        if answer == buttons.Yes:
            self._busy = True
            run_in_background(
                self, lambda _: gather(found, self._folder, People()), self._came, self._fail
            )

    # --- inside -------------------------------------------------------------------------------
    def _search(self) -> tuple[Elsewhere | None, int]:
        found = elsewhere(self._folder)
        return found, 0 if found is None else len(signed_here(found, People()))

    def _show(self, result: Elsewhere | None, count: int) -> None:
        self._found, self._count = result, count
        self.entry.setVisible(count > 0)
        if result is not None and count:
            self.noted.emit(
                tr(
                    "Earlier attempts lie in {there} ({n}): "
                    "Sessions ▸ Bring earlier attempts here…",
                    n=count,
                    there=NAMES.shown(str(result.folder)),
                )
            )

    def _came(self, count: int) -> None:
        self._busy = False
        self._show(None, 0)
        self._after()
        self.noted.emit(
            tr_n(
                "{n} attempt has come; it is in the list (F7).",
                "{n} attempts have come; they are in the list (F7).",
                count,
            )
        )

    def _fail(self, error: Exception) -> None:
        self._busy = False
        self.failed.emit(error)

    def _nothing(self, _: Exception) -> None:
        """Say nothing: nobody asked."""
