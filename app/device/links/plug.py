"""A file descriptor whose number never changes, with a port behind it or nothing.

The compiled loop reads and writes a number. If a lost port were simply closed, its number could be
given to another file while a tick still uses it. So one number is reserved when the link opens, and
ports are put behind it and taken away in one step (`dup2`).
"""

import os

from app.core.arrays import FloatArray
from app.device.links import wire
from app.device.links.port import Port


class Plug:
    """The plug of a link.

    Args:
        end: array of the program's end of the wire; its field FD is kept here.
    """

    def __init__(self, end: FloatArray) -> None:
        self._end = end
        self._fd = -1
        self._port: Port | None = None
        end[wire.FD] = -1.0

    def open(self) -> None:
        """Reserve a number, with nothing behind it. Does nothing if it has one."""
        if self._fd < 0:
            self._fd = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
            self._end[wire.FD] = self._fd

    def put(self, port: Port) -> None:
        """Put an open port behind the number; it belongs to the plug now."""
        os.dup2(port.fd, self._fd, inheritable=False)
        self._port = port

    def take_away(self) -> None:
        """Close the port and leave nothing behind the number. Does nothing without a port."""
        port, self._port = self._port, None
        if port is not None:
            nothing = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
            os.dup2(nothing, self._fd, inheritable=False)
            os.close(nothing)
            port.close()

    def close(self) -> None:
        """Give the number back; no loop may use the stages any more. Idempotent."""
        self.take_away()
        if self._fd >= 0:
            fd, self._fd = self._fd, -1
            self._end[wire.FD] = -1.0
            os.close(fd)
