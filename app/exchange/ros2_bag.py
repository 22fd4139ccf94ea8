"""An attempt as a bag that ROS 2's tools open: the topics of `ros_topics`, MCAP with CDR.

A bag is a folder with `metadata.yaml` and one file. Every channel has a schema (`ros2msg`), so that
a program without ROS reads it too. It is made beside its place and put there whole.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping
from datetime import datetime
from pathlib import Path
from typing import Any, Final

import numpy as np
import yaml
from mcap.writer import CompressionType, Writer

from app import __version__
from app.core.arrays import FloatArray
from app.core.identifiers import without_identifiers
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.exchange.errors import ExportError
from app.exchange.moment import LiveDevice, LiveEvent, LiveMoment, LivePlan, LivePose, Validity
from app.exchange.ros_messages import DEFINITIONS, cdr, definition
from app.exchange.ros_topics import EVENTS, TOPICS, event
from app.session.recording import Recording
from app.session.scan import scan

TOLD: Final = frozenset({"state", "scan", "touch", "task", "breath", "withdrawal"})
"""Kinds of events that are exported."""

_QUANTILE: Final = 2.7954834829151074
"""Radius that holds 95 % of a normal distribution in space, over its standard deviation."""


def write_bag(recording: Recording, folder: Path) -> int:
    """Write an attempt as a bag.

    Args:
        recording: of the attempt.
        folder: of the bag; there must be none yet.

    Returns:
        How many messages it has.

    Raises:
        ExportError: if the folder is there already, the record holds no samples, or it cannot be
            written; nothing is left then.
    """
    if folder.exists():
        raise ExportError(
            sentence("{folder} is there already; name a new folder for the bag", folder=folder)
        )
    if len(recording.samples.time) == 0:
        raise ExportError(
            sentence("the record {record} holds no samples", record=recording.path.name)
        )
    unfinished = folder.with_name(f".{folder.name}.unfinished")
    try:
        shutil.rmtree(unfinished, ignore_errors=True)
        unfinished.mkdir(parents=True)
        count = _write(recording, unfinished, f"{folder.name}_0.mcap")
        unfinished.rename(folder)
    except OSError as error:
        raise ExportError(
            sentence(
                "the bag {folder} cannot be written: {reason}",
                folder=folder,
                reason=error.strerror or error,
            )
        ) from error
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)
    return count


def _write(recording: Recording, folder: Path, name: str) -> int:
    counts, times = dict.fromkeys(TOPICS, 0), []
    with (folder / name).open("wb") as stream:
        writer = Writer(stream, compression=CompressionType.ZSTD)
        writer.start(profile="ros2", library=f"acus {__version__}")
        schemas = {
            kind: writer.register_schema(kind, "ros2msg", definition(kind).encode())
            for kind in sorted({topic.type for topic in TOPICS.values()} & DEFINITIONS.keys())
        }
        channels = {
            name: writer.register_channel(name, "cdr", schemas[topic.type], _QOS)
            for name, topic in TOPICS.items()
            if topic.type in schemas
        }
        for wall, topic, body in _messages(recording):
            if topic not in channels:
                continue
            stamp = round(wall * 1e9)
            counts[topic] += 1
            times.append(stamp)
            data = cdr(TOPICS[topic].type, body)
            writer.add_message(channels[topic], stamp, data, stamp, counts[topic])
        writer.finish()  # type: ignore[no-untyped-call]
    document = _metadata(name, {one: counts[one] for one in channels}, min(times), max(times))
    (folder / "metadata.yaml").write_text(yaml.safe_dump(document, sort_keys=False))
    return len(times)


_QOS: Final = {"offered_qos_profiles": ""}


def _metadata(name: str, counts: Mapping[str, int], first: int, last: int) -> dict[str, Any]:
    """Return what `metadata.yaml` says, version 5 of rosbag2's."""
    span = {
        "duration": {"nanoseconds": last - first},
        "starting_time": {"nanoseconds_since_epoch": first},
        "message_count": sum(counts.values()),
    }
    topics = [
        {
            "topic_metadata": {
                "name": topic,
                "type": TOPICS[topic].type,
                "serialization_format": "cdr",
                **_QOS,
            },
            "message_count": count,
        }
        for topic, count in counts.items()
    ]
    return {
        "rosbag2_bagfile_information": {
            "version": 5,
            "storage_identifier": "mcap",
            **span,
            "topics_with_message_count": topics,
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [name],
            "files": [{"path": name, **span}],
        }
    }


def _messages(recording: Recording) -> Iterator[tuple[float, str, Mapping[str, Any]]]:
    """Yield time [s since 1970], topic and fields of every message, in the order of time."""
    keys: dict[str, object] = {}
    happened = _events(recording)
    for moment in _moments(recording):
        while happened and happened[0].wall <= moment.wall:
            yield happened[0].wall, EVENTS, event(happened.pop(0))
        for name, topic in TOPICS.items():
            told = topic.of(moment)
            if told is not None and told.key != keys.get(name):
                keys[name] = told.key
                yield moment.wall, name, told.body
    for one in happened:
        yield one.wall, EVENTS, event(one)


def _since(recording: Recording) -> float:
    """Return what makes a time since 1970 of a monotonic one [s]."""
    text = recording.metadata.get("session", {}).get("started", "")
    try:
        return datetime.fromisoformat(text).timestamp() - recording.origin
    except ValueError:
        return 0.0


def _events(recording: Recording) -> list[LiveEvent]:
    since = _since(recording)
    return [
        LiveEvent(number, since + one.time, one.kind, without_identifiers(str(one.message)))
        for number, one in enumerate(recording.events, 1)
        if one.kind in TOLD
    ]


def _moments(recording: Recording) -> Iterator[LiveMoment]:
    samples, placed, since = recording.samples, recording.placed_plan(), _since(recording)
    known = samples.valid & np.isfinite(samples.hub).all(axis=1)
    length = 0.0
    if known.any():
        spans = np.linalg.norm(samples.tip[known] - samples.hub[known], axis=1)
        length = float(np.nanmedian(spans))
    plan = LivePlan(
        placed.plan.entry_mm * MILLIMETRE,
        placed.plan.target_mm * MILLIMETRE,
        placed.T_world_patient,
        length,
    )
    joints = _joints(recording)
    for k, time in enumerate(samples.time):
        wall = since + float(time)
        needle = _needle(recording, k, wall, length)
        device = None
        if k < len(joints) and np.isfinite(samples.felt[k]).all():
            names, q, qd, torque = joints[k]
            error = float(np.arccos(np.clip(samples.axis[k] @ placed.axis, -1.0, 1.0)))
            if np.isfinite([*q, *qd, *torque, error]).all():
                device = LiveDevice(names, q, qd, torque, samples.felt[k], error, wall)
        yield LiveMoment(wall, True, str(samples.state[k]), needle, device, plan)


def _needle(recording: Recording, k: int, wall: float, length: float) -> LivePose | None:
    samples = recording.samples
    tip, axis, depth = samples.tip[k], samples.axis[k], float(samples.depth[k])
    if not samples.valid[k] or not np.isfinite([*tip, *axis, depth]).all():
        return None
    radius = np.nan if samples.radius is None else float(samples.radius[k])
    spread = np.eye(3) * (radius / _QUANTILE) ** 2 if np.isfinite(radius) else np.zeros((3, 3))
    measured = Validity.OK if np.isfinite(radius) or samples.radius is None else Validity.MISSING
    hub = tip - length * axis
    return LivePose(tip, tip, hub, axis, axis, depth, spread, measured, wall, 0.0)


_Joints = tuple[tuple[str, ...], FloatArray, FloatArray, FloatArray]


def _joints(recording: Recording) -> list[_Joints]:
    """Return names, angles, speeds and torques of each sample; none where one is not whole."""
    found: list[_Joints] = []
    for data in scan(recording.path).messages.get("/haptic/joints", ()):
        try:
            joints = json.loads(data)["joints"]
            names = tuple(str(joint["name"]) for joint in joints)
            q, qd, torque = (
                np.array([float(joint.get(part, np.nan)) for joint in joints])
                for part in ("position", "velocity", "effort")
            )
        except (ValueError, LookupError, TypeError):
            return []
        found.append((names, q, qd, torque))
    return found if len(found) == len(recording.samples.time) else []
