"""The picture of an exercise's patient: what it shows, where it is kept, what is not in it."""

import numpy as np
import pytest

from app.core.progress import Progress
from app.exercises import portrait
from app.exercises.library import library, load_exercise
from app.exercises.portrait import (
    ACROSS,
    PIXELS,
    find_portrait,
    kept_portrait,
    make_portrait,
    portrait_file,
    shipped_portraits,
)
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.planning.plan import Plan

ENTRY, TARGET = (10.0, -40.0, 30.0), (10.0, 5.0, 30.0)


def volume():
    """Air with a block of tissue, and bright bone right at the patient's left, back and head."""
    hu = np.full((40, 80, 100), -1000, np.int16)
    hu[5:35, 20:60, 20:80] = 40
    hu[30:35, 50:60, 70:80] = 1000  # left, back, head
    affine = np.diag([2.0, 2.0, 2.0, 1.0])
    affine[:3, 3] = -100.0, -80.0, -10.0
    return Volume(hu, affine, Series.__new__(Series))  # no part of the picture comes from it


@pytest.fixture
def exercise(tmp_path, monkeypatch):
    """An exercise with a plan of its own, and a cache of its own."""
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(
        "app.exercises.scene.plan_of", lambda _: Plan(np.array(ENTRY), np.array(TARGET), "plan")
    )
    exercise = load_exercise("first-insertion")
    phantom = exercise.ct.phantom.model_copy(update={"seed": 4711})  # whose picture does not ship
    ct = exercise.ct.model_copy(update={"phantom": phantom})
    return exercise.model_copy(update={"ct": ct})


def test_left_back_and_head_stand_where_radiologists_look_for_them(exercise):
    made = make_portrait(exercise, volume())
    through = portrait._pictured(volume(), (52.0, 28.0, 54.0), None).slices
    bright = {name: np.argwhere(picture == 255).mean(axis=0) for name, picture in through.items()}
    middle = {name: np.array(picture.shape) / 2 for name, picture in made.slices.items()}
    assert (bright["axial"] > middle["axial"]).all()  # down and right: back and left
    assert bright["coronal"][0] < middle["coronal"][0]  # the head is on top
    assert bright["sagittal"][1] > middle["sagittal"][1]  # front at the left


def test_air_is_left_out_and_the_plan_is_not(exercise):
    made = make_portrait(exercise, volume())
    assert made.low_mm[0] > -90.0
    assert made.high_mm[0] < 90.0
    for point in (made.entry_mm, made.target_mm):
        for name in ACROSS:
            x, y = made.place(name, point)
            assert 0.0 <= x <= 1.0
            assert 0.0 <= y <= 1.0
    assert max(max(picture.shape) for picture in made.slices.values()) <= PIXELS


def test_it_is_kept_and_found_again_without_the_ct(exercise, monkeypatch):
    assert kept_portrait(exercise) is None
    made = make_portrait(exercise, volume())
    monkeypatch.setattr(portrait, "_volume_of", lambda *_: pytest.fail("read again"))
    found = find_portrait(exercise, None, Progress())
    assert found.target_mm == made.target_mm
    assert found.entry_mm == made.entry_mm
    np.testing.assert_array_equal(found.slices["axial"], made.slices["axial"])


def test_its_file_names_nobody_and_a_damaged_one_is_made_anew(exercise):
    file = portrait_file(exercise)
    assert exercise.id not in file.name
    file.parent.mkdir(parents=True)
    file.write_bytes(b"PK no archive")
    assert kept_portrait(exercise) is None
    make_portrait(exercise, volume())
    assert kept_portrait(exercise) is not None


def test_another_plan_or_patient_has_another_picture(exercise):
    other = load_exercise("thick-tissue")
    assert portrait_file(exercise) != portrait_file(other)
    again = exercise.model_copy(update={"title": "Another title"})
    assert portrait_file(exercise) == portrait_file(again)


def test_a_ct_that_cannot_be_read_leaves_no_picture_and_no_error(exercise, tmp_path):
    ct = exercise.ct.model_copy(update={"phantom": None, "folder": tmp_path / "gone"})
    assert find_portrait(exercise.model_copy(update={"ct": ct})) is None


@pytest.mark.parametrize("shipped", list(library()), ids=lambda exercise: exercise.id)
def test_the_picture_of_a_shipped_exercise_ships_with_it(shipped, tmp_path, monkeypatch):
    """A first start would make it for minutes; `python -m tools.portraits` makes what lacks."""
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "nothing in it"))
    assert kept_portrait(shipped) is not None


def test_no_picture_ships_of_what_no_exercise_shows():
    wanted = {portrait_file(one, shipped_portraits()) for one in library()}
    assert set(shipped_portraits().glob("*")) == wanted
