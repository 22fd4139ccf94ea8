"""One station as a program of its own: told what to do by a line, killed at any moment.

Each question is `record KEY`, `say TEXT`, `void`, `erase NAME`, `sync`, `sync trust`, `settle`
or `stored`; each answer is a mapping.
"""

import hashlib
import json
import os
import time
from multiprocessing.connection import Connection
from pathlib import Path

import cryptography.hazmat.primitives.asymmetric.ed25519  # noqa: F401 - read once, for all copies
import psycopg  # noqa: F401
import sqlalchemy.dialects.postgresql
import sqlalchemy.dialects.sqlite  # noqa: F401

from app.core.errors import AcusError
from app.session.erasing import erase_person
from app.session.people import People
from app.session.school_store import StorePlace, synchronise
from app.session.sidecar import fresh_kept, write_summary
from app.session.signature import _document, signature_file, signature_text
from app.session.station import StationKey
from app.session.stations import set_name
from app.session.store import settled


def serve(
    root: Path, pool: Path, url: str, offset: float, seconds: float, line: Connection
) -> None:
    """Answer what is asked until nobody asks any more.

    Args:
        root: of the station.
        pool: with records that were made once.
        url: of the store.
        offset: by which its clock is off [s].
        seconds: to wait for the store.
        line: to whom asks.
    """
    os.environ["ACUS_DATA"] = str(root / "data")
    real = time.time
    time.time = lambda: real() + offset
    station = Station(root, pool, url, seconds)
    while True:
        try:
            what, *arguments = line.recv().split()
        except EOFError:
            return
        try:
            answer = getattr(station, what)(*arguments)
        except AcusError as error:
            answer = {"error": str(error)}
        line.send(answer)


class Station:
    def __init__(self, root: Path, pool: Path, url: str, seconds: float) -> None:
        self.name, self.folder = root.name, root / "records"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.people, self.key = People(), StationKey.of()
        if not self.people.setting("station name"):
            set_name(self.name)
        made = json.loads((pool / "records.json").read_text())
        self.pool = {key: [Path(name) for name in some] for key, some in made.items()}
        self.place = StorePlace(url, gives_course=self.name == "head", pins=True, seconds=seconds)
        self.summaries: dict[Path, object] = {}

    def record(self, student: str) -> dict[str, object]:
        """Leave a finished, signed attempt, whole or not at all."""
        number = len(list(self.folder.glob("*.mcap")))
        source = self.pool[student][number % 3]
        path = self.folder / f"{self.name}-{number:05d}-{os.urandom(3).hex()}.mcap"
        data = source.read_bytes()
        if source not in self.summaries:
            self.summaries[source] = fresh_kept(source).summary
        summary = self.summaries[source]
        part = path.with_suffix(".part")
        part.write_bytes(data)
        digest = hashlib.sha256(data).hexdigest()
        document = _document(path, digest, summary, {}, self.key.station)
        signature_file(path).write_text(signature_text(document, self.key))
        part.rename(path)
        write_summary(path, summary)
        return {"attempt": path.stem, "student": student}

    def say(self, text: str) -> dict[str, object]:
        """Comment on the attempt in the middle, whoever made it."""
        some = sorted(path.stem for path in self.folder.glob("*.mcap"))
        if some:
            self.people.remark(some[len(some) // 2], comment=text)
        return {"of": len(some)}

    def void(self) -> dict[str, object]:
        """Declare the first attempt void."""
        some = sorted(path.stem for path in self.folder.glob("*.mcap"))
        if some:
            self.people.remark(some[0], void="the door slammed")
        return {"of": len(some)}

    def erase(self, name: str) -> dict[str, object]:
        done = erase_person(name, self.folder, delete_records=True, people=self.people)
        return {"deleted": done.deleted}

    def sync(self, trust: str = "") -> dict[str, object]:
        begun = time.monotonic()
        done = synchronise(self.place, self.folder, self.people, trust=bool(trust))
        return {
            "sent": done.sent,
            "came": done.gathered.attempts,
            "refused": done.refused,
            "different": done.gathered.different,
            "unknown": len(done.unknown),
            "seconds": time.monotonic() - begun,
        }

    def settle(self) -> dict[str, object]:
        """End what a kill has cut off, as the next look at the folder does."""
        settled(self.folder)
        return {"people": len(self.people.everybody())}

    def stored(self) -> dict[str, object]:
        """Return what all stations must agree on."""
        records = {
            path.stem: hashlib.sha256(path.read_bytes()).hexdigest()
            for path in self.folder.glob("*.mcap")
        }
        said = self.people.remarks()
        marks = {
            f"{name} {what}": str(getattr(one, what))
            for name, one in said.items()
            for what in ("comment", "void", "released")
            if getattr(one, what)
        }
        return {
            "attempts": records,
            "said": marks,
            "excess": sorted(name for name, one in said.items() if one.excess),
            "people": sorted(one.key for one in self.people.everybody()),
        }
