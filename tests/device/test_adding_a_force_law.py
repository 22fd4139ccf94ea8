"""A force law is added just the way docs/extending.md says: the file on the page, no more."""

from pathlib import Path

import pytest
from device.law_rig import PROFILE, pose
from extending_page import example

from app.core import state_vector as sv
from app.device.control import laws
from app.device.errors import LawError


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's own folder of laws."""
    monkeypatch.setenv("ACUS_LAWS", str(tmp_path))
    return tmp_path


@pytest.fixture
def appended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(laws, "__path__", [*laws.__path__, str(tmp_path)])
    return tmp_path


def runs_as_the_page_says(folder: Path) -> None:
    name, code = example("How to add a force law")
    (folder / name).write_text(code, encoding="utf-8")
    assert "upright_spring" in laws.law_names()
    requests = {"fixture": {}, "upright_spring": {"stiffness": 3.0}}
    stage = laws.stages_of(requests, PROFILE)[1]
    state = pose((0.6, 0.0, -0.8), depth=0.05)
    stage[1](state, stage[2])
    # 3 N/rad times sin(tilt), across the needle; the hub stands at -x and is pushed towards +x.
    assert state[sv.FORCE] == pytest.approx([3.0 * 0.48, 0.0, 3.0 * 0.36])
    assert state[sv.POTENTIAL] == pytest.approx(3.0 * 0.15 * 0.2)
    bounds = laws.energy_bounds(requests, PROFILE)
    assert state[sv.POTENTIAL] <= bounds["upright_spring"]
    assert laws.energy_bound(requests, PROFILE) == pytest.approx(sum(bounds.values()))


def use(name: str) -> None:
    laws.stages_of({name: {}}, PROFILE)
    laws.energy_bound({name: {}}, PROFILE)


@pytest.mark.long("machine")
def test_a_law_in_the_users_own_folder_is_found_just_the_way_the_page_says(own: Path) -> None:
    runs_as_the_page_says(own)


@pytest.mark.long("machine")
def test_a_law_in_a_folder_appended_to_the_path_is_found_too(appended: Path) -> None:
    runs_as_the_page_says(appended)


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("x = 1\n", "has no DECLARATION"),
        ("DECLARATION = {'title': f()}\n", "is not a literal"),
        ("DECLARATION = {'title': ''}\n", "must have exactly the keys"),
        ("def\n", "cannot be read"),
        ("x = '\0'\n", "cannot be read"),
    ],
)
def test_a_broken_file_is_named(own: Path, code: str, message: str) -> None:
    (own / "broken.py").write_text(code, encoding="utf-8")
    with pytest.raises(LawError, match=rf"broken\.py.*{message}"):
        laws.declaration("broken")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"l_out"', '"l_outer"', "'l_outer' is not a slot"),
        ('"potential",\n', '"free",\n', "energy is .*one of potential, dissipative, active"),
        ("def energy_bound", "def bound", r"has no function energy_bound\(\)"),
        ('(5.0, "N/rad"', '([5.0], "N/rad"', "parameter 'stiffness' is"),
        ('(5.0, "N/rad"', '("fixture.hardness", "N/rad"', "'fixture.hardness' .* no such field"),
        ("@stage\n", "", "step is not compiled"),
        ("from math import cos", "from maths import cos", "No module named 'maths'"),
        ("return longest_lever", "return -longest_lever", "energy_bound is -.* J"),
    ],
)
def test_what_is_wrong_in_a_law_is_named(own: Path, old: str, new: str, message: str) -> None:
    name, code = example("How to add a force law")
    assert old in code
    (own / name).write_text(code.replace(old, new), encoding="utf-8")
    with pytest.raises(LawError, match=message) as caught:
        use("upright_spring")
    assert "upright_spring.py" in str(caught.value)


def test_a_law_with_the_name_of_one_of_the_programs_own_is_refused_and_takes_nothing(
    own: Path,
) -> None:
    (own / "fixture.py").write_text("", encoding="utf-8")
    assert laws.is_own(laws.declaration("fixture"))
    assert "'fixture' is a name of the program's own" in laws.refused()[own / "fixture.py"]


def test_unknown_laws_and_parameters_are_refused_with_the_known_ones() -> None:
    for requests, message in (
        ({"magnet": {}}, "no force law 'magnet'; there are .*fixture"),
        ({"fixture": {"colour": 1.0}}, "no parameter 'colour'; it has damping, dial_rate"),
        ({"fixture": {"limit": 7.0}}, "limit is 7.0; give 0 to 5 N"),
        ({"fixture": {"limit": float("nan")}}, "limit is nan"),
        ({"fixture": {"limit": True}}, "limit is True"),
    ):
        with pytest.raises(LawError, match=message):
            laws.stages_of(requests, PROFILE)
