"""Machines are tried as laws are: the program's own pass, and what a foreign one does is named."""

import re

import pytest
import yaml
from extending_page import sections

from app.core.errors import ConfigurationError
from app.core.trial_watch import SECONDS
from app.mechanisms.profile import device, load_profile, profile_names
from app.mechanisms.profile.device import TRIAL


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", profile_names())
def test_every_machine_of_the_program_passes_the_trial(name):
    profile = load_profile(name)
    path = device._OWN / profile.kind / "machine.py"
    verdict = TRIAL.verdict(path, profile.model_dump_json())
    assert verdict["reason"] == ""
    assert 0.0 < verdict["seconds"] < SECONDS


@pytest.fixture
def gimbal(tmp_path, monkeypatch):
    """Folder of the machine of the page, and a profile of it."""
    code = re.findall(r"```python\n(.*?)```", sections()["How to add a machine"], re.DOTALL)
    folder = tmp_path / "mechanisms" / "gimbal"
    folder.mkdir(parents=True)
    for name, text in zip(("profile", "machine"), code, strict=True):
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    monkeypatch.setenv("ACUS_MECHANISMS", str(folder.parent))
    monkeypatch.setattr(device, "_passed", set())
    document = load_profile("icube").model_dump(mode="json", exclude_none=True)
    document |= {"kind": "gimbal", "name": "bench-gimbal"}
    rings = {"outer_inertia": 8e-4, "inner_inertia": 5e-4, "radius": 0.06}
    for section, names, new in (
        ("geometry", ("fulcrum", "needle_length"), {}),
        ("inertia", ("needle_mass", "needle_centre", "needle_inertia"), rings),
    ):
        values = {name: document[section][name] for name in names} | new
        document[section] = values | {"provenance": dict.fromkeys(values, "estimated")}
    path = tmp_path / "bench_gimbal.yaml"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    return folder, path


HARMFUL = {
    "arms": (
        "    write_pose(state, parameters, axis_of)\n",
        "    state[3 - 2] = 2.0\n",
        r"its stage 'pose' writes enabled, which it does not declare; it may write kinematics",
    ),
    "outside": (
        "    write_dynamics(state, parameters, axis_of, rates_of)\n",
        "    parameters[5000] = 1.0\n",
        r"its stage 'dynamics' raises IndexError: index 5000 is out of bounds",
    ),
    "raises": (
        "        self.radius = part.radius\n",
        "\n    def pose(self, q):\n        if q[0] != q[0]:\n            raise ValueError('no')\n"
        "        return super().pose(q)\n",
        r"pose\(\[nan, .*raises ValueError: no; say by its status that there is none",
    ),
}


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", HARMFUL)
def test_a_machine_that_could_do_harm_is_refused_with_file_stage_and_state(gimbal, name):
    folder, path = gimbal
    after, added, reason = HARMFUL[name]
    text = (folder / "machine.py").read_text()
    assert after in text
    (folder / "machine.py").write_text(text.replace(after, after + added))
    with pytest.raises(ConfigurationError, match=reason) as caught:
        load_profile(path).machine.holds((0.0, 0.0, -1.0))
    assert "device bench-gimbal: machine 'gimbal' cannot be used" in str(caught.value)
    assert str(folder / "machine.py") in str(caught.value)


@pytest.mark.long("statistics")
def test_the_machine_of_the_page_is_tried_once_whatever_needle_is_mounted(gimbal, monkeypatch):
    _, path = gimbal
    profile = load_profile(path)
    assert profile.machine.holds((0.0, 0.0, -1.0))

    def again(*_):
        raise AssertionError("tried again")

    monkeypatch.setattr(device, "_passed", set())
    monkeypatch.setattr("app.core.trial._run", again)
    assert profile.with_needle(0.18).machine.holds((0.0, 0.0, -1.0))


@pytest.mark.long("statistics")
def test_the_list_of_plugins_names_a_machine_that_its_trial_has_refused(gimbal):
    """By whatever profile; without that no trial is known, and it is imported only."""
    from app.compose.plugins import plugin_files

    folder, path = gimbal

    def listed(tried=True):
        (machine,) = [file for file in plugin_files(tried) if file.path == folder]
        return machine

    assert (listed().refused, listed(False).refused) == ("", "")
    after, added, reason = HARMFUL["arms"]
    text = (folder / "machine.py").read_text()
    (folder / "machine.py").write_text(text.replace(after, after + added))
    assert listed().refused == ""
    with pytest.raises(ConfigurationError):
        load_profile(path).machine.holds((0.0, 0.0, -1.0))
    for tried in (True, False):
        assert re.search(reason, listed(tried).refused)
        assert listed(tried).title == ""


@pytest.mark.long("statistics")
def test_the_list_of_plugins_tries_a_machine_with_the_profiles_that_are_known(gimbal, monkeypatch):
    from app.compose.plugins import plugin_files

    folder, path = gimbal
    monkeypatch.setattr(device, "_profiles", lambda: {"bench_gimbal": path})
    after, added, reason = HARMFUL["outside"]
    text = (folder / "machine.py").read_text()
    (folder / "machine.py").write_text(text.replace(after, after + added))
    (machine,) = [file for file in plugin_files(True) if file.path == folder]
    assert re.search(reason, machine.refused)
