"""Tables of the school's store, and their schema brought up to date by Alembic.

Packets stand in the order in which they came. Each has a chain value, the SHA-256 of the one before
it and its own digest: a station that remembers place and chain sees whether the store was put back
to an older state in between. A packet whose student was erased, or that a later one replaces, keeps
its row and loses its data.
"""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.core.extras import not_installed
from app.core.messages import sentence
from app.session.school_store.errors import StoreError

if TYPE_CHECKING:
    from sqlalchemy import Connection, MetaData, Table

HEAD: Final = "0001"
"""The step of the schema that this program knows."""

BEGIN: Final = "0" * 64
"""Chain value before the first packet."""


@cache
def _known() -> MetaData:
    from sqlalchemy import (
        BigInteger,
        Boolean,
        Column,
        Index,
        Integer,
        LargeBinary,
        MetaData,
        String,
        Table,
    )

    known = MetaData()
    number = BigInteger().with_variant(Integer, "sqlite")
    Table(
        "packets",
        known,
        Column("seq", number, primary_key=True, autoincrement=True),
        Column("digest", String(64), nullable=False),
        Column("chain", String(64), nullable=False),
        Column("station", String(16), nullable=False),
        Column("kind", String(16), nullable=False),
        Column("item", String(200), nullable=False),
        Column("student", String(64), nullable=False),
        Column("mark", String(64), nullable=False),
        Column("size", BigInteger, nullable=False),
        Column("gone", Boolean, nullable=False),
        Column("data", LargeBinary, nullable=True),
        Index("packets_of_station", "station", "kind", "item"),
        Index("packets_of_student", "student"),
        sqlite_autoincrement=True,
    )
    return known


def metadata() -> MetaData:
    """Return the tables as this program knows them."""
    return _known()


def packets() -> Table:
    """Return the table of packets."""
    return _known().tables["packets"]


def chained(before: str, digest: str) -> str:
    """Return the chain value of a packet after another one."""
    return hashlib.sha256(f"{before} {digest}".encode()).hexdigest()


def revision_of(connection: Connection) -> str:
    """Return the step of the schema that a store is at; empty for a database without tables.

    Raises:
        StoreError: if `alembic` is not installed.
    """
    try:
        from alembic.runtime.migration import MigrationContext
    except ImportError as error:
        raise not_installed(StoreError, "alembic", "school") from error
    return MigrationContext.configure(connection).get_current_revision() or ""


def upgrade(connection: Connection, name: str, make: bool = True) -> None:
    """Bring the schema up to date, inside the transaction of the connection.

    Args:
        connection: which holds the store alone.
        name: of the store, for messages.
        make: the tables where there are none.

    Raises:
        StoreError: if there are none and none are made, a newer version of Acus made them, or it
            holds tables of another program.
    """
    from alembic.operations import Operations
    from alembic.runtime.migration import MigrationContext
    from alembic.script import ScriptDirectory
    from sqlalchemy import inspect

    here = revision_of(connection)
    script = ScriptDirectory(str(Path(__file__).parent / "migrations"))
    steps = {one.revision for one in script.walk_revisions()}
    if here and here not in steps:
        raise StoreError(
            sentence(
                "the school's store {name} was made by a newer version of Acus (step {here}, this "
                "one knows {known}): use that version here too; this station goes on by itself",
                name=name,
                here=here,
                known=HEAD,
            )
        )
    if not here and (others := sorted(set(inspect(connection).get_table_names()))):
        raise StoreError(
            sentence(
                "{name} holds tables of another program ({table}): give the school's store a "
                "database of its own",
                name=name,
                table=others[0],
            )
        )
    if not here and not make:
        raise StoreError(
            sentence(
                "{name} holds no school's store any more: connect this station again with `acus "
                "store connect URL`",
                name=name,
            )
        )
    context = MigrationContext.configure(connection)
    with Operations.context(context):
        for one in reversed(list(script.iterate_revisions("head", here or "base"))):
            one.module.upgrade()
            context.stamp(script, one.revision)
