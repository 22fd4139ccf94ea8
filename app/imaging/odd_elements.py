"""Headers that are not as the standard writes them, big endian ones too: read by pydicom."""

import warnings
from collections.abc import Sequence
from typing import BinaryIO

import pydicom
from pydicom.dataset import Dataset
from pydicom.filereader import data_element_generator
from pydicom.tag import BaseTag

from app.imaging.deflated import inflated_head
from app.imaging.elements import FIRST_PIXEL_TAG, PREAMBLE, TRANSFER_SYNTAX, Elements, text
from app.imaging.pixel_data import (
    DECODERS,
    DEFLATED,
    EXPLICIT_BIG,
    EXPLICIT_LITTLE,
    IMPLICIT_LITTLE,
    RAW,
)


def read_odd(stream: BinaryIO, wanted: Sequence[int], forced: bool) -> Elements:
    """Read the wanted elements before the pixels; the stream then stands at the pixels.

    Args:
        stream: the file.
        wanted: tags.
        forced: read although the DICOM preamble is missing.

    Raises:
        Exception: nearly anything, at hostile bytes.
    """
    quick = None if forced else _quick(stream, wanted)
    return quick or _thorough(stream, wanted, forced)


def _quick(stream: BinaryIO, wanted: Sequence[int]) -> Elements | None:
    """Read a file that is what it says; None for one that needs pydicom's whole care."""
    stream.seek(PREAMBLE)
    meta = data_element_generator(
        stream, False, True, _after_meta, None, "iso8859", [TRANSFER_SYNTAX]
    )
    syntax = text(Elements({int(e.tag): e for e in meta}, ""), TRANSFER_SYNTAX)
    if syntax == DEFLATED:
        return _inflate(stream, wanted)
    if syntax not in DECODERS and syntax not in RAW:
        return None
    start = stream.read(6)
    stream.seek(-len(start), 1)
    implicit, little = syntax == IMPLICIT_LITTLE, syntax != EXPLICIT_BIG
    if (start[4:6].isalpha() and start[4:6].isupper()) == implicit:
        return None
    found = data_element_generator(
        stream, implicit, little, _at_pixels, None, "iso8859", list(wanted)
    )
    return Elements({int(element.tag): element for element in found}, syntax)


def _inflate(stream: BinaryIO, wanted: Sequence[int]) -> Elements:
    """Read the elements of a deflated data set, which is explicit and little endian (PS3.5 A.5)."""
    start = stream.tell()
    body = inflated_head(stream)
    found = data_element_generator(body, False, True, _at_pixels, None, "iso8859", list(wanted))
    return Elements({int(element.tag): element for element in found}, DEFLATED, body, start)


def _after_meta(tag: BaseTag, vr: str | None, length: int) -> bool:
    return tag >> 16 != 2


def _at_pixels(tag: BaseTag, vr: str | None, length: int) -> bool:
    return tag >= FIRST_PIXEL_TAG


def _thorough(stream: BinaryIO, wanted: Sequence[int], forced: bool) -> Elements:
    stream.seek(0)
    with warnings.catch_warnings():  # what is wrong with a file is said by name, by us
        warnings.simplefilter("ignore")
        header = pydicom.dcmread(
            stream, stop_before_pixels=True, specific_tags=list(wanted), force=forced
        )
    values = {tag: header.get_item(tag) for tag in wanted if tag in header}
    meta: Dataset = getattr(header, "file_meta", Dataset())
    syntax = str(meta.get("TransferSyntaxUID", "") or "")
    return Elements(values, syntax or _assumed_syntax(header))


def _assumed_syntax(header: Dataset) -> str:
    implicit, little = header.original_encoding
    if little is False:
        return EXPLICIT_BIG
    return IMPLICIT_LITTLE if implicit else EXPLICIT_LITTLE
