"""How the window suits a room: light colours, large text, no names; changed while it is open."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QApplication

from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.themes import DARK, LIGHT


class Projector(QObject):
    """Switches what a room full of people needs.

    Signals:
        changed(): something of it is another.
    """

    changed = Signal()

    @property
    def is_light(self) -> bool:
        """Return whether the colours are those for a lit room."""
        return theme.present() is LIGHT

    @property
    def is_large(self) -> bool:
        """Return whether the text is large."""
        return theme.scale() > 1.0

    @property
    def hides_names(self) -> bool:
        """Return whether pseudonyms, folders and students are hidden."""
        return NAMES.are_hidden

    @property
    def is_on(self) -> bool:
        """Return whether all three are as a room needs them."""
        return self.is_light and self.is_large and self.hides_names

    def set_all(self, on: bool) -> None:
        """Light, large and without names; or as for one user."""
        self.set(light=on, large=on, names_hidden=on)

    def set_light(self, light: bool) -> None:
        """Take light colours, or dark ones."""
        self.set(light=light)

    def set_large(self, large: bool) -> None:
        """Take large text, or usual text."""
        self.set(large=large)

    def hide_names(self, hidden: bool) -> None:
        """Hide names, or show them."""
        self.set(names_hidden=hidden)

    def set(
        self,
        light: bool | None = None,
        large: bool | None = None,
        names_hidden: bool | None = None,
    ) -> None:
        """Change what is given, leave the rest."""
        light = self.is_light if light is None else light
        large = self.is_large if large is None else large
        application = QApplication.instance()
        if (light, large) != (self.is_light, self.is_large) and isinstance(
            application, QApplication
        ):
            theme.apply_theme(application, LIGHT if light else DARK, theme.LARGE if large else 1.0)
        if names_hidden is not None:
            NAMES.hide(names_hidden)
        self.changed.emit()
