"""The exercises that exist: shipped ones and the user's own."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from app.core import paths, plugin_folders
from app.core.configuration import line_of, parse_text, read_text
from app.core.errors import AcusError, ConfigurationError
from app.core.messages import sentence
from app.exercises.errors import ExerciseError, UnknownExerciseError
from app.exercises.schema import Exercise
from app.mechanisms.profile import device

EARLIER: Final = re.compile(r"([a-z0-9-]+)@([0-9]+)")
"""Name of a file (without its ending) that keeps an earlier version: `id@version`."""


@dataclass(frozen=True, slots=True)
class Broken:
    """A file in the library that cannot be used, and why."""

    path: Path
    reason: str


@dataclass(frozen=True, slots=True)
class Library:
    """All exercises; iterating gives those that can be used.

    Attributes:
        exercises: by level; within one, shipped and those of plug-ins before the user's, then by
            file name.
        broken: files that cannot be used: to be shown, not hidden.
        files: where each lies, by its id.
    """

    exercises: tuple[Exercise, ...]
    broken: tuple[Broken, ...]
    files: Mapping[str, Path] = field(default_factory=dict)

    def __iter__(self) -> Iterator[Exercise]:
        return iter(self.exercises)

    def __len__(self) -> int:
        return len(self.exercises)

    def ids(self) -> list[str]:
        """Names that `load_exercise` takes."""
        return [exercise.id for exercise in self.exercises]


def folders() -> tuple[Path, Path]:
    """Return where exercises lie: the shipped folder and the user's."""
    return paths.resources() / "exercises", paths.data() / "exercises"


def library() -> Library:
    """Read every exercise; a broken file is listed as such and hides no other."""
    found: dict[str, Exercise] = {}
    files: dict[str, Path] = {}
    broken: list[Broken] = []
    shipped, own = folders()
    shared = (folder.path / "exercises" for folder in plugin_folders.folders())
    places = (shipped, *shared, own)
    for path in (path for place in places for path in sorted(place.glob("*.yaml"))):
        if EARLIER.fullmatch(path.stem):
            continue
        try:
            exercise = read_exercise(path)
        except ConfigurationError as error:
            broken.append(Broken(path, str(error)))
            continue
        if exercise.id in found:
            broken.append(Broken(path, f"{path}: id: {exercise.id!r} is taken by another exercise"))
        else:
            found[exercise.id], files[exercise.id] = exercise, path
    by_level = sorted(found.values(), key=lambda exercise: exercise.level)
    return Library(tuple(by_level), tuple(broken), files)


def load_exercise(name_or_path: str | Path) -> Exercise:
    """Return an exercise of the library by its id, or any exercise by the path of its file.

    `id@version` is that version of it, which may be an earlier one.

    Raises:
        UnknownExerciseError: if there is none; lists those that there are.
        ConfigurationError: if its file cannot be used; names the file, the field, the value and
            what would be valid.
    """
    path = Path(name_or_path)
    if _is_path(str(name_or_path)):
        return read_exercise(path)
    known = library()
    for exercise in known:
        if str(name_or_path) in (exercise.id, f"{exercise.id}@{exercise.version}"):
            return exercise
    if earlier := EARLIER.fullmatch(str(name_or_path)):
        return _earlier(earlier[1], int(earlier[2]), known)
    for file in known.broken:
        if file.path.stem == str(name_or_path):
            raise ExerciseError(file.reason)
    raise UnknownExerciseError(
        sentence(
            "no exercise {name_or_path!r}; there are {known_ids}, or give the path of a .yaml file",
            name_or_path=str(name_or_path),
            known_ids=", ".join(known.ids()),
        )
    )


def versions(identifier: str, known: Library | None = None) -> tuple[int, ...]:
    """Versions of an exercise that there are, ascending; the last one is the present one."""
    found = {one.version for one in known or library() if one.id == identifier}
    for path in folders()[1].glob(f"{identifier}@*.yaml"):
        match = EARLIER.fullmatch(path.stem)
        if match is not None and match[1] == identifier:
            found.add(int(match[2]))
    return tuple(sorted(found))


def _earlier(identifier: str, version: int, known: Library) -> Exercise:
    path = folders()[1] / f"{identifier}@{version}.yaml"
    if path.is_file():
        return read_exercise(path)
    there = ", ".join(map(str, versions(identifier, known))) or "none"
    raise UnknownExerciseError(
        sentence(
            "there is no version {version} of the exercise {identifier!r}; there are: {there}",
            version=version,
            identifier=identifier,
            there=there,
        )
    )


def read_exercise(path: Path) -> Exercise:
    """Read one exercise file; paths in it (CT, device, cameras) are taken from its own folder.

    Raises:
        ConfigurationError: naming the file, the field, its line, the value and what would be valid.
    """
    text = read_text(path)
    exercise = parse_text(text, Exercise, str(path))
    for name in ("device", "rig"):
        if why := unknown_profile(name, getattr(exercise, name)):
            line = line_of(text, (name,))
            raise ExerciseError(
                sentence("{path}: {name}: {reason}", path=path, name=name, reason=why)
                + (sentence(" (line {line})", line=line) if line else "")
            )
    if exercise.touch is not None:
        _check_touch(path, text, exercise)
    found = {
        field: str(path.parent.resolve() / name)
        for field, name in (("device", exercise.device), ("rig", exercise.rig))
        if _is_path(name)
    }
    ct = exercise.ct
    if ct.folder is not None:
        ct = ct.model_copy(update={"folder": path.parent.resolve() / ct.folder})
    structures = tuple(
        part.model_copy(update={"file": _structure_file(path, part.file)})
        for part in exercise.structures
    )
    return exercise.model_copy(update={**found, "ct": ct, "structures": structures})


def _check_touch(path: Path, text: str, exercise: Exercise) -> None:
    """Refuse targets that the exercise's machine cannot bring the tip to."""
    from app.exercises.scene import device_of, placed_plan_of
    from app.exercises.touching import check_touch

    if _is_path(exercise.device):
        device = str(path.parent.resolve() / exercise.device)
        exercise = exercise.model_copy(update={"device": device})
    profile = device_of(exercise)
    try:
        check_touch(exercise.touch_task(placed_plan_of(exercise, profile)), profile, quick=True)
    except AcusError as error:
        line = line_of(text, ("touch",))
        raise ExerciseError(
            sentence("{path}: {error}", path=path, error=error)
            + (sentence(" (line {line})", line=line) if line else "")
        ) from error


def _structure_file(path: Path, name: Path) -> Path:
    """Place a file of structures: beside the exercise, else in the user's folder of structures."""
    beside, kept = path.parent.resolve() / name, paths.data() / "structures" / name
    return kept if kept.is_file() and not beside.exists() else beside


def _is_path(profile: str) -> bool:
    return Path(profile).suffix in (".yaml", ".yml")


def unknown_profile(field: str, value: str) -> str:
    """Say why a `device` or `rig` is none, and what is valid; empty where it is one."""
    names = profile_names(field)
    if value in names or _is_path(value):
        return ""
    return sentence(
        "{exercise_name!r} is not known; valid names are {names}, or the path of a .yaml file",
        exercise_name=value,
        names=", ".join(names),
    )


def profile_names(field: str) -> tuple[str, ...]:
    """Names that the field `device` or `rig` may hold."""
    if field == "device":
        return tuple(device.profile_names())
    return tuple(sorted(file.stem for file in (paths.resources() / "cameras").glob("*.yaml")))
