"""The library and the PACS in the window: import, report, search, failures."""

import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QToolButton, QWidget

sys.path.append(str(Path(__file__).parents[1] / "imaging"))

from dicom_factory import Slices
from pacs_rig import FakePacs
from test_imaging_enhanced import write_enhanced

from app.commands.ct import boxes_of
from app.core import paths as core_paths
from app.imaging.library import CtLibrary
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import keep
from app.imaging.privacy.burned_in import MaskBox
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.views.series.feature import LibraryImport
from app.views.series.pacs_panel import PacsPanel


class NoIndicator:
    def show_task(self, task, title):
        self.title = title


@pytest.fixture
def desk(qapp_or_own):
    window = QWidget()
    yield LibraryImport(NoIndicator(), window)
    window.deleteLater()


@pytest.fixture(scope="module")
def qapp_or_own():
    return QApplication.instance() or QApplication([])


def until(condition, seconds=60.0):
    limit = time.monotonic() + seconds
    while not condition() and time.monotonic() < limit:
        QApplication.processEvents()
        time.sleep(0.01)
    assert condition()


def mask_dialog(desk):
    """The dialog in which the pictures are read at, once it is open."""
    until(lambda: desk.intake.mask is not None)
    return desk.intake.mask


def drag(widget, start, end):
    for kind, point in ((QTest.mousePress, start), (QTest.mouseMove, end),
                        (QTest.mouseRelease, end)):  # fmt: skip
        if kind is QTest.mouseMove:
            kind(widget, point)
        else:
            kind(widget, Qt.MouseButton.LeftButton, pos=point)


def test_a_folder_is_taken_in_and_the_report_offers_to_open_it(desk, tmp_path):
    Slices(tags={"BodyPartExamined": "HEAD"}).write(tmp_path / "in")
    opened = []
    desk.open_wanted.connect(opened.append)
    desk.import_from(tmp_path / "in")
    mask_dialog(desk).take.click()
    until(lambda: desk.intake.report is not None)
    report = desk.intake.report
    assert "SeriesDescription" in report.text.toPlainText()
    assert "Secret" not in report.text.toPlainText()
    assert "face" in report.warning.text()
    report.accept()
    (entry,) = CtLibrary().entries()
    assert opened == [entry.folder]
    assert desk.entries()[0][1] == entry.folder


@pytest.mark.parametrize("kind", ["zip", "file"])
def test_an_archive_and_a_file_are_taken_in_too(desk, tmp_path, kind):
    if kind == "zip":
        paths = Slices().write(tmp_path / "in")
        source = tmp_path / "in.zip"
        with zipfile.ZipFile(source, "w") as archive:
            for path in paths:
                archive.write(path, f"deep/{path.name}")
    else:
        source = write_enhanced(tmp_path / "one.dcm", Slices())
    desk.import_from(source)
    dialog = mask_dialog(desk)
    assert dialog.canvas.may_draw == (kind == "zip")
    dialog.take.click()
    until(lambda: desk.intake.report is not None)
    (entry,) = CtLibrary().entries()
    assert entry.files == (5 if kind == "zip" else 1)


def test_boxes_drawn_with_the_mouse_do_what_the_command_line_does(desk, tmp_path):
    Slices(shape=(40, 60)).write(tmp_path / "in")
    desk.import_from(tmp_path / "in")
    dialog = mask_dialog(desk)
    frame = dialog.canvas.frame()
    scale = frame.width() / 60.0, frame.height() / 40.0

    def at(column, row):
        return QPoint(round(frame.left() + scale[0] * column), round(frame.top() + scale[1] * row))

    drag(dialog.canvas, at(10.4, 5.4), at(19.6, 9.6))
    assert dialog.boxes == (MaskBox(10, 5, 10, 5),)
    dialog.slider.setValue(2)
    dialog.scope.setCurrentIndex(1)
    drag(dialog.canvas, at(30.4, 20.4), at(30.4, 20.4))  # a click, no box
    drag(dialog.canvas, at(30.4, 20.4), at(500.0, 25.6))  # beyond the edge
    assert dialog.boxes == (MaskBox(10, 5, 10, 5), MaskBox(30, 20, 30, 6, picture=2))
    drag(dialog.canvas, at(1.0, 1.0), at(9.0, 9.0))
    dialog.undo()
    dialog.clear()
    assert dialog.boxes == ()
    dialog.undo()
    assert len(dialog.boxes) == 2
    seen = [dialog.pictures.seen(k, dialog.boxes).copy() for k in (1, 2)]
    dialog.take.click()
    until(lambda: desk.intake.report is not None)
    (entry,) = CtLibrary().entries()
    window = load_ct(entry.folder).hu.copy()
    np.testing.assert_array_equal(window[:2], seen)  # seen before the import
    CtLibrary().remove(entry.name)
    again = CtLibrary().import_series(
        scan_folder(tmp_path / "in").series[0], boxes_of(["10,5,10,5", "30,20,30,6,2"])
    )
    np.testing.assert_array_equal(window, load_ct(again.entry.folder).hu)


def test_writing_that_the_files_tell_of_must_be_drawn_over_before_it_is_taken_in(desk, tmp_path):
    Slices(tags={"BurnedInAnnotation": "YES"}).write(tmp_path / "in")
    failed = []
    desk.failed.connect(failed.append)
    desk.import_from(tmp_path / "in")
    first = mask_dialog(desk)
    first.take.click()
    until(lambda: desk.intake.mask is not first)
    assert desk.entries() == []
    second = desk.intake.mask
    assert "writing" in second._note.text()
    second.draw(0, 0, 3, 3)
    second.take.click()
    until(lambda: desk.intake.report is not None)
    assert not failed
    assert desk.intake.report.isVisible()
    assert len(desk.entries()) == 1


def test_what_cannot_be_taken_in_is_told_and_nothing_is_kept(desk, tmp_path):
    Slices(tags={"ImageType": ["DERIVED", "SECONDARY", "SCREEN SAVE"]}).write(tmp_path / "in")
    failed = []
    desk.failed.connect(failed.append)
    desk.import_from(tmp_path / "in")
    mask_dialog(desk).take.click()
    until(lambda: failed)
    assert "picture of a screen" in str(failed[0])
    assert desk.entries() == []


def test_a_look_that_is_cancelled_keeps_nothing(desk, tmp_path):
    Slices().write(tmp_path / "in")
    desk.import_from(tmp_path / "in")
    mask_dialog(desk).reject()
    assert desk.entries() == []


@pytest.mark.long("journey")
def test_the_panel_searches_shows_and_hands_over(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        keep((pacs.settings(),))
        desk.ask_pacs()
        panel = desk.panel
        panel.query()
        assert "what to look for" in panel.note.text()
        assert not panel.take.isEnabled()
        panel.patient.setText("SECRET*")
        panel.query()
        until(lambda: panel.take.isEnabled())
        assert panel.tree.topLevelItem(0).text(6) == "5"
        panel.take.click()
        mask_dialog(desk).take.click()
        until(lambda: desk.intake.report is not None)
    assert len(CtLibrary().entries()) == 1
    assert aside() == 0


@pytest.mark.long("journey")
def test_a_retrieved_series_that_is_given_up_is_deleted(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        client = Pacs(pacs.settings())
        study = client.find_studies(Query(patient_id="SECRET*"))[0]
        desk._retrieve(pacs.settings(), client.find_series(study)[0])
        dialog = mask_dialog(desk)
        assert aside() == 5
        dialog.reject()
    assert aside() == 0
    assert desk.entries() == []


@pytest.mark.long("journey")
def test_an_interrupted_retrieval_is_shown_and_resumed(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    failed = []
    desk.failed.connect(failed.append)
    with FakePacs(tmp_path / "stored", "cut") as pacs:
        keep((pacs.settings(),))
        for ill in ("cut", ""):
            pacs.ill = ill
            desk.ask_pacs()
            panel = desk.panel
            panel.patient.setText("SECRET*")
            panel.query()
            until(lambda p=panel: p.take.isEnabled())
            shown = panel.tree.topLevelItem(0).text(6)
            assert shown == ("5" if ill else "2 of 5 here, to be resumed")
            panel.take.click()
            until(lambda: failed)
        mask_dialog(desk).take.click()
        until(lambda: desk.intake.report is not None)
    assert len(CtLibrary().entries()) == 1


def aside():
    """Pictures that are kept aside, not yet de-identified."""
    return len(list((core_paths.data() / "incoming").rglob("*.dcm")))


def test_a_search_that_fails_is_said_in_the_panel(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored", "find fails") as pacs:
        keep((pacs.settings(),))
        panel = PacsPanel()
        panel.name.setText("S*")
        panel.query()
        until(lambda: "out of resources" in panel.note.text())
        assert panel.search.isEnabled()
        panel.deleteLater()


def test_a_search_can_be_cancelled_in_the_panel(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored", "slow find") as pacs:
        keep((pacs.settings(timeout_s=20.0),))
        panel = PacsPanel()
        panel.name.setText("S*")
        panel.query()
        until(lambda: pacs.asked)
        start = time.monotonic()
        panel.strip.findChild(QToolButton).click()
        until(lambda: panel.search.isEnabled())
        assert time.monotonic() - start < 15.0
        panel.deleteLater()


def test_without_a_configured_pacs_the_panel_leads_to_the_configuration(desk):
    desk.ask_pacs()
    panel = desk.panel
    assert "Configure" in panel.note.text()
    assert not panel.search.isEnabled()
    panel.configure.click()
    dialog = desk.configuration
    dialog.add_button.click()
    dialog.form.fields["host"].setText("127.0.0.1")
    dialog.form.fields["title"].setText("FAKE")
    dialog.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert panel.search.isEnabled()
    assert "pacs  (FAKE, 127.0.0.1:104)" in panel.servers.currentText()
    panel.reject()
