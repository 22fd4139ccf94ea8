"""A recorded attempt computed once more, and compared with its record to the last bit.

The loop starts from the record's checkpoint and is given, tick by tick, what was recorded: inputs,
time and, of a real robot, what its wire read. Everything else is computed: of a simulated robot
also the plant and so the encoders. Compared is every slot of the state, by a digest per tick; the
main outputs by their values in every tick; all by their values twice a second. Not compared is
`TICK_COST`, the time that a tick took; `LATENESS` and `MISSED` are measured too and are given.
It is told where they first differ, and where most. What a record holds for a replay can be told
without computing anything.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.build import BUILD, build, changes
from app.core.errors import AcusError
from app.core.messages import sentence
from app.planning.entry_mark import EntryMark, mark_of
from app.scoring.met import Met
from app.scoring.risks import RiskMark
from app.session.blocks import CABLES, CLOCK, INPUTS, JUDGED, LATER, SLOT_NAMES, UNSTEADY, WIRE
from app.session.control_scan import ControlScan
from app.session.ct_facts import UNKNOWN_CT, CtFacts
from app.session.digest import MEASURED, digests
from app.session.effect_models import ModelChoice, choices_of
from app.session.errors import ReplayError
from app.session.procedure import KIND as PROCEDURE
from app.session.procedure import MARKED
from app.session.recording import Recording
from app.session.risks import event_of, mark_sentence, risk_marks
from app.session.ticks import Inputs
from app.session.tissues import tissues_met

UNSTEADY_SLOTS: Final = ("unsteady_x", "unsteady_y", "unsteady_depth")
"""What a hand adds that is unsteady; nothing in records from before there was one."""

_INDEX = {name: k for k, name in enumerate(SLOT_NAMES) if name}


@dataclass(frozen=True, slots=True)
class Difference:
    """One slot of one tick.

    Attributes:
        tick: first tick whose state differs.
        time: its monotonic time [s].
        slot: name of the slot; empty if the record holds too little to tell which.
        recorded: value in the record.
        recomputed: value now.
        seen_at: tick whose values these are: `tick`, or the next one that is recorded whole.
    """

    tick: int
    time: float
    slot: str
    recorded: float
    recomputed: float
    seen_at: int

    @property
    def size(self) -> float:
        """Magnitude of the difference; inf if one of the two is not a number."""
        size = abs(self.recorded - self.recomputed)
        return size if np.isfinite(size) else float("inf")


class Comparison:
    """Compares piece after piece; values are equal if all their bits are.

    Args:
        inputs: the recorded ticks.
        given: slots that a tick is given, which are not compared by value.

    Attributes:
        first: where they first differ; None if nowhere.
        largest: the largest difference relative to what the slot's values are; None if none.
        every_slot: whether every slot of every tick was compared (by its digest).
    """

    def __init__(self, inputs: Inputs, given: tuple[str, ...]) -> None:
        self.first: Difference | None = None
        self.largest: Difference | None = None
        known = bool(inputs.slots) and set(inputs.slots) <= set(_INDEX)
        self.every_slot = known and len(inputs.digests) == len(inputs.values)
        self._inputs = inputs
        self._tick = inputs.column("tick")
        self._time = inputs.column("time")
        self._columns = [name for name in inputs.columns if name not in given and name in _INDEX]
        self._slots = [name for name in inputs.slots if name in _INDEX and name not in MEASURED]
        self._scales: dict[str, float] = {}
        self._share = 0.0
        self._open: tuple[int, float] | None = None

    def compare(self, first_row: int, states: FloatArray) -> None:
        """Compare recomputed states, shape (n, SLOTS), with the rows from `first_row` on."""
        rows = np.arange(first_row, first_row + len(states))
        found = self._by_value(rows, states) + self._by_state(first_row, states)
        wrong = [d.tick for d in found]
        if self.every_slot:
            bad = np.flatnonzero(digests(states, self._inputs.slots) != self._inputs.digests[rows])
            wrong += [int(self._tick[rows[k]]) for k in bad[:1]]
        for difference in found:
            self._measure(difference)
        if self.first is None and wrong:
            tick = min(wrong)
            time = float(self._time[np.searchsorted(self._tick[: rows[-1] + 1], tick)])
            self.first = Difference(tick, time, "", float("nan"), float("nan"), tick)
        if self.first is not None and not self.first.slot and found:
            seen = min(found, key=lambda d: d.tick)
            self.first = Difference(
                self.first.tick,
                self.first.time,
                seen.slot,
                seen.recorded,
                seen.recomputed,
                seen.tick,
            )

    def _by_value(self, rows: np.ndarray, states: FloatArray) -> list[Difference]:
        """Per column: the first difference and the largest."""
        found = []
        for name in self._columns:
            recorded = self._inputs.column(name)[rows]
            found += self._of(name, rows, recorded, states[:, _INDEX[name]])
        return found

    def _by_state(self, first_row: int, states: FloatArray) -> list[Difference]:
        """Differences in the rows that are recorded whole."""
        inputs = self._inputs
        inside = (inputs.state_rows >= first_row) & (inputs.state_rows < first_row + len(states))
        rows, whole = inputs.state_rows[inside], inputs.states[inside]
        found = []
        for name in self._slots:
            recorded = whole[:, inputs.slots.index(name)]
            found += self._of(name, rows, recorded, states[rows - first_row, _INDEX[name]])
        return found

    def _of(
        self, name: str, rows: np.ndarray, recorded: FloatArray, recomputed: FloatArray
    ) -> list[Difference]:
        a, b = (np.ascontiguousarray(x).view(np.uint64) for x in (recorded, recomputed))
        at = np.flatnonzero(a != b)
        if not len(at):
            return []
        with np.errstate(invalid="ignore"):
            size = np.abs(recorded[at] - recomputed[at])
        most = at[int(np.argmax(np.where(np.isfinite(size), size, np.inf)))]
        return [
            Difference(
                int(self._tick[rows[k]]),
                float(self._time[rows[k]]),
                name,
                float(recorded[k]),
                float(recomputed[k]),
                int(self._tick[rows[k]]),
            )
            for k in dict.fromkeys((int(at[0]), int(most)))
        ]

    def _measure(self, difference: Difference) -> None:
        share = difference.size / self._scale(difference.slot)
        if self.largest is None or share > self._share:
            self._share, self.largest = share, difference

    def _scale(self, name: str) -> float:
        """Largest magnitude of a slot in the record; 1 where it is zero or unknown."""
        if name not in self._scales:
            inputs = self._inputs
            values = (
                inputs.column(name)
                if name in inputs.columns
                else inputs.states[:, inputs.slots.index(name)]
            )
            finite = np.abs(values[np.isfinite(values)])
            self._scales[name] = float(finite.max(initial=0.0)) or 1.0
        return self._scales[name]


@dataclass(frozen=True, slots=True)
class ReplayReport:
    """Result of a replay.

    Attributes:
        session: id of the session.
        ticks: ticks that were recomputed.
        seconds: time that they stand for [s].
        recorded_ticks: ticks in the record; more than `ticks` if some are missing between.
        first_difference: None if every bit is the same.
        largest_difference: relative to the slot's own size; None if there is none.
        every_slot: whether every slot of every tick was compared; otherwise only those recorded.
        changes: what differs between the build that recorded and this one, one line each.
        gaps: (first tick, count) of every stretch of ticks that the record lacks.
    """

    session: str
    ticks: int
    seconds: float
    recorded_ticks: int
    first_difference: Difference | None
    largest_difference: Difference | None
    every_slot: bool
    changes: tuple[str, ...] = ()
    gaps: tuple[tuple[int, int], ...] = ()

    @property
    def same_build(self) -> bool:
        """Return whether the record was made by this very build on this kind of processor."""
        return not self.changes

    @property
    def identical(self) -> bool:
        """Return whether nothing differs."""
        return self.first_difference is None

    def sentences(self) -> list[str]:
        """Say it, one line each."""
        lines = [self._verdict()]
        if not self.every_slot:
            lines.append(sentence("compared were only the slots that the record holds by value"))
        for first, count in self.gaps:
            lines.append(
                sentence(
                    "{count} ticks from tick {first} on are not in the record",
                    count=count,
                    first=first,
                )
            )
        if self.gaps:
            left = self.recorded_ticks - self.ticks
            lines.append(
                sentence(
                    "the replay ends there: {left} recorded ticks were not recomputed", left=left
                )
            )
        lines += [f"another build: {change}" for change in self.changes]
        if self.changes and not self.identical:
            lines.append(
                sentence("with another build, differences in the last digits are expected")
            )
        return lines

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "session": self.session,
            "identical": self.identical,
            "ticks": self.ticks,
            "seconds": self.seconds,
            "recorded_ticks": self.recorded_ticks,
            "every_slot": self.every_slot,
            "first_difference": _document(self.first_difference),
            "largest_difference": _document(self.largest_difference),
            "same_build": self.same_build,
            "build_changes": list(self.changes),
            "gaps": [{"first_tick": first, "ticks": count} for first, count in self.gaps],
        }

    def _verdict(self) -> str:
        if self.first_difference is None:
            return sentence(
                "identical over {ticks} ticks ({seconds:.1f} s)",
                ticks=self.ticks,
                seconds=self.seconds,
            )
        text = sentence(
            "differs from tick {first_difference_tick} on: {difference}",
            first_difference_tick=self.first_difference.tick,
            difference=_words(self.first_difference),
        )
        most = self.largest_difference
        if most is not None and most != self.first_difference:
            text += sentence(
                "; the largest difference is in tick {most_seen_at}: {difference}",
                most_seen_at=most.seen_at,
                difference=_words(most),
            )
        return text


def _words(difference: Difference) -> str:
    d = difference
    if not d.slot:
        return sentence(
            "at {d_time:.4f} s, in a slot that is not recorded in every tick", d_time=d.time
        )
    where = (
        ""
        if d.seen_at == d.tick
        else sentence(" (as seen in tick {d_seen_at})", d_seen_at=d.seen_at)
    )
    size = f", by {d.size:.2g}" if isfinite(d.size) else ""
    return sentence(
        "{d_slot} was {d_recorded!r}, is now {d_recomputed!r}{size}{where}",
        d_slot=d.slot,
        d_recorded=d.recorded,
        d_recomputed=d.recomputed,
        size=size,
        where=where,
    )


def _document(difference: Difference | None) -> dict[str, Any] | None:
    if difference is None:
        return None
    return {
        "tick": difference.tick,
        "time_s": difference.time,
        "slot": difference.slot,
        "recorded": difference.recorded,
        "recomputed": difference.recomputed,
        "seen_at_tick": difference.seen_at,
    }


TableOf = Callable[[Recording], Any]
"""Builds the loop's table (`device.control.Table`) of a recorded attempt: `compose` knows how."""

ChangedTableOf = Callable[[Recording, Any, Sequence[ModelChoice]], tuple[Any, Callable[[], None]]]
"""Builds the table that a replay goes on with once models were chosen, and how memory moves; takes
the running table and all choices made so far, the newest last."""

_CHUNK: Final = 4096


def is_simulated(recording: Recording) -> bool:
    """Return whether the record's robot is simulated, so that its encoders can be recomputed."""
    return recording.metadata.get("device", {}).get("simulated") == "yes"


def given_slots(recording: Recording) -> tuple[str, ...]:
    """Names of what a tick of this record is given; the rest is computed."""
    return (*INPUTS, *CLOCK, *(() if is_simulated(recording) else (*WIRE, *CABLES, *JUDGED)))


def replay(
    recording: Recording, table_of: TableOf, change: ChangedTableOf | None = None
) -> ReplayReport:
    """Recompute an attempt and say where it first differs from its record.

    Args:
        recording: the attempt.
        table_of: builds its table.
        change: builds the table after a choice of models; None replays records without any.

    Raises:
        ReplayError: if the record cannot be replayed; says why.
        AcusError: if the table cannot be built from the record's attachments.
    """
    inputs = recording.inputs
    rows = _replayable(inputs)
    given = given_slots(recording)
    comparison = Comparison(inputs, given)
    for first, states in _states(recording, table_of, change, given, rows):
        comparison.compare(first, states)
    changed = changes(recording.metadata.get(BUILD, {}), build())
    return ReplayReport(
        session=recording.id,
        ticks=rows,
        seconds=float(inputs.column("dt")[:rows].sum()),
        recorded_ticks=len(inputs.values),
        first_difference=comparison.first,
        largest_difference=comparison.largest,
        every_slot=comparison.every_slot,
        changes=changed,
        gaps=inputs.gaps(),
    )


def why_not(inputs: Inputs) -> str:
    """Return why a record cannot be replayed; empty if it can."""
    if inputs.checkpoint is None:
        return sentence("it holds no checkpoint of the loop: its beginning is damaged")
    if not len(inputs.values):
        return sentence("it holds no tick of the loop")
    tick, start = int(inputs.column("tick")[0]), inputs.checkpoint.checkpoint.tick
    if tick != start + 1:
        return sentence(
            "ticks {start} to {tick} are missing at its beginning", start=start + 1, tick=tick - 1
        )
    missing = set(inputs.checkpoint.slots) ^ set(SLOT_NAMES)
    missing -= {SLOT_NAMES[slot] for slot in sv.SUMS + sv.SCENE}  # later ones: nobody wrote them
    missing -= {*LATER, *UNSTEADY, *UNSTEADY_SLOTS}  # nor gave these
    missing -= {SLOT_NAMES[slot] for slot in sv.MACHINE}  # of machines that it was not
    if missing:
        return sentence(
            "its program's state had other slots than this one's: {missing}",
            missing=", ".join(sorted(missing)),
        )
    return ""


def _replayable(inputs: Inputs) -> int:
    """Count the rows up to the first gap, or up to the loop's end (a row without a step)."""
    reason = why_not(inputs)
    if reason:
        raise ReplayError(sentence("this record cannot be replayed: {reason}", reason=reason))
    tick, dt = inputs.column("tick"), inputs.column("dt")
    stops = np.flatnonzero((np.diff(tick, prepend=tick[0] - 1.0) != 1.0) | (dt == 0.0))
    return int(stops[0]) if len(stops) else len(tick)


def _states(
    recording: Recording,
    table_of: TableOf,
    change: ChangedTableOf | None,
    given: tuple[str, ...],
    rows: int,
) -> Iterator[tuple[int, FloatArray]]:
    """Recompute the ticks in pieces: number of the first row, and states, shape (n, SLOTS)."""
    from app.device.control.checkpoints import Rerun  # compiles or loads kernels

    inputs = recording.inputs
    recorded = inputs.checkpoint
    if recorded is None:
        raise ReplayError(
            sentence("this record cannot be replayed: {reason}", reason=why_not(inputs))
        )
    values = np.zeros((len(inputs.values), len(given)))  # an input that came later was never given
    for place, name in enumerate(given):
        if name in inputs.columns:
            values[:, place] = inputs.column(name)
    rerun = Rerun(table_of(recording), recorded.in_order_of(SLOT_NAMES), given)
    choices = choices_of(recording.events)
    if choices and change is None:
        raise ReplayError(
            sentence("this record cannot be replayed: models were chosen while it ran")
        )
    begin = int(inputs.column("tick")[0])
    at = [min(max(choice.tick - begin, 0), rows) for choice in choices]
    edges = sorted({0, rows, *at})
    for start, end in pairwise(edges):
        for made, place in enumerate(at, 1):
            if place == start and change is not None:
                rerun.exchange(*change(recording, rerun.table, choices[:made]))
        for first in range(start, end, _CHUNK):
            yield first, rerun.run(values[first : min(first + _CHUNK, end)])


@dataclass(frozen=True, slots=True)
class ReplayContents:
    """What can be replayed of a record.

    Attributes:
        session: id of the session.
        why_not: why it cannot be replayed; empty if it can.
        simulated: whether the robot is simulated, so that its encoders are recomputed.
        ticks: ticks of the loop in the record.
        seconds: time from the first to the last [s].
        rate_hz: rate of the ticks, from their median distance [Hz].
        stages: of the tick, in order, with the size of their memory.
        changing: inputs that change during the attempt, with the number of changes.
        missed: deadlines missed during the attempt.
        gaps: (first tick, count) of every stretch of ticks that is missing.
        build: what recorded it.
        scans: control scans with an order.
        origin: monotonic time of the beginning, which their times are told from [s].
        ct: the CT, and how it was read.
        risks: structures of risk, and how near the needle came.
        met: what the needle met; None where the record says nothing of it.
        entry: where it was marked on the skin; None where it was not.
    """

    session: str
    why_not: str
    simulated: bool
    ticks: int
    seconds: float
    rate_hz: float
    stages: Mapping[str, int]
    changing: Mapping[str, int]
    missed: int
    gaps: tuple[tuple[int, int], ...]
    build: Mapping[str, str]
    scans: tuple[ControlScan, ...] = ()
    origin: float = 0.0
    ct: CtFacts = UNKNOWN_CT
    risks: tuple[RiskMark, ...] = ()
    met: tuple[Met, ...] | None = None
    entry: EntryMark | None = None

    def sentences(self) -> list[str]:
        """Say it, one line each."""
        robot = sentence("the simulated robot") if self.simulated else "a real robot"
        lines = [
            sentence(
                "{ticks} ticks ({seconds:.1f} s at {rate_hz:.0f} Hz) of {robot}, "
                "{missed} deadlines missed",
                ticks=self.ticks,
                seconds=self.seconds,
                rate_hz=self.rate_hz,
                robot=robot,
                missed=self.missed,
            ),
            sentence("can be replayed: add --check")
            if not self.why_not
            else f"no replay: {self.why_not}",
        ]
        stages = ", ".join(f"{name} ({size})" for name, size in self.stages.items())
        lines.append(f"stages: {stages or 'not recorded'}")
        inputs = ", ".join(f"{name} ({count})" for name, count in self.changing.items())
        lines.append(sentence("inputs that change (how often): {inputs}", inputs=inputs or "none"))
        lines += [
            sentence("{count} ticks from tick {first} on are missing", count=count, first=first)
            for first, count in self.gaps
        ]
        if self.ct.recipe is not None:
            lines.append(f"CT {self.ct.pseudonym}: {self.ct.words()}")
        lines += [] if self.entry is None else [self.entry.words]
        lines += [scan.sentence(self.origin) for scan in self.scans]
        lines += [mark_sentence(mark) for mark in self.risks]
        lines += [met.sentence for met in self.met or ()]
        build = ", ".join(f"{name} {value}" for name, value in self.build.items())
        return [*lines, f"build: {build or 'not recorded'}"]

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "session": self.session,
            "replayable": not self.why_not,
            "why_not": self.why_not,
            "simulated": self.simulated,
            "ticks": self.ticks,
            "seconds": self.seconds,
            "rate_hz": self.rate_hz,
            "stages": dict(self.stages),
            "changing_inputs": dict(self.changing),
            "missed": self.missed,
            "gaps": [{"first_tick": first, "ticks": count} for first, count in self.gaps],
            "build": dict(self.build),
            "ct": self.ct.document(),
            "risks": [dict(event_of(mark).data) for mark in self.risks],
            "tissues_met": None if self.met is None else [met.document() for met in self.met],
            "scans": [scan.document(self.origin) for scan in self.scans],
            **({} if self.entry is None else {"entry_mark": self.entry.data()}),
        }


def contents(recording: Recording) -> ReplayContents:
    """Look into a record."""
    inputs = recording.inputs
    recorded, enough = inputs.checkpoint, len(inputs.values) > 1
    time = inputs.column("time") if enough else np.zeros(2)
    period = float(np.median(np.diff(time)))
    missed = inputs.column("missed") if enough and "missed" in inputs.columns else np.zeros(1)
    start = recorded.checkpoint if recorded is not None else None
    return ReplayContents(
        session=recording.id,
        why_not=why_not(inputs),
        simulated=is_simulated(recording),
        ticks=len(inputs.values),
        seconds=float(time[-1] - time[0]),
        rate_hz=1.0 / period if period > 0.0 else 0.0,
        stages=dict(zip(start.names, start.sizes, strict=True)) if start is not None else {},
        changing=_changing(recording) if enough else {},
        missed=int(missed[-1] - missed[0]),
        gaps=inputs.gaps(),
        build=recording.metadata.get(BUILD, {}),
        scans=recording.control_scans(),
        origin=recording.origin,
        ct=recording.ct,
        risks=risk_marks(recording.events),
        met=tissues_met(recording.events),
        entry=_entry_mark(recording),
    )


def _entry_mark(recording: Recording) -> EntryMark | None:
    """Return where the entry was marked; None where nobody did, or what is said is damaged."""
    for event in recording.events:
        if event.kind == PROCEDURE and event.data.get("step") == MARKED:
            with suppress(AcusError, LookupError, TypeError, ValueError):
                return mark_of(event.data)
    return None


def _changing(recording: Recording) -> dict[str, int]:
    inputs = recording.inputs
    counts = {}
    for name in INPUTS:
        if name in inputs.columns:
            values = np.nan_to_num(inputs.column(name), nan=0.0)
            counts[name] = int(np.count_nonzero(np.diff(values)))
    return {name: count for name, count in counts.items() if count}
