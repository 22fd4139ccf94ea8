"""Allocation lists: balanced, reproducible, and hidden until a student is enrolled."""

import hashlib
import hmac
import json
from itertools import accumulate

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import paths
from app.core.errors import ConfigurationError
from app.research import ResearchDesign, ResearchError, read_design
from app.research.allocation_list import (
    Draws,
    allocation_lists,
    commitment,
    open_hidden,
    open_place,
    seal,
    seed_of,
)
from app.session.station import StationKey

KEY = StationKey("station", b"k" * 32)
EXAMPLE = yaml.safe_load((paths.resources() / "research" / "design.yaml").read_text())


def design(**changes):
    return ResearchDesign.model_validate(EXAMPLE | changes)


def of_ratios(ratios, participants=40, **randomisation):
    arms = [
        {"name": f"arm-{k}", "exercise": "first-insertion", "ratio": ratio}
        for k, ratio in enumerate(ratios)
    ]
    return design(arms=arms, participants=participants, randomisation=randomisation)


RATIOS = st.lists(st.integers(1, 3), min_size=2, max_size=4)


@settings(max_examples=60, deadline=None)
@given(RATIOS, st.integers(1, 3), st.integers(0, 2**32))
def test_every_whole_block_has_each_arm_in_its_ratio(ratios, times, number):
    size = times * sum(ratios)
    one = of_ratios(ratios, method="blocks", block_sizes=(max(size, 2),))
    places = allocation_lists(one, seed_of(number))["all"]
    for begin in range(0, len(places) - size + 1, size):
        block = places[begin : begin + size]
        assert [block.count(k) for k in range(len(ratios))] == [times * r for r in ratios]


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32), st.randoms(use_true_random=False))
def test_arms_are_balanced_in_each_stratum_in_whatever_order_students_come(number, order):
    strata = {"year": ("first", "second"), "hand": ("left", "right")}
    one = of_ratios((1, 1), 60, method="blocks", block_sizes=(4, 6), strata=strata)
    sealed = seal(one, seed_of(number), KEY)
    labels = list(sealed["lists"])
    arms = {label: [] for label in labels}
    for _ in range(60):
        label = order.choice(labels)
        arms[label].append(open_place(sealed, label, len(arms[label]), KEY))
    for given_arms in arms.values():
        steps = accumulate((1 if arm else -1 for arm in given_arms), initial=0)
        assert max(abs(step) for step in steps) <= 3  # half of the largest block


def test_the_first_place_is_each_arm_as_often_as_the_other_over_many_seeds():
    one = of_ratios((1, 1), 4, method="blocks", block_sizes=(4,))
    firsts = [allocation_lists(one, seed_of(n))["all"][0] for n in range(2000)]
    assert abs(sum(firsts) - 1000) < 4 * (2000 * 0.25) ** 0.5


def test_all_six_orders_of_a_block_of_four_are_equally_likely():
    one = of_ratios((1, 1), 4, method="blocks", block_sizes=(4,))
    counts = {}
    for n in range(3000):
        block = tuple(allocation_lists(one, seed_of(n))["all"][:4])
        counts[block] = counts.get(block, 0) + 1
    assert len(counts) == 6
    chi_squared = sum((count - 500) ** 2 / 500 for count in counts.values())
    assert chi_squared < 20.5  # 0.1 % of the distribution with 5 degrees of freedom


def test_simple_randomisation_follows_the_ratios():
    one = of_ratios((2, 1), 3000, method="simple")
    places = allocation_lists(one, seed_of(1))["all"]
    assert abs(places.count(0) - 2000) < 4 * (3000 * 2 / 9) ** 0.5


def test_draws_are_the_hmac_of_a_counter_as_their_docstring_says():
    key = hmac.new(b"s" * 32, b"acus allocation\0x", hashlib.sha256).digest()
    first = hmac.new(key, (0).to_bytes(8, "big"), hashlib.sha256).digest()
    assert Draws(b"s" * 32, "x").below(1000) == int.from_bytes(first[:8], "big") % 1000


def test_the_sealed_file_is_alike_in_everything_but_random_bytes_whatever_the_list():
    one = of_ratios((1, 1), 12, method="simple")
    by_seed = [seal(one, seed_of(n), KEY) for n in range(2)]
    assert allocation_lists(one, seed_of(0)) != allocation_lists(one, seed_of(1))
    shapes = [[len(text) for text in sealed["lists"]["all"]] for sealed in by_seed]
    assert shapes[0] == shapes[1] == [2 * (12 + 2 + 16)] * 12  # nonce, place, tag, hexadecimal
    assert len({text for sealed in by_seed for text in sealed["lists"]["all"]}) == 24


def test_neither_seed_nor_arm_stands_in_the_sealed_file():
    one, seed = of_ratios((1, 1), 12, method="simple"), seed_of(4)
    text = json.dumps(seal(one, seed, KEY))
    assert seed.hex() not in text
    assert "arm-0" not in text


def test_the_same_seed_sealed_twice_gives_files_that_share_no_place():
    one = of_ratios((1, 1), 12, method="simple")
    first, second = (seal(one, seed_of(4), KEY) for _ in range(2))
    assert not set(first["lists"]["all"]) & set(second["lists"]["all"])
    assert first["commitment"] != second["commitment"]


def test_another_station_opens_no_place_and_a_renewed_key_does():
    sealed = seal(of_ratios((1, 1), 12, method="simple"), seed_of(4), KEY)
    with pytest.raises(ResearchError, match="another station"):
        open_place(sealed, "all", 0, StationKey("other", b"o" * 32))
    renewed = StationKey("station", b"n" * 32, (b"k" * 32,))
    assert open_place(sealed, "all", 0, renewed) == open_place(sealed, "all", 0, KEY)


def test_a_place_that_was_moved_to_another_slot_is_refused():
    sealed = seal(of_ratios((1, 1), 12, method="simple"), seed_of(4), KEY)
    places = sealed["lists"]["all"]
    places[0], places[1] = places[1], places[0]
    with pytest.raises(ResearchError, match="damaged"):
        open_place(sealed, "all", 0, KEY)


def test_seed_and_nonce_show_at_the_end_that_the_list_was_the_one_committed_to():
    one = of_ratios((1, 1), 12, method="simple")
    sealed = seal(one, seed_of(4), KEY)
    hidden = open_hidden(sealed, KEY)
    lists = allocation_lists(one, hidden.seed)
    text = json.dumps(lists, sort_keys=True, separators=(",", ":")).encode()
    assert hashlib.sha256(hidden.nonce + text).hexdigest() == sealed["commitment"]
    assert commitment({"all": lists["all"][::-1]}, hidden.nonce) != sealed["commitment"]


WRONG = {
    "two are called 'guided'": {"arms": [EXAMPLE["arms"][0]] * 2},
    "no student would be in it": {"arms": [EXAMPLE["arms"][0] | {"ratio": 0}, EXAMPLE["arms"][1]]},
    "compares two": {"arms": EXAMPLE["arms"][:1]},
    "5 does not fit arms of 1:1: take a multiple of 2": {
        "randomisation": {"method": "blocks", "block_sizes": [5]}
    },
    "simple randomisation has no blocks": {
        "randomisation": {"method": "simple", "block_sizes": [4]}
    },
    "needs two levels": {"randomisation": {"strata": {"year": ["first"]}}},
    "overlap": {"visits": [{"name": "a", "day": 0, "after": 3}, {"name": "b", "day": 2}]},
    "two have one name": {"visits": [{"name": "a", "day": 0}, {"name": "a", "day": 2}]},
    "fewer than the arms": {
        "participants": 2,
        "arms": [EXAMPLE["arms"][0] | {"ratio": 2}, EXAMPLE["arms"][1]],
        "randomisation": {},
    },
}


@pytest.mark.parametrize("reason", WRONG)
def test_a_design_that_cannot_be_is_refused_in_one_line(tmp_path, reason):
    path = tmp_path / "d.yaml"
    path.write_text(yaml.safe_dump(EXAMPLE | WRONG[reason]))
    with pytest.raises(ConfigurationError) as refused:
        read_design(path)
    assert reason in str(refused.value)
    assert "\n" not in str(refused.value)
