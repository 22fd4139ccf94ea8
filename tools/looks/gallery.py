"""The window as `make looks` takes it: each state in every size and theme, a picture and faults."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from fnmatch import fnmatch
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import QSize, QTimer
from PySide6.QtWidgets import QApplication, QDialog, QMessageBox, QWidget

from app.views.kit.parts import FRAME
from app.views.kit.roles import Role
from tools.looks import rules
from tools.palette import small_png
from tools.reading_studio import Studio
from tools.robot_pictures import pause, wait

SIZES: Final = ("1366x768", "1920x1080", "2560x1440")
THEMES: Final = ("dark", "light")
KEPT: Final = ("en", SIZES[0], THEMES[0])
"""Language, size and theme whose pictures are kept in the repository."""

PASSES_S: Final = 300.0
"""Longest that a state is waited for once it was asked for [s]."""


def size_of(name: str) -> QSize:
    """Return a size from its name, such as 1366x768."""
    width, height = (int(part) for part in name.split("x"))
    return QSize(width, height)


@dataclass(frozen=True, slots=True)
class Wish:
    """Which pictures are wanted.

    Attributes:
        language: code of it, or `pseudo`.
        sizes: of the window; dialogs have a size of their own.
        themes: `dark`, `light`, `large` (dark with large text).
        only: patterns of names of states; empty for all.
    """

    language: str
    sizes: tuple[str, ...] = SIZES
    themes: tuple[str, ...] = THEMES
    only: tuple[str, ...] = ()

    def wants(self, name: str) -> bool:
        """Return whether a state is wanted."""
        return not self.only or any(fnmatch(name, f"*{pattern}*") for pattern in self.only)


@dataclass(slots=True)
class Look:
    """One picture.

    Attributes:
        state: name of page and state.
        language, size, theme: how it was taken; a dialog's size is its own.
        file: of the picture, below the folder of all.
        seconds: that it took.
        faults: rules that it breaks.
        differs: share of it that differs from the kept picture; None where there is none.
    """

    state: str
    language: str
    size: str
    theme: str
    file: str
    seconds: float = 0.0
    faults: list[dict[str, str]] = field(default_factory=list)
    differs: float | None = None

    def facts(self) -> dict[str, Any]:
        """Return it for a JSON file."""
        return asdict(self)


class Gallery(Studio):
    """Takes states as pictures, and judges them.

    Args:
        folder: where the pictures go.
        sessions: where the records go.
        wish: which are wanted.

    Attributes:
        looks: what was taken.
        broken: acts that did not get to their end, and why.
    """

    def __init__(self, folder: Path, sessions: Path, wish: Wish) -> None:
        self.wish, self.looks, self.broken = wish, list[Look](), list[str]()
        self.sessions = sessions
        super().__init__(folder, sessions, None)
        self.window.resize(size_of(SIZES[0]))
        self.window.activateWindow()
        self.window.open_ct.may_replace = lambda: True
        self._guard = QTimer(interval=3000)
        self._guard.timeout.connect(self._answer)
        self._guard.start()

    def _answer(self) -> None:
        """Close a question that nobody is there to answer."""
        asked = QApplication.activeModalWidget()
        if isinstance(asked, QMessageBox):
            self.broken.append(f"a question was asked: {asked.text()}")
            asked.reject()

    # --- ways to states -----------------------------------------------------------------------
    def sit_down(self, role: Role) -> None:
        """Let somebody else sit at the window."""
        self.window.roles.choose(role)
        pause(0.1)

    def leave_attempt(self) -> None:
        """End an attempt that stands still."""
        run = self.window.conductor.controller.run
        if run is not None and self.window.conductor.controller.is_running:
            self.window.conductor.controller.abort()
            self.trainer.step()
            pause(1.0)

    def dialog(self, name: str, ask: Callable[[], object], until: float = 0.4) -> None:
        """Keep the dialog that something opens, and close it."""
        if not self.wish.wants(name):
            return
        before = set(_dialogs())
        ask()
        wait(lambda: bool(set(_dialogs()) - before), PASSES_S)
        pause(until)
        opened = next(iter(set(_dialogs()) - before))
        self.keep(name, opened)
        opened.done(QDialog.DialogCode.Rejected)
        pause(0.1)

    # --- pictures -----------------------------------------------------------------------------
    def keep_window(self, name: str) -> None:
        """Take the window."""
        self.keep(name)

    def keep(self, name: str, widget: QWidget | None = None) -> None:
        """Take a state in every size and theme that is wanted.

        Args:
            name: of the state.
            widget: a window of its own, taken as it is; else the main window.
        """
        if not self.wish.wants(name):
            return
        shown = widget if widget is not None and widget.isWindow() else self.window
        own = shown is not self.window
        for theme in self.wish.themes:
            self.window.projector.set(light=theme == "light", large=theme == "large")
            for size in self.wish.sizes[:1] if own else self.wish.sizes:
                begin = time.monotonic()
                if own:  # as on a screen of that size
                    shown.resize(shown.size().boundedTo(size_of(size) - FRAME))
                else:
                    self.window.resize(size_of(size))
                self.settle()
                self._take(name, shown, size, theme, begin)
        self.window.projector.set(light=False, large=False)
        self.window.resize(size_of(SIZES[0]))

    def _take(self, name: str, shown: QWidget, size: str, theme: str, begin: float) -> None:
        wish = self.wish
        QApplication.processEvents()
        shot = shown.grab()
        file = f"{wish.language}/{theme}/{size}/{name}.png"
        path = self.folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        kept = (wish.language, size, theme) == KEPT
        if kept:
            small_png(shot, path)
        else:
            shot.save(str(path))
        faults = rules.judged(shown, shot.toImage())
        if shown is self.window and self.window.workspace.room.is_on:
            faults += rules.judged_in_attempt(self.window)
        if kept:
            faults += rules.judged_by_keys(shown)
        if shown.width() > size_of(size).width() or shown.height() > size_of(size).height():
            words = f"{shown.width()}x{shown.height()}"
            faults.append(rules.Fault("size", type(shown).__name__, words))
        look = Look(name, wish.language, size, theme, file, time.monotonic() - begin)
        look.faults = [asdict(fault) for fault in dict.fromkeys(faults)]
        self.looks.append(look)
        facts = {"looks": [one.facts() for one in self.looks], "broken": self.broken}
        (self.folder / f"{wish.language}.json").write_text(json.dumps(facts, indent=1))
        print(f"{look.seconds:5.1f} s  {file}  {len(faults)}", file=sys.stderr, flush=True)


def _dialogs() -> Iterator[QDialog]:
    for widget in QApplication.topLevelWidgets():
        if isinstance(widget, QDialog) and widget.isVisible():
            yield widget
