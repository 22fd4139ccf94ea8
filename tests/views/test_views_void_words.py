"""What a void attempt says can be done about it."""

import pytest

from app.scoring.conditions import Conditions, DeviceKind
from app.scoring.result import TRACKING, judge
from app.scoring.rows import Row, ScoreRules
from app.views.debrief.score_words import remedy

UNSEEN = (Row(TRACKING, "Tracking valid", "%", 41.0),)


@pytest.mark.parametrize(
    "score",
    [judge(UNSEEN, ScoreRules()),
     judge((), ScoreRules(), "the attempt waited 31 s for the cameras; 20 s are allowed")],
)  # fmt: skip
def test_simulated_cameras_that_came_too_late_are_the_busy_computers_fault(score):
    words = remedy(score, Conditions("e", kind=DeviceKind.SIMULATED))
    assert "computer was too busy" in words
    assert "marker" not in words
    real = remedy(score, Conditions("e", kind=DeviceKind.REAL))
    assert "Let both cameras see the marker" in real
    assert remedy(score) == real


def test_what_the_hand_did_is_not_blamed_on_the_computer():
    score = judge(UNSEEN, ScoreRules(), "the attempt was aborted: Esc")
    assert "busy" not in remedy(score, Conditions("e", kind=DeviceKind.SIMULATED))
