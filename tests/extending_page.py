"""The page 'How to extend Acus': its sections, and the files that it says to save."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[1] / "docs" / "extending.md"


def sections() -> dict[str, str]:
    """Return the text below each heading 'How to ...'."""
    parts = re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    return dict(part.split("\n", 1) for part in parts if part.startswith("How to"))


def example(heading: str) -> tuple[str, str]:
    """Return name and content of the first file that a section says to save."""
    name, code = next(iter(files(sections()[heading]).items()))
    return name.rpartition("/")[2], code


def files(section: str) -> dict[str, str]:
    """Return the files that a section says to save: their paths, and what is in them."""
    said = re.finditer(
        r"[Ss]ave this\s+as\s+`([\w./-]+)`.*?```(?:python|yaml|xml)\n(.*?)```", section, re.DOTALL
    )
    return {one[1]: one[2] for one in said}


def folders_section() -> str:
    """Return what the page says of folders of plug-ins."""
    return PAGE.read_text(encoding="utf-8").split("\n## Folders of plug-ins")[1].split("\n## ")[0]
