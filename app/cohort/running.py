"""Parts of the work: which are done, what does the others, and the table of all.

A part is done by `do`, which is called on the worker with plain values and answers with plain
values. The file of a finished part is named by the digest of what `do` is given and of the versions
under which it works, so that a run that was broken off goes on where it was, and a table that grows
takes what is there.
"""

from __future__ import annotations

import hashlib
import json
import platform
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Final, Protocol, Self

from app.cohort.cost import AttemptCost, Spent
from app.cohort.errors import CohortError
from app.cohort.table import EXTRA, Columns, Row, join_parts, read_part, write_part
from app.cohort.versions import differences, versions
from app.core.arrow import arrow
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.progress import Progress

FORM: Final = 1
"""Of the parts: it grows when their rows get another meaning."""

Made = tuple[list[Row], float, float]
"""Rows of a part, and what preparing and working took of a processor [s]."""

Do = Callable[[dict[str, Any]], Made]
"""Does a part."""


class Crew(Protocol):
    """Does parts, in any order. It is opened by `with` only where there is something to do."""

    @property
    def workers(self) -> int:
        """Return how many processes work."""

    def __enter__(self) -> Self:
        """Begin."""

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Let everybody go."""

    def results(
        self, todo: Sequence[tuple[Do, dict[str, Any]]], progress: Progress
    ) -> Iterator[tuple[int, Made]]:
        """Do the parts; yield the place of each in the list, and what it made, as they are done.

        Raises:
            CohortError: if the crew cannot go on.
            Cancelled: if `progress` was cancelled.
        """


@dataclass(frozen=True, slots=True)
class WorkPart:
    """One piece of work.

    Attributes:
        do: does it; a function of a module, which workers import by its name.
        given: to `do`: values that JSON holds.
        rows: how many it makes.
    """

    do: Do
    given: dict[str, Any]
    rows: int

    @property
    def digest(self) -> str:
        """Digest of all that decides about the rows, and the order of what they are summed from."""
        name = f"{self.do.__module__}.{self.do.__qualname__}"
        text = json.dumps([FORM, name, dict(versions()), self.given])
        return hashlib.sha256(text.encode()).hexdigest()[:32]


@dataclass(frozen=True, slots=True)
class RunOutcome:
    """What a run came to.

    Attributes:
        out: table that was written.
        rows: in it.
        parts: of it.
        done_before: parts that were there.
        cost: by all parts.
        seconds: that the run took by the clock.
        workers: processes that worked.
    """

    out: Path
    rows: int
    parts: int
    done_before: int
    cost: AttemptCost
    seconds: float
    workers: int


def call(do: Do, given: dict[str, Any], expected: dict[str, str]) -> Made:
    """Do a part on a worker that has the versions that are expected.

    Raises:
        CohortError: if it has others; names them.
    """
    if other := differences(expected):
        raise CohortError(
            sentence(
                "the worker {worker} has another Acus than this computer wants: {differences}",
                worker=platform.node(),
                differences=", ".join(one.replace(", here", " wanted, there") for one in other),
            )
        )
    return do(given)


def run(
    parts: Sequence[WorkPart],
    columns: Columns,
    out: Path,
    crew: Crew,
    progress: Progress | None = None,
) -> RunOutcome:
    """Do the parts that are not there yet, and write the table of all.

    What is done stays done, whatever ends the rest: `OUT.parts` holds it.

    Raises:
        CohortError: if the table cannot be written, or the crew cannot go on.
        AcusError: what a part raises.
        Cancelled: if `progress` was cancelled.
    """
    arrow(CohortError, EXTRA)
    progress, begin = progress or Progress(), time.monotonic()
    if out.suffix != ".parquet":
        raise CohortError(sentence("--out {out}: only .parquet can be written", out=out))
    folder = out.with_name(f"{out.name}.parts")
    _make(folder)
    files = [folder / f"{part.digest}.parquet" for part in parts]
    spent = {
        number: cost
        for number, (part, file) in enumerate(zip(parts, files, strict=True))
        if (cost := read_part(file, columns, part.rows))
    }
    before, rows = len(spent), sum(part.rows for part in parts)
    done = sum(parts[number].rows for number in spent)
    missing = [number for number in range(len(parts)) if number not in spent]

    try:  # for who looks while it grows
        write_atomically(folder / "run.json", json.dumps({"rows": rows, "parts": len(parts)}))
    except OSError as error:
        raise _unwritable(folder, error) from error

    def tell() -> None:
        text = sentence("{done} of {rows} attempts", done=done, rows=rows)
        progress.report(done / max(rows, 1), text)

    tell()
    if missing:
        todo = [(parts[number].do, parts[number].given) for number in missing]
        with crew:
            for place, (made, preparing, working) in crew.results(todo, progress):
                number = missing[place]
                spent[number] = Spent(len(made), preparing, working)
                try:
                    write_part(files[number], columns, made, spent[number])
                except OSError as error:
                    raise _unwritable(folder, error) from error
                done += parts[number].rows
                tell()
    join_parts(files, columns, out)
    whole = AttemptCost.of([spent[number] for number in range(len(parts))])
    seconds = time.monotonic() - begin
    return RunOutcome(out, rows, len(parts), before, whole, seconds, crew.workers)


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _unwritable(folder, error) from error


def _unwritable(folder: Path, error: OSError) -> CohortError:
    return CohortError(
        sentence(
            "{folder} cannot be written: {reason}; what is done stays there",
            folder=folder,
            reason=error.strerror or error,
        )
    )
