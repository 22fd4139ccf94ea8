"""Print the test files that a change can reach: `python -m tools.changed_tests [SINCE]`.

Changed is what differs from a commit (the last one, if none is named), and what git does not know
yet. A change in a module of `app` reaches the modules that import it, in its own layer and the ones
above, and the tests that import any of these. A module may be found by being there (an effect, a
metric, a feature of the window): who imports its package is reached too. Anything else that lies in
the checkout is read by whoever likes, and reaches every test; pages reach their own.
"""

import ast
import subprocess
import sys
from collections.abc import Iterable, Set
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

ALWAYS = ("tests/test_structure.py",)
PAGES = ("tests/test_docs.py", "tests/test_promises.py", "tests/test_extending.py")
"""Tests of README and docs."""


def changed_files(since: str = "HEAD") -> set[str]:
    """Return the paths below the checkout that differ from a commit, or are new.

    Raises:
        subprocess.CalledProcessError: if git does not know the commit.
    """
    asked = (
        ["git", "diff", "--name-only", since],
        ["git", "ls-files", "--others", "--exclude-standard"],
    )
    run = (
        subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True)
        for words in asked
    )
    return {line for done in run for line in done.stdout.splitlines()}


def tests_for(changed: Iterable[str], root: Path) -> list[str]:
    """Return the test files that changed paths reach, as paths below the checkout, in order."""
    changed = set(changed)
    files = {_name(path, root): path for path in sorted((root / "tests").rglob("*.py"))}
    every = [path for path in files.values() if path.name.startswith("test_")]
    modules = {name for name in map(_module, changed) if name}
    pages = {name for name in changed if name.startswith("docs/") or name.endswith(".md")}
    others = {name for name in changed if not _module(name)} - pages
    if others or "tests.conftest" in modules:
        picked = set(every)
    else:
        reached = reached_modules({name for name in modules if name.split(".")[0] != "tests"})
        reached |= {name for name in modules if name.split(".")[0] == "tests"}
        imports = {name: _imports(path) for name, path in files.items()}
        while more := {name for name in files if name not in reached and imports[name] & reached}:
            reached |= more
        picked = {path for name, path in files.items() if name in reached and path in set(every)}
    picked |= {root / name for name in (PAGES if pages else ())}
    picked |= {root / name for name in ALWAYS}
    return sorted(str(path.relative_to(root)) for path in picked if path.exists())


def reached_modules(changed: Set[str]) -> set[str]:
    """Return changed modules of `app` and `tools`, and all that import them, at any remove."""
    import grimp

    graph = grimp.build_graph("app", exclude_type_checking_imports=False, cache_dir=None)
    reached = set(changed)
    for name in sorted(changed):
        if name in graph.modules:
            reached |= graph.find_downstream_modules(name)
        package = name.rpartition(".")[0]
        while "." in package and not graph.find_modules_that_directly_import(package):
            package = package.rpartition(".")[0]
        if "." in package:
            reached |= {package} | graph.find_downstream_modules(package)
    return reached


def _module(path: str) -> str:
    """Return the dotted name of a Python file of the checkout's packages; "" for any other."""
    top = path.split("/")[0]
    if top not in ("app", "tests", "tools") or not path.endswith(".py"):
        return ""
    return path.removesuffix(".py").replace("/", ".").removesuffix(".__init__")


def _name(path: Path, root: Path) -> str:
    return _module(str(path.relative_to(root)))


def _imports(path: Path) -> set[str]:
    """Return the dotted names that a file imports, and of `from a import b` both a and a.b."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module)
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def main() -> None:
    """Print them, a line each."""
    print(*tests_for(changed_files(*sys.argv[1:2]), ROOT), sep="\n")


if __name__ == "__main__":
    main()
