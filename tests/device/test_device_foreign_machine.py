"""Stages of somebody else's machine: what they write beside what is theirs changes no tick."""

from dataclasses import replace

import numpy as np
import pytest
from device.device_rig import PROFILE, Rig

from app.core import state_vector as sv
from app.core.compiled import stage
from app.core.parameters import Stage
from app.device.control import table
from app.device.errors import DeviceError
from app.device.links import Link
from app.mechanisms.pantograph.machine import Pantograph
from app.mechanisms.profile import load_profile


@stage
def arms_and_lifts(state, p):
    """Say that all is well, whatever is, and ask for p[0] times what is allowed."""
    state[sv.ENABLED] = state[sv.HOMED] = state[sv.ARMING] = 1.0
    state[sv.FAULT] = 0.0
    state[sv.FORCE_CAP] = 1e3
    state[sv.HEARTBEAT] = state[sv.TIME]
    state[sv.SAFETY_SCALE] = state[sv.LIMIT_SCALE] = state[sv.GUARD_SCALE] = 1.0
    state[sv.LET_GO] = state[sv.MACHINE_FAULT] = 0.0
    state[sv.TORQUE_LEFT] *= p[0]
    state[sv.TORQUE_RIGHT] *= p[0]
    state[sv.ENERGY_TANK] = 1e9


@stage
def lessens(state, p):
    """Take half of what is sent."""
    state[sv.TORQUE_LEFT] *= 0.5
    state[sv.TORQUE_RIGHT] *= 0.5


@stage
def sends(state, p):
    """Make of both torques whatever p says: a factor of each, and something more."""
    state[sv.TORQUE_LEFT] = p[0] * state[sv.TORQUE_LEFT] + p[2]
    state[sv.TORQUE_RIGHT] = p[1] * state[sv.TORQUE_RIGHT] + p[2]


@stage
def asks(state, p):
    """Ask p[0] N of every cable, p[1] m/s of every winch, p[2] for all that is only told."""
    state[sv.TENSION] = p[0]
    state[sv.REEL_RATE] = p[1]
    state[sv.HOLDING] = p[1]
    state[sv.FELT] = p[2]
    state[sv.FORCE] = state[sv.GUIDE] = p[2]
    state[sv.GUIDANCE_LIMIT] = state[sv.FELT_MOST] = p[2]
    state[sv.SHORTFALL] = p[2]


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


@pytest.fixture
def foreign(monkeypatch):
    """Let every machine count as somebody else's."""
    monkeypatch.setattr(table, "is_own", lambda kind: False)


@pytest.mark.parametrize(
    ("left", "right", "share"),
    [
        (-1.0, -1.0, 0.0),
        (1.0, -1.0, 0.0),
        (-1e-9, 1.0, 0.0),
        (np.nan, 1.0, 0.0),
        (1.0, 0.0, 0.0),
        (np.inf, np.inf, 1.0),
        (3.0, 0.25, 0.25),
        (0.25, 0.5, 0.25),
        (1.0, 1.0, 1.0),
    ],
)
def test_both_torques_become_one_share_of_what_safety_let_through(
    monkeypatch, foreign, left, right, share
):
    """So the force at the hand keeps its direction: one torque alone could turn or raise it."""
    whole = rows(monkeypatch)[:, sv.TORQUE]
    turned = Stage("own", sends, np.array([left, right, 0.0]))
    sent = rows(monkeypatch, efforts=(turned,))[:, sv.TORQUE]
    assert np.abs(whole).max() > 0.01
    assert np.allclose(sent, share * whole, rtol=1e-12, atol=0.0)


def test_where_safety_holds_the_force_at_zero_a_foreign_machine_sends_none(monkeypatch, foreign):
    pushes = Stage("own", sends, np.array([1.0, 1.0, 0.3]))
    sent = rows(monkeypatch, efforts=(pushes,))
    held = sent[:, sv.SAFETY_SCALE] == 0.0
    assert held.any()
    assert (sent[held, sv.TORQUE] == 0.0).all()


def after_efforts(profile, armed, *asked):
    """Run one tick's efforts of a machine that asks so, behind a safety that lets pass or not."""
    state = sv.empty_state()
    state[sv.SAFETY_SCALE], state[sv.FORCE], state[sv.GUIDANCE_LIMIT] = armed, 0.5, 2.0
    state[sv.TORQUE] = 0.1, -0.1
    own = [Stage("own", asks, np.array(asked))]
    for function, values in (one[1:] for one in table._guarded("efforts", own, profile)):
        function(state, values)
    return state


@pytest.mark.parametrize("asked", [np.nan, np.inf, -np.inf, 1e308, -1e308, 5.0])
def test_what_a_foreign_machine_asks_of_cables_and_winches_is_finite_and_within_its_limits(
    foreign, asked
):
    profile = load_profile("tensegrity")
    _, most = profile.tension_range
    for armed in (0.0, 1.0):
        state = after_efforts(profile, armed, asked, asked, asked)
        assert ((state[sv.TENSION] >= 0.0) & (state[sv.TENSION] <= most)).all()
        assert (np.abs(state[sv.REEL_RATE]) <= profile.fastest_reel * armed).all()
        assert state[sv.HOLDING] in (0.0, 1.0)
        assert np.isfinite(state).all()
        assert ((state[sv.FORCE] >= 0.0) & (state[sv.FORCE] <= 0.5)).all()
    assert (after_efforts(profile, 1.0, 5.0, 0.0, 0.0)[sv.TENSION] == 5.0).all()


@pytest.mark.parametrize("limit", [np.inf, np.nan, -1.0])
def test_a_foreign_profile_without_a_limit_of_its_cables_is_refused(monkeypatch, foreign, limit):
    kind = type(PROFILE)
    monkeypatch.setattr(kind, "tension_range", property(lambda self: (0.0, limit)))
    with pytest.raises(DeviceError, match=f"largest tension is {limit} N"):
        after_efforts(PROFILE, 1.0, 5.0, 1.0, 0.0)


def test_a_machine_whose_profile_states_no_cables_can_ask_nothing_of_any(foreign):
    state = after_efforts(PROFILE, 1.0, 5.0, 1.0, 0.0)
    assert (state[sv.TENSION] == 0.0).all()
    assert (state[sv.REEL_RATE] == 0.0).all()


def test_the_simulated_machine_of_somebody_else_writes_nothing_of_the_loops_own(foreign):
    """Its plant runs after safety, whose slots go on into the next tick."""

    def last(*plants):
        link = Link.of([], [Stage("plant", *plant) for plant in plants])
        stages = table.machine_stages(PROFILE, [], [], link).write
        state = np.random.default_rng(1).normal(size=sv.SLOTS)
        for stage_ in stages:
            stage_.function(state, stage_.parameters)
        return state

    assert np.array_equal(last((arms_and_lifts, np.full(1, 50.0))), last())


def test_a_foreign_machine_whose_stage_has_the_name_of_another_is_refused(monkeypatch, foreign):
    """By its name memory would go from one table to the next: a latched fault, say."""
    own = Pantograph.stages
    taken = (Stage("safety", lessens, np.zeros(1)),)
    monkeypatch.setattr(Pantograph, "stages", lambda self: replace(own(self), efforts=taken))
    with pytest.raises(DeviceError, match="its stage is named 'safety', and so is another"):
        Rig()
