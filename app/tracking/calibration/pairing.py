"""Which pictures were taken together: by their names.

The rule: a name says its camera once, and the rest of the name is the same for both cameras.
Cameras are `left`/`right`, `cameraN`/`camN` with two numbers N (the lower one is the left camera),
or `l`/`r` or `0`/`1` standing alone between `_`, `-`, `.`, blanks or the name's ends (`l` and `r`
also before a number). Case and leading zeros of numbers do not matter:

    left01.jpg + right01.jpg     camera0_3.png + camera1_3.png     0_12.png + 1_12.png

In two folders (`left/` and `right/`, or `--left` and `--right`) the rest alone is compared, and the
camera's word may be missing. A picture of a camera without partner serves that camera alone; what
says no camera is skipped; both are named. A second picture of the same camera and number is
refused: which of them belongs to the pair cannot be told.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from app.core.messages import counted, sentence
from app.tracking.calibration.pictures import has_pictures, list_pictures, strange_files
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


@dataclass(frozen=True)
class Paired:
    """What a folder of pictures is.

    Attributes:
        pairs: in the order of their numbers; at least one.
        alone: pictures of the left and of the right camera that have no partner.
        skipped: files that are no pictures of these cameras.
    """

    pairs: tuple[Pair, ...]
    alone: tuple[tuple[Path, ...], tuple[Path, ...]] = ((), ())
    skipped: tuple[Path, ...] = ()

    @property
    def remarks(self) -> list[str]:
        """Return what is not a pair, one line each."""
        lines: list[str] = []
        if self.skipped:
            names = _listed([path.name for path in self.skipped])
            lines.append(
                sentence(
                    "skipped: {names}: not pictures whose names say one of the two cameras",
                    names=names,
                )
            )
        for side, paths in zip(("left", "right"), self.alone, strict=True):
            if paths:
                names = _listed([path.name for path in paths])
                lines.append(
                    sentence(
                        "no partner: {names}: used for the {side} camera alone",
                        names=names,
                        side=side,
                    )
                )
        return lines


def pair_by_name(paths: Sequence[Path]) -> Paired:
    """Pair the pictures of one folder.

    Raises:
        CalibrationError: if no two pictures belong together, most names say no camera, or one
            number was given twice; names them.
    """
    left, right, strays = split_by_camera(paths)
    return _joined(left, right, strays)


def pair_folder(folder: Path) -> Paired:
    """Pair the pictures of a folder, or of its two subfolders, one per camera.

    Raises:
        CalibrationError: as `pair_by_name`; or without pictures.
    """
    inside = sorted(path for path in folder.glob("*") if path.is_dir()) if folder.is_dir() else []
    words = [
        _WORDS[0].search(path.name.lower()) or _WORDS[1].search(path.name.lower())
        for path in inside
    ]
    cameras = [(path, word) for path, word in zip(inside, words, strict=True) if word is not None]
    if len(cameras) == 2 and not has_pairs(folder):
        left, right = sorted(cameras, key=lambda item: int(_camera(item[1])))
        found = pair_folders(list_pictures(left[0]), list_pictures(right[0]))
        places = [folder, left[0], right[0]]
        strays = [path for place in places for path in strange_files(place)]
        beside = list_pictures(folder) if has_pictures(folder) else []
        return replace(found, skipped=(*found.skipped, *beside, *strays))
    found = pair_by_name(list_pictures(folder))
    return replace(found, skipped=(*found.skipped, *strange_files(folder)))


def has_pairs(folder: Path) -> bool:
    """Return whether the pictures that lie in a folder itself pair by their names."""
    if not has_pictures(folder):
        return False
    try:
        return bool(pair_by_name(list_pictures(folder)).pairs)
    except CalibrationError:
        return False


def cameras_of(paths: Sequence[Path]) -> tuple[dict[str, list[Path]], list[Path]]:
    """Pictures by camera, where the names say one of two, and strays; else all as `camera`."""
    try:
        left, right, strays = split_by_camera(paths)
    except CalibrationError:
        return {"camera": list(paths)}, []
    words = {"left", "right"} <= {w[0] for p in paths if (w := _WORDS[0].search(_stem(p)))}
    names = ("left", "right") if words else ("camera0", "camera1")
    groups = [path for _, path in left], [path for _, path in right]
    return dict(zip(names, groups, strict=True)), strays


Keyed = list[tuple[Key, Path]]


def split_by_camera(paths: Sequence[Path]) -> tuple[Keyed, Keyed, list[Path]]:
    """Pictures of both cameras, each with what is left of its name; and those of neither.

    Raises:
        CalibrationError: if half of the names or more say no camera, or there are not two of them.
    """
    word = max(_WORDS, key=lambda w: sum(w.search(_stem(path)) is not None for path in paths))
    found = [(path, word.search(_stem(path))) for path in paths]
    strays = [path for path, match in found if match is None]
    if 2 * len(strays) >= len(paths):
        raise CalibrationError(
            sentence(
                "{listed}: the name does not say the camera; name "
                "pictures e.g. left01.png and right01.png, or camera0_1.png and camera1_1.png",
                listed=_listed([path.name for path in strays]),
            )
        )
    named = [(_camera(match), path, _rest(match)) for path, match in found if match is not None]
    cameras = sorted({camera for camera, _, _ in named}, key=int)
    if len(cameras) != 2:
        raise CalibrationError(
            counted(
                "the names of the pictures speak of {n} camera; two are needed, "
                "e.g. left01.png and right01.png",
                "the names of the pictures speak of {n} cameras; two are needed, "
                "e.g. left01.png and right01.png",
                len(cameras),
            )
        )
    left, right = (
        [(key, path) for camera, path, key in named if camera == wanted] for wanted in cameras
    )
    return left, right, strays


def pair_folders(left: Sequence[Path], right: Sequence[Path]) -> Paired:
    """Pair the pictures of two folders.

    Raises:
        CalibrationError: as `pair_by_name`.
    """
    return _joined(
        [(_key(path), path) for path in left], [(_key(path), path) for path in right], []
    )


def _joined(
    left: Iterable[tuple[Key, Path]], right: Iterable[tuple[Key, Path]], strays: Sequence[Path]
) -> Paired:
    lefts, rights = _unique(left), _unique(right)
    lone = (
        tuple(lefts[key] for key in sorted(lefts) if key not in rights),
        tuple(rights[key] for key in sorted(rights) if key not in lefts),
    )
    pairs = tuple(
        Pair(_text(key), lefts[key], rights[key]) for key in sorted(lefts) if key in rights
    )
    if not pairs:
        names = [path.name for paths in lone for path in paths]
        raise CalibrationError(
            sentence(
                "{listed}: no picture of the other camera has that number; name those taken "
                "together alike (docs/calibration.md says how names are paired)",
                listed=_listed(names),
            )
        )
    return Paired(pairs, lone, tuple(strays))


def _unique(result: Iterable[tuple[Key, Path]]) -> dict[Key, Path]:
    known: dict[Key, Path] = {}
    for key, path in result:
        if key in known:
            raise CalibrationError(
                sentence(
                    "{known_name} and {path_name} are both number {picture_number} of "
                    "one camera; keep one of them",
                    known_name=known[key].name,
                    path_name=path.name,
                    picture_number=_text(key) or "(none)",
                )
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
