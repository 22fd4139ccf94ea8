"""Names hidden from the room: in titles, messages, lists and dialogs."""

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtWidgets import QLabel
from views_exercise_attempts import review

from app.core.errors import AcusError
from app.core.events import Event
from app.core.identifiers import HIDDEN
from app.imaging.pacs.query import FoundSeries, FoundStudy
from app.imaging.series import Ignored, Listing
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.status import MessageList
from app.views.kit.names import NAMES, Names
from app.views.kit.progress_strip import ProgressStrip
from app.views.pacs.panel import PacsPanel
from app.views.series.browser import SeriesBrowser, SeriesCard
from app.views.shell.message_bar import MessageBar


@pytest.fixture(autouse=True)
def shown_again(application):
    yield
    NAMES.hide(False)


@pytest.mark.parametrize(
    ("text", "secret"),
    [
        ("Looking for CT series in Smith John", "Smith"),
        ("cannot read /home/me/Smith John/ct 3/IM1: no DICOM", "Smith"),
        (r"cannot read C:\patients\Smith\a.dcm: no DICOM", "Smith"),
        ("Saved smith-plan.mrk.json", "smith"),
        ("slices 1 and 2 of SMITH_1.dcm and SMITH_2.dcm differ", "SMITH"),
        ("CT-0F3A99B1 is not the CT of this record", "0F3A"),
        ("patient P-0F3A99B1", "0F3A"),
    ],
)
def test_names_paths_files_and_pseudonyms_become_dots_and_come_back(text, secret):
    names = Names()
    names.learn(Path("/data/Smith John"))
    assert names.without_names(text) == text
    names.hide(True)
    assert secret not in names.without_names(text)
    assert HIDDEN in names.without_names(text)
    names.hide(False)
    assert names.without_names(text) == text


@pytest.mark.parametrize(
    "text",
    ["W 400 / L 40", "1/3 of 12 mm", "W/L locked", "10 and/or 20 HU", "gap: 1 slice is missing",
     "0.78 × 0.78 × 1.0 mm", ""],
)  # fmt: skip
def test_what_is_no_name_stays_as_it_is(text):
    names = Names()
    names.learn("ct", "", "  ")  # too short to be read for
    names.hide(True)
    assert names.without_names(text) == text


def test_a_known_name_is_not_found_within_a_word():
    names = Names()
    names.learn("demo")
    names.hide(True)
    assert names.without_names("demonstration of demo") == f"demonstration of {HIDDEN}"


def test_an_error_that_is_shown_loses_its_path_at_once(application, destroy):
    bar = MessageBar()
    destroy(bar)
    bar.show_error(AcusError("/data/Smith John/IM1 is no DICOM file"))
    assert "Smith" in bar.text
    NAMES.hide(True)
    assert "Smith" not in bar.text
    NAMES.hide(False)
    assert "Smith" in bar.text


def test_the_title_of_what_is_going_on_loses_the_folder(window, settle, tmp_path):
    folder = tmp_path / "Smith John"
    folder.mkdir()
    window.resize(1366, 768)
    settle()
    window.open_ct.open_folder(folder)
    strips = window.findChildren(ProgressStrip)
    texts = [label.text() for strip in strips for label in strip.findChildren(QLabel)]
    assert any("Smith John" in text for text in texts)
    window.projector.hide_names(True)
    texts = [label.text() for strip in strips for label in strip.findChildren(QLabel)]
    assert not any("Smith" in text for text in texts)
    assert settle(lambda: bool(window.message_bar.text))
    assert "Smith" not in window.message_bar.text


def test_lines_of_the_message_list_lose_their_names_and_come_back(application, destroy):
    lines = MessageList()
    destroy(lines)
    lines.add_event(Event(1.0, "recorder", "cannot write /records/smith/a.mcap"))
    NAMES.hide(True)
    lines.add_event(Event(2.0, "recorder", "cannot write /records/smith/b.mcap"))
    assert all("smith" not in lines.item(row).text() for row in range(2))
    NAMES.hide(False)
    assert all("smith" in lines.item(row).text() for row in range(2))


def test_the_series_browser_names_neither_folder_nor_files(application, destroy, volume):
    NAMES.hide(True)
    folder = Path("/data/Smith")
    listing = Listing(
        path=folder, series=(volume.series,),
        ignored=(Ignored(folder / "smith.txt", "not a DICOM file"),),
    )  # fmt: skip
    browser = SeriesBrowser(listing)
    destroy(browser)
    browser.thumbnails.close()
    said = browser.windowTitle() + browser.ignored.toPlainText()
    assert "mith" not in said
    assert "not a DICOM file" in said


def test_a_card_keeps_its_reason_without_the_files(application, destroy, volume):
    NAMES.hide(True)
    series = replace(volume.series, usable=False, reason="smith/a.dcm and smith/b.dcm differ")
    card = SeriesCard(series)
    destroy(card)
    assert "smith" not in card.verdict.text()
    assert "differ" in card.verdict.text()


def test_the_pacs_browser_shows_nobodys_name_before_a_room(application, destroy, tmp_path,
                                                           monkeypatch):  # fmt: skip
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path))
    NAMES.hide(True)
    panel = PacsPanel()
    destroy(panel)
    study = FoundStudy("1.1", "20260101", "SMITH^JOHN", "4711", "", "SMITH's CT", ("CT",), 3)
    panel.show_found([(FoundSeries("1.2", study, "2", "CT", "for Dr Smith", "CHEST", 3), 0)])
    item = panel.tree.topLevelItem(0)
    words = " ".join(item.text(column) for column in range(item.columnCount()))
    assert "mith" not in words.lower()
    assert "4711" not in words
    assert "2026-01-01" in words
    assert "CHEST" in words


def test_the_debrief_and_the_list_of_sessions_name_nobody(window):
    page = window.feature(DebriefFeature).page
    page.show_review(review(problems=("cannot read /records/smith/a.mcap: truncated",)))
    window.projector.hide_names(True)
    words = " ".join(label.text() for label in page.findChildren(QLabel))
    assert "student-07" not in words
    assert "smith" not in words
    assert "truncated" in words
    window.projector.hide_names(False)
    words = " ".join(label.text() for label in page.findChildren(QLabel))
    assert "student-07" in words
    assert "smith" in words
