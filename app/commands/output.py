"""The door through which everything is printed: other people's words cannot steer the terminal.

Names of patients, pupils, files and peers come from elsewhere. A control character among them
could move the cursor, hide a line or set the window's title (ECMA-48), and a bidirectional override
lets a line read otherwise than it stands (UAX #9).
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, TextIO

if TYPE_CHECKING:
    from rich.console import Console

_STEERING: Final = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]"
)


def printable(text: str) -> str:
    r"""Return the text with each character that steers a terminal as ``\u001b``; lines stay."""
    return _STEERING.sub(lambda match: f"\\u{ord(match[0]):04x}", text)


class PrintableStream:
    """A stream of text that writes what is `printable`; all else is the stream's own.

    Args:
        stream: to write to.
    """

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def write(self, text: str) -> int:
        """Write the text; return how many characters of it were written."""
        self.stream.write(printable(text))
        return len(text)

    def writelines(self, lines: Any) -> None:
        """Write several texts."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        """Return what the stream has."""
        return getattr(self.stream, name)


@contextmanager
def printable_output() -> Iterator[None]:
    """Let standard output and standard error write what is printable, and nothing else.

    What is written to one that is closed goes nowhere.
    """
    before = sys.stdout, sys.stderr
    with open(os.devnull, "w") as nowhere:  # Python gives None for a stream that is closed
        sys.stdout = PrintableStream(before[0] or nowhere)
        sys.stderr = PrintableStream(before[1] or nowhere)
        try:
            yield
        finally:
            sys.stdout, sys.stderr = before


def console(**options: Any) -> Console:
    """Return a console for tables and bars: it sets colours itself, and its texts are printable."""
    from rich.console import Console
    from rich.segment import Segment

    class Printable(Console):
        def render(self, *what: Any, **how: Any) -> Iterable[Segment]:
            for piece in super().render(*what, **how):
                yield piece if piece.control else Segment(printable(piece.text), piece.style)

    stream = sys.stderr if options.pop("stderr", False) else sys.stdout
    return Printable(file=getattr(stream, "stream", stream), **options)
