"""What a careless user does next: drawn from a seed and from what is on the screen, kept as data.

An action is a frozen value that can be written down and done again in another run: it names its
widget by its path and the place in it by shares of its width and height.
"""

from __future__ import annotations

import json
import random
from dataclasses import asdict, dataclass
from pathlib import Path

from tests.careless.targets import Target

KEYS = (
    *"abcdefghijklmnopqrstuvwxyz0123456789", "Return", "Escape", "space", "Tab", "shift+Tab", "Up",
    "Down", "Left", "Right", "Prior", "Next", "Home", "End", "F1", "F5", "F11", "plus", "minus",
    "bracketleft", "bracketright", "BackSpace", "Delete", "ctrl+z", "ctrl+y", "ctrl+shift+z",
    "ctrl+n", "ctrl+s", "ctrl+a", "ctrl+c", "ctrl+v", "alt+f", "shift+Up", "shift+Down",
    "ctrl+1", "ctrl+2", "ctrl+3", "ctrl+4",
)  # fmt: skip
SIZES = ((1366, 768), (1280, 720), (1920, 1080), (1600, 900), (1440, 1000))
ROLES = ("student", "instructor", "technician")
LANGUAGES = ("en", "de", "fr")
TEXTS = ("../../etc", "P-001", "", "ää", "0", "-1", "1e9", "nonsense", "12,5", "a" * 80)


@dataclass(frozen=True, slots=True)
class Action:
    """One thing that the user does.

    Attributes:
        kind: `click`, `double`, `right`, `middle`, `drag`, `wheel`, `key`, `type`, `menu`,
            `exercise`, `ct`, `page`, `size`, `role`, `language`, `start`, `wait`.
        path: of the widget, see `targets.path_of`; empty where it is not about one.
        at: place in it, shares of width and height.
        to: of a drag, its end [px from its start]; of a size, width and height [px].
        number: notches of a wheel (negative: towards oneself), steps of a drag, entry of a menu.
        seconds: how long it takes, or what is waited; of a start, for the button to be there.
        words: a key, a text, an exercise, a CT, a role, a language; else what the widget said.
    """

    kind: str
    path: str = ""
    at: tuple[float, float] = (0.5, 0.5)
    to: tuple[int, int] = (0, 0)
    number: int = 0
    seconds: float = 0.0
    words: str = ""

    def text(self) -> str:
        """Return it as one line of JSON, without what is as usual."""
        usual = asdict(Action(self.kind))
        told = {name: value for name, value in asdict(self).items() if value != usual[name]}
        return json.dumps({"kind": self.kind, **told}, ensure_ascii=False)


def read_actions(path: Path) -> list[Action]:
    """Return the actions of a file, one JSON object a line; other lines are passed over."""
    actions = []
    for line in path.read_text().splitlines():
        value = json.loads(line)
        if "kind" in value:
            value["at"], value["to"] = (
                tuple(value.get("at", (0.5, 0.5))),
                tuple(value.get("to", (0, 0))),
            )
            actions.append(Action(**value))
    return actions


@dataclass(frozen=True, slots=True)
class Screen:
    """What the user has before the eyes.

    Attributes:
        controls: buttons, lists, fields, sliders.
        pictures: pad, slices, 3D.
        runs: whether an attempt runs.
        end: the button that ends it, if it can be pressed.
        scan: the button that takes a control scan, if it can be pressed.
        entries: of the menu that is open.
        titles: of the menu bar, where it can be reached.
        front: the window in front.
        is_main: whether that is the main window.
        is_file_dialog: whether it is a dialog of files.
        exercises: identifiers.
        cts: folders that can be opened.
    """

    controls: tuple[Target, ...]
    pictures: tuple[Target, ...]
    runs: bool
    end: Target | None
    scan: Target | None
    entries: tuple[Target, ...]
    titles: tuple[Target, ...]
    front: Target | None
    is_main: bool
    is_file_dialog: bool
    exercises: tuple[str, ...]
    cts: tuple[str, ...]


def draw(rng: random.Random, screen: Screen) -> Action:
    """Return the next action."""
    if screen.is_file_dialog:
        return Action("key", words="Escape")
    if screen.entries and rng.random() < 0.85:
        return Action("menu", number=rng.randrange(len(screen.entries)))
    if not screen.is_main and rng.random() < 0.3:
        return Action("key", words="Escape")
    kinds = {"control": 20, "drag": 16, "wheel": 12, "key": 16, "poke": 8, "wait": 8, "text": 2}
    if screen.is_main:
        kinds |= {"menus": 5, "exercise": 1, "ct": 1, "page": 2, "size": 2}
        kinds |= {"role": 2, "language": 1}
        kinds |= {"end": 3, "scan": 6, "drag": 30, "wheel": 24} if screen.runs else {"start": 9}
    kind = rng.choices(list(kinds), list(kinds.values()))[0]
    return _DRAWN[kind](rng, screen) or Action("wait", seconds=0.2)


def _place(rng: random.Random) -> tuple[float, float]:
    return round(rng.uniform(0.02, 0.98), 3), round(rng.uniform(0.02, 0.98), 3)


def _control(rng: random.Random, screen: Screen) -> Action | None:
    if not screen.controls:
        return None
    target = rng.choice(screen.controls)
    kind = rng.choices(("click", "double", "right"), (10, 1, 1))[0]
    return Action(kind, target.path, _place(rng), words=target.words)


def _drag(rng: random.Random, screen: Screen) -> Action | None:
    if not screen.pictures:
        return None
    pads = [target for target in screen.pictures if "PadCanvas" in target.path]
    target = rng.choice(pads if pads and rng.random() < 0.6 else screen.pictures)
    far = rng.choice((20, 100, 400, 2000))
    to = round(rng.uniform(-far, far)), round(rng.uniform(-far, far))
    seconds = rng.choice((0.05, 0.2, 0.7, 2.0))
    button = rng.choices((1, 2, 3), (8, 1, 1))[0]
    return Action("drag", target.path, _place(rng), to, button, seconds, target.words)


def _wheel(rng: random.Random, screen: Screen) -> Action | None:
    places = screen.pictures or screen.controls
    if not places:
        return None
    pads = [target for target in places if "PadCanvas" in target.path]
    target = rng.choice(pads if pads and rng.random() < 0.6 else places)
    notches = rng.choice((1, 3, 10, 40)) * rng.choice((-1, 1))
    return Action("wheel", target.path, _place(rng), number=notches, words=target.words)


def _key(rng: random.Random, screen: Screen) -> Action | None:
    return Action("key", number=rng.choice((1, 1, 1, 2, 5)), words=rng.choice(KEYS))


def _poke(rng: random.Random, screen: Screen) -> Action | None:
    front = screen.front
    if front is None:
        return None
    return Action(
        rng.choice(("click", "click", "double", "right", "middle")), front.path, _place(rng)
    )


def _wait(rng: random.Random, screen: Screen) -> Action | None:
    return Action("wait", seconds=rng.choice((0.1, 0.5, 1.0, 3.0)))


def _text(rng: random.Random, screen: Screen) -> Action | None:
    return Action("type", words=rng.choice(TEXTS))


def _menus(rng: random.Random, screen: Screen) -> Action | None:
    if not screen.titles:
        return None
    number = rng.randrange(len(screen.titles))
    return Action("title", number=number, words=screen.titles[number].words)


def _exercise(rng: random.Random, screen: Screen) -> Action | None:
    return Action("exercise", words=rng.choice(screen.exercises)) if screen.exercises else None


def _ct(rng: random.Random, screen: Screen) -> Action | None:
    return Action("ct", words=rng.choice(screen.cts)) if screen.cts else None


def _page(rng: random.Random, screen: Screen) -> Action | None:
    return Action("page", number=rng.randrange(4))


def _size(rng: random.Random, screen: Screen) -> Action | None:
    return Action("size", to=rng.choice(SIZES))


def _role(rng: random.Random, screen: Screen) -> Action | None:
    return Action("role", words=rng.choice(ROLES))


def _language(rng: random.Random, screen: Screen) -> Action | None:
    return Action("language", words=rng.choice(LANGUAGES))


def _start(rng: random.Random, screen: Screen) -> Action | None:
    if not screen.exercises:
        return None
    patience = rng.choice((0.0, 5.0, 20.0, 20.0))
    return Action("start", seconds=patience, words=rng.choice(screen.exercises))


def _end(rng: random.Random, screen: Screen) -> Action | None:
    target = screen.end
    if target is None:  # behind another panel or page: where the start button is, it is too
        return Action("start", words=rng.choice(screen.exercises)) if screen.exercises else None
    return Action("click", target.path, words=target.words)


def _scan(rng: random.Random, screen: Screen) -> Action | None:
    target = screen.scan
    if target is None:
        return Action("key", words="s")
    return Action("click", target.path, words=target.words)


_DRAWN = {
    "control": _control, "drag": _drag, "wheel": _wheel, "key": _key, "poke": _poke,
    "wait": _wait, "text": _text, "menus": _menus, "exercise": _exercise, "ct": _ct,
    "page": _page, "size": _size, "role": _role, "language": _language, "start": _start,
    "end": _end, "scan": _scan,
}  # fmt: skip
