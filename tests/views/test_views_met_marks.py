"""Where the needle met something is marked over the slices and in 3D of the debrief."""

from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint
from PySide6.QtGui import QHelpEvent
from PySide6.QtWidgets import QApplication, QToolTip
from test_views_replay import attempted

from app.scoring.met import FORBIDDEN, Met
from app.scoring.result import judge
from app.scoring.rows import ScoreRules
from app.views.debrief.feature import DebriefFeature
from app.views.debrief.met_marks import MARKS, MOST, SAME_MM, places_of
from app.views.kit.theme import BACKGROUND

RIB_MM = (5.0, -10.0, 140.0)


def met(kind, name, begin, end, **more):
    return Met(
        kind, name, 8.0, float(np.linalg.norm(np.subtract(end, begin))), (begin, end), **more
    )


MET = (
    met("skin", "", (5.0, -18.0, 140.0), (5.0, -16.0, 140.0)),
    met("bone", "rib", RIB_MM, RIB_MM, force_n=6.2, angle_deg=31.0, time=58.0),
    met("bone", "rib", (5.0, -9.0, 140.5), (5.0, -9.0, 140.5), force_n=9.4, time=61.0),
    met("lung", "", (5.0, -8.0, 140.0), (5.0, 1.0, 140.0), holds_target=True),
    met("organ", "lesion", (5.0, 1.0, 140.0), (5.0, 5.0, 140.0), holds_target=True),
)


@pytest.fixture
def shown(window, patient, settle):
    window.resize(1366, 768)
    window.show_patient(patient)
    feature = window.feature(DebriefFeature)
    score = judge((), ScoreRules(forbidden=FORBIDDEN), "", MET)
    feature._controller._show(attempted(patient.volume, side=0.0, met=MET, score=score), "")
    assert settle(lambda: feature.page.views.has_ct)
    settle()
    return feature.page


def luminance(colour):
    linear = (int(colour[n : n + 2], 16) / 255 for n in (1, 3, 5))
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in linear)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def test_each_kind_has_a_shape_of_its_own_and_is_seen_on_black():
    shapes = [mark.symbol for mark in MARKS.values()]
    assert len(set(shapes)) == len(shapes), "colour alone tells no kind"
    for mark in MARKS.values():  # WCAG 2.2, 1.4.11: 3 to 1 for graphics
        assert (luminance(mark.colour) + 0.05) / (luminance(BACKGROUND) + 0.05) > 3.0


def test_what_is_met_again_at_one_place_is_one_mark_and_skin_and_the_target_are_none():
    places = places_of(attempted_review())
    assert [(one.kind, one.name) for one in places] == [("bone", "✖ rib"), ("lung", "lung")]
    rib = places[0].help
    assert "met 2 times here" in rib
    assert "largest force along the needle: 9.4 N" in rib
    assert "rib touched at 8.0 mm, 6.2 N" in rib
    assert "nobody felt it" in places[1].help
    assert "longest way in it: 9.0 mm" in places[1].help
    many = [met("bone", "rib", (0.0, 4.0 * n, 0.0), (0.0, 4.0 * n, 0.0)) for n in range(20)]
    ends = [one.ends_mm[0] for one in places_of(attempted_review(tuple(many)))]
    assert len(ends) == MOST
    assert all(np.linalg.norm(a - b) > SAME_MM for a, b in combinations(ends, 2))


def attempted_review(what=MET):
    return SimpleNamespace(
        met=what,
        clock_at=lambda moment: moment - 50.0,
        score=judge((), ScoreRules(forbidden=("bone",)), "", what),
    )


@pytest.mark.long("journey")
def test_the_mark_lies_on_its_place_in_the_patient_over_slices_and_in_3d(shown, settle):
    assert settle(lambda: all(layer._places for layer in shown.views.met[:1]))
    layer, canvas = shown.views.met[0], shown.views.panes[0].canvas
    mark = next(mark for mark, place in layer._places.items() if place.kind == "bone")
    there = canvas.plane.point(np.array(RIB_MM), canvas.index)
    assert (mark.x(), mark.y()) == pytest.approx((there.x, there.y))
    back = canvas.plane.lps_mm(mark.x(), mark.y(), canvas.index)
    assert back == pytest.approx(RIB_MM, abs=1.0)
    at = canvas.pixel_at(mark.x(), mark.y())
    assert layer.at(at.x() + 3.0, at.y()).kind == "bone"
    assert layer.at(at.x() + 80.0, at.y() + 80.0) is None
    x, y = shown.views.scene.pixels(np.array([RIB_MM]))[0]
    assert shown.views.met_scene.at(x, y).name == "✖ rib"


@pytest.mark.long("journey")
def test_who_points_at_a_mark_is_told_kind_length_and_force(shown, settle, monkeypatch):
    texts = []
    monkeypatch.setattr(QToolTip, "showText", lambda at, text, widget: texts.append(text))
    assert settle(lambda: bool(shown.views.met[0]._places))
    layer, canvas = shown.views.met[0], shown.views.panes[0].canvas
    mark = next(mark for mark, place in layer._places.items() if place.kind == "bone")
    at = canvas.pixel_at(mark.x(), mark.y()).toPoint()
    scene = shown.views.scene
    x, y = scene.pixels(np.array([RIB_MM]))[0]
    for widget, place in ((canvas, at), (scene, QPoint(round(x), round(y)))):
        event = QHelpEvent(QEvent.Type.ToolTip, place, widget.mapToGlobal(place))
        QApplication.sendEvent(widget, event)
    assert len(texts) == 2
    assert all("rib (bone)" in text and "9.4 N" in text for text in texts)


@pytest.mark.long("journey")
def test_an_attempt_that_met_nothing_has_no_marks_of_the_one_before(shown, settle):
    volume = shown.views.viewing.volume
    shown.show_review(attempted(volume))
    shown.views.show_ct(volume)
    settle()
    assert not any(layer._places for layer in shown.views.met)
    x, y = shown.views.scene.pixels(np.array([RIB_MM]))[0]
    assert shown.views.met_scene.at(x, y) is None


@pytest.mark.long("journey")
def test_published_odds_are_folded_away_until_somebody_wants_them(shown, settle):
    odds = shown.published
    shown.fold.setChecked(True)
    assert odds.isVisibleTo(shown)
    assert not odds.lines.isVisibleTo(odds)
    odds.button.click()
    assert odds.lines.isVisibleTo(odds)
    assert "25.9 % of lung biopsies" in odds.lines.text()
    assert "PMC7362905" in odds.lines.text()
    shown.show_review(attempted(shown.views.viewing.volume))
    assert not odds.isVisibleTo(shown)
