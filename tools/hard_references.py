"""Write the references of the hard cases: `python -m tools.hard_references`; --check compares."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from app.studies.hard_cases.case import REFERENCES
from tools.exact import (
    ENTRIES,
    computed,
    contact,
    control,
    motion,
    optics,
    pictures,
    robot,
    space,
    tensegrity,
)

PARTS = (contact, control, motion, optics, pictures, robot, space, tensegrity)
"""Modules that enter references."""


def document() -> dict[str, Any]:
    """Return the whole file as it should be."""
    return {name: computed(name) for name in sorted(ENTRIES)}


def text() -> str:
    """Return the file's text."""
    return json.dumps(document(), indent=1, ensure_ascii=False) + "\n"


def main() -> int:
    """Write the file, or return 3 where it is not what would be written."""
    parser = argparse.ArgumentParser(prog="python -m tools.hard_references", description=__doc__)
    parser.add_argument("--check", action="store_true", help="code 3 where the file is stale")
    if parser.parse_args().check:
        return 0 if REFERENCES.read_text(encoding="utf-8") == text() else 3
    REFERENCES.write_text(text(), encoding="utf-8")
    print(f"wrote {len(ENTRIES)} references to {REFERENCES}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
