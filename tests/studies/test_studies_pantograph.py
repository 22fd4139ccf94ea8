"""The thesis' validation redone: closures, the singular place, the sizes of the printed errors."""

import ast
from pathlib import Path

import numpy as np
import pytest

import app
from app.mechanisms.profile import load_profile
from app.studies import pantograph_tables, printed_formulas
from app.studies.pantograph_tables import disc, hub_many, inverse_many, jacobian_many, wrapped

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph


@pytest.fixture(autouse=True)
def fewer(monkeypatch):
    monkeypatch.setattr(pantograph_tables, "POSES", 20_000)
    monkeypatch.setattr(pantograph_tables, "GRID", 61)


def rows(sheet):
    return {row[0]: dict(zip(sheet.columns, row, strict=True)) for row in sheet.rows}


@pytest.mark.long("statistics")
def test_everything_closes_to_rounding():
    found = rows(pantograph_tables.closures(GEOMETRY))
    for name, row in found.items():
        limit = {"rad": 1e-8, "m": 1e-12, "-": 1e-7}[row["unit"]]
        assert row["largest"] <= limit, name
        assert row["without an answer"] == 0, name
    assert found["all poses: P3, once more forward"]["median"] <= 1e-15
    assert found["45° cone: q1"]["largest"] < 1e-14


@pytest.mark.long("statistics")
def test_newton_finds_one_singular_place_above_the_motors():
    above = [
        row for row in pantograph_tables.singular_places(GEOMETRY).rows if "above" in str(row[2])
    ]
    assert len(above) == 1
    q1, q2, *_, beside = above[0]
    assert q1 == pytest.approx(64.849, abs=1e-3)
    assert q1 + q2 == pytest.approx(180.0, abs=1e-6)
    assert beside > 1e-9, "a billionth of a radian beside it most digits of P3 are lost"


def test_the_printed_angles_are_those_that_the_errata_list():
    p3 = np.array([[0.020, 0.180]])
    assert printed_formulas.printed_left_angle(GEOMETRY, p3)[0] == pytest.approx(2.951, abs=1e-3)
    assert printed_formulas.printed_right_angle(GEOMETRY, p3)[0] == pytest.approx(3.464, abs=1e-3)
    assert inverse_many(GEOMETRY, p3)[0] == pytest.approx([2.283, 0.571], abs=1e-3)


def test_the_code_gives_what_its_own_failing_unit_tests_show():
    p3 = np.array([[0.0, 0.149223285959824]])
    assert printed_formulas.code_right_angle(GEOMETRY, p3)[0] == pytest.approx(0.68736, abs=1e-5)
    hub = np.array([[0.0, 0.174218467450767, 0.198431955345491]])
    wrong = printed_formulas.printed_display_point(GEOMETRY, hub)
    assert printed_formulas.code_left_angle(GEOMETRY, wrong)[0] == pytest.approx(1.7742, abs=1e-4)
    assert printed_formulas.code_right_angle(GEOMETRY, wrong)[0] == pytest.approx(-0.8095, abs=1e-4)


@pytest.mark.long("statistics")
def test_the_sizes_of_the_errors_are_those_of_the_errata():
    found = rows(pantograph_tables.printed_errors(GEOMETRY))
    assert found["thesis 4.5 and code, system inverse"]["largest, 30° cone"] == pytest.approx(
        1.8, abs=0.05
    )
    assert found["code, Jacobian"]["largest, 30° cone"] == pytest.approx(0.089, abs=0.005)
    p3 = disc(GEOMETRY, np.deg2rad(39.0), 61)
    q = inverse_many(GEOMETRY, p3)
    printed = printed_formulas.printed_jacobian(GEOMETRY, q, p3) - jacobian_many(GEOMETRY, q, p3)
    assert np.abs(printed[:, 0, 0]).max() < 1e-15, "J11 is printed right"
    assert np.abs(printed[:, 0, 1]).max() == pytest.approx(0.068, abs=0.002)


def test_the_corrected_signs_make_the_printed_formulas_right():
    p3 = disc(GEOMETRY, np.deg2rad(30.0), 31)
    q = inverse_many(GEOMETRY, p3)
    mirrored = np.stack([-GEOMETRY.links[2] - p3[:, 0], p3[:, 1]], axis=1)  # x1 - x3 for x3 - x1
    assert printed_formulas.printed_left_angle(GEOMETRY, mirrored) == pytest.approx(
        q[:, 0], abs=1e-14
    )
    beta = np.arctan2(p3[:, 1], 0.5 * GEOMETRY.links[2] - p3[:, 0])
    right = printed_formulas.printed_right_angle(GEOMETRY, p3) - 2.0 * beta
    assert wrapped(right - q[:, 1]) == pytest.approx(0.0, abs=1e-14)


def test_the_tool_point_with_sin_for_cos_in_its_second_row_is_right():
    p3 = disc(GEOMETRY, np.deg2rad(39.0), 31)
    hub = hub_many(GEOMETRY, p3, np.full(len(p3), 0.1))
    theta, _ = printed_formulas.azimuth_elevation(GEOMETRY, hub)
    found = printed_formulas.printed_tool_point(GEOMETRY, hub)
    assert found[:, 0] == pytest.approx(p3[:, 0], abs=1e-15)
    tilted = np.abs(np.cos(theta)) > 0.1
    mended = GEOMETRY.fulcrum[1] + (found[:, 1] - GEOMETRY.fulcrum[1]) * np.tan(theta)
    assert mended[tilted] == pytest.approx(p3[tilted, 1], abs=1e-14)


def test_the_acos_of_equation_4_9_loses_what_atan2_keeps():
    path = np.array([[0.0, 0.0, -1.0]])
    tilted = np.array([[np.sin(1e-9), 0.0, -np.cos(1e-9)]])
    assert printed_formulas.printed_angle_error(tilted, path)[0] == 0.0


def test_the_printed_law_is_twice_too_strong_at_45_degrees():
    last = rows(pantograph_tables.forces(PROFILE))[45.0]
    assert last["felt with 4.12 [N]"] == pytest.approx(4.0, abs=1e-9)
    assert last["felt minus wanted [N]"] < 1e-12


@pytest.mark.long("statistics")
def test_five_newtons_at_the_skin_need_nearly_twice_the_torque_of_the_thesis():
    found = rows(pantograph_tables.torques(PROFILE))
    assert found[0.0]["upright, 5 N [N·m]"] == pytest.approx(1.079, abs=1e-3)
    assert found[90.0]["upright, 5 N [N·m]"] == pytest.approx(0.5934, abs=1e-3)
    assert found[0.0]["cone of 39°, 0.6 N·m [N]"] == pytest.approx(2.76, abs=5e-3)


@pytest.mark.long("statistics")
def test_only_studies_import_the_wrong_formulas():
    folder = Path(app.__file__).parent
    for path in folder.rglob("*.py"):
        imported = [
            node.module or ""
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
            if isinstance(node, ast.ImportFrom)
        ]
        if any(name.startswith("app.studies.printed") for name in imported):
            assert folder / "studies" in path.parents, path
