"""Replay of a robot on a wire: what it read is given from the record, nothing is sent to it."""

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.build import BUILD, build
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, Table, machine_stages
from app.device.links import Link, LinkStatus
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import load_profile
from app.session.header import SessionHeader
from app.session.recorder import Recorder
from app.session.recording import Recording, read_recording
from app.session.replay import given_slots, replay

PROFILE = load_profile("icube")


@stage
def read_wire(state: FloatArray, p: FloatArray) -> None:
    """Angles that no formula of the program gives, replies that are counted, one that is lost."""
    p[0] += 1.0
    p[3] = np.mod(1103515245.0 * p[3] + 12345.0, 2147483648.0)
    state[sv.LINK_REPLIES] = p[0]
    state[sv.ROUND_TRIP] = 80e-6 + 1e-6 * np.mod(p[3], 40.0)
    state[sv.GAUGE], state[sv.GAUGE_FORCE] = 1.0, 1e-9 * p[3]
    if np.mod(p[0], 97.0) != 0.0:
        count = 2.0 * np.pi / 20_000
        state[sv.Q_LEFT] = p[1] + count * np.floor(30.0 * np.sin(0.004 * p[0]))
        state[sv.Q_RIGHT] = p[2] + count * np.mod(p[3], 3.0)
        state[sv.Q_TIME] = state[sv.TIME] - 1e-4
    if p[0] > 900.0:
        state[sv.HOMED] = 0.0


@stage
def write_wire(state: FloatArray, p: FloatArray) -> None:
    """Remember what was sent."""
    p[0] = state[sv.TORQUE_LEFT]


def table(wired: bool = True) -> Table:
    left, right = inverse(PROFILE.pantograph, PROFILE.fulcrum[:2] + (0.01, 0.02))
    link = Link.of(
        [("wire read", read_wire, np.array([0.0, left, right, 7.0]))],
        [("wire write", write_wire, np.zeros(1))],
    )
    laws = [VirtualFixture.of(PROFILE).stage()]
    return machine_stages(PROFILE, laws, [], link if wired else Link.of([], []))


def header() -> SessionHeader:
    metadata = {"device": {"name": "icube", "simulated": "no"}, BUILD: build()}
    started = datetime(2026, 1, 15, tzinfo=UTC)
    return SessionHeader("robot", started, 10.0, "s-1", "liver-01", metadata=metadata)


@pytest.fixture
def recording(tmp_path: Path) -> Recording:
    clock = VirtualClock(10.0)
    with Loop(table(), 1000.0, clock) as loop:
        loop.inbox.write(path_z=-1.0, assistance=1.0, homed=1.0, force_cap=3.0)
        loop.step(50)
        recorder = Recorder(tmp_path, header(), loop.rows, clock=clock, start=loop.checkpoint())
        recorder.open()
        for _ in range(60):
            loop.inbox.write(enabled=1.0, heartbeat=clock.now())
            loop.step(20)
            recorder.drain()
    recorder.finish()  # after the loop has ended: its last row is no tick
    return read_recording(recorder.status().path)


def test_a_real_robot_s_attempt_is_recomputed_from_what_its_wire_read(
    recording: Recording,
) -> None:
    assert {"q_left", "link_replies", "gauge_force"} <= set(given_slots(recording))
    assert np.abs(recording.inputs.column("torque_left")).max() > 0.0
    report = replay(recording, lambda _: table(wired=False))
    assert report.identical, report.sentences()
    assert (report.ticks, report.recorded_ticks) == (1200, 1201)
    assert report.every_slot
    assert int(LinkStatus.FINE) == 0


def test_another_angle_than_was_read_is_found_at_its_tick(recording: Recording) -> None:
    inputs = recording.inputs
    values: Any = inputs.values.copy()
    values[300, inputs.columns.index("q_left")] += 2.0 * np.pi / 20_000
    changed = replace(recording, inputs=replace(inputs, values=values))
    found = replay(changed, lambda _: table(wired=False)).first_difference
    assert found is not None
    assert found.tick == 351
    assert found.slot in ("depth", "torque_left")


def test_as_a_simulated_robot_the_same_record_would_not_be_identical(recording: Recording) -> None:
    metadata = MappingProxyType(dict(recording.metadata) | {"device": {"simulated": "yes"}})
    report = replay(replace(recording, metadata=metadata), lambda _: table(wired=False))
    assert not report.identical
