"""The tables of a bundle as Parquet: the CSV files with their columns' types, all series in one.

They are made from the CSV files and from nothing else, so that a reader can make them again.
"""

from __future__ import annotations

import gzip
import io
from collections.abc import Mapping
from typing import Any, Final

from app.core.arrow import arrow
from app.research.codebook import SERIES_FILES, TABLES, Column
from app.research.errors import ResearchError

EXTRA: Final = "research"
FOLDER: Final = "parquet/"
SERIES_TABLE: Final = f"{FOLDER}series.parquet"
"""Every series, one after the other; the column `attempt` says whose."""


def parquet_tables(files: Mapping[str, bytes]) -> dict[str, Any]:
    """Return the tables of a bundle as pyarrow tables, by the name of their Parquet file.

    Args:
        files: of the bundle, CSV, by name.

    Raises:
        ResearchError: if pyarrow is not installed.
        pyarrow.ArrowException: if a table is not what the codebook says.
    """
    pa = arrow(ResearchError, EXTRA)
    found = {
        f"{FOLDER}{name.removesuffix('.csv')}.parquet": _read(files[name], columns)
        for name, columns in TABLES.items()
        if name in files
    }
    several = []
    for name in sorted(name for name in files if name.startswith("series/")):
        one = _read(gzip.decompress(files[name]), TABLES[SERIES_FILES])
        code = name.removeprefix("series/").removesuffix(".csv.gz")
        whose = pa.array([code] * one.num_rows, pa.string())
        several.append(one.add_column(0, "attempt", whose))
    if several:
        found[SERIES_TABLE] = pa.concat_tables(several)
    return found


def parquet_files(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the Parquet files of a bundle; arguments and errors as of `parquet_tables`."""
    found = {}
    for name, table in parquet_tables(files).items():
        stream = io.BytesIO()
        arrow(ResearchError, EXTRA).parquet.write_table(table, stream, compression="zstd")
        found[name] = stream.getvalue()
    return found


def differing_tables(files: Mapping[str, bytes], parquet: Mapping[str, bytes]) -> list[str]:
    """Return which Parquet files do not hold what the CSV files do, to the last digit.

    Args:
        files: CSV, by name.
        parquet: Parquet, by name.

    Raises:
        ResearchError: if pyarrow is not installed.
    """
    pa, wrong = arrow(ResearchError, EXTRA), []
    try:
        wanted = parquet_tables(files)
    except (pa.ArrowException, ValueError, OSError, EOFError):
        return sorted(parquet)
    for name in sorted({*parquet, *wanted}):
        try:
            written = pa.parquet.read_table(io.BytesIO(parquet[name]))
        except (pa.ArrowException, KeyError, OSError, ValueError):
            wrong.append(name)
            continue
        if name not in wanted or not written.equals(wanted[name]):
            wrong.append(name)
    return wrong


def _read(data: bytes, columns: tuple[Column, ...]) -> Any:
    pa = arrow(ResearchError, EXTRA)
    kinds = {
        "text": pa.string(),
        "number": pa.float64(),
        "whole": pa.int64(),
        "yes_no": pa.bool_(),
    }
    options = pa.csv.ConvertOptions(
        column_types={one.name: kinds[one.kind] for one in columns},
        null_values=[""],
        true_values=["1"],
        false_values=["0"],
        strings_can_be_null=False,
    )
    return pa.csv.read_csv(io.BytesIO(data), convert_options=options)
