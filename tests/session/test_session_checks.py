"""The daily check: verdicts and what to do, from plain facts."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from app.device.readiness import ForceClearance
from app.session.checks.facts import CameraFacts, DailyFacts, RobotFacts, TouchFacts
from app.session.checks.record import DayCheck, newest_check, save_check
from app.session.checks.steps import CheckVerdict, StepResult, daily_check, overall
from app.tracking.picture_quality import PictureQuality, picture_quality

MM = 1e-3
SHARP = PictureQuality(110.0, 0.02, 0.001, 2.4)
LEFT = CameraFacts("left", "", 30.0, 30.0, SHARP, "")
RIGHT = replace(LEFT, name="right")
ROBOT = RobotFacts(False, True, True, True, ForceClearance(1.0, 5.0), "", 0.001)
TOUCH = TouchFacts("F", np.zeros(3), np.array([0.4 * MM, 0.0, 0.3 * MM]), 0.3 * MM)
GOOD = DailyFacts(ROBOT, (LEFT, RIGHT), 0.3, "", 0.4 * MM, TOUCH)


def step(facts: DailyFacts, name: str) -> StepResult:
    return next(one for one in daily_check(facts) if one.name == name)


def test_everything_well_is_green_and_says_nothing_to_do() -> None:
    results = daily_check(GOOD)
    assert overall(results) is CheckVerdict.GOOD
    assert [one.name for one in results] == [
        "homing", "signs", "force", "pictures", "marker", "residual", "touch",
    ]  # fmt: skip
    assert all(not one.todo for one in results)


@pytest.mark.parametrize(
    ("facts", "name", "verdict", "text"),
    [
        (replace(GOOD, robot=replace(ROBOT, ticking=False)), "homing", CheckVerdict.BAD, "loop"),
        (replace(GOOD, robot=replace(ROBOT, homed=False)), "homing", CheckVerdict.BAD, "not homed"),
        (
            replace(GOOD, robot=replace(ROBOT, signs=False)),
            "signs",
            CheckVerdict.BAD,
            "not checked",
        ),
        (
            replace(GOOD, robot=replace(ROBOT, fault="board error")),
            "force",
            CheckVerdict.BAD,
            "board",
        ),
        (replace(GOOD, robot=replace(ROBOT, encoder_age=0.2)), "force", CheckVerdict.BAD, "late"),
        (
            replace(GOOD, robot=replace(ROBOT, encoder_age=np.nan)),
            "force",
            CheckVerdict.BAD,
            "late",
        ),
        (
            replace(GOOD, robot=replace(ROBOT, clearance=ForceClearance(1.0, 1.0, "weigh it"))),
            "force",
            CheckVerdict.WARNING,
            "at most 1 N",
        ),
        (
            replace(GOOD, robot=replace(ROBOT, clearance=ForceClearance(0.0, 0.0, "home it"))),
            "force",
            CheckVerdict.BAD,
            "at most 0 N",
        ),
        (replace(GOOD, cameras=()), "pictures", CheckVerdict.BAD, "0 of 2 cameras"),
        (replace(GOOD, cameras=(LEFT,)), "pictures", CheckVerdict.BAD, "1 of 2 cameras"),
        (
            replace(GOOD, cameras=(LEFT, replace(RIGHT, trouble="no picture for 2.0 s"))),
            "pictures",
            CheckVerdict.BAD,
            "right: no picture",
        ),
        (
            replace(GOOD, cameras=(LEFT, replace(RIGHT, quality=replace(SHARP, level=4.0)))),
            "pictures",
            CheckVerdict.BAD,
            "right: the picture is dark",
        ),
        (
            replace(GOOD, cameras=(replace(LEFT, quality=replace(SHARP, bright=0.3)), RIGHT)),
            "pictures",
            CheckVerdict.WARNING,
            "overexposed",
        ),
        (
            replace(GOOD, cameras=(replace(LEFT, quality=replace(SHARP, edge_width=9.0)), RIGHT)),
            "pictures",
            CheckVerdict.WARNING,
            "9.0 px wide",
        ),
        (
            replace(GOOD, cameras=(replace(LEFT, rate=12.0), RIGHT)),
            "pictures",
            CheckVerdict.WARNING,
            "12 pictures a second instead of 30",
        ),
        (
            replace(GOOD, cameras=(LEFT, replace(RIGHT, miss="too small for the marker"))),
            "marker",
            CheckVerdict.BAD,
            "right: too small",
        ),
        (replace(GOOD, residual_px=None), "residual", CheckVerdict.WAITING, "no point"),
        (replace(GOOD, residual_px=1.5), "residual", CheckVerdict.WARNING, "1.50 px"),
        (replace(GOOD, residual_px=4.0), "residual", CheckVerdict.BAD, "4.00 px"),
        (replace(GOOD, status="the cameras disagree"), "residual", CheckVerdict.BAD, "disagree"),
        (
            replace(GOOD, touch=replace(TOUCH, radius=7 * MM)),
            "touch",
            CheckVerdict.WARNING,
            "± 7.00",
        ),
        (replace(GOOD, touch=None), "touch", CheckVerdict.WAITING, "not touched"),
        (
            replace(GOOD, touch=replace(TOUCH, p_measured=np.array([0, 3 * MM, 0]))),
            "touch",
            CheckVerdict.BAD,
            "3.00 mm off",
        ),
    ],
)
def test_what_is_wrong_is_found_and_something_is_to_do(
    facts: DailyFacts, name: str, verdict: CheckVerdict, text: str
) -> None:
    found = step(facts, name)
    assert found.verdict is verdict
    assert text in found.found
    assert found.todo
    assert overall(daily_check(facts)) is verdict


def test_a_simulated_robot_needs_no_homing() -> None:
    simulated = RobotFacts(True, True, False, False, None, "", 0.001)
    assert overall(daily_check(replace(GOOD, robot=simulated))) is CheckVerdict.GOOD


def test_the_result_of_the_day_is_kept_and_said(tmp_path: Path) -> None:
    assert newest_check(tmp_path) is None
    morning = datetime(2026, 11, 22, 8, 12, tzinfo=UTC)
    check = DayCheck.of(daily_check(GOOD), morning, "icube", simulated=True)
    save_check(check, tmp_path)
    assert newest_check(tmp_path) == check
    assert check.words(morning + timedelta(hours=3)) == "checked today 08:12"
    assert check.words(morning + timedelta(days=1)) == "checked 2026-11-22 08:12"
    (tmp_path / "20991231-000000.yaml").write_text("no: [")
    assert newest_check(tmp_path) == check


def picture(blur: float) -> np.ndarray:
    import cv2

    image = np.full((120, 160, 3), 120, dtype=np.uint8)
    image[40:80, 60:100] = (40, 30, 200)
    return cv2.GaussianBlur(image, (0, 0), blur)


def test_the_width_of_the_marker_s_edge_is_that_of_the_blur() -> None:
    for blur in (0.8, 1.5, 3.0):
        width = picture_quality(picture(blur), np.array([80.0, 60.0])).edge_width
        assert width is not None
        # A Gaussian's 10 to 90 % width is 2.56 σ; Sobel's own smoothing widens narrow edges.
        assert width == pytest.approx(2.56 * np.hypot(blur, 0.9), rel=0.25)


def test_dark_and_overexposed_pictures_are_measured() -> None:
    dark = picture_quality(np.zeros((120, 160, 3), dtype=np.uint8), None)
    assert dark.dark == 1.0
    assert dark.edge_width is None
    bright = picture_quality(np.full((120, 160, 3), 255, dtype=np.uint8), np.array([500.0, 3.0]))
    assert bright.bright == 1.0
    assert bright.edge_width is None
