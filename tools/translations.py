"""Keep the texts of every language complete: `python -m tools.translations [--update]`.

Without an option it says what `resources/translations/acus_<code>.ts` lack of the program's texts
and which translations cannot be used, and ends with 1 if there are any. With `--update` Qt's own
`lupdate` adds new texts to the files and takes out those that are gone; a new language begins with
`--update CODE`. Titles of declarations and texts of the exercises that ship are collected as well.
"""

import argparse
import ast
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from string import Formatter
from xml.etree import ElementTree

from app.core import paths
from app.exercises.library import load_exercise
from app.views.kit.language import folder

ROOT = Path(__file__).resolve().parents[1]
ALIASES = "tr+=sentence"
_MARKUP = re.compile(r"</?[a-z]\w*")
_CODE = re.compile(r"`[^`]*`")


def declared_texts() -> list[str]:
    """Return the texts that `lupdate` does not see.

    Titles of declarations in `app`, texts marked inside f-strings, titles and descriptions of
    shipped exercises.
    """
    texts: set[str] = set()
    for path in (ROOT / "app").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text)
        texts.update(_within_texts(tree))
        if "DECLARATION" in text:
            texts.update(_titles(tree))
    for file in (paths.resources() / "exercises").glob("*.yaml"):
        exercise = load_exercise(file.stem)
        texts.update(text for text in (exercise.title, exercise.description) if text)
    return sorted(texts)


def _titles(tree: ast.Module) -> Iterator[str]:
    dictionaries = [node for node in ast.walk(tree) if isinstance(node, ast.Dict)]
    for key, value in (
        (k, v) for node in dictionaries for k, v in zip(node.keys, node.values, strict=True)
    ):
        titled = isinstance(key, ast.Constant) and key.value == "title"
        if titled and isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value.value


def _within_texts(tree: ast.Module) -> Iterator[str]:
    """Yield what is marked for translation within f-strings."""
    for text in (node for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)):
        for node in ast.walk(text):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.args:
                first, marks = node.args[0], node.func.id in ("tr", "sentence")
                if marks and isinstance(first, ast.Constant) and isinstance(first.value, str):
                    yield first.value


def update(files: Iterable[Path]) -> None:
    """Let `lupdate` add the program's texts to files, and take out those that are gone."""
    tool = Path(sys.executable).parent / "pyside6-lupdate"
    sources = sorted((ROOT / "app").rglob("*.py"))
    with tempfile.TemporaryDirectory() as place:
        more = Path(place) / "declared.py"
        more.write_text("".join(f"tr({text!r})\n" for text in declared_texts()), encoding="utf-8")
        command = [tool, "-silent", "-tr-function-alias", ALIASES, "-no-obsolete"]
        command += ["-locations", "none", *sources, more, "-ts", *files]
        subprocess.run([str(part) for part in command], check=True, timeout=300)


def messages(file: Path) -> dict[str, str]:
    """Return English text -> translation, empty where there is none."""
    tree = ElementTree.parse(file)
    return {
        message.findtext("source") or "": message.findtext("translation") or ""
        for message in tree.iter("message")
    }


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
        (name, form or "", conversion or "")
        for _, name, form, conversion in Formatter().parse(text)
        if name is not None
    )


def _accelerators(text: str) -> int:
    return len(re.findall(r"&\w", text.replace("&&", "")))


def _ends(text: str) -> tuple[bool, bool]:
    return text[:1].isspace(), text[-1:].isspace()


def problems(file: Path, texts: Iterable[str]) -> list[str]:
    """Say what a language lacks of texts, and which of its translations cannot be used."""
    there = messages(file)
    lines = [f"{file.name}: not in it: {text!r}" for text in texts if text not in there]
    for english, text in there.items():
        if not text.strip():
            lines.append(f"{file.name}: not translated: {english!r}")
        else:
            lines += [f"{file.name}: {english!r}: {fault}" for fault in faults(english, text)]
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
    raise SystemExit(bool(lines))


if __name__ == "__main__":
    main()
