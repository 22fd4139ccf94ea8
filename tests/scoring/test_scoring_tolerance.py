from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from app.core.errors import NumericalError
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.score import check_names
from app.scoring.tolerance import Band, Bands, Tolerance, band, tolerance

LATERAL = Bands.model_validate({"expert": 2.0, "good": 3.0, "pass": 5.0})
VALID = Bands.model_validate({"expert": 99.0, "good": 95.0, "pass": 80.0})
seeded = settings(derandomize=True, deadline=None, max_examples=60)


@pytest.mark.parametrize(
    ("value", "utility"),
    [
        (0.0, 1.0),
        (2.0, 1.0),
        (2.5, 0.9),
        (3.0, 0.8),
        (4.0, 0.7),
        (5.0, 0.6),
        (7.5, 0.3),
        (10.0, 0.0),
        (1e9, 0.0),
    ],
)
def test_the_utility_is_linear_between_the_bands(value: float, utility: float) -> None:
    assert tolerance(value, LATERAL) == pytest.approx(utility)
    assert tolerance(-value, LATERAL) == pytest.approx(utility)


def test_where_higher_is_better_the_bands_run_the_other_way() -> None:
    assert VALID.higher_is_better
    values = [100.0, 99.0, 97.0, 95.0, 80.0, 60.0, 40.0, 0.0]
    expected = [1.0, 1.0, 0.9, 0.8, 0.6, 0.3, 0.0, 0.0]
    assert [tolerance(value, VALID) for value in values] == pytest.approx(expected)


@seeded
@given(
    st.lists(st.floats(0.01, 100.0), min_size=4, max_size=4, unique=True),
    st.booleans(),
    st.lists(st.floats(0.0, 200.0), min_size=2, max_size=20),
)
def test_the_utility_is_continuous_monotone_and_bounded(
    knots: list[float], rising: bool, values: list[float]
) -> None:
    expert, good, passing, zero = sorted(knots, reverse=rising)
    if min(abs(np.diff(sorted(knots)))) < 1e-6:
        return
    bands = Bands.model_validate({"expert": expert, "good": good, "pass": passing, "zero": zero})
    ordered = sorted(values, reverse=rising)
    utilities = [tolerance(value, bands) for value in ordered]
    assert all(0.0 <= utility <= 1.0 for utility in utilities)
    assert all(a >= b for a, b in pairwise(utilities))
    for knot in bands.knots:
        below, above = tolerance(knot * (1 - 1e-12), bands), tolerance(knot * (1 + 1e-12), bands)
        assert below == pytest.approx(above, abs=1e-3)


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (2.0, "expert"),
        (2.01, "good"),
        (-3.0, "good"),
        (5.0, "pass"),
        (5.01, "fail"),
        (99.0, "fail"),
    ],
)
def test_a_limit_belongs_to_the_better_band(value: float, name: str) -> None:
    assert band(value, LATERAL) is Band(name)


def test_bands_agree_with_utilities() -> None:
    for value in np.linspace(0.0, 12.0, 200):
        assert (band(value, LATERAL) is Band.FAIL) == (tolerance(value, LATERAL) < 0.6)


@pytest.mark.parametrize(
    "limits", [(2.0, 2.0, 5.0), (3.0, 2.0, 5.0), (2.0, 3.0, 3.0), (-2.0, -1.0, 0.0)]
)
def test_bands_that_do_not_rise_or_fall_are_refused(limits: tuple[float, ...]) -> None:
    with pytest.raises(ValidationError, match="must rise or fall strictly"):
        Bands.model_validate(dict(zip(("expert", "good", "pass"), limits, strict=True)))


def test_a_value_that_is_nan_has_no_utility() -> None:
    with pytest.raises(NumericalError, match="NaN"):
        tolerance(float("nan"), LATERAL)


def test_a_tolerance_survives_being_written_and_read() -> None:
    limits = Tolerance.model_validate(
        {"expert": 1, "good": 2, "pass": 3, "weight": 2, "required": True}
    )
    for by_alias in (True, False):
        assert Tolerance.model_validate(limits.model_dump(by_alias=by_alias)) == limits


def test_the_default_tolerances_fit_their_metrics() -> None:
    check_names(DEFAULT_TOLERANCES)
    assert any(limits.required for limits in DEFAULT_TOLERANCES.values())
