"""Walking the elements of a sound data set: the few that are wanted out of a hundred, quickly.

What is not as the standard writes it is left to pydicom, which knows the ways of odd files: this
answers "not for me" and never guesses. Little endian only (PS3.5 7.1).
"""

import struct
from typing import BinaryIO, Final, NamedTuple

_CHUNK: Final = 1 << 13
_LONGEST_VALUE: Final = 1 << 16
_MOST_ELEMENTS: Final = 1 << 16
_UNDEFINED: Final = 0xFFFFFFFF
_ITEM, _ITEM_END, _SEQUENCE_END = 0xFFFEE000, 0xFFFEE00D, 0xFFFEE0DD
_SHORT: Final = frozenset(b"AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US".split())
_LONG: Final = frozenset(b"OB OD OF OL OV OW SQ SV UC UN UR UT UV".split())
"""Value representations with a length of two and of four bytes."""

_NAMES: Final = {name: name.decode("ascii") or None for name in (b"", *_SHORT, *_LONG)}
_NEVER: Final = 1 << 32

_EXPLICIT: Final = struct.Struct("<HH2sH").unpack_from
_IMPLICIT: Final = struct.Struct("<HHL").unpack_from
_LENGTH: Final = struct.Struct("<L").unpack_from


class Raw(NamedTuple):
    """One element as it stands in the file.

    Attributes:
        VR: value representation; None in an implicit data set.
        value: its bytes.
        is_little_endian: always true; as pydicom names it.
    """

    VR: str | None
    value: bytes
    is_little_endian: bool = True


class OddError(Exception):
    """Not for this reader: the file is cut short, or not written as the standard says."""


class Walk:
    """A place in a file, moving from element to element.

    Args:
        stream: the file.
        start: byte at which the first element stands.
    """

    def __init__(self, stream: BinaryIO, start: int) -> None:
        self._stream, self._base, self._at = stream, start, 0
        stream.seek(start)
        self._data = stream.read(_CHUNK)

    @property
    def place(self) -> int:
        """Byte in the file of the next element."""
        return self._base + self._at

    def is_explicit(self) -> bool:
        """Whether the next element names its value representation."""
        self._have(6)
        name = self._data[self._at + 4 : self._at + 6]
        return name.isalpha() and name.isupper()

    def take(self, wanted: frozenset[int], implicit: bool, first: int, stop: int) -> dict[int, Raw]:
        """Return the wanted elements before the first tag from `stop` on, and stay there.

        Args:
            wanted: tags.
            implicit: whether the elements name no value representation.
            first: lowest tag that may stand here.
            stop: tag.

        Raises:
            OddError: if this reader cannot vouch for what stands there.
        """
        found: dict[int, Raw] = {}
        before = first - 1
        element = self._implicit if implicit else self._explicit
        for _ in range(_MOST_ELEMENTS):
            if self._at + 12 > len(self._data):
                self._have(12)
            tag, name, length, head = element(stop)
            if tag <= before:  # they ascend (PS3.5 7.1)
                raise OddError
            if tag >= stop:
                return found
            before = tag
            self._at += head
            if tag in wanted:
                if length > _LONGEST_VALUE:  # or of undefined length
                    raise OddError
                found[tag] = Raw(_NAMES[name], self._value(length))
            elif length == _UNDEFINED:
                self._pass(implicit)
            else:
                self._at += length
        raise OddError

    def _implicit(self, stop: int) -> tuple[int, bytes, int, int]:
        """Tag, value representation, length of the value and of what stands before it."""
        group, number, length = _IMPLICIT(self._data, self._at)
        return group << 16 | number, b"", length, 8

    def _explicit(self, stop: int) -> tuple[int, bytes, int, int]:
        """Tag, value representation, length of the value and of what stands before it."""
        group, number, name, length = _EXPLICIT(self._data, self._at)
        tag = group << 16 | number
        if name in _SHORT:
            return tag, name, length, 8
        if name in _LONG:
            return tag, name, _LENGTH(self._data, self._at + 8)[0], 12
        if tag >= stop:  # what stands behind may be written in another way
            return tag, b"", 0, 0
        raise OddError

    def _value(self, length: int) -> bytes:
        self._have(length)
        self._at += length
        return self._data[self._at - length : self._at]

    def _pass(self, implicit: bool) -> None:
        """Go behind a value of items whose end is marked, whatever is nested in it."""
        inside = ["sequence"]
        element = self._implicit if implicit else self._explicit
        for _ in range(_MOST_ELEMENTS):
            self._have(8)
            group, number, length = _IMPLICIT(self._data, self._at)
            tag = group << 16 | number
            if inside[-1] == "item" and group != 0xFFFE:
                self._have(12)
                _, name, length, head = element(_NEVER)
                self._at += head + (0 if length == _UNDEFINED else length)
                if length == _UNDEFINED:
                    if name == b"UN":  # holds implicit elements, whatever stands around it
                        raise OddError
                    inside.append("sequence")
                continue
            self._at += 8
            if (inside[-1], tag) == ("sequence", _ITEM):
                if length == _UNDEFINED:
                    inside.append("item")
                else:
                    self._at += length
            elif (inside.pop(), tag) not in (("sequence", _SEQUENCE_END), ("item", _ITEM_END)):
                raise OddError
            if not inside:
                return
        raise OddError

    def _have(self, count: int) -> None:
        """See that so many bytes from here on are in memory."""
        if self._at + count <= len(self._data):
            return
        self._base, self._at = self._base + self._at, 0
        self._stream.seek(self._base)
        self._data = self._stream.read(max(_CHUNK, count))
        if len(self._data) < count:
            raise OddError
