"""What is live now, as every link asks for it: frozen values, pulled, with their age.

Whoever composes a trainer implements `LiveSource`. A link never waits for the loop or an attempt:
it reads the newest values, and leaves out what came between. Points are in `world`, SI; patients
have no names here, and where an exercise does not show its needle nobody else is told of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, IntArray
from app.core.transform import RigidTransform


class Validity(StrEnum):
    """Whether a pose may be used; the words of PLUS (`igsioCommon`, ToolStatus)."""

    OK = "OK"
    MISSING = "MISSING"
    OUT_OF_VIEW = "OUT_OF_VIEW"
    REQ_TIMEOUT = "REQ_TIMEOUT"
    INVALID = "INVALID"


@dataclass(frozen=True, slots=True, eq=False)
class LivePose:
    """The needle as measured.

    Attributes:
        p_tip: tip, of the bent needle where it bends [m], shape (3,).
        p_straight: where the tip would be if nothing bent it [m], shape (3,).
        p_hub: end in the hand [m], shape (3,).
        axis: unit direction of the shaft, hub to tip, shape (3,).
        tip_axis: unit direction in which the tip goes on, shape (3,).
        depth: of the tip beyond the entry along the axis [m].
        covariance: of the tip [m²], shape (3, 3).
        validity: whether it may be used.
        wall: moment that it stands for [s since 1970].
        age: of it when it was asked for [s].
    """

    p_tip: FloatArray
    p_straight: FloatArray
    p_hub: FloatArray
    axis: FloatArray
    tip_axis: FloatArray
    depth: float
    covariance: FloatArray
    validity: Validity
    wall: float
    age: float


@dataclass(frozen=True, slots=True, eq=False)
class LiveDevice:
    """The robot.

    Attributes:
        names: of the joints, as its URDF has them.
        q: angles [rad], shape (n,).
        qd: speeds [rad/s], shape (n,).
        torque: sent to the motors [N·m], shape (n,).
        felt: force at the hub [N], shape (3,).
        angle_error: between needle and path [rad].
        wall: moment that it stands for [s since 1970].
    """

    names: tuple[str, ...]
    q: FloatArray
    qd: FloatArray
    torque: FloatArray
    felt: FloatArray
    angle_error: float
    wall: float


@dataclass(frozen=True, slots=True, eq=False)
class LivePlan:
    """The plan: points in the patient (DICOM LPS, metres), and the patient's place.

    Attributes:
        p_entry: entry [m], shape (3,).
        p_target: target [m], shape (3,).
        T_world_patient: takes LPS metres to the robot's frame.
        length: of the needle [m].
    """

    p_entry: FloatArray
    p_target: FloatArray
    T_world_patient: RigidTransform
    length: float


@dataclass(frozen=True, slots=True, eq=False)
class LiveScan:
    """Picture of a control scan.

    Attributes:
        number: in its attempt, from 1.
        wall: when it was taken [s since 1970].
        hu: voxels, int16, shape (slices, rows, columns).
        affine_mm: (column, row, slice) to DICOM LPS [mm], shape (4, 4).
    """

    number: int
    wall: float
    hu: NDArray[np.int16]
    affine_mm: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class LiveSurface:
    """The skin, or a structure, as triangles.

    Attributes:
        name: of it.
        points: in the patient (DICOM LPS) [m], shape (n, 3).
        triangles: corners, counter-clockwise seen from outside, shape (m, 3).
        skin: whether it is the skin, through which others are to be seen.
    """

    name: str
    points: FloatArray
    triangles: IntArray
    skin: bool = False


@dataclass(frozen=True, slots=True)
class LiveEvent:
    """Something that happened.

    Attributes:
        number: counts up from 1 as long as the program runs.
        wall: when [s since 1970].
        kind: as in the record: `state`, `scan`, `touch`, …
        message: one line for people.
    """

    number: int
    wall: float
    kind: str
    message: str


@dataclass(frozen=True, slots=True, eq=False)
class LiveMoment:
    """Everything at one moment; what is not known, or not to be told, is None.

    Attributes:
        wall: when it was put together [s since 1970].
        running: whether a trainer runs.
        state: of the attempt; empty without a trainer.
        needle, device, plan, scan: see there.
        surfaces: of the patient; the same object as long as they are the same.
    """

    wall: float
    running: bool = False
    state: str = ""
    needle: LivePose | None = None
    device: LiveDevice | None = None
    plan: LivePlan | None = None
    scan: LiveScan | None = None
    surfaces: tuple[LiveSurface, ...] = ()


class LiveSource(Protocol):
    """What a link asks; every method returns at once, in any thread."""

    def now(self) -> LiveMoment:
        """Return the newest of everything."""

    def events_after(self, number: int) -> tuple[LiveEvent, ...]:
        """Return what happened after an event, oldest first; the oldest may be forgotten."""

    def place(self, p_entry: FloatArray, p_target: FloatArray) -> str:
        """Take another entry and target, LPS [m], shape (3,) each.

        Returns why not, in one line; empty where it is done. May wait for a second: a link asks in
        a thread that nobody else needs.
        """


UP = (np.array([0.0, 0.0, 1.0]), np.array([0.0, -1.0, 0.0]))
"""Towards the head, and to the front where the needle runs along the patient (LPS)."""

STEEP = 0.95


def needle_rotation(axis_patient: FloatArray) -> FloatArray:
    """Rotation of the needle's frame in the patient, shape (3, 3): +z out of the tip.

    A needle has no roll of its own: x is the patient's direction to the head as far as it is
    across the needle; where the needle runs along the patient, to the front.

    Args:
        axis_patient: unit direction, hub to tip, LPS, shape (3,).
    """
    up = UP[0] if abs(axis_patient @ UP[0]) < STEEP else UP[1]
    x = up - (up @ axis_patient) * axis_patient
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(axis_patient, x), axis_patient])
