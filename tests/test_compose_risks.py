"""What an exercise says of structures of risk becomes distances on its CT."""

from pathlib import Path

import numpy as np
import pytest

from app.compose.exercise_ct import load_risks
from app.compose.run_context import anonymous
from app.exercises.errors import ExerciseError
from app.exercises.library import load_exercise
from app.exercises.parts import StructurePart
from app.exercises.schema import Exercise
from app.imaging.series import Series
from app.imaging.structures.errors import StructureError, StructureFileError
from app.imaging.structures.structure import Structure, StructureSet
from app.imaging.volume import Volume


@pytest.fixture
def volume() -> Volume:
    size = (30, 30, 20)
    affine = np.diag([1.0, 1.0, 2.0, 1.0])
    series = Series("2.25.1", "CT", "", size, None, None, None, True, "", (), "p", "", ())
    return Volume(np.zeros(size[::-1], np.int16), affine, series)


@pytest.fixture
def file(volume: Volume, tmp_path: Path) -> Path:
    pytest.importorskip("nrrd")
    from app.imaging.structures.files import write_structures

    mask = np.zeros(volume.hu.shape, bool)
    mask[5:10, 10:20, 10:20] = True
    path = tmp_path / "patient-x.seg.nrrd"
    write_structures(path, StructureSet((Structure.of("vein", mask, volume),)), volume)
    return path


def exercise(file: Path, **risks: float) -> Exercise:
    part = StructurePart(file=file, risks=risks)
    return load_exercise("first-insertion").model_copy(update={"structures": (part,)})


def test_a_risk_has_the_distances_of_its_structure(volume: Volume, file: Path) -> None:
    (risk,) = load_risks(exercise(file, vein=3.0), volume)
    assert (risk.name, risk.limit_mm) == ("vein", 3.0)
    assert risk.field.along((5, 0, 14), (5, 29, 14)).distance_mm == pytest.approx(4.5, abs=1e-6)


@pytest.mark.long("machine")
def test_what_cannot_be_measured_is_named(volume: Volume, file: Path, tmp_path: Path) -> None:
    assert load_risks(load_exercise("first-insertion"), None) == ()
    assert load_risks(exercise(file), None) == ()  # shown only
    with pytest.raises(ExerciseError, match="no CT to place them on"):
        load_risks(exercise(file, vein=3.0), None)
    with pytest.raises(StructureError, match="there is no structure 'spleen'"):
        load_risks(exercise(file, spleen=3.0), volume)
    with pytest.raises(StructureFileError, match="gone"):
        load_risks(exercise(tmp_path / "gone.seg.nrrd", vein=3.0), volume)


def test_the_record_names_no_file_of_structures(file: Path) -> None:
    text = anonymous(exercise(file, vein=3.0)).model_dump_json()
    assert "patient-x" not in text
    assert str(file.parent) not in text
    assert "vein" in text
