"""What a plug-in file says about itself, read from its source without importing it.

Effects and force laws are one file each, with a literal `DECLARATION = {...}` at the top. A file
that is not chosen must not be imported, so the literal is read with `ast`.
"""

import ast
from collections.abc import Callable, Collection
from pathlib import Path
from sys import float_info
from typing import Any, Final, NamedTuple

from app.core.errors import AcusError

_NAME: Final = "DECLARATION"


class Source(NamedTuple):
    """A file that was read.

    Attributes:
        document: the literal.
        body: the statements of the file.
    """

    document: dict[str, Any]
    body: list[ast.stmt]


def read_source(
    path: Path, kind: str, keys: Collection[str], error: Callable[[str], AcusError]
) -> Source:
    """Read the declaration of a file.

    Args:
        path: of the file.
        kind: what it is, with its article, as the documentation says it: `an effect`.
        keys: that the declaration must have, no more and no less.
        error: makes the error of the room that asks.

    Raises:
        AcusError: made by `error`, naming the file and what is missing, unknown or not a literal.
    """
    try:
        body = read_statements(path)
    except (OSError, SyntaxError, ValueError) as reason:
        raise error(f"{kind.split(' ', 1)[1]} file {path} cannot be read: {reason}") from reason
    document = _literal(body, path, error)
    if document is None:
        raise error(f"{path} has no {_NAME} = {{...}}; see 'How to add {kind}'")
    if set(document) != set(keys):
        raise error(
            f"{path}: {_NAME} must have exactly the keys {', '.join(keys)};"
            f" check {sorted(set(document) ^ set(keys))}"
        )
    return Source(document, body)


def read_statements(path: Path) -> list[ast.stmt]:
    """Read the statements of a file without running it.

    Raises:
        OSError, SyntaxError, ValueError: if it cannot be read as Python.
    """
    return ast.parse(path.read_text(encoding="utf-8"), str(path)).body


def _literal(
    body: list[ast.stmt], path: Path, error: Callable[[str], AcusError]
) -> dict[str, Any] | None:
    for node in body:
        if not isinstance(node, ast.AnnAssign | ast.Assign) or node.value is None:
            continue
        target = node.targets[0] if isinstance(node, ast.Assign) else node.target
        if isinstance(target, ast.Name) and target.id == _NAME:
            try:
                document = ast.literal_eval(node.value)
            except (ValueError, TypeError) as reason:
                raise error(f"{path}: {_NAME} is not a literal: {reason}") from reason
            if isinstance(document, dict):
                return document
    return None


def number_within(value: object, minimum: float, maximum: float) -> float | None:
    """Return a value as a number if it is a finite one within a closed range; else None."""
    if not isinstance(value, int | float) or isinstance(value, bool):
        return None
    usable = minimum <= value <= maximum and abs(value) <= float_info.max
    return float(value) if usable else None
