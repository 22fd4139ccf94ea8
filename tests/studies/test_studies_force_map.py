"""The study of the force map: both laws against MuJoCo's statics."""

import sys

import numpy as np
import pytest

from app.mechanisms.pantograph import felt_force, needle_at
from app.mechanisms.profile import load_profile
from app.simulation.errors import SimulationError
from app.studies.force_map import STUDY, felt, pose, tool_force
from app.studies.runner import run

PROFILE = load_profile("icube")


@pytest.mark.parametrize("sideways", [False, True])
def test_the_wanted_force_is_2_n_across_the_needle(sideways):
    for tilt in (0.0, 0.4, 0.78):
        where = pose(PROFILE, tilt, sideways)
        assert np.linalg.norm(where.force) == pytest.approx(2.0)
        assert np.dot(where.force, where.lever[:3]) == pytest.approx(0.0, abs=1e-15)
        assert -where.lever[2] == pytest.approx(np.cos(tilt))


def test_our_own_statics_say_the_same_as_the_study():
    where = pose(PROFILE, np.deg2rad(39.0), False)
    geometry = PROFILE.pantograph
    p3 = geometry.fulcrum[:2] + np.array([0.0, geometry.fulcrum[2] * np.tan(np.deg2rad(39.0))])
    needle = needle_at(geometry, p3)
    assert felt_force(needle, tool_force(where, False)) == pytest.approx(where.force, abs=1e-14)
    twice = np.linalg.norm(felt_force(needle, tool_force(where, True)))
    assert twice == pytest.approx(2.0 / np.cos(np.deg2rad(39.0)) ** 2)


def test_mujoco_feels_what_is_wanted_and_twice_that_of_the_printed_law():
    pytest.importorskip("mujoco")
    where = pose(PROFILE, np.deg2rad(45.0), False)
    assert felt(where, tool_force(where, False)) == pytest.approx(where.force, abs=1e-4)
    assert np.linalg.norm(felt(where, tool_force(where, True))) == pytest.approx(4.0, abs=1e-3)


@pytest.mark.long("statistics")
def test_the_study_condemns_the_printed_law_only():
    pytest.importorskip("mujoco")
    result = run("force_map", repeats=1)
    assert result.failures == ()
    assert result.too_coarse() == ("printed 4.12",)
    assert result.findings is not None
    assert "4.000 N for 2 N" in result.findings.lines[0]


def test_without_mujoco_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(SimulationError, match="physics"):
        run(STUDY, repeats=1)
