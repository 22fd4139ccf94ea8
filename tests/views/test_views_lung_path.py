"""The path report of a lung biopsy in the window: the plan's figures beside the alternative's."""

import numpy as np
import pytest
from field_rig import beyond, field_of_shapes

from app.imaging.field import TissueKind, making
from app.planning.draft import DraftPlan
from app.planning.lung_path.reporting import LungPaths
from app.views.plan.lung_path import LungPathPanel, places_of
from app.views.plan.paths import PathsFeature

ENTRY, TARGET = (0.0, -20.0, 140.0), (0.0, 15.0, 140.0)
CORNER = (-40.31, -30.17, 100.23)


def chest(*more):
    """Skin at y = -20, lung of two lobes from -10 on, the fissure at 45°, and what is laid over."""
    lung = beyond((0, 1, 0), -10.0)

    def lower(p):
        return np.maximum(lung(p), (140.0 - p[:, 2] - p[:, 1]) / np.sqrt(2.0))

    shapes = [
        (TissueKind.AIR, "", lambda p: np.full(len(p), -50.0)),
        (TissueKind.MUSCLE, "", beyond((0, 1, 0), -20.0)),
        (TissueKind.LUNG, "right upper lobe", lung),
        (TissueKind.LUNG, "right lower lobe", lower),
        *more,
    ]
    return field_of_shapes(shapes, CORNER, (81, 71, 81))


@pytest.fixture
def planned(window, patient, monkeypatch):
    monkeypatch.setattr(making, "field_of", lambda *args, **named: chest())
    window.show_patient(patient)
    window.editor.start(DraftPlan(ENTRY, TARGET, "report me"))
    return window


def part(window):
    return window.feature(PathsFeature).lung


def column(panel, number):
    return [panel.table.item(row, number).text() for row in range(panel.table.rowCount())]


@pytest.mark.long("journey")
def test_nothing_is_reported_before_it_is_asked_for(planned, settle):
    settle()
    assert part(planned).reports is None
    assert not part(planned).panel.table.isVisible()
    assert part(planned).panel.make.isEnabled()


@pytest.mark.long("journey")
def test_the_report_is_shown_and_marked_and_what_is_not_labelled_is_not_known(planned, settle):
    lung = part(planned)
    lung.panel.make.click()
    assert settle(lambda: lung.reports is not None)
    assert column(lung.panel, 0)[:3] == ["Pleura crossed", "Fissures crossed", "Aerated lung"]
    said = column(lung.panel, 1)
    assert said[0] == "1 (0° at 10 mm)"
    assert said[1] == "1 (45° at 20 mm)"
    assert said[2] == "25.0 mm"
    assert said[3] == "0.0 mm"  # by the CT's own values
    assert said[4:] == ["not known"] * 7
    assert lung.panel.table.item(4, 1).font().italic()
    assert "not known" in lung.panel.table.item(4, 1).toolTip()
    assert [place.name for place in lung._scene._shown] == ["Pleura 0°", "Fissure 45°"]
    assert all(layer._shown for layer in lung._layers)


@pytest.mark.long("journey")
def test_an_alternative_stands_beside_the_plan_and_the_report_follows_the_plan(planned, settle):
    lung = part(planned)
    lung.panel.make.click()
    assert settle(lambda: lung.reports is not None)
    lung.show_alternative(np.array([0.0, -20.0, 130.0]), "Alternative, 80 points")
    assert settle(lambda: lung.reports is not None and lung.reports[1] is not None)
    assert lung.panel.table.columnCount() == 3
    assert lung.panel.table.horizontalHeaderItem(2).text() == "Alternative, 80 points"
    assert column(lung.panel, 2)[0] == "1 (16° at 10 mm)"
    planned.editor.start(DraftPlan((5.0, -20.0, 140.0), TARGET, "moved"))
    assert lung.reports is None
    assert not lung._scene._shown
    assert settle(lambda: lung.reports is not None)
    assert column(lung.panel, 1)[0] == "1 (8° at 10 mm)"


@pytest.mark.long("journey")
def test_clearing_takes_table_and_marks_away_and_another_patient_too(planned, patient, settle):
    lung = part(planned)
    for clear in (lung.panel.clear.click, lambda: planned.show_patient(patient)):
        planned.editor.start(DraftPlan(ENTRY, TARGET, "report me"))
        lung.panel.make.click()
        assert settle(lambda: lung.reports is not None)
        clear()
        assert lung.reports is None
        assert not lung._scene._shown
        assert lung.panel.table.isHidden()


@pytest.mark.long("journey")
def test_a_path_that_misses_the_lung_is_told_in_a_line(planned, settle):
    planned.editor.start(DraftPlan(ENTRY, (0.0, -12.0, 140.0), "short"))
    lung = part(planned)
    lung.panel.make.click()
    assert settle(lambda: "does not go through the lung" in lung.panel.note.text())
    assert lung.panel.table.isHidden()


def test_without_entry_or_target_there_is_no_report_and_it_says_what_to_do(planned):
    planned.editor.start(DraftPlan(None, TARGET, "half"))
    panel = part(planned).panel
    assert not panel.make.isEnabled()
    assert "Place entry and target first" in panel.make.toolTip()


def test_the_button_and_the_table_are_reached_by_tab(application, destroy):
    panel = LungPathPanel()
    destroy(panel)
    report = LungPaths(chest()).report(ENTRY, TARGET)
    panel.show_reports(report, None, "")
    for widget in (panel.make, panel.clear, panel.table):
        assert widget.focusPolicy().value & 1  # Qt.TabFocus
    assert panel.table.accessibleName() == "Path through the lung"
    assert [place.kind for place in places_of(report)] == ["lung", "organ"]
