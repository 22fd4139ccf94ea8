"""Hours of faults on a virtual clock: never a torque above the limit, zero after a loss.

Five minutes for each protocol here; `ACUS_WIRE_MINUTES=60` runs an hour for each.
"""

import os

import numpy as np
import pytest
from device.wire_rig import PROFILES, MemoryRig

from app.core import state_vector as sv
from app.core.compiled import stage
from app.device.links import board_layout as at

MINUTES = float(os.environ.get("ACUS_WIRE_MINUTES", "5"))
CHUNK = 400
CALM = {"drop": 0.02, "garble": 0.02, "delay": 1.0, "cut": 0.0, "freeze": 0.0, "error": 0.0}

_CLOCK_STEP = 1e-6


@stage
def watch_motors(state, box):
    """After the board, before the plant: what its motors do against what they may.

    Slots that nobody uses here keep the score: TARGET_SHIFT_X the largest torque, TARGET_SHIFT_Y
    ticks with a torque, TARGET_SHIFT_Z torques that are no number, TRAINEE_PHASE ticks with a
    torque more than the watchdog's time after the newest command.
    """
    largest = max(abs(state[sv.TORQUE_LEFT]), abs(state[sv.TORQUE_RIGHT]))
    if not np.isfinite(state[sv.TORQUE_LEFT] + state[sv.TORQUE_RIGHT]):
        state[sv.TARGET_SHIFT_Z] += 1.0
    state[sv.TARGET_SHIFT_X] = max(state[sv.TARGET_SHIFT_X], largest)
    if largest > 0.0:
        state[sv.TARGET_SHIFT_Y] += 1.0
        if state[sv.TIME] - box[at.COMMANDED] > box[at.WATCHDOG] + _CLOCK_STEP:
            state[sv.TRAINEE_PHASE] += 1.0


def shake(rig, rng, calm):
    """Switch faults on and off at random; while calm, the wire is only a little bad."""
    faults = rig.link.faults
    if calm:
        for name, value in CALM.items():
            faults.set(name, value)
        return
    faults.set("drop", rng.choice([0.0, 0.0, 0.02, 0.3]))
    faults.set("garble", rng.choice([0.0, 0.0, 0.02, 0.3]))
    faults.set("delay", rng.choice([0.0, 0.0, 2.0, 12.0]))
    faults.set("cut", rng.random() < 0.08)
    faults.set("freeze", rng.random() < 0.05)
    faults.set("error", rng.choice([0.0] * 9 + [3.0]))


def restart(rig):
    """Power off and on, and greet again, as the supervisor of a serial link does."""
    for name in CALM:
        rig.link.faults.set(name, 0)
    rig.link.faults.set("reset", 1)
    rig.step(50)
    assert rig.torque == 0.0
    rig.link.open()


@pytest.mark.long("machine")
@pytest.mark.timeout(900)
@pytest.mark.parametrize("name", PROFILES)
def test_random_faults_never_give_a_torque_above_the_limit(name):
    rig = MemoryRig(name, seed=5, watch=watch_motors)
    rng = np.random.default_rng(7)
    ticks = round(MINUTES * 60 * rig.profile.rate_hz)
    with rig.loop:
        rig.loop.inbox.write(homed=1.0, force_cap=5.0, enabled=1.0, assistance=1.0)
        for k in range(ticks // CHUNK):
            rig.loop.inbox.write(enabled=float(k % 8 != 0))  # a latched fault ends by disarming
            shake(rig, rng, calm=k % 8 < 6)
            direction = rng.uniform(-0.3, 0.3, 2)
            rig.loop.inbox.write(path_x=direction[0], path_y=direction[1], path_z=-0.9)
            rig.step(CHUNK)
            if k % 100 == 99:
                restart(rig)
        assert rig["tick"] >= ticks - CHUNK
        assert rig["target_shift_z"] == 0
        assert rig["target_shift_x"] <= rig.profile.limits.joint_torque * (1.0 + 1e-7)
        assert rig["trainee_phase"] == 0
        assert rig["target_shift_y"] > 0.2 * ticks, "a run without force shows nothing"
        assert rig["link_errors"] > 100
