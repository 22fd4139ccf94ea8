"""Layers of an exercise from its CT: what they are like, when they are taken, what is recorded."""

from collections.abc import Callable

import pytest

from app.compose.explaining import explanation
from app.compose.run_context import conditions_of
from app.exercises.parts import LayersFrom, OwnPlan
from app.exercises.scene import device_of, plan_of, scene_of
from app.exercises.schema import Exercise
from app.exercises.tissue import REACH_MM, layers_along, with_tissue
from app.imaging.errors import ImagingError
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.volume import Volume

EFFECTS = ["puncture", "cutting", "shaft_friction", "bone_contact"]


@pytest.fixture(scope="module")
def volume() -> Volume:
    return load_ct(phantom_series(1))


@pytest.fixture
def exercise() -> Callable[..., Exercise]:
    def made(**given: object) -> Exercise:
        return Exercise.model_validate({"id": "x", "title": "X", "effects": EFFECTS} | given)

    return made


def test_layers_of_a_ct_have_its_thickness_and_the_tissues_own_values(
    volume: Volume, exercise: Callable[..., Exercise]
) -> None:
    layers = layers_along(volume, plan_of(exercise()))
    assert [layer.name for layer in layers] == ["skin", "fat", "muscle", "fat", "organ"]
    assert [layer.puncture_force for layer in layers] == [1.5, 0.0, 1.0, 0.0, 0.6]
    assert 8.0 < layers[2].thickness_mm < 20.0
    assert sum(layer.thickness_mm for layer in layers) == pytest.approx(REACH_MM)


def test_only_an_exercise_that_asks_takes_its_layers_from_the_ct(
    volume: Volume, exercise: Callable[..., Exercise]
) -> None:
    plain, asks = exercise(), exercise(layers_from="ct")
    plan = plan_of(plain)
    assert with_tissue(plain, volume, plan) is plain
    assert with_tissue(asks, None, plan) is asks
    taken = with_tissue(asks, volume, plan)
    again = Exercise.model_validate_json(taken.model_dump_json())  # as a record holds it
    assert again.layers == taken.layers
    assert again.layers_from is LayersFrom.CT
    assert [one.name for one in scene_of(again, device_of(again)).membranes] == [
        "skin",
        "muscle",
        "organ",
    ]


def test_attempts_stay_comparable_whatever_path_the_student_chose(
    volume: Volume, exercise: Callable[..., Exercise]
) -> None:
    asks = exercise(layers_from="ct")
    taken = with_tissue(asks, volume, plan_of(asks))
    assert conditions_of(taken) == conditions_of(asks)
    assert conditions_of(asks) != conditions_of(exercise())


@pytest.mark.long("statistics")
def test_what_is_simulated_is_explained_with_the_layers_of_the_ct(
    exercise: Callable[..., Exercise],
) -> None:
    asks = exercise(layers_from="ct")
    found = explanation(asks)
    assert {one["effect"] for one in found["simulated"]} == (
        set(EFFECTS) - {"bone_contact"} | {"camera_tone", "camera_jpeg"}
    )
    assert "it needs bones" in found["dropped"][0]["why"]
    own = asks.model_copy(update={"plan": OwnPlan(own=True)})
    assert explanation(own)["simulated"]


def test_pictures_that_are_no_ct_are_refused(
    volume: Volume, exercise: Callable[..., Exercise]
) -> None:
    other = Volume(volume.hu, volume.affine_mm, volume.series, unit="")
    with pytest.raises(ImagingError, match="give the layers by hand"):
        with_tissue(exercise(layers_from="ct"), other, plan_of(exercise()))
