"""Zones, margins and electrodes on slices and in the debrief; the steps by key and by mouse."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from test_views_replay import attempted

from app.core.events import Event
from app.session.ablation_shown import AblationShown
from app.session.procedure import KIND, Step, perform
from app.views.debrief.feature import DebriefFeature
from app.views.debrief.margin_map import AROUND, UP, AblationReview, fields, table_rows
from app.views.exercise.ablation_panel import AblationPanel, results
from app.views.slices.zones import BARE, ENOUGH, LITTLE, cut, mark_of
from tests.ablation_rig import begin, liver, needle, part, placed
from tests.careless.texts import cut_texts

OFFS = ((0.004, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.006))


def done(row=None, field=None, asked=None):
    """Return the state and events of an ablation whose electrodes lie beside their places."""
    state, events = begin(field or liver(vessel_mm=18.0), asked), []
    field = state.ablation.lesion.field
    for plan, off in zip(state.ablation.plans, OFFS, strict=True):
        look = needle(plan, off)
        state, words, data = perform(state, Step.PLACE_ELECTRODE, look, placed(), field)
        events.append(Event(1.0, KIND, words, data))
    row = state.ablation.planned_row if row is None else row
    state, words, data = perform(state, Step.ABLATE, look, placed(), field, row)
    return state, [*events, Event(2.0, KIND, words, data)]


@pytest.mark.long("journey")
def test_a_zone_is_cut_by_slices_of_every_direction_where_its_surface_is(window, patient, settle):
    window.resize(1366, 768)
    window.show_patient(patient)
    settle()
    zone = begin(liver()).ablation.planned.zones[0]
    cuts = 0
    for pane in window.workspace.slices:
        plane = pane.canvas.plane
        if plane is None:
            continue
        middle = replace(zone, centre_mm=plane.lps_mm(3.0, -4.0, 0.5 * plane.count))
        turned = replace(middle, axis=np.array([0.3, 0.8, -0.5]))
        for index in (0.5 * plane.count, 0.5 * plane.count + 3.0 / plane.step_mm):
            outline = cut(turned, plane, index)
            assert len(outline) > 40
            places = np.array([plane.lps_mm(x, y, index) for x, y in outline])
            assert np.abs(turned.about_mm(places)).max() < 1e-9
            cuts += 1
        assert not len(cut(turned, plane, 0.5 * plane.count + 60.0 / plane.step_mm))
    assert cuts >= 6


def test_each_class_of_margin_has_a_shape_of_its_own():
    marks = [mark_of(margin, 5.0) for margin in (-0.1, 0.0, 4.9, 5.0, 12.0)]
    assert marks == [BARE, LITTLE, LITTLE, ENOUGH, ENOUGH]
    assert len({mark.symbol for mark in marks}) == 3


@pytest.mark.long("journey")
def test_the_map_has_the_least_margin_of_each_field_and_the_patients_sides():
    state, _ = done()
    planned = AblationShown.of_state(state.ablation).planned
    found = fields(planned)
    assert found.shape == (UP, AROUND)
    assert np.isfinite(found).all()
    assert found.min() == pytest.approx(float(planned.margin_mm.min()))
    marked = replace(planned, margin_mm=np.where(planned.at_mm[:, 2] > 10.0, 1.0, 9.0))
    assert (fields(marked)[0] == 1.0).any()  # towards the head: on top
    assert (fields(marked)[1:] == 9.0).all()
    front = replace(planned, margin_mm=np.where(planned.at_mm[:, 1] < -10.0, 1.0, 9.0))
    assert set(np.flatnonzero((fields(front) == 1.0).any(axis=0))) <= {2, 3, 4}


@pytest.mark.long("journey")
def test_the_panel_leads_through_electrodes_and_generator_by_key_and_mouse(application, settle):
    state = begin(liver())
    panel, asked = AblationPanel(), []
    panel.asked.connect(lambda *step: asked.append(step))
    panel.show()
    panel.show_ablation(state, True, inside=False)
    assert not panel.next.isEnabled()
    assert "Electrode 1 of 3" in panel.held.text()
    panel.show_ablation(state, True, inside=True)
    panel.next.click()
    assert asked.pop() == (Step.PLACE_ELECTRODE, state.ablation.planned_row, 0.0)
    for plan in state.ablation.plans:
        field = state.ablation.lesion.field
        state, _, _ = perform(state, Step.PLACE_ELECTRODE, needle(plan), placed(), field)
    panel.show_ablation(state, True, inside=False)
    assert "All 3 electrodes" in panel.held.text()
    panel.setting.setCurrentIndex(3)
    panel.next.click()
    assert asked.pop() == (Step.ABLATE, 3, 0.0)
    assert panel.setting.currentText() == "30 W, 20 min: 38×24 mm"
    panel.resize(204, 600)  # what the rail has for it at 1366 px
    panel.show()
    assert [words for words in cut_texts(panel) if "QComboBox" in words] == []
    panel.show_ablation(state, False, inside=False)
    assert not panel.next.isEnabled()
    panel.show_ablation(None, True)
    assert panel.isHidden()
    panel.close()


@pytest.mark.long("journey")
def test_where_control_scans_guide_electrodes_can_be_left_by_the_key(application):
    state = begin(liver())
    panel, asked = AblationPanel(), []
    panel.asked.connect(lambda *step: asked.append(step[0]))
    for _ in state.ablation.plans:
        panel.show_ablation(state, True, inside=None)
        panel.next.click()
        plan, field = state.ablation.aim, state.ablation.lesion.field
        state, _, _ = perform(state, Step.PLACE_ELECTRODE, needle(plan), placed(), field)
    panel.show_ablation(state, True, inside=None)
    panel.next.click()
    assert asked == [Step.PLACE_ELECTRODE] * len(state.ablation.plans) + [Step.ABLATE]


@pytest.mark.long("journey")
def test_what_is_told_names_vessels_and_zones_that_were_measured_without_blood():
    state, _ = done()
    said = "\n".join(results(AblationShown.of_state(state.ablation)))
    assert "hepatic vein" in said
    assert "Electrode 3: 6.0 mm from its place" in said
    assert "ex vivo" not in said
    asked = part(generator="microwave-cooled-ex-vivo", minutes=10.0)
    bare, _ = done(asked=asked)
    assert "Zones ex vivo" in "\n".join(results(AblationShown.of_state(bare.ablation)))


@pytest.mark.long("journey")
def test_the_debrief_sets_planned_against_reached(window, patient, settle):
    window.resize(1366, 768)
    window.show_patient(patient)
    feature = window.feature(DebriefFeature)
    _, events = done(row=0)
    review = replace(attempted(patient.volume, side=0.0), ablation=AblationShown.of_events(events))
    feature._controller._show(review, "")
    assert settle(lambda: feature.page.views.has_ct)
    settle()
    box = feature.page.ablation
    assert not box.isHidden()
    rows = table_rows(review.ablation)
    assert box.table.rowCount() == len(rows) == 6
    planned, reached = (box.table.item(0, column).text() for column in (1, 2))
    assert planned == f"{review.ablation.planned.least_mm:.1f} mm"
    assert reached.startswith("-")
    assert all(layer._shown is review.ablation for layer in feature.page.views.zones)
    feature._controller._show(attempted(patient.volume, side=0.0), "")
    settle()
    assert box.isHidden()


@pytest.mark.long("journey")
def test_a_map_is_drawn_with_hatching_where_less_than_wanted(application):
    state, _ = done(row=0)
    box = AblationReview()
    box.show_ablation(AblationShown.of_state(state.ablation))
    box.resize(420, box.sizeHint().height())
    picture = box.reached.grab().toImage()
    colours = {
        picture.pixelColor(x, y).name()
        for x in range(0, picture.width(), 2)
        for y in range(0, picture.height(), 2)
    }
    assert BARE.colour in colours
    assert "#000000" in colours  # hatching, figures
    assert box.key.textFormat() is not Qt.TextFormat.AutoText or box.key.text()
    box.close()
