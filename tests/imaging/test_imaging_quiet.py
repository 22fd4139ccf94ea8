"""Names in faulty elements reach no log, no terminal and no message."""

import os
import subprocess
import sys
from pathlib import Path

import nibabel
import nrrd
import numpy as np
import pydicom
import pytest
from pydicom.data import get_testdata_file

from tests.imaging.dicom_factory import Slices

ROOT = Path(__file__).resolve().parents[2]
NAME = "DOE^JANE"

PROGRAM = """
import logging, sys, warnings
from pathlib import Path
logging.basicConfig(level=logging.DEBUG, format="%(name)s %(message)s")
warnings.simplefilter("always")
from app.core.errors import AcusError
from app.imaging.library import CtLibrary
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.imaging.structures.files import read_structures, write_structures
warnings.simplefilter("always")
from app.imaging import silence
silence()
here = Path(sys.argv[1])
for folder in sorted(here.iterdir()):
    listing = scan_folder(folder)
    for one in listing.series:
        print(folder.name, one.label, one.reason, one.notes, one.pseudonym, one.usable)
        try:
            print(CtLibrary().import_series(one).report.lines())
        except AcusError as error:
            print(error)
    for one in listing.ignored:
        print(one.reason)
volume = load_ct(here / "sound")
for path in sorted((here / "structures").iterdir()):
    try:
        found = read_structures(path, volume)
        write_structures(here / "out.dcm", found, volume)
    except AcusError as error:
        print(error)
"""


def spoilt(path, *tags):
    """Put a name where a number, a UID or a code is wanted, past pydicom's own checks."""
    data = path.read_bytes()
    for tag, kind in tags:
        at = data.index(tag + kind)
        length = int.from_bytes(data[at + 6 : at + 8], "little")
        data = data[: at + 8] + NAME.ljust(length).encode()[:length] + data[at + 8 + length :]
    path.write_bytes(data)


POSITION, WINDOW, KVP = b"\x20\x00\x32\x00", b"\x28\x00\x50\x10", b"\x18\x00\x60\x00"
CHARSET, AGE, SPACING = b"\x08\x00\x05\x00", b"\x10\x00\x10\x10", b"\x28\x00\x30\x00"
SERIES, SYNTAX, INSTANCE = b"\x20\x00\x0e\x00", b"\x02\x00\x10\x00", b"\x20\x00\x13\x00"


@pytest.fixture
def folder(tmp_path):
    tags = {
        "PatientName": NAME, "SpecificCharacterSet": "ISO_IR 100", "PatientAge": "045Y",
        "KVP": "120.000000", "WindowCenter": "40.000000", "WindowWidth": "400.00000",
        "InstanceNumber": "10000001",
    }  # fmt: skip
    Slices(tags=tags).write(tmp_path / "in" / "sound")
    faults = {
        "position": (POSITION, b"DS"), "window": (WINDOW, b"DS"), "kvp": (KVP, b"DS"),
        "charset": (CHARSET, b"CS"), "age": (AGE, b"AS"), "spacing": (SPACING, b"DS"),
        "series": (SERIES, b"UI"), "syntax": (SYNTAX, b"UI"), "instance": (INSTANCE, b"IS"),
    }  # fmt: skip
    for name, fault in faults.items():
        for path in Slices(tags=tags).write(tmp_path / "in" / name):
            spoilt(path, fault)
    structures = tmp_path / "in" / "structures"
    structures.mkdir()
    seg = structures / "seg.dcm"
    seg.write_bytes(Path(get_testdata_file("liver.dcm")).read_bytes())
    spoilt(seg, (SPACING, b"DS"))
    data = np.zeros((4, 5, 6), np.uint8)
    image = nibabel.Nifti1Image(data, np.eye(4))
    image.header["descrip"] = NAME.encode()
    image.header["sform_code"] = 99
    nibabel.save(image, structures / "labels.nii")
    raw = bytearray((structures / "labels.nii").read_bytes())
    raw[70:72] = b"JA"  # its type of data
    (structures / "labels.nii").write_bytes(bytes(raw))
    nrrd.write(str(structures / "x.seg.nrrd"), data, {"Segment0_Name": NAME})
    text = (structures / "x.seg.nrrd").read_bytes().replace(b"sizes: 4 5 6", b"sizes: DOE^JANE")
    (structures / "x.seg.nrrd").write_bytes(text)
    return tmp_path / "in"


@pytest.mark.long("statistics")
def test_a_name_in_a_faulty_element_reaches_no_log_and_no_message(folder, tmp_path):
    environment = os.environ | {"PYTHONWARNINGS": "always", "ACUS_DATA": str(tmp_path / "data"),
                                "ACUS_SETTINGS": str(tmp_path / "settings")}  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(folder)],
        capture_output=True, cwd=ROOT, text=True, env=environment,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    said = done.stdout + done.stderr
    assert "kvp" in said
    told = [line for line in said.splitlines() if "JANE" in line.upper() or "DOE^" in line.upper()]
    assert told == []


@pytest.mark.long("journey")
def test_packages_that_are_loaded_later_are_kept_quiet_too(folder):
    program = (
        "import logging, sys; logging.basicConfig(level=0); import app.imaging;"
        "import pydicom, nibabel, highdicom, pynetdicom; pydicom.dcmread(sys.argv[1]).KVP;"
        "[logging.getLogger(n).critical('JANE') for n in ('pydicom', 'nibabel.global',"
        " 'highdicom.seg.sop', 'pynetdicom.events', 'openjpeg.utils')]"
    )
    command = [sys.executable, "-c", program, str(folder / "kvp" / "s000")]
    done = subprocess.run(command, capture_output=True, cwd=ROOT, text=True)
    assert done.returncode == 0, done.stderr
    assert "JANE" not in done.stderr


def test_the_faults_are_where_the_test_wants_them(folder):
    assert str(pydicom.dcmread(folder / "kvp" / "s000").get_item("KVP").value, "ascii")[:8] == NAME
