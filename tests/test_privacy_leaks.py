"""Forty invented identifiers in a CT's header: none of them reaches anything that Acus writes.

The series is imported, opened, planned, practised on, scored and exported by the real commands,
and opened, practised on and imported in the real window; then every file they left, every line they
printed and the window's log are searched. Its folder and files are named like the patient.
"""

import io
import json
import os
import re
import subprocess
import sys
import zlib
from pathlib import Path

import pydicom
import pytest
from mcap.reader import make_reader
from pydicom.dataset import Dataset

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
    """Runs commands in user folders of their own and keeps what they print."""

    def __init__(self, root: Path) -> None:
        self.root, self.said = root, ""
        self.environment = os.environ | {
            "ACUS_SETTINGS": str(root / "settings"), "ACUS_DATA": str(root / "data"),
            "ACUS_SESSIONS": str(root / "sessions"), "QT_QPA_PLATFORM": "offscreen",
        }  # fmt: skip

    def __call__(self, *arguments: object, module: str = "app", says: bool = True) -> str:
        done = subprocess.run(
            [sys.executable, "-m", module, *map(str, arguments)], env=self.environment,
            cwd=ROOT, capture_output=True, text=True, timeout=600, check=False,
        )  # fmt: skip
        if says:
            self.said += done.stdout + done.stderr
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


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


def spoilt(source: Path, target: Path) -> Path:
    """Folders that cannot be opened: files cut off, and one that is no DICOM at all."""
    (target / "Zqmustermann_cut").mkdir(parents=True)
    for path in sorted(source.iterdir())[:5]:
        (target / "Zqmustermann_cut" / path.name).write_bytes(path.read_bytes()[:-1000])
    (target / "Zqmustermann_none").mkdir()
    (target / "Zqmustermann_none" / "Zqmustermann.dcm").write_bytes(b"Zqmustermann" * 1000)
    return target


@pytest.mark.timeout(900)
def test_no_identifier_of_a_ct_reaches_anything_that_is_written(tmp_path):
    source = marked(tmp_path / "outside")
    words = needles(pydicom.dcmread(next(source.iterdir())))
    assert len(TEXTS) == 40
    assert len(leaks(next(source.iterdir()).read_bytes(), words)) > 40  # they can be found
    acus = Acus(tmp_path / "inside")
    # Of the source itself UIDs are told, to name a series by; nothing else.
    listing = acus("ct", "list", source, "--json=1", says=False)
    assert not leaks(
        listing.replace(str(source), "").encode(), {w for w in words if "2.25" not in w}
    )
    imported = json.loads(acus("ct", "import", source, "--json=1"))
    acus("ct", "import", source)
    acus("ct", "library", "--json=1")
    acus("ct", "list", imported["folder"], "--json=1")
    acus("ct", "point", imported["folder"], "--voxel", "3,4,5", "--json=1")
    out = tmp_path / "inside" / "out"
    # On the original where it lies, which says more than the copy would.
    assert "score" in acus(source, out, module="tests.virtual_attempt")
    sessions = ("--folder", out / "sessions")
    (attempt,) = json.loads(acus("session", "list", *sessions, "--json=1"))["sessions"]
    acus("session", "show", attempt["id"], *sessions, "--json=1")
    path = out / f"{attempt['id']}.csv"
    acus("session", "export", attempt["id"], *sessions, "--trajectory", "--out", path)
    acus("transform", "export", out / "plan.mrk.json", "--out", out / "placed.tfm")
    written = [path for path in (tmp_path / "inside").rglob("*") if path.is_file()]
    kinds = {path.suffix for path in written}
    assert kinds >= {".dcm", ".json", ".mcap", ".csv", ".pdf", ".tfm"}, kinds
    for path in written:
        assert leaks(str(path).encode() + readable(path), words) == [], path
    assert leaks(acus.said.encode(), words) == []


@pytest.mark.timeout(900)
def test_no_identifier_reaches_the_log_of_the_window_or_what_it_writes(tmp_path):
    source = marked(tmp_path / "outside")
    words = needles(pydicom.dcmread(next(source.iterdir())))
    acus = Acus(tmp_path / "inside")
    broken = spoilt(source, tmp_path / "outside" / "broken")
    out = tmp_path / "inside" / "out"
    assert int(acus(source, broken, out, module="tests.window_attempt").split()[0]) >= 4
    written = [path for path in (tmp_path / "inside").rglob("*") if path.is_file()]
    assert {path.suffix for path in written} >= {".dcm", ".mcap", ".log"}
    assert b"the log is open" in (out / "window.log").read_bytes()
    for path in written:
        if path.name != "window.ini":  # recent folders that the user opened: docs/privacy.md
            assert leaks(str(path).encode() + readable(path), words) == [], path
    assert leaks(acus.said.encode(), words) == []


def test_errors_of_an_import_quote_neither_values_nor_paths(tmp_path):
    source = marked(tmp_path / "outside")
    words = needles(pydicom.dcmread(next(source.iterdir())))
    acus = Acus(tmp_path / "inside")
    for path in source.iterdir():
        dataset = pydicom.dcmread(path)
        dataset.BurnedInAnnotation = "YES"
        dataset.save_as(path)
    done = subprocess.run(
        [sys.executable, "-m", "app", "ct", "import", str(source)], env=acus.environment,
        capture_output=True, text=True, timeout=100, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "BurnedInAnnotation" in done.stderr
    assert leaks((done.stdout + done.stderr).encode(), words) == []
