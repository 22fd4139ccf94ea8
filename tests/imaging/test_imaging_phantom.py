"""The procedural torso: a real series, a plausible body, a safe default plan."""

import numpy as np
import pydicom
import pytest

from app.core.errors import ConfigurationError
from app.core.progress import Cancelled, Progress
from app.imaging.body import find_body, is_inside, skin_entry
from app.imaging.phantom import organs, skeleton
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.lesion import make_patient, planned_patient
from app.imaging.phantom.patient import Patient
from app.imaging.phantom.series import Scan, phantom_series
from app.imaging.scanning import scan_folder

SEEDS = range(1, 6)


def test_it_reads_back_as_one_usable_series(small_phantom, phantom_volume):
    listing = scan_folder(small_phantom)
    assert [series.usable for series in listing.series] == [True]
    assert listing.ignored == ()
    assert phantom_volume.size == (128, 128, 64)
    assert phantom_volume.hu.dtype == np.int16
    np.testing.assert_allclose(phantom_volume.spacing_mm, (3.0, 3.0, 4.6875))


def test_its_files_carry_every_required_tag_and_a_pseudonym(small_phantom):
    file = pydicom.dcmread(sorted(small_phantom.iterdir())[0])
    assert str(file.PatientName) == "Phantom^Seed1"
    assert file.SeriesInstanceUID.startswith("2.25.")
    assert len({file.SOPInstanceUID, file.SeriesInstanceUID, file.StudyInstanceUID}) == 3
    required = """SOPClassUID SOPInstanceUID Modality ImageType SamplesPerPixel RescaleSlope
        PhotometricInterpretation BitsAllocated BitsStored HighBit PixelRepresentation Rows Columns
        RescaleIntercept PixelSpacing ImageOrientationPatient ImagePositionPatient
        FrameOfReferenceUID KVP AcquisitionNumber SliceThickness InstanceNumber PatientPosition"""
    for name in required.split():
        assert name in file, name
    assert file.file_meta.TransferSyntaxUID == "1.2.840.10008.1.2.1"


@pytest.mark.long("statistics")
def test_only_patients_from_seed_1000_on_have_a_nodule_which_lies_in_the_lung():
    assert make_patient(1).nodule is None
    assert make_patient(999).nodule is None
    assert "lung nodule" not in anatomy(1).organs
    for seed in range(1000, 1010):
        patient = make_patient(seed)
        (x, y, z), radius = patient.nodule
        at = organs.place_of(patient, *np.array([[x], [y], [z]]))
        assert organs.lungs(patient, at)[0] < -radius - 2.0
        assert anatomy(seed).organs["lung nodule"] == pytest.approx(
            np.array((x, y, z)) * patient.scale
        )


@pytest.mark.long("statistics")
def test_a_nodule_changes_nothing_but_its_own_place():
    class Without(Patient):
        nodule = None

    patient = make_patient(1001)
    bare = Without(**{name: getattr(patient, name) for name in patient.__dataclass_fields__})
    (x, y, z), radius = patient.nodule
    pictures = [Scan(one, 128, 3.0).slice_hu(z * patient.scale[2], 7) for one in (patient, bare)]
    rows, columns = np.nonzero(pictures[0] != pictures[1])
    at = (np.column_stack([columns, rows]) - 63.5) * 3.0 / np.array(patient.scale[:2])
    away = np.hypot(*(at - (x, y)).T)
    assert 0.0 < away.max() < radius + 8.0
    assert pictures[0].max() <= 3071
    row, column = rows[away.argmin()], columns[away.argmin()]
    assert pictures[0][row, column] > pictures[1][row, column] + 500


def test_it_is_made_once(small_phantom):
    before = {path: path.stat().st_mtime_ns for path in small_phantom.iterdir()}
    assert phantom_series(1, slices=64, rows=128) == small_phantom
    assert {path: path.stat().st_mtime_ns for path in small_phantom.iterdir()} == before


@pytest.mark.long("statistics")
def test_what_an_earlier_version_made_is_cleared_away(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path))
    old = tmp_path / "phantom" / "seed1-3x32-0123456789"
    other = tmp_path / "phantom" / "seed1-3x320-0123456789"
    for folder in (old, other):
        folder.mkdir(parents=True)
    phantom_series(1, slices=3, rows=32)
    assert not old.exists()
    assert other.exists()


@pytest.mark.long("statistics")
def test_a_cancelled_phantom_leaves_nothing_behind(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path))
    progress = Progress(lambda fraction, text: progress.cancel() if fraction > 0.3 else None)
    with pytest.raises(Cancelled):
        phantom_series(1, progress, slices=8, rows=32)
    assert list((tmp_path / "phantom").iterdir()) == []
    assert len(list(phantom_series(1, slices=8, rows=32).iterdir())) == 8


@pytest.mark.long("statistics")
def test_the_same_seed_gives_the_same_patient_and_another_seed_another(tmp_path, monkeypatch):
    def content(cache: str, seed: int) -> list[bytes]:
        monkeypatch.setenv("ACUS_CACHE", str(tmp_path / cache))
        folder = phantom_series(seed, slices=3, rows=32)
        return [path.read_bytes() for path in sorted(folder.iterdir())]

    assert content("a", 4) == content("b", 4)
    assert content("a", 5) != content("a", 4)


@pytest.mark.parametrize(
    ("numbers", "words"), [({"slices": 1}, "2 to 2000"), ({"rows": 5}, "16 to 2048")]
)
def test_sizes_out_of_range_are_refused(numbers, words):
    with pytest.raises(ConfigurationError, match=words):
        phantom_series(1, **numbers)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_default_path_is_short_steep_and_ends_in_the_lesion(seed):
    truth = anatomy(seed)
    path = np.subtract(truth.lesion_mm, truth.entry_mm)
    length = np.linalg.norm(path)
    assert 60.0 <= length <= 90.0
    assert np.degrees(np.arctan2(np.hypot(path[0], path[2]), path[1])) <= 30.0


def test_the_default_path_crosses_neither_bone_nor_air(phantom_volume):
    truth = anatomy(1)
    entry, lesion = np.array(truth.entry_mm), np.array(truth.lesion_mm)
    along = np.linspace(0.08, 1.0, 60)[:, None]
    values = [phantom_volume.hu_at(point) for point in entry + along * (lesion - entry)]
    assert min(values) > -250.0
    assert max(values) < 230.0
    assert values[-1] < 90.0  # darker than the liver around it


def test_the_entry_lies_on_the_skin(phantom_volume):
    truth = anatomy(1)
    body = find_body(phantom_volume)
    entry, lesion = np.array(truth.entry_mm), np.array(truth.lesion_mm)
    start = entry - 0.5 * (lesion - entry)
    assert is_inside(body, lesion)
    assert not is_inside(body, start)
    assert np.linalg.norm(skin_entry(body, start, lesion) - entry) < 3.0


@pytest.mark.parametrize(
    ("organ", "low", "high"),
    [
        ("liver", 70, 190),
        ("right kidney", 120, 230),
        ("left kidney", 120, 230),
        ("spleen", 85, 160),
        ("aorta", 130, 220),
        ("vena cava", 90, 170),
        ("right lung", -960, -700),
        ("left lung", -960, -700),
        ("spine", 80, 700),
    ],
)
def test_organs_have_their_density(phantom_volume, organ, low, high):
    point = np.array(anatomy(1).organs[organ])
    offsets = np.random.default_rng(0).normal(0.0, 2.0, (30, 3))
    values = [phantom_volume.hu_at(point + offset) for offset in offsets]
    assert low < np.median(values) < high


def test_the_liver_fills_the_dome_without_a_ring_of_fat_under_the_diaphragm(phantom_volume):
    for x, y in ((-66.0, -6.0), (-80.0, 10.0), (-50.0, -20.0)):
        column = [phantom_volume.hu_at((x, y, z)) for z in np.arange(215.0, 285.0, 1.0)]
        lung = next(n for n, value in enumerate(column) if value < -600.0)
        assert min(column[: lung - 9]) > 30.0, (x, y)  # fat would be at -100


@pytest.mark.parametrize("seed", SEEDS)
def test_the_default_path_keeps_clear_of_the_costal_arch(seed):
    patient, entry = planned_patient(seed)
    x, y, z = np.linspace(entry, patient.lesion_mm, 200).T
    at = organs.place_of(patient, x, y, z)
    p = np.abs(np.arctan2(at.x, at.y)) / np.pi
    assert skeleton.costal_arch_distance(at.wall - 5.0, p, at.z).min() > 3.5


@pytest.mark.parametrize(("x", "z"), [(0.0, 285.0), (0.0, 262.0)])
def test_the_sternum_is_bone_in_the_midline(phantom_volume, x, z):
    column = [phantom_volume.hu_at((x, y, z)) for y in np.arange(-112.0, -70.0, 1.0)]
    assert max(column) > 300.0


def test_the_pelvis_rises_to_a_crest_on_both_sides_and_joins_the_sacrum():
    side, y = np.meshgrid(np.linspace(0.0, 160.0, 321), np.linspace(-45.0, 95.0, 281))
    areas = [(skeleton.pelvis_distance(side, y, z) < 0.0).sum() for z in (2.0, 20.0, 40.0, 56.0)]
    assert areas == sorted(areas, reverse=True)
    assert areas[-1] > 0
    assert not (skeleton.pelvis_distance(side, y, 62.0) < 0.0).any()
    near = side < 40.0
    assert (skeleton.pelvis_distance(side, y, 2.0)[near] < 0.0).any()
