"""The study of the arm's inverse kinematics: what it must find, and what it leaves out by name."""

import importlib.util
import sys

import numpy as np
import pytest

from app.arm.mechanics import load_arm
from app.arm.studies import arm_ik
from app.studies.errors import StudyError
from app.studies.findings import Survey
from app.studies.runner import examine

ARM = load_arm()
TINY = arm_ik.Size(random=300, near=20, slow=10, printed=10)
needs_pinocchio = pytest.mark.skipif(
    importlib.util.find_spec("pinocchio") is None, reason="needs the extra arm"
)


@pytest.mark.long("statistics")
@needs_pinocchio
def test_the_closed_forms_meet_every_pose_and_the_printed_signs_none():
    found = arm_ik.measured(TINY)
    assert found.passed
    rows = {row[0]: row for sheet in found.sheets if sheet.name == "random" for row in sheet.rows}
    assert rows["closed form, θ3 = 0, all eight"][2] == 100.0
    assert rows["closed form, arm angle, within limits"][3] == 100.0
    assert rows["least squares, one start"][2] < 90.0
    printed = {row[0]: row[1:] for row in found.sheets[-1].rows}
    assert printed == {"as printed": (10, 16, 0, 0), "with errata D3 to D5": (10, 8, 8, 8)}


@pytest.mark.long("statistics")
@needs_pinocchio
def test_its_pictures_are_drawn():
    figure_module = pytest.importorskip("matplotlib.figure")
    for picture in arm_ik.measured(arm_ik.Size(20, 5, 5, 2)).figures:
        figure = figure_module.Figure(picture.size)
        picture.draw(figure)
        assert figure.axes


@pytest.mark.long("statistics")
@needs_pinocchio
def test_without_eaik_the_study_names_it_as_left_out(monkeypatch):
    monkeypatch.setitem(sys.modules, "eaik.IK_DH", None)
    found = arm_ik.measured(arm_ik.Size(20, 5, 5, 2))
    assert any("EAIK is left out: EAIK is not installed" in line for line in found.lines)


def test_without_pinocchio_the_study_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(StudyError, match=r"install the extra `arm`: make extra NAME=arm"):
        examine("arm_ik", quick=True)


@pytest.mark.parametrize("kind", arm_ik.KINDS)
def test_postures_near_singular_are_as_far_from_it_as_they_say(kind):
    q = arm_ik.near_singular(ARM, kind, 1e-3, 20)
    if kind == "first axis":
        away = arm_ik.posed(ARM, q).position - [0.0, 0.0, ARM.pedestal]
        sine = np.hypot(away[:, 0], away[:, 1]) / np.linalg.norm(away, axis=1)
    else:
        sine = np.abs(np.sin(q[:, {"shoulder": 1, "elbow": 3, "wrist": 5}[kind]]))
    assert sine == pytest.approx(np.sin(1e-3), rel=1e-9)


def test_a_quick_survey_measures_less_and_one_without_measures_all():
    said = []

    def full(progress=None):
        said.append("full")
        return arm_ik.Findings(())

    def short(progress=None):
        said.append("short")
        return arm_ik.Findings(())

    examine(Survey(measure=full, quick=short), quick=True)
    examine(Survey(measure=full, quick=short))
    examine(Survey(measure=full), quick=True)
    assert said == ["short", "full", "full"]
