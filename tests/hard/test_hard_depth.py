"""A depth that nobody measures: what the hand can feel, and how fast the needle let go can be.

Through the whole trainer, which knows of the depth only what the two cameras of a rig can tell it:
a band that is hidden, one that jumps, a fix that ages. Truth is the plant's own.
"""

import numpy as np
import pytest
from hard.depth_rig import DepthRig
from hypothesis import given, settings
from hypothesis import strategies as st

from app.views.exercise.felt import felt, force_words

RIGS = ["thesis", "wide"]
DEPTHS = [-0.020, -0.015, 0.0, 0.03, 0.06, 0.09, 0.119]
HAND = 1e-3  # relative: the encoders' last count


def assert_force_is_bounded(rig, cap):
    force, within = rig.of("force"), rig.of("within")
    assert force[within].max() <= cap * (1.0 + HAND)
    assert rig.of("most").max() <= cap * (1.0 + 1e-9)
    assert (rig.of("shown") <= rig.of("most") + 1e-9).all()
    # What the bar says at most is never less than what is true.
    assert (force[within] <= rig.of("most")[within] * (1.0 + HAND) + 1e-4).all()


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", RIGS)
@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("cap", [5.0, 1.0])
def test_with_the_band_hidden_no_hand_feels_more_than_its_limit(name, depth, cap):
    rig = DepthRig(name, depth, hidden=True, force_cap=cap)
    rig.step(0.1)
    rig.begin()
    snapshot = rig.step(1.3)
    rig.close()
    assert rig.of("within").all()
    assert_force_is_bounded(rig, cap)
    assert rig.of("force", 100).min() > 0.2 * cap, "the guidance is there all the same"
    assert not snapshot.pose.measured
    assert (snapshot.pose.depth_least, snapshot.pose.depth_most) == (-0.03, 0.12)
    assert any("-30 to 120 mm" in message for message in snapshot.messages)
    said = felt(snapshot)
    assert said.at_most
    assert said.force >= rig.of("force", 1)[0]
    assert "at most" in force_words(said)


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=12)
@given(
    name=st.sampled_from(RIGS),
    depth=st.floats(-0.02, 0.12),
    jump=st.floats(-0.1, 0.1),
    cap=st.sampled_from([5.0, 1.0]),
    course=st.lists(
        st.tuples(st.sampled_from(["seen", "hidden", "jump"]), st.floats(0.05, 0.6)),
        min_size=2,
        max_size=4,
    ),
    to=st.floats(-0.02, 0.12),
    seed=st.integers(0, 99),
)
def test_whatever_the_cameras_show_the_force_stays_within_its_limit_while_the_truth_is_held(
    name, depth, jump, cap, course, to, seed
):
    rig = DepthRig(name, depth, force_cap=cap, seed=seed)
    rig.step(0.5)
    rig.begin()
    rig.step(1.0)
    rig.depth = to  # the hand goes there as fast as hands go
    rig.hold()
    for kind, seconds in course:
        rig.hidden, rig.jump = kind == "hidden", jump if kind == "jump" else 0.0
        rig.step(seconds)
    rig.close()
    assert_force_is_bounded(rig, cap)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("jump", [-0.1, -0.05, 0.05, 0.1])
def test_a_band_that_jumps_is_not_believed_until_ten_pictures_agree(jump):
    rig = DepthRig("wide", 0.02 if jump > 0.0 else 0.1)
    rig.step(0.7)
    rig.begin()
    assert rig.step(1.3).pose.measured
    rig.jump = jump
    snapshot = rig.step(0.2)
    assert not snapshot.pose.measured
    assert "jumped" in snapshot.pose.doubt
    assert (snapshot.pose.depth_least, snapshot.pose.depth_most) == (-0.03, 0.12)
    rig.jump = 0.0
    assert not rig.step(0.2).pose.measured
    snapshot = rig.step(0.6)
    assert snapshot.pose.measured
    assert snapshot.pose.doubt == ""
    rig.close()
    assert rig.of("within").all(), "nothing false was ever believed"
    assert_force_is_bounded(rig, 5.0)
    told = [event.message for event in rig.trainer.events.drain() if event.kind == "depth"]
    assert "jumped" in told[0]


@pytest.mark.long("statistics")
def test_a_measured_depth_gives_nearly_the_whole_force_and_says_how_well_it_is_known():
    rig = DepthRig("wide", 0.09, x=0.5)
    rig.step(0.7)
    rig.begin()
    snapshot = rig.step(1.5)
    rig.close()
    assert snapshot.pose.measured
    assert snapshot.pose.depth_most - snapshot.pose.depth_least < 0.03
    assert rig.of("within").all()
    assert rig.of("force", 200).min() > 4.2
    assert rig.of("most", 200).max() <= 5.0 + 1e-9


@pytest.mark.long("statistics")
def test_force_does_not_hum_with_the_age_of_the_pictures():
    rig = DepthRig("wide", 0.1, x=0.5)
    rig.step(0.7)
    rig.begin()
    rig.step(1.5)
    rig.close()
    force = rig.of("force", 500)
    assert np.ptp(force) < 0.03 * force.mean()


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", RIGS)
@pytest.mark.parametrize("depth", DEPTHS)
def test_a_needle_let_go_with_its_band_hidden_stays_within_the_bound(name, depth):
    rig = DepthRig(name, depth, hidden=True)
    rig.step(0.1)
    rig.begin()
    rig.step(1.3)
    rig.hold(False)
    rig.step(0.3)
    rig.close()
    assert rig.of("speed", 300).max() <= rig.profile.let_go.speed


@pytest.mark.long("statistics")
@pytest.mark.parametrize("jump", [-0.1, 0.1])
def test_a_needle_let_go_while_the_cameras_see_something_else_stays_within_the_bound(jump):
    rig = DepthRig("wide", 0.02 if jump > 0.0 else 0.1)
    rig.step(0.7)
    rig.begin()
    rig.step(1.3)
    rig.jump = jump
    rig.step(0.06)
    rig.hold(False)
    rig.step(0.3)
    rig.close()
    assert rig.of("speed", 300).max() <= rig.profile.let_go.speed
