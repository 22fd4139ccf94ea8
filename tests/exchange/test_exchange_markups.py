"""Plans to and from 3D Slicer."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.exchange.errors import ExportError, MarkupsError
from app.exchange.markups import SCHEMA, parse_plan, plan_document, read_plan, write_plan
from app.planning.plan import Plan

# The structural rules of Slicer's markups-schema-v1.0.3.json that concern a Line.
KINDS = ["Fiducial", "Line", "Angle", "Curve", "ClosedCurve", "Plane", "ROI"]
POINT = {
    "type": "object",
    "required": ["id", "label", "position", "positionStatus"],
    "properties": {
        "id": {"type": "string"},
        "label": {"type": "string"},
        "position": {
            "type": "array",
            "items": {"type": "number"},
            "minItems": 3,
            "maxItems": 3,
        },
        "selected": {"type": "boolean"},
        "locked": {"type": "boolean"},
        "visibility": {"type": "boolean"},
        "positionStatus": {"enum": ["undefined", "preview", "defined"]},
    },
}
RULES = {
    "type": "object",
    "required": ["@schema", "markups"],
    "properties": {
        "@schema": {"pattern": r".*markups-schema-v1\.[0-9]+\.[0-9]+\.json#*$"},
        "markups": {
            "type": "array",
            "minItems": 1,
            "items": {
                "type": "object",
                "required": ["type"],
                "properties": {
                    "type": {"enum": KINDS},
                    "coordinateSystem": {"enum": ["LPS", "RAS"]},
                    "coordinateUnits": {"enum": ["mm", "um"]},
                    "locked": {"type": "boolean"},
                    "labelFormat": {"type": "string"},
                    "controlPoints": {"type": "array", "items": POINT},
                    "measurements": {
                        "type": "array",
                        "items": {
                            "type": "object",
                            "properties": {
                                "name": {"type": "string"},
                                "enabled": {"type": "boolean"},
                                "value": {"type": "number"},
                                "units": {"type": "string"},
                                "printFormat": {"type": "string"},
                            },
                        },
                    },
                },
            },
        },
    },
}
PLAN = Plan(np.array([-12.5, -98.0, 310.2]), np.array([4.0, -31.5, 296.0]), "Liver")


def spoilt(**changes: Any) -> dict[str, Any]:
    """A document with fields of its markup replaced."""
    document = plan_document(PLAN)
    document["markups"][0].update(changes)
    return document


def points(*labels: str) -> list[dict[str, Any]]:
    """Control points at (0, 0, 10·k)."""
    return [{"label": label, "position": [0.0, 0.0, 10.0 * k]} for k, label in enumerate(labels)]


def test_what_is_written_keeps_slicers_rules() -> None:
    document = plan_document(PLAN)
    jsonschema.validate(document, RULES)
    assert document["@schema"] == SCHEMA
    markup = document["markups"][0]
    assert markup["type"] == "Line"
    assert (markup["coordinateSystem"], markup["coordinateUnits"]) == ("LPS", "mm")
    assert [p["label"] for p in markup["controlPoints"]] == ["Entry", "Target"]
    assert {p["positionStatus"] for p in markup["controlPoints"]} == {"defined"}
    assert markup["measurements"][0]["value"] == pytest.approx(69.98, abs=0.01)


coordinate = st.floats(-1e4, 1e4)


@settings(derandomize=True, deadline=None, max_examples=60)
@given(st.tuples(coordinate, coordinate, coordinate), st.text(max_size=20))
def test_reading_gives_back_every_bit_of_what_was_written(
    tmp_path_factory: pytest.TempPathFactory, entry: tuple[float, float, float], name: str
) -> None:
    plan = Plan(np.array(entry), np.array(entry) + np.array([30.0, 40.0, 0.0]), name or "Plan")
    path = tmp_path_factory.mktemp("plan", numbered=True) / "plan.mrk.json"
    write_plan(path, plan)
    assert read_plan(path) == plan


def test_ras_points_are_converted() -> None:
    plan = parse_plan(spoilt(coordinateSystem="RAS"), "x")
    np.testing.assert_array_equal(plan.entry_mm, PLAN.entry_mm * [-1, -1, 1])


def test_micrometres_are_converted() -> None:
    far = [{"position": [0, 0, 0]}, {"position": [0, 0, 50_000]}]
    for units in ("um", ["um", "UCUM", "micrometer"]):
        plan = parse_plan(spoilt(coordinateUnits=units, controlPoints=far), "x")
        assert plan.length_mm == pytest.approx(50.0)


@pytest.mark.parametrize(
    ("labels", "entry", "target"),
    [
        (("Entry", "Target"), 0, 1),
        (("Target", "Entry"), 1, 0),
        (("target ", "ENTRY"), 1, 0),
        (("F-1", "F-2"), 0, 1),
        (("", ""), 0, 1),
        (("End", "Entry"), 1, 0),
        (("Target", "Start"), 1, 0),
        (("other", "Target", "Entry"), 2, 1),
    ],
)
def test_points_are_taken_by_their_names_else_in_their_order(
    labels: tuple[str, ...], entry: int, target: int
) -> None:
    plan = parse_plan(spoilt(controlPoints=points(*labels)), "x")
    assert (plan.entry_mm[2], plan.target_mm[2]) == (10.0 * entry, 10.0 * target)


def test_the_first_line_is_taken_before_any_list_of_points() -> None:
    document = plan_document(PLAN)
    document["markups"].insert(0, {"type": "Fiducial", "controlPoints": points("Entry", "Target")})
    assert parse_plan(document, "x") == PLAN
    del document["markups"][1]
    assert parse_plan(document, "x").length_mm == 10.0


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"type": "ROI"}, "markups[].type is ['ROI']"),
        ({"coordinateSystem": "XYZ"}, "coordinateSystem is 'XYZ'; needed: LPS or RAS"),
        ({"coordinateSystem": ["LPS"]}, "coordinateSystem"),
        ({"coordinateUnits": "inch"}, "coordinateUnits is 'inch'"),
        ({"coordinateUnits": []}, "coordinateUnits is []"),
        ({"controlPoints": None}, "controlPoints is None"),
        ({"controlPoints": points("Entry")}, "controlPoints is 1; needed: two points"),
        ({"controlPoints": points("Entry", "Entry")}, "one Entry and one Target"),
        ({"controlPoints": [1, 2]}, "controlPoints[0] is 1"),
        ({"controlPoints": [{"position": [1, 2]}, {}]}, "controlPoints[0].position is [1, 2]"),
        ({"controlPoints": [{"position": [0, 0, "z"]}, {}]}, "three finite numbers"),
        ({"controlPoints": [{"position": [0, 0, True]}, {}]}, "three finite numbers"),
        ({"controlPoints": [{"position": [0, 0, float("nan")]}, {}]}, "three finite numbers"),
        ({"controlPoints": [{"position": [0, 0, 10**400]}, {}]}, "three finite numbers"),
        (
            {"controlPoints": [{"position": [0, 0, 0], "positionStatus": "undefined"}, {}]},
            "positionStatus is 'undefined'",
        ),
        ({"controlPoints": [{"position": [0, 0, 0]}] * 2}, "apart"),
    ],
)
def test_a_file_without_a_usable_plan_is_refused_with_file_field_and_value(
    changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(MarkupsError) as caught:
        parse_plan(spoilt(**changes), "plan.mrk.json")
    assert str(caught.value).startswith("plan.mrk.json: ")
    assert said in str(caught.value)


@pytest.mark.parametrize(
    "document",
    [None, [], "x", {}, {"@schema": 1}, {"@schema": SCHEMA}, {"@schema": SCHEMA, "markups": []}],
)
def test_a_document_that_is_no_markups_is_refused(document: Any) -> None:
    with pytest.raises(MarkupsError):
        parse_plan(document, "x")


@pytest.mark.parametrize("version", ["v1.0.0", "v1.12.7"])
def test_every_version_one_schema_is_read(version: str) -> None:
    document = plan_document(PLAN)
    document["@schema"] = f"https://example.org/markups-schema-{version}.json#"
    assert parse_plan(document, "x") == PLAN
    document["@schema"] = "https://example.org/markups-schema-v2.0.0.json#"
    with pytest.raises(MarkupsError, match="@schema"):
        parse_plan(document, "x")


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, "\x00", '{"@schema": NaN}'])
def test_a_file_that_is_not_json_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "bad.mrk.json"
    path.write_text(text)
    with pytest.raises(MarkupsError, match=r"bad\.mrk\.json"):
        read_plan(path)


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.mrk.json"):
        with pytest.raises(MarkupsError, match="cannot read"):
            read_plan(path)


def test_a_place_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot write"):
        write_plan(tmp_path / "file" / "plan.mrk.json", PLAN)


def test_the_example_of_the_documentation_is_read() -> None:
    text = json.dumps(plan_document(PLAN))
    assert parse_plan(json.loads(text), "x").name == "Liver"
