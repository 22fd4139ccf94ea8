"""What a lens model leaves is told from the corners' noise."""

import numpy as np
import pytest

from app.tracking.calibration.misfit import misfit_px
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.views import BoardView
from tests.tracking.calibration_rig import usual_rig


def misfit(bend: float, noise: float) -> float:
    """Calibrate on views that are bent by waves of so many pixels, which no lens model follows."""
    rig, rng, views = usual_rig(), np.random.default_rng(4), []
    for T in rig.poses(10, 6):
        view = rig.view(rig.left, T, noise, rng)
        wave = np.sin(view.pixels[:, ::-1] / 35.0)
        views.append(BoardView(view.board, view.ids, view.pixels + bend * wave, view.image_size))
    found = calibrate_mono(views, "left", 0)
    unknowns = len(found.calibration.estimated) + 6 * len(found.views)
    return misfit_px(found.views, found.adjusted, unknowns)


def test_white_noise_of_the_corners_is_no_misfit_of_the_lens() -> None:
    assert misfit(0.0, 0.2) < 0.05


@pytest.mark.long("statistics")
def test_waves_that_no_lens_follows_are_found_under_the_noise() -> None:
    quiet = misfit(0.3, 0.02)
    assert 0.08 < quiet < 0.25
    assert misfit(0.3, 0.15) == pytest.approx(quiet, rel=0.3)
