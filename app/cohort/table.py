"""Rows as Parquet: one schema for each kind of table, the same bytes for the same rows.

A part's file also says what it cost, in its metadata, which the table made of the parts leaves out.
"""

from __future__ import annotations

import io
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, TypeAlias

from app.cohort.cost import Spent
from app.cohort.errors import CohortError
from app.core.arrow import arrow
from app.core.disclaimer import DISCLAIMER
from app.core.files import write_atomically
from app.core.messages import sentence

EXTRA: Final = "cohort"

Row: TypeAlias = "dict[str, Any]"
Columns: TypeAlias = "Mapping[str, type]"
"""Name of a column -> str, float, int or bool; each may be empty."""

_SPENT: Final = b"acus_spent"
_NOTE: Final = b"acus_note"
_LARGEST: Final = 1 << 20
"""Rows of a group in the table."""


def write_part(path: Path, columns: Columns, rows: Sequence[Row], spent: Spent) -> None:
    """Write a finished part, whole or not at all."""
    cost = json.dumps([spent.attempts, spent.preparing, spent.working]).encode()
    write_atomically(path, _bytes(_table(columns, rows), {_SPENT: cost}))


def read_part(path: Path, columns: Columns, number: int) -> Spent | None:
    """Return what a finished part cost; None if it is not there, cut off, or not what it should be.

    Args:
        path: of the part.
        columns: that it must have.
        number: of its rows.
    """
    pa = arrow(CohortError, EXTRA)
    try:
        table = pa.parquet.read_table(path, partitioning=None)
        attempts, preparing, working = json.loads((table.schema.metadata or {})[_SPENT])
    except (OSError, KeyError, ValueError, TypeError, pa.ArrowException):
        return None
    if table.num_rows != number or table.schema.remove_metadata() != _schema(columns):
        return None
    return Spent(int(attempts), float(preparing), float(working))


def join_parts(parts: Iterable[Path], columns: Columns, out: Path) -> None:
    """Make the table of its parts, in their order.

    Raises:
        CohortError: if it cannot be written.
    """
    pa = arrow(CohortError, EXTRA)
    tables = [pa.parquet.read_table(part, partitioning=None) for part in parts]
    bare = [table.replace_schema_metadata(None).cast(_schema(columns)) for table in tables]
    whole = pa.concat_tables(bare) if bare else _table(columns, ())
    try:
        write_atomically(out, _bytes(whole.combine_chunks(), {_NOTE: DISCLAIMER.encode()}))
    except OSError as error:
        raise CohortError(
            sentence("{file} cannot be written: {reason}", file=out, reason=error.strerror or error)
        ) from error


def _schema(columns: Columns) -> Any:
    pa = arrow(CohortError, EXTRA)
    kinds = {str: pa.string(), float: pa.float64(), int: pa.int64(), bool: pa.bool_()}
    return pa.schema([(name, kinds[kind]) for name, kind in columns.items()])


def _table(columns: Columns, rows: Sequence[Row]) -> Any:
    schema = _schema(columns)
    values = {name: [row.get(name) for row in rows] for name in columns}
    return arrow(CohortError, EXTRA).table(values, schema=schema)


def _bytes(table: Any, metadata: Mapping[bytes, bytes]) -> bytes:
    stream = io.BytesIO()
    arrow(CohortError, EXTRA).parquet.write_table(
        table.replace_schema_metadata(dict(metadata)),
        stream,
        compression="zstd",
        row_group_size=_LARGEST,
    )
    return stream.getvalue()
