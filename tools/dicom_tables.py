"""Write what `acus study dicom DIR…` finds into docs/studies.md: differences and refusals.

python -m tools.dicom_tables DIR…
"""

import csv
import json
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

from app.studies.dicom_cases.comparison import SAME_MM

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "studies.md"
BEGIN, END = "<!-- dicom: begin -->", "<!-- dicom: end -->"


def main() -> None:
    """Run the study on the folders named and replace what stands between the marks."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "app", "study", "dicom", *sys.argv[1:], "--out", folder]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        document = json.loads(Path(folder, "dicom.json").read_text())
        read, refused = (_rows(Path(folder, f"dicom-{name}.csv")) for name in ("read", "refused"))
    explained = _table([[row[0], *row[2:]] for row in counted(read) if row[7]])
    reasons = "; ".join(f"{row[0]} ({row[2]})" for row in refused[1:])
    lines = [f"Refused files and series, by reason: {reasons}.", *document["lines"]]
    text = "\n\n".join([explained, *(textwrap.fill(line, 118) for line in lines)])
    before, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(f"{before}{BEGIN}\n{text}\n{END}{rest.split(END)[1]}")


def counted(rows: list[list[str]]) -> list[list[str]]:
    """Return the rows with those that agree and lie within 0.01 mm counted by folder and kind.

    Rows are `dicom.csv`'s: name, size, verdict, voxels, geometry, two distances [mm], reason.
    """
    groups: dict[tuple[str, ...], list[list[str]]] = {}
    for number, row in enumerate(rows):
        alike = (_folder(row[0]), *row[2:5], row[7]) if _agrees(row) else (str(number),)
        groups.setdefault(alike, []).append(row)
    return [_one_row(key[0], group) for key, group in groups.items()]


def _one_row(folder: str, group: list[list[str]]) -> list[str]:
    first = group[0]
    if len(group) == 1:
        return first
    farthest = (max((row[at] for row in group), key=float) for at in (5, 6))
    return [f"{len(group)} of {folder}", first[1], *first[2:5], *farthest, first[7]]


def _folder(name: str) -> str:
    return name.partition("/")[0] if "/" in name else "pydicom"


def _agrees(row: list[str]) -> bool:
    return row[3].startswith("equal") and row[4] == "equal" and float(row[6]) <= SAME_MM


def _rows(path: Path) -> list[list[str]]:
    with path.open(newline="") as file:
        return list(csv.reader(file))


def _table(rows: list[list[str]]) -> str:
    lines = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    return "\n".join("| " + " | ".join(cell or "-" for cell in line) + " |" for line in lines)


if __name__ == "__main__":
    main()
