"""Write docs/accuracy/ from the tables kept with the program: `python -m tools.accuracy_pages`.

An index with a row per study, and a page per study with its diagram and its table. Nothing is
measured here: `acus study NAME --write` does that.
"""

from __future__ import annotations

import sys
import textwrap
from pathlib import Path

from app.studies.findings import Sheet
from app.studies.kept import Kept, kept, kept_names
from app.studies.plot import draw
from app.studies.rule import EQUALLY_CHEAP, noticed_share
from app.studies.study import Point, duration
from app.studies.table import failure_lines

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "accuracy"
WRITTEN = "<!-- written by python -m tools.accuracy_pages; do not edit -->"
WIDTH = 118
MOST_ROWS = 40
"""Longer tables of a study's own are left to `acus study NAME --out`."""
MOST_SETTINGS, MOST_WAYS = 12, 8
"""Larger tables of errors by setting are left to it too."""

HEAD = f"""# What accuracy costs
{WRITTEN}

Wherever the program can compute the same thing in several ways, a study measures each way's error
against a reference and its time. The default is found by one rule: the **cheapest way whose error
nobody notices**, in all settings, and that keeps the **deadline** in all of them; ways within
{100 * (EQUALLY_CHEAP - 1):.0f} % of the least time count as equally cheap, and the more exact one
is taken. Where the program does otherwise, the exception stands here with its number. Tests hold
this rule, the kept tables, the declared defaults and the very functions that the running program
calls against each other.

Errors are the worst of all settings, times the longest: processor time of one call, medians, on
one core of a shared virtual machine. They hold as ratios; `acus study NAME` measures on your own
computer, `acus study all` everything. Noticed are 10 % of a force or 0.1 N, 0.1 mm, 10 ms, unless
a study says otherwise. Hard cases have [a page of their own](hard.md), maps and surveys stand in
[Studies](../studies.md).

| study | ways | default | error | time | noticed from | deadline | exception |
|---|---|---|---|---|---|---|---|
"""


def index() -> str:
    """Return the page of all studies."""
    return HEAD + "\n".join(_row(name, kept(name)) for name in kept_names()) + "\n"


def page(name: str) -> str:
    """Return the page of a study."""
    found = kept(name)
    study = found.result.study
    lines = [
        f"# {study.title}",
        WRITTEN,
        "",
        *_wrapped(f"*{study.question}* `acus study {name}`. Reference: {study.reference}."),
        "",
        f"![Error and time of the ways]({name}.svg)",
        "",
        f"| way | what it is | {_cell(study.error_label)} | worst in | of noticed | time | |",
        "|---|---|---|---|---|---|---|",
        *(_way(found, point) for point in found.result.summary()),
        "",
        *_wrapped(
            f"Noticed from: {study.perception.label}. Deadline: {study.deadline.label}. "
            f"Default: `{found.default}`{', ' + study.because if study.because else ''}."
        ),
    ]
    if found.exception:
        lines += ["", *_wrapped(f"**Exception**: {found.exception}")]
    failing = failure_lines(found.result)
    if failing:
        lines += ["", "Ways that fail:", "", *(_item(line) for line in failing)]
    lines += _by_setting(found)
    if found.result.findings is not None:
        for sheet in found.result.findings.sheets:
            lines += _sheet(name, sheet)
        for line in found.result.findings.lines:
            lines += ["", *_wrapped(line)]
    told = (
        f"Measured on {found.date} by version {found.version}: processor time, medians of "
        f"{found.repeats}."
    )
    return "\n".join([*lines, "", told]) + "\n"


def _by_setting(outcome: Kept) -> list[str]:
    """Return the table of every way's error in each setting, where it is not too large."""
    points = outcome.result.points
    settings = list(dict.fromkeys(point.setting for point in points))
    ways = list(dict.fromkeys(point.way for point in points))
    if not (1 < len(settings) <= MOST_SETTINGS and len(ways) <= MOST_WAYS):
        return []
    errors = {(point.setting, point.way): f"{point.error:.2g}" for point in points}
    rows = [
        f"| {_cell(setting)} | "
        + " | ".join(errors.get((setting, way), "-") for way in ways)
        + " |"
        for setting in settings
    ]
    head = " | ".join(_cell(way) for way in ways)
    return [
        "",
        "Error in each setting:",
        "",
        f"| | {head} |",
        "|---" * (len(ways) + 1) + "|",
        *rows,
    ]


def _row(name: str, outcome: Kept) -> str:
    study = outcome.result.study
    worst = next(p for p in outcome.result.summary() if p.way == outcome.default)
    cells = (
        f"[{name}]({name}.md)",
        str(len(study.ways)),
        f"`{outcome.default}`",
        f"{worst.error:.2g} ({noticed_share(outcome.result, worst.way):.2g} of what is noticed)",
        duration(worst.seconds),
        study.perception.label,
        study.deadline.label,
        outcome.exception or "-",
    )
    return f"| {' | '.join(_cell(cell) for cell in cells)} |"


def _way(outcome: Kept, worst: Point) -> str:
    way = next(one for one in outcome.result.study.ways if one.name == worst.way)
    marks = [
        mark
        for mark, holds in (
            ("default", way.name == outcome.default),
            ("sweet spot", way.name == outcome.sweet_spot),
            ("noticed", not worst.within_perception),
            ("late", not worst.within_deadline),
        )
        if holds
    ]
    share = noticed_share(outcome.result, way.name)
    cells = (
        f"`{way.name}`",
        way.description or way.family,
        f"{worst.error:.2g}",
        worst.setting,
        f"{share:.2g}",
        duration(worst.seconds),
        ", ".join(marks),
    )
    return f"| {' | '.join(_cell(cell) for cell in cells)} |"


def _sheet(name: str, sheet: Sheet) -> list[str]:
    if len(sheet.rows) > MOST_ROWS:
        return ["", f"{sheet.title}: `acus study {name}` prints {len(sheet.rows)} rows."]
    rows = [
        " | ".join(_cell(f"{cell:.3g}" if isinstance(cell, float) else str(cell)) for cell in row)
        for row in sheet.rows
    ]
    head = " | ".join(_cell(column) for column in sheet.columns)
    rule = "|".join("---" for _ in sheet.columns)
    return ["", f"{sheet.title}:", "", f"| {head} |", f"|{rule}|", *(f"| {row} |" for row in rows)]


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _item(text: str) -> str:
    return textwrap.fill(text, WIDTH, initial_indent="- ", subsequent_indent="  ")


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def pages() -> dict[str, str]:
    """Return every page by its file name."""
    return {"index.md": index()} | {f"{name}.md": page(name) for name in kept_names()}


def main(names: list[str]) -> int:
    """Write the pages, and the diagrams: of the studies named, or of all."""
    FOLDER.mkdir(exist_ok=True)
    for file, text in pages().items():
        (FOLDER / file).write_text(text, encoding="utf-8")
    for name in names or kept_names():
        draw(kept(name).result, FOLDER / f"{name}.svg")
    print(f"wrote {FOLDER}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
