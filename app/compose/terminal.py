"""A pseudo-terminal that can be unplugged: to other programs, a serial port."""

import os
from pathlib import Path

from app.core.arrays import FloatArray
from app.device.errors import LinkError
from app.device.links import wire


class Terminal:
    """The board's end of a serial cable.

    The compiled loop reads and writes one descriptor, whose number never changes; unplugged, there
    is nothing behind it.

    Args:
        end: array of the board's end of the wire; its field FD is kept here.
        link: path of a symbolic link to the terminal, made anew with each one.
    """

    def __init__(self, end: FloatArray, link: Path | None) -> None:
        self._end = end
        self._link = link
        self._fd = -1
        self._slave = -1
        self.path = ""

    def open(self) -> None:
        """Plug in.

        Raises:
            LinkError: if the link's path is taken by something that is not a link, or is in a
                folder that is absent or may not be written.
        """
        if self._link is not None and self._link.exists() and not self._link.is_symlink():
            raise LinkError(f"{self._link} exists and is not a link; choose another --link")
        if self._link is not None and not os.access(self._link.parent, os.W_OK):
            raise LinkError(f"no link can be made in {self._link.parent}; choose another --link")
        self._fd = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
        self._end[wire.FD] = self._fd
        self.put()

    def put(self) -> None:
        """Make a new terminal and put it behind the descriptor. Does nothing if there is one.

        Raises:
            LinkError: if the system has none.
        """
        if self._slave >= 0:
            return
        try:
            import pty
            import tty
        except ImportError:
            raise LinkError(
                "this system has no pseudo-terminals (Windows): the emulated board runs on Linux"
            ) from None
        master, self._slave = pty.openpty()
        tty.setraw(self._slave)
        os.set_blocking(master, False)
        os.dup2(master, self._fd, inheritable=False)
        os.close(master)
        self.path = os.ttyname(self._slave)
        if self._link is not None:
            fresh = self._link.with_name(f".{self._link.name}.{os.getpid()}")
            fresh.symlink_to(self.path)
            fresh.replace(self._link)

    def take_away(self) -> None:
        """Close the terminal: whoever has it open sees that the port has gone."""
        if self._slave < 0:
            return
        if self._link is not None:
            self._link.unlink(missing_ok=True)
        nothing = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
        os.dup2(nothing, self._fd, inheritable=False)
        os.close(nothing)
        os.close(self._slave)
        self._slave = -1

    def close(self) -> None:
        """Unplug for good; no loop may use the descriptor any more. Idempotent."""
        self.take_away()
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1
