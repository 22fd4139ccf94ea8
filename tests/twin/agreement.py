"""Whether what each listener heard is what the records hold: by numbers, not by the program's code.

Records are read by the MCAP library, their plan as Slicer's markups. A supine patient lies with his
left to +x, his head to +y and his front to +z of the robot, his entry on the fulcrum, which stands
where the laboratory's description of the robot has it (docs/links.md, docs/planning.md).
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from mcap.reader import NonSeekingReader

FULCRUM = np.array([0.0, 0.16056, 0.090])
"""Of the robot's frame [m]."""

TO_WORLD = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""LPS to world of a supine patient."""

SAME_M, SAME_S = 1e-6, 0.050


@dataclass(frozen=True)
class Track:
    """A record's needle: times [s since 1970], tips in world [m], entry in LPS [m]."""

    id: str
    time: np.ndarray
    tip: np.ndarray
    entry: np.ndarray
    whole: tuple[float, float]


@dataclass
class Agreement:
    """What came of a comparison.

    Attributes:
        compared: poses that were told of a time that a record has.
        wrong: of these, those that no row within `SAME_S` equals, a line each.
        worst_m: largest distance from the row that is equal [m].
        worst_s: largest time between both [s].
        late_s: from the stamp to its arrival [s], all of them.
    """

    compared: int = 0
    wrong: list[str] = field(default_factory=list)
    worst_m: float = 0.0
    worst_s: float = 0.0
    late_s: list[float] = field(default_factory=list)

    @property
    def words(self) -> str:
        if not self.compared:
            return "nothing was heard"
        late = 1e3 * np.percentile(self.late_s, [50, 99])
        return (
            f"{self.worst_m:.1e} m, {1e3 * self.worst_s:.1f} ms, {self.compared} poses; "
            f"{late[0]:.0f} ms old when heard (99 %: {late[1]:.0f})"
        )

    def take(self, tracks: list[Track], p_world: np.ndarray, stamp: float, at: float) -> None:
        """Compare one pose."""
        for track in tracks:
            if not track.whole[0] <= stamp <= track.whole[1]:
                continue
            near = np.flatnonzero(np.abs(track.time - stamp) <= SAME_S)
            self.compared += 1
            self.late_s.append(at - stamp)
            away = np.linalg.norm(track.tip[near] - p_world, axis=1)
            equal = near[away <= SAME_M]
            if not equal.size:
                best = away.min() if near.size else np.inf
                self.wrong.append(f"{track.id}: {best:.2e} m away from every row at {stamp:.3f}")
                return
            first = equal[np.argmin(np.abs(track.time[equal] - stamp))]
            self.worst_s = max(self.worst_s, float(abs(track.time[first] - stamp)))
            self.worst_m = max(self.worst_m, float(np.linalg.norm(track.tip[first] - p_world)))
            return


def track_of(path: Path) -> Track | None:
    """Return what a record holds; None of one that has no measured pose."""
    times, every, tips, entry = [], [], [], None
    with path.open("rb") as stream:
        reader = NonSeekingReader(stream)
        for _, _, message in reader.iter_messages(topics=["/attempt"], log_time_order=False):
            row = json.loads(message.data)
            wall = row["timestamp"]["sec"] + 1e-9 * row["timestamp"]["nsec"]
            every.append(wall)
            if row["valid"] and row["tip"] is not None:
                times.append(wall)
                tips.append([row["tip"][axis] for axis in "xyz"])
    with path.open("rb") as stream:
        for one in NonSeekingReader(stream).iter_attachments():
            if one.name == "plan.mrk.json":
                points = json.loads(one.data)["markups"][0]["controlPoints"]
                entry = 1e-3 * np.array(points[0]["position"])
    if not times or entry is None:
        return None
    return Track(path.stem, np.array(times), np.array(tips), entry, (every[0], every[-1]))


def heard(path: Path) -> list[dict]:
    """Return the lines of a listener; the last may be torn by a kill."""
    lines = []
    for line in path.read_text().splitlines() if path.exists() else ():
        try:
            lines.append(json.loads(line))
        except ValueError:
            continue
    return lines


def of_slicer(lines: list[dict], tracks: list[Track]) -> Agreement:
    """Compare `NeedleTipToRas`: RAS [mm] is LPS with x and y turned round."""
    found = Agreement()
    for line in lines:
        if line["name"] == "NeedleTipToRas":
            x, y, z = (row[3] for row in line["matrix"][:3])
            p_patient = 1e-3 * np.array([-x, -y, z])
            p_world = FULCRUM + TO_WORLD @ (p_patient - tracks[0].entry) if tracks else p_patient
            found.take(tracks, p_world, line["stamp"], line["at"])
    return found


def of_gui(lines: list[dict], tracks: list[Track]) -> Agreement:
    """Compare `/needle_pose`, metres in world, and where `/tf` has the patient."""
    found = Agreement()
    for line in lines:
        message = line["message"]
        if line["name"] == "/needle_pose":
            place = message["pose"]["pose"]["position"]
            p_world = np.array([place[axis] for axis in "xyz"])
            found.take(tracks, p_world, _stamp(message["header"]), line["at"])
        elif line["name"] == "/tf" and tracks:
            for one in message["transforms"]:
                if one["child_frame_id"] == "patient":
                    away = np.linalg.norm(_placed(one["transform"], tracks[0].entry) - FULCRUM)
                    if away > SAME_M:
                        found.wrong.append(f"/tf has the entry {away:.2e} m beside the fulcrum")
    return found


def _stamp(header: dict) -> float:
    return header["stamp"]["sec"] + 1e-9 * header["stamp"]["nanosec"]


def _placed(transform: dict, p: np.ndarray) -> np.ndarray:
    """Return a point turned by a unit quaternion and moved."""
    turn = transform["rotation"]
    v, w = np.array([turn[axis] for axis in "xyz"]), turn["w"]
    moved = np.array([transform["translation"][axis] for axis in "xyz"])
    return moved + p + 2.0 * np.cross(v, np.cross(v, p) + w * p)
