"""Screens from 1366 × 768 to 4K at 100, 150 and 200 %: what is clicked is what is seen."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("scaled_window.py")
VOXEL_MM = 2.0


@pytest.mark.parametrize(
    ("factor", "width", "height"),
    [(1.0, 1366, 768), (1.5, 2560, 1440), (2.0, 1920, 1080)],
)
def test_a_click_lands_on_what_is_seen_at_every_scaling(factor, width, height):
    """Sizes are in the window's own, scaled pixels: 4K is 2560 × 1440 at 150 %."""
    environment = os.environ | {"QT_SCALE_FACTOR": str(factor)}
    environment.pop("DISPLAY", None)
    answer = subprocess.run(
        [sys.executable, str(SCRIPT), str(width), str(height)],
        env=environment, cwd=SCRIPT.parents[2], capture_output=True, text=True, timeout=120,
        check=False,
    )  # fmt: skip
    assert answer.returncode == 0, answer.stderr[-2000:]
    found = json.loads(answer.stdout.splitlines()[-1])
    assert found["ratio"] == factor
    assert found["size"] == [width, height]
    assert not found["outside"]
    assert max(found["off_mm"]) < VOXEL_MM, found
