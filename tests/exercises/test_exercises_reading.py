"""The field `reading` of an exercise: window and layout that it begins with, or holds."""

import pytest
from pydantic import ValidationError

from app.exercises.reading import LayoutName, ReadingPart
from app.exercises.schema import Exercise
from app.imaging.window import PRESETS, WindowLevel


def exercise(**reading):
    return Exercise.model_validate({"id": "a", "title": "A", "reading": reading})


def test_without_the_field_everything_is_left_to_the_student():
    part = Exercise(id="a", title="A").reading
    assert part == ReadingPart()
    assert part.window_level is None
    assert part.layout is None
    assert not part.locked


@pytest.mark.parametrize("name", ["Lung", "lung", "LUNG", " lung "])
def test_a_window_is_named_as_in_the_menu_whatever_its_case(name):
    assert exercise(window=name).reading.window_level == PRESETS["Lung"]


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_can_be_named_with_underscores_too(name):
    assert exercise(window=name.replace(" ", "_")).reading.window_level == PRESETS[name]


def test_a_window_can_be_numbers():
    part = exercise(window={"width": 350, "level": -20}).reading
    assert part.window_level == WindowLevel(350.0, -20.0)


@pytest.mark.parametrize("name", LayoutName)
def test_every_layout_can_be_named(name):
    assert exercise(layout=str(name)).reading.layout is name


@pytest.mark.parametrize(
    ("reading", "says"),
    [
        ({"window": "lungs"}, "there is no window 'lungs'; there are: Soft tissue, Lung"),
        ({"window": {"width": 0.5, "level": 0}}, "greater than or equal to 1"),
        ({"window": {"width": float("nan"), "level": 0}}, "finite"),
        ({"window": {"width": 400}}, "level"),
        ({"window": {"width": 400, "level": 1e9}}, "less than or equal to"),
        ({"window": {"width": 400, "level": 40, "slope": 1}}, "slope"),
        ({"layout": "3x3"}, "'2x2', '1+3', '6-up' or 'needle'"),
        ({"locked": True}, "give at least one of them"),
        ({"zoom": 2}, "zoom"),
    ],
)
def test_what_cannot_be_used_is_refused_with_the_valid_ones(reading, says):
    with pytest.raises(ValidationError) as refused:
        exercise(**reading)
    assert says in str(refused.value)
