"""Reading the wanted elements of a DICOM file up to its pixels: one door, two readers behind it.

A file that is written as the standard says, as nearly all are, is walked through here: the few
elements that are wanted out of a hundred, quickly and without loading pydicom. What is written in
any other way (big endian files too) is left to pydicom, which knows the ways of odd files; the walk
answers "not standard" and never guesses.
"""

import contextlib
import struct
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, BinaryIO, Final, NamedTuple

from app.core.messages import sentence
from app.imaging.deflated import inflated_head
from app.imaging.elements import Elements, text
from app.imaging.errors import FileDamagedError, brief
from app.imaging.pixel_data import (
    DECODERS,
    DEFLATED,
    EXPLICIT_BIG,
    EXPLICIT_LITTLE,
    IMPLICIT_LITTLE,
    RAW,
)

if TYPE_CHECKING:
    from pydicom.dataset import Dataset
    from pydicom.tag import BaseTag

PREAMBLE: Final = 132
TRANSFER_SYNTAX: Final = 0x00020010
FIRST_PIXEL_TAG: Final = 0x7FE00008
_FIRST_META_TAG: Final = 0x00020000
_FIRST_DATA_TAG: Final = 0x00030000
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
_LOW_GROUP: Final = 0x0100
"""A data set starts with a group below this."""

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


class NotStandardError(Exception):
    """The file is cut short, or not written as the standard says; pydicom may yet read it."""


def read_elements(
    stream: BinaryIO, wanted: Sequence[int], forced: bool, without_pydicom: bool = False
) -> Elements:
    """Read the wanted elements before the pixels; the stream then stands at the pixels.

    Args:
        stream: the file, at its start.
        wanted: tags.
        forced: read although the DICOM preamble is missing.
        without_pydicom: only if it can be done without it.

    Raises:
        FileDamagedError: if the header cannot be parsed.
        NotStandardError: if it was to be done without pydicom, and cannot.
    """
    if not forced:
        with contextlib.suppress(NotStandardError):
            return read_standard(stream, frozenset(wanted))
    if without_pydicom:
        raise NotStandardError
    try:
        return read_by_pydicom(stream, wanted, forced)
    except FileDamagedError:
        raise
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise FileDamagedError(
            sentence("its header cannot be read ({brief})", brief=brief(error))
        ) from error


def read_standard(stream: BinaryIO, wanted: frozenset[int]) -> Elements:
    """Read a file that is what it says, and says so as the standard does; little endian only.

    Raises:
        NotStandardError: for any other.
    """
    walk = Walk(stream, PREAMBLE)
    meta = walk.take(frozenset((TRANSFER_SYNTAX,)), False, _FIRST_META_TAG, _FIRST_DATA_TAG)
    syntax = text(Elements(meta, ""), TRANSFER_SYNTAX)
    _check_order(walk.peek(6), syntax)
    if syntax == DEFLATED:
        return _deflated_standard(stream, walk.place, wanted)
    if syntax == EXPLICIT_BIG or (syntax not in DECODERS and syntax not in RAW):
        raise NotStandardError
    implicit = syntax == IMPLICIT_LITTLE
    if walk.is_explicit() == implicit:
        raise NotStandardError
    values = walk.take(wanted, implicit, _FIRST_DATA_TAG, FIRST_PIXEL_TAG)
    stream.seek(walk.place)
    return Elements(values, syntax)


def _check_order(start: bytes, syntax: str) -> None:
    """See that the first element of a data set is of the byte order that its syntax says.

    Raises:
        FileDamagedError: if it is of the other one.
    """
    if syntax not in (*RAW, *DECODERS) or len(start) < 6:
        return
    little, big = (int.from_bytes(start[:2], order) for order in ("little", "big"))
    said, other = (big, little) if syntax == EXPLICIT_BIG else (little, big)
    if other < _LOW_GROUP <= said:
        is_big = syntax == EXPLICIT_BIG
        raise FileDamagedError(
            sentence(
                "its transfer syntax says {stated_order} endian, and its header is "
                "{found_order} endian; have it sent again",
                stated_order="big" if is_big else "little",
                found_order="little" if is_big else "big",
            )
        )


def _deflated_standard(stream: BinaryIO, start: int, wanted: frozenset[int]) -> Elements:
    """Read the elements of a deflated data set, which is explicit and little endian (PS3.5 A.5)."""
    stream.seek(start)
    try:
        body = inflated_head(stream)
    except FileDamagedError as error:
        raise NotStandardError from error
    walk = Walk(body, 0)
    values = walk.take(wanted, False, _FIRST_DATA_TAG, FIRST_PIXEL_TAG)
    body.seek(walk.place)
    return Elements(values, DEFLATED, body, start)


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

    def peek(self, count: int) -> bytes:
        """Return the next bytes, fewer where the file ends."""
        with contextlib.suppress(NotStandardError):
            self._have(count)
        return self._data[self._at : self._at + count]

    def is_explicit(self) -> bool:
        """Return whether the next element names its value representation."""
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
            NotStandardError: if what stands there is not as the standard says.
        """
        found: dict[int, Raw] = {}
        before = first - 1
        for _ in range(_MOST_ELEMENTS):  # what nearly every element is stands here, not in calls
            if self._at + 12 > len(self._data):
                self._have(12)
            if implicit:
                group, number, length = _IMPLICIT(self._data, self._at)
                tag, name, head = group << 16 | number, b"", 8
            else:
                group, number, name, length = _EXPLICIT(self._data, self._at)
                if name in _SHORT:
                    tag, head = group << 16 | number, 8
                else:
                    tag, name, length, head = self._explicit(stop)
            if tag <= before:  # they ascend (PS3.5 7.1)
                raise NotStandardError
            if tag >= stop:
                return found
            before = tag
            self._at += head
            if tag in wanted:
                if length > _LONGEST_VALUE:  # or of undefined length
                    raise NotStandardError
                found[tag] = Raw(_NAMES[name], self._value(length))
            elif length == _UNDEFINED:
                self._skip_items(implicit)
            else:
                self._at += length
        raise NotStandardError

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
        raise NotStandardError

    def _value(self, length: int) -> bytes:
        self._have(length)
        self._at += length
        return self._data[self._at - length : self._at]

    def _skip_items(self, implicit: bool) -> None:
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
                        raise NotStandardError
                    inside.append("sequence")
                continue
            self._at += 8
            if (inside[-1], tag) == ("sequence", _ITEM):
                if length == _UNDEFINED:
                    inside.append("item")
                else:
                    self._at += length
            elif (inside.pop(), tag) not in (("sequence", _SEQUENCE_END), ("item", _ITEM_END)):
                raise NotStandardError
            if not inside:
                return
        raise NotStandardError

    def _have(self, count: int) -> None:
        """See that so many bytes from here on are in memory."""
        if self._at + count <= len(self._data):
            return
        self._base, self._at = self._base + self._at, 0
        self._stream.seek(self._base)
        self._data = self._stream.read(max(_CHUNK, count))
        if len(self._data) < count:
            raise NotStandardError


def read_by_pydicom(stream: BinaryIO, wanted: Sequence[int], forced: bool) -> Elements:
    """Read the wanted elements before the pixels; the stream then stands at the pixels.

    Of the file meta information nothing but the transfer syntax is read: what is wrong with the
    rest of it is nobody's concern. A deflated data set is inflated here and no further than its
    header may reach; pydicom would inflate all of it.

    Args:
        stream: the file.
        wanted: tags.
        forced: read although the DICOM preamble is missing.

    Raises:
        Exception: nearly anything, at hostile bytes.
    """
    from pydicom.filereader import dcmread, read_dataset

    tags: list[BaseTag | int] = list(wanted)
    with warnings.catch_warnings():  # what is wrong with a file is said by name, by us
        warnings.simplefilter("ignore")
        syntax, start = ("", 0) if forced else _meta_by_pydicom(stream)
        if syntax == DEFLATED:  # explicit and little endian (PS3.5 A.5)
            body = inflated_head(stream)
            found = read_dataset(body, False, True, stop_when=_at_pixels, specific_tags=tags)
            return Elements(_raw(found, wanted), syntax, body, start)
        if syntax in RAW or syntax in DECODERS:
            ways = syntax == IMPLICIT_LITTLE, syntax != EXPLICIT_BIG
            found = read_dataset(stream, *ways, stop_when=_at_pixels, specific_tags=tags)
            return Elements(_raw(found, wanted), syntax)
        stream.seek(0)
        file = dcmread(stream, stop_before_pixels=True, specific_tags=tags, force=forced)
    syntax = str(file.file_meta.get("TransferSyntaxUID", "") or "")
    if not syntax or syntax in RAW:  # how it is written counts, not what it says of that
        syntax = _assumed_syntax(file)
    return Elements(_raw(file, wanted), syntax)


def _meta_by_pydicom(stream: BinaryIO) -> tuple[str, int]:
    """Return the transfer syntax, and where the data set starts; the stream then stands there."""
    from pydicom.filereader import data_element_generator

    stream.seek(PREAMBLE)
    meta = data_element_generator(
        stream, False, True, stop_when=_after_meta, specific_tags=[TRANSFER_SYNTAX]
    )
    syntax = text(Elements({int(one.tag): one for one in meta}, ""), TRANSFER_SYNTAX)
    return syntax, stream.tell()


def _raw(result: "Dataset", wanted: Sequence[int]) -> dict[int, Any]:
    """Return the wanted elements as they stand in the file, unconverted."""
    return {int(one.tag): one for one in result.values() if one.tag in wanted}


def _after_meta(tag: "BaseTag", vr: str | None, length: int) -> bool:
    return tag >> 16 != 2


def _at_pixels(tag: "BaseTag", vr: str | None, length: int) -> bool:
    return tag >= FIRST_PIXEL_TAG


def _assumed_syntax(header: "Dataset") -> str:
    implicit, little = header.original_encoding
    if little is False:
        return EXPLICIT_BIG
    return IMPLICIT_LITTLE if implicit else EXPLICIT_LITTLE
