"""Studies of contact and friction: exact within 1e-9, the controls fail, one law is calm."""

import pytest

from app.simulation import dry_friction
from app.simulation.effects import declaration
from app.studies import contact, friction
from app.studies.runner import find_study, run


@pytest.mark.long("statistics")
def test_the_exact_hold_is_within_1e_9_of_the_closed_form_from_1_to_500_000_n_per_m() -> None:
    result = run("contact", repeats=1)
    errors = [point.error for point in result.points if point.way == "exact hold"]
    assert len(errors) == len(contact.STIFFNESS)
    assert max(errors) <= 1e-9
    assert set(result.too_coarse()) == {way.name for way in result.study.ways} - {"exact hold"}


def test_explicit_euler_is_seen_to_fail_at_a_stiff_contact() -> None:
    result = run("contact", repeats=1)
    errors = {p.setting: p.error for p in result.points if p.way == "explicit Euler"}
    assert errors["1 N/m"] < 1e-3
    assert errors["1000 N/m"] > 0.1
    assert errors["50000 N/m"] > 1e6


@pytest.mark.long("statistics")
@pytest.mark.parametrize("share", [share for share in friction.SHARES if share <= 1.0])
def test_only_the_default_law_keeps_its_sign_in_a_still_hand(share: float) -> None:
    changes = {law: friction.still_hand(law, share / friction.COUNT)[0] for law in friction.LAWS}
    assert changes.pop(declaration("shaft_friction").model("")) <= 4
    assert min(changes.values()) > 500
    assert changes["sign of the speed"] == pytest.approx(1500, rel=0.1)


def test_the_study_compares_the_laws_that_the_effect_has_by_the_effects_own_functions() -> None:
    laws = set(declaration("shaft_friction").models) - {"inserted"}  # kikuuwe, per inserted length
    assert laws <= set(friction.LAWS)
    assert friction.kikuuwe is dry_friction.kikuuwe
    assert friction.dahl is dry_friction.dahl
    assert find_study("friction").default.startswith(declaration("shaft_friction").model(""))


def test_the_explicit_law_of_dahl_fails_and_is_named() -> None:
    result = run("friction", repeats=1)
    assert {(f.way, f.setting.split(",")[0]) for f in result.failures} >= {
        ("Dahl, explicit Euler", "fast")
    }
    assert all(point.error <= 2.0 for point in result.points)
