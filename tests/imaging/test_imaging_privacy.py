"""De-identification: the table, what is kept, what is refused, the library whole or not at all."""

import csv
import os
import resource
import shutil
import subprocess
import sys
import time
from datetime import date, timedelta
from pathlib import Path

import numpy as np
import pydicom
import pytest
from dicom_factory import SERIES, Slices
from pydicom.datadict import keyword_for_tag, tag_for_keyword
from pydicom.dataset import Dataset

from app.core import paths
from app.core.progress import Cancelled, Progress
from app.imaging import library as library_module
from app.imaging.errors import FileDamagedError, SeriesUnknownError
from app.imaging.library import CtLibrary, ImportFailedError
from app.imaging.privacy import dates
from app.imaging.privacy.burned_in import MaskBox
from app.imaging.privacy.deidentifying import Secrets, deidentify_series, pixel_digest, verify
from app.imaging.privacy.errors import BurnedInError, KeyDamagedError, NotCleanError
from app.imaging.privacy.forms import fits
from app.imaging.privacy.key import installation_key, key_path
from app.imaging.privacy.profile import profile
from app.imaging.privacy.pseudonyms import pseudonym
from app.imaging.privacy.uids import UidMap
from app.imaging.reading import load_ct, read_series
from app.imaging.scanning import scan_folder
from app.imaging.worker.pool import ImagingWorker

DATES = {"StudyDate", "SeriesDate", "AcquisitionDate", "ContentDate"}
CHARACTERISTICS = {"PatientSex", "PatientAge", "PatientSize", "PatientWeight"}


def series_of(folder, recipe=None, **tags):
    (recipe or Slices(tags=tags)).write(folder)
    return scan_folder(folder).series[0]


def written(entry):
    return [pydicom.dcmread(path) for path in sorted(entry.folder.glob("*.dcm"))]


def test_every_row_of_the_table_names_an_attribute_of_the_dictionary():
    with (paths.resources() / "dicom" / "basic-profile.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    assert len(rows) > 450
    assert all(keyword_for_tag(int(row["tag"], 16)) == row["attribute"] for row in rows)
    assert len({row["tag"] for row in rows}) == len(rows)


def test_nothing_that_the_profile_removes_is_kept_but_for_the_two_declared_options():
    tables = profile()
    for tag, kept in tables.kept.items():
        action = tables.actions.get(tag, "K")
        if kept.keyword in DATES or kept.keyword in CHARACTERISTICS:
            assert action != "K"
        else:
            assert action in ("K", "U"), kept.keyword


def test_a_series_comes_back_with_the_same_voxels_in_the_same_places(tmp_path):
    series = series_of(tmp_path / "in")
    before = read_series(series)
    imported = CtLibrary().import_series(series)
    after = load_ct(imported.entry.folder)
    np.testing.assert_array_equal(before.hu, after.hu)
    np.testing.assert_array_equal(before.affine_mm, after.affine_mm)
    assert after.series.pseudonym == series.pseudonym
    assert after.series.windows == series.windows


@pytest.mark.promise(
    "docs/privacy.md: Text that somebody could have typed is never kept, wherever it stands"
)
def test_names_identifiers_and_free_text_are_gone_and_it_is_said_what_was_done(tmp_path):
    tags = {"OperatorsName": "Op^Erator", "PatientBirthDate": "19500101", "StudyTime": "101112"}
    imported = CtLibrary().import_series(series_of(tmp_path / "in", **tags))
    for dataset in written(imported.entry):
        text = str(dataset)
        assert "Secret" not in text
        assert "SECRET" not in text
        assert "OperatorsName" not in dataset
        assert dataset.PatientBirthDate == ""
        assert dataset.StudyTime == ""
        assert dataset.PatientIdentityRemoved == "YES"
        assert {item.CodeValue for item in dataset.DeidentificationMethodCodeSequence} == {
            "113100", "113107", "113108",
        }  # fmt: skip
        assert dataset.LongitudinalTemporalInformationModified == "MODIFIED"
    report = "\n".join(imported.report.lines())
    assert "SeriesDescription" in report
    assert "OperatorsName" in report
    assert "Secret" not in report


def test_the_report_names_nothing_twice_and_no_lengths_of_groups(tmp_path):
    recipe = Slices(tags={"BodyPartExamined": "NOTHING", "PatientIdentityRemoved": "NO"})
    for path in recipe.write(tmp_path / "in"):
        dataset = pydicom.dcmread(path)
        dataset.add_new(0x00080000, "UL", 500)
        dataset.save_as(path)
    report = CtLibrary().import_series(scan_folder(tmp_path / "in").series[0]).report
    assert {"PatientID", "PatientName"} <= report.replaced.keys()
    kinds = (report.removed, report.emptied, report.replaced, report.shifted, report.unfit)
    named = [keyword for kind in kinds for keyword in kind]
    assert len(named) == len(set(named))
    assert not any("0000)" in keyword for keyword in named)
    assert "PatientIdentityRemoved" not in named


def test_uids_are_new_the_same_at_every_import_and_shared_by_what_was_shared(tmp_path):
    imported = CtLibrary().import_series(series_of(tmp_path / "in"))
    files = written(imported.entry)
    assert len({file.SeriesInstanceUID for file in files}) == 1
    assert len({file.SOPInstanceUID for file in files}) == 5
    for file in files:
        assert file.file_meta.MediaStorageSOPInstanceUID == file.SOPInstanceUID
        assert file.SeriesInstanceUID.startswith("2.25.")
        assert file.SeriesInstanceUID != SERIES
        assert len(file.SOPInstanceUID) <= 64
    again = CtLibrary().import_series(scan_folder(tmp_path / "in").series[0])
    assert again.again
    assert again.entry == imported.entry
    uids = UidMap(installation_key())
    assert uids.new(SERIES) == files[0].SeriesInstanceUID
    assert UidMap(b"another key").new(SERIES) != files[0].SeriesInstanceUID
    assert uids.new("1.2.840.10008.1.2.1") == "1.2.840.10008.1.2.1"


def test_a_series_that_came_de_identified_is_taken_in_as_well(tmp_path):
    first = CtLibrary().import_series(series_of(tmp_path / "in"))
    again = scan_folder(first.entry.folder).series[0]
    second = CtLibrary(tmp_path / "other").import_series(again)
    assert second.entry.files == 5
    assert scan_folder(second.entry.folder).series[0].usable


def test_private_attributes_curves_overlays_and_unknown_ones_go(tmp_path):
    series = series_of(tmp_path / "in")
    for path in series.files:
        dataset = pydicom.dcmread(path)
        dataset.private_block(0x0009, "MAKER", create=True).add_new(1, "LO", "Private^Name")
        dataset.add_new(0x50000010, "US", 1)
        dataset.add_new(0x60003000, "OW", b"\0\0")
        dataset.add_new(0x60004000, "LT", "Overlay^Name")
        dataset.save_as(path)
    imported = CtLibrary().import_series(scan_folder(tmp_path / "in").series[0])
    for dataset in written(imported.entry):
        assert all(not e.tag.is_private and e.tag.group not in (0x5000, 0x6000) for e in dataset)
    assert imported.report.private == 10


def test_the_preamble_is_emptied(tmp_path):
    series = series_of(tmp_path / "in")
    for path in series.files:
        raw = path.read_bytes()
        path.write_bytes(b"Secret^Name".ljust(128, b" ") + raw[128:])
    entry = CtLibrary().import_series(scan_folder(tmp_path / "in").series[0]).entry
    assert all(p.read_bytes()[:128] == b"\0" * 128 for p in entry.folder.glob("*.dcm"))


@pytest.mark.promise("docs/privacy.md: by the same offset for all CTs of a patient")
def test_dates_move_by_one_offset_of_the_patient_and_intervals_stay(tmp_path):
    key = installation_key()
    shift = dates.shift_of(key, "SECRET-ID", "2.25.1")
    assert timedelta(days=-3650) <= shift <= timedelta(days=-30)
    assert shift == dates.shift_of(key, "SECRET-ID", "another study")
    assert shift != dates.shift_of(key, "OTHER", "2.25.1")
    imported = CtLibrary().import_series(
        series_of(tmp_path / "in", StudyDate="20240229", SeriesDate="20240310")
    )
    one = written(imported.entry)[0]
    expected = date(2024, 2, 29) + shift
    assert one.StudyDate == expected.strftime("%Y%m%d")
    assert imported.report.shifted == {"SeriesDate": 5, "StudyDate": 5}


@pytest.mark.parametrize(
    ("value", "result"),
    [("", ""), ("2024", ""), ("20241301", ""), ("00010101", ""), ("2024.03.01", "20240130")],
)
def test_a_date_that_cannot_be_moved_is_left_out(value, result):
    assert dates.shifted(value, timedelta(days=-31)) == result


@pytest.mark.parametrize(
    ("age", "result"),
    [("041Y", "041Y"), ("089Y", "089Y"), ("090Y", "090Y"), ("103Y", "090Y"), ("018M", "018M"),
     ("old", ""), ("", "")],
)  # fmt: skip
def test_ages_above_89_become_90(age, result):
    assert dates.capped_age(age) == result


def test_kept_attributes_keep_only_values_of_their_form(tmp_path):
    tags = {
        "BodyPartExamined": "MUELLER", "ConvolutionKernel": "MUELLERIN", "RotationDirection": "CW",
        "KVP": "120", "PatientAge": "097Y", "PatientSex": "F",
    }  # fmt: skip
    series = series_of(tmp_path / "in", **tags)
    assert "MUELLER" not in series.label
    imported = CtLibrary().import_series(series)
    one = written(imported.entry)[0]
    assert "BodyPartExamined" not in one
    assert "ConvolutionKernel" not in one
    assert (one.RotationDirection, one.KVP, one.PatientAge, one.PatientSex) == (
        "CW", 120, "090Y", "F",
    )  # fmt: skip
    assert set(imported.report.unfit) >= {"BodyPartExamined", "ConvolutionKernel"}


@pytest.mark.parametrize("kernel", ["B30f", "Br40d\\3", "FC08", "STANDARD", "B", "YA", "I30f\\3"])
def test_kernels_of_the_makers_are_recognised(kernel):
    assert fits(profile().kept[tag_for_keyword("ConvolutionKernel")], kernel.split("\\"))


def test_a_number_that_repeats_an_identifier_is_taken_out(tmp_path):
    imported = CtLibrary().import_series(
        series_of(tmp_path / "in", PatientID="4711081", KVP="4711081")
    )
    assert written(imported.entry)[0].KVP is None
    assert imported.report.unfit["KVP"] == 5


@pytest.mark.promise(
    "docs/privacy.md: No kept number may be a date of the patient in any usual order, or "
    "the digits of an identifier"
)
@pytest.mark.parametrize(
    ("keyword", "value"),
    [
        ("SeriesNumber", 19531224),  # the birth date
        ("SeriesNumber", 24121953),
        ("AcquisitionNumber", 531224),
        ("TableHeight", "24121953.0"),
        ("InstanceNumber", 20030405),  # the study's own date, which is moved elsewhere
        ("Exposure", 778899),  # digits of the patient's number
        ("TableHeight", "1953.1224"),
    ],
)
def test_a_number_that_is_a_date_or_the_digits_of_an_identifier_is_taken_out(
    tmp_path, keyword, value
):
    tags = {"PatientBirthDate": "19531224", "StudyDate": "20030405", "PatientID": "P-77/88-99"}
    series = series_of(tmp_path / "ct", **tags, **{keyword: value})
    imported = CtLibrary(tmp_path / "library").import_series(series)
    for file in written(imported.entry):
        assert file.get(keyword) in (None, "")
    kept = {"SeriesNumber": 531, "TableHeight": "195.3", "Exposure": 7788}
    series = series_of(tmp_path / "plain", **tags, **kept)
    imported = CtLibrary(tmp_path / "other").import_series(series)
    for file in written(imported.entry):
        assert (file.SeriesNumber, float(file.TableHeight), file.Exposure) == (531, 195.3, 7788)


def test_writing_in_the_picture_is_refused_and_blackened_only_where_drawn(tmp_path):
    series = series_of(tmp_path / "in", BurnedInAnnotation="YES")
    with pytest.raises(BurnedInError, match="--mask"):
        CtLibrary().import_series(series)
    assert CtLibrary().entries() == ()
    imported = CtLibrary().import_series(series, [MaskBox(2, 3, 4, 5)])
    before, after = read_series(series).hu, load_ct(imported.entry.folder).hu
    inside = np.zeros(before.shape, bool)
    inside[:, 3:8, 2:6] = True
    np.testing.assert_array_equal(before[~inside], after[~inside])
    for k in range(5):
        assert (after[k][inside[k]] == before[k].min()).all()
    assert imported.report.masked == 5
    with pytest.raises(BurnedInError, match="outside the picture"):
        CtLibrary().import_series(series, [MaskBox(100, 3, 4, 5)])


def test_a_box_of_one_picture_leaves_the_others_alone(tmp_path):
    series = series_of(tmp_path / "in")
    before = read_series(series).hu
    imported = CtLibrary().import_series(series, [MaskBox(2, 3, 4, 5, picture=2)])
    after = load_ct(imported.entry.folder).hu
    assert imported.report.masked == 1
    changed = (before != after).any(axis=(1, 2))
    assert changed.tolist() == [False, True, False, False, False]
    assert (after[1, 3:8, 2:6] == before[1].min()).all()
    with pytest.raises(BurnedInError, match="no picture 6: the series has 5"):
        CtLibrary().import_series(series, [MaskBox(2, 3, 4, 5, picture=6)])


def test_pictures_that_say_they_carry_writing_need_boxes_each(tmp_path):
    series = series_of(tmp_path / "in", BurnedInAnnotation="YES")
    with pytest.raises(BurnedInError, match="file 1 of 5"):
        CtLibrary().import_series(series, [MaskBox(2, 3, 4, 5, picture=2)])
    assert CtLibrary().entries() == ()


def test_a_copy_without_boxes_is_replaced_by_one_with_boxes_and_not_the_other_way(tmp_path):
    series = series_of(tmp_path / "in")
    plain = CtLibrary().import_series(series)
    masked = CtLibrary().import_series(series, [MaskBox(2, 3, 4, 5)])
    assert not masked.again
    assert masked.entry.name == plain.entry.name
    again = CtLibrary().import_series(series)
    assert again.again
    after = load_ct(again.entry.folder).hu
    assert (after[:, 3:8, 2:6] == after.min(axis=(1, 2))[:, None, None]).all()
    assert len(list(CtLibrary().folder.iterdir())) == 1


def test_an_overlay_hidden_in_the_unused_bits_goes(tmp_path):
    recipe = Slices(tags={"BitsStored": 12, "HighBit": 11})
    recipe.write(tmp_path / "in")
    for path in (tmp_path / "in").iterdir():
        dataset = pydicom.dcmread(path)
        pixels = np.frombuffer(dataset.PixelData, "<u2") & 0x0FFF
        dataset.PixelData = (pixels | 0x8000).astype("<u2").tobytes()
        dataset.add_new(0x60000102, "US", 15)
        dataset.save_as(path)
    imported = CtLibrary().import_series(scan_folder(tmp_path / "in").series[0])
    assert all((one.pixel_array < 0x1000).all() for one in written(imported.entry))
    assert all(max(np.frombuffer(one.PixelData, "<u2")) < 0x1000 for one in written(imported.entry))


def test_a_head_scan_is_warned_for_its_face_and_a_chest_is_not(tmp_path):
    head = CtLibrary().import_series(series_of(tmp_path / "head", BodyPartExamined="HEAD"))
    assert "face" in head.report.warnings[0]
    chest = CtLibrary().import_series(
        series_of(tmp_path / "chest", BodyPartExamined="CHEST", StudyInstanceUID="2.25.7",
                  SeriesInstanceUID="2.25.77")
    )  # fmt: skip
    assert chest.report.warnings == ()


@pytest.mark.parametrize(
    "tags",
    [
        {"StudyDescription": "CT Schädel nativ"},
        {"ProtocolName": "HeadRoutine"},
        {"RecognizableVisualFeatures": "YES"},
    ],
)
def test_a_head_is_warned_for_where_only_the_files_texts_tell_and_they_are_not_quoted(
    tmp_path, tags
):
    tags = tags | {"BodyPartExamined": "CHEST", "SpecificCharacterSet": "ISO_IR 192"}
    (warning,) = CtLibrary().import_series(series_of(tmp_path / "in", **tags)).report.warnings
    assert "speak of a head" in warning
    assert not any(str(value) in warning for value in tags.values())


@pytest.mark.parametrize(
    "tags",
    [
        {"ImageType": ["DERIVED", "SECONDARY", "SCREEN SAVE"]},
        {"ImageType": ["DERIVED", "SECONDARY", "OTHER", "CT_SOM5 PROT"]},
        {"ImageType": ["DERIVED", "SECONDARY", "DOSE_INFO"]},
        {"ImageType": ["DERIVED", "SECONDARY", "OTHER", "CSA REPORT"]},
        {"ConversionType": "DI"},
        {"SeriesDescription": "Dose Report"},
        {"SeriesDescription": "SCREEN_SAVE 4"},
        {"SeriesDescription": "Patient Protocol"},
    ],
)
def test_makers_pictures_of_screens_and_reports_are_refused_boxes_or_not(tmp_path, tags):
    series = series_of(tmp_path / "in", **tags)
    for boxes in ((), (MaskBox(0, 0, 2, 2),)):
        with pytest.raises(BurnedInError) as refused:
            CtLibrary().import_series(series, boxes)
        assert "4" not in str(refused.value).removeprefix("file 1 of 5")
    assert CtLibrary().entries() == ()


def test_a_workstations_reformatted_series_is_no_picture_of_a_screen(tmp_path):
    tags = {"ImageType": ["DERIVED", "SECONDARY", "REFORMATTED"], "ConversionType": "WSD"}
    tags["SeriesDescription"] = "Thorax 5.0 protocol"
    assert CtLibrary().import_series(series_of(tmp_path / "in", **tags)).entry.files == 5


def test_the_second_pass_finds_what_the_first_let_through(tmp_path):
    entry = CtLibrary().import_series(series_of(tmp_path / "in")).entry
    path = min(entry.folder.glob("*.dcm"))
    clean = pydicom.dcmread(path)
    secrets = Secrets(profile(), {"Secret^Name"})
    digest = pixel_digest(clean)

    def spoilt(change):
        dataset = pydicom.dcmread(path)
        change(dataset)
        dataset.save_as(tmp_path / "spoilt.dcm")
        return tmp_path / "spoilt.dcm"

    verify(path, secrets, frozenset({SERIES}), digest)
    changes = [
        ("SeriesDescription", lambda d: setattr(d, "SeriesDescription", "free text")),
        ("SeriesInstanceUID", lambda d: setattr(d, "SeriesInstanceUID", SERIES)),
        ("original", lambda d: setattr(d, "ConvolutionKernel", "Secret^Name")),
        ("pixels", lambda d: setattr(d, "PixelData", bytes(len(d.PixelData)))),
        ("preamble", lambda d: setattr(d, "preamble", b"x" * 128)),
        ("should have been removed", lambda d: d.private_block(9, "A", create=True)),
    ]
    for words, change in changes:
        with pytest.raises(NotCleanError, match=words) as raised:
            verify(spoilt(change), secrets, frozenset({SERIES}), digest)
        assert "Secret" not in str(raised.value)


def test_a_name_that_lies_in_the_pixels_is_found(tmp_path):
    paths = Slices(tags={"PatientName": "Mustermann^Erika"}).write(tmp_path / "in")
    dataset = pydicom.dcmread(paths[2])
    name = b"Mustermann^Erika"
    dataset.PixelData = dataset.PixelData[:100] + name + dataset.PixelData[100 + len(name) :]
    dataset.save_as(paths[2])
    with pytest.raises(NotCleanError, match="stands in its pixels") as raised:
        CtLibrary().import_series(scan_folder(tmp_path / "in").series[0])
    assert "Mustermann" not in str(raised.value)
    assert nothing_left()


def test_pseudonyms_need_the_key_and_a_lost_key_gives_new_ones(tmp_path):
    first = pseudonym("SECRET-ID", "2.25.1")
    assert first == pseudonym("SECRET-ID", "2.25.1")
    assert pseudonym("", "", first) == first
    assert key_path().stat().st_mode & 0o077 == 0
    key_path().unlink()
    assert pseudonym("SECRET-ID", "2.25.1") != first
    key_path().write_bytes(b"short")
    with pytest.raises(KeyDamagedError, match="5 bytes"):
        pseudonym("SECRET-ID", "2.25.1")


@pytest.mark.long("journey")
def test_compressed_big_endian_and_deflated_files_keep_their_pixels_bit_for_bit(
    tmp_path, shared_data
):
    for name in sorted((shared_data / "ct_transfer_syntaxes").rglob("*.dcm")):
        header = scan_folder_of(name, tmp_path)
        if header is None:
            continue
        from app.imaging.privacy.actions import Rules
        from app.imaging.privacy.deidentifying import convert
        from app.imaging.privacy.report import Tally

        rules = Rules(profile(), UidMap(b"k"), timedelta(days=-40), "P-1", "CT-00000001")
        secrets = Secrets(profile())
        to = tmp_path / "out.dcm"
        digest = convert(header, to, rules, (), secrets, Tally())
        verify(to, secrets, rules.uids.old, digest)
        old, new = pydicom.dcmread(name, force=True), pydicom.dcmread(to)
        assert old.PixelData == new.PixelData, name
        assert new.file_meta.TransferSyntaxUID == header.pixels.syntax


def scan_folder_of(name, tmp_path):
    folder = tmp_path / "alone"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    shutil.copy(name, folder)
    listing = scan_folder(folder)
    found = [s for s in listing.series if s.modality == "CT" and s.slices[0].format.rows > 0]
    return found[0].slices[0] if found else None


# --- whole or not at all


def nothing_left():
    folder = CtLibrary().folder
    return not folder.exists() or list(folder.iterdir()) == []


def test_a_full_disk_leaves_nothing(tmp_path, monkeypatch):
    series = series_of(tmp_path / "in")
    usage = shutil.disk_usage(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(shutil, "disk_usage", lambda _: usage._replace(free=1000))
        with pytest.raises(ImportFailedError, match="MB free"):
            CtLibrary().import_series(series)
    assert nothing_left()


@pytest.mark.long("journey")
def test_a_disk_that_fills_in_the_middle_leaves_nothing(tmp_path, monkeypatch):
    series = series_of(tmp_path / "in")
    worker = ImagingWorker(1, "tests.imaging.full_disk_child")
    monkeypatch.setattr(library_module, "shared_worker", lambda: worker)
    with pytest.raises(ImportFailedError, match="full"):
        CtLibrary().import_series(series)
    worker.close()
    assert nothing_left()


@pytest.mark.long("journey")
def test_a_file_that_the_system_cuts_short_is_told_in_its_words_and_nothing_is_left(tmp_path):
    Slices(shape=(200, 200)).write(tmp_path / "in")
    done = subprocess.run(
        [sys.executable, "-m", "app", "ct", "import", str(tmp_path / "in")],
        env=os.environ, cwd=paths.resources().parent, capture_output=True, text=True, check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000)),
    )  # fmt: skip
    assert done.returncode == 2
    assert "File too large; nothing was kept" in done.stderr
    assert nothing_left()


@pytest.mark.long("journey")
def test_a_file_that_crashes_its_reader_ends_the_import_and_leaves_nothing(tmp_path, monkeypatch):
    series = series_of(tmp_path / "in")
    worker = ImagingWorker(1, "tests.imaging.crashing_child")
    monkeypatch.setattr(library_module, "shared_worker", lambda: worker)
    with pytest.raises(ImportFailedError, match=r"SIGABRT.*nothing was kept"):
        CtLibrary().import_series(series)
    worker.close()
    assert nothing_left()


def test_a_folder_removed_in_the_middle_is_told_by_the_files_number_and_no_path(tmp_path):
    folder, staging = tmp_path / "Secret^Name", tmp_path / "staging"
    series = series_of(folder)
    staging.mkdir()
    (staging / ".lock").touch()

    def look(fraction, text):
        if text.startswith("file 3"):
            shutil.rmtree(folder)

    settings = Path(os.environ["ACUS_SETTINGS"])
    with pytest.raises(FileDamagedError, match="file 3 of 5") as raised:
        deidentify_series(series.slices, series.key, staging, (), settings, Progress(look))
    assert "Secret" not in str(raised.value)


def test_a_file_that_is_gone_ends_the_import_and_leaves_nothing(tmp_path):
    series = series_of(tmp_path / "Secret^Name")
    path = series.slices[3].path
    path.rename(path.with_name("elsewhere"))
    path.mkdir()
    with pytest.raises(ImportFailedError, match="file 4 of 5") as raised:
        CtLibrary().import_series(series)
    assert "Secret" not in str(raised.value)
    assert nothing_left()


def test_a_cancelled_import_leaves_nothing(tmp_path):
    series = series_of(tmp_path / "in")
    progress = Progress(lambda _, text: progress.cancel() if text.startswith("file") else None)
    with pytest.raises(Cancelled):
        CtLibrary().import_series(series, progress=progress)
    assert nothing_left()


KILLED = """
import os, signal, sys
from app.core.progress import Progress
from app.imaging.library import CtLibrary
from app.imaging.scanning import scan_folder
def look(_, text):
    if text.startswith("file"):
        os.kill(os.getpid(), signal.SIGKILL)
CtLibrary().import_series(scan_folder(sys.argv[1]).series[0], progress=Progress(look))
"""


@pytest.mark.long("journey")
def test_a_killed_import_is_swept_at_the_next_look_and_a_living_one_is_not(tmp_path):
    Slices().write(tmp_path / "in")
    done = subprocess.run([sys.executable, "-c", KILLED, str(tmp_path / "in")], check=False)
    assert done.returncode == -9
    library = CtLibrary()
    assert [path.name[:9] for path in library.folder.iterdir()] == [".staging-"]
    deadline = time.monotonic() + 30.0  # the process that writes there notices a moment later
    while not nothing_left() and time.monotonic() < deadline:
        assert library.entries() == ()
        time.sleep(0.1)
    assert nothing_left()
    series = scan_folder(tmp_path / "in").series[0]
    swept = []
    library.import_series(series, progress=Progress(lambda *_: swept.append(library.sweep())))
    assert set(swept) == {0}
    assert len(library.entries()) == 1


def test_an_entry_is_removed_by_name(tmp_path):
    library = CtLibrary()
    entry = library.import_series(series_of(tmp_path / "in")).entry
    with pytest.raises(SeriesUnknownError, match=entry.name):
        library.remove("nobody")
    library.remove(entry.name)
    assert library.entries() == ()
    assert nothing_left() or os.listdir(library.folder) == []


def test_deep_sequences_are_refused(tmp_path):
    inner = Dataset()
    for _ in range(12):
        outer = Dataset()
        outer.SharedFunctionalGroupsSequence = [inner]
        inner = outer
    series = series_of(tmp_path / "in", SharedFunctionalGroupsSequence=[inner])
    with pytest.raises(Exception, match="nested deeper"):
        CtLibrary().import_series(series)
    assert nothing_left()
