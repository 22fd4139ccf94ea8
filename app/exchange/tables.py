"""Rows of values as text that every spreadsheet reads (RFC 4180)."""

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np

_FORMULA: Final = ("=", "+", "-", "@", "\t", "\r", "\n")


def table_text(lines: Iterable[Sequence[object]]) -> str:
    """Write rows of values."""
    stream = io.StringIO(newline="")
    rows = ([cell(value) for value in line] for line in lines)
    csv.writer(stream, lineterminator="\r\n").writerows(rows)
    return stream.getvalue()


def cell(value: object) -> str:
    """Text of a cell; what a spreadsheet would run as a formula begins with an apostrophe."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:.9g}" if np.isfinite(value) else ""
    if isinstance(value, int):
        return str(value)
    text = str(value)
    return f"'{text}" if text.startswith(_FORMULA) else text
