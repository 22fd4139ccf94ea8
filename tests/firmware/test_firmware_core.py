"""The board's program against docs/protocol.md, the standard library's CRC, and the emulator."""

import binascii
import math
import re
import struct

import numpy as np
import pytest
from firmware_rig import FIRMWARE, Bench, built
from hypothesis import given, settings
from hypothesis import strategies as st

from app.device.links import acus_protocol as acus
from app.device.links import board as emulated
from app.device.links import board_layout as at
from app.device.links import cable_protocol as cables
from app.device.links import framing, wire
from app.mechanisms.profile import load_profile

NAN = float("nan")


def payloads(data):
    return list(framing.Deframer().feed(data))


def command(sequence=0, enable=True, torques=(0.1, -0.2), flags=None):
    flags = acus.ENABLE * enable if flags is None else flags
    kind = acus.COMMAND if len(torques) == 2 else cables.COMMAND
    return framing.frame(struct.pack(f"<BBH{len(torques)}f", kind, flags, sequence, *torques))


def state(data):
    (one,) = payloads(data)
    names = ("kind", "flags", "sequence", "time", "left", "right", "error")
    return dict(zip(names, struct.unpack("<BBHIiiB", one[:17]), strict=True))


@pytest.fixture
def board():
    return Bench()


@pytest.fixture
def greeted(board):
    board.feed(acus.hello())
    return board


def test_the_checksum_is_the_standard_librarys(board):
    data = bytes(range(200))
    crc = board.lib.frame_crc
    crc.restype = int
    assert board.lib.frame_crc(b"123456789", 9) & 0xFFFF == 0x29B1
    for count in (1, 2, 50, 200):
        assert board.lib.frame_crc(data, count) & 0xFFFF == binascii.crc_hqx(data[:count], 0xFFFF)


def test_the_examples_of_the_page_are_understood_and_answered(board):
    page = (FIRMWARE.parent / "docs" / "protocol.md").read_text(encoding="utf-8")
    sent = re.findall(r"^((?:[0-9a-f]{2} )+)= (HELLO|COMMAND|HOME)", page, re.MULTILINE)
    assert [name for _, name in sent] == ["HELLO", "COMMAND", "HOME"]
    hello, obeyed, home = (bytes.fromhex(text) for text, _ in sent)
    assert acus.read_info(payloads(board.feed(hello))[0])[0].profile == "icube"
    found = state(board.feed(obeyed))
    assert (found["sequence"], found["flags"]) == (258, acus.ENABLED | acus.GREETED)
    # 0.25 and -0.125 N·m by the gear and the torque constant of the profile
    motor = load_profile("icube")
    per_ampere = motor.inertia.gear * motor.motor.torque_constant
    assert list(board.current) == pytest.approx([0.25 / per_ampere, -0.125 / per_ampere])
    board.feed(home)  # while enabled
    assert (board.state, board.error, board.pushes) == ("REFUSED", 2, False)


def test_a_board_gives_no_torque_before_it_is_greeted_in_its_version(board):
    found = state(board.feed(command()))
    assert found["flags"] == 0
    (info,) = payloads(board.feed(acus.hello(7)))
    assert (info[0], info[1], board.state) == (acus.INFO, 1, "BOOT")
    assert state(board.feed(command()))["flags"] == 0
    assert not board.pushes


def test_the_watchdog_stops_the_motors_before_twenty_milliseconds(greeted):
    greeted.feed(command())
    greeted.tick(17)
    assert greeted.pushes
    greeted.tick(2)
    assert not greeted.pushes
    found = state(greeted.feed(command(enable=False)))
    assert found["flags"] == acus.TRIPPED | acus.GREETED
    assert state(greeted.feed(command()))["flags"] == acus.ENABLED | acus.GREETED


def test_the_watchdog_works_across_the_end_of_the_clock(board):
    board.now.value = (1 << 32) - 5000
    board.feed(acus.hello() + command())
    board.tick(17)
    assert board.pushes
    board.tick(2)
    assert not board.pushes


@pytest.mark.parametrize("feed", [b"\x00", b"\x05\x02", bytes(range(1, 200)), acus.home(1)])
def test_only_a_command_keeps_the_motors_on(greeted, feed):
    greeted.feed(command())
    for _ in range(19):
        greeted.feed(feed)
        greeted.tick()
    assert not greeted.pushes


@pytest.mark.parametrize("torques", [(NAN, 0.0), (0.0, NAN), (math.inf, 0.0), (-math.inf, 1.0)])
def test_a_torque_that_is_not_finite_stops_until_the_next_good_command(greeted, torques):
    greeted.feed(command())
    found = state(greeted.feed(command(1, torques=torques)))
    assert (found["error"], found["flags"] & acus.ENABLED, greeted.pushes) == (1, 0, False)
    assert state(greeted.feed(command(2)))["error"] == 0
    assert greeted.pushes


@pytest.mark.parametrize("torques", [(1.2, -0.3), (-0.1, 600.0), (3e38, 3e38), (0.61, 0.0)])
def test_both_torques_are_scaled_down_together_and_it_is_said(greeted, torques):
    found = state(greeted.feed(command(torques=torques)))
    assert found["flags"] & acus.LIMITED
    profile = load_profile("icube")
    most = profile.limits.joint_torque / (profile.inertia.gear * profile.motor.torque_constant)
    wanted = np.array(torques) * (most / max(map(abs, torques)))
    assert list(greeted.current) == pytest.approx(wanted.tolist())
    assert not state(greeted.feed(command(torques=(0.6, -0.6))))["flags"] & acus.LIMITED


@pytest.mark.parametrize(
    ("name", "value", "error", "ticks"),
    [("hottest", 95.0, 6, 3), ("hottest", NAN, 6, 3), ("supply", 11.0, 5, 3),
     ("supply", NAN, 5, 3), ("ready", False, 4, 1)],
)  # fmt: skip
def test_heat_supply_and_amplifiers_stop_it_until_it_is_greeted(greeted, name, value, error, ticks):
    sound = getattr(greeted.health, name)
    for k in range(6):
        greeted.feed(command(k))
        if k == 1:
            setattr(greeted.health, name, value)
        assert greeted.pushes is (k < 1 + ticks), k
        greeted.tick()
    greeted.feed(acus.hello() + command())  # it is still so
    assert (greeted.error, greeted.pushes) == (error, False)
    setattr(greeted.health, name, sound)
    greeted.tick(5)
    found = state(greeted.feed(command()))
    assert (found["error"], greeted.state) == (error, "FAULT")
    greeted.feed(acus.hello() + command())
    assert (greeted.error, greeted.pushes) == (0, True)


def test_a_moment_of_low_supply_counts_for_nothing(greeted):
    for _ in range(3):
        greeted.health.supply = 10.0
        greeted.tick(2)
        greeted.health.supply = 24.0
        greeted.tick(1)
    assert greeted.error == 0


def test_a_smaller_error_does_not_hide_a_greater_one(greeted):
    greeted.health.ready = False
    greeted.tick()
    greeted.health.ready = True
    greeted.feed(command(torques=(NAN, NAN)) + command() + acus.home(9) + acus.home(1))
    assert (greeted.error, greeted.state) == (4, "FAULT")


def test_counters_of_16_bits_are_counted_on_both_ways(greeted):
    position = 0
    for step in [2400] * 100 + [-2400] * 180:
        position += step
        greeted.encoders[0], greeted.encoders[1] = position & 0xFFFF, -position & 0xFFFF
        found = state(greeted.feed(command(enable=False)))
        assert (found["left"], found["right"], found["error"]) == (position, -position, 0)
    assert position < -(1 << 16)


def test_home_begins_the_counters_anew_in_this_power_cycle_only(board):
    board.feed(acus.hello())
    board.encoders[0], board.encoders[1] = 1500, 64000
    board.feed(acus.home(2))
    assert (board.state, state(board.feed(command()))["error"]) == ("REFUSED", 2)
    board.feed(acus.home(1))
    found = state(board.feed(command(enable=False)))
    assert (found["left"], found["right"], found["flags"]) == (0, 0, acus.HOMED | acus.GREETED)


def test_an_encoder_that_leaps_or_loses_counts_stops_the_motors(greeted):
    greeted.feed(command())
    greeted.encoders[0] = 2501
    greeted.tick()
    assert (greeted.error, greeted.pushes) == (3, False)
    greeted.feed(acus.hello() + command())
    assert greeted.pushes
    for k, (here, sound) in enumerate(
        [(2600, True), (4602, True), (597, True), (4597, True), (2620, False)]
    ):
        while greeted.encoders[0] != here:
            way = max(-2000, min(2000, here - greeted.encoders[0]))
            greeted.encoders[0] += way
            greeted.tick()
        greeted.index[0], greeted.latched[0] = True, here
        greeted.tick()
        assert (greeted.error == 0) is sound, k


@pytest.mark.parametrize("leap", [2501, -2501])
def test_an_index_does_not_make_good_a_leap(greeted, leap):
    greeted.encoders[1] = leap & 0xFFFF
    greeted.index[1], greeted.latched[1] = True, leap & 0xFFFF
    greeted.tick()
    assert (greeted.error, greeted.state) == (3, "FAULT")


def test_an_overlong_frame_is_dropped_with_whatever_stands_in_it(greeted):
    whole = command(7)
    assert greeted.feed(b"\x41" * 68 + whole) == b""
    assert state(greeted.feed(whole))["sequence"] == 7
    assert greeted.feed(b"\x44" * 67 + b"\x00") == b""


def test_the_devices_numbers_are_the_profiles():
    for device in ("icube", "tensegrity"):
        text = (FIRMWARE / "devices" / f"{device}.h").read_text(encoding="utf-8")
        numbers = {
            name: float(value) for name, value in re.findall(r"#define (\w+) ([\d.]+)[fU]?\b", text)
        }
        profile = load_profile(device)
        assert f'"{profile.name}"' in text
        assert numbers["COUNTS_PER_TURN"] == profile.encoder.counts_per_turn
        assert numbers["WATCHDOG_MS"] == profile.wire.watchdog_ms
        assert numbers["LARGEST_CURRENT"] == profile.motor.largest_current
        if device == "icube":
            assert numbers["GEAR"] == profile.inertia.gear
            assert numbers["JOINT_TORQUE"] == profile.limits.joint_torque
            assert numbers["TORQUE_CONSTANT"] == profile.motor.torque_constant
            assert numbers["INDEX_PERIOD"] * numbers["GEAR"] == numbers["COUNTS_PER_TURN"]
        else:
            assert numbers["TENSION"] == profile.tension_range[1]
            assert numbers["FASTEST"] == profile.fastest_reel


class Emulated:
    """The emulator's board in memory, fed like a `Bench`."""

    def __init__(self, name):
        self.profile = load_profile(name)
        self.array = np.zeros(emulated.SIZE)[: at.SIZE]
        self.array[:] = at.new_board(self.profile, "A0001", boot=0)
        self.now = 0.0
        emulated.work(self.array, self.now)

    def feed(self, data):
        answer = b""
        for start in range(0, len(data), 100):
            piece = data[start : start + 100]
            wire.incoming(self.array)[: len(piece)] = np.frombuffer(piece, np.uint8)
            self.array[wire.IN_COUNT] = len(piece)
            emulated.work(self.array, self.now)
            count = int(self.array[wire.OUT_COUNT])
            answer += wire.outgoing(self.array)[:count].tobytes()
            self.array[wire.OUT_COUNT] = 0.0
        return answer


SINGLES = st.floats(width=32) | st.sampled_from([0.0, -0.0, 0.6, 0.5, -0.7, 200.0, -0.25, 0.25])


@pytest.mark.parametrize("device", ["icube", "tensegrity"])
def test_messages_as_long_as_known_ones_but_of_another_type_are_ignored(device):
    channels = 2 if device == "icube" else 4
    kind = acus.COMMAND if channels == 2 else cables.COMMAND
    command = framing.frame(struct.pack(f"<BBH{channels}f", kind, 1, 7, *[0.0] * channels))
    board = Bench(device)
    assert board.feed(acus.hello()) != b""
    for known in (acus.hello(), command, acus.home(1)):
        length = len(next(framing.Deframer().feed(known)))
        for other in (0x00, 0x7F, 0xFF):
            assert board.feed(framing.frame(bytes([other]) + bytes(length - 1))) == b""
    assert board.feed(command) != b""


def requests(channels):
    kind = acus.COMMAND if channels == 2 else cables.COMMAND
    commands = st.builds(
        lambda flags, sequence, torques: framing.frame(
            struct.pack(f"<BBH{channels}f", kind, flags, sequence, *torques)
        ),
        st.sampled_from([0, 1, 2, 3, 255]),
        st.integers(0, 65535),
        st.lists(SINGLES, min_size=channels, max_size=channels),
    )
    hellos = st.sampled_from([acus.hello(n) for n in (1, 2, 3)])
    homes = st.sampled_from([acus.home(n) for n in (1, 2)])
    junk = st.binary(min_size=1, max_size=90) | st.binary(min_size=1, max_size=64).map(
        framing.frame
    )
    times = st.sampled_from([1, 2, 5, 16, 20, 40]) | st.integers(1, 60)
    joint = st.integers(-40, 40)
    return st.lists(
        st.tuples(st.one_of(hellos, commands, commands, commands, homes, junk), times, joint),
        max_size=25,
    )


@pytest.mark.long("machine")
@pytest.mark.parametrize("device", ["icube", "tensegrity"])
def test_frames_are_the_emulators_to_the_byte(device):
    built("bench", device)
    pantograph = load_profile("icube")
    torque_per_ampere = pantograph.inertia.gear * pantograph.motor.torque_constant

    @settings(max_examples=200)
    @given(requests(2 if device == "icube" else 4))
    def same(steps):
        board, other = Bench(device), Emulated(device)
        assert board.feed(acus.hello()) == other.feed(acus.hello())
        position = 0
        for data, milliseconds, turned in steps:
            if milliseconds in (17, 18, 19):  # either may trip here: both must by 20 ms
                milliseconds = 16
            for _ in range(milliseconds):
                board.tick()
                other.now = board.now.value * 1e-6 + 1e-9
                emulated.work(other.array, other.now)
            position += turned
            for k, way in enumerate((position, -position)):
                board.encoders[k] = way & 0xFFFF
                other.array[at.Q + k] = way * other.array[at.STEP]
            for k in range(board.channels if device == "tensegrity" else 0):
                board.tension[k] = other.array[at.CABLE + k] = k + 0.5
                board.reeled[k] = other.array[at.REEL + k] = -0.25 * k
            assert board.feed(data).hex() == other.feed(data).hex()
            driven = other.array[[at.TORQUE, at.TORQUE + 1]].any() or (
                other.array[at.PULL : at.PULL + 4].any()
            )
            assert board.pushes == (bool(driven) and bool(other.array[at.ENABLED]))
            if board.pushes and device == "icube":
                told = other.array[at.TORQUE : at.TORQUE + 2]
                assert np.array(board.current) * torque_per_ampere == pytest.approx(told, abs=1e-6)

    same()
