"""De-identification against another's: every row of the table, as Orthanc treats it.

Orthanc carries PS3.15 table E.1-1 of edition 2021b in its own words. One file with a value in every
attribute of our table goes through both.
"""

import io
import json
import urllib.request
from datetime import timedelta

import pydicom
import pytest
from orthanc_rig import Orthanc
from pydicom.datadict import dictionary_VR
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset

from app.imaging.privacy.actions import Rules, deidentified
from app.imaging.privacy.profile import profile
from app.imaging.privacy.report import Tally
from app.imaging.privacy.uids import UidMap

EDITION = "2021b"
CT = "1.2.840.10008.5.1.4.1.1.2"
EXPLICIT = "1.2.840.10008.1.2.1"
PIXELS = 0x7FE00010
VALUES = {
    "AE": "AETITLE", "AS": "045Y", "CS": "CODE", "DA": "20260317", "DS": "1.5", "IS": "7",
    "DT": "20260317101112", "LO": "Text", "LT": "Text", "PN": "Name^Given", "SH": "Text",
    "ST": "Text", "TM": "101112", "UC": "Text", "UI": "2.25.77", "UR": "http://a.example",
    "UT": "Text", "FL": 1.5, "FD": 1.5, "SL": 7, "SS": 7, "UL": 7, "US": 7, "OB": b"ab",
    "OW": b"ab", "UN": b"ab", "OF": b"abcd", "AT": 0x00100010,
}  # fmt: skip
SHIFTED = {"StudyDate", "SeriesDate", "AcquisitionDate", "ContentDate"}
CHARACTERISTICS = {"PatientAge", "PatientSize", "PatientWeight"}
NAMES = {"PatientName", "PatientID", "StudyID"}


def full() -> Dataset:
    """A value in every attribute of the table that may stand in a data set."""
    dataset = Dataset()
    for tag in sorted(profile().actions):
        if tag >> 16 in (0x0000, 0x0002, 0x0004, 0xFFFA) or tag == PIXELS:
            continue
        vr = dictionary_VR(tag).split(" or ")[0]
        if vr == "SQ":
            item = Dataset()
            item.PatientName = "Name^Given"
            dataset.add_new(tag, "SQ", [item])
        else:
            dataset.add_new(tag, vr, VALUES[vr])
    dataset.SOPClassUID, dataset.SOPInstanceUID, dataset.Modality = CT, "2.25.1", "CT"
    dataset.StudyInstanceUID, dataset.SeriesInstanceUID = "2.25.2", "2.25.3"
    return dataset


def encoded(dataset: Dataset) -> bytes:
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = dataset.SOPClassUID
    meta.MediaStorageSOPInstanceUID = dataset.SOPInstanceUID
    meta.TransferSyntaxUID = EXPLICIT
    file, into = FileDataset("", dataset, file_meta=meta, preamble=b"\0" * 128), io.BytesIO()
    file.save_as(into, enforce_file_format=True)
    return into.getvalue()


def post(address: str, body: bytes) -> bytes:
    request = urllib.request.Request(address, data=body, method="POST")
    with urllib.request.urlopen(request, timeout=60) as answer:
        return answer.read()


def fate(element, result: Dataset) -> str:
    """What became of an element."""
    if element.tag not in result:
        return "removed"
    value = result[element.tag].value
    if value is None or len(str(value)) == 0 or (element.VR == "SQ" and not len(value)):
        return "emptied"
    return "kept" if value == element.value else "changed"


@pytest.fixture(scope="module")
def fates(tmp_path_factory):
    """Of every attribute, by keyword: its action in our table, what Orthanc did, what we did."""
    with Orthanc(tmp_path_factory.mktemp("orthanc")) as archive:
        base = f"http://127.0.0.1:{archive.http}"
        identifier = json.loads(post(f"{base}/instances", encoded(full())))["ID"]
        wish = json.dumps({"DicomVersion": EDITION}).encode()
        theirs = pydicom.dcmread(io.BytesIO(post(f"{base}/instances/{identifier}/anonymize", wish)))
    rules = Rules(profile(), UidMap(b"k" * 32), timedelta(days=-100), "P-1", "CT-1")
    source = pydicom.dcmread(io.BytesIO(encoded(full())))
    ours = deidentified(source, rules, Tally())
    return {
        element.keyword: (
            profile().actions.get(int(element.tag), "K"),
            fate(element, theirs),
            fate(element, ours),
        )
        for element in source
    }


@pytest.mark.long("journey")
def test_every_row_of_the_table_has_the_action_that_orthanc_takes(fates):
    assert len(fates) > 440
    expected = {"X": "removed", "Z": "emptied", "D": "emptied", "U": "changed", "K": "kept"}
    for keyword, (action, theirs, _) in fates.items():
        if keyword in ("PatientName", "PatientID"):  # Orthanc gives the patient another name
            assert theirs == "changed"
        elif action == "X/Z/U*":  # ours to choose; Orthanc keeps the sequence with new UIDs in it
            assert theirs == "kept", keyword
        elif keyword == "TreatmentSite":  # X/D: theirs is the D
            assert (action, theirs) == ("X/D", "emptied")
        else:
            assert theirs == expected[action[0]], (keyword, action)


@pytest.mark.long("journey")
def test_nothing_that_orthanc_takes_out_stays_with_us_but_for_the_two_declared_options(fates):
    stays = {
        name for name, (_, theirs, ours) in fates.items() if ours == "kept" and theirs != "kept"
    }
    assert stays == CHARACTERISTICS
    other = {
        name
        for name, (_, theirs, ours) in fates.items()
        if ours == "changed" and theirs != "changed"
    }
    assert other == SHIFTED | (NAMES - {"PatientName", "PatientID"})


@pytest.mark.long("journey")
def test_we_take_out_whatever_orthanc_takes_out_and_more(fates):
    more = {
        name for name, (_, theirs, ours) in fates.items() if theirs == "kept" and ours == "removed"
    }
    assert more == {"ReferencedImageSequence", "SourceImageSequence"}
    both = [name for name, (_, theirs, ours) in fates.items() if theirs == ours == "removed"]
    assert len(both) > 300
