"""The study of reading DICOM: comparison with a peer, the standard as judge, right reasons."""

from pathlib import Path

import numpy as np
import pytest

from app.core.progress import Progress
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.studies.dicom_cases.cases import file_cases, folder_cases, pydicom_files
from app.studies.dicom_cases.comparison import compare, read
from app.studies.dicom_cases.peer import Peer, PeerImage
from app.studies.dicom_cases.reasons import justified
from app.studies.errors import StudyError
from app.studies.runner import examine
from tests.imaging.dicom_factory import Slices

pytest.importorskip("SimpleITK")


@pytest.fixture(scope="module")
def peer():
    asked = Peer()
    yield asked
    asked.close()


def test_an_even_series_is_read_as_the_peer_reads_it(tmp_path, peer):
    Slices().write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    theirs = peer.image(series.files)
    found = compare(series, read(series), theirs, peer)
    assert (found.values, found.geometry) == ("equal", "equal")
    assert found.ours_mm == pytest.approx(0.0, abs=1e-9)
    assert found.peer_mm == pytest.approx(0.0, abs=1e-6)


def test_where_a_tilted_series_is_misplaced_by_the_peer_the_standard_says_who_is_right(
    tmp_path, peer
):
    Slices(shear=0.25).write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    found = compare(series, read(series), peer.image(series.files), peer)
    assert found.values == "equal"
    assert found.ours_mm == pytest.approx(0.0, abs=1e-9)
    assert found.peer_mm > 0.2


def test_a_peer_that_counts_slices_the_other_way_has_the_same_volume(tmp_path, peer):
    Slices().write(tmp_path / "ct")
    volume = load_ct(tmp_path / "ct")
    turned = volume.affine_mm.copy()
    turned[:3, 3] = volume.lps_mm((0, 0, 4))
    turned[:3, 2] *= -1.0
    found = compare(volume.series, read(volume.series), PeerImage(volume.hu[::-1], turned), peer)
    assert (found.values, found.geometry) == ("equal", "equal")


def test_a_difference_in_a_voxel_and_in_a_place_is_told(tmp_path, peer):
    Slices().write(tmp_path / "ct")
    volume = load_ct(tmp_path / "ct")
    hu, affine = volume.hu.copy(), volume.affine_mm.copy()
    hu[2, 3, 4] += 7
    affine[0, 3] += 0.5
    found = compare(volume.series, read(volume.series), PeerImage(hu, affine), peer)
    assert (found.values, found.geometry) == ("to 7", "0.5 mm apart")
    assert found.peer_mm == pytest.approx(0.5)


def test_the_peer_survives_what_it_cannot_read(tmp_path, peer):
    (tmp_path / "text").write_text("no image")
    assert "Error" in peer.image([tmp_path / "text"])
    assert peer.facts([tmp_path / "text"]) == []


def test_each_of_pydicoms_files_is_a_case_of_its_own_and_refused_for_a_right_reason(peer):
    names = ("no_meta.dcm", "rtplan.dcm", "MR_truncated.dcm", "SC_rgb_rle.dcm", "CT_small.dcm")
    files = [file for file in pydicom_files() if file.name in names]
    cases = list(file_cases(files, Progress()))
    assert sorted(case.name for case in cases) == sorted(names)
    for case in cases:
        assert justified(case.found.reason, peer.facts(case.files)), case.name


def test_a_wrong_reason_is_not_taken_for_right(peer):
    (file,) = [file for file in pydicom_files() if file.name == "CT_small.dcm"]
    facts = peer.facts([file])
    assert not justified("not CT (modality MR)", facts)
    assert not justified("damaged file (truncated)", facts)
    assert not justified("something else", facts)


def test_files_of_a_refused_series_are_cases_too(tmp_path):
    paths = Slices(offsets=(0.0, 2.0)).write(tmp_path / "ct")
    Slices(offsets=(0.0,)).write_one(tmp_path / "ct" / "more", 7, 9.0)
    Slices(offsets=(0.0,)).write_one(tmp_path / "ct" / "again", 8, 9.0, PixelData=bytes(384))
    cases = list(folder_cases(tmp_path / "ct", Progress()))
    whole = [case for case in cases if not case.alone]
    assert not whole[0].found.usable
    assert len(cases) == 1 + len(paths) + 2


def test_a_survey_that_takes_no_folders_says_so():
    with pytest.raises(StudyError, match="study pantograph takes no folders"):
        examine("pantograph", inputs=(Path("somewhere"),))


def test_the_places_are_judged_over_the_whole_picture(tmp_path, peer):
    """A spacing wrong by a thousandth is nothing at the first pixel and shows at the last."""
    Slices(shape=(64, 64)).write(tmp_path / "ct")
    volume = load_ct(tmp_path / "ct")
    affine = volume.affine_mm @ np.diag([1.001, 1.0, 1.0, 1.0])
    found = compare(volume.series, read(volume.series), PeerImage(volume.hu, affine), peer)
    assert 0.02 < found.peer_mm < 0.04
