"""Frames on a byte stream: found among garbage, damaged ones dropped, never a crash."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.device.links.framing import LARGEST_PAYLOAD, Deframer, crc16, frame

payloads = st.binary(min_size=1, max_size=LARGEST_PAYLOAD)


def test_the_checksum_has_the_published_check_value():
    assert crc16(np.frombuffer(b"123456789", np.uint8), 9) == 0x29B1


@given(payloads)
def test_a_frame_has_one_zero_at_its_end_and_gives_its_payload_back(payload):
    sent = frame(payload)
    assert sent.index(0) == len(sent) - 1
    assert len(sent) == len(payload) + 4
    assert list(Deframer().feed(sent)) == [payload]


@given(st.lists(payloads, max_size=5), st.integers(1, 7))
def test_frames_cut_into_pieces_come_out_whole_and_in_order(sent, piece):
    stream = b"".join(map(frame, sent))
    receiver = Deframer()
    got = [p for k in range(0, len(stream), piece) for p in receiver.feed(stream[k : k + piece])]
    assert got == sent
    assert receiver.errors == 0


@pytest.mark.promise("docs/protocol.md: So it is in step again one frame after any garbage")
@given(st.binary(max_size=400), payloads)
def test_after_any_garbage_and_a_zero_the_next_frame_is_found(garbage, payload):
    receiver = Deframer()
    list(receiver.feed(garbage + b"\x00"))
    assert list(receiver.feed(frame(payload))) == [payload]


@given(payloads, st.data())
def test_one_changed_byte_never_gives_another_payload(payload, data):
    sent = bytearray(frame(payload))
    where = data.draw(st.integers(0, len(sent) - 2))
    sent[where] ^= data.draw(st.integers(1, 255))
    receiver = Deframer()
    got = list(receiver.feed(bytes(sent)))
    assert payload not in got or len(got) > 1
    assert all(len(p) < len(payload) for p in got if p != payload)


@settings(max_examples=300)
@given(st.binary(max_size=300))
def test_any_bytes_are_survived(data):
    for payload in Deframer().feed(data):
        assert 1 <= len(payload) <= LARGEST_PAYLOAD


def test_an_overlong_frame_is_dropped_and_counted_once():
    receiver = Deframer()
    assert list(receiver.feed(b"\x07" * 5000 + b"\x00")) == []
    assert receiver.errors == 1
    assert list(receiver.feed(frame(b"next"))) == [b"next"]


@pytest.mark.parametrize("size", [0, LARGEST_PAYLOAD + 1])
def test_a_payload_that_no_frame_holds_is_refused(size):
    with pytest.raises(ValueError, match="1 to 64"):
        frame(bytes(size))
