"""The machines are compared by one table."""

from dataclasses import replace

import numpy as np
import pytest

from app.mechanisms.errors import UnreachableError
from app.studies import machines

figure = pytest.importorskip("matplotlib.figure")

NAMES = ["pantograph (icube)", "tensegrity (paper)"]
"""The program's own; machines of plug-ins follow."""


@pytest.mark.long("statistics")
def test_all_machines_are_asked_the_same():
    found = {m.name: machines.at_tilt(m, np.deg2rad(20.0)) for m in machines.machines()}
    assert list(found)[:2] == NAMES
    for values in found.values():
        assert values["reached"] == 1.0
        assert all(np.isfinite(value) and value > 0.0 for value in values.values())
    first, second = (found[name] for name in NAMES)
    assert first["resolution"] < second["resolution"]
    assert first["stiffness"] < second["stiffness"]
    assert second["force"] > first["force"]


def test_the_force_that_a_machine_is_said_to_give_needs_its_largest_effort():
    limits = {"pantograph (icube)": 0.6, "tensegrity (paper)": 60.0}
    for machine in machines.machines()[:2]:
        d = machines.ring(np.deg2rad(39.0))[3]
        most = machine.force(d)
        efforts = [np.abs(machine.efforts(d, most * way)).max() for way in machines.across(d)]
        assert max(efforts) <= limits[machine.name] * (1.0 + 1e-9)


def test_beyond_its_reach_a_machine_has_no_numbers():
    pantograph = machines.machines()[0]
    found = machines.at_tilt(pantograph, np.deg2rad(45.0))
    assert found["reached"] == 0.0
    assert np.isnan(found["force"])


@pytest.mark.long("statistics")
def test_a_further_machine_is_one_more_entry(monkeypatch):
    def half_reach(d):
        if d[0] > 0.0:
            raise UnreachableError("unreachable: only the left half")
        return pantograph.turning(d)

    pantograph = machines.machines()[0]

    def fourth():
        return replace(pantograph, name="fourth", turning=half_reach)

    more = (*machines.comparisons(), machines.ComparedPlugin("a fourth", fourth))
    monkeypatch.setattr(machines, "comparisons", lambda: more)
    machines.machines.cache_clear()
    try:
        names = {row[0] for row in machines.by_tilt().rows}
    finally:
        machines.machines.cache_clear()
    assert names >= {*NAMES, "fourth"}
    assert names == {one.name for one in machines.machines()} | {"fourth"}


@pytest.mark.long("statistics")
def test_the_picture_has_every_machine_and_the_reach_by_turn():
    canvas = figure.Figure(figsize=(16.0, 7.0))
    machines.draw(canvas)
    names = [one.name for one in machines.machines()]
    assert len(canvas.axes) == 7
    for axes in canvas.axes:
        assert len(axes.lines) == len(names)
    assert [text.get_text() for text in canvas.legends[0].get_texts()] == names
