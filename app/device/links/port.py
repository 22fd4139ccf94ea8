"""Serial ports: which there are, and opening one for a robot alone. pyserial appears only here."""

import errno
import os
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Final

from app.core.messages import sentence
from app.device.errors import LinkError

ANSWER_TIME = 0.06
"""How long one greeting waits for its answer [s]."""

LONGEST_ANSWER = 0.2
"""How long bytes are taken for one answer, if they never end [s]."""

PSEUDO_TERMINALS: Final = range(136, 144)
"""Major numbers of UNIX98 pseudo-terminals (Linux: Documentation/admin-guide/devices.txt)."""


@dataclass(frozen=True, slots=True)
class PortInfo:
    """One serial port.

    Attributes:
        path: what to open, e.g. `/dev/ttyACM0`.
        description: maker and product, as the system knows them; empty if it does not.
        hardware: identity of the USB device (vendor:product:serial number); empty if there is none.
    """

    path: str
    description: str
    hardware: str


def ports() -> list[PortInfo]:
    """Return the serial ports of this computer, sorted by path; none where it has no driver."""
    try:
        from serial.tools import list_ports  # with a simulated robot nobody needs it
    except ImportError:
        return []
    return sorted((_described(port) for port in list_ports.comports()), key=lambda port: port.path)


def _described(port: Any) -> PortInfo:
    known = port.description if port.description not in (None, "n/a") else ""
    hardware = ""
    if port.vid is not None:
        hardware = f"{port.vid:04x}:{port.pid:04x}:{port.serial_number or ''}"
    return PortInfo(port.device, known or "", hardware)


def check_there(path: str) -> None:
    """Refuse a path at which nothing is, before code is compiled for what would speak there.

    Raises:
        LinkError: naming the ports that there are. Names without a path (COM3) are left to `open`.
    """
    if os.path.isabs(path) and not os.path.exists(path):
        raise LinkError(reason(path, 0, FileNotFoundError(errno.ENOENT, "")))


class Port:
    """An open serial port that nobody else has; its descriptor does not block.

    Args:
        path: of the device, e.g. `/dev/ttyACM0`, or of a link to it.
        baud: speed of the line; without meaning on USB and on a pseudo-terminal.
    """

    def __init__(self, path: str, baud: int) -> None:
        self.path = path
        self.baud = baud
        self._serial: Any = None

    @property
    def fd(self) -> int:
        """Descriptor of the open port."""
        return int(self._serial.fileno())

    @property
    def is_pseudo_terminal(self) -> bool:
        """Return whether another program is at its other end: no hardware is behind a
        pseudo-terminal.

        By the device's major number on Linux; elsewhere nobody can tell.
        """
        if not sys.platform.startswith("linux"):
            return False
        return os.major(os.fstat(self.fd).st_rdev) in PSEUDO_TERMINALS

    def open(self) -> None:
        """Open the port, lock it against other programs, and set its speed.

        Raises:
            LinkError: if it is absent, busy, forbidden or no serial port; says how to mend it.
        """
        try:
            import serial
        except ImportError as error:
            raise LinkError(
                sentence("serial ports cannot be used on this system: {error}", error=error)
            ) from error
        try:
            self._serial = serial.Serial(
                self.path, self.baud, timeout=0, write_timeout=0, exclusive=True
            )
        except (serial.SerialException, OSError, ValueError) as error:
            raise LinkError(reason(self.path, self.baud, error)) from error

    def close(self) -> None:
        """Close the port. Does nothing if it is closed; a port that has gone is closed as well."""
        port, self._serial = self._serial, None
        if port is not None:
            with suppress(OSError):  # the device may be gone, and the descriptor with it
                port.close()

    def exchange(self, data: bytes) -> bytes:
        """Send bytes; return what has come once nothing more comes.

        Waits `ANSWER_TIME` for the first byte and a few milliseconds for the next, and no longer
        than `LONGEST_ANSWER` for a line that never falls silent.

        Raises:
            LinkError: if the port has gone.
        """
        try:
            os.write(self.fd, data)
            return self._gather()
        except BlockingIOError:
            return b""
        except OSError as error:
            raise LinkError(reason(self.path, self.baud, error)) from error

    def _gather(self) -> bytes:
        answer, begin = b"", time.monotonic()
        end = begin + ANSWER_TIME
        while time.monotonic() < min(end, begin + LONGEST_ANSWER):
            try:
                piece = os.read(self.fd, 512)
            except BlockingIOError:
                piece = b""
            answer += piece
            if piece:
                end = time.monotonic() + 0.005
            else:
                time.sleep(0.001)
        return answer


def reason(path: str, baud: int, error: Exception) -> str:
    """Say why a port cannot be used, and what to do."""
    code = getattr(error, "errno", None)
    cause = error.__context__ if error.__context__ is not None else error
    code = code if code is not None else getattr(cause, "errno", None)
    if code is None and cause.args and isinstance(cause.args[0], int):
        code = cause.args[0]  # termios names its errors by number only
    if code in (errno.ENOENT, errno.ENXIO, errno.ENODEV):
        there = ", ".join(port.path for port in ports()) or "none"
        return sentence(
            "there is no port {path}; serial ports here: {there}. Plug the robot in and look "
            "with `acus device list`",
            path=path,
            there=there,
        )
    if code == errno.EACCES or code == errno.EPERM:
        return sentence(
            "you may not open {path}: add yourself to the group that owns it with"
            " `sudo usermod -aG dialout $USER`, then log out and in again",
            path=path,
        )
    if code in (errno.EAGAIN, errno.EWOULDBLOCK, errno.EBUSY):
        return sentence(
            "{path} is busy: another program is using this robot; close it"
            " (`fuser -v {path}` names it)",
            path=path,
        )
    if isinstance(error, ValueError) or code == errno.EINVAL:
        return sentence(
            "{path} cannot be set to {baud} baud; correct wire.baud in the device profile",
            path=path,
            baud=baud,
        )
    if code in (errno.ENOTTY, errno.EISDIR):
        return sentence("{path} is not a serial port; see `acus device list`", path=path)
    if code == errno.EIO:
        return sentence("{path} has gone; plug the robot in again", path=path)
    return sentence("{path} cannot be used: {error}", path=path, error=error)
