"""Words that an attribute may hold because they can be nobody's name; quick to load.

The process that reads headers needs these and no more of the tables of de-identification.
"""

import re
from functools import cache

from app.core import paths

_KERNEL = re.compile(
    r"(?i:STANDARD|STND|SOFT|LUNG|BONE|BONEPLUS|DETAIL|EDGE|ULTRA|CHEST|SMOOTH|SHARP|BRAIN|HEAD)"
    r"|BODY|ABDOMEN|HD|[A-FL]|[USYE][A-D]"
    r"|[A-Z][A-Za-z]?\d{1,3}[a-z]{0,2}|\d"
)


@cache
def body_parts() -> frozenset[str]:
    """Return the words that BodyPartExamined may hold."""
    path = paths.resources() / "dicom" / "body-parts.txt"
    lines = path.read_text(encoding="utf-8").splitlines()
    return frozenset(word for line in lines if not line.startswith("#") for word in line.split())


def is_kernel(text: str) -> bool:
    """Return whether it reads like a reconstruction kernel: a known word, or a letter and a
    number.
    """
    return _KERNEL.fullmatch(text.strip()) is not None
