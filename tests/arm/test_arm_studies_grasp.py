"""The study of grasps: its reference, its other ways, and what its kept table says."""

import numpy as np
import pytest

from app.arm.hand import Contacts, force_closure, hull_margin, programme_margin, wrenches
from app.arm.hand.errors import GraspError
from app.arm.studies import grasp
from app.studies.kept import kept
from app.studies.runner import find_study


def contacts(seed: int) -> Contacts:
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(3, 3))
    return Contacts(points, -points + 0.2 * rng.normal(size=(3, 3)), 0.9)


@pytest.mark.parametrize("seed", range(8))
def test_every_plane_tried_finds_the_margin_of_the_hull(seed):
    rays = wrenches(contacts(seed), 4).rays
    assert grasp.every_facet(rays) == pytest.approx(hull_margin(rays), rel=1e-9, abs=1e-15)


def test_directions_and_single_programmes_never_say_less_than_there_is():
    rays = wrenches(grasp.held().contacts(0.5), 4).rays
    margin = hull_margin(rays)
    sampled = [grasp.sampled_margin(rays, count) for count in (100, 1000, 10_000)]
    assert sampled == sorted(sampled, reverse=True)
    assert min(sampled) >= margin
    assert grasp.shot_margin(rays) >= margin * (1.0 - 1e-9)
    assert programme_margin(rays) == pytest.approx(margin, rel=1e-6)


@pytest.mark.long("machine")
@pytest.mark.parametrize("number", range(5))
def test_every_setting_is_a_grasp_that_closes(number):
    setting = find_study("grasp").settings[number]
    case = grasp.STUDY.case(setting)
    assert case.error(hull_margin(case.data)) < 1e-9


def test_the_hand_holds_a_tool_that_lies_a_little_otherwise_and_says_when_it_does_not():
    planned = force_closure(grasp.held().contacts(0.5)).margin
    for pose in ({"aside": 1e-3}, {"turned": 0.02}, {"tilted": 0.02}):
        assert 0.5 * planned < force_closure(grasp.held(**pose).contacts(0.5)).margin < planned
    with pytest.raises(GraspError, match="closes to its limit without touching"):
        grasp.held(aside=0.012)


def test_the_kept_margins_are_those_of_the_program_and_grow_with_friction():
    sheet = next(s for s in kept("grasp").result.findings.sheets if s.name == "friction")
    table = np.array(sheet.rows, float)
    assert (table[0, 1:] == 0.0).all(), "without friction nothing closes on a cylinder"
    assert (np.diff(table, axis=0) >= 0.0).all()
    for mu, margin in table[:, :2]:
        found = force_closure(grasp.held().contacts(mu)).margin
        assert found == pytest.approx(margin, rel=1e-4, abs=1e-12)


def test_no_press_of_the_kept_table_overshoots():
    sheet = next(s for s in kept("grasp").result.findings.sheets if s.name == "press")
    column = sheet.columns.index("overshoot, share")
    assert [row[column] for row in sheet.rows] == [0.0] * len(sheet.rows)
