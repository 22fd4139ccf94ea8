"""The second pass: what was written is read again and searched for what must not be there."""

import contextlib
import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pydicom
from pydicom.dataelem import DataElement
from pydicom.dataset import Dataset

from app.imaging.privacy.actions import DECLARED
from app.imaging.privacy.errors import NotCleanError
from app.imaging.privacy.forms import values
from app.imaging.privacy.profile import Profile
from app.imaging.privacy.report import Tally

_SHORTEST = 4
_SHORTEST_NUMBER = 6
_SHORTEST_IN_PIXELS = 8  # a shorter one may stand there by chance
_TEXT = ("AE", "LO", "LT", "PN", "SH", "ST", "UC", "UR", "UT", "CS", "AS", "IS", "DS", "UN")
_ADDED = (
    "PatientName", "PatientID", "StudyID", "PatientIdentityRemoved", "DeidentificationMethod",
    "DeidentificationMethodCodeSequence", "CodeValue", "CodingSchemeDesignator", "CodeMeaning",
    "LongitudinalTemporalInformationModified", "StudyTime", "AccessionNumber",
    "ReferringPhysicianName", "PatientBirthDate", "Manufacturer", "PositionReferenceIndicator",
)  # fmt: skip


_NUMERIC = ("IS", "DS", "US", "UL", "UV", "SS", "SL", "SV", "FD", "FL")
_DATE = re.compile(r"(\d{4})[.]?(\d{2})[.]?(\d{2})")
_DIGITS = 5
_NUMBERS = ("PatientID", "OtherPatientIDs", "AccessionNumber", "IssuerOfPatientID")
_GEOMETRY = (
    "ImagePositionPatient", "ImageOrientationPatient", "PixelSpacing", "RescaleSlope",
    "RescaleIntercept", "NumberOfFrames",
)  # fmt: skip


@dataclass(slots=True)
class Secrets:
    """What the original files said and the new ones must not: kept in memory only.

    Attributes:
        profile: the tables.
        texts: words and numbers of attributes that are not kept.
        names: those of them that are a person's name or number: not even the pixels may hold one,
            where a damaged or prepared file can have it.
        digits: dates in the orders in which people write them, and the digits of the patient's
            numbers, as one number: no kept number may be one of them.
    """

    profile: Profile
    texts: set[str] = field(default_factory=set)
    names: set[str] = field(default_factory=set)
    digits: set[int] = field(default_factory=set)

    def gather(self, original: Dataset) -> None:
        """Collect what stands in attributes that are not kept, at any depth."""
        for element in _elements(original, 0):
            self._gather_digits(element)
            listed = int(element.tag) in self.profile.kept
            if not listed and (element.VR in _TEXT or element.tag.is_private):
                found = {
                    text
                    for text in _words(element)
                    if text not in self.profile.vocabulary and text not in DECLARED
                }
                self.texts |= found
                if element.VR == "PN" or element.keyword in _NUMBERS:
                    self.names |= found

    def _gather_digits(self, element: DataElement) -> None:
        if element.VR in ("DA", "DT"):
            for value in values(element.value):
                found = _DATE.match(str(value))
                if found is not None:
                    self.digits |= set(_date_numbers(*found.groups()))
        elif element.keyword in _NUMBERS:
            for value in values(element.value):
                runs = re.findall(r"\d+", str(value))
                self.digits |= {int(run) for run in (*runs, "".join(runs)) if len(run) >= _DIGITS}

    def scrub(self, result: Dataset, tally: Tally) -> None:
        """Take out kept numbers that repeat an identifier, and texts that repeat anything."""
        for element in list(_elements(result, 0)):
            if self.repeats(element) and element.tag in result:
                result[element.tag].clear()
                tally.unfit[element.keyword] += 1

    def repeats(self, element: DataElement) -> bool:
        """Whether an element that may be kept says what a removed one said."""
        if element.keyword in _GEOMETRY or element.keyword in _ADDED:
            return False
        if element.VR in _NUMERIC and any(self._tells(value) for value in values(element.value)):
            return True
        if element.VR not in _TEXT:
            return False
        numeric = element.VR in ("IS", "DS")
        secrets = [text for text in self.texts if _numeric(text) or not numeric]
        return any(secret in str(value) for value in values(element.value) for secret in secrets)

    def _tells(self, value: object) -> bool:
        """Whether a number is a date or the digits of a number of the patient's."""
        text = str(getattr(value, "original_string", value)).strip().lower()
        whole = re.sub(r"\D", "", text.split("e")[0].split(".")[0])
        all_of_it = re.sub(r"\D", "", text.split("e")[0])
        return any(part and int(part) in self.digits for part in (whole, all_of_it))


def _date_numbers(year: str, month: str, day: str) -> Iterator[int]:
    """Yield a date as one number, in the orders in which people write it."""
    for order in ((year, month, day), (day, month, year), (month, day, year)):
        yield int("".join(order))
        yield int("".join(part[-2:] for part in order))


def pixel_digest(dataset: Dataset) -> str:
    """SHA-256 of the pixels as they stand in the file, encoded or not."""
    return hashlib.sha256(dataset["PixelData"].value).hexdigest()


def verify(path: Path, secrets: Secrets, old_uids: frozenset[str], pixels: str) -> None:
    """Search one written file.

    Args:
        path: the file.
        secrets: of the originals.
        old_uids: none of them may stand in it.
        pixels: `pixel_digest` that it must have.

    Raises:
        NotCleanError: naming the attribute, never the value.
    """
    written = pydicom.dcmread(path)
    if (written.preamble or b"").strip(b"\0"):
        raise NotCleanError(f"{path.name}: the preamble is not empty")
    for part in (written.file_meta, written):
        for element in _elements(part, 0):
            _check(path, element, secrets, old_uids)
    if pixel_digest(written) != pixels:
        raise NotCleanError(f"{path.name}: its pixels are not those that were read")
    end = written["PixelData"].file_tell or path.stat().st_size
    whole = path.read_bytes()
    head = whole[:end]
    for secret in secrets.texts:
        if len(secret) >= _SHORTEST_NUMBER and not _numeric(secret) and _in(secret, head):
            raise NotCleanError(f"{path.name}: a text of the original header stands in it")
    if any(len(name) >= _SHORTEST_IN_PIXELS and _in(name, whole) for name in secrets.names):
        raise NotCleanError(f"{path.name}: a name or number of the patient stands in its pixels")


def _check(path: Path, element: DataElement, secrets: Secrets, old: frozenset[str]) -> None:
    name = element.keyword or str(element.tag)
    known = int(element.tag) in secrets.profile.kept or element.keyword in _ADDED
    if element.tag.is_private or not (known or element.tag.group == 2):
        raise NotCleanError(f"{path.name}: {name} should have been removed")
    if element.VR == "UI" and old.intersection(str(value) for value in values(element.value)):
        raise NotCleanError(f"{path.name}: {name} still has its old UID")
    if secrets.repeats(element):
        raise NotCleanError(f"{path.name}: {name} repeats what the original said elsewhere")


def _elements(dataset: Dataset, depth: int) -> Iterator[DataElement]:
    for tag in list(dataset.keys()):
        try:
            element = dataset[tag]
        except Exception:  # unreadable in the original: it is not copied either
            continue
        yield element
        if element.VR == "SQ" and depth < 8:
            for item in element.value or ():
                yield from _elements(item, depth + 1)


def _words(element: DataElement) -> Iterator[str]:
    """Values that are long enough to tell something, whole; bytes as Latin letters."""
    for value in values(element.value):
        text = value.decode("latin-1") if isinstance(value, bytes) else str(value)
        text = text.strip(" \0")
        shortest = _SHORTEST_NUMBER if _numeric(text) else _SHORTEST
        if shortest <= len(text) <= 10240:
            yield text


def _numeric(text: str) -> bool:
    return text.replace(".", "").replace("-", "").isdigit()


def _in(secret: str, head: bytes) -> bool:
    for code in ("utf-8", "latin-1"):
        with contextlib.suppress(UnicodeEncodeError):
            if secret.encode(code) in head:
                return True
    return False
