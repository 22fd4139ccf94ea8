"""A source of live values that a test sets, and small peers."""

import socket
import time
from dataclasses import replace

import numpy as np

from app.core.transform import RigidTransform
from app.exchange.moment import (
    LiveDevice,
    LiveEvent,
    LiveMoment,
    LivePlan,
    LivePose,
    LiveScan,
    LiveSurface,
    Validity,
)

HEAD_UP = RigidTransform(np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]]), [0.1, 0.2, 0.05])
"""A supine patient: L to +x, S to +y, A to +z."""

PLAN = LivePlan(np.array([0.01, -0.1, 0.2]), np.array([0.03, -0.05, 0.22]), HEAD_UP, 0.2)


def needle(validity=Validity.OK, wall=None, p_tip=(0.05, -0.04, 0.02), axis=(0.0, 0.6, -0.8)):
    """A straight needle, in world."""
    tip, axis = np.array(p_tip), np.array(axis)
    hub = tip - 0.2 * axis
    wall = time.time() if wall is None else wall
    spread = np.diag([1e-6, 4e-6, 9e-6])
    return LivePose(tip, tip, hub, axis, axis, 0.03, spread, validity, wall, 0.0)


def device():
    return LiveDevice(
        ("panto_a1", "panto_a5"), np.array([2.1, 1.0]), np.array([0.1, -0.2]),
        np.array([0.01, -0.02]), np.array([0.3, -0.4, 0.0]), 0.05, time.time(),
    )  # fmt: skip


class Stage:
    """A source whose values a test sets; each question is a new moment unless `still`."""

    def __init__(self):
        self.moment = LiveMoment(0.0, True, "inserting", needle(), device(), PLAN)
        self.still, self.events, self.placed, self.refusal = False, [], [], ""

    def now(self):
        wall = time.time()
        moment = replace(self.moment, wall=wall)
        if self.still or moment.needle is None:
            return moment
        return replace(moment, needle=replace(moment.needle, wall=wall))

    def events_after(self, number):
        return tuple(event for event in self.events if event.number > number)

    def place(self, p_entry, p_target):
        if not self.refusal:
            self.placed.append((p_entry, p_target))
        return self.refusal

    def say(self, kind, message):
        self.events.append(LiveEvent(len(self.events) + 1, time.time(), kind, message))

    def change(self, **values):
        self.moment = replace(self.moment, **values)


def scan(slices=3, rows=20, columns=30):
    """A control scan whose numbers say where they stand, at a place and steps of its own."""
    k, j, i = np.meshgrid(range(slices), range(rows), range(columns), indexing="ij")
    affine = np.diag([0.7, 0.8, 5.0, 1.0])
    affine[:3, 3] = [-120.0, -95.0, 130.0]
    return LiveScan(1, time.time(), (1000 * k + 30 * j + i - 1000).astype(np.int16), affine)


def tetrahedron(name="skin", skin=True, at=(0.0, 0.0, 0.0)):
    """The smallest closed surface, in the patient [m]."""
    points = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]) + at
    corners = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    return LiveSurface(name, points, corners, skin)


def wait_for(what, seconds=3.0):
    """Return what `what()` returns once it is true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if found := what():
            return found
        time.sleep(0.01)
    raise AssertionError("it has not come")


def knock(port, host="127.0.0.1", buffer=None):
    """Return a connected socket."""
    one = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
    if buffer:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
    one.settimeout(3.0)
    one.connect((host, port))
    return one
