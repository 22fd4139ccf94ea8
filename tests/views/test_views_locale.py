"""What the window writes by language agrees with Qt's own tables of the Unicode project (CLDR)."""

import ast
import re
from datetime import datetime
from pathlib import Path

import pytest
import yaml
from PySide6.QtCore import QDate, QDateTime, QLocale, QTime
from PySide6.QtGui import QFont, QFontMetrics

from app.core import language as core_language
from app.planning.registration import words as registration_words
from app.session.checks.facts import CameraFacts
from app.session.checks.steps import CheckVerdict, _picture
from app.views.kit import text, theme
from app.views.kit.language import use_language
from app.views.kit.roles import Role
from app.views.plan.paths import PathsPanel
from app.views.robot.health_panel import TITLE_WIDTH, _Line
from app.views.shell.help import unreviewed
from app.views.shell.shortcuts import ROLE_KEY, groups
from app.views.slices.bindings import SCHEMES

ROOT = Path(__file__).resolve().parents[2]
WHEN = datetime(2026, 11, 29, 17, 5)


@pytest.fixture(params=["de", "fr"])
def spoken(request, application):
    assert use_language(application, request.param) == request.param
    yield request.param
    use_language(application, "en")


@pytest.fixture
def german(application):
    use_language(application, "de")
    yield
    use_language(application, "en")


def test_dates_decimal_points_and_lists_are_those_of_the_unicode_project(spoken):
    locale = QLocale(spoken)
    digits = re.findall(r"\d+", text.moment(WHEN))
    day = QDateTime(QDate(2026, 11, 29), QTime(17, 5))
    short = re.findall(r"\d+", locale.toString(day, QLocale.FormatType.ShortFormat))
    assert [part[-2:] for part in digits] == [part[-2:] for part in short]
    assert text.day(WHEN.date()) == text.moment(WHEN)[:10]
    signs = re.sub(r"\d", "", text.day(WHEN.date()))
    short_day = locale.toString(QDate(2026, 11, 29), QLocale.FormatType.ShortFormat)
    assert signs == re.sub(r"\d", "", short_day)
    assert text.number(1.5, ".1f") == f"1{locale.decimalPoint()}5"
    assert text.listing(["a", "b", "c"]) == locale.createSeparatedList(["a", "b", "c"])


@pytest.mark.parametrize("n", [0, 1, 2, 5, 11, 21, 100])
def test_window_and_command_line_choose_the_same_form_for_a_number(spoken, n):
    single, several = "{n} attempt counts", "{n} attempts count"
    of_qt = text.tr_n(single, several, n)  # by Qt's own rules of plurals
    assert core_language.texts(spoken).counted(single, several, n, {}) == of_qt
    assert of_qt != (single if n == 1 else several).format(n=n)


def test_keys_are_named_as_on_the_keyboards_of_the_language(german):
    assert text.keys_text("Ctrl+B, Shift+R") == "Strg+B, Umschalt+R"
    sheet = [key for _, rows in groups(SCHEMES["ohif"], role=Role.TECHNICIAN) for key, _ in rows]
    assert ROLE_KEY in sheet
    assert not [key for key in sheet if "Ctrl" in text.keys_text(key)]


def test_every_other_language_says_that_nobody_of_the_field_reviewed_it(application, spoken):
    (line,) = unreviewed()
    assert "radiolog" in line.lower()
    use_language(application, "en")
    assert unreviewed() == ()


def test_what_the_daily_and_the_registration_check_say_is_in_german(german):
    dark = CameraFacts("left", "", 30.0, 30.0, None, "")
    verdict, found, todo = _picture(dark)
    assert verdict is CheckVerdict.WAITING
    assert text.translated(found) == "noch kein Bild"
    assert text.translated(todo) == "einen Augenblick warten"
    assert text.translated(registration_words.NOT_CHECKED).startswith("Bildschirm und Nadel")
    assert not [line for line in registration_words.MEANING if text.translated(line) == line]


@pytest.mark.long("journey")
def test_no_text_is_fixed_in_the_language_in_which_a_module_was_imported():
    """A text that is made at import stays as it is when another language is chosen."""
    fixed = []

    def look(node, path):
        for inner in ast.iter_child_nodes(node):
            if isinstance(inner, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
                continue
            if isinstance(inner, ast.Call):
                name = getattr(inner.func, "id", "")
                if name in ("tr", "tr_n", "translated", "declared"):
                    fixed.append(f"{path.name}:{inner.lineno}")
            look(inner, path)

    for path in (ROOT / "app").rglob("*.py"):
        look(ast.parse(path.read_text(encoding="utf-8")), path)
    assert fixed == []


ROOM_PX = 354
"""Beside the pictures at 1366 pixels a side panel has this much between its margins."""


def test_panels_of_plan_and_robot_have_room_for_their_words(spoken, application):
    paths, line = PathsPanel(), _Line(None)
    assert paths.minimumSizeHint().width() <= ROOM_PX
    font = QFont(line.font())
    font.setPixelSize(theme.SMALL_PX)
    metrics = QFontMetrics(font)
    titles = [text.tr("Speed governor"), text.tr("Passivity guard")]
    words = [f"✔ {title}".split(" ") for title in titles]
    longest = max((word for each in words for word in each), key=metrics.horizontalAdvance)
    assert metrics.horizontalAdvance(longest) <= theme.px(TITLE_WIDTH)
    assert line._title.wordWrap()
    paths.deleteLater()
    line.deleteLater()


def test_the_glossary_says_of_eighty_terms_where_their_words_are_usual():
    words = (core_language.folder() / "glossary.yaml").read_text(encoding="utf-8")
    terms = yaml.safe_load(words)["terms"]
    assert len({term["en"] for term in terms}) == len(terms)
    assert sum(term["source"] != "usage, not looked up" for term in terms) >= 80
