"""What the window remembers between runs, in one ini file of the user."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSettings

from app.core import paths

MOST_RECENT = 8


def open_settings() -> QSettings:
    """Return the window's settings file."""
    folder = paths.settings()
    folder.mkdir(parents=True, exist_ok=True)
    return QSettings(str(folder / "window.ini"), QSettings.Format.IniFormat)


class Recents:
    """A list of paths, newest first, kept under one key."""

    def __init__(self, settings: QSettings, key: str) -> None:
        self._settings, self._key = settings, key

    def paths(self) -> list[Path]:
        """Those that still exist, newest first."""
        stored = self._settings.value(self._key) or []
        names = [stored] if isinstance(stored, str) else [str(name) for name in list(stored)]
        return [Path(name) for name in names if Path(name).exists()]

    def add(self, path: Path) -> None:
        """Put a path first."""
        first = path.resolve()
        others = [other for other in self.paths() if other != first]
        names = [str(entry) for entry in [first, *others][:MOST_RECENT]]
        self._settings.setValue(self._key, names)
