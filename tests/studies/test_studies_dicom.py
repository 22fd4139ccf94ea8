"""The study of reading DICOM: comparison with a peer, the standard as judge, right reasons."""

from pathlib import Path

import numpy as np
import pytest

from app.core.progress import Progress
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.studies.dicom import file_cases, folder_cases, justified, meaning, pydicom_files
from app.studies.dicom_cases.comparison import ROUNDED, UNEXPLAINED, Peer, PeerImage, compare, read
from app.studies.errors import StudyError
from app.studies.runner import examine
from tests.imaging.dicom_factory import Slices
from tests.studies.pydicom_refusals import REFUSED

pytest.importorskip("SimpleITK")


@pytest.fixture(scope="module")
def peer():
    asked = Peer()
    yield asked
    asked.close()


@pytest.mark.long("statistics")
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
    (fact,) = peer.facts([tmp_path / "text"])
    assert not any(fact[name] for name in ("series", "preamble", "pixels"))


@pytest.fixture(scope="module")
def pydicoms():
    """Every case of pydicom's files, scanned once."""
    return tuple(file_cases(pydicom_files(), Progress()))


@pytest.fixture(scope="module")
def facts(pydicoms, peer):
    """What the peer says of the files of a case, asked once."""
    known = {}

    def of(case):
        if case.name not in known:
            known[case.name] = peer.facts(case.files)
        return known[case.name]

    return of


@pytest.mark.long("statistics")
def test_each_of_pydicoms_files_is_refused_for_the_reason_that_stands_in_the_table(pydicoms):
    expected = {name: reason for reason, names in REFUSED.items() for name in names.split()}
    assert len({case.name for case in pydicoms}) == len(pydicoms)
    for case in pydicoms:
        assert case.name in expected, f"{case.name} is not in the table: {case.found.reason}"
        reason = case.found.reason.removeprefix(f"{case.name} ")
        assert reason.startswith(expected[case.name]), case.name
    own = {file.name for file in pydicom_files() if "test_files" in file.parts}
    assert own <= {case.name for case in pydicoms}


@pytest.mark.long("statistics")
def test_every_one_of_those_reasons_is_confirmed_by_pydicom(pydicoms, facts):
    for case in pydicoms:
        assert justified(case.found.reason, facts(case)), case.name
        assert meaning(case.found.reason), case.found.reason


@pytest.mark.long("statistics")
def test_hardly_another_reason_would_have_been_confirmed(pydicoms, facts):
    """No other modality for any file, and nothing at all but "a single slice" for a sound slice."""
    for case in pydicoms[::3]:
        alone = case.found.reason.startswith("a single slice")
        for other in REFUSED:
            other_kind = "modality" in other and "none given" not in other
            if not case.found.reason.startswith(other) and (alone or other_kind):
                assert not justified(other, facts(case)), (case.name, other)


def test_a_wrong_reason_is_not_taken_for_right(peer):
    (file,) = [file for file in pydicom_files() if file.name == "CT_small.dcm"]
    facts = peer.facts([file])
    assert not justified("not CT (modality MR)", facts)
    assert not justified("damaged file (truncated)", facts)
    assert not justified("gap: 1 slice is missing", facts)
    assert not justified("something else", facts)
    assert not justified("not CT (modality MR)", [])


@pytest.mark.parametrize(
    ("offsets", "right", "wrong"),
    [
        ((0.0, 2.0, 6.0, 8.0), ("gap", "uneven"), ("doubled", "mixed orientations")),
        ((0.0, 2.0, 4.1, 6.1), ("uneven",), ("gap", "doubled")),
        ((0.0, 2.0, 2.0, 4.0), ("doubled",), ("mixed orientations", "mixed image sizes")),
        ((0.0, 2.0, 4.0, 6.0), (), ("gap", "uneven", "doubled", "mixed pixel spacings")),
    ],
)
def test_what_is_said_of_the_places_of_slices_is_measured_anew(
    tmp_path, peer, offsets, right, wrong
):
    facts = peer.facts(Slices(offsets=offsets).write(tmp_path))
    assert all(justified(f"{reason}: so they say", facts) for reason in right)
    assert not any(justified(f"{reason}: so they say", facts) for reason in wrong)


def test_a_difference_of_rounding_is_told_from_one_of_voxels(tmp_path, peer):
    Slices(tags={"RescaleSlope": "1.3"}).write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    ours, theirs = read(series), peer.image(series.files)
    found = compare(series, ours, theirs, peer)
    assert found.values == ROUNDED
    assert found.because.startswith("slope 1.3: GDCM keeps 64 bits")
    spoilt = theirs.values.copy()
    spoilt[0, 0, 0] += 0.01
    found = compare(series, ours, PeerImage(spoilt, theirs.affine_mm), peer)
    assert (found.values, found.because) == ("to 0.01", UNEXPLAINED)


def test_a_misplacement_by_the_peer_is_explained(tmp_path, peer):
    Slices(shear=0.25).write(tmp_path / "tilted")
    (series,) = scan_folder(tmp_path / "tilted").series
    found = compare(series, read(series), peer.image(series.files), peer)
    assert found.because == "gantry tilt 14.0°: GDCM stacks the slices straight"


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


def test_refusals_of_nifti_files_are_confirmed_by_the_bytes_of_their_headers(tmp_path, peer):
    nibabel = pytest.importorskip("nibabel")
    values = np.arange(120, dtype=np.int16).reshape(4, 5, 6)
    sheared = np.eye(4)
    sheared[0, 1] = 0.5
    cases = {
        "nowhere": (values, np.eye(4), 0), "sheared": (values, sheared, 1),
        "times": (np.zeros((4, 5, 6, 3), np.int16), np.eye(4), 1),
        "single": (values[:, :, :1], np.eye(4), 1),
        "complex": (values.astype(np.complex64), np.eye(4), 1),
    }  # fmt: skip
    for name, (some, affine, code) in cases.items():
        image = nibabel.Nifti1Image(some, affine)
        image.set_sform(affine, code)
        image.set_qform(None, 0)
        (tmp_path / name).mkdir()
        nibabel.save(image, tmp_path / name / "a.nii.gz")
    (tmp_path / "text").mkdir()
    (tmp_path / "text" / "a.nii").write_text("nothing of the kind")
    reasons = {}
    for name in (*cases, "text"):
        listing = scan_folder(tmp_path / name)
        (found,) = (*listing.series, *listing.ignored)
        (file,) = (tmp_path / name).iterdir()
        reasons[name] = found.reason, peer.facts((file,))
        assert justified(*reasons[name]), (name, found.reason)
        assert meaning(found.reason)
    for name, (reason, _) in reasons.items():
        for other, (_, facts) in reasons.items():
            assert (name == other) == justified(reason, facts), (reason, other)
