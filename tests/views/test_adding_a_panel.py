"""A panel is added as docs/extending.md says: one file of a folder of plug-ins."""

import re
import sys
from pathlib import Path

import pytest
from window_rig import plan

from app.core import plugin_folders
from app.planning.placement import Placement
from app.views.kit.roles import EVERYBODY, Role
from app.views.shell.feature_plugins import with_plugins
from app.views.shell.features import FEATURES
from app.views.shell.window import MainWindow

PAGE = Path(__file__).resolve().parents[2] / "docs" / "extending.md"
OWN = tuple(one for one in FEATURES if one.__module__.startswith("app.views."))


@pytest.fixture
def panel_section():
    """What the page says of panels."""
    return PAGE.read_text(encoding="utf-8").split("## How to add a panel")[1].split("\n## ")[0]


@pytest.fixture
def order(tmp_path, monkeypatch, panel_section):
    """The window's features with the one of the page, saved where the page says."""
    block = re.search(r"Save this as `([\w/.]+)`.*?```python\n(.*?)```", panel_section, re.DOTALL)
    assert block is not None
    folder = tmp_path / "acus_slope"
    path = folder / block.group(1)
    path.parent.mkdir(parents=True)
    (folder / "__init__.py").touch()
    path.write_text(block.group(2), encoding="utf-8")
    monkeypatch.setenv("ACUS_PLUGINS", str(folder))
    monkeypatch.setattr(sys, "path", [*sys.path])
    plugin_folders.folders.cache_clear()
    yield with_plugins(OWN)
    plugin_folders.folders.cache_clear()
    for name in [name for name in sys.modules if name.split(".")[0] == folder.name]:
        del sys.modules[name]


@pytest.fixture
def feature(order):
    """The class of the page."""
    return next(one for one in order if one.__name__ == "SlopeFeature")


@pytest.fixture
def longer(application, services, destroy, order):
    """A window that has one feature more."""
    window = MainWindow(services, order)
    destroy(window)
    window.show()
    yield window
    window.editor.saved(Path("kept"))


@pytest.mark.long("journey")
def test_the_panel_of_the_page_is_there_for_whom_the_page_says(longer, feature):
    panel = longer.feature(feature).panel
    side = longer.workspace.side
    longer.roles.choose(Role.INSTRUCTOR)
    assert "Slope" in side.names()
    assert entry(longer)
    longer.roles.choose(Role.STUDENT)
    assert "&Measure" not in [one.text() for one in longer.menuBar().actions()]
    assert not panel.isVisible()


@pytest.mark.long("journey")
def test_a_panel_for_everybody_is_shown_by_its_entry_in_a_student_s_window(
    application, services, destroy, order, feature, patient, monkeypatch
):
    monkeypatch.setattr(feature, "roles", EVERYBODY)
    window = MainWindow(services, order)
    destroy(window)
    window.show()
    window.roles.choose(Role.STUDENT)
    window.show_patient(patient)
    plan(window)
    entry(window).trigger()
    assert window.feature(feature).panel.isVisible()
    window.editor.saved(Path("kept"))


def entry(window):
    (menu,) = [one.menu() for one in window.menuBar().actions() if one.text() == "&Measure"]
    return next(one for one in menu.actions() if one.text() == "Slope of the path")


@pytest.mark.long("journey")
def test_the_panel_of_the_page_stands_beside_the_others_and_follows_the_plan(
    longer, feature, patient, settle
):
    panel, side = longer.feature(feature).panel, longer.workspace.side
    assert side.names()[side.names().index("Measure") + 1] == "Slope"
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


@pytest.mark.long("journey")
def test_what_the_panel_of_the_page_misses_is_said_until_the_plan_changes(longer, patient):
    longer.show_patient(patient)
    longer.editor.start(None)
    entry(longer).trigger()
    assert "no path yet" in longer.message_bar.text
    plan(longer)
    assert longer.message_bar.isHidden()


@pytest.mark.long("journey")
def test_the_panel_of_the_page_says_nothing_of_a_patient_who_left(longer, feature, patient):
    longer.show_patient(patient)
    plan(longer)
    assert longer.feature(feature).panel.text()
    longer.editor.saved(Path("kept"))
    longer.conductor.leave_patient()
    assert longer.feature(feature).panel.text() == ""


def test_the_page_names_every_feature_behind_which_a_panel_can_stand(panel_section):
    names = panel_section.split("\n- `after` is")[1].split(", or the file of another")[0]
    modules = (one.__module__.split(".") for one in OWN)
    own = [file if file != "feature" else folder for *_, folder, file in modules]
    assert re.findall(r"`(\w+)`", names) == own
