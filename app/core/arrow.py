"""pyarrow, where it is used and where it is installed: columns of tables, Parquet."""

from __future__ import annotations

from typing import Any

from app.core.extras import not_installed


def arrow(family: type[Exception], extra: str) -> Any:
    """Return pyarrow with its readers and writers of CSV and Parquet.

    Args:
        family: of the error where it is not installed.
        extra: that brings it.

    Raises:
        Exception: of the family, if it is not installed; names the extra.
    """
    try:
        import pyarrow.csv
        import pyarrow.parquet
    except ImportError as error:
        raise not_installed(family, "pyarrow", extra) from error
    return pyarrow
