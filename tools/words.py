"""Count words that a stranger stumbles over, and refuse more of them.

    python -m tools.words [--list] [--write]

Looked at are names that cross a function's border (functions, parameters, attributes and fields),
the first word of a function's docstring, which is a verb, literal texts of the window, raises below
the window whose text is no `core.messages.sentence`, so that nobody can translate it, and fields of
sentences whose names no translator understands (`{text}`, `{points_2}`, `{shape_first}`). What is
there now stands in tools/words.yaml: a count that rises ends with code 3 and is never written; one
that falls is, by `--write`. docs/vocabulary.md says which words to use.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from string import Formatter

import yaml

ROOT = Path(__file__).resolve().parents[1]
COUNTS = Path(__file__).with_name("words.yaml")

NAMES = frozenset(("found", "kept", "one", "said", "told", "why"))
"""Names that say nothing of what they hold; `result`, `stored`, `message`, `reason` do."""

NO_VERBS = frozenset(("How", "What", "When", "Where", "Whether", "Which", "Who", "Whose", "Why"))
"""Begin no docstring of a function: it says what the function does, as in "Return whether …"."""

PHRASES = ("beside the window", "anew", "counts for nobody", "tells of", "is said")
"""A native speaker says it otherwise."""


FIELDS = frozenset(
    (
        *("text", "what", "word", "words", "number", "value", "values", "given", "message"),
        *("item", "result", "stored", "not_"),
    )
)
"""Fields of a sentence that tell a translator nothing of what comes in their place."""

FIELD_ENDS = re.compile(r"_(\d+|first|last|count|min|max|type|round)$")
"""Ends of fields that a script made of code: `points_count_2`, `shape_first`."""

NOT_FOR_PEOPLE = frozenset(
    (
        *("AttributeError", "Cancelled", "ConstructorError", "Exit", "PydanticCustomError"),
        *("DepartureError", "UnseenError"),  # of a board: a report for whoever writes its firmware
        *("FileExistsError", "FileNotFoundError", "OSError", "SystemExit"),
    )
)
"""Errors whose texts are the system's, a library's, or nobody's."""


def words_in(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """Yield each refused word of a module, as `kind: word`, with its line."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            first = (ast.get_docstring(node) or "").split(" ", 1)[0].rstrip(",:;")
            if first in NO_VERBS:
                yield f"docstring: {first}", node.lineno
            names = [node.name, *(each.arg for each in _parameters(node.args))]
        elif isinstance(node, ast.ClassDef):
            fields = [each.target for each in node.body if isinstance(each, ast.AnnAssign)]
            names = [each.id for each in fields if isinstance(each, ast.Name)]
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            names = [node.attr]
        elif isinstance(node, ast.Call):
            text = _text(node)
            phrases = [each for each in PHRASES if re.search(rf"\b{each}\b", text)]
            yield from ((f"text: {phrase}", node.lineno) for phrase in phrases)
            continue
        else:
            continue
        for name in names:
            if name.strip("_") in NAMES:
                yield f"name: {name.strip('_')}", node.lineno


def templates_in(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """Yield the template of each `sentence("…")` of a module, with its line."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "sentence" and node.args:
            first = node.args[0]
            if not isinstance(first, ast.Constant) or not isinstance(first.value, str):
                raise ValueError(f"line {node.lineno}: the template of a sentence is no literal")
            yield first.value, node.lineno


def fields_in(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """Yield each refused field of a module's sentences, as `field: word` or its end, with its line.

    A field that stands twice in a sentence is one field.
    """
    for template, line in templates_in(tree):
        names = dict.fromkeys(name for _, name, _, _ in Formatter().parse(template) if name)
        for name in names:
            if name in FIELDS:
                yield f"field: {name}", line
            elif end := FIELD_ENDS.search(name):
                yield f"field: {'_2' if end[1].isdigit() else end[0]}", line


def unmarked_in(tree: ast.AST) -> Iterator[int]:
    """Yield the line of each raise whose text is an f-string, is formatted, or a bare literal."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            kind = ast.unparse(node.exc.func).rpartition(".")[2]
            if kind not in NOT_FOR_PEOPLE and any(map(_is_bare, node.exc.args)):
                yield node.lineno


def _is_bare(text: ast.expr) -> bool:
    """Return whether an argument is a text of several words that nothing marks."""
    if isinstance(text, ast.IfExp):
        return _is_bare(text.body) or _is_bare(text.orelse)
    if isinstance(text, ast.BoolOp):
        return any(map(_is_bare, text.values))
    if isinstance(text, ast.BinOp):
        return _is_bare(text.left) or (isinstance(text.op, ast.Add) and _is_bare(text.right))
    if isinstance(text, ast.Call):
        formats = isinstance(text.func, ast.Attribute) and text.func.attr == "format"
        return formats and _is_bare(text.func.value)  # type: ignore[attr-defined]
    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
    literals = (part.value for part in parts if isinstance(part, ast.Constant))
    return any(isinstance(each, str) and " " in each.strip() for each in literals)


def _parameters(arguments: ast.arguments) -> Iterator[ast.arg]:
    yield from (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
    yield from filter(None, (arguments.vararg, arguments.kwarg))


def _text(call: ast.Call) -> str:
    """Return the literal text that a call of `tr` translates; empty for others."""
    first = call.args[0] if call.args else None
    translates = isinstance(call.func, ast.Name) and call.func.id == "tr"
    literal = translates and isinstance(first, ast.Constant) and isinstance(first.value, str)
    return first.value if literal else ""  # type: ignore[union-attr]


def count(root: Path = ROOT) -> tuple[Counter[str], list[str]]:
    """Return how often each refused word is there, and a line for each place."""
    counts: Counter[str] = Counter()
    places = []
    for path in (file for room in ("app", "acus") for file in sorted((root / room).rglob("*.py"))):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        words = list(words_in(tree))
        if path.is_relative_to(root / "app") and not path.is_relative_to(root / "app" / "views"):
            words += [("raise: no sentence", line) for line in unmarked_in(tree)]
            words += fields_in(tree)
        for word, line in words:
            counts[word] += 1
            places.append(f"{path.relative_to(root)}:{line}: {word}")
    return counts, places


def lowered(counts: Counter[str], allowed: Mapping[str, int]) -> dict[str, int]:
    """Return the counts to be stored: the lower one of now and before; without those at zero."""
    lowest = {word: min(counts[word], number) for word, number in sorted(allowed.items())}
    return {word: number for word, number in lowest.items() if number > 0}


def _allowed() -> dict[str, int]:
    return yaml.safe_load(COUNTS.read_text(encoding="utf-8")) or {}


def templates(root: Path = ROOT) -> list[str]:
    """Return the template of every sentence of the program, in the order of its files."""
    trees = (ast.parse(file.read_text(encoding="utf-8")) for file in (root / "app").rglob("*.py"))
    return [template for tree in trees for template, _ in templates_in(tree)]


def risen(counts: Counter[str]) -> list[str]:
    """Return a sentence for each word that is there more often than tools/words.yaml says."""
    allowed = _allowed()
    return [
        f"{word!r} is there {number} times, {allowed.get(word, 0)} before: see docs/vocabulary.md"
        for word, number in sorted(counts.items())
        if number > allowed.get(word, 0)
    ]


def main() -> int:
    """Print the counts; return 3 where one has risen."""
    parser = argparse.ArgumentParser(prog="python -m tools.words", description=__doc__)
    parser.add_argument("--list", action="store_true", help="name each place")
    parser.add_argument("--write", action="store_true", help="store counts that have fallen")
    options = parser.parse_args()
    counts, places = count()
    if options.list:
        print(*places, sep="\n")
    if options.write:
        lines = (f"'{word}': {number}\n" for word, number in lowered(counts, _allowed()).items())
        COUNTS.write_text("".join(lines), encoding="utf-8")
    sentences = risen(counts)
    print(*sentences, f"{sum(counts.values())} words that {COUNTS.name} counts", sep="\n")
    print(f"{len(templates())} texts below the window keep their template and values")
    return 3 if sentences else 0


if __name__ == "__main__":
    sys.exit(main())
