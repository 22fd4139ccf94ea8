"""A record read back: metadata, plan, events and arrays."""

import json
import math
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from app.core.arrays import read_only
from app.core.events import Event
from app.planning.placement import PlacedPlan
from app.scoring.trajectory import Trajectory
from app.session.control_scan import ControlScan, scan_marks, scans_of
from app.session.ct_facts import CtFacts
from app.session.errors import BrokenRecordingError
from app.session.facts import PLAN, placed_plan
from app.session.pauses import excused
from app.session.risks import risk_marks
from app.session.samples import Samples, bends, floats, vectors, words
from app.session.scan import Scan, scan
from app.session.schemas import CHANNELS, conforms
from app.session.scored import renders_force, trajectory
from app.session.ticks import Inputs, read_inputs

Metadata = MappingProxyType[str, dict[str, str]]


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
        """Control scans with an order; the streak of old ones is that of the recorded exercise."""
        return scans_of(self.events, self._streak())

    def _streak(self) -> bool | None:
        try:
            streak = json.loads(self.attachments["exercise.json"])["guidance"]["streak"]
        except (KeyError, TypeError, ValueError, RecursionError):
            return None
        return streak if isinstance(streak, bool) else None

    def trajectory(self) -> Trajectory:
        """Return the attempt as scoring wants it.

        Raises:
            BrokenRecordingError: if the record holds no usable plan.
        """
        reason = self.metadata.get("result", {}).get("reason", "")
        renders = renders_force(self.metadata)
        scans = scan_marks(self.events)
        risks = risk_marks(self.events)
        return trajectory(
            self.samples, self.placed_plan(), reason, renders, scans, risks, excused(self.events)
        )

    def placed_plan(self) -> PlacedPlan:
        """Plan in the robot's frame.

        Raises:
            BrokenRecordingError: if the record holds no usable plan.
        """
        if PLAN not in self.metadata:
            raise BrokenRecordingError(
                f"{self.path.name} holds no plan: it was cut off at its beginning"
            )
        return placed_plan(self.metadata[PLAN])


def read_recording(path: Path) -> Recording:
    """Read a record, finished or not.

    Raises:
        BrokenRecordingError: if the file is not an MCAP file, or holds nothing of an attempt.
    """
    content = scan(path)
    if "session" not in content.metadata:
        raise BrokenRecordingError(
            f"{path.name} holds no session: " + "; ".join(content.problems or ["not ours"])
        )
    problems = content.problems
    samples = _samples(content, problems)
    inputs = read_inputs(content, problems)
    events = tuple(_event(document) for document in _documents(content, "/events", problems))
    if inputs.lost:
        problems.append(f"{inputs.lost} ticks of the loop were lost while recording")
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


def _documents(content: Scan, topic: str, problems: list[str]) -> list[dict[str, Any]]:
    """Messages of a JSON channel that are as its schema says."""
    schema = CHANNELS[topic].schema or {}
    documents = []
    for data in content.messages.get(topic, []):
        try:
            document = json.loads(data)
        except (ValueError, RecursionError) as error:
            problems.append(f"a message of {topic} is not JSON and left out: {error}")
            continue
        if conforms(document, schema):
            documents.append(document)
        else:
            problems.append(f"a message of {topic} lacks a field or has a wrong one: left out")
    return documents


def _event(document: dict[str, Any]) -> Event:
    data = dict(document.get("data", {}))
    time = data.pop("time", 0.0)
    time = float(time) if conforms(time, {"type": "number"}) else 0.0
    return Event(time, str(document.get("kind", "")), str(document.get("message", "")), data)


def _samples(content: Scan, problems: list[str]) -> Samples:
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
    )


def _stamp(document: dict[str, Any]) -> int:
    stamp = document["timestamp"]
    return int(stamp["sec"]) * 1_000_000_000 + int(stamp["nsec"])
