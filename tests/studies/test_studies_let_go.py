"""Letting go under three rules: the force to be had, and what the run has beyond its twin."""

import numpy as np
import pytest

from app.mechanisms.profile import load_profile
from app.studies import let_go
from app.studies.releasing.device import Rule, poses, release, upright

ALIGNING = -0.020


@pytest.mark.parametrize(
    ("name", "before", "now"), [("icube", 1.32, 2.74), ("haply-2diy", 0.10, 0.62)]
)
def test_where_students_align_the_profiles_limit_leaves_more_than_the_fixed_speed(
    name, before, now
):
    profile = load_profile(name)
    felt = {
        rule: np.median(
            [release(profile, pose, rule, runs=1).felt for pose in upright(ALIGNING, 8)]
        )
        for rule in (Rule.BEFORE, Rule.PROFILE)
    }
    assert felt[Rule.BEFORE] == pytest.approx(before, rel=0.15)
    assert felt[Rule.PROFILE] == pytest.approx(now, rel=0.15)


@pytest.mark.parametrize("name", let_go.PROFILES)
@pytest.mark.parametrize("factor", [0.7, 1.3])
def test_the_torque_limit_alone_lets_run_what_the_profiles_limit_holds(name, factor):
    profile = load_profile(name)
    limit = profile.let_go
    for pose in poses(profile, 0.0, 2, 2):
        loose = release(profile, pose, Rule.TORQUE_ALONE, factor)
        held = release(profile, pose, Rule.PROFILE, factor)
        assert loose.speed > 2.0 * limit.speed
        assert held.speed <= limit.speed
        assert held.energy <= 1e-3 * limit.energy_mj
        assert held.noticed is not None


def test_without_a_fix_the_icube_holds_with_no_more_than_its_longest_lever_allows():
    profile = load_profile("icube")
    for pose in upright(ALIGNING, 4):
        assert release(profile, pose, Rule.PROFILE, measured=False, runs=1).pull <= 1.85


@pytest.mark.long("statistics")
def test_the_study_has_its_tables_pictures_and_what_they_say(monkeypatch):
    for name, value in (("POSES", 1), ("AROUND", 2), ("DEPTHS_MM", (0.0,)), ("FACTORS", (1.0,))):
        monkeypatch.setattr(let_go, name, value)
    monkeypatch.setattr(let_go, "_ENERGIES_MJ", (8.0,))
    findings = let_go.STUDY.measure(None)
    assert [sheet.name for sheet in findings.sheets] == ["force", "released", "aligning", "choice"]
    assert [figure.name for figure in findings.figures] == ["force", "released"]
    assert len(findings.lines) == len(let_go.PROFILES)
