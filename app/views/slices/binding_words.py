"""What the bindings of mouse and keys are in words: the rows of the sheet."""

from __future__ import annotations

from PySide6.QtCore import Qt

from app.views.kit.text import tr
from app.views.slices.bindings import CTRL, SHIFT, Action, Drag, Scheme, Wheel

_B = Qt.MouseButton


def action_words() -> dict[Action, str]:
    """Return what each action does, in the order of the sheet."""
    return {
        Action.NEXT: tr("one slice on, back"), Action.TEN_ON: tr("ten slices on, back"),
        Action.FIRST: tr("first, last slice"), Action.ZOOM_IN: tr("zoom in, out"),
        Action.FIT: tr("fit to pane"), Action.RESET: tr("reset zoom, window and slab"),
        Action.ZOOM_TOOL: tr("left drag zooms, until Esc"), Action.INVERT: tr("invert grey"),
        Action.TURN_RIGHT: tr("turn right, left by 90°"),
        Action.MIRROR: tr("mirror left-right, top-bottom"),
        Action.THINNER: tr("slab thinner, thicker"), Action.SLAB_KIND: tr("slab: mean, MIP, MinIP"),
        Action.CINE: tr("cine: start, stop"), Action.MAXIMISE: tr("maximise or restore the pane"),
        Action.PANE_BACK: tr("previous, next pane"), Action.LEFT: tr("move the crosshair"),
        Action.PLACE: tr("with E or T before: place at the crosshair"),
        Action.MENU: tr("menu of the pane"), Action.CANCEL: tr("stop what is going on"),
    }  # fmt: skip


_TOGETHER: dict[Action, tuple[Action, ...]] = {
    Action.NEXT: (Action.PREVIOUS,), Action.TEN_ON: (Action.TEN_BACK,),
    Action.FIRST: (Action.LAST,),
    Action.ZOOM_IN: (Action.ZOOM_OUT,), Action.TURN_RIGHT: (Action.TURN_LEFT,),
    Action.MIRROR: (Action.MIRROR_UPRIGHT,), Action.THINNER: (Action.THICKER,),
    Action.PANE_BACK: (Action.PANE_ON,), Action.LEFT: (Action.RIGHT, Action.UP, Action.DOWN),
}  # fmt: skip
"""Actions that share a row of the sheet with the one before."""

_ARROWS = {"Up": "↑", "Down": "↓", "Left": "←", "Right": "→"}


def _shown(key: str) -> str:
    *modifiers, last = [key] if key == "+" else key.split("+")
    return "+".join([*modifiers, _ARROWS.get(last, last)])


def key_rows(scheme: Scheme) -> list[tuple[str, str]]:
    """Rows of the sheet for the keys of a scheme: what to press, what it does."""
    rows = []
    for action, words in action_words().items():
        group = (action, *_TOGETHER.get(action, ()))
        keys = [_shown(key) for one in group for key, does in scheme.keys.items() if does is one]
        if keys:
            rows.append(("  ".join(keys), words))
    return rows


def mouse_rows(scheme: Scheme) -> list[tuple[str, str]]:
    """Rows of the sheet for the mouse."""
    level = tr("up") if scheme.level_rises_upwards else tr("down")
    words = {
        Drag.WINDOW: tr("window (right: wider) and level ({way}: higher)", way=level),
        Drag.PAN: tr("pan"), Drag.ZOOM: tr("zoom"), Drag.CROSSHAIR: tr("crosshair in all views"),
        Drag.BOX: tr("best window for the box"),
    }  # fmt: skip
    wheels = {
        Wheel.SCROLL: tr("scroll through slices"), Wheel.ZOOM: tr("zoom"),
        Wheel.SLAB: tr("slab thinner, thicker"),
    }  # fmt: skip
    rows = [
        (", ".join(_drag_name(*at) for at, does in scheme.drags.items() if does is drag), text)
        for drag, text in words.items()
    ]
    rows += [(_with(tr("Wheel"), at), wheels[does]) for at, does in scheme.wheels.items()]
    rows += [
        (tr("Shift+move"), tr("crosshair in all views")),
        (tr("Right click"), tr("menu: windows, slab, turn, cine")),
        (tr("Double click"), tr("maximise or restore a pane")),
        (tr("Ctrl+double click"), tr("reset window and level")),
    ]
    return [row for row in rows if row[0]]


def _drag_name(button: Qt.MouseButton, modifiers: Qt.KeyboardModifier) -> str:
    names = {_B.LeftButton: tr("Left drag"), _B.MiddleButton: tr("Middle drag"),
             _B.RightButton: tr("Right drag")}  # fmt: skip
    return _with(names[button], modifiers)


def _with(name: str, modifiers: Qt.KeyboardModifier) -> str:
    held = [word for bit, word in ((CTRL, "Ctrl"), (SHIFT, "Shift")) if modifiers & bit]
    return "+".join([*held, name.lower() if held else name])
