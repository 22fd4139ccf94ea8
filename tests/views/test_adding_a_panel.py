"""A panel is added in just the way that docs/extending.md says: one file."""

import importlib.util
import re
from pathlib import Path

import pytest
from window_rig import plan

from app.planning.placement import Placement
from app.views.shell.features import FEATURES
from app.views.shell.window import MainWindow

PAGE = Path(__file__).resolve().parents[2] / "docs" / "extending.md"


@pytest.fixture
def feature(tmp_path):
    """The class of the page."""
    section = PAGE.read_text(encoding="utf-8").split("## How to add a panel")[1].split("\n## ")[0]
    block = re.search(r"```python\n(.*?)```", section, re.DOTALL)
    assert block is not None
    path = tmp_path / "slope.py"
    path.write_text(block.group(1), encoding="utf-8")
    spec = importlib.util.spec_from_file_location("slope", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.SlopeFeature


@pytest.fixture
def longer(application, services, destroy, feature):
    """A window that has one feature more."""
    window = MainWindow(services, (*FEATURES, feature))
    destroy(window)
    window.show()
    yield window
    window.editor.saved(Path("kept"))


def entry(window):
    (menu,) = [one.menu() for one in window.menuBar().actions() if one.text() == "&Measure"]
    return next(one for one in menu.actions() if one.text() == "Slope of the path")


def test_the_panel_of_the_page_stands_beside_the_others_and_follows_the_plan(
    longer, feature, patient, settle
):
    panel, side = longer.feature(feature).panel, longer.workspace.side
    assert side.names()[-1] == "Slope"
    longer.show_patient(patient)
    plan(longer)
    assert panel.text() == "0° from straight down"
    draft = longer.editor.edit.draft
    x, y, z = draft.entry_mm
    longer.editor.take(draft.with_entry((x + draft.target_mm[1] - y, y, z)), Placement())
    assert panel.text() == "45° from straight down"
    longer.show_start()
    entry(longer).trigger()
    assert longer.pages.currentWidget() is longer.workspace
    assert panel.isVisible()


def test_what_the_panel_of_the_page_misses_is_said_until_the_plan_changes(longer, patient):
    longer.show_patient(patient)
    longer.editor.start(None)
    entry(longer).trigger()
    assert "no path yet" in longer.message_bar.text
    plan(longer)
    assert longer.message_bar.isHidden()


def test_the_panel_of_the_page_says_nothing_of_a_patient_who_left(longer, feature, patient):
    longer.show_patient(patient)
    plan(longer)
    assert longer.feature(feature).panel.text()
    longer.editor.saved(Path("kept"))
    longer.conductor.leave_patient()
    assert longer.feature(feature).panel.text() == ""
