"""The verdict on a calibration follows the rig's size, not fixed millimetres."""

import pytest
from calibration_samples import sample

from app.tracking.calibration.checks import check_baseline
from app.tracking.calibration.verdict import Grade, Why, judge
from app.tracking.optics.calibration import FitTogether, StereoCalibration
from app.tracking.optics.rig import load_rig


@pytest.fixture
def good() -> StereoCalibration:
    return sample(load_rig("wide"))


def held_back(calibration: StereoCalibration, **values: float) -> StereoCalibration:
    assert calibration.validation is not None
    return calibration.model_copy(
        update={"validation": calibration.validation.model_copy(update=values)}
    )


@pytest.mark.parametrize(
    ("rms_mm", "distance_mm", "grade"),
    [
        (0.1, 150.0, Grade.GOOD),
        (0.3, 150.0, Grade.USABLE),
        (0.6, 150.0, Grade.NOT_GOOD_ENOUGH),  # the fixed millimetre called it usable
        (1.5, 2000.0, Grade.GOOD),  # and this one of no use
        (5.0, 2000.0, Grade.USABLE),
        (8.0, 2000.0, Grade.NOT_GOOD_ENOUGH),
    ],
)
def test_errors_on_pairs_held_back_count_against_the_boards_distance(
    good: StereoCalibration, rms_mm: float, distance_mm: float, grade: Grade
) -> None:
    found = judge(held_back(good, rms_mm=rms_mm, distance_mm=distance_mm))
    assert found.grade is grade
    assert f"{rms_mm:.2f} mm" in found.text


def test_every_reason_is_said(good: StereoCalibration) -> None:
    assert judge(good).why is Why.RIGHT
    assert judge(good.model_copy(update={"validation": None})).why is Why.UNCHECKED
    assert judge(good.model_copy(update={"rms_px": 0.9})).why is Why.RESIDUAL
    assert judge(good.model_copy(update={"rms_px": 3.0})).why is Why.RESIDUAL_BAD
    assert judge(held_back(good, scale=1.01)).why is Why.LENGTHS
    moved = FitTogether(alone_px=(0.1, 0.1), together_px=0.58, sd_factor=9.0)
    assert judge(good.model_copy(update={"together": moved})).why is Why.APART
    against = judge(good, [check_baseline(good, 2e3 * good.baseline)])
    assert against.why is Why.CONTRADICTED
    assert against.grade is Grade.NOT_GOOD_ENOUGH
