"""Files and folders that are dropped on the window."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QDropEvent

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow


def dropped(event: QDropEvent) -> list[Path]:
    """Return what of this computer is dropped."""
    return [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]


def open_dropped(window: MainWindow, path: Path) -> None:
    """Open what was dropped: a plan, a position of the patient, or else a CT."""
    if path.suffix == ".json":
        window.plan_files.open(path)
    elif path.suffix == ".tfm":
        window.menus.position.open(path)
    else:
        window.open_ct.open_folder(path)
