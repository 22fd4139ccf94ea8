"""Ports that cannot be used: the message says what is wrong and how to mend it."""

import contextlib
import errno
import os
import pty
import threading
import time
import tty

import pytest
import serial

from app.device.errors import LinkError
from app.device.links import protocols
from app.device.links.port import Port, ports, reason
from app.device.links.serial_link import SerialLink
from app.mechanisms.profile import load_profile

ICUBE, HAPLY = load_profile("icube"), load_profile("haply-2diy")


@pytest.fixture
def terminal():
    """A pseudo-terminal: (master's descriptor, path)."""
    master, slave = pty.openpty()
    tty.setraw(slave)
    yield master, os.ttyname(slave)
    os.close(slave)
    os.close(master)


def quickly(monkeypatch):
    monkeypatch.setattr(protocols, "ATTEMPTS", 3)


def test_an_absent_port_is_named_with_those_that_are_there(tmp_path):
    with pytest.raises(LinkError, match=r"no port .*robot; serial ports here: .*acus device list"):
        SerialLink(str(tmp_path / "robot"), ICUBE).open()


def test_a_file_that_is_no_port_is_refused(tmp_path):
    file = tmp_path / "file"
    file.write_text("nothing")
    with pytest.raises(LinkError, match=r"not a serial port|cannot be used"):
        SerialLink(str(file), ICUBE).open()


def test_a_forbidden_port_says_how_to_be_let_in(monkeypatch):
    def forbid(*_, **__):
        raise serial.SerialException(errno.EACCES, "Permission denied")

    monkeypatch.setattr(serial, "Serial", forbid)
    with pytest.raises(LinkError, match=r"sudo usermod -aG dialout \$USER.*log out and in"):
        Port("/dev/ttyACM0", 115200).open()


def test_a_port_that_is_in_use_says_so(terminal):
    first = Port(terminal[1], 115200)
    first.open()
    with pytest.raises(LinkError, match=r"busy: another program .*fuser -v"):
        Port(terminal[1], 115200).open()
    first.close()
    first.close()
    again = Port(terminal[1], 115200)
    again.open()
    again.close()


@pytest.mark.parametrize("profile", [ICUBE, HAPLY], ids=lambda profile: profile.name)
def test_a_port_where_nobody_answers_says_what_to_check(profile, terminal, monkeypatch):
    quickly(monkeypatch)
    with pytest.raises(LinkError, match=r"answers; check its power and cable, that this is the"):
        SerialLink(terminal[1], profile).open()


@pytest.mark.parametrize("profile", [ICUBE, HAPLY], ids=lambda profile: profile.name)
def test_garbage_on_the_wire_is_told_from_silence(profile, terminal, monkeypatch):
    """A board at another baud rate looks like this."""
    quickly(monkeypatch)
    ended = threading.Event()

    def talk():
        while not ended.wait(0.005):
            os.write(terminal[0], os.urandom(20))

    thread = threading.Thread(target=talk)
    thread.start()
    try:
        with pytest.raises(LinkError, match="they make no sense; check that this is"):
            SerialLink(terminal[1], profile).open()
    finally:
        ended.set()
        thread.join()


def test_a_speed_that_the_port_does_not_have_is_named():
    with pytest.raises(LinkError, match=r"cannot be set to 1234567 baud; correct wire\.baud"):
        raise LinkError(reason("/dev/ttyS9", 1234567, ValueError("Invalid baud rate")))


def test_a_link_that_was_never_opened_knows_nobody():
    link = SerialLink("/dev/ttyACM0", ICUBE)
    with pytest.raises(LinkError, match=r"call open\(\) first"):
        link.info()
    link.close()


def test_ports_are_listed_without_opening_them():
    assert all(port.path for port in ports())


def test_a_line_that_never_falls_silent_does_not_hold_a_greeting():
    master, slave = pty.openpty()
    tty.setraw(slave)
    os.set_blocking(master, False)
    ended = threading.Event()

    def babble():
        while not ended.is_set():
            with contextlib.suppress(BlockingIOError):
                os.write(master, b"\x55" * 64)

    noise = threading.Thread(target=babble)
    port = Port(os.ttyname(slave), 115200)
    port.open()
    noise.start()
    try:
        begin = time.monotonic()
        assert port.exchange(b"\0")
        assert time.monotonic() - begin < 30.0
    finally:
        ended.set()
        noise.join()
        port.close()
        os.close(master)
        os.close(slave)


def test_a_file_that_is_no_port_is_named_so():
    with pytest.raises(LinkError, match="is not a serial port"):
        Port(os.devnull, 115200).open()
