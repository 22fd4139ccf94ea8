"""De-identification of one data set: attribute by attribute, into sequences, private ones out."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import timedelta
from typing import Any

from pydicom.datadict import keyword_for_tag
from pydicom.dataelem import DataElement
from pydicom.dataset import Dataset
from pydicom.tag import BaseTag

from app.core.messages import sentence
from app.imaging.privacy import dates
from app.imaging.privacy.errors import PrivacyError
from app.imaging.privacy.forms import fits, values
from app.imaging.privacy.profile import KeptAttribute, Profile
from app.imaging.privacy.report import Tally
from app.imaging.privacy.uids import UidMap

METHOD = "Acus: PS3.15 Basic Profile"
_DEEPEST = 8
_CODES = (  # PS3.16 CID 7050
    ("113100", "Basic Application Confidentiality Profile"),
    ("113107", "Retain Longitudinal Temporal Information Modified Dates Option"),
    ("113108", "Retain Patient Characteristics Option"),
)
DECLARED = "\n".join(
    (METHOD, "MODIFIED", "YES", "DCM", *(part for code in _CODES for part in code))
)
"""What every written file says of itself; a file that came de-identified may say the same."""

_EMPTY = (  # type 2 of the CT image: must stand there, with or without a value
    "StudyDate",
    "StudyTime",
    "AccessionNumber",
    "ReferringPhysicianName",
    "PatientBirthDate",
    "PatientSex",
    "Manufacturer",
    "KVP",
    "AcquisitionNumber",
    "SeriesNumber",
    "InstanceNumber",
    "PositionReferenceIndicator",
)


@dataclass(frozen=True, slots=True)
class Rules:
    """How a patient's files are treated.

    Attributes:
        profile: the tables.
        uids: old UIDs to new ones.
        shift: added to every date.
        patient: PatientID and name to write.
        study: StudyID to write.
    """

    profile: Profile
    uids: UidMap
    shift: timedelta
    patient: str
    study: str


def deidentified(dataset: Dataset, rules: Rules, tally: Tally) -> Dataset:
    """Return a new data set that holds only what may be kept.

    Args:
        dataset: as it was read; it is not changed.
        rules: of this patient.
        tally: counts what is done.

    Raises:
        PrivacyError: if sequences are nested deeper than eight levels.
    """
    result = _treated(dataset, rules, tally, 0)
    if "PixelData" in dataset:
        result[_PIXELS] = _pixels(dataset)
    for keyword in _EMPTY:
        if keyword not in result:
            setattr(result, keyword, None)
            tally.emptied[keyword] += 1
    result.PatientName = result.PatientID = rules.patient
    result.StudyID = rules.study
    tally.replaced.update(("PatientName", "PatientID", "StudyID"))
    _declare(result)
    for keyword in _DECLARING:  # written anew at once: not counted as gone
        tally.removed.pop(keyword, None)
    return result


_DECLARING = (
    "PatientIdentityRemoved",
    "DeidentificationMethod",
    "DeidentificationMethodCodeSequence",
    "LongitudinalTemporalInformationModified",
)
_PIXELS = BaseTag(0x7FE00010)


def _pixels(dataset: Dataset) -> DataElement:
    """Return the pixels bit for bit, under the VR that the standard asks for (PS3.5 A.4, 8.1.1)."""
    raw = dataset["PixelData"]
    encapsulated = bool(getattr(raw, "is_undefined_length", False))
    wide = int(dataset.get("BitsAllocated", 16) or 16) > 8
    vr = "OW" if wide and not encapsulated else "OB"
    element = DataElement(_PIXELS, vr, raw.value)
    element.is_undefined_length = encapsulated
    return element


def _declare(result: Dataset) -> None:
    """Say what was done (PS3.15 E.1.1, PS3.3 C.12.1.1.2)."""
    result.PatientIdentityRemoved = "YES"
    result.DeidentificationMethod = METHOD
    result.DeidentificationMethodCodeSequence = [_code(*code) for code in _CODES]
    result.LongitudinalTemporalInformationModified = "MODIFIED"


def _code(value: str, meaning: str) -> Dataset:
    item = Dataset()
    item.CodeValue, item.CodingSchemeDesignator, item.CodeMeaning = value, "DCM", meaning
    return item


def _treated(dataset: Dataset, rules: Rules, tally: Tally, depth: int) -> Dataset:
    if depth > _DEEPEST:
        raise PrivacyError(
            sentence("its sequences are nested deeper than {deepest} levels", deepest=_DEEPEST)
        )
    result = Dataset()
    for tag in list(dataset.keys()):
        kept = rules.profile.kept.get(int(tag))
        if tag.is_private:
            tally.private += 1
        elif tag.element == 0:
            continue  # a group's length (PS3.5 7.2, retired): says nothing, and is written no more
        elif kept is None:
            tally.removed[keyword_for_tag(tag) or f"({tag.group:04X},{tag.element:04X})"] += 1
        elif kept.kind == "items":
            items = [_treated(item, rules, tally, depth + 1) for item in _items(dataset, tag)]
            result.add_new(tag, "SQ", items)
        elif kept.kind != "pixels":
            _keep(result, dataset, tag, kept, rules, tally)
    return result


def _items(dataset: Dataset, tag: BaseTag) -> list[Dataset]:
    element = dataset[tag]
    return list(element.value or ()) if element.VR == "SQ" else []


def _keep(
    result: Dataset,
    dataset: Dataset,
    tag: BaseTag,
    stored: KeptAttribute,
    rules: Rules,
    tally: Tally,
) -> None:
    """Copy one attribute in the form in which it may be kept, or leave it out."""
    try:
        element = dataset[tag]
        treat = _TREATMENTS.get(_kind(stored, tag, rules), _checked)
        value = treat(element.value, stored, rules, tally)
    except (ValueError, TypeError, AttributeError, NotImplementedError, OverflowError):
        value = None
    if value is None:
        tally.unfit[stored.keyword] += 1
        return
    result.add_new(tag, element.VR, value)


def _kind(stored: KeptAttribute, tag: BaseTag, rules: Rules) -> str:
    return "remapped" if rules.profile.actions.get(int(tag)) == "U" else stored.kind


def _checked(value: Any, stored: KeptAttribute, rules: Rules, tally: Tally) -> Any:
    return value if fits(stored, value) else None


def _first(value: Any, stored: KeptAttribute, rules: Rules, tally: Tally) -> Any:
    """Words stand in an order that counts (ImageType): keep them up to the first unknown one."""
    known: list[str] = []
    for word in (str(item).strip() for item in values(value)):
        if word not in stored.words:
            break
        known.append(word)
    if len(known) < len(values(value)):
        tally.unfit[stored.keyword] += 1
    return known or None


def _remapped(value: Any, stored: KeptAttribute, rules: Rules, tally: Tally) -> Any:
    tally.replaced[stored.keyword] += 1
    new = [rules.uids.new(str(uid)) for uid in values(value)]
    return new[0] if len(new) == 1 else new or None


def _shifted(value: Any, stored: KeptAttribute, rules: Rules, tally: Tally) -> Any:
    moved = dates.shifted(str(value or ""), rules.shift)
    if moved:
        tally.shifted[stored.keyword] += 1
    return moved or (None if value else "")


def _aged(value: Any, stored: KeptAttribute, rules: Rules, tally: Tally) -> Any:
    return dates.capped_age(str(value or "")) or None


Treatment = Callable[[Any, KeptAttribute, Rules, Tally], Any]
_TREATMENTS: dict[str, Treatment] = {
    "remapped": _remapped,
    "date": _shifted,
    "age": _aged,
    "words": _first,
}
