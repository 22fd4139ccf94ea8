"""Show that the program goes on without one of its parts: `python -m tools.without NAME`.

Copies the checkout into the cache folder, leaves out the files of that part (the table below), and
asks of the copy, in processes of its own, that

- every module of `app` can be imported,
- `acus explain` answers for first-insertion and every other exercise that is left, and
  `acus exercise list` lists them,
- no file of `app` or `acus` names what is gone: a module, a folder, a file.

Several names are asked for one after the other, all parts without a name. `--tests [PATH ...]` runs
the tests, or those of some paths, that do not concern that part either. Ends with code 3 where
something is named or does not work.

Every copy lies in the same place, one at a time, and their kernels, volumes and fields of tissue
are kept together: they are those of the checkout but for what is left out, and made once for all.
Kernels that the checkout has compiled are taken over.
"""

from __future__ import annotations

import argparse
import ast
import contextlib
import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.core import paths
from app.core.compiled import kernels_digest
from app.core.exits import Exit

ROOT: Final = Path(__file__).resolve().parents[1]


@dataclass(frozen=True, slots=True)
class Part:
    """What belongs to a part of the program.

    Attributes:
        files: folders and files, as patterns below the checkout.
        words: names that only this part has, beside those of its modules and files.
        tests: that concern it without naming it.
    """

    files: tuple[str, ...]
    words: tuple[str, ...] = ()
    tests: tuple[str, ...] = ()


PARTS: Final[Mapping[str, Part]] = {
    "arm": Part(("app/arm", "docs/arm.md", "tests/arm", "tools/eyes_pictures.py")),
    "tensegrity": Part(
        (
            *("app/mechanisms/tensegrity", "app/studies/tensegrity.py"),
            *("app/studies/hard_cases/tensegrity.py", "app/studies/hard_cases/holder.py"),
            *("app/studies/comparisons/tensegrity.py", "resources/devices/tensegrity.yaml"),
            *("resources/exercises/tensegrity-liver.yaml", "tools/exact/tensegrity.py"),
            *("tools/holder_pictures.py", "tests/tensegrity_rig.py", "tests/**/*tensegrity*.py"),
            *("tests/hard/test_hard_holder.py", "tests/bench/bench_holder.py"),
            "app/exchange/mjcf/tensegrity.py",
        ),
        words=("tensegrity",),
        tests=("tests/hard/test_hard_references.py",),
    ),
    "pen": Part(
        (
            *("app/tracking/pen", "app/tracking/simulated/pen.py"),
            *("app/tracking/simulated/pen_scene.py", "app/views/pen", "app/commands/pen.py"),
            *("app/compose/pen.py", "app/compose/live_pen.py", "app/studies/pen.py"),
            *("app/compose/needle_sources/pen.py", "app/device/links/pen.py"),
            *("app/studies/hard_cases/pen.py", "resources/pens", "docs/pen.md"),
            *("tests/**/*_pen.py", "tests/**/test_*_pen_*.py", "tools/pen_pictures.py"),
            *("tests/hard/defects/pen.py", "tests/tracking/pen_rig.py"),
            # A needle that is tracked elsewhere is a pen that somebody else looks at.
            *("app/compose/tracked_needle.py", "app/compose/needle_sources/igtl.py"),
            "tests/test_compose_tracked_needle.py",
        ),
        words=(r"Pen(?:Tracker|Settings|Profile|Tip|Port|Link|Error|Step|Scene)", "LivePen"),
    ),
    "studies": Part(
        (
            *("app/studies", "app/*/studies", "app/*/hard_cases", "app/*/comparisons"),
            "app/compose/attacked.py",
            *("app/commands/study.py", "app/views/accuracy", "tests/studies", "tests/hard"),
            *("docs/studies.md", "docs/accuracy", "tools/hard_*.py", "tools/exact"),
            *("tools/accuracy_pages.py", "tests/views/test_views_accuracy.py"),
        ),
        words=("AccuracyFeature",),
    ),
    "research": Part(
        (
            *("app/research", "app/commands/research.py", "resources/research"),
            *("docs/research.md", "tests/research", "tests/commands/test_commands_research.py"),
            *("app/views/research", "tests/views/test_views_research.py"),
        ),
        words=("ResearchFeature",),
        tests=("tests/commands/test_commands_tree.py", "tests/commands/test_commands_people.py"),
    ),
    "pacs": Part(
        (
            *("app/imaging/pacs", "app/views/pacs", "app/commands/pacs.py", "docs/pacs.md"),
            *("tests/**/*pacs*.py", "tests/imaging/*orthanc*.py", "tools/dialog_pictures.py"),
        ),
        words=("pacs",),
    ),
    "cohort": Part(("app/cohort", "app/commands/cohort.py", "docs/cohort.md", "tests/cohort")),
    "links": Part(
        (
            *("app/exchange/live", "app/compose/watchers/links.py"),
            *("app/compose/tracked_needle.py", "app/compose/needle_sources/igtl.py"),
            *("app/views/links", "docs/links.md", "tests/exchange/live_rig.py"),
            *("tests/exchange/test_exchange_igtl.py", "tests/exchange/test_exchange_rosbridge.py"),
            *("tests/exchange/test_exchange_foxglove.py", "resources/foxglove-layout.json"),
            "tests/bench/bench_links.py",
            *("tests/test_compose_tracked_needle.py", "tests/test_compose_live_links.py"),
            "tests/views/test_views_links.py",
        ),
        words=("LinksFeature", "LiveBoard"),
    ),
    "author": Part(
        ("app/views/author", "docs/authoring.md", "tests/views/test_views_author.py"),
        words=("AuthorFeature", r"authoring\.md"),
    ),
}

_COPIED: Final = ("app", "acus", "resources", "tools", "tests", "docs", "README.md", "CHANGELOG.md")
_COPIED_TOO: Final = ("pyproject.toml", "mkdocs.yml", "Makefile", "LICENSE", "NOTICE")
_TEXTS: Final = (".py", ".yaml", ".json", ".qss", ".txt", ".csv")

OF_THE_WHOLE: Final = tuple(
    f"tests/{name}.py"
    for name in (
        *("test_docs", "test_promises", "test_structure", "test_changed_tests", "test_long_tests"),
        *("test_install_system", "test_unchanged", "test_extending", "test_without"),
    )
)
"""Tests of the checkout as a whole: its pages, its figures, what git knows."""

IMPORTS: Final = """
import importlib, pkgutil, sys
import app
failed = 0
for found in (m for m in pkgutil.walk_packages(app.__path__, "app.") if "__main__" not in m.name):
    try:
        importlib.import_module(found.name)
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] in ("app", "acus"):
            failed += 1
            print(f"{found.name}: {error}")
    except Exception as error:
        failed += 1
        print(f"{found.name}: {type(error).__name__}: {error}")
sys.exit(3 if failed else 0)
"""
"""A library that is not installed belongs to an extra, and is no failure."""

ANSWERS: Final = """
import contextlib, io, sys
from app.commands import build
from app.exercises.library import library
known, failed = library(), 0
for broken in known.broken:
    failed += 1
    print(f"{broken.path}: {broken.reason}")
commands = build()
for words in (["exercise", "list"], *(["explain", name] for name in sys.argv[1:] or known.ids())):
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            code = commands(words, standalone_mode=False)
    except Exception as error:
        code = f"{type(error).__name__}: {error}"
    failed += bool(code)
    print(f"acus {' '.join(words)}: {code or 'answered'}")
sys.exit(3 if failed else 0)
"""


def copied(part: Part, folder: Path) -> list[str]:
    """Copy the checkout without a part; return what was left out, as paths below the checkout."""
    shutil.rmtree(folder, ignore_errors=True)
    left_out = sorted(path for pattern in part.files for path in ROOT.glob(pattern))

    def ignored(place: str, names: list[str]) -> list[str]:
        return [n for n in names if n == "__pycache__" or Path(place, n) in left_out]

    for name in (*_COPIED, *_COPIED_TOO):
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, folder / name, ignore=ignored)
        elif (ROOT / name).is_file():
            shutil.copy2(ROOT / name, folder / name)
    return [path.relative_to(ROOT).as_posix() for path in left_out]


def pattern_of(part: Part, left_out: list[str]) -> re.Pattern[str]:
    """Return what finds a name of something that was left out in a text."""
    names = [rf"(?i:\b{word}\b)" if word.islower() else rf"\b{word}\b" for word in part.words]
    for path in left_out:
        top, stem = path.split("/")[0], Path(path).stem
        if top == "app":
            dotted = path.removesuffix(".py").split("/")
            package, last = ".".join(dotted[:-1]), dotted[-1]
            names.append(rf"\b{re.escape('.'.join(dotted))}\b")
            names.append(rf"\bfrom {re.escape(package)} import .*\b{last}\b")
            names.append(rf"\b{re.escape(path)}\b")
        elif top == "resources" and "." in path:
            names.append(rf"[\"'/ ]{re.escape(stem)}(?:\.\w+)?[\"']")
    return re.compile("|".join(names))


def naming(folder: Path, pattern: re.Pattern[str], rooms: tuple[str, ...]) -> Iterator[str]:
    """Yield `file:line: text` of every line of some folders that a pattern is in.

    Of Python also what no single line says: an import of several lines or of `.`, and a text in
    several pieces.
    """
    for path in sorted(path for room in rooms for path in (folder / room).rglob("*")):
        if path.suffix not in _TEXTS or not path.is_file():
            continue
        text, where = path.read_text(encoding="utf-8", errors="replace"), path.relative_to(folder)
        lines = text.splitlines()
        numbers = {number for number, line in enumerate(lines, 1) if pattern.search(line)}
        if path.suffix == ".py":
            with contextlib.suppress(SyntaxError):  # its lines alone, then
                meant = spelled(ast.parse(text), where.with_suffix("").parts)
                numbers |= {number for words, number in meant if pattern.search(words)}
        for number in sorted(numbers):
            yield f"{where.as_posix()}:{number}: {lines[number - 1].strip()[:120]}"


def spelled(tree: ast.AST, module: tuple[str, ...]) -> Iterator[tuple[str, int]]:
    """Yield what a module imports, by full names, and its texts and paths as they are joined.

    Args:
        tree: of the module.
        module: parts of its own name; the last of a package is `__init__`.

    Yields:
        Words, and the line on which they stand or begin.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            above = module[: len(module) - node.level] if node.level else ()
            package = ".".join((*above, *filter(None, [node.module])))
            yield package, node.lineno
            for alias in node.names:
                yield f"{package}.{alias.name}", alias.lineno
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value, node.lineno
        elif isinstance(node, ast.BinOp | ast.Tuple | ast.List | ast.Call):
            pieces = _pieces(node)
            yield from ((sign.join(pieces), node.lineno) for sign in "/." if len(pieces) > 1)


def _pieces(node: ast.AST) -> list[str]:
    """Return the texts that a path, a sum, a tuple or a call's arguments are made of, in order."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
        return _pieces(node.left) + _pieces(node.right)
    if isinstance(node, ast.Tuple | ast.List):
        return [piece for each in node.elts for piece in _pieces(each)]
    if isinstance(node, ast.Call):
        return [piece for each in node.args for piece in _pieces(each)]
    return []


def tests_left(folder: Path, part: Part, pattern: re.Pattern[str], asked: list[str]) -> list[str]:
    """Return the test files of a copy that concern neither a part nor the checkout as a whole."""
    texts = {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
        for path in sorted((folder / "tests").rglob("*.py"))
    }
    concerned = {name for name, text in texts.items() if pattern.search(text)}
    concerned = {name for name in concerned if not name.endswith("conftest.py")}
    while more := {
        name
        for name, text in texts.items()
        if name not in concerned
        and any(
            re.search(rf"^(?:from|import) (?:[\w.]+\.)?{Path(other).stem}\b", text, re.MULTILINE)
            for other in concerned
        )
    }:
        concerned |= more
    excluded = {*concerned, *part.tests, *OF_THE_WHOLE}
    return [
        name
        for name in texts
        if Path(name).name.startswith("test_")
        and name not in excluded
        and (not asked or any(name == one or name.startswith(f"{one}/") for one in asked))
    ]


def _take_kernels(folder: Path, kernels: Path) -> None:
    """Copy what the checkout has compiled: numba keeps it by the path of each file's folder."""
    compiled = Path(os.environ["NUMBA_CACHE_DIR"])
    for package in {path.parent for path in (folder / "app").rglob("*.py")}:
        own = ROOT / package.relative_to(folder)
        source, target = (
            place / f"{here.name}_{hashlib.sha1(str(here).encode()).hexdigest()}"
            for place, here in ((compiled, own), (kernels, package))
        )
        if source.is_dir() and not target.exists():
            shutil.copytree(source, target)


def _run(folder: Path, *arguments: str) -> int:
    """Run Python in a copy, with data, settings and cache of their own; return how it ended."""
    own = {name: folder.parent / name for name in ("data", "settings")}
    own["cache"] = folder.parent / "cache" / kernels_digest()
    environment = os.environ | {f"ACUS_{name.upper()}": str(own[name]) for name in own}
    environment |= {
        "PYTHONPATH": str(folder),
        "QT_QPA_PLATFORM": "offscreen",
        "NUMBA_CACHE_DIR": str(folder.parent / "kernels" / kernels_digest()),
    }
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=folder, env=environment, check=False).returncode


def goes_on(
    name: str, place: Path, tests: list[str] | None = None, explained: tuple[str, ...] = ()
) -> bool:
    """Copy, ask and look; print what is wrong, and return whether nothing is.

    Args:
        name: of the part.
        place: folder for the copy, its kernels and its cache.
        tests: paths of tests to run too, empty for all; None runs none.
        explained: exercises that are asked for; all that are left without.
    """
    part, folder = PARTS[name], place / "acus"
    made = (*place.glob("kernels/*"), *place.glob("cache/*"))
    earlier = [older for older in made if older.name != kernels_digest()]
    for leftover in (*(place / kind for kind in ("data", "settings")), *earlier):
        shutil.rmtree(leftover, ignore_errors=True)
    left_out = copied(part, folder)
    _take_kernels(folder, place / "kernels" / kernels_digest())
    print(f"{folder}: without {', '.join(left_out)}", flush=True)
    pattern = pattern_of(part, left_out)
    named = list(naming(folder, pattern, ("app", "acus", "resources")))
    print("\n".join(named) or "nothing names what is gone", flush=True)
    ended = [_run(folder, "-P", "-c", IMPORTS), _run(folder, "-P", "-c", ANSWERS, *explained)]
    if tests is not None:
        files = tests_left(folder, part, pattern, tests)
        print(f"{len(files)} files of tests", flush=True)
        options = ("-q", "-m", "not bench and not display and not long", "-p", "no:xdist")
        ended.append(_run(folder, "-m", "pytest", *options, *files))
    return not (named or any(ended))


def main() -> int:
    """Ask of every part that is named."""
    parser = argparse.ArgumentParser(prog="python -m tools.without", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(PARTS))
    parser.add_argument("--tests", nargs="*", metavar="PATH", help="run tests of the copy too")
    given = parser.parse_args()
    if unknown := [name for name in given.names if name not in PARTS]:
        parser.error(f"there is no part {unknown[0]!r}; there are {', '.join(PARTS)}")
    place = paths.cache() / "without"
    fine = [goes_on(name, place, given.tests) for name in given.names or PARTS]
    return Exit.DONE if all(fine) else Exit.NO


if __name__ == "__main__":
    sys.exit(main())
