"""The library and the PACS in the window: import, report, search, failures."""

import sys
import time
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QWidget

sys.path.append(str(Path(__file__).parents[1] / "imaging"))

from dicom_factory import Slices
from pacs_rig import FakePacs

from app.imaging.library import CtLibrary
from app.imaging.pacs.settings import keep
from app.views.series.library_desk import LibraryDesk
from app.views.series.pacs_panel import PacsPanel


class NoIndicator:
    def show_task(self, task, title):
        self.title = title


@pytest.fixture
def desk(qapp_or_own):
    window = QWidget()
    yield LibraryDesk(NoIndicator(), window)
    window.deleteLater()


@pytest.fixture(scope="module")
def qapp_or_own():
    return QApplication.instance() or QApplication([])


def until(condition, seconds=20.0):
    limit = time.monotonic() + seconds
    while not condition() and time.monotonic() < limit:
        QApplication.processEvents()
        time.sleep(0.01)
    assert condition()


def test_a_folder_is_taken_in_and_the_report_offers_to_open_it(desk, tmp_path):
    Slices(tags={"BodyPartExamined": "HEAD"}).write(tmp_path / "in")
    opened = []
    desk.open_wanted.connect(opened.append)
    desk.import_folder(tmp_path / "in")
    until(lambda: desk.report is not None)
    assert "SeriesDescription" in desk.report.text.toPlainText()
    assert "Secret" not in desk.report.text.toPlainText()
    assert "face" in desk.report.warning.text()
    desk.report.accept()
    (entry,) = CtLibrary().entries()
    assert opened == [entry.folder]
    assert desk.entries()[0][1] == entry.folder


def test_what_cannot_be_taken_in_is_told_and_nothing_is_kept(desk, tmp_path):
    Slices(tags={"BurnedInAnnotation": "YES"}).write(tmp_path / "in")
    failed = []
    desk.failed.connect(failed.append)
    desk.import_folder(tmp_path / "in")
    until(lambda: failed)
    assert "carry writing" in str(failed[0])
    assert desk.entries() == []


def test_the_panel_searches_shows_and_hands_over(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        keep((pacs.settings(),))
        desk.ask_pacs()
        panel = desk.panel
        panel.look()
        assert "what to look for" in panel.note.text()
        assert not panel.take.isEnabled()
        panel.patient.setText("SECRET*")
        panel.look()
        until(lambda: panel.take.isEnabled())
        assert panel.tree.topLevelItem(0).text(6) == "5"
        panel.take.click()
        until(lambda: desk.report is not None)
    assert len(CtLibrary().entries()) == 1


def test_a_search_that_fails_is_said_in_the_panel(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored", "find fails") as pacs:
        keep((pacs.settings(),))
        panel = PacsPanel(NoIndicator())
        panel.name.setText("S*")
        panel.look()
        until(lambda: "out of resources" in panel.note.text())
        assert panel.search.isEnabled()
        panel.deleteLater()


def test_without_a_configured_pacs_it_says_how_to_add_one(desk):
    panel = PacsPanel(NoIndicator())
    assert "acus pacs add" in panel.note.text()
    assert not panel.search.isEnabled()
    panel.deleteLater()
