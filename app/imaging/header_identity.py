"""Whose image a file holds, in words that tell nobody's name."""

from app.imaging import elements
from app.imaging.elements import Elements
from app.imaging.header import Identity
from app.imaging.header_tags import TAGS
from app.imaging.privacy.known_words import body_parts, is_kernel
from app.imaging.privacy.pseudonyms import former_pseudonym, pseudonym


def identity_of(header: Elements) -> Identity:
    """Which object a file holds; patient and study only inside the pseudonym."""

    def get(name: str) -> str:
        return elements.text(header, TAGS[name])

    return Identity(
        sop_uid=get("SOPInstanceUID"),
        sop_class=get("SOPClassUID"),
        series_uid=get("SeriesInstanceUID"),
        modality=get("Modality"),
        image_type=elements.parts(header, TAGS["ImageType"]),
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
