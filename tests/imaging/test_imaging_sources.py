"""Zip archives, DICOMDIRs, single files and NIfTI as sources of series."""

import gc
import os
import subprocess
import sys
import tempfile
import warnings
import zipfile
from pathlib import Path

import nibabel
import numpy as np
import pydicom
import pytest
from pydicom.fileset import FileSet

from app.core.progress import Cancelled, Progress
from app.core.temporary import sweep_temporary
from app.imaging import sources
from app.imaging.body import find_body, is_inside
from app.imaging.errors import FolderError, SeriesRefusedError
from app.imaging.reading import choose, load_ct, read_series
from app.imaging.scanning import scan_folder
from app.imaging.window import presets
from app.imaging.worker.pool import ImagingWorker
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """Where archives are unpacked."""
    folder = tmp_path / "unpacked"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def zipped(folder, path, **more):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(folder.rglob("*")):
            archive.write(file, f"study/{file.name}")
        for name, content in more.items():
            archive.writestr(name, content)
    return path


def test_a_zip_is_read_like_its_folder_and_leaves_nothing(tmp_path, temporary):
    Slices().write(tmp_path / "a")
    path = zipped(tmp_path / "a", tmp_path / "a.zip", **{"study/readme": "text"})
    volume = load_ct(path)
    np.testing.assert_array_equal(volume.hu, load_ct(tmp_path / "a").hu)
    listing = scan_folder(path)
    assert [listing.shown(file.path) for file in listing.ignored] == ["study/readme"]
    assert len(os.listdir(temporary)) == 1
    assert oct(os.stat(next(temporary.iterdir())).st_mode)[-3:] == "700"
    del listing
    gc.collect()
    assert os.listdir(temporary) == []


def test_members_that_lead_out_of_an_archive_are_left_out_by_name(tmp_path, temporary):
    Slices().write(tmp_path / "a")
    path = zipped(
        tmp_path / "a", tmp_path / "a.zip", **{"../evil": "x", "/etc/evil": "x", "C:/evil": "x"}
    )
    with zipfile.ZipFile(path, "a") as archive:
        link = zipfile.ZipInfo("study/link")
        link.external_attr = 0o120777 << 16
        archive.writestr(link, "/etc/passwd")
    listing = scan_folder(path)
    reasons = sorted(file.reason for file in listing.ignored)
    assert reasons == ["a link, not a file", *["leads out of the archive"] * 3]
    assert len(listing.usable) == 1
    assert not (tmp_path / "evil").exists()


def test_an_archive_that_grows_out_of_proportion_is_refused(tmp_path, temporary, monkeypatch):
    monkeypatch.setattr(sources, "BOMB_BYTES", 1 << 20)
    path = tmp_path / "bomb.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("zeros", bytes(1 << 23))
    with pytest.raises(FolderError, match="would grow"):
        scan_folder(path)
    assert os.listdir(temporary) == []


def test_an_archive_that_does_not_fit_the_disk_is_refused(tmp_path, temporary, monkeypatch):
    Slices().write(tmp_path / "a")
    path = zipped(tmp_path / "a", tmp_path / "a.zip")
    monkeypatch.setattr(sources, "RESERVE_BYTES", 1 << 60)
    with pytest.raises(FolderError, match=r"0\.0 GB are free"):
        scan_folder(path)


@pytest.mark.parametrize("keep", [0.3, 0.9, 0.999])
def test_a_broken_or_cancelled_archive_leaves_nothing(tmp_path, temporary, keep):
    Slices().write(tmp_path / "a")
    path = zipped(tmp_path / "a", tmp_path / "a.zip")
    whole = path.read_bytes()
    path.write_bytes(whole[: int(keep * len(whole))])
    with pytest.raises(FolderError, match="cannot be unpacked"):
        scan_folder(path)
    path.write_bytes(whole)
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        scan_folder(path, progress)
    assert os.listdir(temporary) == []


@pytest.mark.long("journey")
def test_a_full_disk_while_unpacking_leaves_nothing(tmp_path, temporary, monkeypatch):
    Slices().write(tmp_path / "a")
    path = zipped(tmp_path / "a", tmp_path / "a.zip")

    worker = ImagingWorker(1, "tests.imaging.full_disk_child")
    monkeypatch.setattr(sources, "shared_worker", lambda: worker)
    with pytest.raises(FolderError, match="No space left"):
        scan_folder(path)
    worker.close()
    assert os.listdir(temporary) == []


@pytest.mark.long("journey")
def test_what_a_killed_program_unpacked_is_swept_away_and_nobody_elses(tmp_path, temporary):
    program = (
        "import sys, time; from pathlib import Path; from app.core.progress import Progress;"
        "from app.imaging.sources import unpack; kept = unpack(Path(sys.argv[1]), Progress());"
        "print(kept.root.name, flush=True); time.sleep(60)"
    )
    Slices().write(tmp_path / "a")
    path = zipped(tmp_path / "a", tmp_path / "a.zip")
    command = [sys.executable, "-c", program, str(path)]
    root = Path(__file__).resolve().parents[2]
    environment = os.environ | {"TMPDIR": str(temporary)}
    (temporary / "acus-zip-of-nobody").mkdir()
    with subprocess.Popen(command, stdout=subprocess.PIPE, cwd=root, env=environment) as other:
        theirs = other.stdout.readline().decode().strip()
        assert sweep_temporary() == 0
        assert (temporary / theirs / "study" / "s000").exists()
        other.kill()
    assert sweep_temporary() == 1
    assert os.listdir(temporary) == ["acus-zip-of-nobody"]


def test_a_dicomdir_names_the_files_to_read(tmp_path):
    files = FileSet()
    slices = Slices(tags={"StudyDate": "20200101", "StudyTime": "1200", "StudyID": "1"})
    for path in slices.write(tmp_path / "a"):
        files.add(pydicom.dcmread(path))
    files.write(tmp_path / "medium")
    del files
    with warnings.catch_warnings():  # of the folder it kept its copies in
        warnings.simplefilter("ignore")
        gc.collect()
    Slices(series="2.25.9").write(tmp_path / "medium" / "beside")
    listing = scan_folder(tmp_path / "medium" / "DICOMDIR")
    assert [series.uid for series in listing.series] == [factory.SERIES]
    lost = listing.series[0].slices[2].path
    lost.rename(lost.with_name(lost.name.lower()))  # as some systems show a medium
    assert scan_folder(tmp_path / "medium" / "DICOMDIR").usable
    lost.with_name(lost.name.lower()).unlink()
    listing = scan_folder(tmp_path / "medium" / "DICOMDIR")
    assert listing.ignored[0].reason == "named in the DICOMDIR, but not there"
    assert listing.series[0].reason.startswith("gap")


def test_the_real_directory_of_a_medium_says_what_is_missing(shared_data):
    listing = scan_folder(shared_data / "ct_phantom_study" / "DIRFILE")
    assert len(listing.usable) == 1
    assert {file.reason for file in listing.ignored} == {"named in the DICOMDIR, but not there"}


def test_a_damaged_dicomdir_is_refused(tmp_path):
    head = bytes(128) + b"DICM" + b"1.2.840.10008.1.3.10" + os.urandom(99)
    (tmp_path / "DICOMDIR").write_bytes(head)
    with pytest.raises(FolderError, match=r"open its folder instead|empty|no DICOM"):
        load_ct(tmp_path / "DICOMDIR")


def test_one_file_is_read_alone(tmp_path):
    paths = Slices().write(tmp_path)
    (series,) = scan_folder(paths[0]).series
    assert "single slice" in series.reason


# --- NIfTI


def nifti(path, values, affine, unit="mm", code=1):
    image = nibabel.Nifti1Image(values, affine)
    image.header.set_xyzt_units(unit)
    image.set_sform(affine, code)
    image.set_qform(affine, 0)
    nibabel.save(image, path)


VALUES = np.arange(4 * 5 * 6, dtype=np.int16).reshape(4, 5, 6) - 1000


def test_two_nifti_files_of_one_name_are_two_series_and_copies_are_one(tmp_path):
    for folder, values in (("one", VALUES), ("two", VALUES + 1), ("copy", VALUES)):
        (tmp_path / folder).mkdir()
        nifti(tmp_path / folder / "ct.nii.gz", values, np.eye(4))
    one, two, copy = (
        scan_folder(tmp_path / folder).series[0].key for folder in ("one", "two", "copy")
    )
    assert one != two
    assert one == copy


@pytest.mark.parametrize("mirrored", [1.0, -1.0])
@pytest.mark.parametrize(("unit", "scale"), [("mm", 1.0), ("meter", 1e-3)])
def test_a_nifti_volume_lies_where_its_affine_says(tmp_path, mirrored, unit, scale):
    affine = np.diag([mirrored * 0.8, 0.9, 2.0, 1.0])
    affine[:3, 3] = 10.0, -20.0, 30.0
    scaled = np.array(affine)
    scaled[:3] *= scale
    nifti(tmp_path / "a.nii.gz", VALUES, scaled, unit)
    volume = load_ct(tmp_path)
    assert volume.unit == "HU"
    assert volume.hu.dtype == np.int16
    assert not volume.is_left_handed
    for ijk in ((0, 0, 0), (3, 4, 5), (1, 2, 3)):
        x, y, z = (affine @ (*ijk, 1.0))[:3]
        assert volume.hu_at((-x, -y, z)) == pytest.approx(VALUES[ijk], abs=1e-3)


@pytest.mark.parametrize(
    ("values", "affine", "code", "words"),
    [
        (VALUES, np.eye(4), 0, "neither sform nor qform"),
        (np.zeros((4, 5, 6, 2), np.int16), np.eye(4), 1, "no times"),
        (np.zeros((4, 5, 1), np.int16), np.eye(4), 1, "at least two"),
        (VALUES, np.array([[1, 0.1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]), 1,
         "not perpendicular"),
        (np.zeros((4, 5, 6), np.complex64), np.eye(4), 1, "not one number"),
        (VALUES, np.diag([1.0, 1.0, 1e30, 1.0]), 1, "lies 1e+30 mm away; 100000 mm are the most"),
    ],
)  # fmt: skip
def test_a_nifti_file_that_is_no_volume_is_refused_by_name(tmp_path, values, affine, code, words):
    nifti(tmp_path / "a.nii", values, affine, code=code)
    (series,) = scan_folder(tmp_path).series
    assert words in series.reason
    with pytest.raises(SeriesRefusedError):
        read_series(series)


def test_values_that_are_no_numbers_are_never_passed_on(tmp_path):
    nifti(tmp_path / "a.nii", np.full((4, 5, 6), np.nan, np.float32), np.eye(4))
    with pytest.raises(ValueError, match="no numbers"):
        load_ct(tmp_path)


def test_a_value_of_which_nothing_can_be_computed_is_named(tmp_path):
    nifti(tmp_path / "a.nii", np.full((4, 5, 6), 1e300, np.float64), np.eye(4))
    with pytest.raises(ValueError, match=r"holds the value 1e\+300; 1e\+12 is the most"):
        load_ct(tmp_path)


def test_a_broken_nifti_file_is_named_and_does_no_harm(tmp_path):
    Slices().write(tmp_path)
    (tmp_path / "broken.nii").write_bytes(b"nonsense" * 100)
    listing = scan_folder(tmp_path)
    assert "not a NIfTI file" in listing.ignored[0].reason
    assert len(listing.usable) == 1


def test_a_pipe_called_like_a_volume_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.nii")
    (ignored,) = scan_folder(tmp_path).ignored
    assert "not a regular file" in ignored.reason


def test_a_nifti_of_positive_values_has_no_unit(tmp_path):
    nifti(tmp_path / "name_of_a_patient.nii", (VALUES + 1000).astype(np.float32) / 2, np.eye(4))
    series = choose(scan_folder(tmp_path / "name_of_a_patient.nii"))
    assert "patient" not in series.uid + series.label + series.pseudonym
    volume = read_series(series)
    assert volume.unit == ""
    assert volume.hu.dtype == np.float32


# --- MR


def test_mr_is_usable_for_practice_and_says_so(tmp_path):
    tags = {"SOPClassUID": "1.2.840.10008.5.1.4.1.1.4", "Modality": "MR", "RescaleSlope": None,
            "RescaleIntercept": None}  # fmt: skip
    slices = Slices(tags=tags)
    slices.write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    assert series.notes == ("MR, for practice only: its values are no Hounsfield units",)
    volume = read_series(series)
    assert volume.unit == ""
    np.testing.assert_array_equal(volume.hu[1], slices.stored(1))
    (first, *_) = presets(volume).values()
    assert first.level == pytest.approx(np.median(volume.hu), rel=0.5)


def test_the_body_of_a_volume_without_a_unit_is_parted_from_the_air_by_its_values(tmp_path):
    k, j, i = np.mgrid[:30, :30, :30]
    inside = (k - 15) ** 2 + (j - 15) ** 2 + (i - 15) ** 2 < 100
    noise = np.random.default_rng(2).uniform(0.0, 8.0, inside.shape)
    values = (300.0 * inside + noise).astype(np.int16)
    nifti(tmp_path / "a.nii", values, np.diag([2.5, 2.5, 2.5, 1.0]))
    volume = load_ct(tmp_path)
    body = find_body(volume)
    assert 8.0 <= body.skin_level <= 300.0
    assert is_inside(body, volume.lps_mm((15, 15, 15)))
    assert not is_inside(body, volume.lps_mm((2, 2, 2)))


def test_a_volume_of_one_value_has_no_body(tmp_path):
    nifti(tmp_path / "a.nii", np.full((12, 12, 12), 7, np.int16), np.eye(4))
    assert not find_body(load_ct(tmp_path)).coarse.any()
