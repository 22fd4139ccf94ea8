"""Stages of somebody else's machine: what they write beside what is theirs changes no tick."""

from dataclasses import replace

import numpy as np
import pytest
from device.device_rig import PROFILE, Rig

from app.core import state_vector as sv
from app.core.compiled import stage
from app.core.parameters import Stage
from app.device.control import table
from app.mechanisms.pantograph.machine import Pantograph


@stage
def arms_and_lifts(state, p):
    """Say that all is well, whatever is, and ask for more than is allowed."""
    state[sv.ENABLED] = state[sv.HOMED] = state[sv.ARMING] = 1.0
    state[sv.FAULT] = 0.0
    state[sv.FORCE_CAP] = 1e3
    state[sv.HEARTBEAT] = state[sv.TIME]
    state[sv.TORQUE_LEFT] = p[0]
    state[sv.TORQUE_RIGHT] = -p[0]
    state[sv.ENERGY_TANK] = 1e9


@stage
def lessens(state, p):
    """Take half of what is sent."""
    state[sv.TORQUE_LEFT] *= 0.5
    state[sv.TORQUE_RIGHT] *= 0.5


MORE = Stage("own", arms_and_lifts, np.full(1, 50.0))
PARTS = {"watch": (MORE,), "efforts": (MORE,)}


def rows(monkeypatch, **stages):
    """Ticks of a rig that is armed, disarmed, and whose window dies."""
    own = Pantograph.stages
    with monkeypatch.context() as changed:
        changed.setattr(Pantograph, "stages", lambda self: replace(own(self), **stages))
        rig = Rig(force=(0.5, 0.0, 0.0))
    with rig.loop:
        rig.write(force_cap=1.0)
        rig.arm()
        rig.write(enabled=0.0)
        rig.step(30)
        rig.write(enabled=1.0)
        rig.beating = False
        rig.step(1500)
        return rig.loop.rows()


@pytest.mark.parametrize("part", PARTS)
def test_what_a_foreign_machine_writes_beside_its_own_changes_nothing(monkeypatch, part):
    alone = rows(monkeypatch)
    monkeypatch.setattr(table, "is_own", lambda kind: False)
    assert np.array_equal(rows(monkeypatch), alone, equal_nan=True)
    assert np.array_equal(rows(monkeypatch, **{part: PARTS[part]}), alone, equal_nan=True)


def test_a_foreign_machine_may_lessen_a_torque(monkeypatch):
    monkeypatch.setattr(table, "is_own", lambda kind: False)
    whole = rows(monkeypatch)
    half = rows(monkeypatch, efforts=(Stage("own", lessens, np.zeros(1)),))
    sent = np.abs(whole[:, sv.TORQUE])
    assert sent.max() > 0.0
    assert (np.abs(half[:, sv.TORQUE]) <= sent + 1e-12).all()
    assert np.abs(half[:, sv.TORQUE]).max() > 0.0


def test_the_programs_own_machines_stand_in_the_table_alone():
    names = [stage.name for stage in Rig().table]
    assert not [name for name in names if name.startswith(("keep for", "give back after"))]
    assert PROFILE.kind == "pantograph"
