"""A German window: numbers have a comma, and reasons and titles of the rooms below are German."""

from dataclasses import replace
from datetime import date
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QTranslator
from PySide6.QtGui import QFont, QFontMetrics
from views_exercise_attempts import review, score

from app.core.events import Event
from app.core.messages import sentence
from app.core.paths import resources
from app.imaging.header_reading import file_headers
from app.scoring.conditions import Assistance
from app.scoring.met import Met
from app.scoring.result import judge
from app.scoring.risks import RiskMark
from app.scoring.rows import ScoreRules
from app.session.abort_reasons import (
    BY_USER,
    OTHER_PATIENT,
    TRAINER_CLOSED,
    WINDOW_CLOSED,
    abort_words,
    known_reason,
)
from app.session.control_scan import TEACHING_ESTIMATE
from app.session.course import Course, CourseItem, CourseStanding, why_not
from app.session.next_exercise import Proposal, ProposalReason
from app.session.snapshot import NextStep, StepKind
from app.session.timeline import marks
from app.views.debrief.card import costs
from app.views.debrief.page import facts
from app.views.debrief.score_words import (
    assistance_words,
    dial_text,
    met_lines,
    number,
    proposal_words,
    risk_line,
    row_texts,
    verdict,
    with_unit,
)
from app.views.debrief.sessions import exercise_text
from app.views.exercise.assistance_dial import apart
from app.views.exercise.status import MessageList
from app.views.exercise.steps import amount, step_words
from app.views.kit import text, theme
from app.views.kit.coordinates import lps_words
from app.views.kit.text import kept_text, tr, translated
from app.views.people.pages import standing_words
from tools.translations import faults

GERMAN = {
    "0.5": "0,5",
    "the attempt was aborted: {trajectory_aborted}": "der Versuch wurde abgebrochen: "
    "{trajectory_aborted}",
    "{bone} touched at {depth}": "{bone} bei {depth} berührt",
    "{met}, {force:.1f} N": "{met}, {force:.1f} N Kraft",
    "first pass {exercise}": "zuerst {exercise} bestehen",
    "First insertion": "Erster Einstich",
    "{a:.1f} of {b}": "{a:.1f} von {c}",
    "{a} mm": "{} mm",
    "{a} N": "{a.b} N",
}


class German(QTranslator):
    def translate(self, context, source, disambiguation=None, n=-1):
        return GERMAN.get(source)

    def isEmpty(self):
        return False


@pytest.fixture
def german(qt):
    translator = German()
    QCoreApplication.installTranslator(translator)
    text.begin_language(english=False)
    yield
    text.begin_language(english=True)
    QCoreApplication.removeTranslator(translator)
    translator.deleteLater()


def lines_of(shown):
    return [line for cost in costs(shown) for line in (cost.loss, *cost.reasons)]


def test_numbers_of_the_debrief_have_the_comma(german):
    assert [number(v) for v in (1.234, 12.34, 123.4)] == ["1,23", "12,3", "123"]
    assert with_unit(2.4, "mm", 0.3) == "2,40 ± 0,30 mm"
    dial = Assistance(0.7, 0.2, 0.7, 0.45)
    assert "0,45" in assistance_words(dial)
    assert "." not in assistance_words(dial) + dial_text(dial)
    shown = review()
    texts = [row_texts(row, shown.score) for row in shown.score.rows]
    assert not any("." in one.value + one.points + one.weight for one in texts)
    assert any("," in one.points for one in texts)
    assert "3,2 mm" in risk_line(RiskMark("vein", 2.5, 3.2, 24.0, 61.0), 1.0)
    assert not any("0." in line or "1." in line for line in lines_of(shown))


def test_numbers_of_the_next_step_and_of_places_have_the_comma(german):
    assert (amount(0.42), amount(3.7)) == ("0,4", "4")
    deeper = NextStep(StepKind.DEEPER, distance=0.0005)
    assert "0,5 mm" in step_words(deeper, by_mouse=False)
    assert lps_words((1.04, -2.06, 310.2)) == "L 1,0   A 2,1   S 310,2 mm"


@pytest.mark.parametrize("kind", [float, np.float64, np.float32])
def test_a_number_of_numpy_in_a_sentence_has_the_comma_too(german, kind):
    line = sentence("{n:.1f} mm", n=kind(2.5))
    assert line == "2.5 mm"
    assert translated(line) == "2,5 mm"


def test_why_an_attempt_is_void_is_said_in_the_language_of_the_window(german):
    reason = sentence("the attempt was aborted: {trajectory_aborted}", trajectory_aborted="Esc")
    void = judge(score().rows, ScoreRules(), reason)
    assert void.void_reason == "the attempt was aborted: Esc"
    assert verdict(review(score=void))[2].startswith("Der Versuch wurde abgebrochen: Esc. ")


def test_why_an_exercise_of_a_course_is_closed_is_said_in_the_language_of_the_window(german):
    items = (CourseItem(exercise="ribs"), CourseItem(exercise="lung"))
    course, day = Course(id="c", title="C", ordered=True, items=items), date(2026, 11, 20)
    why = why_not(course, "lung", [], day, {"ribs": "Rippen"})
    standing = CourseStanding(items[1], "Lunge", used=0, refusal=why)
    assert standing_words(standing, comes=False)[-1] == "zuerst Rippen bestehen"


def test_what_fails_an_attempt_is_said_in_the_language_of_the_window(german):
    rib = Met("bone", "rib", 12.0, 0.0, ((0, 0, 0), (0, 0, 0)), force_n=8.4)
    failed = judge(score().rows, ScoreRules(forbidden=("bone",)), met=(rib,))
    assert verdict(review(score=failed))[2] == "Rib bei 12,0 mm berührt, 8,4 N Kraft"
    assert "rib bei 12,0 mm berührt, 8,4 N Kraft" in met_lines(review(score=failed, met=(rib,)))[0]


@pytest.fixture
def shipped(german, monkeypatch):
    """The German that ships, in place of the few texts of these tests."""
    tree = ElementTree.parse(resources() / "translations" / "acus_de.ts")
    texts = {
        message.findtext("source"): message.findtext("translation")
        for message in tree.iter("message")
        if message.findtext("translation")
    }
    monkeypatch.setattr(f"{__name__}.GERMAN", texts)
    return texts


def test_the_next_exercise_names_the_metric_in_the_language_of_the_window(shipped):
    proposal = Proposal("a", "A", ProposalReason.AGAIN, "Angle error", 14.0)
    assert " Winkelfehler " in proposal_words(proposal)
    assert "Angle" not in proposal_words(proposal)


def test_who_aborted_an_attempt_is_said_in_the_language_of_the_window(shipped):
    reason = "by the user"  # as a record holds it
    (mark,) = marks([Event(3.0, "abort", f"aborted: {reason}")], 0.0, ("abort",))
    assert translated(mark.label) == "abgebrochen: vom Benutzer"
    assert mark.sign == "! aborted: by the user"  # as a table of the command line says it
    assert mark.sign_of(translated(mark.label)) == "! abgebrochen: vom Benutz…"
    assert translated(known_reason(reason)) == "vom Benutzer"
    assert known_reason("the hand let go") == "the hand let go"
    void = sentence("the attempt was aborted: {trajectory_aborted}",
                    trajectory_aborted=known_reason(reason))  # fmt: skip
    shown = verdict(review(score=judge(score().rows, ScoreRules(), void)))[2]
    assert "vom Benutzer" in shown
    assert "user" not in shown


@pytest.mark.parametrize("reason", [BY_USER, OTHER_PATIENT, WINDOW_CLOSED, TRAINER_CLOSED])
def test_each_reason_of_this_program_is_said_in_the_language_of_the_window(shipped, reason):
    recorded = str.__str__(reason)  # a record holds the text, and no sentence
    assert translated(recorded) == recorded
    assert translated(known_reason(recorded)) == shipped[recorded] != recorded
    assert translated(abort_words(f"aborted: {recorded}")) == f"abgebrochen: {shipped[recorded]}"


def test_a_message_of_the_attempt_is_said_in_the_language_of_the_window(shipped):
    messages = MessageList()
    messages.add_event(Event(3.0, "abort", abort_words(BY_USER)))
    assert messages.item(0).text().endswith("abgebrochen: vom Benutzer")
    messages.deleteLater()


def test_nobody_s_attempt_is_named_in_the_language_of_the_window(shipped):
    assert facts(review(student="anonymous")).startswith("anonym ")


def test_a_dose_says_in_the_language_of_the_window_that_it_is_an_estimate(shipped):
    assert tr(TEACHING_ESTIMATE) == "didaktischer Schätzwert"


def test_why_a_file_is_left_out_is_said_in_the_language_of_the_window(shipped, tmp_path):
    (tmp_path / "notes.txt").write_text("no picture " * 99)
    left_out = file_headers(tmp_path / "notes.txt")
    assert kept_text(left_out.reason) == "keine DICOM-Datei"
    assert kept_text(str.__str__(left_out.reason)) == "keine DICOM-Datei"  # by way of a process


def test_a_translation_with_other_names_is_not_shown_and_takes_nothing_down(german):
    assert tr("{a:.1f} of {b}", a=1.5, b=2) == "1,5 of 2"
    assert tr("{a} mm", a=3) == "3 mm"
    assert tr("{a} N", a=3) == "3 N"
    with pytest.raises(KeyError):
        tr("{nobody}", a=3)


def test_a_translation_with_another_conversion_or_a_field_without_name_is_a_fault():
    assert faults("{spec!r} is none", "{spec} ist keines")
    assert faults("{n:.1f} mm", "{n:.2f} mm")
    assert faults("{n} mm", "{} mm")
    assert faults("all", "alle {}")
    assert faults("{a!r} of {b:.1f}", "{b:.1f} von {a!r}") == []


def test_a_gate_that_costs_something_is_not_told_as_all():
    shown = review()
    rows = tuple(
        replace(row, gate=0.996) if row.name == "lateral_error" else row for row in shown.score.rows
    )
    told = lines_of(replace(shown, score=replace(shown.score, rows=rows)))
    assert not any("100 %" in line for line in told)


@pytest.mark.parametrize("version", [1, 2])
def test_an_exercise_of_the_list_is_named_in_the_language_of_the_window(german, version):
    known = SimpleNamespace(version=version, drill="")
    one = SimpleNamespace(exercise_title="First insertion", exercise_id="first", conditions=known)
    assert exercise_text(one).startswith("Erster Einstich")


@pytest.mark.parametrize("words", [("wegdrücken", "frei", "führen"), ("repel", "off", "guide")])
@pytest.mark.parametrize("width", [90, 120, 160, 320])
def test_the_three_words_of_the_dial_never_run_into_each_other(qt, words, width):
    font = QFont(qt.font())
    font.setPixelSize(theme.SMALL_PX)
    metrics = QFontMetrics(font)
    left, middle, right = (metrics.horizontalAdvance(w) for w in apart(words, metrics, width))
    assert max(left, right) < (width - middle) / 2
    assert "…" not in "".join(apart(words, metrics, width))
    assert apart(words, metrics, 1000) == words
