"""Memory that the program and its child both see, in the three ways that systems have.

- Linux: anonymous memory (`memfd_create`), handed over by its descriptor, and sealed before it is
  read: nobody can change it any more.
- Other Unix: a file that has no name any more, handed over by its descriptor. Nothing seals it:
  what it holds is copied before it is read.
- Windows: a piece of the page file under a name of 128 random bits, which is handed over; copied
  likewise. It cannot shrink.

What was copied nobody changes under a reader's feet; a seal saves the copy.
"""

from __future__ import annotations

import mmap
import os
import re
import secrets
import socket
import tempfile
from typing import Any, Final

from app.core.descriptors import SEAL_GROW, SEAL_SEAL, SEAL_SHRINK, SEAL_WRITE, seal
from app.core.messages import sentence

SEALS: Final = hasattr(os, "memfd_create")
"""Whether memory can be sealed here."""

PASSES: Final = hasattr(socket, "send_fds")
"""Whether a socket passes descriptors here."""

_SEALED: Final = SEAL_SEAL | SEAL_SHRINK | SEAL_GROW | SEAL_WRITE
_NAME: Final = re.compile(r"acus-[0-9a-f]{32}")
_CHUNK: Final = 1 << 24


class LentMemoryError(OSError):
    """There is no such memory, or it is not what it was said to be."""


class LentMemory:
    """A piece of memory: made by one side, sent by a `WorkerChannel`, taken by the other.

    Args:
        descriptor: of the memory, owned from now on; -1 where it has a name.
        name: of the memory; empty where a descriptor stands for it.
        mapping: of named memory.
    """

    def __init__(
        self, descriptor: int = -1, name: str = "", mapping: mmap.mmap | None = None
    ) -> None:
        self.descriptor, self.name, self._mapping = descriptor, name, mapping

    @classmethod
    def made(cls, size: int) -> LentMemory:
        """Make a piece of `size` bytes, zeros.

        Raises:
            OSError, ValueError, OverflowError: if there is not enough memory.
        """
        if not PASSES:
            return cls._mapped(f"acus-{secrets.token_hex(16)}", size)
        if SEALS:
            descriptor = os.memfd_create("acus", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
        else:
            descriptor, path = tempfile.mkstemp(prefix="acus-")
            os.unlink(path)
        piece = cls(descriptor)
        try:
            os.ftruncate(descriptor, size)
        except BaseException:
            piece.close()
            raise
        return piece

    @classmethod
    def named(cls, name: Any, size: Any) -> LentMemory:
        """Return the piece of a name that came in a message.

        Raises:
            LentMemoryError: if there is none of that name and size.
        """
        fits = isinstance(name, str) and _NAME.fullmatch(name) and type(size) is int and size >= 0
        if PASSES or not fits:
            raise LentMemoryError(sentence("no memory has that name"))
        return cls._mapped(name, size)

    @classmethod
    def _mapped(cls, name: str, size: int) -> LentMemory:
        given: dict[str, Any] = {"tagname": name}  # which only Windows has
        return cls(name=name, mapping=mmap.mmap(-1, max(1, size), **given))

    @property
    def size(self) -> int:
        """Return how many bytes it has."""
        if self._mapping is not None:
            return len(self._mapping)
        return os.fstat(self.descriptor).st_size

    def fix_size(self) -> None:
        """Let nobody change the size from now on, where the system can do that.

        Raises:
            OSError: if it cannot be done here.
        """
        if self._mapping is None and SEALS:
            seal(self.descriptor, SEAL_SHRINK | SEAL_GROW)

    def write(self, start: int, content: memoryview) -> None:
        """Write bytes from a place on.

        Raises:
            OSError, ValueError: if they do not fit.
        """
        if self._mapping is not None:
            self._mapping[start : start + len(content)] = content
            return
        while content:
            written = os.pwrite(self.descriptor, content, start)
            content, start = content[written:], start + written

    def shared(self) -> Any:
        """Return the memory itself, writable, as both sides see it.

        Raises:
            OSError, ValueError, OverflowError: if it cannot be mapped.
        """
        if self._mapping is not None:
            return self._mapping
        return mmap.mmap(self.descriptor, self.size)

    def own(self) -> Any:
        """Return what it holds, as memory that the other side cannot change any more.

        Raises:
            OSError: if it can neither be sealed nor copied.
        """
        if self._mapping is not None:
            return self._mapping[:]
        if SEALS:
            seal(self.descriptor, _SEALED)
            return (
                mmap.mmap(self.descriptor, size, flags=mmap.MAP_PRIVATE)
                if (size := self.size)
                else b""
            )
        return self._copied()

    def settled(self) -> Any:
        """Return what was written to it, writable, in memory that cannot shrink any more.

        Raises:
            OSError, ValueError, OverflowError: if there is not enough memory, or it has shrunk.
        """
        if self._mapping is not None or SEALS:
            return self.shared()
        return self._copied()

    def _copied(self) -> Any:
        size = self.size
        if not size:
            return b""
        copy, at = mmap.mmap(-1, size), 0
        while at < size:
            part = os.pread(self.descriptor, min(_CHUNK, size - at), at)
            if not part:
                raise LentMemoryError(sentence("the memory beside a message is of no use"))
            copy[at : at + len(part)] = part
            at += len(part)
        return copy

    def close(self) -> None:
        """Close this side's; what was mapped stays while somebody uses it; idempotent."""
        if self.descriptor >= 0:
            os.close(self.descriptor)
        self.descriptor, self._mapping = -1, None
