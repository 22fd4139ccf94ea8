"""The exercises that exist: shipped ones and the user's own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from app.core import paths
from app.core.configuration import load
from app.core.errors import ConfigurationError
from app.exercises.errors import ExerciseError, UnknownExerciseError
from app.exercises.schema import Exercise


@dataclass(frozen=True, slots=True)
class Broken:
    """A file in the library that cannot be used, and why."""

    path: Path
    reason: str


@dataclass(frozen=True, slots=True)
class Library:
    """All exercises; iterating gives those that can be used.

    Attributes:
        exercises: by level; within one, shipped before the user's, then by file name.
        broken: files that cannot be used: to be shown, not hidden.
    """

    exercises: tuple[Exercise, ...]
    broken: tuple[Broken, ...]

    def __iter__(self) -> Iterator[Exercise]:
        return iter(self.exercises)

    def __len__(self) -> int:
        return len(self.exercises)

    def ids(self) -> list[str]:
        """Names that `load_exercise` takes."""
        return [exercise.id for exercise in self.exercises]


def folders() -> tuple[Path, Path]:
    """Where exercises lie: the shipped folder and the user's."""
    return paths.resources() / "exercises", paths.data() / "exercises"


def library() -> Library:
    """Read every exercise; a broken file is listed as such and hides no other."""
    found: dict[str, Exercise] = {}
    broken: list[Broken] = []
    for path in (path for folder in folders() for path in sorted(folder.glob("*.yaml"))):
        try:
            exercise = read_exercise(path)
        except ConfigurationError as error:
            broken.append(Broken(path, str(error)))
            continue
        if exercise.id in found:
            broken.append(Broken(path, f"{path}: id: {exercise.id!r} is taken by another exercise"))
        else:
            found[exercise.id] = exercise
    by_level = sorted(found.values(), key=lambda exercise: exercise.level)
    return Library(tuple(by_level), tuple(broken))


def load_exercise(name_or_path: str | Path) -> Exercise:
    """Return an exercise of the library by its id, or any exercise by the path of its file.

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
        if exercise.id == str(name_or_path):
            return exercise
    for file in known.broken:
        if file.path.stem == str(name_or_path):
            raise ExerciseError(file.reason)
    raise UnknownExerciseError(
        f"no exercise {str(name_or_path)!r}; there are {', '.join(known.ids())}, "
        "or give the path of a .yaml file"
    )


def read_exercise(path: Path) -> Exercise:
    """Read one exercise file; paths in it (CT, device, cameras) are taken from its own folder.

    Raises:
        ConfigurationError: naming the file, the field, the value and what would be valid.
    """
    exercise = load(path, Exercise)
    _check_profile(path, "device", exercise.device, "devices")
    _check_profile(path, "rig", exercise.rig, "cameras")
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


def _structure_file(path: Path, name: Path) -> Path:
    """Place a file of structures: beside the exercise, else in the user's folder of structures."""
    beside, kept = path.parent.resolve() / name, paths.data() / "structures" / name
    return kept if kept.is_file() and not beside.exists() else beside


def _is_path(profile: str) -> bool:
    return Path(profile).suffix in (".yaml", ".yml")


def _check_profile(path: Path, field: str, value: str, folder: str) -> None:
    names = sorted(file.stem for file in (paths.resources() / folder).glob("*.yaml"))
    if value not in names and not _is_path(value):
        raise ExerciseError(
            f"{path}: {field}: {value!r} is not known; valid names are {', '.join(names)}, "
            "or the path of a .yaml file"
        )
