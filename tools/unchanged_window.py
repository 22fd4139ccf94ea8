"""Print menus, keys, pages and panels of the real window; `tools/unchanged.py` runs it.

    python tools/unchanged_window.py STATE

Widgets are walked as Qt has them, by the classes of Qt that they are: the program's own classes may
have other names.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Final

from unchanged_inside import name  # type: ignore[import-not-found]  # both run by their path

PASSWORD: Final = "correct horse"
EXERCISE: Final = "thick-tissue"
DIALOGS: Final = ("Keys and mouse", "About Acus")
"""Entries of menus whose dialogs are written too."""
QUIET_S: Final = 2.0
"""What is read beside the window has come after so long."""
PATIENCE_S: Final = 600.0
ROWS: Final = 40
"""Of a table so many rows are written."""


def window(state: str) -> Iterator[str]:
    """Yield menus, keys, pages and panels of the window.

    Args:
        state: `open` (nobody has set a password), `exercise` (the same, an exercise and its patient
            are open: menus and keys only), or `guarded` (a password is set: what nobody, a student
            and the instructor reach).
    """
    from PySide6.QtWidgets import QApplication

    student = None
    if state == "guarded":
        people = name("people")()
        student, _ = people.add(name("line of a roster")("Ada", pin="482917"))
        people.set_instructor(PASSWORD)
    _application = name("start of Qt")(offscreen=True)  # kept as long as the window
    sessions = Path(os.environ["ACUS_SESSIONS"])
    sessions.mkdir(exist_ok=True)
    shown = name("window")(name("services")(sessions=sessions))
    shown.resize(1366, 768)

    def settle(until: Callable[[], bool] | None = None) -> None:
        end = time.monotonic() + (QUIET_S if until is None else PATIENCE_S)
        while time.monotonic() < end and not (until and until()):
            QApplication.processEvents()
            time.sleep(0.005)

    settle()
    access = name("who is signed in")
    if state == "open":
        yield from _menus(shown)
        yield from _pages(shown)
        yield from _dialogs(shown, settle)
    elif state == "exercise":
        shown.begin_exercise(EXERCISE)
        settle(lambda: "Thick tissue" in shown.windowTitle())
        settle()
        settle()
        yield shown.windowTitle()
        yield from _menus(shown)
    else:
        roles = {"nobody": (None, False), "student": (student, False), "instructor": (None, True)}
        for role, signed in roles.items():
            access.sign_in(*signed)
            settle()
            yield f"=== {role}: {shown.windowTitle()}"
            yield from _menus(shown)
            yield from _pages(shown)


def _menus(shown: Any) -> Iterator[str]:
    """Yield the menu bar with all entries, then keys that stand in no menu."""
    from PySide6.QtGui import QAction, QShortcut

    yield "--- menus"
    seen: set[int] = set()
    for action in shown.menuBar().actions():
        yield from _entry(action, "", seen)
    yield "--- other keys"
    others = [
        f"{keys}  {action.text()}"
        for action in shown.findChildren(QAction)
        if id(action) not in seen and (keys := _keys(action))
    ]
    others += [
        f"{shortcut.key().toString()}  (shortcut)" for shortcut in shown.findChildren(QShortcut)
    ]
    yield from sorted(others)


def _entry(action: Any, indent: str, seen: set[int]) -> Iterator[str]:
    seen.add(id(action))
    if action.isSeparator():
        yield f"{indent}----"
        return
    marks = [] if action.isEnabled() else ["disabled"]
    marks += [] if action.isVisible() else ["hidden"]
    marks += [("checked" if action.isChecked() else "unchecked")] if action.isCheckable() else []
    tip = action.toolTip() if action.toolTip() != action.text().replace("&", "") else ""
    row = [action.text(), _keys(action), ", ".join(marks), tip, action.whatsThis()]
    yield f"{indent}{_joined(row)}"
    if (menu := action.menu()) is not None:
        menu.aboutToShow.emit()
        for below in menu.actions():
            yield from _entry(below, f"{indent}    ", seen)


def _keys(action: Any) -> str:
    return ", ".join(key.toString() for key in action.shortcuts())


def _joined(parts: list[str]) -> str:
    return "  |  ".join(" ".join(part.split()) for part in parts if part)


def _pages(shown: Any) -> Iterator[str]:
    """Yield what stands on every page of the window, whichever is in front."""
    from PySide6.QtWidgets import QDockWidget, QStackedWidget

    central = shown.centralWidget()
    stacks = [central, *central.findChildren(QStackedWidget)]
    stack = next(one for one in stacks if isinstance(one, QStackedWidget))
    for number in range(stack.count()):
        yield f"--- page {number}"
        yield from _texts(stack.widget(number))
    for dock in shown.findChildren(QDockWidget):
        yield f"--- dock {dock.windowTitle()}"
        yield from _texts(dock)
    yield "--- around the pages"
    for child in shown.children():
        if (
            child.isWidgetType()
            and child not in (central, shown.menuBar())
            and not child.isWindow()
        ):
            yield from _texts(child)


def _dialogs(shown: Any, settle: Callable[[], None]) -> Iterator[str]:
    from PySide6.QtGui import QAction
    from PySide6.QtWidgets import QApplication, QDialog

    entries = {one.text().replace("&", ""): one for one in shown.findChildren(QAction)}
    for text in DIALOGS:
        yield f"--- dialog {text}"
        if text not in entries:
            yield "no such entry"
            continue
        entries[text].trigger()
        for dialog in [one for one in QApplication.topLevelWidgets() if isinstance(one, QDialog)]:
            if dialog.isVisible():
                yield dialog.windowTitle()
                yield from _texts(dialog)
                dialog.reject()
        settle()


def _texts(root: Any) -> Iterator[str]:
    """Yield a line for each widget that says or asks something, in the order of their making."""
    from PySide6.QtWidgets import QWidget

    for widget in [root, *root.findChildren(QWidget)]:
        if widget.objectName().startswith("qt_"):
            continue
        kind = next(one.__name__ for one in type(widget).__mro__ if "PySide6" in one.__module__)
        said = [*_said(widget), widget.toolTip(), widget.accessibleName()]
        if kind not in ("QWidget", "QFrame") and not widget.isEnabledTo(root):
            said.append("disabled")
        if any(said) and widget is not root and not widget.isVisibleTo(root):
            said.append("hidden")
        if any(part for part in said if part not in ("disabled", "hidden")):
            yield f"{kind}: {_joined(said)}"


def _said(widget: Any) -> Iterator[str]:
    from PySide6 import QtWidgets as Qt6
    from PySide6.QtCore import QAbstractListModel, Qt

    if isinstance(widget, Qt6.QLabel):
        yield widget.text()
    elif isinstance(widget, Qt6.QAbstractButton):
        yield widget.text()
        yield widget.shortcut().toString()
        yield ("checked" if widget.isChecked() else "unchecked") if widget.isCheckable() else ""
    elif isinstance(widget, Qt6.QGroupBox):
        yield widget.title()
    elif isinstance(widget, Qt6.QComboBox):
        items = " / ".join(widget.itemText(k) for k in range(widget.count()))
        yield f"[{items}] at {widget.currentText()!r}"
    elif isinstance(widget, Qt6.QTabBar):
        yield " / ".join(widget.tabText(k) for k in range(widget.count()))
    elif isinstance(widget, Qt6.QSpinBox | Qt6.QDoubleSpinBox):
        ends = f"{widget.minimum():g} to {widget.maximum():g}"
        yield f"{widget.text()!r} of {ends} by {widget.singleStep():g}"
    elif isinstance(widget, Qt6.QSlider):
        yield f"{widget.value()} of {widget.minimum()} to {widget.maximum()}"
    elif isinstance(widget, Qt6.QLineEdit):
        yield _joined([widget.text(), widget.placeholderText()])
    elif isinstance(widget, Qt6.QTextEdit | Qt6.QPlainTextEdit):
        yield _joined([widget.toPlainText(), widget.placeholderText()])
    elif isinstance(widget, Qt6.QAbstractItemView) and (model := widget.model()) is not None:
        root = widget.rootIndex()
        wide = 1 if isinstance(model, QAbstractListModel) else model.columnCount(root)
        columns, rows = range(wide), range(min(model.rowCount(root), ROWS))
        heads = [str(model.headerData(k, Qt.Orientation.Horizontal)) for k in columns]
        yield f"{heads}, {model.rowCount(root)} rows"
        yield " / ".join(str(model.index(k, j, root).data()) for k in rows for j in columns)


def main() -> None:
    """Print a state. What Qt would take apart at the end is left as it is."""
    for line in window(sys.argv[1]):
        sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
