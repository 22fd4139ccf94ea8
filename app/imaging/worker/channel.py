"""Messages between the program and its child: JSON, each behind its length."""

import array
import json
import os
import socket
import struct
from typing import Any

from app.core.messages import sentence

LONGEST = 1 << 26
"""Longest message that is accepted [bytes]; the frames of the largest files need a few MB."""

VOLUME = "volume"
"""First word of the message beside which the memory of a volume comes."""

_LENGTH = struct.Struct("<L")
_ENCODER = json.JSONEncoder(separators=(",", ":"))


class ChannelError(ValueError):
    """What came is no message."""


class WorkerChannel:
    """One end of a socket pair.

    Args:
        end: a connected socket; owned from now on.
    """

    def __init__(self, end: socket.socket) -> None:
        self._end = end
        self._got = bytearray()
        self._descriptors: list[int] = []

    def fileno(self) -> int:
        """File descriptor, for `select`."""
        return self._end.fileno()

    def close(self) -> None:
        """Close this end, and what came through it and was not taken; idempotent."""
        self._end.close()
        while self._descriptors:
            os.close(self._descriptors.pop())

    def send(self, message: Any, descriptor: int | None = None) -> None:
        """Send a message, and a file descriptor with it.

        Raises:
            OSError: if the other side is gone.
        """
        body = _ENCODER.encode(message).encode()
        data = _LENGTH.pack(len(body)) + body
        if descriptor is None:
            self._end.sendall(data)
            return
        sent = socket.send_fds(self._end, [data], [descriptor])
        self._end.sendall(data[sent:])

    def fill(self) -> bool:
        """Read what has come, waiting if nothing has; False if the other side is gone.

        Raises:
            OSError: if the connection breaks.
        """
        data, ancillary, _, _ = self._end.recvmsg(1 << 18, socket.CMSG_SPACE(4))
        for level, kind, payload in ancillary:
            if (level, kind) == (socket.SOL_SOCKET, socket.SCM_RIGHTS):
                self._descriptors.extend(array.array("i", payload[: len(payload) // 4 * 4]))
        self._got += data
        return bool(data)

    def take(self) -> Any:
        """Return the next whole message that was read; None if there is none.

        Raises:
            ChannelError: if what came is no message.
        """
        if len(self._got) < _LENGTH.size:
            return None
        (length,) = _LENGTH.unpack_from(self._got)
        if length > LONGEST:
            raise ChannelError(sentence("a message of {length} bytes", length=length))
        end = _LENGTH.size + length
        if len(self._got) < end:
            return None
        body = bytes(self._got[_LENGTH.size : end])
        del self._got[:end]
        try:
            return json.loads(body, parse_constant=_refuse)
        except (ValueError, RecursionError) as error:
            raise ChannelError(str(error)[:100]) from None

    def take_descriptor(self) -> int:
        """Return the file descriptor that came first.

        Raises:
            ChannelError: if none came.
        """
        if not self._descriptors:
            raise ChannelError(sentence("no file descriptor came"))
        return self._descriptors.pop(0)


def _refuse(name: str) -> float:
    raise ValueError(sentence("{name} is no number", name=name))
