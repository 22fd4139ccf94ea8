"""Print the test files that a change can reach: `python -m tools.changed_tests [SINCE]`.

Changed is what differs from a commit (the last one, if none is named), and what git does not know
yet. A change in a module of `app` or `acus` reaches the modules that import it, in its own layer
and the ones above, and the tests that import any of these, by themselves, by a helper or by a
`conftest.py` above them. A module may be found by being there (an effect, a metric, a feature of
the window): who imports its package is reached too, and of a folder of plug-ins who looks for files
of its kind. A test that starts programs is reached by whatever `acus` is made of. Anything else
that lies in the checkout is read by whoever likes, and reaches every test; pages reach their own.
"""

import ast
import subprocess
import sys
from collections.abc import Iterable, Mapping, Set
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from app.core.plugin_folders import APP, folders

if TYPE_CHECKING:
    from grimp import ImportGraph

ROOT = Path(__file__).resolve().parents[1]

ALWAYS = ("tests/test_structure.py",)
PAGES = (
    "tests/test_docs.py",
    "tests/test_promises.py",
    "tests/test_extending.py",
    "tests/test_python_page.py",
)
"""Tests of README and docs."""


def changed_files(since: str = "HEAD") -> set[str]:
    """Return the paths below the checkout that differ from a commit, or are new.

    Raises:
        ValueError: if git does not know the commit.
    """
    differing = _git("diff", "--name-only", since, "--")
    if differing is None:
        raise ValueError(
            f"git knows no commit {since}; SINCE=main names a branch, SINCE=HEAD~3 too"
        )
    return {*differing, *(_git("ls-files", "--others", "--exclude-standard") or ())}


def _git(*words: str) -> list[str] | None:
    """Return the lines of git's answer; None if it refuses."""
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False)
    return None if done.returncode else done.stdout.splitlines()


def tests_for(changed: Iterable[str]) -> list[str]:
    """Return the test files that changed paths reach, as paths below the checkout, in order."""
    files = {_module(path): path for path in _paths()}
    tests = {path for path in files.values() if path.rpartition("/")[2].startswith("test_")}
    changed = set(changed)
    modules = {_module(path) for path in changed} - {""}
    pages = {path for path in changed if path.endswith(".md")}
    picked = set(ALWAYS) | set(PAGES if pages else ())
    if any(not _module(path) for path in changed - pages):
        return sorted(tests | picked)
    program = {name for name in modules if name.startswith(("acus", "app"))}
    reached = reached_modules(program) | modules
    imports = _imports_of_tests()
    while more := {name for name in imports.keys() - reached if imports[name] & reached}:
        reached |= more
    return sorted(picked | {path for name, path in files.items() if name in reached} & tests)


def _paths() -> list[str]:
    """Return the files of tests, without their data, and of tools, which some of them import."""
    found = (path for top in ("tests", "tools") for path in (ROOT / top).rglob("*.py"))
    below = (path.relative_to(ROOT).as_posix() for path in found)
    return sorted(path for path in below if not path.startswith("tests/data/"))


def reached_modules(changed: Set[str]) -> set[str]:
    """Return changed modules of `acus` and `app` and all that rest on them, at any remove."""
    graph = _graph()
    inside = {name: graph.find_descendants(name) for name in changed & graph.modules}
    waiting = [*changed, *(below for names in inside.values() for below in names)]
    reached: set[str] = set()
    while waiting:
        name = waiting.pop()
        if name in reached:
            continue
        reached.add(name)
        importers = _importers(graph, name)
        package = name.rpartition(".")[0]
        if all(importer.startswith(f"{package}.") for importer in importers):
            # Nobody outside its folder names it: who looks into the folders around it may load it,
            # and lies in one of them.
            while "." in package:
                waiting += {package} | _files_in(graph, package)
                package = package.rpartition(".")[0]
        waiting += importers | _finders(name)
    return reached


def _finders(name: str) -> set[str]:
    """Return who finds a module of a folder of plug-ins by the kind of its file."""
    for folder in folders():
        kind, _, file = name.removeprefix(f"{folder.package}.").partition(".")
        if file and name.startswith(f"{folder.package}."):
            return {
                module
                for module, text in _looking().items()
                if f'"{kind}"' in text and not module.startswith(f"{folder.package}.")
            }
    return set()


@cache
def _looking() -> Mapping[str, str]:
    """Return the text of every module above `core` that looks into folders of plug-ins."""
    above = (path for path in APP.rglob("*.py") if not path.is_relative_to(APP / "core"))
    texts = {path: path.read_text(encoding="utf-8") for path in above}
    return {
        _module(path.relative_to(ROOT).as_posix()): text
        for path, text in texts.items()
        if "plugin_folders" in text or "PluginKind(" in text
    }


@cache
def _graph() -> "ImportGraph":
    import grimp

    return grimp.build_graph("acus", "app", exclude_type_checking_imports=False, cache_dir=None)


def _importers(graph: "ImportGraph", name: str) -> set[str]:
    return graph.find_modules_that_directly_import(name) if name in graph.modules else set()


def _module(path: str) -> str:
    """Return the dotted name of a Python file of the checkout's packages; "" for any other."""
    top = path.split("/")[0]
    if top not in ("acus", "app", "tests", "tools") or not path.endswith(".py"):
        return ""
    return path.removesuffix(".py").replace("/", ".").removesuffix(".__init__")


def _files_in(graph: "ImportGraph", package: str) -> set[str]:
    if package not in graph.modules:
        return set()
    return {name for name in graph.find_children(package) if not graph.find_children(name)}


@cache
def _imports_of_tests() -> Mapping[str, set[str]]:
    names = {_module(path): ROOT / path for path in _paths()}
    return {name: _imports(path, names) for name, path in names.items()}


def _imports(path: Path, files: Iterable[str]) -> set[str]:
    """Return the dotted names that a file of tests rests on, and of `from a import b` a and a.b.

    Helpers are imported by their own name or with their folder's (both are on the path); a
    `conftest` above a file by nobody; and who lists modules finds those in folders that it names.
    """
    names = set()
    text = path.read_text(encoding="utf-8")
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module)
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    if "subprocess" in names:
        names.add("app.__main__")
    own = _module(path.relative_to(ROOT).as_posix())
    for name in files:
        folder, _, last = name.rpartition(".")
        above = last == "conftest" and own.startswith(f"{folder}.") and own != name
        listed = "iter_modules" in text and f'"{folder.rpartition(".")[2]}"' in text
        if above or listed or names & {last, name.removeprefix("tests.")}:
            names.add(name)
    return names


def main() -> None:
    """Print them, a line each."""
    try:
        print(*tests_for(changed_files(*sys.argv[1:2])), sep="\n")
    except ValueError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
