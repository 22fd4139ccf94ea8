"""One file in, one de-identified file out; the pixels bit for bit unless somebody drew on them."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pydicom
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian

from app.core.files import sync
from app.imaging.decoding import read_stored, stored_type
from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.privacy import burned_in, faces
from app.imaging.privacy.actions import Rules, deidentified
from app.imaging.privacy.burned_in import Box
from app.imaging.privacy.errors import BurnedInError, PrivacyError
from app.imaging.privacy.report import Tally
from app.imaging.privacy.verify import Secrets, pixel_digest

_MAKER = UID("2.25.203667418361548929302126903270614716401")


def read_original(header: SliceHeader) -> Dataset:
    """Read a whole file.

    Raises:
        FileDamagedError: if it cannot be read; quotes nothing of it.
    """
    try:
        dataset = pydicom.dcmread(header.path, force=True)
        dataset["PixelData"]  # not every file has got any
    except OSError as error:
        raise FileDamagedError(f"it cannot be read: {error.strerror or 'no such file'}") from None
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise FileDamagedError(f"it cannot be read ({type(error).__name__})") from None
    if str(dataset.get("SOPInstanceUID", "")).strip(" \0") != header.identity.sop_uid:
        raise FileDamagedError("it has changed since the folder was looked at")
    return dataset


def convert(
    header: SliceHeader, to: Path, rules: Rules, boxes: Sequence[Box], secrets: Secrets,
    tally: Tally,
) -> str:  # fmt: skip
    """De-identify one file into another.

    Args:
        header: of the original, as the scan of its folder found it.
        to: file to write.
        rules: of this patient.
        boxes: pixels to blacken.
        secrets: takes up what the original says.
        tally: counts what is done.

    Returns:
        Digest that the pixels of the written file must have.

    Raises:
        PrivacyError, FileDamagedError: if it must not or cannot be taken; quotes nothing of it.
        OSError: if the new file cannot be written.
    """
    original = read_original(header)
    burned_in.check(original, boxes)
    secrets.gather(original)
    if text := faces.warning(original):
        tally.warn(text)
    result = deidentified(original, rules, tally)
    secrets.scrub(result, tally)
    syntax = UID(header.pixels.syntax)
    if boxes or _drawn_over(original):
        _redraw(header, original, result, boxes)
        syntax = ExplicitVRLittleEndian
        tally.masked += 1
    _write(result, to, syntax)
    tally.files += 1
    return pixel_digest(result)


def _drawn_over(original: Dataset) -> bool:
    """Whether an overlay lies in the unused bits of the pixels (PS3.5 8.1.2, retired)."""
    return any(
        tag.group & 0xFF00 == 0x6000 and tag.element == 0x0102 and int(original[tag].value or 0) > 0
        for tag in list(original.keys())
    )


def _redraw(header: SliceHeader, original: Dataset, result: Dataset, boxes: Sequence[Box]) -> None:
    """Write the pixels anew: what was drawn in unused bits is gone, boxes are black."""
    form = header.format
    if form.frames != 1:
        raise BurnedInError("boxes can be drawn on files of one picture only")
    stored = np.empty((form.rows, form.columns), stored_type(form))
    read_stored(header, stored)
    slope = header.rescale.slope if header.rescale else 1.0
    if boxes:
        inverted = form.photometric == "MONOCHROME1"
        stored = burned_in.blackened(stored, boxes, slope, inverted)
        result.BurnedInAnnotation = "NO"
    wide = stored.dtype.itemsize == 2
    raw = stored.astype(stored.dtype.newbyteorder("<")).tobytes()
    result.add_new("PixelData", "OW" if wide else "OB", raw + b"\0" * (len(raw) % 2))
    result.HighBit = result.BitsStored - 1


def _write(result: Dataset, to: Path, syntax: UID) -> None:
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = result.SOPClassUID
    meta.MediaStorageSOPInstanceUID = result.SOPInstanceUID
    meta.TransferSyntaxUID = syntax
    meta.ImplementationClassUID = _MAKER
    file = FileDataset(
        str(to), result, preamble=b"\0" * 128, file_meta=meta,
        is_implicit_VR=syntax.is_implicit_VR, is_little_endian=syntax.is_little_endian,
    )  # fmt: skip
    try:
        file.save_as(to, enforce_file_format=True)
    except OSError as error:
        raise _of_the_system(error) from None
    except MemoryError:
        raise
    except Exception as error:  # a value that pydicom will not write; its message would quote it
        raise PrivacyError(f"it cannot be written anew ({type(error).__name__})") from None
    sync(to)


def _of_the_system(error: OSError) -> OSError:
    """Return the system's own error: pydicom raises another of its type, without the number."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, OSError) and cause.errno:
            return cause
        cause = cause.__cause__ or cause.__context__
    return error
