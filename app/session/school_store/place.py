"""Where the school's store is: `ACUS_STORE`, or what this station was connected to."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Final

from app.core.files import write_atomically
from app.core.messages import sentence
from app.session.people import People, people_folder
from app.session.school_store.errors import StoreError
from app.session.school_store.objects import Objects
from app.session.school_store.store import SchoolStore

FILE: Final = "store.json"
VARIABLE: Final = "ACUS_STORE"


@dataclass(frozen=True, slots=True)
class StorePlace:
    """A school's store, and what this station does there.

    Attributes:
        url: of the database.
        objects: URL of the place of the packets' files; empty: in the database.
        options: of that place's file system.
        gives_course: whether this station's people and courses go there.
        pins: with the hashes of their PINs.
        names: with their names.
        seconds: that an answer may take.
    """

    url: str
    objects: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)
    gives_course: bool = False
    pins: bool = False
    names: bool = False
    seconds: float = 10.0

    def store(self) -> SchoolStore:
        """Return the store, not yet open.

        Raises:
            StoreError: if the place of the objects is none.
        """
        objects = Objects(self.objects, self.seconds, **self.options) if self.objects else None
        return SchoolStore(self.url, objects, self.seconds)


def require_password(people: People) -> None:
    """Let only a station whose people are guarded share a store.

    Whoever sits at one without a password could erase students of the whole school.

    Raises:
        StoreError: if no password is set.
    """
    if not people.has_instructor():
        raise StoreError(
            sentence(
                "set the instructor's password first (`acus people instructor`): without one "
                "whoever sits here could erase students at all stations"
            )
        )


def place_of_store(folder: Path | None = None) -> StorePlace | None:
    """Return where the store is; None for a station that has none.

    Args:
        folder: of the people.

    Raises:
        StoreError: naming the file, if it cannot be read.
    """
    path = (folder or people_folder()) / FILE
    url = os.environ.get(VARIABLE, "").strip()
    if not path.exists():
        return StorePlace(url) if url else None
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        place = StorePlace(
            url=str(document["url"]),
            objects=str(document.get("objects", "")),
            options=dict(document.get("options", {})),
            gives_course=document.get("gives_course") is True,
            pins=document.get("pins") is True,
            names=document.get("names") is True,
            seconds=min(max(float(document.get("seconds", 10.0)), 1.0), 600.0),
        )
    except (OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise StoreError(
            sentence(
                "{path} does not say where the school's store is: connect this station again with "
                "`acus store connect URL`",
                path=path,
            )
        ) from error
    return StorePlace(**{**asdict(place), "url": url}) if url else place


def put_place(place: StorePlace | None, folder: Path | None = None) -> None:
    """Keep where the store is, for this user only: it may hold a password; None forgets it.

    Raises:
        StoreError: if that cannot be written.
    """
    path = (folder or people_folder()) / FILE
    try:
        if place is None:
            path.unlink(missing_ok=True)
            return
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        write_atomically(path, json.dumps(asdict(place), indent=1) + "\n")
        path.chmod(0o600)
    except OSError as error:
        raise StoreError(
            sentence("cannot write {path}: {reason}", path=path, reason=error.strerror or error)
        ) from error
