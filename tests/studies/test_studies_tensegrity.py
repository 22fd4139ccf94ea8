"""The needle holder's study finds what the errata say; the machines are compared by one table."""

import pytest

from app.studies import tensegrity

figure = pytest.importorskip("matplotlib.figure")


@pytest.fixture(autouse=True)
def fewer(monkeypatch):
    monkeypatch.setattr(tensegrity, "POSES", 20_000)
    monkeypatch.setattr(tensegrity, "_SLOW", 20)


def rows(sheet, key=0):
    return {row[key]: dict(zip(sheet.columns, row, strict=True)) for row in sheet.rows}


@pytest.mark.long("statistics")
def test_the_assumed_tilts_cover_both_cones_and_tilts_of_zero_neither():
    found = tensegrity.workspace().rows
    reached = {(row[0], row[2]): row[3:6] for row in found}
    for joints in ("one rhombus", "scissor"):
        full, half = (reached[joints, f"40° as the {w} angle"] for w in ("full", "half"))
        assert (full[0], half[0]) == (100.0, 100.0)
        assert full[1] == pytest.approx(27.36, abs=0.02)
        assert half[1] == pytest.approx(7.36, abs=0.02)
        assert half[2] < 3.8
    lacking = reached["one rhombus, tilts 0", "40° as the full angle"]
    assert lacking[0] < 100.0
    assert lacking[1] == pytest.approx(-2.64, abs=0.01)


def test_everything_closes_to_the_laws_of_its_conditions():
    for name, row in rows(tensegrity.closure()).items():
        limit = 1e-14 if "times" in name else 1e-12
        assert row["largest"] <= limit, name
        assert row["poses"] > 1000, name


def test_every_way_of_the_direct_kinematics_ends_in_one_place():
    found = rows(tensegrity.direct())
    assert len(found) == 4
    for row in found.values():
        assert row["largest error of t"] < 1e-13
        assert row["time [ns]"] > 0.0


def test_encoders_and_condition_grow_worse_with_tilt():
    found = list(rows(tensegrity.conditioning()).values())
    for name in list(found[0])[1:]:
        values = [row[name] for row in found]
        assert values == sorted(values), name
    assert found[0]["edges: largest error [°]"] == pytest.approx(0.12, abs=0.005)


def test_constant_cables_soften_with_pretension_and_stiffening_ones_do_not():
    for row in tensegrity.stiffness().rows:
        least, most = row[2], row[3]
        assert (most < least) == row[1].startswith("constant")


def test_tensions_are_in_equilibrium():
    for row in tensegrity.cables().rows:
        assert row[2] < 1e-10


@pytest.mark.long("statistics")
def test_its_pictures_can_be_drawn():
    for draw in (tensegrity.draw_maps, tensegrity.draw_stiffness, tensegrity.draw_workspace):
        canvas = figure.Figure(figsize=(6.0, 3.0))
        draw(canvas)
        assert canvas.axes
