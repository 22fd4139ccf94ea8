"""The study of the pen: a few poses of it."""

import numpy as np
import pytest

from app.core.progress import Progress
from app.studies import pen
from app.studies.pen import Outcome, Setup, rendered, trials
from app.tracking.confidence import chi_square_quantile


@pytest.mark.long("statistics")
def test_rendered_pictures_give_the_tip_to_a_fraction_of_a_millimetre():
    found = rendered(Setup(), poses=6)
    assert found.share > 0.6
    assert np.median(found.tip) < 1e-3


@pytest.mark.long("statistics")
def test_the_ellipsoid_holds_in_trials_with_everything_declared_drawn_anew():
    found = trials(60)
    assert found.share > 0.5, "single faces are refused where nothing but the picture is known"
    assert np.mean(found.distance < chi_square_quantile(0.95, 3)) >= 0.88


@pytest.mark.long("statistics")
def test_the_study_has_a_row_for_each_condition_and_says_what_the_trials_gave(monkeypatch):
    monkeypatch.setattr(pen, "SETUPS", (Setup(), Setup(distance=0.35)))
    monkeypatch.setattr(pen, "rendered", lambda setup: rendered(setup, poses=3))
    monkeypatch.setattr(pen, "trials", lambda: trials(20))
    told = []
    found = pen.STUDY.measure(Progress(lambda share, text: told.append(share)))
    (sheet,) = found.sheets
    assert len(sheet.rows) == 2
    assert all(len(row) == len(sheet.columns) for row in sheet.rows)
    assert "95 % ellipsoid" in found.lines[-1]
    assert told == sorted(told)


def test_a_condition_in_which_nothing_is_found_has_a_row_that_says_so():
    nothing = Outcome(np.array([]), np.array([]), np.array([]), 0.0)
    row = pen._row(Setup(), nothing)
    assert row[4] == 0.0
    assert row[-1] == "-"
