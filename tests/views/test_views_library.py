"""The library of CTs in the window: import, report, failures."""

import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

sys.path.append(str(Path(__file__).parents[1] / "imaging"))

from dicom_factory import Slices
from test_imaging_enhanced import write_enhanced

from app.commands.ct import boxes_of
from app.imaging.library import CtLibrary
from app.imaging.privacy.burned_in import MaskBox
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.views.series.feature import LibraryImport


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
