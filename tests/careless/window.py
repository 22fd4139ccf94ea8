"""The trainer's own window in a process of its own, used carelessly.

`python -m tests.careless.window FOLDER --seed N --seconds S [--plant CHECK] [--replay FILE]`: every
action is written to `FOLDER/actions.jsonl` before it is done, what failed after it as a line with
`failed`. The mouse and the keys go through the X server, from a thread that asks the window where
things are. Exit code 0: nothing failed; 3: something did.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu

from app.compose.desktop import Desktop
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.roles import Role
from app.views.shell.application import start
from app.views.shell.language import Rebuilding
from app.views.shell.window import MainWindow
from tests.careless import hands
from tests.careless.actions import Action, Screen, draw, read_actions
from tests.careless.checks import ANSWER_S, Checks, Failure
from tests.careless.defects import DEFECTS
from tests.careless.targets import (
    CONTROLS,
    PICTURES,
    Target,
    find,
    is_file_dialog,
    menu_items,
    menu_titles,
    path_of,
    seen_box,
    targets,
    top,
    words_of,
)

SETTLES_S = 0.4
"""What is still so after this long is no passing state [s]."""
READY_S = 240.0
LOADS_S = 8.0
FROZEN_S = 30.0

T = TypeVar("T")


class Asked(QObject):
    """Lets another thread have something done on the window's thread."""

    _wanted = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self._wanted.connect(lambda job: job(), Qt.ConnectionType.QueuedConnection)

    def of(self, operation: Callable[[], T], seconds: float = FROZEN_S) -> T:
        """Return what an operation gives on the window's thread.

        Raises:
            TimeoutError: if the window does not get to it in time.
        """
        answer: Future[T] = Future()

        def job() -> None:
            try:
                answer.set_result(operation())
            except Exception as error:
                answer.set_exception(error)

        self._wanted.emit(job)
        return answer.result(seconds)

    def begin(self, operation: Callable[[], object]) -> None:
        """Have something done that may open a dialog and come back late."""
        self._wanted.emit(operation)


class ReadOnlyFiles(QObject):
    """Keeps dialogs of files from renaming or deleting any.

    It looks now and then: a filter of all events would make every one of them wait for Python.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        timer = QTimer(self, interval=20)
        timer.timeout.connect(self._look)
        timer.start()

    def _look(self) -> None:
        for window in QApplication.topLevelWidgets():
            if isinstance(window, QFileDialog):
                window.setOption(QFileDialog.Option.ReadOnly, True)


class CarelessUser(threading.Thread):
    """Does one action after the other until the time is over, the list ends or something fails."""

    def __init__(
        self, holder: Rebuilding, checks: Checks, asked: Asked, options: argparse.Namespace
    ):
        super().__init__(name="careless-user", daemon=True)
        self._holder, self._checks, self._asked = holder, checks, asked
        self._options = options
        self._rng = random.Random(options.seed)
        self._log = (options.folder / "actions.jsonl").open("w", buffering=1)
        self.failed: list[Failure] = []

    @property
    def _window(self) -> MainWindow:
        """Return the window that stands: another language replaces it."""
        return self._holder.window

    def run(self) -> None:
        """Use the window, then close it."""
        try:
            self._use()
        except TimeoutError:
            self._fail([Failure("answer", f"the window did not answer for {FROZEN_S:.0f} s")])
        except BaseException as error:
            self._fail([Failure("log", f"{type(error).__name__}: {error}")])
        finally:
            code = 3 if self.failed else 0
            self._log.close()
            os._exit(code)  # a window that hangs is not waited for

    def _use(self) -> None:
        end = time.monotonic() + READY_S
        while not self._asked.of(lambda: self._window.isVisible(), READY_S):
            time.sleep(0.1)
        time.sleep(LOADS_S)  # the first start of a day loads libraries from a cold disk
        self._asked.of(self._checks.after, READY_S)
        end = time.monotonic() + self._options.seconds
        for action in self._actions(end):
            print(action.text(), file=self._log)
            self._do(action)
            found = self._asked.of(self._checks.after)
            if found:
                time.sleep(SETTLES_S)
                lasting = self._asked.of(self._checks.after)
                passing = {"text", "quantity", "patient"}
                found = [one for one in found if one.check not in passing or one in lasting]
                found += [one for one in lasting if one.check not in passing]
            if found:
                self._fail(found)
                if not self._options.go_on:
                    return

    def _actions(self, end: float):
        if self._options.replay is not None:
            yield from read_actions(self._options.replay)
            return
        while time.monotonic() < end:
            yield draw(self._rng, self._asked.of(self._screen))

    def _fail(self, found: list[Failure]) -> None:
        self.failed += found
        for one in found:
            print(json.dumps({"failed": one.check, "words": one.words}), file=self._log)
        picture = self._options.folder / f"failed-{len(self.failed)}.png"
        with_suppressed(
            lambda: self._asked.of(
                lambda: QApplication.primaryScreen().grabWindow(0).save(str(picture)), 5.0
            )
        )

    # --- what is on the screen ----------------------------------------------------------------
    def _screen(self) -> Screen:
        window, front = self._window, top()
        if front is None:
            front = window
        buttons = window.workspace.exercise_panel.buttons
        main = front is window
        box = seen_box(front)
        return Screen(
            controls=tuple(t for t in targets(front, CONTROLS) if t.words != "Quit"),
            pictures=tuple(targets(front, PICTURES)),
            runs=buttons.end.isEnabled(),
            end=_target(buttons.end) if main else None,
            scan=_target(buttons.scan) if main else None,
            entries=tuple(menu_items(front)) if isinstance(front, QMenu) else (),
            titles=tuple(menu_titles(window)) if main else (),
            front=None if box is None else Target(path_of(front), words_of(front), box),
            is_main=main,
            is_file_dialog=is_file_dialog(front),
            exercises=tuple(window.feature(ExerciseFeature).exercises),
            cts=tuple(str(path) for path in self._options.ct),
        )

    def _box(self, path: str) -> tuple[int, int, int, int] | None:
        widget = find(path)
        return None if widget is None else seen_box(widget)

    # --- what the user does -------------------------------------------------------------------
    def _do(self, action: Action) -> None:
        if action.kind in ("click", "double", "right", "middle", "drag", "wheel"):
            box = self._asked.of(lambda: self._box(action.path))
            if box is not None:
                act = {"drag": hands.drag, "wheel": hands.wheel}.get(action.kind, hands.click)
                act(box, action)
        elif action.kind in ("menu", "title"):
            entries = self._asked.of(lambda: self._entries(action.kind))
            if action.number < len(entries):
                hands.click(entries[action.number].box, action)
        elif action.kind == "key":
            if action.words == "Escape" or not self._asked.of(lambda: is_file_dialog(top())):
                hands.key(action)
        elif action.kind == "type":
            if not self._asked.of(lambda: is_file_dialog(top())):
                hands.write(action.words)
        elif action.kind == "start":
            self._start(action)
        elif action.kind == "wait":
            hands.wait(action.seconds)
        else:
            self._asked.begin(lambda: self._wish(action))
        time.sleep(0.05)

    def _start(self, action: Action) -> None:
        """Go where the start button is, and press it as soon as it can be pressed."""
        self._asked.begin(lambda: self._show_exercise(action.words))
        buttons, end = (
            self._window.workspace.exercise_panel.buttons,
            time.monotonic() + action.seconds,
        )
        while (target := self._asked.of(lambda: _target(buttons.start))) is None:
            if time.monotonic() >= end:
                return
            time.sleep(0.2)
        hands.click(target.box, action)

    def _show_exercise(self, identifier: str) -> None:
        """Go to the start button; where no patient is open, or no plan, begin an exercise first."""
        window = self._window
        if QApplication.activeModalWidget() is not None:
            return
        if window.conductor.patient is None or window.editor.verdict.placed is None:
            window.begin_exercise(identifier)
        else:
            window.show_workspace()
            window.workspace.show_exercise()

    def _entries(self, kind: str) -> list[Target]:
        front = top()
        if kind == "title":
            return menu_titles(self._window)
        return menu_items(front) if isinstance(front, QMenu) else []

    def _wish(self, action: Action) -> None:
        """Do what has many ways: a drop, the start page, the window's frame."""
        window = self._window
        if QApplication.activeModalWidget() is not None:
            return  # nobody gets at the window behind it
        if action.kind == "exercise":
            window.begin_exercise(action.words)
        elif action.kind == "ct":
            window.open_ct.open_folder(Path(action.words))
        elif action.kind == "page":
            (
                window.show_start,
                window.show_workspace,
                window.feature(DebriefFeature).show_sessions,
                window.feature(DebriefFeature).show,
            )[action.number]()
        elif action.kind == "size":
            window.resize(*action.to)
        elif action.kind == "role":
            window.roles.choose(Role(action.words))
        elif action.kind == "language":
            self._holder.change(action.words)


def _target(widget) -> Target | None:
    if not (widget.isVisible() and widget.isEnabled()):
        return None
    box = seen_box(widget)
    return None if box is None else Target(path_of(widget), words_of(widget), box)


def with_suppressed(operation: Callable[[], object]) -> None:
    """Try what is not worth a failure."""
    try:
        operation()
    except Exception as error:
        print(f"no picture: {error}", file=sys.stderr)


def main() -> None:
    """Run the window until the user has done enough."""
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--plant", choices=sorted(DEFECTS))
    parser.add_argument("--replay", type=Path)
    parser.add_argument("--ct", type=Path, action="append", default=[])
    parser.add_argument("--answer", type=float, default=ANSWER_S)
    parser.add_argument("--go-on", action="store_true", help="after a failure too")
    options = parser.parse_args()
    application = start()
    ReadOnlyFiles(application)
    services = Desktop()
    holder = Rebuilding(lambda: MainWindow(services))
    window = holder.window
    window.resize(1366, 768)
    window.show()
    checks = Checks(holder, options.folder / "stacks.txt", options.answer)
    if options.plant:
        DEFECTS[options.plant](window)
    asked = Asked()
    CarelessUser(holder, checks, asked, options).start()
    application.exec()
    holder.close()
    os._exit(0)  # the user closed the window


if __name__ == "__main__":
    main()
