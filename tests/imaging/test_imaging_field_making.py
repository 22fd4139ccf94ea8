"""Making a tissue field of a CT: by values, shapes and structures; and what cannot be made."""

import numpy as np
import pytest

from app.core.progress import Cancelled, Progress
from app.imaging.errors import ImagingError
from app.imaging.field import FieldError, TissueKind, making
from app.imaging.field.making import field_of, make, seed_of
from app.imaging.field.naming import kind_of, name_of
from app.imaging.field.walking import walk
from app.imaging.series import Series
from app.imaging.structures.structure import Structure, StructureKind
from app.imaging.volume import Volume

SIZE = (130, 110, 60)
SPACING = (1.25, 1.25, 1.5)


def volume_of(hu, unit="HU", affine=None):
    if affine is None:
        affine = np.diag([*SPACING, 1.0])
    series = Series("1", "CT", "", SIZE, None, None, None, True, "", (), "", "", ())
    return Volume(hu.astype(np.int16), affine, series, unit=unit)


def places():
    k, j, i = np.indices(SIZE[::-1])
    return i * SPACING[0], j * SPACING[1], k * SPACING[2]


def painted(hu, away, value):
    """Lay a value over an array by a signed distance [mm], edges by partial volume."""
    share = np.clip(0.5 - away / 1.25, 0.0, 1.0)
    return hu + share * (value - hu)


MIDDLE = np.array([80.0, 68.0])


def trunk(noise=0.0):
    """An oval body with fat, a wall, a lung, a rib with marrow, gas, and a vessel with contrast."""
    x, y, z = places()
    rho = np.hypot((x - MIDDLE[0]) / 1.2, y - MIDDLE[1])
    hu = np.full(SIZE[::-1], -1000.0)
    hu = painted(hu, rho - 55.0, -100.0)
    hu = painted(hu, rho - 45.0, 50.0)
    hu = painted(hu, np.hypot(x - 55.0, y - 68.0) - 20.0, -850.0)
    hu = painted(hu, np.hypot(x - 80.0, y - 28.0) - 5.0, 700.0)  # a rib along the patient
    hu = painted(hu, np.hypot(x - 80.0, y - 28.0) - 2.5, 150.0)
    hu = painted(hu, np.hypot(x - 105.0, y - 70.0) - 7.0, 320.0)  # a vessel along him
    ball = np.sqrt((x - 110.0) ** 2 + (y - 95.0) ** 2 + (z - 45.0) ** 2)
    hu = painted(hu, ball - 5.0, -995.0)
    return hu + np.random.default_rng(3).normal(0.0, 1.0, hu.shape) * noise


@pytest.fixture(scope="module")
def chest():
    return volume_of(trunk(noise=12.0))


@pytest.fixture(scope="module")
def field(chest):
    return make(chest)


def kinds_along(field, *line):
    return [field.tissues[part.code].kind.value for part in walk(field, np.array(line))]


def test_skin_fat_wall_lung_and_bone_lie_where_they_were_laid(field):
    lung = walk(field, [[55.0, 30.0, 45.0], [55.0, 68.0, 45.0]])[-1]
    assert field.tissues[lung.code].kind is TissueKind.LUNG
    assert lung.begin_mm == pytest.approx(48.0 - 30.0, abs=0.3)
    line = walk(field, [[80.0, 10.0, 45.0], [80.0, 60.0, 45.0]])
    names = [field.tissues[part.code].kind.value for part in line]
    assert names[:3] == ["air", "skin", "fat"]
    bone = line[names.index("bone")]
    assert bone.begin_mm == pytest.approx(23.0 - 10.0, abs=0.4)
    assert bone.length_mm == pytest.approx(10.0, abs=0.6)  # with its marrow
    skin = line[names.index("skin")]
    assert skin.begin_mm == pytest.approx(13.0 - 10.0, abs=0.5)


def test_contrast_in_a_vessel_is_no_bone(field):
    found = {field.tissues[code].words for code in field.codes_at([[105.0, 70.0, 45.0]])}
    assert found == {"contrast"}
    (contrast,) = (tissue for tissue in field.tissues if tissue.name == "contrast")
    assert contrast.kind is TissueKind.VESSEL
    assert 0.0 < contrast.confidence < 0.9


def test_gas_outside_the_lung_is_gut(field):
    code = int(field.codes_at([[110.0, 95.0, 45.0]])[0])
    assert field.tissues[code].kind is TissueKind.GUT


@pytest.mark.long("statistics")
def test_a_structure_knows_better_and_the_first_before_the_others(chest):
    x, y, _ = places()
    liver = Structure.of("Liver_1", np.hypot(x - 100.0, y - 70.0) < 20.0, chest)
    aorta = Structure.of("aorta", np.hypot(x - 105.0, y - 70.0) < 7.0, chest, StructureKind.VESSEL)
    field = make(chest, (aorta, liver))
    at = field.codes_at([[105.0, 70.0, 45.0], [90.0, 70.0, 45.0]])
    assert [field.tissues[code].name for code in at] == ["aorta", "liver"]
    assert field.tissues[at[0]].kind is TissueKind.VESSEL
    (note,) = field.notes
    assert "aorta and Liver_1 overlap by" in note
    assert "count as aorta" in note


def test_names_say_what_a_structure_is(chest):
    mask = np.zeros(SIZE[::-1], bool)
    mask[0, 0, 0] = True

    def told(name, kind=StructureKind.RISK):
        found = Structure.of(name, mask, chest, kind)
        return kind_of(found).value, name_of(found)

    assert told("left_lung") == ("lung", "left_lung")
    assert told("lung nodule") == ("organ", "lung nodule")
    assert told("Kidney right") == ("organ", "kidney")
    assert told("portal vein") == ("vessel", "portal vein")
    assert told("sigmoid colon")[0] == "gut"
    assert told("heart")[0] == "heart"
    assert told("tribasic thing")[0] == "organ"
    assert told("x", StructureKind.BONE)[0] == "bone"


@pytest.mark.long("statistics")
def test_without_bone_lung_or_body_a_line_says_so():
    x, y, _ = places()
    soft = painted(np.full(SIZE[::-1], -1000.0), np.hypot(x - 80.0, y - 68.0) - 50.0, 50.0)
    notes = make(volume_of(soft)).notes
    assert any("no bone was found" in note for note in notes)
    assert any("no lung was found" in note for note in notes)
    notes = make(volume_of(np.full(SIZE[::-1], -1000.0))).notes
    assert any("there is no body" in note for note in notes)


@pytest.mark.long("statistics")
def test_a_ct_smaller_than_the_reach_says_what_is_unknown(chest):
    field = make(chest, entry_mm=(80.0, 13.0, 45.0), reach_mm=100.0)
    assert any("what lies beyond is unknown" in note for note in field.notes)
    assert field.codes_at([[80.0, 13.0, -20.0]]).tolist() == [0]


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"entry_mm": (-500.0, 0.0, 0.0)}, "lies outside the CT"),
        ({"spacing_mm": 0.7}, "0.5, 1, 2, 3 mm can be chosen"),
        ({"reach_mm": -1.0}, "a reach of -1 mm"),
    ],
)
def test_what_cannot_be_asked_for_is_said_in_one_line(chest, asked, said):
    with pytest.raises(FieldError, match=said) as caught:
        make(chest, **asked)
    assert "\n" not in str(caught.value)


def test_values_without_a_unit_are_no_tissue():
    with pytest.raises(FieldError, match="not in HU"):
        make(volume_of(trunk(), unit=""))


def test_a_field_that_does_not_fit_the_memory_is_refused(chest, monkeypatch):
    monkeypatch.setattr(making, "available", lambda: 1_000_000)
    with pytest.raises(FieldError, match="GB are free: take 2 mm, or a shorter reach"):
        make(chest)
    monkeypatch.setattr(making, "MOST_MB", 0.5)
    with pytest.raises(FieldError, match="are allowed: take 2 mm, or a shorter reach"):
        make(chest)


def test_it_can_be_cancelled_and_nothing_is_kept(chest, monkeypatch, tmp_path):
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path))
    progress = Progress(lambda fraction, text: progress.cancel() if fraction > 0.3 else None)
    with pytest.raises(Cancelled):
        field_of(chest, progress=progress)
    assert not list(tmp_path.rglob("*.field"))


def test_what_was_made_once_is_read_again(chest, monkeypatch, tmp_path):
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path))
    first = field_of(chest, spacing_mm=2.0)
    (file,) = tmp_path.rglob("*.field")
    monkeypatch.setattr(making, "make", lambda *_: pytest.fail("it was made again"))
    assert field_of(chest, spacing_mm=2.0).digest == first.digest
    file.write_bytes(file.read_bytes()[:-40])  # damaged: made again
    monkeypatch.undo()
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path))
    assert field_of(chest, spacing_mm=2.0).digest == first.digest


@pytest.mark.long("statistics")
def test_a_sheared_or_turned_ct_is_labelled_in_its_own_place():
    turn = np.diag([*SPACING, 1.0])
    c, s = np.cos(0.4), np.sin(0.4)
    rotation = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    turn[:3, :3] = rotation @ turn[:3, :3]
    field = make(volume_of(trunk(), affine=turn), spacing_mm=2.0)
    at = rotation @ np.array([55.0, 68.0, 45.0])
    assert field.tissues[int(field.codes_at(at)[0])].kind is TissueKind.LUNG
    shear = np.diag([*SPACING, 1.0])
    shear[1, 2] = 0.15
    sheared = make(volume_of(trunk(), affine=shear), spacing_mm=2.0)
    at = np.array([55.0, 68.0 + 30.0 * 0.15, 45.0])
    assert sheared.tissues[int(sheared.codes_at(at)[0])].kind is TissueKind.LUNG


def test_only_the_built_in_patients_frame_is_his(chest):
    assert seed_of(chest) is None


def test_errors_of_the_field_are_the_rooms_own():
    assert issubclass(FieldError, ImagingError)
