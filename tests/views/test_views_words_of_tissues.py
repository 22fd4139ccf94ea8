"""Names of tissues, units and numbers come in the user's language wherever a student reads them.

Anatomical names of reference: Terminologia Anatomica in German and French, and the glossary.
"""

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QDialogButtonBox,
    QFileDialog,
    QLabel,
    QLineEdit,
    QToolButton,
    QTreeView,
)

from app.exercises.library import load_exercise
from app.imaging.field.from_recipe import TABLE
from app.imaging.field.tissue_field import FieldTissue, TissueKind
from app.imaging.field.walking import words
from app.planning.judged import JudgedPlan, WayHindrance
from app.scoring.met import Met
from app.scoring.metrics import available
from app.scoring.unit_words import unit_words
from app.session.planned import plan_sentences
from app.views.debrief.met_marks import kind_word
from app.views.debrief.score_words import with_unit
from app.views.exercise.briefing import scored_words
from app.views.kit.language import use_language
from app.views.kit.text import translated
from app.views.plan.verdict import _hindrance_words

ANATOMY = {
    "hepatic vein": ("Lebervene", "veine hépatique"),
    "portal vein": ("Pfortader", "veine porte"),
    "vena cava": ("Hohlvene", "veine cave"),
    "liver": ("Leber", "foie"),
    "lesion": ("Läsion", "lésion"),
    "cartilage": ("Knorpel", "cartilage"),
    "rib": ("Rippe", "côte"),
    "spleen": ("Milz", "rate"),
    "skin": ("Haut", "peau"),
    "fat": ("Fett", "graisse"),
}


@pytest.fixture(params=["de", "fr"])
def spoken(request, application):
    use_language(application, request.param)
    yield request.param
    use_language(application, "en")


def of(spoken, name):
    return ANATOMY[name][("de", "fr").index(spoken)]


def test_the_tissues_that_this_program_names_have_their_anatomical_names(spoken):
    for name in ANATOMY:
        assert translated(FieldTissue(3, TissueKind.ORGAN, name).words) == of(spoken, name)
    same = {"air", "cartilage", "muscle", "organ", "pancreas", "aorta", "organe"}
    for tissue in TABLE:
        assert translated(tissue.words) != str(tissue.words) or tissue.words in same, tissue


def test_a_name_that_somebody_else_gave_stays_as_it_is(spoken):
    assert translated(FieldTissue(3, TissueKind.VESSEL, "V. hepatica dextra").words) == (
        "V. hepatica dextra"
    )


def test_what_the_needle_met_is_told_in_the_language_with_its_decimal_comma(spoken):
    points = ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    met = Met("vessel", "hepatic vein", 12.5, 3.25, points, sd_mm=0.4, force_n=1.5)
    told = translated(met.sentence)
    assert of(spoken, "hepatic vein") in told
    assert "hepatic vein" not in told
    assert not re.search(r"\d\.\d", told)
    assert kind_word("bone") in ("Knochen", "os")


def test_a_plan_that_a_record_keeps_is_judged_in_the_language(spoken):
    way = WayHindrance("hepatic vein", TissueKind.VESSEL, 41.0, 2.5)
    plans = (
        JudgedPlan(0.0, 80.0, 10.0, 0.0, meets=(way,)),
        JudgedPlan(80.0, 80.0, 10.0, 4.5, nearest="hepatic vein", nearest_mm=41.0),
    )
    for plan in plans:
        told = " ".join(map(translated, plan_sentences(plan)))
        assert of(spoken, "hepatic vein") in told
        assert "hepatic vein" not in told
        assert not re.search(r"\d\.\d", told)
    assert of(spoken, "hepatic vein") in _hindrance_words(way)


def test_the_planned_way_is_told_in_the_language(spoken, monkeypatch):
    class Part:
        def __init__(self, code, length_mm):
            self.code, self.length_mm = code, length_mm

    class Field:
        tissues = TABLE

    codes = {str(tissue.words): tissue.code for tissue in TABLE}
    parts = [Part(codes["skin"], 2.04), Part(codes["fat"], 8.06), Part(codes["liver"], 30.0)]
    monkeypatch.setattr("app.imaging.field.walking.walk", lambda *_: parts)
    told = translated(words(Field(), []))
    expected = (("skin", "2,0"), ("fat", "8,1"), ("liver", "30,0"))
    assert told == ", ".join(f"{of(spoken, name)} {mm} mm" for name, mm in expected)


def test_units_that_are_words_are_told_in_the_language(spoken):
    assert with_unit(68.0, "points") == {"de": "68,0 Punkte", "fr": "68,0 points"}[spoken]
    wordy = {one.unit for one in available().values() if re.fullmatch("[a-z]{3,}", one.unit)}
    assert wordy == {"points", "scans", "times"}
    for unit in wordy:
        assert unit_words(unit).template == unit
    told = " ".join(scored_words(load_exercise("plan-it-yourself")))
    assert spoken == "fr" or "points" not in told
    vein = " ".join(scored_words(load_exercise("beside-the-vein")))
    assert of(spoken, "hepatic vein") in vein


UNTRANSLATABLE = {"OK", "Name", "Type"}
"""The same in English and in a language; "Name" in German, "Type" in French."""


def dialog_texts():
    texts = []
    for accept in QFileDialog.AcceptMode:
        for mode in QFileDialog.FileMode:
            dialog = QFileDialog()
            dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
            dialog.setAcceptMode(accept)
            dialog.setFileMode(mode)
            dialog.ensurePolished()
            parts = (*dialog.findChildren(QLabel), *dialog.findChildren(QAbstractButton))
            texts += [part.text() for part in parts]
            texts += [part.toolTip() for part in dialog.findChildren(QToolButton)]
            model = dialog.findChildren(QTreeView)[0].model()
            texts += [model.headerData(n, Qt.Orientation.Horizontal) for n in range(4)]
            dialog.deleteLater()
    box = QDialogButtonBox()
    for button in QDialogButtonBox.StandardButton:
        if button not in (
            QDialogButtonBox.StandardButton.NoButton,
            QDialogButtonBox.StandardButton.FirstButton,
            QDialogButtonBox.StandardButton.LastButton,
        ):
            texts.append(box.addButton(button).text())
    line = QLineEdit()
    texts += [action.text() for action in line.createStandardContextMenu().actions()]
    return texts


@pytest.mark.long("journey")
def test_dialogs_of_qt_are_in_the_language_to_the_last_word(spoken):
    other = dialog_texts()
    use_language(QApplication.instance(), "en")
    english = dialog_texts()
    assert len(english) == len(other) > 50
    left = {a for a, b in zip(english, other, strict=True) if a and a == b}
    assert left <= UNTRANSLATABLE
