"""Device profiles: strict, with the origin of every number."""

import math

import pytest
import yaml

from app.core import paths
from app.core.errors import ConfigurationError
from app.mechanisms.profile import (
    LET_GO_UNSTATED,
    Axis,
    Provenance,
    Section,
    load_profile,
    parse_profile,
    profile_names,
)


@pytest.fixture
def document():
    path = paths.resources() / "devices" / "icube.yaml"
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def written(tmp_path, document):
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    return path


def test_every_shipped_profile_loads():
    for name in profile_names():
        assert load_profile(name).name == name


def test_the_robots_numbers_are_those_of_the_thesis():
    profile = load_profile("icube")
    assert profile.pantograph.links == (0.100, 0.165, 0.085)
    assert profile.fulcrum.tolist() == [0.0, 0.16056, 0.09]
    assert profile.tilt_limit == pytest.approx(math.radians(39.0))
    assert profile.with_joint("old").tilt_limit_deg == 45.0
    assert profile.renders == (Axis.LATERAL,)
    assert profile.rate_hz == 1000.0
    assert profile.inertia.reflected_rotor == pytest.approx(6.99e-4)


def test_every_value_says_where_it_comes_from():
    profile = load_profile("icube")
    for name in type(profile).model_fields:
        section = getattr(profile, name)
        if isinstance(section, Section):
            values = set(type(section).model_fields) - {"provenance"}
            assert set(section.provenance) == values
    assert profile.inertia.provenance["distal_mass"] is Provenance.ESTIMATED


def test_a_value_without_its_origin_is_refused(tmp_path, document):
    del document["geometry"]["provenance"]["distal"]
    with pytest.raises(ConfigurationError, match=r"geometry.*no provenance for distal"):
        load_profile(written(tmp_path, document))


def test_a_profile_that_states_no_let_go_limit_keeps_a_quarter_of_a_metre_per_second(
    tmp_path, document
):
    del document["limits"]["let_go"]
    del document["limits"]["provenance"]["let_go"]
    profile = load_profile(written(tmp_path, document))
    assert profile.limits.let_go is None
    assert profile.let_go == LET_GO_UNSTATED
    assert profile.let_go.speed == 0.25


def test_a_let_go_limit_needs_its_origin(tmp_path, document):
    del document["limits"]["provenance"]["let_go"]
    with pytest.raises(ConfigurationError, match="no provenance for let_go"):
        load_profile(written(tmp_path, document))


def test_an_origin_of_a_let_go_limit_that_is_not_stated_is_refused(tmp_path, document):
    del document["limits"]["let_go"]
    with pytest.raises(ConfigurationError, match="provenance of let_go"):
        load_profile(written(tmp_path, document))


def test_an_origin_without_a_value_is_refused(tmp_path, document):
    document["limits"]["provenance"]["power"] = "measured"
    with pytest.raises(ConfigurationError, match="provenance of power"):
        load_profile(written(tmp_path, document))


@pytest.mark.parametrize(
    ("section", "key", "value", "message"),
    [
        ("geometry", "proximal", -0.1, "greater than 0"),
        ("geometry", "fulcrum", [0.0, 0.16, 0.0], "greater than 0"),
        ("workspace", "joint", "newest", "not one of new, old"),
        ("workspace", "depth_min", 0.5, "must be below depth_max"),
        ("encoder", "counts_per_turn", 0, "greater than 0"),
        ("limits", "hand_force", float("nan"), "finite"),
        ("loop", "renders", ["sideways"], "lateral"),
        ("limits", "let_go", {"energy_mj": 10.1, "speed": 0.4}, "less than or equal to 10"),
        ("limits", "let_go", {"energy_mj": 5.0, "speed": 0.51}, r"less than or equal to 0\.5"),
        ("limits", "let_go", {"energy_mj": 0.0, "speed": 0.4}, "greater than 0"),
        ("limits", "let_go", {"speed": 0.4}, "energy_mj"),
        ("geometry", "proximal", 100.0, "less than or equal to 2"),  # millimetres
        ("inertia", "distal_mass", 60.0, "less than or equal to 20"),  # grams
        ("limits", "joint_torque", 600.0, "less than or equal to 20"),
        ("encoder", "counts_per_turn", 10**12, "less than or equal to 100000000"),
        ("encoder", "home_offsets", [194.95, -10.86], "less than or equal to 12.6"),  # degrees
        ("mounting", "gravity", [0.0, 0.0, -981.0], "greater than or equal to -25"),
        ("geometry", "fulcrum", [0.0, 0.3, 0.09], r"0.303 m from the left.*0.065 to 0.265 m"),
        ("geometry", "fulcrum", [0.24, 0.1, 0.09], r"from the left motor axis"),
        ("geometry", "fulcrum", [0.0, 0.03, 0.09], r"0\.05202 m from the left.*from 0.065"),
        ("geometry", "fulcrum", [0.0, -0.16, 0.09], "in front of the motors, y > 0"),
        ("geometry", "needle_length", 0.08, "must be greater than the lever.*0.09 m"),
        ("workspace", "depth_max", 0.25, r"depth_max 0.25 m must be below.*0.2 m"),
        ("inertia", "needle_centre", 0.3, r"needle_centre 0.3 m must lie on the needle"),
    ],
)
def test_a_wrong_value_is_refused_by_name(tmp_path, document, section, key, value, message):
    document[section][key] = value
    with pytest.raises(ConfigurationError, match=message) as caught:
        load_profile(written(tmp_path, document))
    assert "mine.yaml" in str(caught.value)
    assert section in str(caught.value)


def test_a_fulcrum_behind_the_elbows_is_refused(tmp_path, document):
    document["geometry"] |= {"proximal": 0.165, "distal": 0.1, "fulcrum": [0.0, 0.12, 0.09]}
    with pytest.raises(ConfigurationError, match="lies behind the elbows"):
        load_profile(written(tmp_path, document))


def test_an_unknown_profile_names_the_valid_ones():
    with pytest.raises(ConfigurationError, match=r"valid names: .*icube"):
        load_profile("icubed")


def test_an_unknown_joint_names_the_valid_ones():
    with pytest.raises(ConfigurationError, match="valid names: new, old"):
        load_profile("icube").with_joint("rusty")


def test_a_profile_that_is_not_there_is_said_to_be_missing(tmp_path):
    with pytest.raises(ConfigurationError, match="cannot read"):
        load_profile(tmp_path / "none.yaml")


@pytest.mark.parametrize("link", ["proximal_mass", "distal_mass"])
def test_a_link_that_weighs_next_to_nothing_is_refused(tmp_path, document, link):
    document["inertia"][link] = 1e-8
    with pytest.raises(ConfigurationError, match=rf"{link}.*0\.001"):
        load_profile(written(tmp_path, document))


@pytest.mark.parametrize("tilt", [79.0, 89.9])
def test_a_tilt_at_which_no_link_reaches_the_tool_is_refused(tmp_path, document, tilt):
    document["workspace"]["tilt_limit_deg"]["new"] = tilt
    with pytest.raises(ConfigurationError, match=r"tilt_limit_deg.*links reach .* at most 78\.2"):
        load_profile(written(tmp_path, document))


def test_a_needle_holder_of_impossible_bars_is_refused_with_the_reason():
    document = load_profile("tensegrity").model_dump(mode="json")
    short = document | {
        "geometry": document["geometry"] | {"first_reach": 0.02, "second_reach": 0.02}
    }
    with pytest.raises(ConfigurationError, match="no pose closes both pantographs"):
        parse_profile(short, "it")
    order = document | {"cables": document["cables"] | {"least": 300.0}}
    with pytest.raises(ConfigurationError, match="tensions must rise"):
        parse_profile(order, "it")
    with pytest.raises(ConfigurationError, match=r"needles longer than 0\.26"):
        load_profile("tensegrity").with_needle(0.2)
    assert load_profile("tensegrity").with_needle(0.3).needle_length == 0.3


def test_a_joint_that_there_is_not_is_said_in_our_own_words_alone(document, tmp_path):
    document["workspace"]["joint"] = "leg"
    with pytest.raises(ConfigurationError) as refused:
        load_profile(written(tmp_path, document))
    said = str(refused.value)
    assert "workspace: joint 'leg' is not one of new, old (line" in said
    assert "Value error" not in said
