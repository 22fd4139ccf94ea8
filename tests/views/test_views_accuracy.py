"""The scene's effects in their panel, and what accuracy costs on its page."""

from dataclasses import replace
from threading import Event
from types import SimpleNamespace

import pyqtgraph as pg
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton
from views_exercise_fakes import snapshot, statistics
from window_rig import plan

from app.session.machine import State
from app.session.snapshot import BreathHold
from app.studies.findings import Findings, Sheet
from app.studies.hard import COLUMNS
from app.studies.kept import kept, kept_names
from app.studies.sweep_table import SweepTable
from app.views.accuracy.budget import EffectCost, SceneCost, advice, lowering, too_much
from app.views.accuracy.diagram import Diagram
from app.views.accuracy.feature import AccuracyFeature
from app.views.accuracy.page import AccuracyPage, share_words
from app.views.accuracy.panel import EffectsPanel
from app.views.accuracy.sweep_tab import SweepTab, measure_words

DEAR = EffectCost("a", "Dear", "fine", {"fine": "", "rough": ""}, {"fine": 9e-4, "rough": 1e-6}, "")
CHEAP = EffectCost("b", "Cheap", "one", {"one": "only"}, {"one": 1e-7}, "")


def test_a_scene_that_is_held_needs_no_advice() -> None:
    assert not too_much(1e-5, 1e-3, 0.0)
    assert advice((DEAR, CHEAP), 1e-5, 1e-3, 0.0) == ""


def test_the_effect_that_saves_most_is_the_one_to_lower() -> None:
    best = lowering((CHEAP, DEAR))
    assert best is not None
    assert (best.effect, best.model) == (DEAR, "rough")
    said = advice((CHEAP, DEAR), 9.1e-4, 1e-3, 0.0)
    assert "a tick takes 910 µs of 1000 µs" in said
    assert "“Dear” by rough, which saves 899.0 µs" in said


def test_no_effect_is_blamed_for_what_other_programs_take() -> None:
    assert lowering((CHEAP,)) is None
    said = advice((CHEAP,), 1e-5, 1e-3, 0.2)
    assert "20.0 % of the ticks come too late" in said
    assert "no effect of this scene is the reason" in said
    assert advice((), float("nan"), 1e-3, 0.0) == ""
    little = replace(DEAR, costs={"fine": 2e-6, "rough": 1e-6})
    assert lowering((little,)) is not None
    assert lowering((little,), 1e-3) is None  # no button where no effect is the reason
    assert "no effect of this scene is the reason" in advice((little,), 1e-5, 1e-3, 0.2)


@pytest.mark.parametrize(("share", "words"), [(12.0, "12 times"), (0.5, "50 %"), (1e-4, "0.01 %")])
def test_a_share_of_what_is_noticed_is_said_in_words(share, words) -> None:
    assert share_words(share) == words


@pytest.mark.long("journey")
def test_every_kept_study_can_be_looked_at(window) -> None:
    page = AccuracyPage(window)
    page.wanted.connect(lambda name: page.show_study(kept(name), False))
    page.set_studies({name: kept(name).result.study.title for name in kept_names()})
    for name in kept_names():
        page.choose(name)
        assert page.name == name
        assert page.title.text() == kept(name).result.study.title
        assert page.ways.rowCount() == len(kept(name).result.summary())
        assert "In use: " in page.verdict.text()


@pytest.mark.long("journey")
def test_hard_cases_are_shown_with_their_verdict(window) -> None:
    page = AccuracyPage(window)
    row = ("rotations", "near 180°", "π - 1e-9", "60 digits", 1e-16, 1e-12, "rad", "named", "yes")
    sheet = Sheet("cases", "Hard cases", COLUMNS, (row,))
    page.hard.show_findings(Findings((sheet,), lines=("1 of 1 cases hold",), passed=True))
    assert page.hard.cases.rowCount() == 1
    assert "✔ 1 of 1 cases hold" in page.hard.said.text()


@pytest.fixture
def running(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    feature = window.feature(AccuracyFeature)
    assert settle(lambda: feature._runs.run is not None and feature.panel._scene is not None)
    return feature


@pytest.mark.long("journey")
def test_a_model_is_chosen_in_the_panel_and_shown(running, settle) -> None:
    panel = running.panel
    settle()
    rows = {row.effect.name: row for row in panel.rows}
    if "lateral_tissue" not in rows:
        pytest.skip("the exercise that is open first has no effects")
    rows["lateral_tissue"].models.setCurrentIndex(1)
    settle()
    rows = {row.effect.name: row for row in panel.rows}
    assert rows["lateral_tissue"].effect.model == "winkler"


@pytest.mark.long("journey")
def test_the_wheel_over_a_model_without_the_keyboard_changes_no_model(running, settle) -> None:
    panel = running.panel
    running._shell.show_panel(panel)
    settle()
    box = next((row.models for row in panel.rows if row.models.isEnabled()), None)
    if box is None:
        pytest.skip("the exercise that is open first has no effects to choose a model of")
    before, where = box.currentIndex(), QPointF(box.rect().center())
    button, keys = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier
    for angle in (-120, 120):
        turned = QPoint(0, angle)
        phase = Qt.ScrollPhase.NoScrollPhase
        wheel = QWheelEvent(where, where, QPoint(), turned, button, keys, phase, False)
        QApplication.sendEvent(box, wheel)
        assert box.currentIndex() == before


@pytest.mark.long("journey")
def test_a_model_that_is_kept_goes_back_and_says_why(running, settle, monkeypatch) -> None:
    panel, said = running.panel, []
    settle()
    if not panel.rows:
        pytest.skip("the exercise that is open first has no effects")
    opened = running._runs._open
    locked = opened.setup.exercise.model_copy(update={"locks": ("models",)})
    opened.setup = replace(opened.setup, exercise=locked)
    running.failed.connect(said.append)
    before = panel.rows[0].models.currentIndex()
    panel.rows[0].models.setCurrentIndex(1 - before)
    assert panel.rows[0].models.currentIndex() == before
    assert said


@pytest.mark.long("journey")
def test_the_shares_of_frame_and_picture_are_shown_beside_the_tick(running, settle) -> None:
    panel = running.panel
    settle()
    tracker = statistics(rate=30.0, cost=3e-3)
    running._shell.show_panel(panel)
    settle()
    scene = SceneCost((), {})
    panel.show_scene(scene, "")
    timing = SimpleNamespace(cost=5e-6, rate_hz=1000.0, ticks=1000, missed=0)
    panel.show_snapshot(
        snapshot(running._runs.run.placed, timing=timing, tracker=tracker, time=1e6), 8e-3
    )
    assert "A frame of the window takes 8.0 of 17 ms (48 %)" in panel._frame._said.text()
    assert "A pair of pictures takes 3.0 of 33 ms (9 %)" in panel._picture._said.text()
    assert not panel._picture.isHidden()
    panel.show_snapshot(snapshot(running._runs.run.placed, timing=timing, time=2e6), 0.0)
    assert panel._frame.isHidden()


@pytest.mark.long("journey")
def test_the_keys_of_the_attempt_work_whichever_panel_is_in_front(running, window, settle) -> None:
    panel, asked = window.workspace.exercise_panel, []
    buttons = panel.buttons
    buttons.end_requested.connect(lambda: asked.append("end"))
    buttons.scan_requested.connect(lambda: asked.append("scan"))
    panel.breath.asked.connect(lambda _: asked.append("breath"))
    running._shell.show_panel(running.panel)
    buttons.show_state(State.INSERTING, False)
    panel.breath.show_breath(BreathHold(), True)
    window.activateWindow()
    assert QTest.qWaitForWindowActive(window)
    assert not buttons.isVisible()
    for key in (Qt.Key.Key_S, Qt.Key.Key_A, Qt.Key.Key_Return):
        QTest.keyClick(window.workspace, key)
    assert asked == ["scan", "breath", "end"]


def test_a_warning_brings_no_button_that_helps_nobody_and_moves_nothing(settle) -> None:
    panel = EffectsPanel()  # none that a running trainer writes into meanwhile
    panel.resize(320, 600)
    panel.show()
    little = replace(DEAR, costs={"fine": 2e-6, "rough": 1e-6})
    places = []
    for number, (effect, missed, lowered) in enumerate(
        ((DEAR, 0, False), (little, 300, False), (DEAR, 300, True))
    ):
        panel.clear()
        panel.show_scene(SceneCost((effect,), {}), "")
        cost = 5e-6 if not lowered else 9e-4
        start = 1e6 * (number + 1)
        for time, ticks, late in ((start, 1000, 0), (start + 1.0, 2000, missed)):
            timing = SimpleNamespace(cost=cost, rate_hz=1000.0, ticks=ticks, missed=late)
            panel.show_snapshot(snapshot(timing=timing, time=time, tracker=None), 0.0)
        settle()
        assert panel.lowering.isVisible() == lowered
        places.append(panel.rows[0].y())
    assert len(set(places)) == 1
    panel.close()


def test_while_something_is_measured_nothing_else_can_be_and_cancel_is_answered(
    window, settle, monkeypatch
) -> None:
    feature = window.feature(AccuracyFeature)
    feature.open_page()
    page, seen, free = feature.page, [], Event()

    def measure(name, progress):
        while not free.wait(0.01):
            pass
        progress.report(0.5, "further")

    monkeypatch.setattr("app.views.accuracy.feature._measure", measure)
    page.measure.click()
    assert not page.measure.isEnabled()
    assert not page.hard.run.isEnabled()
    feature.measure(page.name)
    assert "cancel it at the top" in window.message_bar.text
    feature.measured.connect(lambda: seen.append(page.measure.isEnabled()))
    (cancel,) = [one for one in window.progress.findChildren(QToolButton) if one.isEnabled()]
    cancel.click()
    assert (cancel.text(), cancel.isEnabled()) == ("Cancelling…", False)
    free.set()
    assert settle(lambda: bool(seen))
    assert seen == [True]
    assert page.hard.run.isEnabled()
    assert window.message_bar.isHidden()


@pytest.mark.long("journey")
def test_no_diagram_has_a_factor_beside_its_axis_or_a_label_cut_at_its_edge(window, settle) -> None:
    diagram = Diagram(window)
    diagram.resize(1060, 300)
    diagram.show()
    for name in kept_names():
        study = kept(name)
        diagram.show_study(study)
        settle()
        axis = diagram.plot.getAxis("bottom")
        assert not axis.autoSIPrefix
        assert "(x" not in axis.labelString()
        (low, high), _ = diagram.plot.viewRange()
        levels = axis.tickValues(low, high, 900.0)
        ticks = [one for _, values in levels for one in values]
        assert len(ticks) >= 2
        words = axis.logTickStrings(ticks, 1.0, 1.0)
        assert all("10" in one and "e" not in one for one in words)
        assert high - low < 25.0  # decades: a way that blows up stands at the edge
        box = diagram.plot.getViewBox()
        whole = box.mapRectToScene(box.boundingRect())
        for item in diagram.plot.getPlotItem().items:
            text = item.label if isinstance(item, pg.InfiniteLine) else item
            if isinstance(text, pg.TextItem):
                at = text.mapRectToScene(text.boundingRect())
                assert at.left() >= whole.left() - 1.0, (name, text.toPlainText())
                assert at.right() <= whole.right() + 1.0, (name, text.toPlainText())
    diagram.close()


@pytest.mark.long("journey")
def test_four_ways_of_a_study_are_seen_in_a_low_window(window, settle) -> None:
    window.resize(1366, 768)
    feature = window.feature(AccuracyFeature)
    feature.open_page()
    for name in kept_names():
        feature.page.choose(name)
        settle()
        ways = feature.page.ways
        last = min(4, ways.rowCount()) - 1
        assert ways.visualItemRect(ways.item(last, 0)).bottom() <= ways.viewport().height(), name


def sweep_of(attempts, wanted=None):
    """A sweep of two skills over registration errors; `attempts` of each condition."""
    rows = [
        {"exercise": "liver-01", "version": 1, "skill": skill, "registration_error_mm": error,
         "seed": seed, "total": total - 4.0 * error + seed, "passed": total - 4.0 * error > 60.0,
         "duration_s": 20.0}
        for skill, total in (("expert", 90.0), ("novice", 65.0))
        for error in (0.0, 2.0, 5.0)
        for seed in range(attempts)
    ]  # fmt: skip
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    return SweepTable(columns, wanted is None, wanted, 1.44)


def marked(tab):
    """Return where the marks of each line stand along the axis."""
    lines = [one for one in tab.plot.getPlotItem().items if isinstance(one, pg.PlotDataItem)]
    return [
        list(one.getData()[0])
        for one in lines
        if one.opts["symbol"] and one.getData()[0] is not None
    ]


def test_a_sweep_is_drawn_along_what_was_varied_and_keeps_what_was_chosen(application, destroy):
    tab = SweepTab()
    destroy(tab)
    assert tab.plot.isHidden() or tab.plot.parentWidget().isHidden()  # nothing to draw yet
    tab.show_sweep(sweep_of(2, wanted=48))
    assert not tab.plot.parentWidget().isHidden()
    assert not tab.grown.isHidden()
    assert (tab.grown.value(), tab.grown.maximum()) == (12, 48)
    tab.measure.setCurrentIndex(tab.measure.findData("passed"))
    tab.over.setCurrentIndex(tab.over.findData("registration_error_mm"))
    tab.apart.setCurrentIndex(tab.apart.findData("skill"))
    tab.show_sweep(sweep_of(8))
    assert tab.grown.isHidden()
    assert tab.measure.currentData() == "passed"
    assert [tab.means.item(row, 2).text() for row in range(6)] == ["8"] * 6
    assert [tab.means.item(row, 3).text() for row in range(6)] == [
        "100",
        "100",
        "100",
        "100",
        "0",
        "0",
    ]
    assert marked(tab) == [[0.0, 2.0, 5.0]] * 2
    assert "48 attempts of scripts, not people" in tab.summary.text()
    assert "one costs 1.44 s of a processor, a million 400 h" in tab.summary.text()
    assert "expert" in tab.series.text()


def test_texts_stand_on_the_axis_one_after_another(application, destroy):
    tab = SweepTab()
    destroy(tab)
    tab.show_sweep(sweep_of(2))
    assert tab.over.currentData() == "skill"
    assert marked(tab) == [[0.0, 1.0]]
    assert [tab.means.item(row, 1).text() for row in range(2)] == ["expert", "novice"]


def test_a_metric_is_called_as_everywhere_with_its_unit_and_another_column_by_its_name():
    assert measure_words("value_target_error").endswith(" [mm]")
    assert "_" not in measure_words("value_target_error")
    assert measure_words("value_of_somebody") == "value_of_somebody"
