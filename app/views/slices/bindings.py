"""What mouse and keys do in a slice: one table for each scheme, from which the sheet is made too.

`OHIF` follows OHIF and cornerstone, `SLICER` 3D Slicer. Where their keys meet those of an attempt
the attempt wins, in every state, so that no habit learnt on one page is dangerous on another: `H`
switches the robot's forces on and is never a flip (that is `M`), `S` is the control scan, `Enter`
ends the attempt, and holding `Esc` aborts it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from PySide6.QtCore import QKeyCombination, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence

from app.views.kit.text import tr

_M = Qt.KeyboardModifier
_B = Qt.MouseButton
NONE, SHIFT, CTRL = _M.NoModifier, _M.ShiftModifier, _M.ControlModifier
_SEEN = _M.ShiftModifier | _M.ControlModifier | _M.AltModifier


class Drag(StrEnum):
    """What dragging with a button does."""

    WINDOW = "window"
    PAN = "pan"
    ZOOM = "zoom"
    BOX = "box"
    CROSSHAIR = "crosshair"


class Wheel(StrEnum):
    """What the wheel does."""

    SCROLL = "scroll"
    ZOOM = "zoom"
    SLAB = "slab"


class Action(StrEnum):
    """What a key does in the pane that has the keyboard; a digit chooses a window."""

    NEXT = "next"
    PREVIOUS = "previous"
    TEN_ON = "ten_on"
    TEN_BACK = "ten_back"
    FIRST = "first"
    LAST = "last"
    ZOOM_IN = "zoom_in"
    ZOOM_OUT = "zoom_out"
    FIT = "fit"
    RESET = "reset"
    CANCEL = "cancel"
    ZOOM_TOOL = "zoom_tool"
    INVERT = "invert"
    TURN_RIGHT = "turn_right"
    TURN_LEFT = "turn_left"
    MIRROR = "mirror"
    MIRROR_UPRIGHT = "mirror_upright"
    SLAB_KIND = "slab_kind"
    THICKER = "thicker"
    THINNER = "thinner"
    CINE = "cine"
    PANE_ON = "pane_on"
    PANE_BACK = "pane_back"
    MAXIMISE = "maximise"
    PLACE = "place"
    LEFT = "left"
    RIGHT = "right"
    UP = "up"
    DOWN = "down"
    MENU = "menu"


@dataclass(frozen=True, slots=True)
class Scheme:
    """The bindings of one way to work.

    Attributes:
        name: what it is remembered by.
        title: name for people, a trade name.
        level_rises_upwards: whether dragging up raises the level.
        drags: what a button with these modifiers does.
        wheels: what the wheel with these modifiers does.
        keys: what a key, written as Qt writes it, does.
        menu_keys: keys of the window's menu that differ between schemes.
    """

    name: str
    title: str
    level_rises_upwards: bool
    drags: Mapping[tuple[Qt.MouseButton, Qt.KeyboardModifier], Drag]
    wheels: Mapping[Qt.KeyboardModifier, Wheel]
    keys: Mapping[str, Action]
    menu_keys: Mapping[str, str]

    def drag(self, button: Qt.MouseButton, modifiers: Qt.KeyboardModifier) -> Drag | None:
        """Return what this button does; modifiers that mean nothing here are ignored."""
        known = self.drags.get((button, modifiers & _SEEN))
        return known or self.drags.get((button, NONE))

    def wheel(self, modifiers: Qt.KeyboardModifier) -> Wheel:
        """Return what the wheel does."""
        return self.wheels.get(modifiers & _SEEN, Wheel.SCROLL)

    def action(self, event: QKeyEvent) -> Action | None:
        """Return what this key does here, if anything."""
        return self.keys.get(key_name(event))


_WHEELS = {NONE: Wheel.SCROLL, CTRL: Wheel.ZOOM, SHIFT: Wheel.SLAB}

_KEYS = {
    "Up": Action.NEXT,
    "Down": Action.PREVIOUS,
    "PgUp": Action.TEN_ON,
    "PgDown": Action.TEN_BACK,
    "Home": Action.FIRST,
    "End": Action.LAST,
    "+": Action.ZOOM_IN,
    "-": Action.ZOOM_OUT,
    "=": Action.FIT,
    "Space": Action.RESET,
    "Esc": Action.CANCEL,
    "Z": Action.ZOOM_TOOL,
    "I": Action.INVERT,
    "M": Action.MIRROR,
    "K": Action.SLAB_KIND,
    "]": Action.THICKER,
    "[": Action.THINNER,
    "C": Action.CINE,
    "X": Action.MAXIMISE,
    "Return": Action.PLACE,
    "Enter": Action.PLACE,
    "Ctrl+Left": Action.LEFT,
    "Ctrl+Right": Action.RIGHT,
    "Ctrl+Up": Action.UP,
    "Ctrl+Down": Action.DOWN,
    "Menu": Action.MENU,
    "Shift+F10": Action.MENU,
}

_MEASURE = {"distance": "D", "angle": "G", "probe": "U", "region": "O"}
"""Keys of the menu *Measure*: alike in all schemes, as neither model has a habit to keep."""

OHIF = Scheme(
    "ohif",
    "OHIF",
    False,
    {
        (_B.LeftButton, NONE): Drag.WINDOW,
        (_B.MiddleButton, NONE): Drag.PAN,
        (_B.RightButton, NONE): Drag.ZOOM,
        (_B.LeftButton, CTRL): Drag.PAN,
        (_B.LeftButton, SHIFT): Drag.CROSSHAIR,
        (_B.LeftButton, CTRL | SHIFT): Drag.BOX,
    },
    _WHEELS,
    _KEYS
    | {
        "Right": Action.PANE_ON,
        "Left": Action.PANE_BACK,
        "R": Action.TURN_RIGHT,
        "L": Action.TURN_LEFT,
        "V": Action.MIRROR_UPRIGHT,
    },
    {"follow": "F", "bullseye": "B"} | _MEASURE,
)
"""OHIF and cornerstone: dragging down raises the level."""

SLICER = Scheme(
    "slicer",
    "3D Slicer",
    True,
    {
        (_B.LeftButton, NONE): Drag.WINDOW,
        (_B.MiddleButton, NONE): Drag.PAN,
        (_B.RightButton, NONE): Drag.ZOOM,
        (_B.LeftButton, SHIFT): Drag.PAN,
        (_B.LeftButton, CTRL): Drag.BOX,
    },
    _WHEELS,
    _KEYS
    | {
        "Right": Action.NEXT,
        "Left": Action.PREVIOUS,
        "F": Action.NEXT,
        "B": Action.PREVIOUS,
        "R": Action.RESET,
        "Shift+R": Action.TURN_RIGHT,
        "Shift+L": Action.TURN_LEFT,
        "Shift+M": Action.MIRROR_UPRIGHT,
    },
    {"follow": "Shift+F", "bullseye": "Shift+B"} | _MEASURE,
)
"""3D Slicer: dragging up raises the level."""

SCHEMES = {scheme.name: scheme for scheme in (OHIF, SLICER)}
"""The schemes to choose from, the default first."""

RESERVED = ("A", "H", "J", "S", "E", "T")
"""Keys of an attempt and of the plan, which no scheme may use in a slice."""


def key_name(event: QKeyEvent) -> str:
    """Name of a key with its modifiers, as the tables have it; Shift is left out where it is only
    what the key needs on some keyboards, as for `+`.
    """
    key, modifiers = Qt.Key(event.key()), event.modifiers() & _SEEN
    if 0x21 <= key <= 0x7E and not Qt.Key.Key_A <= key <= Qt.Key.Key_Z:
        modifiers &= ~SHIFT
    return QKeySequence(QKeyCombination(modifiers, key)).toString()


def digit(event: QKeyEvent) -> int | None:
    """Return the digit that was pressed without Ctrl or Alt, if one was."""
    if event.modifiers() & (CTRL | _M.AltModifier):
        return None
    number = event.key() - Qt.Key.Key_0
    return number if 0 <= number <= 9 else None


def action_words() -> dict[Action, str]:
    """Return what each action does, in the order of the sheet."""
    return {
        Action.NEXT: tr("one slice on, back"),
        Action.TEN_ON: tr("ten slices on, back"),
        Action.FIRST: tr("first, last slice"),
        Action.ZOOM_IN: tr("zoom in, out"),
        Action.FIT: tr("fit to pane"),
        Action.RESET: tr("reset zoom, window and slab"),
        Action.ZOOM_TOOL: tr("left drag zooms, until Esc"),
        Action.INVERT: tr("invert grey"),
        Action.TURN_RIGHT: tr("turn right, left by 90°"),
        Action.MIRROR: tr("mirror left-right, top-bottom"),
        Action.THINNER: tr("slab thinner, thicker"),
        Action.SLAB_KIND: tr("slab: mean, MIP, MinIP"),
        Action.CINE: tr("cine: start, stop"),
        Action.MAXIMISE: tr("maximise or restore the pane"),
        Action.PANE_BACK: tr("previous, next pane"),
        Action.LEFT: tr("move the crosshair"),
        Action.PLACE: tr("with E or T before: place at the crosshair"),
        Action.MENU: tr("menu of the pane"),
        Action.CANCEL: tr("stop the current action"),
    }


_TOGETHER: dict[Action, tuple[Action, ...]] = {
    Action.NEXT: (Action.PREVIOUS,),
    Action.TEN_ON: (Action.TEN_BACK,),
    Action.FIRST: (Action.LAST,),
    Action.ZOOM_IN: (Action.ZOOM_OUT,),
    Action.TURN_RIGHT: (Action.TURN_LEFT,),
    Action.MIRROR: (Action.MIRROR_UPRIGHT,),
    Action.THINNER: (Action.THICKER,),
    Action.PANE_BACK: (Action.PANE_ON,),
    Action.LEFT: (Action.RIGHT, Action.UP, Action.DOWN),
}
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
        Drag.PAN: tr("pan"),
        Drag.ZOOM: tr("zoom"),
        Drag.CROSSHAIR: tr("crosshair in all views"),
        Drag.BOX: tr("best window for the box"),
    }
    wheels = {
        Wheel.SCROLL: tr("scroll through slices"),
        Wheel.ZOOM: tr("zoom"),
        Wheel.SLAB: tr("slab thinner, thicker"),
    }
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
    names = {
        _B.LeftButton: tr("Left drag"),
        _B.MiddleButton: tr("Middle drag"),
        _B.RightButton: tr("Right drag"),
    }
    return _with(names[button], modifiers)


def _with(name: str, modifiers: Qt.KeyboardModifier) -> str:
    held = [word for bit, word in ((CTRL, "Ctrl"), (SHIFT, "Shift")) if modifiers & bit]
    return "+".join([*held, name.lower() if held else name])
