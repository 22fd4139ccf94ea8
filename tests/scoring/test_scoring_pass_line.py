"""What a pass line is, against the normal and gamma distributions of another library."""

import pytest
from scipy import stats

from app.scoring.errors import ToleranceError
from app.scoring.pass_line import ANGLES, DISTANCES, Hands, pass_words, share_within


@pytest.mark.parametrize("hands", [*DISTANCES, *ANGLES], ids=lambda one: one.words)
@pytest.mark.parametrize("limit", [0.0, 0.4, 2.7, 5.0, 40.0])
def test_the_share_of_hands_is_that_of_a_gamma_distribution(hands: Hands, limit: float) -> None:
    variance = hands.sd**2
    expected = stats.gamma.cdf(limit, hands.mean**2 / variance, scale=variance / hands.mean)
    assert share_within(limit, hands) == pytest.approx(expected, abs=1e-12)


def test_a_pass_line_of_an_error_is_called_a_wish_with_the_share_of_hands_that_keep_it() -> None:
    words = pass_words("lateral_error", 2.7)
    assert words.startswith("a wish of 153 respondents (125 radiologists), nobody's measured hand")
    assert "at least 14% freehand, 38% guided" in words
    assert pass_words("angle_error", 2.2).startswith("of published hands 45% freehand")
    assert "wish" not in pass_words("depth_error", 5.0)
    assert pass_words("total_time", 300.0) == ""


def test_limits_at_the_ends_of_all_numbers_are_borne_or_refused() -> None:
    assert share_within(float("inf"), DISTANCES[0]) == 1.0
    assert share_within(5e-324, DISTANCES[0]) == pytest.approx(0.0, abs=1e-12)
    for bad in (-1.0, float("nan")):
        with pytest.raises(ToleranceError, match="give 0 or more"):
            share_within(bad, DISTANCES[0])
