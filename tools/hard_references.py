"""Write the references of the hard cases: `python -m tools.hard_references`; --check compares."""

from __future__ import annotations

import argparse
import json
import sys
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from app.core.plugin_folders import APP
from app.studies.hard_cases.case import REFERENCES
from tools import exact
from tools.exact import ENTRIES, computed

PARTS = [import_module(f"{exact.__name__}.{found.name}") for found in iter_modules(exact.__path__)]
"""Modules that enter references, by lying in the folder; `FOLDER` names whose cases they are of."""

FOLDERS = {part.__name__: getattr(part, "FOLDER", "app/studies/hard_cases") for part in PARTS}
"""Module -> folder of the cases, from the root of the project."""


def files() -> dict[Path, str]:
    """Return every file of references with its text as it should be."""
    documents: dict[str, dict[str, Any]] = {folder: {} for folder in FOLDERS.values()}
    for name in sorted(ENTRIES):
        documents[FOLDERS[ENTRIES[name][2].__module__]][name] = computed(name)
    return {
        APP.parent / folder / REFERENCES: json.dumps(document, indent=1, ensure_ascii=False) + "\n"
        for folder, document in documents.items()
    }


def main() -> int:
    """Write the files, or return 3 where one is not what would be written."""
    parser = argparse.ArgumentParser(prog="python -m tools.hard_references", description=__doc__)
    parser.add_argument("--check", action="store_true", help="code 3 where a file is stale")
    if parser.parse_args().check:
        kept = all(file.read_text(encoding="utf-8") == text for file, text in files().items())
        return 0 if kept else 3
    for file, text in files().items():
        file.write_text(text, encoding="utf-8")
        print(f"wrote references to {file}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
