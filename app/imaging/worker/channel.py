"""Messages between the program and its child: JSON, each behind its length.

Memory goes with a message: as a descriptor where a socket passes any, else a message before it
names the memory.
"""

import array
import json
import socket
import struct
from typing import Any

from app.core.messages import sentence
from app.imaging.worker.lent_memory import PASSES, LentMemory

LONGEST = 1 << 26
"""Longest message that is accepted [bytes]; the frames of the largest files need a few MB."""

MOST_OPEN = 8
"""Tasks that a child has before it, so that it need not wait for the program."""

VOLUME = "volume"
"""First word of the message beside which the memory of a volume comes."""

_MEMORY = "memory"
"""First word of the message that names the memory of the next one."""

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
        self._memory: list[LentMemory] = []

    def fileno(self) -> int:
        """File descriptor, for `select`."""
        return self._end.fileno()

    def close(self) -> None:
        """Close this end, and what came through it and was not taken; idempotent."""
        self._end.close()
        while self._memory:
            self._memory.pop().close()

    def send(self, message: Any, memory: LentMemory | None = None) -> None:
        """Send a message, and memory with it.

        Raises:
            OSError: if the other side is gone.
        """
        data, sent = _packed(message), 0
        if memory is not None and memory.name:
            data = _packed([_MEMORY, memory.name, memory.size]) + data
        elif memory is not None:
            sent = socket.send_fds(self._end, [data], [memory.descriptor])
        self._end.sendall(data[sent:])

    def fill(self) -> bool:
        """Read what has come, waiting if nothing has; False if the other side is gone.

        Raises:
            OSError: if the connection breaks.
        """
        if PASSES:
            data, ancillary, _, _ = self._end.recvmsg(1 << 18, socket.CMSG_SPACE(4))
            for level, kind, payload in ancillary:
                if (level, kind) == (socket.SOL_SOCKET, socket.SCM_RIGHTS):
                    descriptors = array.array("i", payload[: len(payload) // 4 * 4])
                    self._memory.extend(map(LentMemory, descriptors))
        else:
            data = self._end.recv(1 << 18)
        self._got += data
        return bool(data)

    def take(self) -> Any:
        """Return the next whole message that was read; None if there is none.

        Raises:
            ChannelError: if what came is no message.
        """
        message = self._next()
        if not PASSES and isinstance(message, list) and message[:1] == [_MEMORY]:
            try:
                self._memory.append(LentMemory.named(*message[1:3]))
            except (OSError, TypeError, ValueError, OverflowError) as error:
                raise ChannelError(sentence("no memory has that name")) from error
            message = self._next()
        return message

    def _next(self) -> Any:
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

    def take_memory(self) -> LentMemory:
        """Return the memory that came first.

        Raises:
            ChannelError: if none came.
        """
        if not self._memory:
            raise ChannelError(sentence("no memory came"))
        return self._memory.pop(0)


def _packed(message: Any) -> bytes:
    body = _ENCODER.encode(message).encode()
    return _LENGTH.pack(len(body)) + body


def _refuse(name: str) -> float:
    raise ValueError(sentence("{name} is no number", name=name))
