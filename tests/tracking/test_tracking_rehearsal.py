"""The tracker tries itself out before the first picture."""

import numpy as np
import pytest

from app.tracking import tracker as rehearsal
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Hint, MarkerFix
from app.tracking.optics.rig import load_rig, shipped_rigs
from app.tracking.solver import FixSolver

FULCRUM = np.array([0.0, 0.16056, 0.090])


@pytest.mark.long("statistics")
@pytest.mark.parametrize("rig_name", shipped_rigs())
@pytest.mark.parametrize("name", list(ExtractorName))
def test_every_way_can_be_rehearsed_on_every_rig(rig_name: str, name: ExtractorName) -> None:
    rig = load_rig(rig_name)
    rehearsal.rehearse(rig, FULCRUM, extractors(rig, name), FixSolver(rig, FULCRUM))


def test_the_drawn_band_is_found_so_that_no_kernel_is_left_out() -> None:
    rig = load_rig("wide")
    centre = FULCRUM - np.array([0.0, 0.0, 0.035])
    for model, extractor in zip(rig.models, extractors(rig), strict=True):
        picture, uv = rehearsal._drawn(model, rig.needle.shape, centre)
        found = extractor.find(picture, Hint(uv))
        assert isinstance(found, MarkerFix)
        assert np.abs(found.uv - uv).max() < 2.0
