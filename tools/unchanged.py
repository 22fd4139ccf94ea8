"""Write what must stay equal while the program is rebuilt, and compare two such folders.

    python -m tools.unchanged write FOLDER [--only PART]...
    python -m tools.unchanged compare BEFORE AFTER

`compare` ends with code 3 where a file differs, is missing or is additional, and prints the first
lines of each difference. What is described is the checkout whose `app` Python finds, so that one
version of this script describes another one's tree:

    PYTHONPATH=/other/tree python tools/unchanged.py write FOLDER

The program is asked by its own commands, each in a process of its own, with empty folders of the
user and a fixed key of this installation; what no command tells, `unchanged_*.py` read. The
records and the page of the wire are the described tree's, real CT comes from ACUS_TEST_DATA.

Left out, as it depends on time or machine: measured costs (`cost_ns`, `picture_ns`,
`model_costs_ns`, lines `cost`), what another build was made with (`build_changes`, `same_build`,
lines `another build`), ports, notes on kernels that compile and on Qt's platform. The program's
version stands in `version.txt` only; folders are <TREE>, <DATA> and <SCRATCH>. Language, width of
the terminal, time zone and Python's hash seed are set.
"""

from __future__ import annotations

import argparse
import difflib
import hashlib
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

HERE: Final = Path(__file__).resolve().parent
DIFFERENT: Final = 3
"""Exit code where two folders are not equal."""
FIRST_LINES: Final = 12
"""Lines of each difference that are printed."""
PATIENCE_S: Final = 900.0
"""A command that takes longer is broken; a first one compiles kernels [s]."""
KEY: Final = bytes(range(32))
"""Key of the installation: the same pseudonyms everywhere."""
MEASURED: Final = {
    *("cost_ns", "picture_ns", "model_costs_ns", "trial_s", "trial_states"),
    *("build_changes", "same_build", "ports"),
}
"""Keys of the JSON that depend on the machine."""
MEASURED_LINES: Final = re.compile(
    r"another build:|compiling for the first time|    cost     |\s*/dev/|This plugin does not"
)
"""Beginnings of lines that depend on the machine."""
REMEDIES: Final = ("resample", "straighten", "halve")
LISTED: Final = ("plugin", "law", "study", "device")


class Outcome(NamedTuple):
    """What a process has printed, cleaned of what depends on time, machine and folders."""

    words: str
    code: int
    out: str
    err: str

    @property
    def text(self) -> str:
        """Return all of it as one block."""
        err = f"stderr:\n{self.err}\n" if self.err else ""
        return f"$ {self.words}\nexit code {self.code}\n{self.out}\n{err}\n"

    def rows(self, key: str) -> list[dict[str, Any]]:
        """Return a list among the facts of an answer in JSON; empty where there is none."""
        document = json.loads(self.out) if self.out.startswith("{") else {}
        return list(document.get("facts", {}).get(key, ()))


@dataclass(frozen=True, slots=True)
class Tree:
    """A checkout that is described.

    Attributes:
        root: of the checkout.
        data: folder of real CT.
        scratch: empty folder for all that the program writes.
        out: where the description goes.
    """

    root: Path
    data: Path
    scratch: Path
    out: Path

    def environment(self) -> dict[str, str]:
        """Return the variables of a process: nothing of this user's but the cache of kernels."""
        import platformdirs

        kept = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("ACUS_", "XDG_", "LC_", "QT_")) and name != "LANGUAGE"
        }
        cache = os.environ.get("ACUS_CACHE") or platformdirs.user_cache_dir("acus", appauthor=False)
        places = {"HOME": "home", "TMPDIR": "tmp", "ACUS_DATA": "data"}
        places |= {"ACUS_SETTINGS": "settings", "ACUS_SESSIONS": "records"}
        for place in ("home", "tmp"):
            (self.scratch / place).mkdir(exist_ok=True)
        return (
            kept
            | {name: str(self.scratch / place) for name, place in places.items()}
            | {"ACUS_CACHE": cache, "PYTHONPATH": str(self.root), "PYTHONHASHSEED": "0"}
            | {"LANG": "C.UTF-8", "LC_ALL": "C.UTF-8", "TZ": "UTC", "COLUMNS": "100"}
            | {"NO_COLOR": "1", "TERM": "dumb", "QT_QPA_PLATFORM": "offscreen"}
            | {"SDL_AUDIODRIVER": "dummy", "MUJOCO_GL": "egl"}
        )

    def acus(self, *words: str | Path) -> Outcome:
        """Run a command of the program."""
        return self._run("acus", "-m", "app", *words)

    def script(self, name: str, *words: str | Path) -> Outcome:
        """Run a script beside this one, which reads the program through its own names."""
        outcome = self._run(name, HERE / f"unchanged_{name}.py", *words)
        if outcome.code:
            _tell(f"  !! {outcome.words} failed: {outcome.err.splitlines()[-1:]}")
        return outcome

    def _run(self, name: str, *words: str | Path) -> Outcome:
        texts = [str(word) for word in words]
        done = subprocess.run(
            [sys.executable, *texts],
            cwd=self.scratch,
            env=self.environment(),
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            timeout=PATIENCE_S,
            check=False,
        )
        shown = self.clean(" ".join([name, *(texts[2:] if name == "acus" else texts[1:])]))
        return Outcome(shown, done.returncode, self.clean(done.stdout), self.clean(done.stderr))

    def clean(self, text: str) -> str:
        """Return the text without folders, measured values and the program's version."""
        known = {self.scratch: "<SCRATCH>", self.data: "<DATA>", self.root: "<TREE>"}
        for folder in sorted(known, key=lambda one: -len(str(one))):
            text = text.replace(str(folder), known[folder])
        try:
            document = json.loads(text)
        except ValueError:
            lines = [line for line in text.splitlines() if not MEASURED_LINES.match(line)]
            return "\n".join(line.rstrip() for line in lines).rstrip()
        if isinstance(document, dict) and "form" in document:
            document.pop("acus", None)
            document = _without(document, MEASURED)
        return json.dumps(document, indent=1, ensure_ascii=False)

    def write(self, name: str, *parts: Outcome | str) -> None:
        """Write a file of the description."""
        path = self.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        texts = [part.text if isinstance(part, Outcome) else part for part in parts]
        path.write_text("".join(texts).rstrip() + "\n", encoding="utf-8")

    def copy(self, made: Path, name: str) -> None:
        """Take a file that a command has written into the description, byte by byte."""
        if made.exists():
            (self.out / name).write_bytes(made.read_bytes())


def _without(value: Any, names: set[str]) -> Any:
    if isinstance(value, dict):
        return {key: _without(one, names) for key, one in value.items() if key not in names}
    return [_without(one, names) for one in value] if isinstance(value, list) else value


def _digests(folder: Path, pattern: str) -> Iterator[str]:
    """Yield a line for each file of a pattern: SHA-256 and path."""
    for path in sorted(folder.rglob(pattern)):
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        yield f"{digest}  {path.relative_to(folder)}\n"


# --- the parts -----------------------------------------------------------------------------------
def records(tree: Tree) -> None:
    """Write replay, verification, score with all metrics and exports of the records kept."""
    folder, source = tree.scratch / "records", tree.root / "tests" / "data" / "records-machines"
    shutil.copytree(source, folder, dirs_exist_ok=True)
    names = sorted(path.stem for path in folder.glob("*.mcap"))
    tree.write("records/digests.txt", *_digests(folder, "*.mcap"))
    for name in names:
        _tell(f"  {name}")
        table = tree.scratch / f"{name}.csv"
        tree.write(
            f"records/{name}.txt",
            tree.acus("session", "show", name, "--json"),
            tree.acus("session", "show", name),
            tree.acus("session", "verify", name, "--json"),
            tree.acus("session", "replay", name, "--check", "--json"),
            tree.acus("session", "replay", name),
            tree.acus("session", "export", name, "--trajectory", "--out", table, "--json"),
        )
        tree.copy(table, f"records/{name}.csv")
    table = tree.scratch / "scores.csv"
    exported = tree.acus("session", "export", *names, "--out", table, "--json")
    tree.copy(table, "records/scores.csv")
    asked = [tree.acus("session", "list", "--json"), tree.acus("session", "list"), exported]
    asked += [tree.acus("session", "compare", names[0], name) for name in names[1:3]]
    for form in ("tidy", "wide", "moodle", "json"):
        table = tree.scratch / f"results.{'json' if form == 'json' else 'csv'}"
        asked.append(tree.acus("results", "export", form, "--out", table, "--json"))
        tree.copy(table, f"records/{table.stem}-{form}{table.suffix}")
    tree.write("records/all.txt", *asked)
    tree.write("records/digests-afterwards.txt", *_digests(folder, "*.mcap"))


def dicom(tree: Tree) -> None:
    """Write voxels' digests, places and refusals of real CT, and what imports make of it."""
    if not tree.data.is_dir():
        tree.write("dicom/none.txt", "ACUS_TEST_DATA names no folder\n")
        return
    _fix_key(tree)
    tree.write("dicom/all.txt", tree.acus("ct", "list", tree.data, "--json"))
    places = {*tree.data.glob("ct_*/"), *tree.data.glob("ct_cases/*/")} - {tree.data / "ct_cases"}
    for place in sorted(places | {*tree.data.glob("ct_transfer_syntaxes/*.dcm*")}):
        name = str(place.relative_to(tree.data)).replace("/", "-")
        _tell(f"  {name}")
        tree.write(f"dicom/{name}.txt", *_series(tree, place))
    _tell("  study dicom")
    tree.write("dicom/study.txt", tree.acus("study", "dicom", tree.data, "--quick", "--json"))


def _series(tree: Tree, place: Path) -> Iterator[Outcome | str]:
    """Yield list, digests, structures and import of one folder."""
    listing = tree.acus("ct", "list", place, "--json")
    yield listing
    if place.is_file():
        return
    yield tree.acus("ct", "list", place)
    for series in listing.rows("series"):
        if "CT" not in str(series.get("modality", "CT")):
            continue
        asked = ("ct", "digest", place, "--series", str(series.get("key", series.get("uid"))))
        yield tree.acus(*asked, "--json")
        if series.get("remedy", "none") not in ("", "none"):
            for remedy in REMEDIES:
                yield tree.acus(*asked, "--remedy", remedy, "--json")
    if place.parent.name != "ct_cases":
        return
    for path in sorted(place.glob("*.dcm")) if (place / "ct").is_dir() else ():
        yield tree.acus("structures", "list", path, "--ct", place / "ct", "--json")
    yield tree.acus("ct", "import", place, "--json")
    library = tree.scratch / "data"
    yield from _digests(library, "*.dcm")
    shutil.rmtree(library, ignore_errors=True)


def _fix_key(tree: Tree) -> None:
    (tree.scratch / "settings").mkdir(exist_ok=True)
    (tree.scratch / "settings" / "privacy.key").write_bytes(KEY)


def exercises(tree: Tree) -> None:
    """Write the schema of exercises, and each shipped one as it is listed and explained."""
    tree.write("exercises/schema.json", tree.acus("exercise", "schema").out)
    listing = tree.acus("exercise", "list", "--json")
    names = [str(one.get("id", one.get("name"))) for one in listing.rows("exercises")]
    tree.write("exercises/all.txt", listing, tree.acus("exercise", "list"))
    for name in names:
        _tell(f"  {name}")
        tree.write(
            f"exercises/{name}.txt",
            tree.acus("explain", name, "--json"),
            tree.acus("explain", name, "--real"),
            tree.acus("exercise", "validate", name, "--json"),
        )


def window(tree: Tree) -> None:
    """Write menus, shortcuts, panels and pages of the window, by role."""
    for state in ("open", "exercise", "guarded"):
        _tell(f"  {state}")
        for folder in ("data", "records", "settings"):
            shutil.rmtree(tree.scratch / folder, ignore_errors=True)
        tree.write(f"window/{state}.txt", tree.script("window", state))


def program(tree: Tree) -> None:
    """Write version, commands, plug-ins, pseudonyms, and the bytes of both protocols."""
    _fix_key(tree)
    tree.write("version.txt", tree.acus("--version"))
    tree.write("help.txt", tree.script("inside", "commands"))
    asked = [(noun, "list", *form) for noun in LISTED for form in ((), ("--json",))]
    tree.write("plugins/lists.txt", *(tree.acus(*words) for words in asked))
    tree.write("plugins/declared.txt", tree.script("inside", "declared", tree.root))
    tree.write("pseudonyms.txt", tree.script("inside", "pseudonyms"))
    tree.write("wire.txt", tree.script("inside", "wire", tree.root / "docs" / "protocol.md"))


PARTS: Final[dict[str, Callable[[Tree], None]]] = {
    part.__name__: part for part in (program, records, exercises, window, dicom)
}


def described_root() -> Path:
    """Return the root of the checkout whose `app` Python finds.

    Raises:
        SystemExit: if there is none.
    """
    spec = importlib.util.find_spec("app")
    if spec is None or spec.origin is None:
        raise SystemExit("no package `app` on Python's path: set PYTHONPATH to a checkout's root")
    return Path(spec.origin).resolve().parents[1]


def write(out: Path, only: Sequence[str] = ()) -> None:
    """Write the description of the tree into a folder, which is emptied of those parts."""
    root = described_root()
    data = Path(os.environ.get("ACUS_TEST_DATA", root.parent / "shared" / "data")).resolve()
    begun = time.monotonic()
    _tell(f"{root} is described in {out}")
    if not only and out.exists():
        shutil.rmtree(out)
    out.mkdir(parents=True, exist_ok=True)
    for name in only or PARTS:
        _tell(f"{time.monotonic() - begun:6.1f} s  {name}")
        with tempfile.TemporaryDirectory(prefix="acus-unchanged-") as scratch:
            PARTS[name](Tree(root, data, Path(scratch).resolve(), out))
    _tell(f"{time.monotonic() - begun:6.1f} s  done: {sum(1 for _ in _files(out))} files")


def _tell(words: str) -> None:
    print(words, flush=True)


# --- comparing -----------------------------------------------------------------------------------
def differences(before: Path, after: Path) -> Iterator[tuple[str, list[str]]]:
    """Yield the name of each file that is not equal, and lines that say how."""
    first, second = set(_files(before)), set(_files(after))
    for name in sorted(first | second):
        if name not in second:
            yield name, ["missing afterwards"]
        elif name not in first:
            yield name, ["additional afterwards"]
        elif (before / name).read_bytes() != (after / name).read_bytes():
            old, new = ((side / name).read_bytes().decode().split("\n") for side in (before, after))
            yield name, list(difflib.unified_diff(old, new, "before", "after", lineterm="", n=1))


def _files(folder: Path) -> Iterator[str]:
    for path in folder.rglob("*"):
        if path.is_file():
            yield path.relative_to(folder).as_posix()


def compare(before: Path, after: Path) -> int:
    """Print what differs between two folders; return 0 where nothing does, else `DIFFERENT`."""
    unequal = list(differences(before, after))
    for name, lines in unequal:
        _tell(f"≠ {name}")
        for line in lines[:FIRST_LINES]:
            _tell(f"    {line[:200]}")
        if len(lines) > FIRST_LINES:
            _tell(f"    … and {len(lines) - FIRST_LINES} more lines")
    total = len(set(_files(before)) | set(_files(after)))
    _tell(f"{len(unequal)} of {total} files differ" if unequal else f"equal: {total} files")
    return DIFFERENT if unequal else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Write or compare."""
    parser = argparse.ArgumentParser(
        prog="python -m tools.unchanged", description="Write what must stay equal; compare."
    )
    verbs = parser.add_subparsers(dest="verb", required=True)
    writing = verbs.add_parser("write", help="describe the tree")
    writing.add_argument("folder", type=Path)
    writing.add_argument("--only", action="append", choices=list(PARTS), default=[])
    comparing = verbs.add_parser("compare", help="compare two descriptions; code 3 if they differ")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    options = parser.parse_args(arguments)
    if options.verb == "write":
        write(options.folder.resolve(), options.only)
        return 0
    for folder in (options.before, options.after):
        if not folder.is_dir():
            parser.error(f"{folder} is no folder; `write` makes one")
    return compare(options.before, options.after)


if __name__ == "__main__":
    sys.exit(main())
