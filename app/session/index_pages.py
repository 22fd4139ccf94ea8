"""Pages of the index: attempts of which each was found in order, a few hundred under one seal.

A page is a copy of rows as columns, made after the seal of each of its rows was looked at. Whoever
reads it looks at one seal only. A row that is written anew dissolves the page that it was in.
"""

from __future__ import annotations

import hmac
import json
import secrets
from base64 import b64decode, b64encode
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from app.session.admission import Admission, with_admission
from app.session.indexed import HAS_ERROR, Attempts, Coded, Texts, split
from app.session.sealed_rows import SEALED, Row
from app.session.signature import Signed, vouched_for
from app.session.station import StationKey

if TYPE_CHECKING:
    from sqlalchemy import Connection

PAGE: Final = 256
"""Rows of a page."""

_TEXTS: Final = ("id", "started", "record")
_CODED: Final = ("student", "exercise", "state", "verdict", "task", "station")
_WHOLE: Final = ("inode", "signed_inode", "version", "passed", "counts", "has_error")
_REAL: Final = ("duration", "total", "dial")
_PLACES: Final = [SEALED.index(name) for name in _TEXTS]
_BETWEEN: Final = "\0"
"""Stands between texts; a row with one in it is in no page."""


@dataclass(frozen=True)
class IndexPage:
    """Some rows as columns.

    Attributes:
        texts: columns of texts, by name.
        coded: columns of texts of which many are the same.
        numbers: columns of numbers; `passed` is -1 and reals are NaN where nothing is known.
    """

    texts: Mapping[str, list[str]]
    coded: Mapping[str, Coded]
    numbers: Mapping[str, NDArray[Any]]

    def __len__(self) -> int:
        return len(self.texts["id"])

    @classmethod
    def of(cls, rows: Sequence[Row]) -> IndexPage:
        """Return rows, in the order of `SEALED`, as columns."""
        columns = {name: [row[k] for row in rows] for k, name in enumerate(SEALED)}
        parts = [split(under) for under in columns["under"]]
        columns["task"] = [task for task, _ in parts]
        columns["dial"] = [dial for _, dial in parts]
        columns["has_error"] = [HAS_ERROR in text for text in columns["document"]]
        columns["passed"] = [-1 if one is None else one for one in columns["passed"]]
        columns["total"] = [np.nan if one is None else one for one in columns["total"]]
        return cls(
            {name: [str(text) for text in columns[name]] for name in _TEXTS},
            {name: Coded.of(columns[name]) for name in _CODED},
            {name: np.array(columns[name], np.int64) for name in _WHOLE}
            | {name: np.array(columns[name], np.float64) for name in _REAL},
        )

    def text(self) -> str:
        """Return it as JSON, arrays as base64 of little-endian bytes of 8 each."""
        coded = {name: (one.texts, _packed(one.codes)) for name, one in self.coded.items()}
        texts = {name: _BETWEEN.join(some) for name, some in self.texts.items()}
        numbers = {name: _packed(some) for name, some in self.numbers.items()}
        return json.dumps([texts, coded, numbers], ensure_ascii=False)

    @classmethod
    def read(cls, text: str) -> IndexPage:
        """Read what `text` gave."""
        texts, coded, numbers = json.loads(text)
        return cls(
            {name: some.split(_BETWEEN) for name, some in texts.items()},
            {name: Coded(tuple(known), _array(k, "<i8")) for name, (known, k) in coded.items()},
            {name: _array(k, "<f8" if name in _REAL else "<i8") for name, k in numbers.items()},
        )


def _packed(values: NDArray[Any]) -> str:
    kind = "<f8" if values.dtype.kind == "f" else "<i8"
    return b64encode(values.astype(kind).tobytes()).decode("ascii")


def _array(text: str, kind: str) -> NDArray[Any]:
    return np.frombuffer(b64decode(text), kind)


@dataclass
class IndexPages:
    """The pages of an index, read once and kept as long as they stand.

    Attributes:
        key: of this station.
        sound: pages that this station has sealed, by number.
        broken: numbers of those that this station has not sealed.
    """

    key: StationKey | None
    sound: dict[int, IndexPage] = field(default_factory=dict)
    broken: list[int] = field(default_factory=list)
    _seals: dict[int, str] = field(default_factory=dict)
    _where: dict[str, int] = field(default_factory=dict)

    def look(self, connection: Connection) -> None:
        """Read the pages that came, and forget those that went."""
        numbered = "SELECT number, seal FROM pages WHERE typeof(number) = 'integer'"
        there = {int(n): str(seal) for n, seal in _all(connection, numbered)}
        self.sound = {n: one for n, one in self.sound.items() if self._seals[n] == there.get(n)}
        self.broken, self._where = [], {}
        missing = [number for number in there if number not in self.sound]
        for begin in range(0, len(missing), PAGE):
            some = ",".join(map(str, missing[begin : begin + PAGE]))
            wanted = f"SELECT number, body FROM pages WHERE number IN ({some})"
            for number, body in _all(connection, wanted):
                seal = there[number]
                if hmac.compare_digest(seal.encode(), self._seal(number, str(body)).encode()):
                    self.sound[number] = IndexPage.read(str(body))
                else:
                    self.broken.append(number)
        self._seals = there

    def numbers_of(self, ids: Sequence[str]) -> list[int]:
        """Return the numbers of the pages that were read and hold one of some attempts."""
        if not self._where:
            pages = self.sound.items()
            self._where = {one: number for number, page in pages for one in page.texts["id"]}
        return sorted({self._where[one] for one in ids if one in self._where})

    def let_go(self, ids: Sequence[str]) -> list[str]:
        """Believe no page in which one of some attempts stands that is in none; return its ids."""
        numbers = self.numbers_of(ids) if ids else []
        gone = [self.sound.pop(number) for number in numbers]
        self.broken += numbers
        self._where = {} if gone else self._where
        return [one for page in gone for one in page.texts["id"]]

    def put(self, connection: Connection, rows: Sequence[Row]) -> int:
        """Make whole pages of rows whose seals hold, oldest first; return how many that are."""
        rows = [row for row in rows if not any(_BETWEEN in str(row[k]) for k in _PLACES)]
        whole = len(rows) // PAGE * PAGE
        for begin in range(0, whole, PAGE):
            some = rows[begin : begin + PAGE]
            number, body = secrets.randbits(62), IndexPage.of(some).text()
            into = "INSERT INTO pages (number, body, seal) VALUES (?, ?, ?)"
            connection.exec_driver_sql(into, (number, body, self._seal(number, body)))
            ids = [(number, row[0]) for row in some]
            connection.exec_driver_sql("UPDATE seals SET page = ? WHERE id = ?", ids)
        return whole

    def _seal(self, number: int, body: str) -> str:
        if self.key is None:
            return ""
        whole = f"{number}:{body}".encode("utf-8", "surrogatepass")
        return hmac.digest(self.key.derived("page of the index"), whole, "sha256").hex()


def dissolve(connection: Connection, ids: Sequence[str], numbers: Sequence[int] = ()) -> None:
    """Let pages go: those that rows stand in, and some by number; None stay without ids."""
    marks = ",".join("?" * len(ids))
    held = f"SELECT page FROM seals WHERE id IN ({marks}) AND typeof(page) = 'integer'"
    found = {int(row[0]) for row in _all(connection, held, tuple(ids))} | set(numbers)
    for number in found:
        connection.exec_driver_sql("UPDATE seals SET page = NULL WHERE page = ?", (number,))
        connection.exec_driver_sql("DELETE FROM pages WHERE number = ?", (number,))


def attempts_of(
    pages: Sequence[IndexPage], texts: Texts, seals: bool, admitted: Mapping[str, Admission]
) -> Attempts:
    """Return the attempts of pages, oldest first, with what this station says of them now.

    Args:
        pages: in any order; one of loose rows may be among them.
        texts: gives `under` and `document` by the place in the order that is returned.
        seals: whether what is unsigned counts no more.
        admitted: by the instructor, by attempt.
    """
    pages = sorted(filter(len, pages), key=lambda page: page.texts["started"][0])
    ids, started = _texts(pages, "id"), _texts(pages, "started")
    keys = list(zip(started, ids, strict=True))
    order = np.array(sorted(range(len(ids)), key=keys.__getitem__), np.int64)
    coded = {name: Coded.joined([page.coded[name] for page in pages]) for name in _CODED[:-1]}
    verdict = coded["verdict"]
    if admitted:
        verdict = _with_admissions(verdict, ids, _texts(pages, "record"), admitted)
    good = [vouched_for(one) if seals else one != Signed.ALTERED for one in verdict.texts]
    stands = np.array([*good, False])[verdict.codes]
    numbers = {name: _joined(pages, name) for name in (*_WHOLE[2:], *_REAL)}
    whole = Attempts(
        ids=tuple(ids),
        started=tuple(started),
        **coded | {"verdict": verdict},
        version=numbers["version"],
        duration=numbers["duration"],
        total=numbers["total"],
        passed=np.where(stands, numbers["passed"], -1),
        counts=(numbers["counts"] != 0) & stands,
        stands=stands,
        has_error=numbers["has_error"] != 0,
        dial=numbers["dial"].reshape(-1, 4),
        texts=texts,
        places=np.arange(len(ids)),
    )
    return replace(whole.taken(order), places=np.arange(len(ids)))


def _with_admissions(
    verdict: Coded, ids: list[str], records: list[str], admitted: Mapping[str, Admission]
) -> Coded:
    """Return verdicts with what the instructor has admitted."""
    known, codes = {text: code for code, text in enumerate(verdict.texts)}, verdict.codes.copy()
    places = {name: k for k, name in enumerate(ids) if name in admitted}
    for name, k in places.items():
        said = with_admission(verdict[k], records[k], admitted[name])
        codes[k] = known.setdefault(said, len(known))
    return Coded(tuple(known), codes)


def _texts(pages: Sequence[IndexPage], name: str) -> list[str]:
    return list(chain.from_iterable(page.texts[name] for page in pages))


def _joined(pages: Sequence[IndexPage], name: str) -> NDArray[Any]:
    parts = [page.numbers[name].reshape(-1) for page in pages]
    return (
        np.concatenate(parts) if parts else np.empty(0, np.float64 if name in _REAL else np.int64)
    )


def _all(connection: Connection, text: str, values: tuple[Any, ...] = ()) -> Iterator[Any]:
    return iter(connection.exec_driver_sql(text, values).fetchall())
