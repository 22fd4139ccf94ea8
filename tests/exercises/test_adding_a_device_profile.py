"""A device profile is added in just the way that docs/architecture.md says: one file."""

import re
import shutil
from pathlib import Path

import pytest

from app.core import paths
from app.core.errors import ConfigurationError
from app.exercises.errors import ExerciseError
from app.exercises.library import read_exercise
from app.exercises.scene import device_of
from app.mechanisms.profile import load_profile
from app.planning.placement import Placement
from app.planning.plan import Plan
from app.planning.reach import reach

EXERCISE = """
id: on-another-device
title: On another device
device: {device}
"""


@pytest.fixture
def resources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the shipped resources, as a person who adds a file would have before them."""
    folder = tmp_path / "resources"
    shutil.copytree(paths.resources(), folder)
    monkeypatch.setattr(paths, "resources", lambda: folder)
    return folder


def add_profile(path: Path, **changes: str) -> None:
    """Copy icube.yaml, change the name and values: what the page says."""
    text = load_text().replace("name: icube", f"name: {path.stem}")
    for field, value in changes.items():
        text, found = re.subn(rf"{field}: \S+", f"{field}: {value}", text, count=1)
        assert found == 1
    path.write_text(text, encoding="utf-8")


def load_text() -> str:
    return (paths.resources() / "devices" / "icube.yaml").read_text(encoding="utf-8")


def test_a_copied_profile_is_found_by_its_name_and_used_by_an_exercise(resources: Path) -> None:
    add_profile(resources / "devices" / "workshop.yaml", needle_length="0.180")
    file = resources / "exercises" / "on-another-device.yaml"
    file.write_text(EXERCISE.format(device="workshop"), encoding="utf-8")
    profile = device_of(read_exercise(file))
    assert profile.name == "workshop"
    assert profile.geometry.needle_length == 0.180


def test_its_values_decide_what_is_within_reach(resources: Path) -> None:
    add_profile(resources / "devices" / "shallow.yaml", depth_max="0.060")
    plan = Plan((0.0, -100.0, 0.0), (0.0, -20.0, 0.0))
    assert reach(plan, Placement(), load_profile("icube")).reachable
    answer = reach(plan, Placement(), load_profile("shallow"))
    assert "depth 80.0 mm exceeds 60 mm" in str(answer.reasons[0])


def test_a_profile_elsewhere_is_chosen_by_the_path_of_its_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    add_profile(path)
    exercise = tmp_path / "exercise.yaml"
    exercise.write_text(EXERCISE.format(device=path), encoding="utf-8")
    assert device_of(read_exercise(exercise)).name == "mine"


def test_the_path_of_a_profile_is_taken_from_the_folder_of_the_exercise(tmp_path: Path) -> None:
    (tmp_path / "school").mkdir()
    add_profile(tmp_path / "school" / "mine.yaml")
    exercise = tmp_path / "school" / "exercise.yaml"
    exercise.write_text(EXERCISE.format(device="mine.yaml"), encoding="utf-8")
    assert device_of(read_exercise(exercise)).name == "mine"


def test_a_profile_that_does_not_exist_is_refused_with_the_names_that_do(tmp_path: Path) -> None:
    exercise = tmp_path / "exercise.yaml"
    exercise.write_text(EXERCISE.format(device="phantomx"), encoding="utf-8")
    with pytest.raises(ExerciseError, match=r"exercise.yaml: device: 'phantomx' .*icube"):
        read_exercise(exercise)


def test_an_unknown_field_in_a_profile_is_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(load_text() + "\ncolour: red\n", encoding="utf-8")
    with pytest.raises(ConfigurationError, match=r"mine.yaml: colour"):
        load_profile(path)
