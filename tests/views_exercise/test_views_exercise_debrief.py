import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pyqtgraph as pg
import pytest
from PySide6.QtCore import QPointF, QRectF, QSizeF
from PySide6.QtWidgets import QApplication, QPushButton
from views_exercise_attempts import placed_plan, review, score

from app.core.disclaimer import DISCLAIMER
from app.core.events import Event
from app.exercises.drill import DrillKind, DrillPart
from app.planning.judged import JudgedPlan
from app.scoring.conditions import Conditions
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.pass_mark import SetMark
from app.scoring.result import judge
from app.scoring.risks import RiskMark
from app.scoring.rows import Row, ScoreRules
from app.session.curves import Curves
from app.session.facts import plan_record
from app.session.next_exercise import Proposal, ProposalReason
from app.session.recording import Inputs, Recording
from app.session.review import Correction, Span, TimeMark, marks, only_measured, spans
from app.session.review import review as review_of
from app.session.samples import Samples
from app.views.debrief.card import costs, drill_title
from app.views.debrief.curves import CurvesView, PhaseLabel, curves_of, peaks, time_end, value_range
from app.views.debrief.page import DebriefPage, date_text
from app.views.debrief.path_view import force_place
from app.views.debrief.report import polylines, report_bytes, ticks, write_report
from app.views.debrief.score_words import (
    facts_of,
    number,
    points_words,
    row_texts,
    short_words,
    verdict,
)
from app.views.exercise.briefing import AttemptsLeft
from app.views.exercise.pad_canvas import PadArea, is_inside
from app.views.kit import theme
from app.views.kit.language import use_language


@pytest.fixture
def page(qt):
    widget = DebriefPage()
    widget.resize(1400, 900)
    yield widget
    widget.close()
    widget.deleteLater()


def empty() -> Curves:
    nothing = np.empty(0)
    return Curves(nothing, nothing, nothing, nothing, nothing, nothing)


def column(page, index):
    return [page.table.item(row, index).text() for row in range(page.table.rowCount())]


def test_the_table_shows_value_band_points_and_weight_of_every_metric(page):
    shown = review()
    page.show_review(shown)
    assert page.table.rowCount() == len(shown.score.rows)
    assert column(page, 1)[:4] == ["2.40 mm", "-0.90 mm", "2.70°", "1.72"]
    assert column(page, 2)[:4] == ["✔ good", "★ expert", "▲ pass", "✖ fail"]
    points = [float(text.split(" / ")[0]) for text in column(page, 3) if "/" in text]
    assert sum(points) == pytest.approx(shown.score.total, abs=0.2)
    assert "held" in page.table.item(page.table.rowCount() - 1, 0).toolTip()
    for row, name in enumerate(column(page, 0)):  # a name may be cut: it is whole there
        assert page.table.item(row, 0).toolTip().startswith(f"{name}\n")


def test_structures_of_risk_are_told_worst_first_with_a_sign_and_words(page):
    risks = (
        RiskMark("lung", 5.0, 18.4, 31.0, 70.0),
        RiskMark("portal vein", 5.0, 3.2, 24.0, 61.0),
        RiskMark("gallbladder", 3.0, -1.4, 31.0, 70.0),
    )
    page.show_review(review(risks=risks, origin=1.0))
    assert page.risks.text().splitlines()[1:] == [
        "✖ gallbladder: needle inside, 1.4 mm deep, at 0:30 (limit 3 mm)",
        "▲ portal vein: 3.2 mm, at 0:23: nearer than 5 mm",
        "✔ lung: 18.4 mm, at 0:30 (limit 5 mm)",
    ]
    assert not page.risks.isHidden()
    plain = len(report_bytes(review()))
    assert len(report_bytes(review(risks=risks))) > plain
    page.show_review(review())
    assert page.risks.isHidden()


def test_passed_not_passed_void_and_unscored_are_told_apart_in_words():
    failed = review(
        score=score().recomputed(rules=score().rules.model_copy(update={"pass_mark": 99.0}))
    )
    verdicts = [
        verdict(r) for r in (review(), failed, review(score=score(void=True)), review(score=None))
    ]
    assert [v[1] for v in verdicts] == ["✔ Passed", "✖ Not passed", "▲ Void", "–"]
    assert "99" in verdicts[1][2]
    assert "aborted" in verdicts[2][2]
    assert len({v[0] for v in verdicts}) == 4


@pytest.mark.long("journey")
@pytest.mark.parametrize(("above", "word"), [(-2.0, "✔ Passed"), (2.0, "✖ Not passed")])
def test_a_score_within_the_error_of_the_mark_says_so_on_either_side(above, word):
    points = round(score().total + above, 1)
    set_by = {"method": "angoff", "points": points, "standard_error": 1.0, "people": 5}
    for error, near in ((4.0, True), (1.0, False), (None, False)):
        mark = SetMark.model_validate(set_by | {"score_error": error})
        rules = score().rules.model_copy(update={"pass_mark": points, "mark": mark})
        said = verdict(review(score=score().recomputed(rules=rules)))
        assert said[1] == word
        assert ("Within the error of measurement of the mark" in said[2]) is near
        assert report_bytes(review(score=score().recomputed(rules=rules)))


def test_a_void_attempt_is_not_judged_and_what_can_be_done_is_said(page):
    shown = review(score=score(void=True))
    page.show_review(shown)
    assert not any("expert" in text or "/" in text for k in (2, 3) for text in column(page, k))
    assert column(page, 1)[0] == "2.40 mm"
    assert page.card.total.text() == "not scored"
    assert page.card.reason.text().startswith("The attempt was aborted: student. It does not count")
    assert "try again" in page.card.reason.text()
    lost = score().recomputed(rules=score().rules.model_copy(update={"minimum_tracking": 99.0}))
    assert "both cameras see the marker" in verdict(review(score=lost))[2]


@pytest.mark.parametrize("time", [0.5, 30.0, 63.5])
def test_what_is_written_at_an_event_is_not_cut_at_the_edge(qt, page, time):
    message = "the control loop has missed its deadline three times in a row"
    page.resize(1180, 760)
    page.show()
    page.show_review(review(marks=(TimeMark(time, "abort", message), TimeMark(time, "scan", "2"))))
    for _ in page.curves._curves:
        page.curves._draw_next()
    qt.processEvents()
    plot = page.curves._plots[0]
    area = plot.getViewBox().sceneBoundingRect()
    texts = [i for i in plot.items if isinstance(i, pg.TextItem) and i.toPlainText()[0] in "!▼"]
    assert len(texts) == 2
    for text in texts:
        box = text.mapRectToScene(text.boundingRect())
        assert area.left() - 1 <= box.left()
        assert box.right() <= area.right() + 1
    assert texts[0].toPlainText().endswith("…")
    assert texts[0].toolTip() == message


def test_the_page_says_it_is_for_training_only(page):
    labels = [w.text() for w in page.findChildren(type(page._title))]
    assert DISCLAIMER in labels


def test_the_buttons_hand_over_the_attempt_shown(page):
    got = []
    page.report_requested.connect(got.append)
    page.export_requested.connect(got.append)
    page.report.click()
    assert got == []
    shown = review()
    page.show_review(shown)
    page.report.click()
    page.export.click()
    assert got == [shown, shown]
    assert {b.text() for b in page.findChildren(QPushButton)} >= {"Again", "Sessions"}


def test_the_pointer_reads_every_curve_and_the_state(qt):
    view = CurvesView()
    view.resize(900, 700)
    view.show_review(review())
    text = view.read_out(20.0)
    assert text.startswith("20.0 s")
    for word in ("Inserting", "depth", "off the path", "angle", "force", "mm", "°", "N"):
        assert word in text
    assert "–" in view.read_out(30.4)
    view._hover(QPointF(450.0, 300.0))
    assert all(cursor.isVisible() for cursor in view._cursors)
    view.deleteLater()


def test_a_pen_has_no_curve_of_the_force_and_the_next_robot_has_one_again(qt):
    view = CurvesView()
    view.resize(900, 700)
    for renders, count in ((True, 4), (False, 3), (True, 4)):
        view.show_review(replace(review(), renders=renders))
        for _ in range(count + 1):
            view._draw_next()
        assert len(view._plots) == count
        assert ("force" in view.read_out(20.0)) is renders
        bottom = view._plots[-1].getAxis("bottom")
        assert bottom.isVisible()
        assert bottom.labelText
    assert not view.grab().isNull()
    view.deleteLater()


@pytest.mark.parametrize("size", [(900, 700), (300, 260)])
def test_an_attempt_of_a_tenth_of_a_second_fills_a_time_axis_in_plain_seconds(qt, size):
    full = review().curves
    names = ("depth", "lateral", "remaining", "angle", "felt")
    parts = {name: getattr(full, name)[:5] for name in names}
    short = Curves(time=np.linspace(0.0, 0.1, 5), **parts)
    view = CurvesView()
    view.resize(*size)
    view.show_review(review(curves=short, spans=(Span("aligning", 0.0, 0.1),), marks=()))
    for _ in range(5):
        view._draw_next()
    view.show()
    qt.processEvents()
    for plot in view._plots:
        assert plot.viewRange()[0] == pytest.approx([0.0, 0.1], abs=0.01)
    view._plots[2].setXRange(0.02, 0.06, padding=0.0)  # the axis is one: all plots go along
    assert all(plot.viewRange()[0] == pytest.approx([0.02, 0.06]) for plot in view._plots)
    axis = view._plots[-1].getAxis("bottom")
    assert axis.labelText == "Time [s]"
    assert "0.001" not in axis.label.toPlainText()
    assert axis.autoSIPrefixScale == 1.0
    assert view.read_out(0.05).startswith("0.050 s")
    view.deleteLater()


def test_an_attempt_without_samples_is_shown_and_printed(page):
    shown = review(curves=empty(), tip=np.empty((0, 3)), spans=(), marks=(), score=None)
    page.show_review(shown)
    assert not page.grab().isNull()
    assert report_bytes(shown).startswith(b"%PDF")
    assert page.curves.read_out(1.0) == ""


def test_an_attempt_that_was_never_measured_is_shown(page):
    some = review()
    blank = np.full_like(some.curves.depth, np.nan)
    figures = Curves(some.curves.time, blank, blank, blank, blank, blank)
    shown = review(curves=figures, tip=np.full((len(blank), 3), np.nan))
    page.show_review(shown)
    assert not page.grab().isNull()
    assert np.isnan(shown.track()).all()
    assert report_bytes(shown).startswith(b"%PDF")


def test_the_track_is_where_the_pad_would_draw_the_tip():
    shown = review()
    track, frame, scale = shown.track(), shown.frame, shown.scale
    for i in (0, 700, 3000):
        offset = frame.offset(shown.tip[i], shown.placed.p_entry)
        assert np.allclose(track[i], scale.place_of_offset(offset), atol=1e-12)
    assert np.isnan(track[1510]).all()
    assert np.nanmax(np.hypot(*track.T)) <= 1.0


def test_a_tip_on_the_path_is_in_the_middle():
    placed = placed_plan()
    tip = placed.p_entry + np.linspace(0.0, 0.05, 5)[:, None] * placed.axis
    assert np.allclose(review(tip=tip).track(), 0.0, atol=1e-12)


def test_a_depth_that_was_only_the_models_is_a_gap_and_the_angle_is_kept():
    figures = review().curves
    measured = np.ones(len(figures.time), dtype=bool)
    measured[10:20] = False
    kept = only_measured(figures, measured)
    for values in (kept.depth, kept.lateral, kept.remaining):
        assert np.isnan(values[10:20]).all()
        assert np.isfinite(values[:10]).all()
    assert np.array_equal(kept.angle, figures.angle, equal_nan=True)


def test_rings_follow_the_tolerances_of_the_attempt():
    assert review().rings == pytest.approx((0.002, 0.005))
    assert review(score=None).rings == pytest.approx((0.002, 0.005))
    bands = DEFAULT_TOLERANCES["lateral_error"].model_copy(update={"expert": 1.0})
    judged = {"lateral_error": bands}
    assert review(tolerances=judged).rings == pytest.approx((0.001, 0.005))
    assert review(tolerances=judged, score=None).rings == pytest.approx((0.001, 0.005))


def test_points_that_are_withheld_say_why_in_place_of_not_scored():
    assert verdict(review(score=None, reason="")).count("This attempt was not scored.") == 1
    colour, sign, why = verdict(review(score=None, reason="altered after it was signed: x"))
    assert (sign, why) == ("–", "Altered after it was signed: x.")
    assert colour == theme.TEXT_DIM


def test_spans_cover_the_whole_time_without_gaps():
    time = np.arange(6.0)
    found = spans(time, np.array(["a", "a", "b", "b", "a", "a"]))
    assert [(s.state, s.start, s.end) for s in found] == [("a", 0, 2), ("b", 2, 4), ("a", 4, 5)]
    assert spans(np.empty(0), np.empty(0, dtype=np.str_)) == ()


def test_scans_are_numbered_and_other_events_left_out():
    events = [Event(11.0, "scan", "x"), Event(12.0, "state", "y"), Event(13.5, "scan", "z")]
    assert [(m.time, m.label) for m in marks(events, 10.0, ("scan",))] == [(1.0, "1"), (3.5, "2")]


def test_the_report_is_a_pdf_of_two_pages_and_names_no_patient(qt, tmp_path):
    path = tmp_path / "report.pdf"
    write_report(review(), path)
    data = path.read_bytes()
    assert data.startswith(b"%PDF")
    assert data.count(b"/Type /Page\n") == 2
    assert b"PatientName" not in data


def test_a_report_survives_any_text(qt):
    shown = review(
        exercise="A" * 300,
        reason="B" * 2000,
        student="ß–★",
        problems=("C" * 500,) * 4,
        state="aborted",
    )
    assert report_bytes(shown).startswith(b"%PDF")


def test_thinning_keeps_every_peak_and_gap():
    time = np.linspace(0.0, 60.0, 60_000)
    values = np.zeros_like(time)
    values[31_234] = 7.0
    values[100:200] = np.nan
    parts = polylines(time, values)
    assert len(parts) == 2
    assert sum(len(part) for part in parts) < 4000
    assert max(part[:, 1].max() for part in parts) == 7.0
    assert polylines(time, np.full_like(time, np.nan)) == []


@pytest.mark.parametrize("span", [(0.0, 1.0), (-3.0, 97.0), (0.0, 1e-9), (-1e6, 1e6), (2.0, 2.0)])
def test_ticks_are_few_round_and_inside(span):
    found = ticks(*span)
    assert len(found) <= 7
    assert all(span[0] - 1e-12 <= value <= span[1] + 1e-12 for value in found)


def test_the_range_of_a_plot_holds_its_line_and_is_never_empty():
    for curve in curves_of(review()):
        low, high = value_range(curve)
        assert low < high
        assert curve.line is None or low < curve.line < high
    flat = SimpleNamespace(values=np.array([np.nan]), line=None)
    low, high = value_range(flat)
    assert low < high


def test_numbers_have_three_digits():
    assert [number(v) for v in (0.031, -0.9, 12.34, 250.4)] == ["0.03", "-0.90", "12.3", "250"]
    assert [number(v) for v in (-0.004, -0.0, 0.0)] == ["0.00"] * 3


def test_a_date_that_is_none_stands_as_it_is():
    assert date_text("yesterday") == "yesterday"
    assert date_text("2026-11-21T10:15:00.000+00:00").startswith("2026-11-2")


def test_bands_differ_by_symbol_as_well_as_colour():
    texts = [row_texts(row, score()) for row in score().rows[:4]]
    assert len({t.band[0] for t in texts}) == 4
    assert texts[3].colour == theme.BAD


def recording(**changes):
    """A record as it is read back: two samples from the cameras, one from the model."""
    placed = placed_plan()
    nothing = np.zeros((3, 3))
    samples = Samples(
        time=np.array([5.0, 5.1, 5.2]), state=np.array(["aligning", "inserting", "inserting"]),
        valid=np.ones(3, dtype=bool), depth_source=np.array(["tracked", "held", "model"]),
        depth=np.array([0.0, 0.01, 0.09]), tip=np.tile(placed.p_entry, (3, 1)),
        axis=np.tile(placed.axis, (3, 1)), target=np.tile(placed.p_target, (3, 1)),
        felt=nothing, hub=nothing, guide=nothing, measured=np.full(3, np.nan),
    )  # fmt: skip
    values = {
        "path": Path("s1.mcap"), "complete": True, "problems": (),
        "metadata": MappingProxyType({
            "session": {"id": "s1", "student": "student-07", "started": "2026-11-21T10:15:00Z"},
            "exercise": {"id": "x", "title": "First insertion"}, "plan": plan_record(placed),
            "result": {"state": "ended", "duration_s": "0.2"},
        }),
        "attachments": MappingProxyType({
            "score.json": score().to_json().encode(),
            "device.json": b'{"limits": {"hand_force": 4.0}}',
        }),
        "events": (Event(5.1, "scan", "control scan 1"),), "samples": samples,
        "inputs": Inputs((), np.empty((0, 0)), 0),
    }  # fmt: skip
    return Recording(**(values | changes))


def test_a_record_is_gathered_with_score_marks_limits_and_gaps():
    shown = review_of(recording())
    assert (shown.id, shown.student, shown.exercise) == ("s1", "student-07", "First insertion")
    assert shown.score.total != pytest.approx(score().total)  # what was written is not believed
    assert "not what its samples give: total: 84.8333 written" in shown.problems[0]
    assert shown.force_limit == 4.0
    assert [(m.kind, round(m.time, 6)) for m in shown.marks] == [("scan", 0.1)]
    assert np.isfinite(shown.curves.depth).tolist() == [True, True, False]
    assert shown.scans == 1


def test_a_stored_score_that_cannot_be_read_becomes_a_problem_line():
    shown = review_of(recording(attachments=MappingProxyType({"score.json": b"{}"})))
    assert shown.score is not None  # it is computed from the samples
    assert "score.json: not a stored score" in shown.problems[0]
    assert shown.force_limit == 5.0


@pytest.mark.parametrize("large", [False, True])
def test_the_name_of_a_level_stands_beside_that_of_its_curve(qt, large):
    view = CurvesView()
    try:
        theme.apply_theme(qt, size=theme.LARGE if large else 1.0)
        view.resize(600, 640)
        view.show_review(review())
        while len(view._cursors) < len(view._curves):
            view._draw_next()
        view.show()
        qt.processEvents()
        levels = 0
        for plot, curve in zip(view._plots, view._curves, strict=True):
            texts = [one for one in plot.getViewBox().childItems() if isinstance(one, pg.TextItem)]
            (title,) = [one for one in texts if one.toPlainText() == curve.title]
            for line in plot.items:
                if isinstance(line, pg.InfiniteLine) and getattr(line, "label", None):
                    levels += 1
                    place = line.label.mapRectToScene(line.label.boundingRect())
                    assert not place.intersects(title.mapRectToScene(title.boundingRect()))
                    assert plot.sceneBoundingRect().right() >= place.right()
        assert levels == 2
    finally:
        theme.apply_theme(qt)
        view.deleteLater()


def test_a_long_curve_is_drawn_by_its_extremes_without_losing_a_peak_or_a_gap():
    time = np.arange(180_000) / 50.0
    values = np.sin(time)
    values[77_777] = 9.0
    values[100_000:120_000] = np.nan
    thin_time, thin = peaks(time, values)
    assert len(thin) < 2_500
    assert (np.diff(thin_time) >= 0.0).all()
    assert np.nanmax(thin) == 9.0
    assert np.isnan(thin[(thin_time > 2010.0) & (thin_time < 2390.0)]).all()
    assert (thin_time[0], thin_time[-1]) == (time[0], pytest.approx(time[-1], abs=4.0))
    short = np.arange(3999.0)
    assert peaks(short, short)[0] is short


def test_the_page_is_there_before_its_curves_and_each_plot_has_its_turn(qt):
    view = CurvesView()
    view.resize(900, 700)
    turns = []
    view.drawn.connect(lambda: turns.append(len(view._cursors)))
    for _ in range(2):  # the second attempt reuses the plots
        view.show_review(review())
        assert len(view._cursors) == 0
        for count in (1, 2, 3, 4):
            view._draw_next()
            assert len(view._cursors) == count
        view._draw_next()
    assert turns == [4, 4]
    assert len(view._plots) == 4
    assert not view.grab().isNull()
    view.deleteLater()


def test_curves_cannot_be_zoomed_or_moved_to_nonsense_and_all_is_shown_again(qt):
    view = CurvesView()
    view.resize(800, 600)
    view.show_review(review())
    for _ in range(8):
        view._draw_next()
    end = view._review.curves.time[-1]
    box = view._plots[1].getViewBox()
    for _ in range(40):
        box.scaleBy((0.5, 0.5))
    low, high = box.viewRange()[0]
    assert high - low >= min(0.5, end) - 1e-6
    for _ in range(40):
        box.scaleBy((2.0, 2.0))
        box.translateBy((end, 0.0))
    low, high = box.viewRange()[0]
    assert -0.05 * end < low < high < 1.05 * end
    box.setXRange(0.2 * end, 0.4 * end)
    view.show_all()
    for plot in view._plots:
        low, high = plot.getViewBox().viewRange()[0]
        assert low <= 0.0 < end <= high


def test_what_cost_points_is_said_with_the_attempts_own_numbers_and_its_reasons(page):
    shown = replace(review(), correction=Correction(0.06, np.radians(3.0), 0.02, 0.08))
    worst = shown.score.losses[0][1]
    shown = replace(shown, reasons={worst.name: ("You left the line.", "It was askew.")})
    first, *more = costs(shown)
    assert len(more) <= 1
    assert worst.label in first.loss
    assert "or less costs none" in first.loss
    assert first.reasons[:2] == ("You left the line.", "It was askew.")
    turned = "You turned the needle by 3.0° at 60 mm depth. The same turn at 20 mm takes 8 % of"
    told = [text for cost in (first, *more) for text in cost.reasons]
    assert sum(text.startswith(turned) for text in told) == 1  # and no reason twice
    page.show_review(shown)
    lines = page.card.words.splitlines()
    assert first.loss in lines
    assert "•  You left the line." in lines


@pytest.mark.parametrize(("depth_mm", "told"), [(1.0, False), (5.2, False), (8.0, True)])
def test_that_the_target_was_missed_is_said_where_that_holds_all_else_back(depth_mm, told):
    bands = DEFAULT_TOLERANCES["depth_error"]  # passes up to 5 mm, worth nothing from 10 mm on
    rows = (
        Row("depth_error", "Depth error", "mm", depth_mm, "", bands),
        Row("total_time", "Total time", "s", 400.0, "", bands),
    )
    first, *more = costs(review(score=judge(rows, ScoreRules())))
    missed = "The target was missed: all else counts only 40 %."  # (10 - 8) of (10 - 5) mm
    assert (missed in first.reasons) == told
    texts = [text for cost in (first, *more) for text in cost.reasons if "missed" in text]
    assert len(texts) == told


def test_the_card_offers_the_drill_and_begins_exactly_that(page):
    page.show_review(review())
    assert not page.card.drill.isVisibleTo(page)
    asked = []
    page.drill_wanted.connect(asked.append)
    for kind in DrillKind:
        page.offer_drill(kind)
        assert page.card.drill.isVisibleTo(page)
        assert drill_title(kind) in page.card.drill.accessibleName()
        assert "no course" in page.card.drill.accessibleDescription()
        page.card.drill.click()
    assert asked == list(DrillKind)
    page.offer_drill(DrillKind.REPEAT, rounds=3)
    assert "Round 3 of 10 is done" in page.card.practise.text()
    page.offer_drill(None)
    assert not page.card.drill.isVisibleTo(page)


def test_that_one_begins_aligned_is_said_only_of_a_simulated_hand(page):
    page.show_review(review())
    page.offer_drill(DrillKind.DEPTH, aligned=True)
    assert "you begin aligned" in page.card.practise.text()
    page.offer_drill(DrillKind.DEPTH)
    assert "aligned" not in page.card.practise.text()


@pytest.fixture(params=["en", "de", "fr"])
def language(qt, request):
    yield use_language(qt, request.param)
    use_language(qt, "en")


@pytest.mark.long("journey")
@pytest.mark.parametrize("size", [1.0, theme.LARGE])
def test_the_card_is_never_wider_than_its_column(qt, language, size):
    theme.apply_theme(qt, theme.DARK, size)
    page = DebriefPage()
    page.resize(1366, 768)
    page.show()
    column = page.card.parentWidget()
    for changes in ({}, {"drill": DrillPart(kind="depth", of="liver-01")}):
        page.show_review(replace(lost_all(-9.0), **changes))
        for kind in DrillKind:
            page.offer_drill(kind)
            qt.processEvents()
            card = page.card
            room = column.parentWidget().width()  # what of the column can be seen
            assert card.minimumSizeHint().width() <= room
            assert column.width() <= room
            for part in (card.verdict, card.total, card.drill):
                place = part.mapTo(card, part.rect().topRight()).x()
                assert place < card.width()
                words = part.fontMetrics().horizontalAdvance(part.text())
                assert part is card.drill or words <= part.width()  # whole, in one line
    page.close()
    page.deleteLater()
    theme.apply_theme(qt, theme.DARK)


def test_verdict_and_total_stand_side_by_side_where_there_is_room(page):
    page.show_review(review())
    page.show()
    for width, beside in ((700, True), (270, False), (700, True)):
        page.card.setParent(None)
        page.card.show()
        page.card.resize(width, 400)
        QApplication.processEvents()
        card = page.card
        assert (card.verdict.geometry().top() == card.total.geometry().top()) == beside
        assert card.width() == width


def lost_all(depth=-4.05):
    """An attempt that missed its target in depth, and with it nearly all points."""
    rows = tuple(
        replace(row, value=depth) if row.name == "depth_error" else row for row in score().rows
    )
    return review(score=replace(score(), rows=rows).recomputed())


@pytest.mark.parametrize(("depth", "words"), [(-4.05, "4.05 mm short"), (4.05, "4.05 mm too deep")])
def test_the_depth_error_is_told_by_its_size_and_in_words_to_which_side(depth, words):
    texts = [cost.loss for cost in costs(lost_all(depth))]
    (text,) = [text for text in texts if text.startswith("Depth error")]
    assert text.startswith(f"Depth error: {words} cost ")
    assert "or less costs none" in text


def test_no_value_is_told_with_a_sign_as_only_its_size_counts():
    rows = tuple(
        replace(row, value=-abs(row.value)) if row.tolerance else row for row in score().rows
    )
    for cost in costs(review(score=replace(score(), rows=rows).recomputed())):
        assert not re.search(r"[-−]\d", cost.loss)


def test_the_points_that_are_told_make_up_what_is_missing(page):
    for depth in np.linspace(-8.0, 8.0, 33):
        shown = lost_all(float(depth))
        page.show_review(shown)
        told = re.findall(r"cost (\d+) point", page.card.words)
        missing = 100 - int(page.card.total.text().split()[0])
        assert sum(map(int, told)) == pytest.approx(missing, abs=1)
        rest = [line for line in page.card.words.splitlines() if line.startswith("The rest cost ")]
        lost = [points for points, _ in shown.score.losses]
        if sum(lost[2:]) > 2.0:
            assert sum(map(int, told)) == missing
            assert len(rest) == 1
    page.show_review(review(score=all_expert(score())))
    assert "rest" not in page.card.words


def test_where_a_drill_is_offered_nothing_else_is_said_to_come_next(page):
    page.show_review(lost_all(-9.0))
    again = Proposal("liver-01", "Liver", ProposalReason.AGAIN)
    page.show_proposal(again)
    assert page.proposal.isVisibleTo(page)
    page.offer_drill(DrillKind.DEPTH)
    assert page.card.drill.isVisibleTo(page)
    assert not page.proposal.isVisibleTo(page)
    page.offer_drill(None)
    assert page.proposal.isVisibleTo(page)
    page.show_review(review(score=all_expert(score())))  # passed: what comes next comes first
    page.show_proposal(Proposal("liver-02", "Liver", ProposalReason.LEVEL, level=2))
    page.offer_drill(DrillKind.DEPTH)
    assert page.proposal.isVisibleTo(page)


def test_where_no_attempt_is_left_again_is_shut_and_says_why(page):
    page.show_review(review(score=all_expert(score())))
    why = "the course allows 3 attempts, and 3 were made"
    page.show_proposal(Proposal("", "", ProposalReason.CLOSED, closed=why))
    assert not page.retry.isEnabled()
    assert page.retry.property("role") != "primary"
    assert why in page.retry.toolTip()
    page.show_proposal(Proposal("liver-01", "Liver", ProposalReason.AGAIN))
    assert page.retry.isEnabled()
    assert page.retry.property("role") == "primary"
    assert not page.retry.toolTip()


def test_the_metrics_are_folded_until_somebody_wants_them(page):
    page.show_review(review())
    assert not page.table.isVisibleTo(page)
    page.fold.click()
    assert page.table.isVisibleTo(page)
    page.show_review(review())
    assert page.table.isVisibleTo(page)


def test_a_drill_is_named_and_neither_passed_nor_failed(page):
    shown = replace(review(), drill=DrillPart(kind="depth", of="liver-01"))
    page.show_review(shown)
    assert page._title.text().startswith("Drill, depth only: ")
    assert "ass" not in page.card.verdict.text()


def test_points_of_100_that_are_told_are_those_that_are_missing():
    shown = review()
    lost = sum(points for points, _ in shown.score.losses)
    assert lost == pytest.approx(100.0 - shown.score.total, abs=len(shown.score.rows))


def test_who_lost_nothing_is_told_so_and_who_was_not_judged_nothing(page):
    assert costs(review(score=all_expert(score()))) == ()
    assert costs(review(score=score(void=True))) == ()
    assert costs(review(score=None)) == ()
    page.show_review(review(score=all_expert(score())))
    assert page.card.words == "Nothing cost points."
    nearly = replace(all_expert(score()), total=99.4)
    page.show_review(review(score=nearly))
    assert page.card.words == "Nothing cost as much as a point."
    page.show_review(review(score=None))
    assert page.card.words == ""


def all_expert(judged):
    rows = tuple(
        replace(row, value=row.tolerance.expert) if row.tolerance else row for row in judged.rows
    )
    return replace(judged, rows=rows).recomputed()


def test_a_model_that_was_changed_during_the_attempt_is_told_beside_the_score(page):
    under = Conditions("x", models=("lateral_tissue: winkler",))
    words = "▲ model changed meanwhile: lateral tissue: winkler"
    assert words in short_words(under)  # in the list, and in the debrief's line
    page.show_review(replace(review(), conditions=under))
    assert words in page.conditions.text()
    assert ("Models changed meanwhile", "lateral tissue: winkler") in facts_of(under)
    assert "changed" not in short_words(replace(under, models=()))


def test_one_point_is_said_as_one():
    assert points_words(1.2) == "1 point"
    assert points_words(11.6) == "12 points"
    assert AttemptsLeft(1, 0).words() == "The one attempt is left."
    assert AttemptsLeft(1, 1).words() == "The one attempt is used."
    assert AttemptsLeft(1).words() == "1 attempt is allowed."
    assert AttemptsLeft(3, 1).words() == "2 of 3 attempts are left."


def test_a_limit_that_was_kept_by_far_is_not_said_to_be_uncertain():
    kept = Row("risk_breach", "Too near to risk", "mm", 0.0, sd=2.48)
    near = Row("risk_distance", "Distance from risk", "mm", 19.9, sd=2.48)
    broken = replace(kept, value=1.5)
    texts = [row_texts(row, score()).value for row in (kept, near, broken)]
    assert texts == ["0.00 mm", "19.9 ± 2.48 mm", "1.50 ± 2.48 mm"]


def test_what_is_before_an_attempt_is_not_called_withdrawing(qt):
    view = CurvesView()
    view.show_review(review(spans=(Span("withdrawing", 0.0, 1.5), Span("inserting", 1.5, 3.0))))
    assert "Before the start" in view.read_out(0.5)
    assert "Withdrawing" not in view.read_out(0.5)
    assert "Inserting" in view.read_out(2.0)


@pytest.mark.parametrize("width", [300, 420, 900])
def test_names_of_phases_stand_within_their_phases_and_never_on_each_other(qt, width):
    states = ("withdrawing", "aligning", "inserting", "holding")
    view = CurvesView()
    view.resize(width, 500)
    view.show()
    end = time_end(review().curves.time)
    ends = [share * end for share in (0.0, 0.15, 0.2, 0.9, 1.0)]
    view.show_review(review(spans=tuple(map(Span, states, ends[:-1], ends[1:]))))
    for _ in range(30):
        QApplication.processEvents()
    names = [item for item in view._plots[0].items if isinstance(item, PhaseLabel)]
    assert len(names) == len(states)
    boxes = sorted(
        (box.left(), box.right())
        for name in names
        if name.isVisible()
        for box in [name.mapRectToScene(name.boundingRect())]
    )
    assert boxes
    assert all(left[1] <= right[0] + 1.0 for left, right in pairwise(boxes))
    view.hide()


def test_a_void_attempt_tells_what_the_students_plan_is_worth(page):
    plan = JudgedPlan(64.0, 88.0, 21.0, 4.5, nearest="hepatic vein", nearest_mm=61.0)
    page.show_review(review(score=score(void=True), planned=plan))
    words = page.card.words
    assert "Your plan itself: 64 of 100." in words
    assert "4.5 mm of hepatic vein" in words
    page.show_review(review(score=score(), planned=plan))
    assert "Your plan itself" not in page.card.words
    page.show_review(review(score=score(void=True)))
    assert "Your plan itself" not in page.card.words


def test_numbers_of_the_axes_have_the_decimal_sign_of_the_language(qt):
    use_language(qt, "de")
    try:
        view = CurvesView()
        view.show_review(review())
        while len(view._cursors) < len(view._curves):
            view._draw_next()
        for plot in view._plots:
            for side in ("left", "bottom"):
                assert plot.getAxis(side).tickStrings([0.5, 1.0], 1.0, 0.5) == ["0,5", "1,0"]
    finally:
        use_language(qt, "en")


def test_all_metrics_stand_in_the_page_without_scrolling_in_the_table_too(page):
    """Seen: a scroll bar in the table, beside that of the page."""
    page.resize(1366, 700)
    page.fold.setChecked(True)
    page.show_review(review())
    page.table.set_detailed(True)
    page.show()
    QApplication.processEvents()
    assert page.table.rowCount() > 5
    assert page.table.verticalScrollBar().maximum() == 0
    last = page.table.visualItemRect(page.table.item(page.table.rowCount() - 1, 0))
    assert last.bottom() <= page.table.viewport().height()


@pytest.mark.parametrize("angle_deg", range(0, 360, 15))
@pytest.mark.parametrize("radius", [60.0, 95.0, 200.0])
def test_the_size_of_a_force_covers_no_mark_and_no_other_words(angle_deg, radius):
    """Seen: "0.4 N" over the needle's tip and a ring's size, in a small pane."""
    area, turn = PadArea(QPointF(250.0, 250.0), radius), np.radians(angle_deg)
    away = QPointF(float(np.cos(turn)), float(np.sin(turn)))
    taken = [QRectF(240.0, 240.0, 18.0, 18.0), QRectF(262.0, 214.0, 44.0, 14.0)]
    size = QSizeF(38.0, 14.0)
    for reach in (0.0, 0.3, 0.9):
        end = area.centre + reach * radius * away
        box = force_place(area, end, size, taken)
        assert (box.width(), box.height()) == (38.0, 14.0)
        assert not any(box.intersects(other) for other in taken)
        assert is_inside(box, area)
