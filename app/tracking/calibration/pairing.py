"""Which pictures were taken together: by their names.

The rule: a name says its camera once, and the rest of the name is the same for both cameras.
Cameras are `left`/`right`, `cameraN`/`camN` with two numbers N (the lower one is the left camera),
or `l`/`r` or `0`/`1` standing alone between `_`, `-`, `.`, blanks or the name's ends (`l` and `r`
also before a number). Case and leading zeros of numbers do not matter:

    left01.jpg + right01.jpg     camera0_3.png + camera1_3.png     0_12.png + 1_12.png

In two folders (`left/` and `right/`, or `--left` and `--right`) the rest alone is compared, and the
camera's word may be missing. A picture without partner is refused by name, and so is a second one
of the same camera and number.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from app.tracking.calibration.pictures import has_pictures, list_pictures
from app.tracking.errors import CalibrationError

_WORDS = (
    re.compile(r"(?P<camera>left|right)"),
    re.compile(r"(?:camera|cam)[_\- ]?(?P<camera>\d+)"),
    re.compile(r"(?:^|(?<=[_\-. ]))(?P<camera>[lr])(?=[_\-. \d]|$)"),
    re.compile(r"(?:^|(?<=[_\-. ]))(?P<camera>[01])(?=[_\-. ]|$)"),
)
_ORDER = {"left": "0", "right": "1", "l": "0", "r": "1"}

Key = tuple[tuple[int, str], ...]


@dataclass(frozen=True)
class Pair:
    """Two pictures taken together.

    Attributes:
        name: what both names have in common; their number, mostly.
        left, right: files.
    """

    name: str
    left: Path
    right: Path


def pair_by_name(paths: Sequence[Path]) -> list[Pair]:
    """Pair the pictures of one folder.

    Raises:
        CalibrationError: naming the pictures without camera or partner.
    """
    left, right = split_by_camera(paths)
    return _joined(left, right)


def pair_folder(folder: Path) -> list[Pair]:
    """Pair the pictures of a folder, or of its two subfolders, one per camera.

    Raises:
        CalibrationError: naming the pictures without camera or partner; or without pictures.
    """
    inside = sorted(path for path in folder.glob("*") if path.is_dir()) if folder.is_dir() else []
    words = [
        _WORDS[0].search(path.name.lower()) or _WORDS[1].search(path.name.lower())
        for path in inside
    ]
    cameras = [(path, word) for path, word in zip(inside, words, strict=True) if word is not None]
    if len(cameras) == 2 and not has_pictures(folder):
        left, right = sorted(cameras, key=lambda item: int(_camera(item[1])))
        return pair_folders(list_pictures(left[0]), list_pictures(right[0]))
    return pair_by_name(list_pictures(folder))


def cameras_of(paths: Sequence[Path]) -> dict[str, list[Path]]:
    """Pictures by camera, where all names say one of two; else all of them as `camera`."""
    try:
        left, right = split_by_camera(paths)
    except CalibrationError:
        return {"camera": list(paths)}
    words = {"left", "right"} <= {w[0] for p in paths if (w := _WORDS[0].search(_stem(p)))}
    names = ("left", "right") if words else ("camera0", "camera1")
    return dict(zip(names, ([path for _, path in left], [path for _, path in right]), strict=True))


def split_by_camera(paths: Sequence[Path]) -> tuple[list[tuple[Key, Path]], list[tuple[Key, Path]]]:
    """Pictures of both cameras, each with what is left of its name.

    Raises:
        CalibrationError: if a name says no camera, or there are not two of them.
    """
    word = max(_WORDS, key=lambda w: sum(w.search(_stem(path)) is not None for path in paths))
    found = [(path, word.search(_stem(path))) for path in paths]
    if lost := [path.name for path, match in found if match is None]:
        raise CalibrationError(
            f"{_listed(lost)}: the name does not say the camera; name pictures e.g. left01.png and "
            "right01.png, or camera0_1.png and camera1_1.png"
        )
    named = [(_camera(match), path, _rest(match)) for path, match in found if match is not None]
    cameras = sorted({camera for camera, _, _ in named}, key=int)
    if len(cameras) != 2:
        raise CalibrationError(
            f"the names of the pictures speak of {len(cameras)} camera(s); two are needed, e.g. "
            "left01.png and right01.png"
        )
    left, right = (
        [(key, path) for camera, path, key in named if camera == wanted] for wanted in cameras
    )
    return left, right


def pair_folders(left: Sequence[Path], right: Sequence[Path]) -> list[Pair]:
    """Pair the pictures of two folders.

    Raises:
        CalibrationError: naming the pictures without partner.
    """
    return _joined([(_key(path), path) for path in left], [(_key(path), path) for path in right])


def _joined(left: Iterable[tuple[Key, Path]], right: Iterable[tuple[Key, Path]]) -> list[Pair]:
    lefts, rights = _unique(left), _unique(right)
    lone = [lefts[key].name for key in lefts if key not in rights]
    lone += [rights[key].name for key in rights if key not in lefts]
    if lone:
        raise CalibrationError(
            f"{_listed(lone)}: no picture of the other camera has that number; add it, or take the "
            "picture away (docs/calibration.md says how names are paired)"
        )
    return [Pair(_text(key), lefts[key], rights[key]) for key in sorted(lefts)]


def _unique(found: Iterable[tuple[Key, Path]]) -> dict[Key, Path]:
    known: dict[Key, Path] = {}
    for key, path in found:
        if key in known:
            raise CalibrationError(
                f"{known[key].name} and {path.name} are both number {_text(key) or '(none)'} of "
                "one camera; keep one of them"
            )
        known[key] = path
    return known


def _stem(path: Path) -> str:
    return path.stem.lower()


def _camera(match: re.Match[str]) -> str:
    word = match["camera"]
    return str(int(_ORDER.get(word, word)))


def _key(path: Path) -> Key:
    """Name without the camera's word, if it has one."""
    found = (word.search(_stem(path)) for word in _WORDS[:3])
    match = next((match for match in found if match is not None), None)
    return _parts(_stem(path)) if match is None else _rest(match)


def _rest(match: re.Match[str]) -> Key:
    return _parts(match.string[: match.start()] + " " + match.string[match.end() :])


def _parts(text: str) -> Key:
    """Words and numbers in order; numbers compare as numbers and come before words."""
    words = re.findall(r"\d+|[^\W\d_]+", text)
    return tuple((int(word), "") if word.isdigit() else (-1, word) for word in words)


def _text(key: Key) -> str:
    return "_".join(word or str(number) for number, word in key)


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - 5} more" if len(names) > 5 else ""
    return ", ".join(names[:5]) + more
