"""Bands that are fitted to two groups of attempts: where they lie, and where there are none."""

import numpy as np
import pytest

from app.scoring.contrasting import contrasted

RNG = np.random.default_rng(28)


def test_pass_lies_where_two_groups_part() -> None:
    """Careful 0.1 to 0.5, hasty 1.5 to 4.5: any value between parts them; the middle is taken."""
    careful, hasty = np.linspace(0.1, 0.5, 21), np.linspace(1.5, 4.5, 21)
    bands = contrasted(careful, hasty)
    assert bands is not None
    assert bands.expert == pytest.approx(0.42)  # 80 % of them
    assert bands.pass_ == pytest.approx(1.0)
    assert bands.good == pytest.approx(0.71)
    assert bands.zero == pytest.approx(3.0)


def test_of_two_groups_that_overlap_as_few_as_can_be_are_on_the_wrong_side() -> None:
    """Two normal distributions of one width: they part half-way between their means."""
    careful = np.abs(RNG.normal(2.0, 0.5, 4000))
    hasty = np.abs(RNG.normal(4.0, 0.5, 4000))
    bands = contrasted(careful, hasty)
    assert bands is not None
    assert bands.pass_ == pytest.approx(3.0, abs=0.15)
    assert bands.expert == pytest.approx(2.0 + 0.5 * 0.8416, abs=0.1)  # 80 % point of a normal one


def test_of_several_values_with_as_few_on_the_wrong_side_the_middle_one_is_pass() -> None:
    """By hand: 2.5 and 6.5 leave two of six on the wrong side, 4.5 one of either, 3.5 more."""
    bands = contrasted([1.0, 2.0, 2.0, 2.0, 4.0, 6.0], [3.0, 5.0, 7.0, 8.0, 8.0, 8.0])
    assert bands is not None
    assert bands.pass_ == pytest.approx(4.5)
    assert bands.expert == pytest.approx(4.0)
    assert bands.zero == pytest.approx(7.5), "the median of the others, which is not their mean"


def test_where_half_of_both_are_on_the_wrong_side_at_best_there_are_no_bands() -> None:
    """A fifth of the ones do badly, nearly half of the others do best of all."""
    careful = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 40.0, 40.0]
    assert contrasted(careful, [0.5] * 9 + [30.0] * 10) is None


def test_the_sign_of_a_value_does_not_count() -> None:
    careful, hasty = [-0.1, 0.2, -0.3], [-2.0, 3.0, 4.0]
    assert contrasted(careful, hasty) == contrasted(np.abs(careful), np.abs(hasty))


@pytest.mark.parametrize("hasty", [[9.0, 10.0, 11.0], [33.0, 34.0, 35.0]])
def test_where_the_hasty_are_no_worse_there_are_no_bands(hasty: list[float]) -> None:
    """They are quick: time says nothing of care."""
    assert contrasted([33.0, 34.0, 35.0], hasty) is None
