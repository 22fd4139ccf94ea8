"""Write the tables of `acus study dicom DIR…` into docs/studies.md.

python -m tools.dicom_tables DIR…
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "studies.md"
BEGIN, END = "<!-- dicom: begin -->", "<!-- dicom: end -->"


def main() -> None:
    """Run the study on the folders named and replace what stands between the marks."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "app", "study", "dicom", *sys.argv[1:], "--out", folder]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        document = json.loads(Path(folder, "dicom.json").read_text())
        tables = [_table(Path(folder, f"dicom-{name}.csv")) for name in ("read", "refused")]
    text = "\n\n".join([*tables, *document["lines"]])
    before, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(f"{before}{BEGIN}\n{text}\n{END}{rest.split(END)[1]}")


def _table(path: Path) -> str:
    with path.open(newline="") as file:
        head, *rows = csv.reader(file)
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell or "-" for cell in line) + " |" for line in lines)


if __name__ == "__main__":
    main()
