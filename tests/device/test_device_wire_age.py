"""How old what comes over a wire is: late replies are stale, repeated ones are no news."""

import pytest
from device.wire_rig import PROFILES, MemoryRig

from app.core import state_vector as sv
from app.device.faults import Fault
from app.device.links import host_end as host
from app.device.links import wire
from app.device.links.protocols import speech_of
from app.mechanisms.profile import load_profile


@pytest.mark.parametrize("name", PROFILES)
def test_angles_are_as_old_as_their_question(name):
    rig = MemoryRig(name)
    with rig.loop:
        rig.arm()
        assert rig["time"] - rig["q_time"] == pytest.approx(1e-3)


def test_replies_that_come_30_ms_late_fade_the_force_though_they_come_every_tick():
    rig = MemoryRig("icube")
    with rig.loop:
        rig.arm()
        rig.link.faults.set("delay", 15.0)
        rig.step(500)
        rig.rearm()
        assert rig["time"] - rig["q_time"] >= 0.030
        assert rig["fault"] == Fault.NONE
        assert rig["safety_scale"] < 0.9


def test_a_reply_that_is_repeated_is_no_sign_of_life():
    read, _ = speech_of(load_profile("icube")).stages
    rig = MemoryRig("icube")
    with rig.loop:
        rig.arm()
        end = rig.link._end
        state = rig.loop.latest().row.copy()
        again = wire.incoming(end)[: int(end[wire.IN_COUNT])].copy()
        assert len(again) > 0
        heard = end[host.HEARD]
        for _ in range(3):
            end[wire.NOW] += 1e-3
            wire.incoming(end)[: len(again)] = again
            end[wire.IN_COUNT] = len(again)
            read(state, end)
        assert end[host.HEARD] == pytest.approx(heard + 1e-3)
        assert state[sv.Q_TIME] <= end[host.HEARD]


def test_every_connection_to_a_haply_is_a_power_cycle_that_no_record_knows():
    boots = set()
    for _ in range(20):
        rig = MemoryRig("haply-2diy")
        with rig.loop:
            boots.add(rig.link.info().boot)
    assert len(boots) == 20
    assert min(boots) > 1000, "a record of another program's first connection must not fit"
