"""The order of lines in `core.state_vector` means nothing: moved, a tick is the same or refused."""

import json
import os
import random
import subprocess
import sys

import pytest
from device import slot_order_rig as rig


@pytest.fixture(scope="module")
def outcomes():
    """Runs of many orders, from one child process: {label: outcome}."""
    rng, names = random.Random(4), rig.slots()
    orders = {"as it is": names}
    orders |= {f"shuffled {seed}": rig.shuffled(seed) for seed in range(4)}
    orders |= {f"moved {k}": rig.moved(*rng.sample(names, 2)) for k in range(8)}
    orders["a sum below the sums"] = rig.moved("POTENTIAL", "TRAINEE_PHASE")
    orders["a slot among the sums"] = rig.moved("TORQUE_LEFT", "GAIN_WORK")
    orders["the last sum first"] = rig.moved("AXIAL_FORCE", "TIME")
    orders["an input below"] = rig.moved("ENABLED", "DT")
    orders["a slot among the inputs"] = rig.moved("TIME", "ENABLED")
    orders["a vector torn apart"] = rig.moved("FORCE_X", "FELT_X")
    done = subprocess.run(
        [sys.executable, rig.__file__],
        input=json.dumps(list(orders.values())),
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return dict(zip(orders, json.loads(done.stdout), strict=True))


@pytest.mark.long("statistics")
def test_however_lines_are_shuffled_the_tick_stays_the_same_bit_for_bit(outcomes):
    for seed in range(4):
        assert outcomes[f"shuffled {seed}"] == outcomes["as it is"], seed


@pytest.mark.long("machine")
def test_a_line_moved_anywhere_changes_nothing_or_is_refused(outcomes):
    for label, outcome in outcomes.items():
        assert outcome.startswith("refused: ") or outcome == outcomes["as it is"], label
    for label in ("a sum below the sums", "the last sum first"):
        assert outcomes[label] == outcomes["as it is"], label


@pytest.mark.long("machine")
def test_what_would_change_its_meaning_is_refused_with_the_reason(outcomes):
    assert "below the last input" in outcomes["an input below"]
    assert "among the inputs" in outcomes["a slot among the inputs"]
    assert "the parts of a vector" in outcomes["a vector torn apart"]
