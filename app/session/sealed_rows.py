"""Rows of the index: their tables, and the seal that stands over each of them."""

from __future__ import annotations

import hmac
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from app.session.database import number, words
from app.session.station import StationKey

if TYPE_CHECKING:
    from sqlalchemy import Table

SEALED: Final = (
    *("id", "size", "modified_ns", "signed_ns", "inode", "signed_inode", "station"),
    *("started", "student", "exercise"),
    *("version", "state", "duration", "total", "passed", "verdict", "counts", "under", "document"),
    "record",
)
"""What the seal of a row is over, in this order."""


STARTED = SEALED.index("started")
UNDER = SEALED.index("under")
MARK = slice(1, STARTED)
"""Where the mark of a record stands: what tells whether it has changed."""

Row = tuple[Any, ...]
"""Values in the order of `SEALED`; a seal may follow."""


class Sealer:
    """Makes the seals of rows: nobody without the station's key can, nor move one elsewhere."""

    def __init__(self, key: StationKey | None) -> None:
        self._key = None if key is None else key.derived("row of the index")

    def __call__(self, row: Row) -> str:
        """Return the seal of a row, hexadecimal; empty without a key."""
        if self._key is None:
            return ""
        texts = [f"{len(text)}:{text}" for text in map(str, row)]
        whole = "".join(texts).encode("utf-8", "surrogatepass")
        return hmac.digest(self._key, whole, "sha256").hex()


@cache
def attempts_table() -> Table:
    """Return the table of attempts."""
    from sqlalchemy import BigInteger, Boolean, Column, MetaData, Table, Text

    known = MetaData()
    Table(
        "seals",
        known,
        Column("id", words(), primary_key=True),
        Column("record", words(), nullable=False),
        Column("seal", words(), nullable=False),
        Column("page", BigInteger, index=True),
    )
    Table(
        "pages",
        known,
        Column("number", BigInteger, primary_key=True, autoincrement=False),
        Column("seal", Text, nullable=False),
        Column("body", Text, nullable=False),  # at last: seals are read without it
    )
    return Table(
        "attempts",
        known,
        Column("id", words(), primary_key=True),
        Column("size", number(whole=True), nullable=False),
        Column("modified_ns", number(whole=True), nullable=False),
        Column("signed_ns", number(whole=True), nullable=False),
        Column("inode", number(whole=True), nullable=False),
        Column("signed_inode", number(whole=True), nullable=False),
        Column("station", words(), nullable=False),
        Column("started", words(), nullable=False, index=True),
        Column("student", words(), nullable=False, index=True),
        Column("exercise", words(), nullable=False),
        Column("version", number(whole=True), nullable=False),
        Column("state", words(), nullable=False, index=True),
        Column("duration", number(whole=False), nullable=False),
        Column("total", number(whole=False)),
        Column("passed", Boolean),
        Column("verdict", words(), nullable=False),
        Column("counts", Boolean, nullable=False),
        Column("under", words(), nullable=False),
        Column("document", words(), nullable=False),
    )


@cache
def seals_table() -> Table:
    """Return the table of their seals."""
    return attempts_table().metadata.tables["seals"]
