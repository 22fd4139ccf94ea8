"""The page 'How to extend Acus': its sections, and the files that it says to save."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[1] / "docs" / "extending.md"


def sections() -> dict[str, str]:
    """Return the text below each heading 'How to ...'."""
    parts = re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    return dict(part.split("\n", 1) for part in parts if part.startswith("How to"))


def example(heading: str) -> tuple[str, str]:
    """Return name and content of the file that a section says to save."""
    section = sections()[heading]
    name = re.search(r"Save this as\s+`[\w/]+/([\w.]+)`", section)
    code = re.search(r"```(?:python|yaml)\n(.*?)```", section, re.DOTALL)
    assert name is not None
    assert code is not None
    return name[1], code[1]
