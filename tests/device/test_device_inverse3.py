"""A Haply Inverse3 against a scripted service: what is said and given, and no force on a fault.

Nobody had the device: every claim here is about the maker's published pages.
"""

import json
import socket
import time

import numpy as np
import pytest
from device.inverse3_rig import DEVICE, ScriptedService
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.device.control import Loop, machine_stages
from app.device.errors import BoardVersionError, LinkError
from app.device.links import inverse3, inverse_service
from app.device.links.inverse3 import ANSWER_WITHIN, Inverse3Link, robot_link
from app.device.links.inverse_bridge import Impersonated
from app.device.links.inverse_service import (
    NO_FORCE,
    Cursor,
    InverseService,
    answering,
    refuse_inverse3,
)
from app.device.links.link import LinkStatus
from app.device.links.serial_link import SerialLink
from app.device.readiness import Readiness
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
ENTRY = np.array([0.0, -0.12, 0.0])  # in the service's frame, by default
L_OUT = 0.19


def hub(tilt_deg, azimuth_deg=0.0, l_out=L_OUT):
    """Place [m] of the hub in the service's frame: the needle leans so, its tip the other way."""
    tilt, azimuth = np.radians([tilt_deg, azimuth_deg])
    up = np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), np.cos(tilt)])
    return tuple((ENTRY + l_out * up).tolist())


@pytest.fixture(autouse=True)
def own_settings(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path))


@pytest.fixture
def service():
    service = ScriptedService(hub(0.0))
    yield service
    service.close()


def wait(ready, seconds=30.0, what="it"):
    end = time.monotonic() + seconds
    while not ready():
        assert time.monotonic() < end, f"waited too long for {what}"
        time.sleep(0.005)


# --- the service ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "host", "port"),
    [
        ("haply:", "localhost", 10001),
        ("haply:lab", "lab", 10001),
        ("haply:lab:7", "lab", 7),
        ("haply:[::1]:7", "::1", 7),
    ],
)
def test_a_port_named_haply_is_a_service(name, host, port):
    service = InverseService(name)
    assert (service._host, service._port) == (host, port)
    assert isinstance(robot_link(name, PROFILE), Inverse3Link)
    assert type(robot_link("/dev/ttyACM0", PROFILE)) is SerialLink


@pytest.mark.parametrize("name", ["haply:lab:x", "haply:lab:70000", "haply:a/b", "haply:me@lab"])
def test_what_is_no_address_is_refused_with_what_would_be(name):
    with pytest.raises(LinkError, match="valid are haply:, haply:HOST and haply:HOST:PORT"):
        InverseService(name)


def test_the_first_message_greets_and_every_one_gives_a_force(service):
    mine = InverseService(service.name)
    assert mine.open() == Cursor(*hub(0.0))
    assert (mine.device, mine.version) == (DEVICE, "3.5.0.0")
    service.place = (0.01, -0.11, 0.2)
    assert mine.turn((0.1, 0.2, -0.3), 5.0) == Cursor(0.01, -0.11, 0.2)
    mine.turn((0.0, 0.0, 0.5), 5.0)
    mine.close()
    mine.close()
    wait(lambda: len(service.forces) == 3)
    assert [force for _, force in service.forces] == [(0.1, 0.2, -0.3), (0, 0, 0.5), NO_FORCE]
    assert service.messages[0]["session"]["configure"]["basis"] == {"permutation": "XYZ"}
    assert not any("session" in message for message in service.messages[1:])


@pytest.mark.parametrize(("version", "key"), [("3.1.2", "values"), (None, "values")])
def test_an_older_service_gets_its_force_under_its_older_name(version, key):
    service = ScriptedService(hub(0.0), version=version, key=key)
    mine = InverseService(service.name)
    mine.open()
    mine.turn((0.1, 0.2, 0.3), 5.0)
    assert service.force() == (0.1, 0.2, 0.3)
    mine.close()
    service.close()


def test_a_service_that_is_not_there_is_named_with_what_to_start(service):
    service.close()
    with pytest.raises(LinkError, match=r"no Haply service answers at localhost port \d+ .*start"):
        InverseService(service.name).open()


@pytest.mark.parametrize("version", ["4.0.0", "2.9", "unreleased"])
def test_another_major_version_is_refused_by_name(version):
    service = ScriptedService(hub(0.0), version=version)
    with pytest.raises(BoardVersionError, match=f"speaks version {version}, this program 3.1"):
        InverseService(service.name).open()
    assert service.greetings == 0
    service.close()


def without_devices(inventory):
    return inventory | {"inverse3": []}


def of_version_3_0(inventory):
    return {"inverse3": {DEVICE: inventory["inverse3"][0]}}


def without_name(inventory):
    del inventory["inverse3"][0]["device_id"]
    return inventory


def badly_named(inventory):
    inventory["inverse3"][0]["device_id"] = "../../etc"
    return inventory


@pytest.mark.parametrize(
    ("inventory", "family", "message"),
    [
        (without_devices, LinkError, "no Inverse3 is plugged in"),
        (of_version_3_0, BoardVersionError, r"speaks version 3\.0, this program 3\.1 to 3\.5"),
        (lambda inventory: {"hello": 1}, BoardVersionError, "speaks version unknown"),
        (without_name, LinkError, "names no device"),
        (badly_named, LinkError, "names no device"),
    ],
)
def test_an_inventory_of_no_use_is_refused(service, inventory, family, message):
    service.inventory = inventory
    with pytest.raises(family, match=message):
        InverseService(service.name).open()


@pytest.mark.parametrize("scale", [2.0, -1.0, float("nan"), "one"])
def test_a_mount_that_scales_is_refused(scale):
    service = ScriptedService(hub(0.0), scale=scale)
    with pytest.raises(LinkError, match="its mount is scaled"):
        InverseService(service.name).open()
    service.close()


def at(*place):
    def script(state):
        state["inverse3"][0]["state"]["cursor_position"] = dict(zip("xyz", place, strict=True))
        return json.dumps(state)  # NaN and Infinity as Python writes them

    return script


def other_device(state):
    state["inverse3"][0]["device_id"] = "0BAD"
    return state


def without_state(state):
    del state["inverse3"][0]["state"]
    return state


FAULTS = {
    "NaN": (at(float("nan"), 0.0, 0.2), "which is no place"),
    "infinite": (at(0.0, float("inf"), 0.2), "which is no place"),
    "1e308": (at(1e308, 1e308, 0.2), "which is no place"),
    "a number of 300 digits": (at(0.0, 10**300, 0.2), "which is no place"),
    "text": (at("0.1", 0.0, 0.2), "cannot be used"),
    "nothing": (at(None, 0.0, 0.2), "cannot be used"),
    "no state": (without_state, "sends no position"),
    "another device": (other_device, "another is there"),
    "unplugged": (without_devices, "no Inverse3 is plugged in"),
    "of 3.0": (of_version_3_0, r"speaks version 3\.0"),
    "garbage": (lambda state: "\\x00{]", "sends no JSON"),
    "binary garbage": (lambda state: bytes(range(256)), "sends no JSON"),
    "a list": (lambda state: "[1, 2]", "sends no state"),
    "deep": (lambda state: "[" * 100_000, "cannot be used"),
    "oversize": (lambda state: " " * (1 << 18) + "{}", "is gone"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_state_of_no_use_is_refused_with_the_reason(service, name):
    script, message = FAULTS[name]
    mine = InverseService(service.name)
    mine.open()
    service.script = script
    with pytest.raises(LinkError, match=message):
        mine.turn((0.1, 0.0, 0.0), 5.0)
    mine.close()


def test_a_service_that_hangs_is_given_no_force_once_and_what_it_says_late_is_no_answer(service):
    mine = InverseService(service.name)
    mine.open()
    service.script = lambda state: None
    begin = time.monotonic()
    assert mine.turn((0.5, 0.0, 0.0), ANSWER_WITHIN) is None
    assert time.monotonic() - begin >= ANSWER_WITHIN
    assert mine.turn((0.5, 0.0, 0.0), ANSWER_WITHIN) is None
    wait(lambda: len(service.forces) == 2)
    assert [force for _, force in service.forces] == [(0.5, 0.0, 0.0), NO_FORCE]
    assert mine._owed == 2
    mine.close()


def test_what_comes_unasked_is_passed_over_and_a_flood_ends_it(service):
    mine = InverseService(service.name)
    mine.open()

    def repeated(times):
        def script(state):
            for connection in service._open:
                for _ in range(times):
                    connection.send(json.dumps(state))
            return state

        return script

    service.script = repeated(3)
    for k in range(3):
        service.place = hub(float(k))
        assert mine.turn(NO_FORCE, 5.0) == Cursor(*service.place)
        time.sleep(0.1)
    service.script = repeated(500)
    mine.turn(NO_FORCE, 5.0)
    time.sleep(0.1)
    with pytest.raises(LinkError, match="does not stop sending"):
        mine.turn(NO_FORCE, 5.0)
    mine.close()


# --- the pantograph that is played ----------------------------------------------------------------


def played():
    return Impersonated(PROFILE, tuple(ENTRY))


@pytest.mark.parametrize("tilt", [0.0, 5.0, 20.0, 38.9])
@pytest.mark.parametrize("azimuth", [0.0, 70.0, 200.0, 300.0])
def test_the_hub_is_the_needle_that_the_machine_would_hold(tilt, azimuth):
    pose = played().pose(Cursor(*hub(tilt, azimuth)))
    away = np.array(hub(tilt, azimuth)) - ENTRY
    assert pose.hub.inside
    assert pose.hub.l_out == pytest.approx(L_OUT)
    np.testing.assert_allclose(PROFILE.machine.axis(pose.q), -away / L_OUT, atol=1e-9)


@pytest.mark.parametrize("tilt", [0.0, 12.0, 35.0])
def test_the_force_is_that_of_the_torques_by_the_machines_own_moment(tilt):
    """Another way: the moment about the entry, made by a force across the needle at the hub."""
    place, torques = hub(tilt, 130.0), (0.03, -0.02)
    pose = played().pose(Cursor(*place))
    force = np.array(played().force(pose, torques))
    arm = np.array(place) - ENTRY
    np.testing.assert_allclose(
        np.cross(arm, force), PROFILE.machine.moment(pose.q, torques), atol=1e-9
    )
    assert force @ arm == pytest.approx(0.0, abs=1e-12)


def test_no_torque_makes_more_than_one_newton():
    pose = played().pose(Cursor(*hub(10.0)))
    for torques in ((0.6, 0.6), (1e30, -1e30), (-0.6, 0.2)):
        assert np.linalg.norm(played().force(pose, torques)) <= 1.0 + 1e-12
    for torques in ((float("nan"), 0.0), (float("inf"), 0.0)):
        assert played().force(pose, torques) == NO_FORCE


@pytest.mark.parametrize(
    "place",
    [hub(39.5), hub(89.9), hub(120.0), hub(179.0), hub(5.0, l_out=0.029), hub(5.0, l_out=1e-300)],
)
def test_a_hub_where_no_needle_can_be_has_no_force_and_the_nearest_pose(place):
    pose = played().pose(Cursor(*place))
    assert pose is None or not pose.hub.inside
    if pose is not None:
        assert np.isfinite(pose.q).all()
        assert played().force(pose, (0.1, 0.1)) == NO_FORCE


@pytest.mark.parametrize("place", [tuple(ENTRY), hub(180.0), (0.0, -0.12, -1e-320)])
def test_a_hub_at_the_entry_or_straight_below_it_is_nowhere_or_outside(place):
    pose = played().pose(Cursor(*place))
    assert pose is None or not pose.hub.inside


# --- in the loop ----------------------------------------------------------------------------------


@pytest.fixture
def patient(monkeypatch):
    """Wait five times as long for an answer: the computer of the tests has much else to do."""
    monkeypatch.setattr(inverse3, "ANSWER_WITHIN", 0.1)


SLOW = PROFILE.model_copy(update={"wire": PROFILE.wire.model_copy(update={"watchdog_ms": 100.0})})


class Running:
    """A loop with the guidance towards the vertical, armed again after every fault."""

    def __init__(self, service):
        self.link = Inverse3Link(service.name, SLOW)
        table = machine_stages(
            PROFILE, [VirtualFixture.of(PROFILE).stage()], [], self.link.stages()
        )
        self.loop = Loop(table, PROFILE.rate_hz, link=self.link)
        self.arms, self.said = True, []

    def __enter__(self):
        self.loop.open()
        self.loop.inbox.write(homed=1.0, force_cap=1.0, assistance=1.0, path_z=-1.0)
        return self

    def __exit__(self, *_):
        self.loop.close()

    def row(self):
        """Look at the loop as a window does: a sign of life, the depth, forces on again."""
        now, row = time.monotonic(), self.loop.latest().row
        self.loop.inbox.write(
            heartbeat=now,
            enabled=float(self.arms and row[sv.FAULT] == 0.0),
            tracked_depth=PROFILE.needle_length - L_OUT,
            tracked_time=now,
            tracked_variance=1e-8,
        )
        self.said += [event.message for event in self.link.events.drain()]
        return row

    def until(self, ready, what="it", seconds=60.0):
        wait(lambda: ready(self.row()), seconds, what)


def size(force):
    return float(np.linalg.norm(force))


TILT = 1.5
WANTED = PROFILE.fixture.stiffness * np.radians(TILT)
"""K times the angle, in newtons: 0.75."""


def pushes(service):
    since = len(service.forces)
    return lambda row: any(abs(size(f) - WANTED) < 0.03 for _, f in service.forces[since:])


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
@pytest.mark.usefixtures("patient")
def test_the_cursor_is_pushed_as_the_law_says(service):
    service.place = hub(TILT, 40.0)
    with Running(service) as running:
        running.until(pushes(service), "the guidance's force")
        end, kept = time.monotonic() + 3.0, []
        while time.monotonic() < end:
            running.row()
            kept.append(service.force())
            time.sleep(0.01)
        assert max(map(size, kept)) < WANTED + 0.03
        force = np.array(next(f for f in reversed(kept) if abs(size(f) - WANTED) < 0.03))
    # Guided to the vertical: the hub is pushed back over the entry, across the needle.
    up = (np.array(service.place) - ENTRY) / L_OUT
    wanted = np.array([0.0, 0.0, 1.0]) - up[2] * up
    assert force @ wanted / size(wanted) == pytest.approx(WANTED, abs=0.03)
    wait(lambda: size(service.force()) == 0.0)  # it is closed: the last word is no force


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
@pytest.mark.usefixtures("patient")
@pytest.mark.parametrize("name", ["NaN", "another device", "unplugged", "garbage"])
def test_each_fault_ends_at_no_force_says_why_and_is_over_when_it_is(service, name):
    service.place = hub(TILT, 40.0)
    script, message = FAULTS[name]
    with Running(service) as running:
        running.until(pushes(service), "the guidance's force")
        running.said.clear()
        service.script = script
        running.until(lambda row: row[sv.LINK_STATUS] != LinkStatus.FINE, "the loop to see it")
        running.until(lambda row: size(service.force()) == 0.0 and not service._open, "no force")
        after = len(service.forces)
        running.until(
            lambda row: any(message.replace("\\", "") in s for s in running.said), message
        )
        assert all(size(force) == 0.0 for _, force in service.forces[after:])
        service.script = lambda state: state
        running.until(pushes(service), "the force again")


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
@pytest.mark.usefixtures("patient")
def test_a_service_that_hangs_does_not_answer_and_gives_no_force(service):
    service.place = hub(TILT, 40.0)
    with Running(service) as running:
        running.until(pushes(service), "the guidance's force")
        running.said.clear()
        service.script = lambda state: None
        hung = time.monotonic()
        running.until(lambda row: size(service.force()) == 0.0, "no force")
        assert (
            time.monotonic() - hung < 2.0
        )  # 20 ms, and here 100, where the computer has nothing else to do
        running.until(lambda row: row[sv.LINK_STATUS] != LinkStatus.FINE, "the loop to see it")
        running.until(lambda row: any("does not answer" in said for said in running.said))


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
@pytest.mark.usefixtures("patient")
def test_a_service_that_goes_and_comes_back_is_found_again(service):
    service.place = hub(TILT, 40.0)
    with Running(service) as running:
        running.until(pushes(service), "the guidance's force")
        service.close()
        running.until(lambda row: row[sv.LINK_STATUS] != LinkStatus.FINE, "the loop to see it")
        running.until(lambda row: any("no Haply service answers" in s for s in running.said))
        again = ScriptedService(hub(TILT, 40.0), port=service.port)
        running.until(pushes(again), "the force again")
        again.close()


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
@pytest.mark.usefixtures("patient")
def test_a_device_without_its_zero_and_one_without_power_get_no_force(service):
    service.place = hub(TILT, 40.0)
    service.status = {"calibrated": False, "power_supply": True}
    with Running(service) as running:
        running.until(lambda row: row[sv.Q_TIME] > 0.0)
        end = time.monotonic() + 0.5
        running.until(lambda row: time.monotonic() > end)
        service.status = {"calibrated": True, "power_supply": False}
        running.until(lambda row: row[sv.BOARD_ERROR] != 0.0, "the error")
        assert all(size(force) == 0.0 for _, force in service.forces)
        service.status = {"calibrated": True, "power_supply": True}
        running.until(pushes(service), "the force")


@pytest.mark.long("journey")
@pytest.mark.timeout(300)
@pytest.mark.usefixtures("patient")
def test_a_hub_led_out_of_the_cone_feels_nothing_and_the_force_comes_back_by_and_by(service):
    service.place = hub(TILT, 40.0)
    with Running(service) as running:
        running.until(pushes(service), "the guidance's force")
        service.place = hub(100.0, 40.0)
        running.until(lambda row: size(service.force()) == 0.0, "no force")
        running.until(
            lambda row: not running.link.hub.latest.read().value.inside, "the hub outside"
        )
        service.place = hub(TILT, 40.0)
        running.until(pushes(service), "the force again")


def test_what_is_no_pantograph_and_what_is_no_board_are_refused(service):
    with pytest.raises(LinkError, match=r"an Inverse3 stands in for a pantograph; .* tensegrity"):
        Inverse3Link(service.name, load_profile("tensegrity")).open()
    with pytest.raises(LinkError, match="nothing to commission"):
        refuse_inverse3(service.name)
    refuse_inverse3("/dev/ttyACM0")


def test_who_answers_is_told_and_held_to_one_newton(service):
    link = Inverse3Link(service.name, PROFILE)
    link.open()
    info = link.info()
    link.close()
    assert (info.serial, info.firmware, info.protocol) == (DEVICE, "3.5.0.0", "haply inverse3")
    assert info.kind == "real"
    clearance = Readiness().clearance(info, PROFILE)
    assert (clearance.homed, clearance.force_cap) == (1.0, 1.0)
    assert "never weighed" in clearance.reason


def test_a_service_is_found_by_its_inventory_and_told_nothing(service, monkeypatch):
    monkeypatch.setattr(inverse_service, "PORT", service.port)
    assert answering(2.0) == DEVICE
    assert service.messages == []
    service.inventory = without_devices
    assert answering(2.0) == ""
    service.inventory = lambda inventory: {"hello": []}
    assert answering(2.0) is None
    service.close()
    begin = time.monotonic()
    assert answering(2.0) is None
    assert time.monotonic() - begin < 1.0


def test_whoever_takes_the_connection_and_says_nothing_is_no_service(monkeypatch):
    with socket.create_server(("127.0.0.1", 0)) as mute:
        monkeypatch.setattr(inverse_service, "PORT", mute.getsockname()[1])
        begin = time.monotonic()
        assert answering(0.2) is None
        assert time.monotonic() - begin < 2.0
