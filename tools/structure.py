"""Figures of the structure: how many ideas a stranger meets.

    python -m tools.structure [--list] [--check]

Counts for each room of `app` its files and lines; circles of imports (deferred and type-only ones
count), modules that exactly one other imports (pieces of an idea that lies elsewhere), and class
names that mean more than one thing. `--list` names them; `--check` ends with code 3 where one of
the bounds below is passed.
"""

from __future__ import annotations

import argparse
import ast
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST_ALONE = 0.16
"""Share of modules that may have exactly one importer."""
MOST_NAMES = 10
"""Class names that may stand for more than one thing."""


@dataclass(frozen=True, slots=True)
class Structure:
    """What the syntax trees say.

    Attributes:
        files: module -> its file.
        lines: module -> how many lines it has.
        imports: module -> the modules of `app` that it imports, wherever in its text.
        classes: class name -> modules that define it.
    """

    files: Mapping[str, Path]
    lines: Mapping[str, int]
    imports: Mapping[str, frozenset[str]]
    classes: Mapping[str, tuple[str, ...]]

    @property
    def modules(self) -> tuple[str, ...]:
        """All but the packages' own files."""
        return tuple(name for name, path in self.files.items() if path.name != "__init__.py")

    @property
    def alone(self) -> tuple[str, ...]:
        """Modules with exactly one importer."""
        importers = Counter(used for uses in self.imports.values() for used in uses)
        return tuple(name for name in self.modules if importers[name] == 1)

    @property
    def ambiguous(self) -> dict[str, tuple[str, ...]]:
        """Class names that more than one module defines."""
        return {name: where for name, where in sorted(self.classes.items()) if len(where) > 1}

    @property
    def circles(self) -> tuple[frozenset[str], ...]:
        """Sets of modules that import each other, directly or through others."""
        return tuple(_circles(self.imports))


def read(root: Path = ROOT) -> Structure:
    """Return the structure of the checkout at `root`."""
    paths = {_name(path, root): path for path in sorted((root / "app").rglob("*.py"))}
    lines: dict[str, int] = {}
    imports: dict[str, frozenset[str]] = {}
    classes: dict[str, list[str]] = defaultdict(list)
    for name, path in paths.items():
        text = path.read_text(encoding="utf-8")
        lines[name] = text.count("\n")
        nodes = list(ast.walk(ast.parse(text)))
        found = {used for node in nodes for used in _imported(node) if used != name}
        imports[name] = frozenset(_longest(used, paths) for used in found) - {"", name}
        for node in nodes:
            if isinstance(node, ast.ClassDef):
                classes[node.name].append(name)
    return Structure(paths, lines, imports, {name: tuple(w) for name, w in classes.items()})


def _name(path: Path, root: Path) -> str:
    return ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")


def _imported(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
        yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _longest(name: str, known: Mapping[str, Path]) -> str:
    """Return the module that an imported name lies in; empty if it is none of the program's."""
    while name and name not in known:
        name = name.rpartition(".")[0]
    return name


def _circles(imports: Mapping[str, frozenset[str]]) -> Iterator[frozenset[str]]:
    """Yield the strongly connected parts of more than one module.

    While there is a circle, its modules become one, until what is left has an order.
    """
    members = {name: frozenset({name}) for name in imports}
    graph = {name: set(uses) for name, uses in imports.items()}
    while True:
        try:
            TopologicalSorter(graph).prepare()
        except CycleError as error:
            circle = set(error.args[1])
            one = min(circle)
            members[one] = frozenset[str]().union(*(members[name] for name in circle))
            graph[one] = set[str]().union(*(graph.pop(name) for name in circle)) - circle
            for name in circle - {one}:
                del members[name]
            for uses in graph.values():
                if uses & circle:
                    uses -= circle
                    uses.add(one)
            graph[one].discard(one)
        else:
            break
    yield from (part for part in members.values() if len(part) > 1)


def main() -> int:
    """Print the figures; return 3 where a bound is asked for and passed."""
    parser = argparse.ArgumentParser(prog="python -m tools.structure", description=__doc__)
    parser.add_argument("--list", action="store_true", help="name what is counted")
    parser.add_argument("--check", action="store_true", help="code 3 where a bound is passed")
    parser.add_argument("--root", type=Path, default=ROOT, help="another checkout")
    options = parser.parse_args()
    structure = read(options.root)
    rooms: dict[str, list[str]] = defaultdict(list)
    for name in structure.files:
        rooms[name.split(".")[1] if "." in name else "app"].append(name)
    print(f"{'room':<12}{'files':>7}{'lines':>8}")
    for room, names in sorted(rooms.items()):
        print(f"{room:<12}{len(names):>7}{sum(structure.lines[name] for name in names):>8}")
    print(f"{'together':<12}{len(structure.files):>7}{sum(structure.lines.values()):>8}\n")
    alone, modules = structure.alone, structure.modules
    share = len(alone) / len(modules)
    print(f"circles of imports: {len(structure.circles)}")
    print(f"modules with one importer: {len(alone)} of {len(modules)} ({100 * share:.0f} %)")
    print(f"class names with more than one meaning: {len(structure.ambiguous)}")
    if options.list:
        for circle in structure.circles:
            print("circle:", ", ".join(sorted(circle)))
        for name in alone:
            print("one importer:", name)
        for name, where in structure.ambiguous.items():
            print(f"{name}:", ", ".join(where))
    passed = structure.circles or share > MOST_ALONE or len(structure.ambiguous) > MOST_NAMES
    return 3 if options.check and passed else 0


if __name__ == "__main__":
    sys.exit(main())
