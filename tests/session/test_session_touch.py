"""Touches: the mean of a second of fixes, with what does not average out."""

import numpy as np
import pytest

from app.session.touch import TouchCollector, TouchError
from app.tracking.fix import FixStatus, NeedleFix

MM = 1e-3
NOISE = (0.1 * MM) ** 2 * np.eye(3)
WHOLE = NOISE + (0.2 * MM) ** 2 * np.eye(3)


def fix(time: float, tip: np.ndarray, status: FixStatus = FixStatus.VALID) -> NeedleFix:
    return NeedleFix(
        tip, WHOLE, time, status, (None, None), 0.2, has_point=status is FixStatus.VALID,
        noise_covariance=NOISE,
    )  # fmt: skip


def test_noise_averages_out_and_calibration_does_not() -> None:
    rng, collector = np.random.default_rng(1), TouchCollector()
    for i in range(31):
        collector.add(fix(i / 30, 0.1 * MM * rng.standard_normal(3)))
    touch = collector.touch()
    assert collector.share == 1.0
    assert touch.count == 31
    assert np.linalg.norm(touch.p_world) < 0.1 * MM
    deviation = np.sqrt(np.diag(touch.covariance)) / MM
    np.testing.assert_allclose(deviation, 0.2, atol=0.04)


def test_fixes_that_do_not_scatter_as_they_say_are_wrong_together() -> None:
    collector = TouchCollector()
    for i in range(31):
        collector.add(fix(i / 30, np.zeros(3)))
    np.testing.assert_allclose(collector.touch().covariance, WHOLE, rtol=1e-9)


def test_a_fix_that_was_seen_already_does_not_count_twice() -> None:
    collector = TouchCollector()
    for _ in range(50):
        collector.add(fix(1.0, np.zeros(3)))
    with pytest.raises(TouchError, match="only 1 of 1 fixes"):
        collector.touch()


def test_a_tip_that_moves_is_refused() -> None:
    collector = TouchCollector()
    for i in range(31):
        collector.add(fix(i / 30, np.array([i * 0.2 * MM, 0.0, 0.0])))
    with pytest.raises(TouchError, match=r"moved by 1\.8 mm"):
        collector.touch()


def test_a_marker_that_is_lost_is_said() -> None:
    collector = TouchCollector()
    for i in range(30):
        status = FixStatus.VALID if i < 5 else FixStatus.OUT_OF_VIEW
        collector.add(fix(i / 30, np.zeros(3), status))
    with pytest.raises(TouchError, match="only 5 of 30 fixes"):
        collector.touch()


def test_fixes_of_one_camera_measure_no_touch() -> None:
    collector = TouchCollector()
    for i in range(30):
        status = FixStatus.VALID if i % 2 else FixStatus.ONE_CAMERA
        far = np.array([0.0, 0.0, 0.0 if i % 2 else 20 * MM])
        collector.add(fix(i / 15, far, status))
    touch = collector.touch()
    assert touch.count == 15
    assert np.abs(touch.p_world).max() == 0.0


def test_a_trembling_hand_widens_the_covariance() -> None:
    rng, collector = np.random.default_rng(2), TouchCollector()
    for i in range(31):
        collector.add(fix(i / 30, 0.25 * MM * rng.standard_normal(3)))
    assert np.trace(collector.touch().covariance) > 3 * (0.2 * MM) ** 2 + np.trace(NOISE) * 4 / 31
