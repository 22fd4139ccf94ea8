"""Somebody else's force law: what it writes defeats nothing, and what could do harm is refused."""

import re
import time
from pathlib import Path

import numpy as np
import pytest
from device.device_rig import HAND_LIMIT, Rig
from device.law_rig import PROFILE
from extending_page import example
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.core.compiled import stage
from app.device.control import Loop, Table, laws
from app.device.control.kernel import fence
from app.device.control.shared import TickHistory
from app.device.errors import LawError, LoopError

NAME, CODE = example("How to add a force law")
LAST = "    p[_AT.last_l_out] = state[sv.L_OUT]\n"


@stage
def writes_anything(state, p):
    """Write p[2k + 1] to slot p[2k], and push."""
    for k in range((len(p) - 1) // 2):
        state[int(p[2 * k])] = p[2 * k + 1]
    state[sv.FORCE_X] += 3.0


@stage
def keeps_alive(state, p):
    """Say that the window is alive, and push."""
    state[sv.HEARTBEAT] = state[sv.TIME]
    state[sv.FORCE_X] += 3.0


def writing(*pairs):
    return ("law", writes_anything, np.array([*(float(v) for pair in pairs for v in pair), 0.0]))


def torques(rig, ticks):
    return np.abs(rig.loop.rows()[-ticks:, sv.TORQUE]).max()


def test_a_law_that_writes_enabled_keeps_no_torque_on():
    with (rig := Rig(laws=[writing((sv.ENABLED, 1.0))])).loop:
        rig.arm()
        assert torques(rig, 10) > 0.01
        rig.write(enabled=0.0)
        rig.step(2000)
        assert torques(rig, 1990) == 0.0


def test_a_law_that_writes_the_force_cap_lifts_no_limit():
    law = writing((sv.FORCE_CAP, 100.0), (sv.HOMED, 1.0))
    with (rig := Rig(laws=[law], force=(4.0, 0.0, 0.0))).loop:
        rig.write(force_cap=1.0)
        rig.arm()
        assert 0.0 < rig.felt <= 1.0 + 1e-9


def test_a_law_that_writes_the_heartbeat_keeps_nothing_alive():
    with (rig := Rig(laws=[("law", keeps_alive, np.zeros(1))])).loop:
        rig.arm()
        assert torques(rig, 10) > 0.01
        rig.beating = False
        rig.step(1500)
        assert torques(rig, 100) == 0.0


@settings(derandomize=True, deadline=None, max_examples=60)
@given(
    st.lists(
        st.tuples(
            st.integers(0, sv.SLOTS - 1).filter(lambda k: k not in (*sv.SUMS, *sv.SCENE)),
            st.floats(allow_nan=True, allow_infinity=True),
        ),
        max_size=8,
    )
)
def test_whatever_a_law_writes_beside_its_sums_the_tick_is_the_same(pairs):
    rows = []
    for law in (writing(*pairs), writing()):
        with (rig := Rig(laws=[law], force=(0.5, 0.0, 0.0))).loop:
            rig.write(force_cap=1.0)
            rig.arm()
            rig.write(enabled=0.0)
            rig.step(20)
            rows.append(rig.loop.rows()[:, :])
    assert np.array_equal(rows[0], rows[1], equal_nan=True)


@settings(derandomize=True, deadline=None, max_examples=60)
@given(st.lists(st.tuples(st.sampled_from(sv.SUMS), st.floats()), max_size=8))
def test_whatever_a_law_writes_into_its_sums_the_force_stays_within_the_cap(pairs):
    with (rig := Rig(laws=[writing(*pairs)])).loop:
        rig.write(force_cap=1.0)
        rig.arm()
        felt = np.linalg.norm(rig.loop.rows()[:, sv.FELT], axis=1)
        assert felt.max() <= 1.0 + 1e-9 <= HAND_LIMIT
        assert np.isfinite(rig.loop.rows()[:, sv.TORQUE]).all()


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's own folder of laws."""
    monkeypatch.setenv("ACUS_LAWS", str(tmp_path))
    return tmp_path


def save(folder, added="", **replaced):
    code = CODE.replace(LAST, LAST + added)
    for old, new in replaced.values():
        assert old in code
        code = code.replace(old, new)
    (folder / NAME).write_text(code, encoding="utf-8")


REFUSED = {
    "ENABLED": ("    state[sv.ENABLED] = 1.0\n", "it writes enabled, which it does not declare"),
    "FORCE_CAP": ("    state[sv.FORCE_CAP] = 100.0\n", "it writes force_cap, which"),
    "added to": ("    state[sv.TIME] += 1.0\n", "it writes time, which"),
    "state index": ("    state[100000] += 1.0\n", r"is 100000; the state has \d+ slots"),
    "negative": ("    p[-100] = 1.0\n", r"the index of p\[-100\] is -100, below 0"),
    "computed": ("    p[int(dx)] = 1.0\n", "neither a constant nor counted over constants"),
    "taken": ("    k = 7\n    p[k] = 1.0\n", "neither a constant nor counted over constants"),
    "slice": ("    p[0:1000] = 1.0\n", "a slice of an array is not seen through"),
    "alias": ("    q = p\n    q[5] = 1.0\n", "the array p may only be indexed or handed"),
    "attribute": ("    n = p.ctypes.data\n", "p.ctypes.data is not a constant of a module"),
    "endless": ("    while True:\n        pass\n", "a while loop may never end"),
    "long": ("    for k in range(10**9):\n        dx += k\n", "may be long or endless"),
    "many": (
        "    for i in range(1000):\n        for k in range(1000):\n            dx += k\n",
        "its loops run 1000000 rounds in a tick, 10000 at most",
    ),
    "by a number": ("    for k in range(int(dx)):\n        dz += k\n", "may be long or endless"),
    "counter": ("    for i in range(200):\n        state[i] = 0.0\n", r"the state has \d+ slots"),
    "counted": ("    for i in range(20):\n        state[i] = 0.0\n", "which it does not declare"),
    "allocates": ("    q = np.zeros(3)\n", r"np.zeros\(\) is not one of the functions"),
    "opens": ("    open('x')\n", r"open\(\) is not one of the functions"),
    "raises": ("    raise ValueError\n", "an error would end the loop"),
    "recursive": ("    step(state, p)\n", "step calls itself"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_law_that_could_do_harm_is_refused_with_file_line_and_reason(own, what):
    added, reason = REFUSED[what]
    save(own, added)
    with pytest.raises(LawError, match=reason) as caught:
        laws.stages_of({"upright_spring": {}}, PROFILE)
    line = int(re.search(r"upright_spring\.py, line (\d+): ", str(caught.value))[1])
    last = CODE.count("\n") + added.count("\n")
    assert last - added.count("\n") < line <= last or what in ("many", "recursive")


def test_a_law_that_declares_what_is_the_loops_own_is_refused(own):
    save(own, writes=('"writes": ("guide",', '"writes": ("guide", "enabled",'))
    with pytest.raises(LawError, match=r"line \d+: it declares to write enabled, which"):
        laws.stages_of({"upright_spring": {}}, PROFILE)


def test_a_law_that_uses_more_parameters_than_it_has_is_refused(own):
    save(own, "    p[300] = 1.0\n")
    with pytest.raises(LawError, match=r"uses 301 parameters|index"):
        laws.stages_of({"upright_spring": {}}, PROFILE)


def test_an_index_that_only_a_function_of_the_program_sees_is_found_by_the_trial(own):
    save(
        own,
        "    gravity_far_away(state, p)\n",
        imports=(
            "from app.mechanisms.profile import DeviceProfile\n",
            "from app.core.compiled import njit\n"
            "from app.mechanisms.pantograph.dynamics import axial_load_kernel\n"
            "from app.mechanisms.profile import DeviceProfile\n",
        ),
        kernel=(
            "@stage\n",
            "@njit\ndef gravity_far_away(state: FloatArray, q: FloatArray) -> None:\n"
            "    state[sv.GUIDE_X] += axial_load_kernel(0.1, 0.1, 0.0, 0.1, 0.05, q, 5000)\n\n\n"
            "@stage\n",
        ),
    )
    with pytest.raises(LawError, match=r"upright_spring\.py: in the trial, state 0: IndexError"):
        laws.stages_of({"upright_spring": {}}, PROFILE)
    assert "IndexError" in laws.refused()[own / NAME]


def test_the_verdict_of_a_trial_is_kept_until_the_file_changes(own):
    save(own)
    laws.stages_of({"upright_spring": {}}, PROFILE)
    began = time.perf_counter()
    from app.device.control import law_check

    verdict = law_check.trial(own / NAME)
    assert time.perf_counter() - began < 1.0
    assert (verdict["reason"], verdict["states"]) == ("", 10_000)
    save(own, "    dx += 1.0\n")
    assert law_check.known(own / NAME) == {}


def test_laws_that_are_there_already_and_fail_are_listed_and_stay(own):
    save(own, "    while True:\n        pass\n")
    (own / "broken.py").write_text("def\n", encoding="utf-8")
    listed = laws.refused()
    assert set(listed) == {own / NAME, own / "broken.py"}
    assert "a while loop may never end" in listed[own / NAME]
    assert "cannot be read" in listed[own / "broken.py"]
    assert (own / NAME).is_file()
    laws.stages_of({"fixture": {}}, PROFILE)


def test_every_law_of_the_program_passes_the_same_check():
    from app.device.control import law_check

    for name in laws.law_names():
        law = laws.declaration(name)
        if laws.is_own(law):
            found = law_check.check_text(law)
            assert {sv.INDEX[slot] for slot in law.writes} == found.writes, name


@stage
def sticks(state, p):
    """Never return once p[0] is set, until p[1] is."""
    while p[0] != 0.0 and p[1] == 0.0:
        fence()


def test_a_tick_that_does_not_return_is_named_and_closing_waits_for_nothing():
    p = np.zeros(2)
    around = [(name, writes_anything, np.zeros(1)) for name in ("keep", "give back")]
    loop = Loop(Table.of([around[0], ("sticky", sticks, p), around[1]]))
    loop.open()
    try:
        _until(lambda: loop.latest().tick > 5)
        p[0] = 1.0
        began = time.monotonic()
        with pytest.raises(LoopError, match="force law or effect 'sticky' does not return"):
            _until(lambda: loop.latest() is None)
        assert time.monotonic() - began < 30.0
        began = time.monotonic()
        loop.close()
        assert time.monotonic() - began < 4.0  # five seconds would be a thread that is waited for
        with pytest.raises(LoopError, match="'sticky' does not return"):
            loop.open()
        assert isinstance(loop.rows(), np.ndarray)
        assert loop.latest().tick > 5
        assert isinstance(loop._history, TickHistory)
    finally:
        p[1] = 1.0


def _until(done, patience=60.0):
    end = time.monotonic() + patience
    while not done():
        assert time.monotonic() < end
        time.sleep(0.01)
