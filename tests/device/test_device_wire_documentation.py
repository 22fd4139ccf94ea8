"""docs/protocol.md says what the program does: its examples are decoded, its numbers compared."""

import re
import struct
from pathlib import Path

import numpy as np
import pytest

from app.device.control.plausibility import FARTHEST, FASTEST, PATIENCE
from app.device.links import acus_protocol as acus
from app.device.links import cable_protocol as cables
from app.device.links import framing
from app.device.links import haply_protocol as haply
from app.mechanisms.profile import load_profile

PAGE = (Path(__file__).parents[2] / "docs" / "protocol.md").read_text(encoding="utf-8")
EXAMPLES = {
    text.strip(): bytes.fromhex(data)
    for data, text in re.findall(r"^((?:[0-9a-f]{2} )+)= (.*)$", PAGE, re.MULTILINE)
}


def example(beginning):
    (data,) = [data for text, data in EXAMPLES.items() if text.startswith(beginning)]
    return data


def message(beginning):
    (payload,) = framing.Deframer().feed(example(beginning))
    return payload


def test_the_page_has_an_example_of_every_message():
    assert len(EXAMPLES) == 13


def test_the_greeting_on_the_page_is_what_the_program_sends():
    assert example("HELLO") == acus.hello()


def test_the_command_on_the_page_decodes_by_its_table():
    kind, flags, sequence, left, right = struct.unpack("<BBHff", message("COMMAND"))
    assert (kind, flags, sequence, left, right) == (acus.COMMAND, acus.ENABLE, 258, 0.25, -0.125)
    assert len(message("COMMAND")) == acus.COMMAND_BYTES


def test_the_homing_on_the_page_is_what_the_program_sends():
    assert example("HOME") == acus.home(0x1234)


@pytest.mark.parametrize(("beginning", "force"), [("STATE", None), ("the same with a gauge", 1.5)])
def test_the_states_on_the_page_decode_by_their_table(beginning, force):
    data = message(beginning)
    kind, flags, sequence, time, left, right, error = struct.unpack("<BBHIiiB", data[:17])
    known = acus.ENABLED | acus.HOMED | acus.GREETED
    assert flags == (known if force is None else known | acus.FORCE_VALID)
    assert (kind, sequence, time, left, right, error) == (0x82, 258, 1_000_000, -2681, 2400, 0)
    if force is None:
        assert len(data) == acus.STATE_BYTES
    else:
        assert len(data) == acus.STATE_WITH_FORCE_BYTES
        assert struct.unpack("<f", data[17:]) == (force,)


def test_the_info_on_the_page_is_understood():
    info, counts, torque, watchdog = acus.read_info(message("INFO"))
    assert (info.serial, info.profile, info.boot, info.gauge) == ("A0007", "icube", 0x1234, True)
    assert (counts, torque, watchdog) == (20000, pytest.approx(0.6), pytest.approx(0.020))


def test_the_messages_of_version_two_on_the_page_decode_by_their_tables():
    assert example("version 2: HELLO") == acus.hello(cables.VERSION)
    pulls, holds = message("version 2: COMMAND enable,"), message("version 2: COMMAND enable and")
    assert len(pulls) == len(holds) == cables.COMMAND_BYTES
    assert struct.unpack("<BBH4f", pulls) == (cables.COMMAND, acus.ENABLE, 258, 2, 12.5, 2, 40)
    kind, flags, sequence, *speeds = struct.unpack("<BBH4f", holds)
    assert (kind, flags, sequence) == (cables.COMMAND, acus.ENABLE | cables.HOLD, 259)
    assert speeds == pytest.approx([0.01, -0.01, 0.0, 0.0])
    state = message("version 2: STATE")
    assert len(state) == cables.STATE_BYTES
    kind, flags, sequence, time, left, right, error = struct.unpack("<BBHIiiB", state[:17])
    known = acus.ENABLED | acus.HOMED | acus.GREETED
    assert (kind, flags, sequence, time) == (cables.STATE, known, 258, 1_000_000)
    assert (left, right, error) == (719, -721, 0)
    assert struct.unpack("<8f", state[17:]) == (2.5, 12.5, 2, 40, 0.125, -0.125, 0, 0.0625)


def test_the_haply_setup_on_the_page_is_what_the_program_sends():
    assert example("setup") == haply.setup(load_profile("haply-2diy"))
    assert len(example("setup")) == haply.SETUP_BYTES


def test_the_haply_messages_on_the_page_have_their_lengths_and_values():
    assert struct.unpack("<BBff", example("torques"))[2:] == pytest.approx((-0.05, 0.1))
    assert struct.unpack("<Bff", example("angles")) == (5, 12.0, 168.0)


@pytest.mark.parametrize(
    "words",
    [
        "**0x29B1**",
        f"{np.degrees(FASTEST) * 1e-3:g}° per millisecond",
        f"at most {np.degrees(FARTHEST):g}°",
        f"more than {PATIENCE * 1e3:g} ms",
        f"after {haply.ANSWER_WITHIN * 1e3:g} ms",
        f"1 to {framing.LARGEST_PAYLOAD} bytes",
        "errors: 1 torque not finite, 2 home refused, 3 encoder, 4 amplifier, 5 motor supply off,"
        " 6 too hot, 7 internal",
    ],
)
def test_the_numbers_on_the_page_are_the_programs(words):
    assert words.lower() in " ".join(PAGE.split()).lower()
