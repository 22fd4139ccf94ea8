"""What the index asks of a folder of records: which there are, their marks, and their rows."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from itertools import repeat
from pathlib import Path
from typing import Any, Final

from app.core.json_values import finite
from app.scoring.conditions import DeviceKind
from app.session.sidecar import Cached
from app.session.signature import judged, signature_file
from app.session.station import StationKey
from app.session.store import SUFFIX, unreadable_folder
from app.session.summary import UNFINISHED

Mark = tuple[int, int, int, int, int, str]
"""Size and time of a record, time of its signature, the inodes of both, and the station whose key
judged that, with the stations that it knew."""

Listing = dict[str, tuple[int, int]]
"""Records of a folder: inode of each, and that of its signature, 0 without one."""

_INODE: Final = (1 << 63) - 1
"""Of an inode's number so much fits into a column."""

_STILL_WRITTEN: Final = 10.0
"""An unfinished record that changed within this time [s] is under way and comes in later."""


def listing(folder: Path) -> Listing:
    """Return the records that a folder holds now, by name.

    Raises:
        SessionError: if the folder cannot be read.
    """
    found: dict[str, int] = {}
    signed: dict[str, int] = {}
    end, beside = SUFFIX[1:], signature_file(Path("a")).suffix[1:]
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                name, dot, kind = entry.name.rpartition(".")
                if kind == end and dot:
                    if entry.is_file():
                        found[name] = entry.inode() & _INODE
                elif kind == beside and dot:
                    signed[name] = entry.inode() & _INODE
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise unreadable_folder(folder, error) from error
    beside_of = map(signed.get, found, repeat(0))
    return dict(zip(found, zip(found.values(), beside_of, strict=False), strict=False))


def mark_of(folder: Path, name: str, there: Listing, station: str) -> Mark | None:
    """Return the mark of a record now; None where it has gone."""
    path = folder / f"{name}{SUFFIX}"
    inodes = there.get(name)
    try:
        stat = path.stat()
    except OSError:
        return None
    if inodes is None:
        return None
    try:
        signed = signature_file(path).stat().st_mtime_ns if inodes[1] else 0
    except OSError:
        signed = 0
    return (stat.st_size, stat.st_mtime_ns, signed, *inodes, station)


def rows_of(
    folder: Path,
    name: str,
    mark: Mark,
    kept_of: Callable[[Path], Cached],
    key: StationKey | None,
) -> list[dict[str, Any]]:
    """Return the row of a record; none of one that is under way."""
    path = folder / f"{name}{SUFFIX}"
    kept = kept_of(path)
    summary = judged(path, kept, key)
    if summary.state == UNFINISHED and time.time() - mark[1] * 1e-9 < _STILL_WRITTEN:
        return []
    score, known = summary.score or {}, summary.conditions
    total = None if score.get("total") is None else float(score["total"])
    person = known is not None and known.by_person and known.kind is not DeviceKind.EMULATED
    person = person and not (known is not None and known.drill)
    return [
        {
            "id": name,
            "size": mark[0],
            "modified_ns": mark[1],
            "signed_ns": mark[2],
            "inode": mark[3],
            "signed_inode": mark[4],
            "station": mark[5],
            "started": summary.started,
            "student": summary.student,
            "exercise": summary.exercise_id,
            "version": known.version if known is not None else 0,
            "state": summary.state,
            "duration": float(summary.duration),
            "total": total,
            "passed": score.get("passed") if total is not None else None,
            "verdict": summary.signature,
            "counts": person and total is not None and not score.get("void_reason"),
            "under": "" if known is None else json.dumps(finite(known.document()), sort_keys=True),
            "document": json.dumps(summary.document(), sort_keys=True, ensure_ascii=False),
            "record": kept.sha256,
        }
    ]
