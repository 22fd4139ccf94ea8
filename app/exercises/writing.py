"""Exercises into files: as YAML that reads back equal, in versions; and the schema of such a file.

The schema is made from the same declaration as the reader.
"""

from __future__ import annotations

import inspect
import json
import os
import re
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import yaml
from pydantic import BaseModel

from app.core import paths
from app.core.configuration import LARGEST_FILE, parse_yaml, read_text
from app.core.descriptors import is_held
from app.core.files import write_atomically
from app.core.messages import sentence
from app.exercises.errors import ExerciseError
from app.exercises.library import folders, library, read_exercise, versions
from app.exercises.schema import Exercise
from app.imaging.window import PRESETS

HEAD: Final = "# An exercise for Acus; every field is explained in docs/exercises.md.\n"
SCHEMA_ID: Final = "https://json-schema.org/draft/2020-12/schema"
_WIDTH: Final = 100
_LONGEST_ID: Final = 64
_EMPTY: Final[tuple[Any, ...]] = ("", [], {})


_BREAKS: Final = re.compile("[\r\x85\u2028\u2029\ufeff]")
"""PyYAML writes them plainly between single quotes, and reads them otherwise."""


class _Dumper(yaml.SafeDumper):
    """Texts of several lines stand as they are; nothing is an alias."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


class _QuotingDumper(_Dumper):
    """Every text is quoted, with escapes."""


def _text(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    style = "|" if "\n" in text else None
    if isinstance(dumper, _QuotingDumper) or _BREAKS.search(text):
        style = '"'
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


for _kind in (_Dumper, _QuotingDumper):
    _kind.add_representer(str, _text)


def exercise_document(exercise: Exercise, folder: Path | None = None) -> dict[str, Any]:
    """Return an exercise as the values of its file, in the order of the fields.

    Everything is said, so that the exercise stays what it is when a default changes one day; left
    out is what is empty.

    Args:
        exercise: the exercise.
        folder: of the file: paths below it are written from there, others whole; None writes all
            whole.
    """
    whole = exercise.model_dump(mode="json", by_alias=True, exclude_none=True)
    whole["effects"] = _parts(exercise.effects)
    whole["laws"] = _parts(exercise.laws)
    emptied = ("description", "joint", "target_organ", "structures", "layers", "effects", "without")
    for name in emptied:
        if whole[name] in _EMPTY:
            del whole[name]
    if not whole["guidance"].get("mode"):
        whole["guidance"].pop("mode", None)
    if exercise.ct.folder is not None:
        whole["ct"]["folder"] = _from(folder, exercise.ct.folder)
    if whole["ct"]["remedy"] == "none":
        del whole["ct"]["remedy"]
    if whole["reading"] == {"locked": False}:
        del whole["reading"]
    for part, given in zip(whole.get("structures", ()), exercise.structures, strict=True):
        part["file"] = _from(folder, given.file, paths.data() / "structures")
    for name in ("device", "rig"):
        if Path(whole[name]).is_absolute():
            whole[name] = _from(folder, Path(whole[name]))
    return whole


def exercise_text(exercise: Exercise, folder: Path | None = None) -> str:
    """Return the YAML of an exercise, which reads back equal.

    Args:
        exercise: the exercise.
        folder: of the file, as for `exercise_document`.

    Raises:
        ExerciseError: if it would be longer than a file may be.
    """
    document = exercise_document(exercise, folder)
    for dumper in (_Dumper, _QuotingDumper):
        text = HEAD + yaml.dump(
            document,
            Dumper=dumper,
            sort_keys=False,
            allow_unicode=True,
            width=_WIDTH,
            default_flow_style=None,
        )
        raw = text.encode()
        if len(raw) > LARGEST_FILE:
            raise ExerciseError(
                sentence(
                    "exercise {exercise_id} would be a file of {size_kb} kB; "
                    "{largest_file} kB are the most: shorten its texts",
                    exercise_id=exercise.id,
                    size_kb=len(raw) >> 10,
                    largest_file=LARGEST_FILE >> 10,
                )
            )
        if parse_yaml(text, exercise.id) == document:
            return text
    raise ExerciseError(
        sentence(
            "exercise {exercise_id} cannot be written as YAML: it reads back otherwise",
            exercise_id=exercise.id,
        )
    )


def write_exercise(path: Path, exercise: Exercise) -> None:
    """Write an exercise to a file, whole or not at all; paths below its folder from there.

    Raises:
        ExerciseError: if it cannot be written.
    """
    _write(path, exercise_text(exercise, path.parent.resolve()))


def _write(path: Path, text: str) -> None:
    try:
        write_atomically(path, text)
    except OSError as error:
        why = sentence(
            "cannot write {path}: {why}; nothing was changed",
            path=path,
            why=error.strerror or error,
        )
        raise ExerciseError(why) from error


def save(exercise: Exercise) -> Exercise:
    """Keep an exercise in the user's folder; a changed one is a new version, earlier ones are kept.

    Attempts name the version that they were made on; `load_exercise("id@version")` reads it again.

    Returns:
        The exercise as it was kept: with its version.

    Raises:
        ExerciseError: if its id is that of a shipped exercise, or of a file that cannot be used; or
            it cannot be written.
    """
    shipped, own = folders()
    if (shipped / f"{exercise.id}.yaml").is_file():
        raise ExerciseError(
            sentence(
                "id: {exercise_id!r} is an exercise that comes with Acus and stays as it is: "
                "save yours under another id (duplicate it)",
                exercise_id=exercise.id,
            )
        )
    with _alone(own):
        known = library()
        path = known.files.get(exercise.id, own / f"{exercise.id}.yaml")
        if exercise.id not in known.files:
            if path.exists():
                raise ExerciseError(
                    sentence(
                        "{path} is there and cannot be used: repair it (acus exercise validate "
                        "{path}) or move it away, then save again",
                        path=path,
                    )
                )
            exercise = exercise.model_copy(update={"version": _next(exercise.id, exercise.version)})
            write_exercise(path, exercise)
            return read_exercise(path)
        present = read_exercise(path)
        if _same(present, exercise):
            return present
        kept = own / f"{exercise.id}@{present.version}.yaml"
        if not kept.exists():
            _write(kept, read_text(path))
        version = max(versions(exercise.id)) + 1
        write_exercise(path, exercise.model_copy(update={"version": version}))
        return read_exercise(path)


def free_id(title: str, taken: Iterator[str] | list[str]) -> str:
    """Make an id of a title: small letters, digits, hyphens; with a number where it is taken."""
    plain = title.casefold().replace("ä", "ae").replace("ö", "oe").replace("ü", "ue")
    words = re.findall(r"[a-z0-9]+", plain.replace("ß", "ss"))
    base = "-".join(words)[: _LONGEST_ID - 4].strip("-") or "exercise"
    used, number, found = set(taken), 2, base
    while found in used:
        found, number = f"{base}-{number}", number + 1
    return found


def taken_ids() -> list[str]:
    """Ids that a new exercise cannot have: of exercises, of broken files, of earlier versions."""
    known = library()
    earlier = [path.stem.partition("@")[0] for path in folders()[1].glob("*@*.yaml")]
    return [*known.ids(), *(file.path.stem for file in known.broken), *earlier]


def _next(identifier: str, version: int) -> int:
    """Version of an exercise that is new here: its own, or above those that are kept."""
    kept = versions(identifier)
    return max(version, kept[-1] + 1) if kept else version


def _same(item: Exercise, other: Exercise) -> bool:
    """Return whether two exercises say the same, whatever their versions."""
    return item.model_copy(update={"version": other.version}) == other


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Let no other program save at the same moment."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = os.open(folder / ".lock", os.O_CREAT | os.O_RDWR, 0o600)
    except OSError as error:
        raise ExerciseError(
            sentence(
                "cannot write in {folder}: {error_strerror}; ACUS_DATA moves it",
                folder=folder,
                error_strerror=error.strerror or error,
            )
        ) from error
    try:
        _wait_for(lock)
        yield
    finally:
        os.close(lock)


def _wait_for(lock: int) -> None:
    for _ in range(100 if os.name == "posix" else 0):
        if not is_held(lock):  # and now it is ours
            return
        time.sleep(0.05)


def _parts(parts: Mapping[str, BaseModel]) -> dict[str, Any]:
    """Effects or laws: of each what is not its default."""
    return {
        name: part.model_dump(mode="json", exclude_defaults=True) for name, part in parts.items()
    }


def _from(folder: Path | None, path: Path, other: Path | None = None) -> str:
    """Return a path as a file of `folder` writes it: relative to that or to `other`, else whole.

    Without a folder nothing could resolve a relative path, so it stays whole.
    """
    if not path.is_absolute():
        return str(path)
    if folder is not None and path.is_relative_to(folder):
        return path.relative_to(folder).as_posix()
    if folder is None or other is None or not path.is_relative_to(other) or not path.is_file():
        return str(path)
    name = path.relative_to(other).as_posix()
    shadowed = (folder / name).exists()  # that would be read in its place
    return str(path) if shadowed else name


# --- schema -------------------------------------------------------------------------------------
def schema_document() -> dict[str, Any]:
    """Return the JSON Schema of an exercise file, made from the declaration that reads it."""
    made = Exercise.model_json_schema(by_alias=True, mode="validation")
    definitions = made["$defs"]
    _describe(made, Exercise)
    for model in _models(Exercise):
        if model.__name__ in definitions:
            _describe(definitions[model.__name__], model)
    for name in ("effects", "laws"):
        parts = made["properties"][name]
        part = parts["additionalProperties"]
        parts["additionalProperties"] = {"anyOf": [part, {"type": "null"}]}
        names = {"type": "array", "items": {"type": "string"}, "uniqueItems": True}
        shared = {
            key: parts.pop(key) for key in ("title", "description", "default") if key in parts
        }
        made["properties"][name] = {"anyOf": [parts, names], **shared}
    window = definitions["ReadingPart"]["properties"]["window"]
    words = "|".join(re.escape(name).replace(r"\ ", "[ _]+") for name in PRESETS)
    window["anyOf"].insert(
        0, {"type": "string", "examples": list(PRESETS), "pattern": _caseless(words)}
    )
    return {
        "$schema": SCHEMA_ID,
        **made,
        "title": "Exercise for Acus",
        "description": "One exercise, as YAML or JSON; docs/exercises.md explains every field.",
    }


def schema_text() -> str:
    """Return the JSON Schema of an exercise file as text."""
    return json.dumps(schema_document(), indent=1, ensure_ascii=False) + "\n"


def _caseless(words: str) -> str:
    """Return a pattern for words in capital or small letters; JSON Schema has no flag for that."""
    either = re.sub(r"[A-Za-z]", lambda m: f"[{m[0].upper()}{m[0].lower()}]", words)
    return f"^({either})$"


def _models(
    model: type[BaseModel], seen: set[type[BaseModel]] | None = None
) -> set[type[BaseModel]]:
    """All models that a model is made of, itself among them."""
    found = seen if seen is not None else set()
    if model in found:
        return found
    found.add(model)
    waiting: list[Any] = [field.annotation for field in model.model_fields.values()]
    while waiting:
        kind = waiting.pop()
        if inspect.isclass(kind) and issubclass(kind, BaseModel):
            _models(kind, found)
        else:
            waiting += getattr(kind, "__args__", ())
    return found


def _describe(schema: dict[str, Any], model: type[BaseModel]) -> None:
    """Give the properties of a schema the words of the model's docstring."""
    words = inspect.getdoc(model) or ""
    said = words.partition("Attributes:\n")[2]
    for name, field in model.model_fields.items():
        match = re.search(rf"^ *{name}: (.*(?:\n {{6,}}.*)*)", said, re.MULTILINE)
        shown = schema["properties"].get(field.alias or name)
        if match and shown is not None:
            shown["description"] = " ".join(match[1].split())
    schema["description"] = " ".join(words.partition("\n\n")[0].split())
