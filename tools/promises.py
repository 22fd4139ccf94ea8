"""Write docs/promises.md from the marks of the tests that hold them: `python -m tools.promises`.

A test that holds a sentence of README or docs is marked with it:

    @pytest.mark.promise("docs/protocol.md: at most 20 ms later: torque 0, tripped")

The tests' syntax is read, nothing is run. Tests of this table see that each sentence stands in its
page, and that each *never* and *always* about safety, privacy and records is held or listed here.
"""

from __future__ import annotations

import ast
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from tools.marks import marks

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "promises.md"
WRITTEN = "<!-- written by python -m tools.promises; do not edit -->"

WATCHED = (
    "README.md",
    *(f"docs/{name}.md" for name in ("hardware", "pacs", "people", "privacy", "protocol")),
    *(f"docs/{name}.md" for name in ("sessions", "troubleshooting", "user-guide")),
)
"""Pages of safety, privacy, replay and limits."""

ABSOLUTE = re.compile(r"\b(never|always)\b|\b(on|with) any fault\b", re.IGNORECASE)

_NO_ROBOT = "no real robot is at hand to try"
NOT_PROMISED = {
    "docs/hardware.md: a student who aligns the needle outside the skin never feels 5 N": (
        "follows from the profile's torque; docs/mechanism.md has the figures"
    ),
    "docs/hardware.md: `limits.hand_force` is never above 5 N": "of the profiles that ship",
    "docs/hardware.md: the whole range rules there, always": _NO_ROBOT,
    "docs/hardware.md: Acus stops there and never commands more": _NO_ROBOT,
    "docs/protocol.md: firmware on hardware never sets it": "of firmware that is not ours",
    "docs/protocol.md: bit 3 is never set": "a format",
    "docs/protocol.md: A zero torque after a push never waits": _NO_ROBOT,
    "docs/sessions.md: hand led by inputs, real time, never at rest": "a measurement",
    "docs/user-guide.md: Enter a **pseudonym** there, never a name": "asked of the student",
    "docs/user-guide.md: shows it always or never": "a setting",
}
"""Sentences that promise nothing that a test could hold, each with the reason."""


@dataclass(frozen=True, order=True)
class Promise:
    """A sentence of a page, and the test that holds it.

    Attributes:
        page: path below the checkout.
        sentence: as it stands there, white space aside.
        test: file and name.
    """

    page: str
    sentence: str
    test: str


def promises(folder: Path = ROOT / "tests") -> list[Promise]:
    """Return what the tests of a folder are marked with, in the order of pages.

    Raises:
        ValueError: for a mark that is no text of page and sentence.
    """
    return sorted(
        Promise(*_told(mark, f"{file}::{test}"), f"{file}::{test}")
        for file, test, arguments in marks(folder, "promise")
        for mark in arguments
    )


def _told(mark: ast.expr, test: str) -> tuple[str, str]:
    value = mark.value if isinstance(mark, ast.Constant) else None
    page, colon, sentence = str(value).partition(": ")
    if not isinstance(value, str) or not colon or not page.endswith(".md"):
        raise ValueError(
            f"{test} is marked with {ast.unparse(mark)}; wanted is 'page.md: sentence'"
        )
    return page, " ".join(sentence.split())


def words(page: str) -> str:
    """Return a page's text on one line."""
    return " ".join((ROOT / page).read_text(encoding="utf-8").split())


def sentences(page: str) -> list[str]:
    """Return a page's sentences, cells of tables and headings, without its blocks of code."""
    text = re.sub(r"(?ms)^```.*?^```", "", (ROOT / page).read_text(encoding="utf-8"))
    text = re.sub(r"(?m)^\|.*$", lambda row: "\n\n" + row[0].replace("|", "\n\n") + "\n\n", text)
    text = re.sub(r"(?m)^(#+|\s*[-*]) ", "\n\n", text)
    parts = [" ".join(part.split()) for part in re.split(r"\n\s*\n", text)]
    ends = re.compile(r"(?<=[.!?])\s+(?=[A-Z`*\[(])")
    return [one for part in parts for one in ends.split(part) if one]


def unheld(known: list[Promise]) -> list[str]:
    """Return every absolute sentence of the watched pages that no test holds and no list has."""
    keys = (key.partition(": ") for key in NOT_PROMISED)
    listed = [Promise(page, sentence, "") for page, _, sentence in keys]
    return [
        f"{page}: {one}"
        for page in WATCHED
        for one in sentences(page)
        if ABSOLUTE.search(one)
        and not any(p.page == page and p.sentence in one for p in [*known, *listed])
    ]


def written(known: list[Promise]) -> str:
    """Return the text of the page."""
    lines = [
        "# What is promised, and what holds it",
        WRITTEN,
        "",
        "Sentences about safety, privacy, replay and limits, each with the test that fails where",
        "it is untrue.",
        "",
        "| page | promise | held by |",
        "|---|---|---|",
    ]
    lines += [f"| {one.page} | {_cell(one.sentence)} | `{one.test}` |" for one in known]
    lines += [
        "",
        "*Never* and *always* of these pages that no test holds:",
        "",
        "| page | sentence | because |",
        "|---|---|---|",
    ]
    for key, why in sorted(NOT_PROMISED.items()):
        page, sentence = key.split(": ", 1)
        lines.append(f"| {page} | {_cell(sentence)} | {why} |")
    return "\n".join(lines) + "\n"


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def main() -> int:
    """Write the page."""
    PAGE.write_text(written(promises()), encoding="utf-8")
    print(f"wrote {PAGE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
