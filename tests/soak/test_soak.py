"""Three minutes of the soak; `make soak` plays the whole hour."""

import pytest

from tests.soak.soak import Found, layered_effects, soak


@pytest.fixture(scope="module")
def found() -> Found:
    return soak(180.0, seed=2, idle_minutes=1.0)


@pytest.mark.long("machine")
@pytest.mark.promise("CONTRIBUTING.md: nothing broken, no force beyond 5 N, no memory grown")
def test_nothing_is_ever_no_number_and_no_force_is_beyond_five_newton(found):
    assert found.broken == 0
    assert 1.0 < found.most_force <= 5.0 + 1e-9
    assert found.under_force > 0.2, "the hand did feel something"


@pytest.mark.long("machine")
def test_every_effect_that_ships_was_played(found):
    assert {name.split()[0] for name in found.effects} == set(layered_effects())


@pytest.mark.long("machine")
def test_no_memory_grows_and_rest_leaves_no_subnormal_numbers(found):
    assert found.grown < 16 << 20
    assert found.subnormal == 0
