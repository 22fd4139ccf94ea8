"""The house by its syntax trees: no circles, who knows the window, a small context, Qt in views."""

from __future__ import annotations

import ast
import dataclasses
import re
import typing
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import app
from tools.structure import MOST_ALONE, MOST_NAMES, Structure, over_budget, read, read_budget

ROOT = Path(app.__file__).parents[1]
TOOLKITS = ("PySide6", "pyqtgraph", "vtkmodules", "vtk")
WINDOW = "MainWindow"
MOST_FIELDS = 8
MOST_WITHOUT_QT = 10

WITHOUT_QT = {
    "app.views.exercise.run": "what compose hands the window of a running trainer: a port",
    "app.views.kit.themes": "the colours, as plain values",
    "app.views.scene.orbit": "where the 3D camera stands",
    "app.views.slices.camera": "which part of a plane a pane shows",
    "app.views.slices.labels": "where labels find room on a pane",
    "app.views.slices.slab": "points and slabs as panes take them",
}
"""Modules of `views` that neither import a toolkit nor a module that does, each with its reason."""

MEAN_TWO_THINGS = {
    "Patient": "whose CT is planned on, and the body that the phantom draws",
    "Ring": "a circle: an actor of VTK here, the outline of the brush there",
    "Section": "a part of a device's mechanics, and a cut through the 3D view: the words of either",
    "Stage": "a step of the loop, and what a theatre and a renderer call a stage",
    "Trial": "an attempt of a script in virtual time, and how somebody else's file is tried",
    "Way": "one of several that are compared: in a study, and of triangulating",
}
"""Class names that more than one module defines, each with its reason."""


@cache
def sources() -> dict[str, str]:
    """Text of every module of `app`, by its dotted name."""
    found = {}
    for path in sorted((ROOT / "app").rglob("*.py")):
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
        found[name.removesuffix(".__init__")] = path.read_text(encoding="utf-8")
    return found


@cache
def trees() -> dict[str, ast.Module]:
    """Syntax tree of every module of `app`, by its dotted name."""
    return {name: ast.parse(text) for name, text in sources().items()}


@cache
def imports() -> dict[str, tuple[tuple[str, str], ...]]:
    """What every module of `app` imports, by its dotted name."""
    return {name: tuple(imported(tree)) for name, tree in trees().items()}


def imported(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Module and name of every import, wherever it stands: in functions and for types too."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name, "") for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from ((node.module, alias.name) for alias in node.names)


@cache
def structure() -> Structure:
    """What the syntax trees say of this checkout."""
    return read()


@pytest.mark.long("journey")
def test_no_modules_import_each_other_in_a_circle_not_even_late_or_for_types():
    assert structure().circles == ()


def test_few_modules_are_a_piece_of_the_one_that_uses_them():
    assert len(structure().alone) <= MOST_ALONE * len(structure().modules)


def test_a_class_name_means_one_thing_but_for_those_that_say_why():
    assert len(MEAN_TWO_THINGS) <= MOST_NAMES
    assert set(structure().ambiguous) == set(MEAN_TWO_THINGS)


def test_nothing_is_kept_from_the_formatter_to_save_lines():
    skipped = [
        f"{path.relative_to(ROOT)}:{number}"
        for room in ("app", "tools")
        for path in sorted((ROOT / room).rglob("*.py"))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if re.search(r"#\s*fmt:\s*(skip|off)", line)
    ]
    assert skipped == []


@pytest.mark.long("journey")
def test_only_the_shell_names_the_windows_class():
    naming = [
        name
        for name, text in sources().items()
        if WINDOW in text
        and (
            any(part == WINDOW for _, part in imports()[name])
            or any(
                (isinstance(node, ast.Name) and node.id == WINDOW)
                or (isinstance(node, ast.Constant) and node.value == WINDOW)
                or (isinstance(node, ast.Attribute) and node.attr == WINDOW)
                for node in ast.walk(trees()[name])
            )
        )
    ]
    assert naming, "the window has another name now"
    assert [name for name in naming if not name.startswith("app.views.shell.")] == []


def test_the_context_is_a_small_frozen_record_without_widgets_and_features():
    from PySide6.QtWidgets import QWidget

    from app.views.shell.feature import Context, Feature

    assert dataclasses.is_dataclass(Context)
    assert Context.__dataclass_params__.frozen  # type: ignore[attr-defined]
    kinds = typing.get_type_hints(Context)
    assert 0 < len(dataclasses.fields(Context)) <= MOST_FIELDS
    for field in dataclasses.fields(Context):
        kind = kinds[field.name]
        assert isinstance(kind, type), f"{field.name}: {kind}"
        assert not issubclass(kind, QWidget | Feature), field.name


def test_features_are_made_from_the_context_alone_and_know_neither_window_nor_workspace():
    from app.views.shell.feature import Context
    from app.views.shell.features import FEATURES

    rooms = {kind.__module__.rpartition(".")[0] for kind in FEATURES}
    for kind in FEATURES:
        hints = typing.get_type_hints(kind.__init__)
        hints.pop("return")
        assert list(hints.values()) == [Context], kind
        assert kind.__init__.__code__.co_argcount == 2, kind
    for name, edges in structure().imports.items():
        if name.rpartition(".")[0] in rooms and not name.startswith("app.views.exercise"):
            assert "app.views.reading.workspace" not in edges, name
            assert "app.views.shell.window" not in edges, name
    for kind in FEATURES:
        others = {other.__module__ for other in FEATURES} - {kind.__module__}
        assert not structure().imports[kind.__module__] & others, f"{kind} knows another feature"


def test_what_stands_in_views_draws_or_speaks():
    """Words of the interface are Qt's too: they pass through `tr`, which is its translation."""
    known, edges = trees(), structure().imports
    direct = {
        name
        for name in known
        if any(module.split(".")[0] in TOOLKITS for module, _ in imports()[name])
    }
    with_qt = {name for name in direct if name.startswith("app.views")}
    while True:
        more = {
            name
            for name, used in edges.items()
            if name.startswith("app.views") and name not in with_qt and used & with_qt
        }
        if not more:
            break
        with_qt |= more
    modules = {
        name
        for name, tree in known.items()
        if name.startswith("app.views.") and len(tree.body) > 1  # not the line of a folder
    }
    assert modules - with_qt == set(WITHOUT_QT)
    assert len(WITHOUT_QT) <= MOST_WITHOUT_QT


def test_no_room_has_more_nodes_than_it_is_granted():
    """`python -m tools.structure --budget` grants more; the commit says what the new replaces."""
    assert over_budget(read(), read_budget()) == ()


def test_a_room_over_its_budget_or_without_one_is_named(tmp_path):
    (tmp_path / "app" / "mechanisms" / "gimbal").mkdir(parents=True)
    (tmp_path / "app" / "core.py").write_text("x = 1\n")
    (tmp_path / "app" / "mechanisms" / "gimbal" / "machine.py").write_text("y = 2\n")
    structure = read(tmp_path)
    assert structure.size == {"core": 5, "mechanisms/gimbal": 5}
    [small, missing] = over_budget(structure, {"core": 3})
    assert "core has 5 nodes, 2 more" in small
    assert "mechanisms/gimbal has 5 nodes, 5 more" in missing
