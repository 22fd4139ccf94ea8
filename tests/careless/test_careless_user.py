"""The careless user: what it draws and finds, and one minute of it at the real window."""

import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QWidget

from app.views.kit.theme import apply_theme
from tests.careless.actions import Action, Screen, Target, draw, read_actions
from tests.careless.texts import cut_texts

ROOT = Path(__file__).resolve().parents[2]
PAD = Target("MainWindow0/PadCanvas0", "pad", (10, 10, 300, 300))
SCREEN = Screen(
    controls=(Target("MainWindow0/QPushButton0", "Start", (0, 0, 80, 20)),),
    pictures=(PAD,),
    runs=True,
    end=None,
    scan=None,
    entries=(),
    titles=(Target("", "File", (0, 0, 40, 20)),),
    front=Target("MainWindow0", "", (0, 0, 1366, 768)),
    is_main=True,
    is_file_dialog=False,
    exercises=("first-insertion",),
    cts=("/data/ct",),
)


@pytest.fixture(scope="module")
def application():
    found = QApplication.instance() or QApplication([])
    apply_theme(found)
    return found


@pytest.mark.long("journey")
def test_a_seed_draws_the_same_actions_and_they_can_be_written_down_and_read(tmp_path):
    first, again = random.Random(7), random.Random(7)
    drawn = [draw(first, SCREEN) for _ in range(300)]
    assert drawn == [draw(again, SCREEN) for _ in range(300)]
    (tmp_path / "actions").write_text("\n".join(action.text() for action in drawn))
    assert read_actions(tmp_path / "actions") == drawn
    assert {"click", "drag", "wheel", "key", "wait", "title", "size"} <= {a.kind for a in drawn}


@pytest.mark.long("journey")
def test_nobody_types_at_random_into_a_dialog_of_files():
    from dataclasses import replace

    dialog = replace(SCREEN, is_file_dialog=True, is_main=False)
    rng = random.Random(1)
    assert {draw(rng, dialog) for _ in range(50)} == {Action("key", words="Escape")}


@pytest.mark.long("journey")
def test_cut_texts_are_found_and_whole_and_elided_ones_are_not(application):
    window = QWidget()
    window.resize(400, 300)
    label, button, elided, whole = (
        QLabel("a label that is far too long for its place", window),
        QPushButton("a button with a long word", window),
        QLabel("an elided…", window),
        QLabel("whole", window),
    )
    label.setGeometry(0, 0, 60, 20)
    button.setGeometry(0, 30, 50, 24)
    elided.setGeometry(0, 60, 30, 20)
    elided.setToolTip("an elided text")
    whole.setGeometry(0, 90, 200, 30)
    wrapped = QLabel("words that need three lines in so little room as this", window)
    wrapped.setWordWrap(True)
    wrapped.setGeometry(0, 130, 120, 16)
    window.show()
    application.processEvents()
    found = cut_texts(window)
    assert [one.split()[0] for one in found] == ["QLabel", "QPushButton", "QLabel"]
    wrapped.resize(120, 100)
    label.resize(390, 20)
    button.resize(300, 24)
    assert cut_texts(window) == []
    window.close()


@pytest.mark.long("journey")
@pytest.mark.display
@pytest.mark.timeout(900)
@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="xvfb-run is not installed")
@pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed")
def test_half_a_minute_of_a_careless_user_breaks_nothing(tmp_path):
    command = [sys.executable, "-m", "tests.careless", "--minutes", "0.5", "--seed", "1", "--whole"]
    said = subprocess.run(
        [*command, "--busy", "--keep", str(tmp_path)],
        cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True,
        timeout=880, check=False,
    )  # fmt: skip
    assert said.returncode == 0, said.stdout[-6000:] + said.stderr[-2000:]
