"""A CT with forty invented identifiers in its header, and what searches for them.

Its folder and files are named like the patient; `Acus` runs the program in user folders of its own
and keeps what it prints.
"""

import io
import os
import re
import subprocess
import sys
import zlib
from pathlib import Path
from unittest.mock import patch

import pydicom
import pytest
from mcap.reader import make_reader
from pydicom.dataset import Dataset

from app.__main__ import main
from app.imaging.phantom.series import phantom_series

TEXTS = {
    "PatientName": "Zqmustermann^Hanspeter", "PatientID": "ZQ-4711-0815",
    "OtherPatientIDs": "ZQOTHER77",
    "PatientBirthName": "Zqgeborene", "PatientAddress": "Zqstrasse 12 Zqstadt",
    "PatientTelephoneNumbers": "+49 171 5550199", "AccessionNumber": "ZQACC20260199",
    "InstitutionName": "Zqklinikum Nord", "InstitutionAddress": "Zqallee 4",
    "InstitutionalDepartmentName": "Zqradiologie", "ReferringPhysicianName": "Zqueberweiser^Otto",
    "OperatorsName": "Zqmtra^Anna", "PerformingPhysicianName": "Zqarzt^Karl",
    "NameOfPhysiciansReadingStudy": "Zqbefunder^Lena", "StationName": "ZQCTRAUM3",
    "DeviceSerialNumber": "ZQSN90210", "StudyDescription": "Zqthorax von Zqmustermann",
    "SeriesDescription": "Zqserie Hanspeter", "ProtocolName": "Zqprotokoll Hans",
    "PatientComments": "Zqkommentar lang", "ImageComments": "Zqbildtext", "StudyID": "ZQST0815",
    "AdditionalPatientHistory": "Zqanamnese lang", "Occupation": "Zqbeamter",
    "RequestingPhysician": "Zqanforderer^Uwe", "RequestedProcedureDescription": "Zqanforderung",
    "ConvolutionKernel": "ZQKERNELNAME", "BodyPartExamined": "ZQBODYPART",
    "SoftwareVersions": "Zqversion",
    "PatientBirthDate": "19370331", "StudyDate": "20260317", "StudyTime": "134259.771",
    "AcquisitionDateTime": "20260317134301.123456", "PatientAge": "097Y",
    "ManufacturerModelName": "Zqmodell", "ContrastBolusAgent": "Zqkontrast",
    "PatientReligiousPreference": "Zqglaube",
    "RetrieveAETitle": "ZQPACSAE", "DerivationDescription": "Zqableitung",
    "TextValue": "Zqfreitext",
}  # fmt: skip
PRIVATE = {
    "LO": "Zqprivat eins",
    "OB": b"Zqprivat zwei ",
    "UT": "Zqprivat drei",
    "UR": "http://zq.example/privat",
}
UIDS = ("StudyInstanceUID", "SeriesInstanceUID", "FrameOfReferenceUID", "SOPInstanceUID")
FOLDER = "Zqmustermann_Hanspeter_1937"
ROOT = Path(__file__).resolve().parents[1]


def needles(original: Dataset) -> set[str]:
    """Everything that must be found nowhere, in the pieces in which it could leak."""
    values = [*TEXTS.values(), *(str(value) for value in PRIVATE.values()), "Zqverschachtelt^Ida"]
    pieces = {piece.lower() for value in values for piece in re.split(r"[^\w-]+", value)}
    found = {piece for piece in pieces if "zq" in piece and len(piece) >= 6}
    found |= {
        "hanspeter",
        "4711-0815",
        "5550199",
        "19370331",
        "20260317",
        "134259.771",
        "zqpreamble",
    }
    return found | {str(original[uid].value) for uid in UIDS}


def marked(folder: Path) -> Path:
    """Phantom patient with the identifiers in every file, nested and private ones too."""
    source = phantom_series(1, slices=64, rows=128)
    target = folder / FOLDER
    target.mkdir(parents=True)
    for path in sorted(source.iterdir()):
        dataset = pydicom.dcmread(path)
        for keyword, value in TEXTS.items():
            setattr(dataset, keyword, value)
        block = dataset.private_block(0x0043, "ZQMAKER", create=True)
        for offset, (vr, value) in enumerate(PRIVATE.items()):
            block.add_new(offset, vr, value)
        item = Dataset()
        item.PatientName, item.TextValue = "Zqverschachtelt^Ida", "Zqtief im Baum"
        dataset.RequestAttributesSequence = [item]
        dataset.preamble = b"Zqpreamble Hanspeter".ljust(128, b"\0")
        dataset.save_as(target / f"Zqmustermann {path.name}")
    return target


class Acus:
    """Runs commands in user folders of their own and keeps what they print.

    Args:
        root: of the user folders.
        capfd: of the test, which hears what this process and its children print.
    """

    def __init__(self, root: Path, capfd: pytest.CaptureFixture[str] | None = None) -> None:
        self.said, self._capfd = "", capfd
        self.environment = os.environ | {
            "ACUS_SETTINGS": str(root / "settings"), "ACUS_DATA": str(root / "data"),
            "ACUS_SESSIONS": str(root / "sessions"), "QT_QPA_PLATFORM": "offscreen",
        }  # fmt: skip

    def __call__(self, *arguments: object, says: bool = True, code: int = 0) -> str:
        """Run `acus` in this process, where everything is loaded; return what it prints."""
        assert self._capfd is not None
        with (
            patch.dict(os.environ, self.environment),
            patch.object(sys, "argv", ["acus", *map(str, arguments)]),
            pytest.raises(SystemExit) as ended,
        ):
            main()
        out, err = self._capfd.readouterr()
        return self._heard(out, err, ended.value.code == code, says)

    def apart(self, module: str, *arguments: object) -> str:
        """Run a module in a process of its own; return what it prints."""
        done = subprocess.run(
            [sys.executable, "-m", module, *map(str, arguments)], env=self.environment,
            cwd=ROOT, capture_output=True, text=True, timeout=600, check=False,
        )  # fmt: skip
        return self._heard(done.stdout, done.stderr, done.returncode == 0, True)

    def _heard(self, out: str, err: str, well: bool, says: bool) -> str:
        assert well, out[-4000:] + err[-4000:]
        if says:
            self.said += out + err
        return out


def leaks(text: bytes, words: set[str]) -> list[str]:
    low = text.lower()
    return [word for word in words if any(word.encode(c) in low for c in ("utf-8", "utf-16-le"))]


def pdf_text(path: Path) -> bytes:
    """Text streams of a PDF, inflated."""
    raw, found = path.read_bytes(), b""
    for match in re.finditer(rb"stream\r?\n", raw):
        try:
            found += zlib.decompressobj().decompress(raw[match.end() :])
        except zlib.error:
            continue
    return raw + found


def mcap_text(path: Path) -> bytes:
    """Everything in a record, inflated."""
    raw = path.read_bytes()
    messages = (message.data for *_, message in make_reader(io.BytesIO(raw)).iter_messages())
    metadata = (repr(one).encode() for one in make_reader(io.BytesIO(raw)).iter_metadata())
    files = (one.data for one in make_reader(io.BytesIO(raw)).iter_attachments())
    return b"".join((raw, *messages, *metadata, *files))


def readable(path: Path) -> bytes:
    """What a file says, compressed parts inflated, the pixels of a CT left out."""
    if path.suffix == ".pdf":
        return pdf_text(path)
    if path.suffix == ".mcap":
        return mcap_text(path)
    content = path.read_bytes()
    return content[: content.index(b"\xe0\x7f\x10\x00")] if path.suffix == ".dcm" else content
