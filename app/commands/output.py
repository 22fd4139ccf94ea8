"""The door through which everything is printed: other people's words cannot steer the terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TextIO

from app.core.words import printable

if TYPE_CHECKING:
    from rich.console import Console


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
