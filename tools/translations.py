"""Keep the texts of every language complete: `python -m tools.translations [--update]`.

Without an option it says what `resources/translations/acus_<code>.ts` lack of the program's texts
and which translations cannot be used, and ends with 1 if there are any. With `--update` Qt's own
`lupdate` adds new texts to the files and takes out those that are gone; a new language begins with
`--update CODE`. Titles of declarations, texts of the exercises that ship and texts about a number
of things (`tr_n`, `counted`) are collected as well. At the end it says how many literal texts of
the command line nobody marked: they are English in every language.
"""

import argparse
import ast
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from string import Formatter
from typing import Any
from xml.etree import ElementTree

from app.core import paths
from app.core.language import folder
from app.exercises.library import load_exercise
from app.session.course_plan import course_plans

ROOT = Path(__file__).resolve().parents[1]
ALIASES = "tr+=sentence,tr+=template"
COUNTING = ("tr_n", "counted")
"""Functions whose second literal is a text about a number of things."""
_MARKUP = re.compile(r"</?[a-z]\w*")
_CODE = re.compile(r"`[^`]*`")


def declared_texts() -> list[str]:
    """Return the texts that `lupdate` does not see.

    Titles of declarations and of fields in `app`, texts marked inside f-strings, titles and
    descriptions of exercises and plans of courses that ship.
    """
    texts: set[str] = set()
    for path in (ROOT / "app").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text)
        texts.update(_within_texts(tree))
        if "DECLARATION" in text:
            texts.update(_titles(tree))
        texts.update(_of_fields(tree))
    for file in (paths.resources() / "exercises").glob("*.yaml"):
        exercise = load_exercise(file.stem)
        texts.update(text for text in (exercise.title, exercise.description) if text)
    for plan in course_plans():
        texts.update(text for text in (plan.title, plan.description) if text)
    return sorted(texts)


def counted_texts() -> list[str]:
    """Return the English texts about a number of things: for any other number than one."""
    trees = (ast.parse(path.read_text(encoding="utf-8")) for path in (ROOT / "app").rglob("*.py"))
    return sorted({text for tree in trees for text in _about_numbers(tree)})


def _about_numbers(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in COUNTING:
            several = node.args[1] if len(node.args) > 2 else None
            if isinstance(several, ast.Constant) and isinstance(several.value, str):
                yield several.value


def unmarked_texts(tree: ast.Module) -> list[str]:
    """Return the literal texts of a module of commands that no reader of another language gets.

    Looked at are texts with a blank between words, as parts of code that runs; help stays English,
    and so do the command's own name, orders to it (`acus camera use`) and names of threads and
    variables.
    """
    marked: list[ast.AST] = []
    for node in ast.walk(tree):
        name = getattr(getattr(node, "func", None), "id", "")
        if isinstance(node, ast.Call) and name in ("sentence", "template", "ContextVar", *COUNTING):
            marked += node.args
        if _is_help(node):
            marked.append(node)
        if isinstance(node, ast.Expr) or getattr(node, "arg", "") in ("help", "metavar"):
            marked += [
                part for part in ast.iter_child_nodes(node) if isinstance(part, ast.Constant)
            ]
        if isinstance(node, ast.Subscript):  # of an annotation, or of a mapping
            marked.append(node.slice)
    left_out = {id(inner) for part in marked for inner in ast.walk(part)}
    texts = [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and id(node) not in left_out
    ]
    return [
        text
        for text in texts
        if re.search(r"[a-z]{2,} +[a-z]{2,}|^ ?[a-z]{3,} $", text) and not text.startswith("acus ")
    ]


def _is_help(node: ast.AST) -> bool:
    """Return whether a part of a module makes a text of `--help`, by its name."""
    if isinstance(node, ast.Assign):
        return "help" in ast.unparse(node.targets[0]).lower()
    return isinstance(node, ast.FunctionDef) and "help" in node.name.lower()


def _titles(tree: ast.Module) -> Iterator[str]:
    dictionaries = [node for node in ast.walk(tree) if isinstance(node, ast.Dict)]
    for key, value in (
        (k, v) for node in dictionaries for k, v in zip(node.keys, node.values, strict=True)
    ):
        titled = isinstance(key, ast.Constant) and key.value == "title"
        if titled and isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value.value


def _of_fields(tree: ast.Module) -> Iterator[str]:
    """Yield titles and helps of fields of models, which forms show."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "FieldText":
            parts = (part.value for part in node.args if isinstance(part, ast.Constant))
            yield from (text for text in parts if isinstance(text, str))


def _within_texts(tree: ast.Module) -> Iterator[str]:
    """Yield what is marked for translation within f-strings."""
    for text in (node for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)):
        for node in ast.walk(text):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.args:
                first, marks = node.args[0], node.func.id in ("tr", "sentence", "template")
                if marks and isinstance(first, ast.Constant) and isinstance(first.value, str):
                    yield first.value


def update(files: Sequence[Path]) -> None:
    """Let `lupdate` add the program's texts to files, and take out those that are gone."""
    tool = Path(sys.executable).parent / "pyside6-lupdate"
    sources = sorted((ROOT / "app").rglob("*.py"))
    with tempfile.TemporaryDirectory() as place:
        more = Path(place) / "declared.py"
        lines = [f"tr({text!r})\n" for text in declared_texts()]
        lines += [f'tr({text!r}, "", n)\n' for text in counted_texts()]
        more.write_text("".join(lines), encoding="utf-8")
        command = [tool, "-silent", "-tr-function-alias", ALIASES, "-no-obsolete"]
        command += ["-locations", "none", *sources, more, "-ts", *files]
        subprocess.run([str(part) for part in command], check=True, timeout=300)
    for file in files:
        tree = ElementTree.parse(file)
        ElementTree.indent(tree, " " * 4)
        write(tree, file)


def write(tree: Any, file: Path) -> None:
    """Write a language's file in the one form in which all of them stand."""
    head = '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n'
    text = ElementTree.tostring(tree.getroot(), encoding="unicode")
    file.write_text(f"{head}{text}\n", encoding="utf-8")


def messages(file: Path) -> dict[str, tuple[str, ...]]:
    """Return English text -> the forms of its translation, empty where there is none."""
    forms: dict[str, tuple[str, ...]] = {}
    for message in ElementTree.parse(file).iter("message"):
        several = [form.text or "" for form in message.iter("numerusform")]
        single = message.findtext("translation") or ""
        counted = message.get("numerus") == "yes"
        forms[message.findtext("source") or ""] = tuple(several or [""] if counted else [single])
    return forms


def faults(english: str, text: str) -> list[str]:
    """Say what of a translation would be wrong in the window."""
    try:
        wanted, given = _fields(english), _fields(text)
    except ValueError as error:
        return [f"no pattern: {error}"]
    pairs = (
        ("fields", wanted, given),
        ("markup", sorted(_MARKUP.findall(english)), sorted(_MARKUP.findall(text))),
        ("code", sorted(_CODE.findall(english)), sorted(_CODE.findall(text))),
        ("line breaks", english.count("\n"), text.count("\n")),
        ("accelerators", _accelerators(english), _accelerators(text)),
        ("blanks at the ends", _ends(english), _ends(text)),
    )
    return [f"{name} are {b}, of the English {a}" for name, a, b in pairs if a != b]


def _fields(text: str) -> list[tuple[str, str, str]]:
    return sorted(
        field
        for _, name, form, conversion in Formatter().parse(text)
        if name is not None
        for field in _of_field(name, form or "", conversion or "")
    )


def _of_field(name: str, form: str, conversion: str) -> Iterator[tuple[str, str, str]]:
    """Yield a field, and those within the texts that it chooses between (`commands/shown.py`)."""
    chooses = form[:1] if form[:1] in ("?", "#") else ""
    yield name, chooses or form, conversion
    if chooses == "?":
        yield from _fields(form[1:])


def _accelerators(text: str) -> int:
    return len(re.findall(r"&\w", text.replace("&&", "")))


def _ends(text: str) -> tuple[bool, bool]:
    return text[:1].isspace(), text[-1:].isspace()


def problems(file: Path, texts: Iterable[str]) -> list[str]:
    """Say what a language lacks of texts, and which of its translations cannot be used."""
    there = messages(file)
    lines = [f"{file.name}: not in it: {text!r}" for text in texts if text not in there]
    for english, forms in there.items():
        if not all(text.strip() for text in forms):
            lines.append(f"{file.name}: not translated: {english!r}")
        else:
            wrong = [fault for text in forms for fault in faults(english, text)]
            lines += [f"{file.name}: {english!r}: {fault}" for fault in wrong]
    return lines


def main() -> None:
    """Check the languages, or bring them up to date."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--update", nargs="*", metavar="CODE", help="also begin these languages")
    given = parser.parse_args()
    files = sorted(folder().glob("acus_*.ts"))
    if given.update is not None:
        folder().mkdir(parents=True, exist_ok=True)
        new = [folder() / f"acus_{code}.ts" for code in given.update]
        update(sorted({*files, *new}))
        return
    with tempfile.TemporaryDirectory() as place:
        fresh = Path(place) / "acus_xx.ts"
        update([fresh])
        texts = list(messages(fresh))
    lines = [line for file in files for line in problems(file, texts)]
    print("\n".join(lines[:40]))
    print(f"{len(texts)} texts in {len(files)} languages: {len(lines)} problems")
    commands = (ROOT / "app" / "commands").glob("*.py")
    left = [unmarked_texts(ast.parse(path.read_text(encoding="utf-8"))) for path in commands]
    print(f"{sum(map(len, left))} texts of the command line are English in every language")
    raise SystemExit(bool(lines))


if __name__ == "__main__":
    main()
