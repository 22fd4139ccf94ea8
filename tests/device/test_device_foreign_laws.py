"""Somebody else's force law: what it writes defeats nothing, and what could do harm is refused."""

import re
import time
from pathlib import Path

import numpy as np
import pytest
from device.device_rig import HAND_LIMIT, Rig, keep_what_was_sent
from device.law_rig import PROFILE
from extending_page import example
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.core.compiled import stage
from app.device.control import Loop, Table, laws
from app.device.control.kernel import fence
from app.device.control.law import KIND
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


@pytest.mark.long("machine")
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


@pytest.mark.long("machine")
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
    "ENABLED": ("    state[sv.ENABLED] = 2.0\n", "writes enabled, which it does not declare"),
    "state index": ("    state[100000] += 1.0\n", "index 100000 is out of bounds"),
    "computed": ("    p[int(dx)] = 1.0\n", "out of bounds"),
    "endless": (
        "    while state[sv.TIME] > 0.0:\n        pass\n",
        r"step\(\) in state 0 \(an ordinary state\) did not return within 1 s",
    ),
    "recursive": (
        "    deeper(state, p)\n",
        r"step\(\) in state 0 \(an ordinary state\) ended its process by SIGSEGV",
    ),
}
"""What the trial finds in a law, and the reason that it gives."""

DEEPER = """@njit
def deeper(state: FloatArray, p: FloatArray) -> None:
    if state[sv.TIME] > 0.0:
        deeper(state, p)
    state[sv.FORCE_X] += p[0]


@stage
"""
IMPORTED = "from app.core.compiled import njit, stage\n"
WITH_NJIT = ("from app.core.compiled import stage\n", IMPORTED)


@pytest.mark.long("machine")
@pytest.mark.parametrize("what", REFUSED)
def test_a_law_that_could_do_harm_is_refused_with_file_line_and_reason(own, what):
    added, reason = REFUSED[what]
    more = {"imports": WITH_NJIT, "kernel": ("@stage\n", DEEPER)} if what == "recursive" else {}
    save(own, added, **more)
    with pytest.raises(LawError, match=reason) as caught:
        laws.stages_of({"upright_spring": {}}, PROFILE)
    assert str(own / NAME) in str(caught.value)
    if what not in ("endless", "recursive"):
        line = int(re.search(r"upright_spring\.py, line (\d+): ", str(caught.value))[1])
        assert line == CODE.count("\n") + added.count("\n")
        assert "(trial, state " in str(caught.value)


@pytest.mark.long("machine")
def test_what_does_not_compile_is_refused_with_its_line_before_the_trial(own):
    save(own, "    open('x')\n")
    line = CODE.count("\n") + 1
    with pytest.raises(LawError, match=rf"global name 'open'.*upright_spring\.py\", line {line}:"):
        laws.stages_of({"upright_spring": {}}, PROFILE)


@pytest.mark.long("machine")
def test_a_law_that_allocates_in_a_tick_is_refused(own):
    imports = (
        "from app.core import state_vector",
        "import numpy as np\nfrom app.core import state_vector",
    )
    save(
        own,
        "    q = np.zeros(3)\n    q[int(10.0 * abs(dx)) % 3] = dz\n    p[0] += q[0] + q[1]\n",
        imports=imports,
    )
    with pytest.raises(LawError, match="allocates memory in a tick"):
        laws.stages_of({"upright_spring": {}}, PROFILE)


def test_a_law_that_declares_what_is_the_loops_own_is_refused(own):
    save(own, writes=('"writes": ("guide",', '"writes": ("guide", "enabled",'))
    with pytest.raises(
        LawError, match=r"line \d+: writes: enabled is the loop's own; give a tuple"
    ):
        laws.stages_of({"upright_spring": {}}, PROFILE)


@pytest.mark.long("machine")
def test_a_law_that_gives_a_shorter_array_than_it_was_tried_with_is_refused(own):
    """Which array it gives for values that no trial gave, nobody has seen."""
    short = (
        '    return packed(_AT, stiffness=values["stiffness"])\n',
        '    whole = packed(_AT, stiffness=values["stiffness"])\n'
        '    return whole[:1] if values["stiffness"] == 7.0 else whole\n',
    )
    save(own, short=short)
    laws.stages_of({"upright_spring": {}}, PROFILE)
    with pytest.raises(
        LawError, match=r"shape \(1,\) for these values; give .* 2 numbers at least"
    ):
        laws.stages_of({"upright_spring": {"stiffness": 7.0}}, PROFILE)


@pytest.mark.long("machine")
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
    with pytest.raises(LawError, match=r"upright_spring\.py.*step\(\) raises IndexError"):
        laws.stages_of({"upright_spring": {}}, PROFILE)
    assert "IndexError" in laws.refused()[own / NAME]


@pytest.mark.long("machine")
def test_the_verdict_of_a_trial_is_kept_until_the_file_changes(own):
    save(own)
    laws.stages_of({"upright_spring": {}}, PROFILE)
    began = time.perf_counter()
    verdict = KIND.trial.verdict(own / NAME)
    assert time.perf_counter() - began < 1.0
    assert (verdict["reason"], verdict["states"], verdict["shortest"]) == ("", 10_000, 2)
    assert verdict["seconds"] < 3.0
    save(own, "    dx += 1.0\n")
    assert KIND.trial.known(own / NAME) == {}


@pytest.mark.long("machine")
def test_laws_that_are_there_already_and_fail_are_listed_and_stay(own):
    save(own, "    state[100000] += 1.0\n")
    (own / "broken.py").write_text("def\n", encoding="utf-8")
    assert set(laws.refused()) == {own / "broken.py"}  # read, and not tried
    assert "index 100000" in KIND.fault(own / NAME)
    listed = laws.refused()
    assert set(listed) == {own / NAME, own / "broken.py"}
    assert "index 100000 is out of bounds" in listed[own / NAME]
    assert "cannot be read" in listed[own / "broken.py"]
    assert (own / NAME).is_file()
    laws.stages_of({"fixture": {}}, PROFILE)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", laws.law_names())
def test_every_law_of_the_program_passes_the_same_trial(name):
    law = laws.declaration(name)
    assert KIND.trial.verdict(law.path)["reason"] == ""


PATIENT = {
    "arms": "state[sv.ENABLED] = 1.0\n        state[sv.HEARTBEAT] = state[sv.TIME]",
    "lifts": "state[sv.FORCE_CAP] = 1e3\n        push(state, 1e6, 0.0, 0.0)",
    "nan": "push(state, nan, inf, -inf)",
    "outside": "p[int(1e7)] = 1.0",
    "far": "state[-100000] = 1.0",
    "raises": 'raise ValueError("enough")',
    "endless": "while p[_AT.free] == 0.0:\n            fence()",
}
"""What a law does once it has run a thousand ticks, which no trial shows: each on its number."""


@pytest.fixture(scope="module")
def patient(tmp_path_factory):
    """Folder of a law that does so, tried once for all tests."""
    folder = tmp_path_factory.mktemp("patient")
    added = ["    p[_AT.ticks] += 1.0\n"]
    for number, misdeed in enumerate(PATIENT.values()):
        added.append(f"    if p[_AT.ticks] > 1000.0 and p[_AT.misdeed] == {number}:\n")
        added.append(f"        {misdeed}\n")
    save(
        folder,
        "".join(added),
        numbers=("from math import cos", "from math import cos, inf, nan"),
        imports=(
            "from app.mechanisms.profile import DeviceProfile\n",
            "from app.device.control.kernel import fence\n"
            "from app.mechanisms.profile import DeviceProfile\n",
        ),
        memory=(
            "    last_l_out: int = 0\n",
            "    misdeed: int\n    last_l_out: int = 0\n    ticks: int = 0\n    free: int = 0\n",
        ),
        declared=(
            '    "parameters": {\n',
            '    "parameters": {\n        "misdeed": (0.0, "-", 0.0, 6.0, "which"),\n',
        ),
        given=(
            'stiffness=values["stiffness"])',
            'stiffness=values["stiffness"], misdeed=values["misdeed"])',
        ),
    )
    return folder


@pytest.fixture
def later(patient, monkeypatch):
    """Make the stage of a law that passes its trial and then does a misdeed."""
    monkeypatch.setenv("ACUS_LAWS", str(patient))
    numbers = {name: float(number) for number, name in enumerate(PATIENT)}
    return lambda misdeed: laws.stages_of(
        {"upright_spring": {"misdeed": numbers[misdeed]}}, PROFILE
    )[0]


@pytest.mark.long("machine")
@pytest.mark.parametrize("misdeed", ["arms", "lifts", "nan"])
def test_a_law_that_misbehaves_after_its_trial_keeps_and_lifts_nothing(later, misdeed):
    law = later(misdeed)
    with (rig := Rig(laws=[law], force=(0.5, 0.0, 0.0))).loop:
        rig.write(force_cap=1.0)
        rig.arm()
        rows = rig.loop.rows()
        assert np.linalg.norm(rows[:, sv.FELT], axis=1).max() <= 1.0 + 1e-9
        assert np.isfinite(rows[:, sv.TORQUE]).all()
        rig.write(enabled=0.0)
        rig.beating = False
        rig.step(2000)
        assert torques(rig, 1500) == 0.0


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("misdeed", "reason"),
    [
        ("outside", "'upright_spring' raises IndexError: index is out of bounds"),
        ("far", "'upright_spring' raises IndexError"),
        ("raises", "'upright_spring' raises ValueError: enough"),
        ("endless", "'upright_spring' does not return"),
    ],
)
def test_a_law_that_ends_the_loop_after_its_trial_ends_it_at_zero_and_is_named(
    later, misdeed, reason
):
    law, sent = later(misdeed), np.ones(4)
    around = [(name, writes_anything, np.zeros(1)) for name in ("keep", "give back")]
    table = Table.of([around[0], law, around[1]], [("motors", keep_what_was_sent, sent)])
    loop = Loop(table)
    loop.open()
    try:
        with pytest.raises(LoopError, match=f"force law or effect {reason}"):
            _until(lambda: loop.latest() is None)
        if misdeed != "endless":  # the thread goes on, and nothing leaves it: the board ends it
            _until(lambda: loop.rows()[-1, sv.DT] == 0.0)
            assert loop.rows()[-1, sv.TORQUE].tolist() == [0.0, 0.0]
            assert sent[:2].tolist() == [0.0, 0.0]
    finally:
        loop.close()
        law.parameters[-1] = 1.0


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
