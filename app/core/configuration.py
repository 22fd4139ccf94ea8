"""Strict YAML: one loader for settings, profiles and exercises."""

from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError, ValidationInfo, field_validator

from app.core.errors import ConfigurationError

M = TypeVar("M", bound="Strict")


class Strict(BaseModel):
    """Base of everything that is read from YAML: frozen; unknown keys, NaN and infinity refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @field_validator("*", mode="before")
    @classmethod
    def _no_truth_for_a_number(cls, value: object, info: ValidationInfo) -> object:
        """Refuse `yes` and `true` where a number is wanted; pydantic would read them as 1."""
        field = cls.model_fields.get(info.field_name or "")
        if isinstance(value, bool) and field is not None and field.annotation in (int, float):
            raise ValueError("a number is needed")
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


_UniqueKeyLoader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


def read_yaml(path: Path) -> Any:
    """Read one YAML document.

    Raises:
        ConfigurationError: if the file cannot be read or is not YAML; names the file and the line.
    """
    try:
        text = path.read_text(encoding="utf-8")
        return yaml.load(text, Loader=_UniqueKeyLoader)  # a SafeLoader
    except OSError as error:
        raise ConfigurationError(f"cannot read {path}: {error.strerror or error}") from error
    except RecursionError as error:
        raise ConfigurationError(f"{path} is not valid YAML: it is nested too deeply") from error
    except (yaml.YAMLError, ValueError, LookupError, AttributeError) as error:
        # Not all are YAMLError: a date of month 99, `!!int abc` or `!!bool x` raise these.
        raise ConfigurationError(f"{path} is not valid YAML: {_one_line(error)}") from error


def load(path: Path, model: type[M]) -> M:
    """Read a YAML file into a `Strict` model.

    Raises:
        ConfigurationError: naming the file, the field, the value and what would be valid.
    """
    return parse(read_yaml(path), model, str(path))


def parse(document: Any, model: type[M], origin: str) -> M:
    """Check a document that is already in memory; `origin` names it in messages."""
    try:
        return model.model_validate(document)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        field = ".".join(str(part) for part in first["loc"]) or "(document)"
        more = f" (and {error.error_count() - 1} more)" if error.error_count() > 1 else ""
        value = _short(first.get("input"))
        raise ConfigurationError(f"{origin}: {field}: {first['msg']}, got {value}{more}") from error


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())
