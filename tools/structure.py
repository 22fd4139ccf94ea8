"""Figures of the structure: how many ideas a stranger meets.

    python -m tools.structure [--list] [--check] [--budget]

Counts for each room of `app`, and for each machine, its files, lines and nodes of its syntax trees,
beside the nodes that tools/budget.yaml grants it; circles of imports (deferred and type-only ones
count), modules that exactly one other imports (pieces of an idea that lies elsewhere), and class
names that mean more than one thing. `--list` names them; `--check` ends with code 3 where one of
the bounds below, or a room's budget, is passed. `--budget` writes what is there now as the budget:
the commit that raises one says what the new code replaces.
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

import yaml

ROOT = Path(__file__).resolve().parents[1]
BUDGET = Path(__file__).with_name("budget.yaml")
MACHINES = "app.mechanisms."
"""A folder in there is a machine's, and counted by itself."""
MOST_ALONE = 0.165
"""Share of modules that may have exactly one importer."""
MOST_NAMES = 10
"""Class names that may stand for more than one thing."""


@dataclass(frozen=True, slots=True)
class Structure:
    """What the syntax trees say.

    Attributes:
        files: module -> its file.
        lines: module -> how many lines it has.
        nodes: module -> how many nodes its syntax tree has: size that no formatting changes.
        imports: module -> the modules of `app` that it imports, wherever in its text.
        classes: class name -> modules that define it.
    """

    files: Mapping[str, Path]
    lines: Mapping[str, int]
    nodes: Mapping[str, int]
    imports: Mapping[str, frozenset[str]]
    classes: Mapping[str, tuple[str, ...]]

    @property
    def modules(self) -> tuple[str, ...]:
        """All but the packages' own files."""
        return tuple(name for name, path in self.files.items() if path.name != "__init__.py")

    @property
    def rooms(self) -> dict[str, tuple[str, ...]]:
        """Modules of each room, and of each machine, by its name."""
        rooms: dict[str, list[str]] = defaultdict(list)
        for name, path in self.files.items():
            rooms[_room(name, path.name == "__init__.py")].append(name)
        return {room: tuple(names) for room, names in sorted(rooms.items())}

    @property
    def size(self) -> dict[str, int]:
        """Nodes of each room and machine."""
        return {room: sum(self.nodes[name] for name in names) for room, names in self.rooms.items()}

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
    sizes: dict[str, int] = {}
    imports: dict[str, frozenset[str]] = {}
    classes: dict[str, list[str]] = defaultdict(list)
    for name, path in paths.items():
        text = path.read_text(encoding="utf-8")
        lines[name] = text.count("\n")
        nodes = list(ast.walk(ast.parse(text)))
        sizes[name] = len(nodes)
        found = {used for node in nodes for used in _imported(node) if used != name}
        imports[name] = frozenset(_longest(used, paths) for used in found) - {"", name}
        for node in nodes:
            if isinstance(node, ast.ClassDef):
                classes[node.name].append(name)
    return Structure(paths, lines, sizes, imports, {name: tuple(w) for name, w in classes.items()})


def _room(name: str, is_package: bool) -> str:
    """Return the room of a module; in the room of machines each folder is one of its own."""
    parts = name.split(".")
    machine = name.startswith(MACHINES) and (len(parts) > 3 or is_package)
    return "/".join(parts[1:3]) if machine else parts[1] if len(parts) > 1 else "app"


def read_budget(path: Path = BUDGET) -> dict[str, int]:
    """Return the nodes that each room may have."""
    budget: dict[str, int] = yaml.safe_load(path.read_text(encoding="utf-8"))
    return budget


def over_budget(structure: Structure, budget: Mapping[str, int]) -> tuple[str, ...]:
    """Return a sentence for each room that has more nodes than it is granted, or no grant."""
    return tuple(
        f"{room} has {nodes} nodes, {nodes - budget.get(room, 0)} more than granted: take some "
        "out, or raise it (--budget) and say in the commit what the new code replaces"
        for room, nodes in structure.size.items()
        if nodes > budget.get(room, 0)
    )


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
    parser.add_argument("--budget", action="store_true", help="grant what is there now")
    parser.add_argument("--root", type=Path, default=ROOT, help="another checkout")
    options = parser.parse_args()
    structure = read(options.root)
    size = structure.size
    if options.budget:
        BUDGET.write_text("".join(f"{room}: {nodes}\n" for room, nodes in size.items()))
    budget = read_budget()
    print(f"{'room':<22}{'files':>7}{'lines':>8}{'nodes':>9}{'granted':>9}")
    for room, names in structure.rooms.items():
        lines = sum(structure.lines[name] for name in names)
        granted = budget.get(room, 0)
        print(f"{room:<22}{len(names):>7}{lines:>8}{size[room]:>9}{granted:>9}")
    lines, nodes = sum(structure.lines.values()), sum(size.values())
    granted = sum(budget.values())
    print(f"{'together':<22}{len(structure.files):>7}{lines:>8}{nodes:>9}{granted:>9}\n")
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
    over = over_budget(structure, budget)
    for sentence in over:
        print(sentence)
    passed = (
        over or structure.circles or share > MOST_ALONE or len(structure.ambiguous) > MOST_NAMES
    )
    return 3 if options.check and passed else 0


if __name__ == "__main__":
    sys.exit(main())
