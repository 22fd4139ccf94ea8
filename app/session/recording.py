"""A record read back: metadata, plan, events and arrays."""

import json
import math
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from app.core.arrays import read_only
from app.core.events import Event
from app.core.messages import sentence
from app.planning.placement import PlacedPlan
from app.scoring.trajectory import Trajectory
from app.session.budget import LONGEST_WORD
from app.session.control_scan import ControlScan, scan_marks, scans_of
from app.session.ct_facts import CtFacts
from app.session.errors import BrokenRecordingError, BudgetExceededError
from app.session.facts import PLAN, placed_plan
from app.session.planned import judged_plan
from app.session.procedure_marks import marks_of
from app.session.risks import risk_marks
from app.session.sample_columns import SAMPLES_FILE, same, unpack
from app.session.samples import Samples, bends, flags, floats, known, spreads, vectors, words
from app.session.scan import FileContents, scan, scan_by_index
from app.session.schemas import CHANNELS, conforms
from app.session.scored import agreement_of, renders_force, seen_from, trajectory
from app.session.ticks import Inputs, read_inputs
from app.session.tissues import tissues_met
from app.session.touching import touches_of
from app.session.transitions import excused, waited_for_computer

Metadata = MappingProxyType[str, dict[str, str]]

WORDS = ("state", "depth_source")
"""What becomes a column of texts."""


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """One record.

    Attributes:
        path: the file.
        complete: whether the file was finished; if not, it holds all up to its last second.
        problems: what is cut off, damaged or lost, one line each.
        metadata: metadata records by name.
        attachments: attached files by name.
        events: events in order.
        samples: the attempt over time.
        inputs: the loop's ticks.
    """

    path: Path
    complete: bool
    problems: tuple[str, ...]
    metadata: Metadata
    attachments: MappingProxyType[str, bytes]
    events: tuple[Event, ...]
    samples: Samples
    inputs: Inputs = field(repr=False)

    @property
    def id(self) -> str:
        """Session id."""
        return self.metadata.get("session", {}).get("id", self.path.stem)

    @property
    def origin(self) -> float:
        """Monotonic time of the attempt's beginning [s], which events and samples are told from."""
        try:
            origin = float(self.metadata["session"]["origin_s"])
        except (KeyError, ValueError):
            origin = math.nan
        return origin if math.isfinite(origin) else 0.0

    @property
    def ct(self) -> CtFacts:
        """The CT, and how it was read."""
        return CtFacts.of_metadata(self.metadata.get("ct", {}))

    def control_scans(self) -> tuple[ControlScan, ...]:
        """Control scans with an order."""
        return scans_of(self.events)

    def trajectory(self) -> Trajectory:
        """Return the attempt as scoring wants it.

        Raises:
            BrokenRecordingError: if the record holds no usable plan.
        """
        reason = self.metadata.get("result", {}).get("reason", "")
        renders = renders_force(self.metadata)
        scans = scan_marks(self.events)
        risks = risk_marks(self.events)
        met = tissues_met(self.events)
        return trajectory(
            self.samples,
            self.placed_plan(),
            reason,
            renders,
            scans,
            risks,
            excused(self.events),
            agreement_of(self.metadata),
            touches_of(self.events),
            met,
            computer=waited_for_computer(self.events),
            seen_from=seen_from(self.attachments),
            planned=judged_plan(self.events),
            procedure=marks_of(self.events, self.samples, met, self.placed_plan()),
        )

    def placed_plan(self) -> PlacedPlan:
        """Plan in the robot's frame.

        Raises:
            BrokenRecordingError: if the record holds no usable plan.
        """
        if PLAN not in self.metadata:
            raise BrokenRecordingError(
                sentence(
                    "{path_name} holds no plan: it was cut off at its beginning",
                    path_name=self.path.name,
                )
            )
        return placed_plan(self.metadata[PLAN])


class DeferredInputs:
    """The loop's ticks of a record, read when somebody first asks for one of their attributes."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._read: Inputs | None = None

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the ticks as they stand in the file.

        Raises:
            BrokenRecordingError: if the file cannot be read any more.
        """
        if name.startswith("_"):  # somebody looks what this is, not at the ticks
            raise AttributeError(name)
        if self._read is None:
            self._read = read_inputs(scan(self._path), [])
        return getattr(self._read, name)


def deferred_inputs(path: Path) -> Inputs:
    """Return the ticks of a record, to be read when they are asked for."""
    return cast("Inputs", DeferredInputs(path))


def open_recording(path: Path) -> Recording:
    """Read a record for its debrief: all but the ticks and what is only there for other programs.

    Of a finished record with samples in columns; any other is read whole.

    Raises:
        BrokenRecordingError: as `read_recording`.
    """
    content = scan_by_index(path, "/events")
    if content is None or "session" not in content.metadata:
        return read_recording(path)
    problems: list[str] = []
    samples = _columns(content, problems)
    if samples is None:
        return read_recording(path)
    lost = content.metadata.get("result", {}).get("lost_rows", "0")
    return _recording(
        path,
        content,
        samples,
        problems,
        deferred_inputs(path),
        int(lost) if lost.isdigit() else 0,
    )


def read_recording(path: Path) -> Recording:
    """Read a whole record, finished or not.

    Raises:
        BrokenRecordingError: if the file is not an MCAP file, or holds nothing of an attempt.
    """
    content = scan(path)
    if "session" not in content.metadata:
        raise BrokenRecordingError(
            sentence("{path_name} holds no session: ", path_name=path.name)
            + "; ".join(content.problems or ["not ours"])
        )
    problems = content.problems
    samples = _columns(content, problems) or _samples(content, problems)
    inputs = read_inputs(content, problems)
    return _recording(path, content, samples, problems, inputs, inputs.lost)


def messages_agree(recording: Recording) -> str:
    """Name what of the samples is not in the record's messages as it is in its columns; or nothing.

    Raises:
        BrokenRecordingError: if the file cannot be read any more.
    """
    content = scan(recording.path)
    if SAMPLES_FILE not in content.attachments:
        return ""
    messages = _samples(content, [])
    cut = "full" in recording.metadata.get("result", {})
    if len(messages.time) != len(recording.samples.time) and not cut:
        return "their number"
    return same(messages, recording.samples)


def _recording(
    path: Path,
    content: FileContents,
    samples: Samples,
    problems: list[str],
    inputs: Inputs,
    lost: int,
) -> Recording:
    events = tuple(_event(document) for document in _documents(content, "/events", problems))
    if lost:
        problems.append(f"{lost} ticks of the loop were lost while recording")
    full = content.metadata.get("result", {}).get("full", "")
    if full:
        problems.append(full)
    return Recording(
        path=path,
        complete=content.complete,
        problems=tuple(problems),
        metadata=MappingProxyType(content.metadata),
        attachments=MappingProxyType(content.attachments),
        events=events,
        samples=samples,
        inputs=inputs,
    )


def _documents(content: FileContents, topic: str, problems: list[str]) -> list[dict[str, Any]]:
    """Messages of a JSON channel that are as its schema says."""
    schema = CHANNELS[topic].schema or {}
    documents, odd = [], Counter[str]()
    for data in content.messages.get(topic, []):
        content.budget.take_json(data)
        try:
            document = json.loads(data)
        except (ValueError, RecursionError):
            odd["is not JSON"] += 1
            continue
        if conforms(document, schema) and _has_short_words(document):
            documents.append(document)
        else:
            odd["lacks a field or has a wrong one"] += 1
    for why, count in odd.items():
        times = f" ({count} times)" if count > 1 else ""
        problems.append(f"a message of {topic} {why}: left out{times}")
    return documents


def _has_short_words(document: dict[str, Any]) -> bool:
    """Return whether what becomes a column of texts is short: a column is as wide as its
    longest.
    """
    return all(len(str(document.get(name, ""))) <= LONGEST_WORD for name in WORDS)


def _event(document: dict[str, Any]) -> Event:
    data = dict(document.get("data", {}))
    time = data.pop("time", 0.0)
    time = float(time) if conforms(time, {"type": "number"}) else 0.0
    return Event(time, str(document.get("kind", "")), str(document.get("message", "")), data)


def _columns(content: FileContents, problems: list[str]) -> Samples | None:
    """Return the samples by the attachment; None without one that can be read."""
    try:
        return unpack(content.attachments[SAMPLES_FILE], content.budget)
    except KeyError:
        return None
    except BudgetExceededError:
        raise
    except BrokenRecordingError as error:
        problems.append(str(error))
        return None


def _samples(content: FileContents, problems: list[str]) -> Samples:
    rows = _documents(content, "/attempt", problems)
    by_stamp = {_stamp(d): d for d in _documents(content, "/haptic/wrench", problems)}
    wrenches = [by_stamp.get(_stamp(row), {}) for row in rows]  # both channels share the stamp
    stated = {_stamp(d): d for d in _documents(content, "/tracking/quality", problems)}
    qualities = [stated.get(_stamp(row), {}) for row in rows]
    return Samples(
        time=floats([row["time"] for row in rows]),
        state=words([row["state"] for row in rows]),
        valid=read_only(np.array([row["valid"] for row in rows], dtype=np.bool_)),
        depth_source=words([row["depth_source"] for row in rows]),
        depth=floats([row["depth"] for row in rows]),
        tip=vectors([row["tip"] for row in rows]),
        axis=vectors([row["axis"] for row in rows]),
        target=vectors([row["target"] for row in rows]),
        hub=vectors([row["hub"] for row in rows]),
        guide=vectors([wrench.get("guide") for wrench in wrenches]),
        felt=vectors([wrench.get("felt") for wrench in wrenches]),
        measured=floats([wrench.get("measured") for wrench in wrenches]),
        radius=floats([quality.get("radius_95") for quality in qualities]),
        bend=bends([row.get("bend") for row in rows]),
        assistance=floats([wrench.get("assistance") for wrench in wrenches]),
        spread=spreads([quality.get("spread") for quality in qualities]),
        clamped=flags([bool(wrench.get("clamped")) for wrench in wrenches]),
        felt_least=known([wrench.get("felt_least") for wrench in wrenches]),
        felt_most=known([wrench.get("felt_most") for wrench in wrenches]),
        along=known([wrench.get("along") for wrench in wrenches]),
    )


def _stamp(document: dict[str, Any]) -> int:
    stamp = document["timestamp"]
    return int(stamp["sec"]) * 1_000_000_000 + int(stamp["nsec"])
