"""Strict YAML: one loader for settings, profiles and exercises."""

from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar, get_args

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError, ValidationInfo, field_validator
from pydantic_core import ErrorDetails

from app.core.errors import ConfigurationError
from app.core.files import LARGEST_FILE as LARGEST_FILE
from app.core.files import read_at_most
from app.core.library_words import check_words
from app.core.messages import Sentence, joined, sentence

M = TypeVar("M", bound="Strict")

MOST_VALUES = 200_000
"""Nor holds more values than this; a few lines of aliases can stand for any number of them."""

MOST_PROBLEMS = 12
"""A message names so many wrong values; a list may hold thousands."""


@dataclass(frozen=True, slots=True)
class FieldText:
    """Say how a form shows a field of a model: `Annotated[str, FieldText("Host", "its name")]`.

    Attributes:
        title: of its row, in English; `tools.translations` collects it.
        help: what to fill in, likewise; empty for none.
        unit: of its number, where the end of its name (`_mm`, `_s`) does not say one.
    """

    title: str = ""
    help: str = ""
    unit: str = ""


class Strict(BaseModel):
    """Base of everything that is read from YAML: frozen; unknown keys, NaN and infinity refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @field_validator("*", mode="before")
    @classmethod
    def _no_truth_for_a_number(cls, value: object, info: ValidationInfo) -> object:
        """Refuse `yes` and `true` where a number is wanted; pydantic would read them as 1."""
        field = cls.model_fields.get(info.field_name or "")
        if isinstance(value, bool) and field is not None and field.annotation in (int, float):
            raise ValueError(sentence("a number is needed"))
        return value


class _UniqueKeyLoader(yaml.SafeLoader):
    """YAML 1.1 safe loader that refuses a key given twice instead of keeping the last."""


def _mapping(loader: _UniqueKeyLoader, node: yaml.MappingNode) -> dict[Any, Any]:
    seen: set[Any] = set()
    for key_node, _ in node.value:
        key = loader.construct_object(key_node)
        if not isinstance(key, str | int | float):
            raise yaml.constructor.ConstructorError(
                None, None, "a key must be a name", key_node.start_mark
            )
        if key in seen:
            raise yaml.constructor.ConstructorError(
                None, None, f"key {key!r} is given twice", key_node.start_mark
            )
        seen.add(key)
    return loader.construct_mapping(node, deep=True)


# What is written is read again as a text, with or without its template.
yaml.SafeDumper.add_multi_representer(
    Sentence, lambda dumper, text: dumper.represent_str(str(text))
)
_UniqueKeyLoader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


def read_yaml(path: Path) -> Any:
    """Read one YAML document.

    Raises:
        ConfigurationError: if the file cannot be read, is larger than `LARGEST_FILE` or is not
            YAML; names the file and the line.
    """
    return parse_yaml(read_text(path), str(path))


def read_text(path: Path) -> str:
    """Read the text of a file of settings.

    Raises:
        ConfigurationError: if the file cannot be read, is larger than `LARGEST_FILE` or is no text.
    """
    try:
        return read_at_most(path).decode("utf-8")
    except OSError as error:
        raise ConfigurationError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except UnicodeDecodeError as error:
        raise ConfigurationError(
            sentence("{path} is not valid YAML: {line}", path=path, line=_one_line(error))
        ) from error


def parse_yaml(text: str, origin: str) -> Any:
    """Read one YAML document that is already in memory; `origin` names it in messages.

    Raises:
        ConfigurationError: if it is not YAML, or its aliases make more of it than `MOST_VALUES`.
    """
    try:
        return deepcopy(_document(text))
    except RecursionError as error:
        raise ConfigurationError(
            sentence("{origin} is not valid YAML: it is nested too deeply", origin=origin)
        ) from error
    except (yaml.YAMLError, ValueError, LookupError, AttributeError, ArithmeticError) as error:
        # Not all are YAMLError: a date of month 99, `!!int abc`, `!!bool x` or 1:1:…:1 raise these.
        raise ConfigurationError(
            sentence("{origin} is not valid YAML: {line}", origin=origin, line=_one_line(error))
        ) from error


@lru_cache(maxsize=64)
def _document(text: str) -> Any:
    """Return what a document holds, to be copied before it is given away.

    The same few profiles and exercises are read again and again; YAML takes long to read.
    """
    loader = _UniqueKeyLoader(text)  # a SafeLoader
    try:
        node = loader.get_single_node()
        if node is None:
            return None
        _count_values(node, {})
        return loader.construct_document(node)
    finally:
        loader.dispose()


def _count_values(node: yaml.Node, known: dict[int, int]) -> int:
    """Count the values that a node stands for; an alias counts as all that it repeats."""
    count = known.get(id(node))
    if count == 0:
        raise yaml.constructor.ConstructorError(
            None, None, "an alias within what it repeats", node.start_mark
        )
    if count is not None:
        return count
    known[id(node)], count = 0, 1
    if isinstance(node, yaml.MappingNode):
        count += sum(_count_values(part, known) for pair in node.value for part in pair)
    elif isinstance(node, yaml.SequenceNode):
        count += sum(_count_values(part, known) for part in node.value)
    if count > MOST_VALUES:
        raise yaml.constructor.ConstructorError(
            None,
            None,
            f"more than {MOST_VALUES} values (an alias counts as all that it repeats)",
            node.start_mark,
        )
    known[id(node)] = count
    return count


@dataclass(frozen=True, slots=True)
class FieldProblem:
    """What is wrong with one field of a document.

    Attributes:
        field: where it stands: names of fields, and places in lists; empty for the whole document.
        text: what is wrong, the value, and what would be valid; without the field.
        missing: whether it is required and not there.
    """

    field: tuple[str | int, ...]
    text: str
    missing: bool = False

    @property
    def name(self) -> str:
        """The field for people, such as `tolerances.angle_error.pass`."""
        return ".".join(map(str, self.field)) or "(document)"


def load(path: Path, model: type[M]) -> M:
    """Read a YAML file into a `Strict` model.

    Raises:
        ConfigurationError: naming the file, the field, its line, the value and what would be valid.
    """
    return parse_text(read_text(path), model, str(path))


def parse_text(text: str, model: type[M], origin: str) -> M:
    """Check a YAML document that is in memory as text; `origin` names it in messages.

    Raises:
        ConfigurationError: as `load`.
    """
    return parse(parse_yaml(text, origin), model, origin, text)


def parse(document: Any, model: type[M], origin: str, text: str = "") -> M:
    """Check a document that is already in memory; `origin` names it in messages.

    Args:
        document: as YAML or JSON gives it.
        model: what it should be.
        origin: for messages.
        text: the YAML that it was read from, for the lines in messages; empty where there is none.

    Raises:
        ConfigurationError: naming every field that is wrong or missing, its value and what would
            be valid.
    """
    try:
        return model.model_validate(document)
    except ValidationError as error:
        problems = _problems(error, model)
        missing = [one.name for one in problems if one.missing]
        names = ", ".join(missing)
        said = [sentence("required and missing: {names}", names=names)] if missing else []
        wrong = [one for one in problems if not one.missing]
        room = MOST_PROBLEMS - len(said)
        node = yaml.compose(text, Loader=_UniqueKeyLoader) if text else None
        for one in wrong[:room]:
            line = _line(node, one.field)
            at = sentence(" (line {line})", line=line) if line else ""
            said.append(joined("", (one.name, ": ", one.text, at)))
        if len(wrong) > room:
            said.append(sentence("and {n} more like these", n=len(wrong) - room))
        raise ConfigurationError(
            sentence("{origin}: {faults}", origin=origin, faults=joined("; ", said))
        ) from error


def checked(document: Any, model: type[M]) -> tuple[M | None, tuple[FieldProblem, ...]]:
    """Read a document, or say what is wrong with it, field by field."""
    try:
        return model.model_validate(document), ()
    except ValidationError as error:
        return None, _problems(error, model)


def line_of(text: str, field: Sequence[str | int]) -> int | None:
    """Line, from 1, of a field in a YAML text, or of what is nearest around it; None without any.

    Args:
        text: the document.
        field: names of fields and places in lists; names that no mapping has are passed over.
    """
    return _line(yaml.compose(text, Loader=_UniqueKeyLoader), field) if text else None


def _line(node: yaml.Node | None, field: Sequence[str | int]) -> int | None:
    line = None
    for part in field:
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                if key.value == str(part):
                    node, line = value, key.start_mark.line + 1
                    break
        elif isinstance(node, yaml.SequenceNode) and part in range(len(node.value)):
            node = node.value[int(part)]
            line = node.start_mark.line + 1
    return line


def _problems(error: ValidationError, model: type[Strict]) -> tuple[FieldProblem, ...]:
    return tuple(_problem(one, model) for one in error.errors(include_url=False))


def _problem(problem: ErrorDetails, model: type[Strict]) -> FieldProblem:
    """Say what is wrong with one field; of a mapping or a list its kind, not all that it holds."""
    if problem["type"] == "missing":
        return FieldProblem(problem["loc"], sentence("required and missing"), missing=True)
    value = problem.get("input")
    said = check_words(problem["type"], problem["msg"], problem.get("ctx", {}))
    said = said if isinstance(said, Sentence) else said.removeprefix("Value error, ")
    if problem["type"] in ("model_type", "model_attributes_type", "dict_type"):
        said = sentence("should be names with values, each as `name: value`")
    if isinstance(value, dict | list) and problem["type"] == "value_error":
        text = said  # our own words name what is wrong within
    elif isinstance(value, dict):
        text = sentence("{wrong}, got a mapping of {n}", wrong=said, n=len(value))
    elif isinstance(value, list):
        text = sentence("{wrong}, got a list of {n}", wrong=said, n=len(value))
    else:
        text = sentence("{wrong}, got {entry}", wrong=said, entry=shown(value))
    if problem["type"] == "extra_forbidden" and (section := _section(model, problem["loc"][:-1])):
        names = ", ".join(field.alias or name for name, field in section.model_fields.items())
        text = sentence("{wrong}; valid names: {names}", wrong=text, names=names)
    return FieldProblem(problem["loc"] or _first_word(said, model), text)


def _section(model: type[BaseModel], place: Sequence[str | int]) -> type[BaseModel] | None:
    """Return the model of a section within a document; None where none or several may stand."""
    for part in place:
        field = model.model_fields.get(str(part))
        kinds = () if field is None else (field.annotation, *get_args(field.annotation))
        models = [one for one in kinds if isinstance(one, type) and issubclass(one, BaseModel)]
        if len(models) != 1:
            return None
        (model,) = models
    return model


def _first_word(message: str, model: type[Strict]) -> tuple[str, ...]:
    """Field that a message about the whole document begins with; empty if it names none."""
    word = message.split()[:1]
    return tuple(name for name in (one.rstrip(":") for one in word) if name in model.model_fields)


def shown(value: object) -> str:
    """Return a value for a message: at most 60 characters."""
    try:
        text = repr(value)
    except ValueError:  # a whole number of thousands of digits
        return "a number that is too long to be written"
    return text if len(text) <= 60 else text[:57] + "..."


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())
