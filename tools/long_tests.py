"""Write docs/tests.md from the marks of the long tests: `python -m tools.long_tests`.

A test that takes half a second or more of a quiet core is marked with its kind:

    @pytest.mark.long("journey")

`make test` leaves these out and `make test-long` runs them. The tests' syntax is read, nothing is
run; a test sees that the page is what the marks say.
"""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

from tools.marks import marks

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "tests.md"

KINDS = {
    "statistics": "many seeds, rendered pictures or drawn examples: a share, a covariance, a bound",
    "journey": "real programs, a whole window, another process or another program's archive",
    "machine": "seconds to minutes of a machine's motion, in the loop and beside it",
}

HEAD = """# What is tested where
<!-- written by python -m tools.long_tests; do not edit -->

| command | runs | on two cores |
|---|---|---|
| `make test` | all but the long tests | eight minutes; three more where no kernel is compiled |
| `make test-changed SINCE=main` | of these what changes since a commit can reach | less |
| `make test-long` | the long ones | forty minutes |
| `make test-all` | both | an hour |
| `make careless`, `soak`, `kills`, `twin`, `fuzz`, `looks`, `by-hand`, `bench` | each | yours |

Continuous integration runs style, types and structure, `make test`, of the long tests as many as an
hour leaves time for, from another file on at each commit, and a minute of `kills`. Long tests that
it did not reach are counted as skipped. Each half ends with its twenty slowest tests.

Long tests are marked with their kind, in the test's own file:

| kind | what |
|---|---|
"""


def long_tests(folder: Path = ROOT / "tests") -> dict[str, Counter[str]]:
    """Return how many tests of each file are marked as long: path -> kind -> functions.

    Raises:
        ValueError: for a mark without one of the kinds.
    """
    marked: dict[str, Counter[str]] = {}
    for file, test, arguments in marks(folder, "long"):
        match arguments:
            case [ast.Constant(value=str(kind))] if kind in KINDS:
                marked.setdefault(file, Counter())[kind] += 1
            case _:
                raise ValueError(f"{file}: {test} is marked as long by none of {', '.join(KINDS)}")
    return marked


def written(marked: dict[str, Counter[str]]) -> str:
    """Return the text of the page: how many functions of each folder are marked by which kind."""
    folders: dict[str, Counter[str]] = {}
    for name, counts in marked.items():
        folders.setdefault(Path(name).parent.as_posix(), Counter()).update(counts)
    lines = [HEAD + "\n".join(f"| {kind} | {text} |" for kind, text in KINDS.items())]
    lines += ["", f"| folder | {' | '.join(KINDS)} |", "|---|" + "---|" * len(KINDS)]
    for name, counts in sorted(folders.items()):
        lines.append(f"| {name} | {' | '.join(str(counts[kind] or '') for kind in KINDS)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the page."""
    PAGE.write_text(written(long_tests()), encoding="utf-8")
    print(f"wrote {PAGE}")


if __name__ == "__main__":
    main()
