"""Recorded attempts as arrays, and whether a record is right."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen, read_only
from app.core.events import Event
from app.session.recording import Recording, open_recording, read_recording
from app.session.replay import ReplayReport as Replay
from app.session.store import records as records_in
from app.session.store import records_folder
from app.session.verify import Verification

__all__ = ["Record", "Replay", "Verification", "read_record", "records", "replay", "verify"]

_GIVEN: Final = {
    "session": ("started", "seed"),
    "exercise": ("id", "title", "version"),
    "software": ("name", "version"),
    "device": ("name", "kind", "simulated"),
    "trainee": ("hand", "scripted"),
    "conditions": ("level", "views", "assistance"),
    "result": ("state", "reason", "duration_s"),
}
"""What of a record's metadata is handed out: nothing of a patient, and no student's pseudonym."""

_UNITS: Final = {
    "depth": ("_m", 0),
    "tip": ("_m", 1),
    "axis": ("", 1),
    "target": ("_m", 1),
    "force": ("_n", 1),
    "guidance": ("_n", 1),
    "tip_radius": ("_m", 0),
}
"""Array of a record -> unit in the names of its columns, and how many dimensions follow time."""


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """One attempt: n samples, at most 100 a second, SI, in the frame `world` of the robot.

    Arrays are read-only. Where the needle's pose was not valid, tip and depth are NaN.

    Attributes:
        id: of the attempt.
        complete: whether the file was finished; if not, it holds all up to its last second.
        problems: what is cut off, damaged or lost, one line each.
        metadata: exercise, software, device, trainee, conditions and result, as text by group and
            name; nothing of a patient, and not the student's pseudonym.
        events: what happened, in order; times since the beginning of the attempt [s].
        time: since the beginning of the attempt [s], shape (n,).
        phase: `aligning`, `inserting`, `holding`, ..., shape (n,), text.
        valid: whether the pose is valid, shape (n,).
        depth: of the tip beyond the entry, along the needle [m], shape (n,).
        depth_source: what the depth comes from (`tracked`, `one_camera`, `model`, ...), shape (n,).
        tip: needle tip [m], shape (n, 3).
        axis: unit vector from hub to tip, shape (n, 3).
        target: target with its motion [m], shape (n, 3).
        force: at the hand after all limits, estimated from the torques [N], shape (n, 3).
        guidance: the guidance's share of the wanted force [N], shape (n, 3).
        tip_radius: round the tip that holds the true one with 95 % [m], shape (n,); NaN where
            unknown.
    """

    id: str
    complete: bool
    problems: tuple[str, ...]
    metadata: Mapping[str, Mapping[str, str]]
    events: tuple[Event, ...]
    time: FloatArray
    phase: NDArray[np.str_]
    valid: NDArray[np.bool_]
    depth: FloatArray
    depth_source: NDArray[np.str_]
    tip: FloatArray
    axis: FloatArray
    target: FloatArray
    force: FloatArray
    guidance: FloatArray
    tip_radius: FloatArray
    _recording: Recording = field(repr=False)

    @property
    def entry(self) -> FloatArray:
        """Planned entry, which is the robot's remote centre [m], shape (3,).

        Raises:
            AcusError: if the record holds no usable plan.
        """
        return self._recording.placed_plan().p_entry

    @property
    def T_world_patient(self) -> FloatArray:
        """Patient (DICOM LPS, metres) -> world [m], homogeneous, shape (4, 4).

        Raises:
            AcusError: if the record holds no usable plan.
        """
        transform = self._recording.placed_plan().T_world_patient
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = transform.rotation, transform.translation
        return frozen(matrix, (4, 4), "T_world_patient")

    def to_columns(self) -> dict[str, NDArray[Any]]:
        """Return all arrays over time as flat columns, shape (n,), as data frames take them.

        Names carry the unit and the axis of `world`: `time_s`, `tip_x_m`, `force_z_n`.
        """
        columns: dict[str, NDArray[Any]] = {"time_s": self.time}
        columns |= {name: getattr(self, name) for name in ("phase", "valid", "depth_source")}
        for name, (unit, vector) in _UNITS.items():
            values = getattr(self, name)
            parts = zip("xyz", values.T, strict=True) if vector else [("", values)]
            for letter, column in parts:
                columns["_".join(filter(None, (name, letter))) + unit] = column
        return columns


def record_of(recording: Recording) -> Record:
    """Return the arrays of a recording, shown by their promised names."""
    samples, origin = recording.samples, recording.origin
    unknown = read_only(np.full(len(samples.time), np.nan))
    return Record(
        id=recording.id,
        complete=recording.complete,
        problems=recording.problems,
        metadata=_shown(recording.metadata),
        events=tuple(_from(recording.events, origin)),
        time=read_only(samples.time - origin),
        phase=samples.state,
        valid=samples.valid,
        depth=samples.depth,
        depth_source=samples.depth_source,
        tip=samples.tip,
        axis=samples.axis,
        target=samples.target,
        force=samples.felt,
        guidance=samples.guide,
        tip_radius=unknown if samples.radius is None else samples.radius,
        _recording=recording,
    )


def recording_of(record: Record) -> Recording:
    """Return what the program knows of a record."""
    return record._recording  # noqa: SLF001  (of this module's own class)


def read_record(path: str | Path) -> Record:
    """Read the record of an attempt (.mcap), finished or not.

    Raises:
        AcusError: if the file cannot be read or holds nothing of an attempt; says why.
    """
    return record_of(open_recording(Path(path)))


def records(folder: str | Path | None = None) -> tuple[Path, ...]:
    """Return the files of all records in a folder, by name, which begins with date and time.

    What a killed program left half done there is finished first, as the program does.

    Args:
        folder: that holds them; this user's own where None.

    Raises:
        AcusError: if it is no folder, or cannot be read.
    """
    return tuple(records_in(records_folder(None if folder is None else Path(folder))))


def verify(path: str | Path) -> Verification:
    """Compute the score of a record again, and compare it with what was written.

    `confirmed` says whether all is the same, `changes` what differs, `sentences()` says both.

    Raises:
        AcusError: if the record cannot be read.
    """
    from app.session.sidecar import verify_record

    return verify_record(Path(path))


def replay(path: str | Path) -> Replay:
    """Compute every tick of a recorded attempt again, and compare it to the last bit.

    `identical` says whether nothing differs, `first_difference` where it does first. The first call
    on a computer compiles kernels for a minute or two.

    Raises:
        AcusError: if the record cannot be read, or holds too little to be computed again.
    """
    from app.compose.recomputed import replay_recording

    return replay_recording(read_recording(Path(path)))


def _shown(metadata: Mapping[str, Mapping[str, str]]) -> Mapping[str, Mapping[str, str]]:
    groups = {
        group: MappingProxyType(
            {key: metadata[group][key] for key in keys if key in metadata[group]}
        )
        for group, keys in _GIVEN.items()
        if group in metadata
    }
    return MappingProxyType(groups)


def _from(events: Iterable[Event], origin: float) -> Iterable[Event]:
    return (replace(event, time=event.time - origin) for event in events)
