"""Screens from 1366 × 768 to 4K at 100, 150 and 200 %: what is clicked is what is seen."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("scaled_window.py")
VOXEL_MM = 2.0


SCREENS = ((1.0, 1366, 768), (1.5, 2560, 1440), (2.0, 1920, 1080))
"""Factor and size in the window's own, scaled pixels: 4K is 2560 × 1440 at 150 %."""


@pytest.fixture(scope="module")
def answers():
    """What each window found, in a process of its own that has everything loaded."""
    environment = os.environ.copy()
    environment.pop("DISPLAY", None)
    answer = subprocess.run(
        [sys.executable, str(SCRIPT), json.dumps(SCREENS)],
        env=environment, cwd=SCRIPT.parents[2], capture_output=True, text=True, timeout=240,
        check=False,
    )  # fmt: skip
    assert answer.returncode == 0, answer.stderr[-2000:]
    lines = [line for line in answer.stdout.splitlines() if line.startswith("{")]
    assert len(lines) == len(SCREENS), answer.stderr[-2000:]
    return dict(zip(SCREENS, map(json.loads, lines), strict=True))


@pytest.mark.long("journey")
@pytest.mark.parametrize("screen", SCREENS)
def test_a_click_lands_on_what_is_seen_at_every_scaling(answers, screen):
    factor, width, height = screen
    found = answers[screen]
    assert found["ratio"] == factor
    assert found["size"] == [width, height]
    assert not found["outside"]
    assert max(found["off_mm"]) < VOXEL_MM, found
