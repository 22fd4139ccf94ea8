"""`acus.env`: Gymnasium's own checker passes, seeds decide, and the score is the program's."""

import inspect
import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import acus
import acus.env
from acus.env import ACTIONS, OBSERVED, REWARDS, Insertion
from app.compose.skill_scores import Resolved, risks_of
from app.compose.trial import Trials
from app.core import state_vector as sv
from app.core.bend import tip_beside, tips_beside
from app.core.errors import AcusError
from app.exercises.scene import device_of
from tests.layered import layered

STILL = np.array([0.0, 0.0, 0.0, -1.0], np.float32)


def made(**other):
    return Insertion(layered("first-insertion"), **other)


@pytest.fixture(scope="module")
def env():
    found = made(seconds=4.0)
    yield found
    found.close()


def insert(env, action):
    """Insert with one action; all that an episode gave."""
    given = [env.reset(seed=5)[0]]
    while True:
        seen, reward, ended, cut_off, info = env.step(action)
        given.append(np.append(seen, reward))
        if ended or cut_off:
            return given, info


def test_the_names_and_arguments_are_these():
    assert acus.env.__all__ == ["ACTIONS", "OBSERVED", "REWARDS", "Insertion"]
    assert str(inspect.signature(Insertion)) == (
        "(exercise: 'Exercise | str | Path' = 'first-insertion', *, action: 'str' = 'velocity',"
        " reward: 'str' = 'score', seconds: 'float | None' = None, tilted: 'float' = 0.15)"
        " -> 'None'"
    )
    assert (ACTIONS, REWARDS) == (("velocity", "force"), ("score", "score+distance"))
    assert len(OBSERVED) == 11


@pytest.mark.long("journey")
@pytest.mark.parametrize("action", ACTIONS)
@pytest.mark.parametrize("reward", REWARDS)
def test_gymnasiums_checker_finds_nothing_wrong(action, reward):
    env = made(action=action, reward=reward, seconds=1.0)
    check_env(env, skip_render_check=True)
    env.close()
    env.close()


@pytest.mark.long("journey")
def test_the_same_seed_and_actions_give_the_same_to_the_last_bit():
    random = np.random.default_rng(3)
    actions = random.uniform(-1.0, 0.89, (150, 4)).astype(np.float32)
    runs = []
    for _ in range(2):
        env, seen = made(reward="score+distance"), []
        for seed in (7, 8):
            seen.append(env.reset(seed=seed)[0].tobytes())
            for action in actions:
                state, reward, *_ = env.step(action)
                seen += [state.tobytes(), np.float64(reward).tobytes()]
        env.close()
        runs.append(seen)
    assert runs[0] == runs[1]
    assert runs[0][0] != runs[0][301]


@pytest.mark.long("journey")
def test_two_at_once_do_not_meet():
    alone, first, second = made(), made(), made(action="force")
    for one in (alone, first):
        one.reset(seed=1)
    second.reset(seed=2)
    push = np.array([0.2, -0.1, 0.5, -1.0], np.float32)
    for _ in range(60):
        second.step(push)
        seen = first.step(push)[0]
        assert seen.tobytes() == alone.step(push)[0].tobytes()
    second.close()
    assert first.step(push)[0].shape == (11,)
    for one in (alone, first):
        one.close()


def test_the_attempt_is_ended_by_the_hand_or_cut_off_and_scored_either_way(env):
    given, info = insert(env, np.array([0.0, 0.0, 1.0, -1.0], np.float32))
    assert len(given) == 201  # 4 s of 20 ms
    assert info["seconds"] == pytest.approx(4.0)
    env.reset(seed=5)
    *_, reward, ended, cut_off, info = env.step(np.array([0.0, 0.0, 0.0, 1.0], np.float32))
    assert (ended, cut_off) == (True, False)
    assert reward == pytest.approx((info["score"] or 0.0) / 100.0)
    with pytest.raises(gymnasium.error.ResetNeeded, match="call reset"):
        env.step(STILL)


def test_the_needle_goes_where_the_hand_does_at_its_speed(env):
    env.reset(seed=5)
    for _ in range(25):
        before = env.step(STILL)[0]
    for _ in range(100):
        seen = env.step(np.array([0.0, 0.0, 0.5, -1.0], np.float32))[0]
    gone = seen[OBSERVED.index("depth_m")] - before[OBSERVED.index("depth_m")]
    assert gone == pytest.approx(2.0 * 0.5 * 0.020, abs=0.003)  # seconds, share, m/s; skin dents


@pytest.mark.long("journey")
def test_without_guidance_it_turns_at_the_speed_of_the_hand():
    alone = layered("first-insertion").model_copy(update={"assistance": 0.0})
    env = Insertion(alone)
    env.reset(seed=5)
    for _ in range(25):
        before = env.step(STILL)[0]
    for _ in range(25):
        seen = env.step(np.array([-1.0, 0.0, 0.0, -1.0], np.float32))[0]
    lever = device_of(env.exercise).needle_length + 0.015
    assert seen[0] - before[0] == pytest.approx(-0.5 * 0.05 / lever, rel=0.25)
    assert abs(seen[1] - before[1]) < 0.01
    env.close()


@pytest.mark.long("journey")
def test_a_force_is_what_the_hand_presses_with_at_most_and_against_a_stop():
    env, most = made(action="force", seconds=30.0), 0.0
    env.reset(seed=5)
    for _ in range(400):
        env.step(np.array([0.0, 0.0, 0.6, -1.0], np.float32))  # 6 N
        most = max(most, float(env._loop.row[sv.PUSH]))
    assert most == pytest.approx(6.0, abs=0.05)
    assert env._loop.row[sv.PUSH] == pytest.approx(6.0, abs=0.05)
    env.close()


def test_shaping_is_what_it_came_nearer_and_no_more():
    env = made(reward="score+distance", seconds=3.0)
    env.reset(seed=5)
    begun, total, over = env._left, 0.0, False
    while not over:
        _, reward, ended, over, info = env.step(np.array([0.0, 0.0, 0.6, -1.0], np.float32))
        total += reward
    assert not ended
    assert total == pytest.approx(begun - env._left + (info["score"] or 0.0) / 100.0)
    assert env._left < begun - 0.2


@pytest.mark.long("journey")
def test_a_scripted_experts_attempt_is_scored_as_the_trials_do():
    """Steer by the hands that an expert had: the loop's own way, with the trials' score."""
    on = Resolved.of(layered("first-insertion"))
    trials = Trials(on.exercise, on.placed, risks_of(on.exercise), on.tissues)
    env = Insertion(layered("first-insertion"), tilted=0.0)
    env.reset(seed=1)
    aim, wish = on.placed.axis, -0.015
    for _ in range(200):  # align
        env._loop.hand(float(aim[0]), float(aim[1]), wish)
        env._loop.step()
    while wish < on.placed.length:
        wish += 0.020 * 0.015
        env._loop.hand(float(aim[0]), float(aim[1]), wish)
        env._loop.step()
    for _ in range(100):
        env._loop.step()
    own = env._trials.judged(env._loop)
    *_, reward, ended, _, info = env.step(np.array([0.0, 0.0, 0.0, 1.0], np.float32))
    assert ended
    assert reward == pytest.approx(info["score"] / 100.0)
    assert info["score"] == pytest.approx(own.score.total, abs=2.0)
    assert info["score"] > 60.0
    assert trials.score("expert", 1).score.total > 60.0


def test_one_bend_is_bent_as_many_are():
    random = np.random.default_rng(1)
    for _ in range(300):
        parts = [random.normal(0.0, size, 3) for size in (0.01, 0.1, 1.0)]
        length, depth = random.uniform(0.001, 0.1), random.uniform(-0.02, 0.15)
        many = tips_beside(np.concatenate([*parts, [length]])[None], np.array([depth]))[0]
        assert np.abs(tip_beside(*parts, length, depth) - many).max() < 1e-14


@pytest.mark.parametrize(
    ("other", "words"),
    [({"action": "torque"}, "'torque' is no choice here: velocity, force"),
     ({"reward": "dense"}, "'dense' is no choice here: score, score.distance")],
)  # fmt: skip
def test_an_unknown_choice_is_refused_with_those_that_there_are(other, words):
    with pytest.raises(AcusError, match=words):
        made(**other)


def test_an_action_that_is_no_number_is_refused(env):
    env.reset(seed=1)
    with pytest.raises(AcusError, match="finite"):
        env.step(np.array([np.nan, 0.0, 0.0, -1.0], np.float32))


@pytest.mark.long("journey")
def test_without_the_extra_its_name_is_told():
    code = "import sys; sys.modules['gymnasium'] = None; import acus, acus.env"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert "install the extra `env`" in said.stderr
