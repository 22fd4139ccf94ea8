"""The limits of the boxes that an exercise is written with are those of its model."""

import pytest

from app.core.documents import limits
from app.exercises.schema import Exercise


@pytest.mark.parametrize(
    ("where", "expected"),
    [
        ("level", (1, 9, 1)),
        ("seed", (0, 2**31 - 1, 1)),
        ("assistance", (-1.0, 1.0, 0.7)),
        ("fading.least", (-1.0, 1.0, 0.0)),
        ("fading.step", (0.01, 1.0, 0.2)),  # more than 0: a hundredth above it
        ("fading.probe_every", (0, 100, 0)),
        ("reading.slab.thickness_mm", (0.0, 100.0, 0.0)),
        ("guidance.slices", (3, 5, 3)),
        ("guidance.dose_per_slice", (0.0, 1000.0, 3.85)),
        ("rules.minimum_tracking", (0.0, 100.0, 70.0)),
    ],
)
def test_limits_and_defaults_are_the_models(where, expected):
    found = limits(Exercise, *where.split("."))
    assert found == expected
    assert [type(value) for value in found] == [type(value) for value in expected]


def test_what_the_model_does_not_have_is_a_mistake():
    with pytest.raises(KeyError, match="stature"):
        limits(Exercise, "needle", "stature")
