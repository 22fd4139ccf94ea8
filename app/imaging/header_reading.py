"""Reading the header of one DICOM image file: one image, or one for each frame."""

from pathlib import Path
from typing import BinaryIO, Final

from app.imaging import elements
from app.imaging.element_walk import OddError
from app.imaging.elements import Elements
from app.imaging.errors import FileDamagedError
from app.imaging.header import MULTI_FRAME, Identity, Plane, Rescale, SliceHeader
from app.imaging.pixel_data import PixelFormat
from app.imaging.pixel_finding import find_pixels
from app.imaging.privacy.known_words import body_parts, is_kernel
from app.imaging.privacy.pseudonyms import former_pseudonym, pseudonym

_TAGS: Final = {
    "SOPClassUID": 0x00080016,
    "SOPInstanceUID": 0x00080018,
    "ImageType": 0x00080008,
    "AcquisitionTime": 0x00080032,
    "Modality": 0x00080060,
    "PatientID": 0x00100020,
    "BodyPartExamined": 0x00180015,
    "SliceThickness": 0x00180050,
    "EchoNumbers": 0x00180086,
    "TriggerTime": 0x00181060,
    "ConvolutionKernel": 0x00181210,
    "StudyInstanceUID": 0x0020000D,
    "SeriesInstanceUID": 0x0020000E,
    "StudyID": 0x00200010,
    "SeriesNumber": 0x00200011,
    "AcquisitionNumber": 0x00200012,
    "ImagePositionPatient": 0x00200032,
    "ImageOrientationPatient": 0x00200037,
    "FrameOfReferenceUID": 0x00200052,
    "TemporalPositionIdentifier": 0x00200100,
    "SamplesPerPixel": 0x00280002,
    "PhotometricInterpretation": 0x00280004,
    "NumberOfFrames": 0x00280008,
    "Rows": 0x00280010,
    "Columns": 0x00280011,
    "PixelSpacing": 0x00280030,
    "BitsAllocated": 0x00280100,
    "BitsStored": 0x00280101,
    "HighBit": 0x00280102,
    "PixelRepresentation": 0x00280103,
    "PixelPaddingValue": 0x00280120,
    "PixelPaddingRangeLimit": 0x00280121,
    "WindowCenter": 0x00281050,
    "WindowWidth": 0x00281051,
    "RescaleIntercept": 0x00281052,
    "RescaleSlope": 0x00281053,
    "RescaleType": 0x00281054,
}
_TAG_LIST: Final = list(_TAGS.values())


_MARKS: Final = {
    "acquisition": "AcquisitionNumber",
    "time-position": "TemporalPositionIdentifier",
    "trigger": "TriggerTime",
    "echo": "EchoNumbers",
    "image-type": "ImageType",
    "kernel": "ConvolutionKernel",
    "acquisition-time": "AcquisitionTime",
}
_AS_STORED: Final = Rescale(1.0, 0.0)


def read_headers(
    path: Path, stream: BinaryIO, forced: bool, sound: bool = False
) -> tuple[SliceHeader, ...]:
    """Read the header of one file up to its pixels; nothing if it is no instance of a series.

    Args:
        path: the file, for messages.
        stream: the file, opened for reading at its start.
        forced: read although the DICOM preamble is missing.
        sound: only if it can be done without pydicom.

    Returns:
        One header for each image: one, or for a multi-frame file that says where its frames lie
        one for each.

    Raises:
        FileDamagedError: if the header cannot be parsed.
        OddError: if only what is sound was asked for, and this is not.
    """
    header = elements.read_elements(stream, _TAG_LIST, forced, sound)
    if not elements.text(header, _TAGS["SeriesInstanceUID"]):
        return ()
    found = _slice_header(path, stream, header)
    if found.identity.sop_class not in MULTI_FRAME or found.damage:
        return (found,)
    if sound:
        raise OddError
    from app.imaging.enhanced import frames_of

    return frames_of(found, stream)


def _slice_header(path: Path, stream: BinaryIO, header: Elements) -> SliceHeader:
    problems: list[str] = []
    identity = _identity(header)
    pixel_format = _guarded(_format, header, problems) or PixelFormat.unknown()
    pixels = find_pixels(stream, header, pixel_format)
    plane = _guarded(_plane, header, problems)
    rescale = _guarded(_rescale, header, problems)
    damage = "; ".join([*problems, *([pixels.damage] if pixels.damage else [])])
    if identity.modality == "MR" and rescale is None:
        rescale = _AS_STORED  # MR has no unit to be scaled to
    return SliceHeader(
        path,
        identity,
        pixel_format,
        plane,
        rescale,
        _windows(header),
        pixels,
        damage,
        thickness_mm=_thickness(header),
        marks=_marks(header),
    )


def _thickness(header: Elements) -> float | None:
    """SliceThickness, which nothing is placed by; one that cannot be read is none."""
    try:
        return next(iter(elements.numbers(header, _TAGS["SliceThickness"], "SliceThickness")), None)
    except FileDamagedError:
        return None


def _marks(header: Elements) -> tuple[tuple[str, str], ...]:
    values = ((mark, elements.text(header, _TAGS[name])) for mark, name in _MARKS.items())
    return tuple((mark, value) for mark, value in values if value)


def _guarded(read, header: Elements, problems: list[str]):  # type: ignore[no-untyped-def]
    try:
        return read(header)
    except FileDamagedError as error:
        problems.append(str(error))
        return None


def _identity(header: Elements) -> Identity:
    def get(name: str) -> str:
        return elements.text(header, _TAGS[name])

    return Identity(
        sop_uid=get("SOPInstanceUID"),
        sop_class=get("SOPClassUID"),
        series_uid=get("SeriesInstanceUID"),
        modality=get("Modality"),
        image_type=elements.parts(header, _TAGS["ImageType"]),
        label=_label(get("SeriesNumber"), get("BodyPartExamined"), get("ConvolutionKernel")),
        pseudonym=pseudonym(get("PatientID"), get("StudyInstanceUID"), get("StudyID")),
        former=former_pseudonym(get("PatientID"), get("StudyInstanceUID")),
        frame_of_reference=get("FrameOfReferenceUID"),
    )


def _label(number: str, body_part: str, kernel: str) -> str:
    """Built from coded elements, and of these from known words only: free text may hold a name."""
    number = number if number.isdigit() and len(number) <= 5 else "?"
    body_part = body_part if body_part in body_parts() else ""
    first = kernel.split(chr(92))[0]
    kernel = f"kernel {first}" if first and is_kernel(first) else ""
    return ", ".join(part for part in (f"Series {number}", body_part, kernel) if part)


def _format(header: Elements) -> PixelFormat:
    def get(name: str, default: int) -> int:
        value = elements.integer(header, _TAGS[name], name)
        return default if value is None else value

    signed = get("PixelRepresentation", 0) == 1
    allocated = get("BitsAllocated", 0)
    stored = get("BitsStored", allocated)
    frames = elements.integer_string(header, _TAGS["NumberOfFrames"], "NumberOfFrames")
    padding = elements.integer(header, _TAGS["PixelPaddingValue"], "PixelPaddingValue", signed)
    limit = elements.integer(
        header, _TAGS["PixelPaddingRangeLimit"], "PixelPaddingRangeLimit", signed
    )
    return PixelFormat(
        rows=get("Rows", 0),
        columns=get("Columns", 0),
        samples=get("SamplesPerPixel", 1),
        frames=1 if frames is None else frames,
        bits_allocated=allocated,
        bits_stored=stored,
        high_bit=get("HighBit", stored - 1),
        signed=signed,
        photometric=elements.text(header, _TAGS["PhotometricInterpretation"]),
        padding=None if padding is None else _range(padding, padding if limit is None else limit),
    )


def _range(a: int, b: int) -> tuple[int, int]:
    return min(a, b), max(a, b)


def _plane(header: Elements) -> Plane | None:
    def get(name: str, count: int) -> tuple[float, ...]:
        return elements.numbers(header, _TAGS[name], name, count)

    position = get("ImagePositionPatient", 3)
    orientation = get("ImageOrientationPatient", 6)
    spacing = get("PixelSpacing", 2)
    if not (position and orientation and spacing):
        return None
    if min(spacing) <= 0.0:
        raise FileDamagedError(f"PixelSpacing is {spacing}; both must be above zero")
    check_orientation(orientation)
    return Plane(position, orientation, spacing)  # type: ignore[arg-type]  # counts were checked


def check_orientation(orientation: tuple[float, ...]) -> None:
    """See that direction cosines are what they should be, to a thousandth.

    Raises:
        FileDamagedError: if they are not two perpendicular unit vectors.
    """
    row, column = orientation[:3], orientation[3:]
    norms = [sum(v * v for v in vector) ** 0.5 for vector in (row, column)]
    dot = sum(a * b for a, b in zip(row, column, strict=True))
    if max(abs(norm - 1.0) for norm in norms) > 1e-3 or abs(dot) > 1e-3:
        raise FileDamagedError(
            f"ImageOrientationPatient {orientation} is not two perpendicular unit vectors"
        )


def _rescale(header: Elements) -> Rescale | None:
    slope = elements.numbers(header, _TAGS["RescaleSlope"], "RescaleSlope", 1)
    intercept = elements.numbers(header, _TAGS["RescaleIntercept"], "RescaleIntercept", 1)
    kind = elements.text(header, _TAGS["RescaleType"]).upper()
    is_mr = elements.text(header, _TAGS["Modality"]) == "MR"
    if not (slope and intercept) or (kind not in ("", "HU") and not is_mr):
        return None
    if slope[0] == 0.0:
        raise FileDamagedError("RescaleSlope is 0; every pixel would have the same value")
    return Rescale(slope[0], intercept[0])


def _windows(header: Elements) -> tuple[tuple[float, float], ...]:
    """Width and level pairs; a window that cannot be used is no reason to refuse a file."""
    try:
        levels = elements.numbers(header, _TAGS["WindowCenter"], "WindowCenter")
        widths = elements.numbers(header, _TAGS["WindowWidth"], "WindowWidth")
    except FileDamagedError:
        return ()
    pairs = zip(widths, levels, strict=False)
    return tuple(dict.fromkeys((width, level) for width, level in pairs if width >= 1.0))
