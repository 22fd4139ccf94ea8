"""Write the table of hard cases for the documentation: `python -m tools.hard_page`."""

from __future__ import annotations

import sys
from pathlib import Path

from app.studies.hard import cases
from app.studies.hard_cases.case import SUBSYSTEMS, HardCase
from tests.hard.defects import defects

PAGE = Path(__file__).resolve().parents[1] / "docs" / "accuracy" / "hard.md"

HEAD = """# Hard cases

Every subsystem has places where its formulas are delicate: needles that stand upright, elbows
that meet, rays that are parallel, rests of ten minutes. Each of them is an entry of one register
(`app/studies/hard_cases`) with a reference, a bound that the program keeps, and what happens one
step beyond it. `acus study hard` tries them all on your computer, with the errors that it finds.
The tests do so too, and compute each case wrongly on purpose (`tests/hard/defects`): the bound must
catch that defect.

References marked *60 digits* are kept beside the register; `tools/exact` computes them with mpmath
from the same doubles. This page is written by `python -m tools.hard_page`; how to add a case stands
in [Extending](../extending.md#how-to-add-a-hard-case).
"""


def text() -> str:
    """Return the page."""
    register = cases()
    parts = [HEAD, f"There are {len(register)} cases in {len(SUBSYSTEMS)} subsystems."]
    for subsystem in SUBSYSTEMS:
        parts.append(f"\n## {subsystem[0].upper()}{subsystem[1:]}\n")
        parts.append(
            "| case | input | reference | bound | one step beyond | defect that must fail |"
        )
        parts.append("|---|---|---|---|---|---|")
        parts += [_row(case) for case in register if case.subsystem == subsystem]
    return "\n".join(parts) + "\n"


def _row(case: HardCase) -> str:
    bound = f"{case.bound:.1g} {case.unit}" if case.bound else f"0 {case.unit}"
    if case.relative:
        bound = f"{case.bound:.1g} of it"
    defect = defects()[case.name].text
    cells = (case.case, case.given, case.reference.how, bound, case.beyond.text, defect)
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def main() -> int:
    """Write the page."""
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(text(), encoding="utf-8")
    print(f"wrote {PAGE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
