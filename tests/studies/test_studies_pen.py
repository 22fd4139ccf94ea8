"""The study of the pen: a few poses of it."""

import numpy as np

from app.studies.webcam.setups import Setup
from app.studies.webcam.trials import rendered, trials
from app.tracking.confidence import chi_square_quantile


def test_rendered_pictures_give_the_tip_to_a_fraction_of_a_millimetre():
    found = rendered(Setup(), poses=6)
    assert found.share > 0.6
    assert np.median(found.tip) < 1e-3


def test_the_ellipsoid_holds_in_trials_with_everything_declared_drawn_anew():
    found = trials(60)
    assert found.share > 0.5, "single faces are refused where nothing but the picture is known"
    assert np.mean(found.distance < chi_square_quantile(0.95, 3)) >= 0.88
