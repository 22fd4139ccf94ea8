"""A bar of work that cannot tell how far it is moves by time all the same."""

import time

import pytest

from app.core.progress import Cancelled, Progress, elapsed_share, moving


@pytest.mark.long("journey")
def test_the_bar_moves_on_and_says_the_seconds_while_the_work_stands_still():
    told = []
    progress = Progress(lambda fraction, text: told.append((fraction, text)))
    with moving(progress.part(0.6, 0.8), lambda waited: f"{waited:.1f} s"):
        time.sleep(1.2)
    fractions = [fraction for fraction, _ in told]
    assert len(told) >= 4
    assert fractions == sorted(set(fractions))
    assert fractions[0] == 0.6
    assert fractions[-1] < 0.8
    assert len({text for _, text in told}) == len(told)
    time.sleep(0.4)
    assert len(told) == len(fractions)  # it ends with the work


def test_a_bar_by_time_never_arrives_and_never_stands():
    shares = [elapsed_share(seconds) for seconds in range(0, 200, 5)]
    assert shares == sorted(set(shares))
    assert shares[0] == 0.0
    assert shares[-1] < 1.0


def test_work_that_was_cancelled_does_not_begin_and_the_error_of_work_comes_through():
    progress = Progress()
    with pytest.raises(ZeroDivisionError), moving(progress, lambda _: ""):
        raise ZeroDivisionError
    progress.cancel()
    with pytest.raises(Cancelled), moving(progress, lambda _: ""):
        pass
