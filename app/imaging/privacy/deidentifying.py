"""A series de-identified into a folder, in the worker process: the originals are foreign files.

One file in, one de-identified file out; every pixel as it was unless somebody drew on it. A head
scan can be rendered to a likeness of the face: that is said, never quietly dealt with. In a second
pass what was written is read again and searched for what must not be there.
"""

import contextlib
import hashlib
import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
import pydicom
from pydicom.dataelem import DataElement
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian

from app.core.descriptors import hold
from app.core.files import sync
from app.core.messages import sentence
from app.core.progress import Cancelled, Progress
from app.imaging.decoding import read_stored, stored_type
from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.privacy import burned_in, dates
from app.imaging.privacy.actions import DECLARED, Rules, deidentified
from app.imaging.privacy.burned_in import MaskBox, check_numbers, of_picture
from app.imaging.privacy.errors import BurnedInError, NotCleanError, PrivacyError
from app.imaging.privacy.forms import values
from app.imaging.privacy.key import installation_key
from app.imaging.privacy.pixels import take_pixels
from app.imaging.privacy.profile import Profile, profile
from app.imaging.privacy.pseudonyms import patient_pseudonym, pseudonym
from app.imaging.privacy.report import LOCK, Deidentified, Tally, file_name
from app.imaging.privacy.uids import UidMap

_SHORTEST = 4
_SHORTEST_NUMBER = 6
_SHORTEST_IN_PIXELS = 8  # a shorter one may stand there by chance
_TEXT = ("AE", "LO", "LT", "PN", "SH", "ST", "UC", "UR", "UT", "CS", "AS", "IS", "DS", "UN")
_ADDED = (
    "PatientName",
    "PatientID",
    "StudyID",
    "PatientIdentityRemoved",
    "DeidentificationMethod",
    "DeidentificationMethodCodeSequence",
    "CodeValue",
    "CodingSchemeDesignator",
    "CodeMeaning",
    "LongitudinalTemporalInformationModified",
    "StudyTime",
    "AccessionNumber",
    "ReferringPhysicianName",
    "PatientBirthDate",
    "Manufacturer",
    "PositionReferenceIndicator",
)


_NUMERIC = ("IS", "DS", "US", "UL", "UV", "SS", "SL", "SV", "FD", "FL")
_DATE = re.compile(r"(\d{4})[.]?(\d{2})[.]?(\d{2})")
_DIGITS = 5
_NUMBERS = ("PatientID", "OtherPatientIDs", "AccessionNumber", "IssuerOfPatientID")
_GEOMETRY = (
    "ImagePositionPatient",
    "ImageOrientationPatient",
    "PixelSpacing",
    "RescaleSlope",
    "RescaleIntercept",
    "NumberOfFrames",
)


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
        """Return whether an element that may be kept says what a removed one said."""
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
        """Return whether a number is a date or the digits of a number of the patient's."""
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
        raise NotCleanError(sentence("{path_name}: the preamble is not empty", path_name=path.name))
    for part in (written.file_meta, written):
        for element in _elements(part, 0):
            _check(path, element, secrets, old_uids)
    if pixel_digest(written) != pixels:
        raise NotCleanError(
            sentence("{path_name}: its pixels are not those that were read", path_name=path.name)
        )
    end = written["PixelData"].file_tell or path.stat().st_size
    whole = path.read_bytes()
    head = whole[:end]
    for secret in secrets.texts:
        if len(secret) >= _SHORTEST_NUMBER and not _numeric(secret) and _in(secret, head):
            raise NotCleanError(
                sentence(
                    "{path_name}: a text of the original header stands in it", path_name=path.name
                )
            )
    if any(len(name) >= _SHORTEST_IN_PIXELS and _in(name, whole) for name in secrets.names):
        raise NotCleanError(
            sentence(
                "{path_name}: a name or number of the patient stands in its pixels",
                path_name=path.name,
            )
        )


def _check(path: Path, element: DataElement, secrets: Secrets, old: frozenset[str]) -> None:
    name = element.keyword or str(element.tag)
    known = int(element.tag) in secrets.profile.kept or element.keyword in _ADDED
    if element.tag.is_private or not (known or element.tag.group == 2):
        raise NotCleanError(
            sentence("{path_name}: {name} should have been removed", path_name=path.name, name=name)
        )
    if element.VR == "UI" and old.intersection(str(value) for value in values(element.value)):
        raise NotCleanError(
            sentence("{path_name}: {name} still has its old UID", path_name=path.name, name=name)
        )
    if secrets.repeats(element):
        raise NotCleanError(
            sentence(
                "{path_name}: {name} repeats what the original said elsewhere",
                path_name=path.name,
                name=name,
            )
        )


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


_HEAD = re.compile(
    "HEAD|HEADNECK|NECK|BRAIN|SKULL|FACE|EAR|EYE|IAC|JAW|MANDIBLE|MAXILLA|ORBIT|SINUS|CSPINE"
    "|CAROTID|NECKCHEST|NECKCHESTABDOMEN|NECKCHESTABDPELV|WHOLEBODY"
)
_TEXTS = ("StudyDescription", "SeriesDescription", "ProtocolName")
_SPOKEN = re.compile(
    r"\b(head|neck|brain|skull|face|facial|sinus|orbit|crani|cereb|kopf|sch(ae|ä)del|hals|gesicht"
    r"|nnh|t[eê]te|cr[aâ]n|cabeza|testa|hoofd)",
    re.IGNORECASE,
)


def face_warning(dataset: Dataset) -> str:
    """Return what to say about a face in these slices; empty where none is to be expected."""
    part = str(dataset.get("BodyPartExamined", "") or "").strip().upper()
    if _HEAD.fullmatch(part):
        return sentence(
            "a face may be recognisable in the 3D view (body part {part}): nothing was "
            "removed from the pictures; keep this CT where patients' pictures may be kept",
            part=part,
        )
    recognisable = str(dataset.get("RecognizableVisualFeatures", "") or "").strip().upper()
    if recognisable == "YES" or any(_SPOKEN.search(str(dataset.get(k, "") or "")) for k in _TEXTS):
        return sentence(
            "the files' own texts speak of a head or neck: a face may be recognisable in the "
            "3D view; nothing was removed from the pictures"
        )
    if not part:
        return sentence(
            "the files do not say which body part they show: if it is the head, a face may "
            "be recognisable in the 3D view"
        )
    return ""


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
        raise FileDamagedError(
            sentence(
                "it cannot be read: {error_strerror}",
                error_strerror=error.strerror or "no such file",
            )
        ) from None
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise FileDamagedError(
            sentence("it cannot be read ({error_name})", error_name=type(error).__name__)
        ) from None
    if str(dataset.get("SOPInstanceUID", "")).strip(" \0") != header.identity.sop_uid:
        raise FileDamagedError(sentence("it has changed since the folder was looked at"))
    return dataset


def convert(
    header: SliceHeader,
    to: Path,
    rules: Rules,
    boxes: Sequence[MaskBox],
    secrets: Secrets,
    tally: Tally,
) -> str:
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
    if text := face_warning(original):
        tally.warn(text)
    result = deidentified(original, rules, tally)
    secrets.scrub(result, tally)
    if boxes:
        _redraw(header, result, boxes)
        syntax = ExplicitVRLittleEndian
        tally.masked += 1
    else:
        syntax, stripped = take_pixels(header, original, result)
        tally.stripped += stripped
    _write(result, to, syntax)
    tally.files += 1
    return pixel_digest(result)


def _redraw(header: SliceHeader, result: Dataset, boxes: Sequence[MaskBox]) -> None:
    """Write the pixels anew, boxes black."""
    form = header.format
    if form.frames != 1:
        raise BurnedInError(sentence("boxes can be drawn on files of one picture only"))
    stored = np.empty((form.rows, form.columns), stored_type(form))
    read_stored(header, stored)
    slope = header.rescale.slope if header.rescale else 1.0
    stored = burned_in.blackened(stored, boxes, slope, form.photometric == "MONOCHROME1")
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
        str(to),
        result,
        preamble=b"\0" * 128,
        file_meta=meta,
        is_implicit_VR=syntax.is_implicit_VR,
        is_little_endian=syntax.is_little_endian,
    )
    try:
        file.save_as(to, enforce_file_format=True)
    except OSError as error:
        raise _of_the_system(error) from None
    except MemoryError:
        raise
    except Exception as error:  # a value that pydicom will not write; its message would quote it
        raise PrivacyError(
            sentence("it cannot be written anew ({error_name})", error_name=type(error).__name__)
        ) from None
    sync(to)


def _of_the_system(error: OSError) -> OSError:
    """Return the system's own error: pydicom raises another of its type, without the number."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, OSError) and cause.errno:
            return cause
        cause = cause.__cause__ or cause.__context__
    return error


_Made = TypeVar("_Made")


def deidentify_series(
    headers: tuple[SliceHeader, ...],
    key: str,
    staging: Path,
    boxes: tuple[MaskBox, ...],
    settings: Path,
    progress: Progress,
) -> Deidentified:
    """Job of the worker: write every file of a series anew and look through what was written.

    Args:
        headers: one for each file, in the order of the series.
        key: of the series, see `Series.key`.
        staging: folder to write to; it holds a lock file.
        boxes: pixels to blacken.
        settings: folder with the key of the pseudonyms.
        progress: told of each file.

    Raises:
        PrivacyError, FileDamagedError: naming a file by its number only; quoting nothing of it.
        OSError: if a file cannot be written.
    """
    os.environ["ACUS_SETTINGS"] = str(settings)
    with _held(staging):
        return _deidentified(headers, key, staging, boxes, progress)


@contextmanager
def _held(staging: Path) -> Iterator[None]:
    """Hold the lock of the folder too: nobody sweeps it while there is still somebody writing."""
    lock = os.open(staging / LOCK, os.O_RDWR)
    try:
        hold(lock)
        yield
    finally:
        os.close(lock)


def _deidentified(
    headers: Sequence[SliceHeader],
    key: str,
    staging: Path,
    boxes: Sequence[MaskBox],
    progress: Progress,
) -> Deidentified:
    count = len(headers)
    progress.report(0.0, sentence("file 1 of {count}", count=count))
    check_numbers(boxes, count)
    rules = _counted(1, count, lambda: _rules(headers[0]))
    secrets, tally, digests = Secrets(rules.profile), Tally(), []
    for number, header in enumerate(headers, 1):
        progress.report(
            0.7 * (number - 1) / count,
            sentence("file {current} of {count}", current=number, count=count),
        )
        to, drawn = staging / file_name(number), of_picture(boxes, number)
        write = _writer(header, to, rules, drawn, secrets, tally)
        digests.append(_counted(number, count, write))
    for number, digest in enumerate(digests, 1):
        share = 0.7 + 0.3 * (number - 1) / count
        progress.report(
            share, sentence("checking file {current} of {count}", current=number, count=count)
        )
        verify(staging / file_name(number), secrets, rules.uids.old, digest)
    return Deidentified(tally.report(), rules.study, rules.uids.new(key))


def _writer(
    header: SliceHeader,
    to: Path,
    rules: Rules,
    boxes: Sequence[MaskBox],
    secrets: Secrets,
    tally: Tally,
) -> Callable[[], str]:
    return lambda: convert(header, to, rules, boxes, secrets, tally)


def _counted(number: int, count: int, work: Callable[[], _Made]) -> _Made:
    """Name a file by its number: the names of files and folders may tell who the patient is."""
    try:
        return work()
    except Cancelled:
        raise
    except (PrivacyError, FileDamagedError) as error:
        raise type(error)(
            sentence(
                "file {file_number} of {count}: {error}",
                file_number=number,
                count=count,
                error=error,
            )
        ) from None


def _rules(first: SliceHeader) -> Rules:
    original = read_original(first)
    key = installation_key()
    patient = str(original.get("PatientID", "") or "").strip(" \0")
    study = str(original.get("StudyInstanceUID", "") or "").strip(" \0")
    return Rules(
        profile(),
        UidMap(key),
        dates.shift_of(key, patient, study),
        patient_pseudonym(key, patient, study),
        pseudonym(patient, study),
    )
