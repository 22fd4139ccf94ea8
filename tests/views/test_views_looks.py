"""The rules of `tools.looks` hold on the pages that matter most, and find planted faults."""

from pathlib import Path

import numpy as np
import pytest
from attempt_windows import begun
from PIL import Image
from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPixmap
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.author.feature import AuthorFeature
from app.views.debrief.feature import DebriefFeature
from app.views.kit.roles import Role
from tools.looks import rules
from tools.looks.measure import difference
from tools.looks.pseudo import Longer, longer
from tools.palette import WIDEST_PX, small_png


@pytest.fixture
def page(application, destroy):
    made = QWidget()
    made.setLayout(QVBoxLayout())
    destroy(made)

    def show(*widgets):
        for widget in widgets:
            made.layout().addWidget(widget)
        made.resize(300, 40 * len(widgets))
        made.show()
        made.activateWindow()
        QApplication.processEvents()
        return made

    return show


def broken(window):
    return {fault.rule for fault in (*rules.judged(window), *rules.judged_by_keys(window))}


def at_rest(window, settle, size=(1366, 768)):
    """Show the window in a size, its keys with it."""
    window.resize(*size)
    window.show()
    window.activateWindow()
    settle(timeout=0.15)
    return window


# --- the rules --------------------------------------------------------------------------------
def test_contrast_is_that_of_the_web_content_guidelines():
    """#767676 on white is the guidelines' own borderline: 4.54 to 1; black on white is 21."""
    white, grey, black = (
        float(rules.luminance(np.array(rgb, np.uint8)))
        for rgb in ((255, 255, 255), (0x76, 0x76, 0x76), (0, 0, 0))
    )
    assert rules.contrast(white, grey) == pytest.approx(4.54, abs=0.005)
    assert rules.contrast(white, black) == pytest.approx(21.0)


def test_a_pale_text_is_told_from_a_clear_one(page):
    label = QLabel("Depth of the needle")
    label.setStyleSheet("color: #555b60; background: #14171a;")
    assert broken(page(label)) == {"contrast"}
    label.setStyleSheet("color: #e8ecef; background: #14171a;")
    assert broken(label.window()) == set()


def test_a_cut_button_and_a_text_on_a_text_are_seen(page):
    button, check = QPushButton("Write a report of the problem"), QCheckBox("Keep it")
    window = page(button, check)
    assert broken(window) == set()
    button.setFixedWidth(60)
    assert "cut" in broken(window)
    on_it = QLabel("over", window)
    on_it.setGeometry(check.geometry())
    on_it.show()
    assert "overlap" in broken(window)


def test_a_window_that_fits_no_small_screen_and_a_text_beyond_its_page_are_seen(page):
    label = QLabel("Entry")
    window = page(label)
    label.setParent(window)
    label.setGeometry(290, 0, 60, 20)
    label.show()
    window.setMinimumWidth(1400)
    window.resize(300, 60)
    label.move(1390, 5)
    assert {"outside", "size"} <= broken(window)


def test_a_control_without_name_focus_or_tab_is_seen(page):
    nameless, named = QLineEdit(), QLineEdit()
    named.setAccessibleName("Search")
    shy = QPushButton("Only by the mouse")
    shy.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
    flat = QPushButton("No ring")
    flat.setStyleSheet("QPushButton { border: 0; outline: 0; } QPushButton:focus { border: 0; }")
    window = page(nameless, named, shy, flat)
    faults = rules.judged_by_keys(window)
    assert [fault.rule for fault in faults] == ["name", "focus", "tab"]
    assert "No ring" in faults[1].where
    assert "Only by the mouse" in faults[2].where


def test_a_table_that_keeps_the_tab_key_is_seen(page):
    table, after = QTableWidget(3, 3), QPushButton("After it")
    table.setAccessibleName("Table")
    window = page(table, after)
    table.setFocus()
    table.setCurrentCell(0, 0)
    assert "tab" in broken(window)
    table.setTabKeyNavigation(False)
    assert "tab" not in broken(window)


def test_words_of_the_pseudo_language_are_two_fifths_longer_and_keep_places_and_keys():
    text = "Open {name} in <b>Acus</b> by Ctrl+O"
    made = longer(text)
    assert "{name}" in made
    assert "<b>" in made
    assert made.endswith("Ctrl+O")
    assert len(longer("needle insertion")) >= 1.4 * len("needle insertion")


def test_pictures_are_compared_as_they_are_seen(page, tmp_path):
    """By OpenCV's structural similarity: none for the same, little for a digit, much for a move."""
    label = QLabel("12.4 mm")
    window = page(label, QLabel("Depth"), QLabel("Target"), QLabel("Entry"))
    window.resize(320, 320)

    def kept(name):
        QApplication.processEvents()
        window.grab().save(str(tmp_path / name))
        return tmp_path / name

    before = kept("before.png")
    assert difference(before, kept("same.png")) == 0.0
    label.setText("12.5 mm")
    digit = difference(before, kept("digit.png"))
    window.layout().setContentsMargins(80, 80, 0, 0)
    moved = difference(before, kept("moved.png"))
    assert digit < 0.02 < moved


# --- the pages --------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_start_page_debrief_and_sessions_keep_the_rules(window, settle):
    at_rest(window, settle)
    for role in Role:
        window.roles.choose(role)
        settle(timeout=0.1)
        assert (role, broken(window)) == (role, set())
    feature = window.feature(DebriefFeature)
    for show in (feature.show, feature.show_sessions):
        show()
        settle(timeout=0.1)
        assert broken(window) == set()


@pytest.mark.long("journey")
def test_the_workspace_keeps_the_rules_before_an_attempt_and_in_it(window, patient, settle):
    at_rest(window, settle)
    begun(window, patient, start=False)
    # What the path meets is worked out beside the window, and its words come when they are there.
    settle(lambda: not rules.judged(window))
    assert [*map(str, rules.judged(window)), *map(str, rules.judged_by_keys(window))] == []
    window.workspace.room.begin()
    settle(timeout=0.3)
    assert [*map(str, rules.judged(window)), *map(str, rules.judged_by_keys(window))] == []
    assert rules.judged_in_attempt(window) == []
    window.workspace.room.end()


@pytest.mark.long("journey")
def test_the_authors_form_keeps_the_rules_on_every_page(window, patient, settle):
    window.roles.choose(Role.INSTRUCTOR)
    begun(window, patient, start=False)
    feature = window.feature(AuthorFeature)
    feature.make()
    dialog = feature.dialog
    dialog.may_close = lambda: True
    for number in range(dialog.pages.count()):
        dialog.show_page(number)
        settle(timeout=0.1)
        assert [str(fault) for fault in rules.judged(dialog)] == [], number
    dialog.show_page(5)
    assert [str(fault) for fault in rules.judged_by_keys(dialog)] == []
    dialog.reject()


@pytest.mark.long("journey")
def test_with_longer_words_the_window_still_fits_a_small_screen(
    application, services, destroy, settle
):
    from app.views.shell.window import MainWindow

    words = Longer(application)
    QCoreApplication.installTranslator(words)
    try:
        window = MainWindow(services)
        destroy(window)
        at_rest(window, settle)
        assert [str(fault) for fault in rules.judged(window)] == []
        least = window.minimumSizeHint()
        assert (least.width() <= 1366, least.height() <= 768) == (True, True)
    finally:
        QCoreApplication.removeTranslator(words)


# --- the pictures themselves ------------------------------------------------------------------
def test_no_two_of_the_pictures_that_are_kept_show_the_same():
    kept = sorted((Path(__file__).parents[1] / "data" / "looks").glob("*.png"))
    assert len({picture.read_bytes() for picture in kept}) == len(kept) > 0


def test_fine_strokes_are_not_lost_in_a_picture_that_is_scaled_down(application, tmp_path):
    wide = QImage(2 * WIDEST_PX, 40, QImage.Format.Format_RGB32)
    wide.fill(QColor("black"))
    with QPainter(wide) as painter:
        painter.setPen(QColor("white"))
        for x in range(0, wide.width(), 20):  # strokes of one pixel at even and at odd places
            painter.drawLine(x, 0, x, 39)
            painter.drawLine(x + 9, 0, x + 9, 39)
    small_png(QPixmap.fromImage(wide), tmp_path / "small.png")
    row = np.asarray(Image.open(tmp_path / "small.png").convert("L"))[10]
    for place in range(0, WIDEST_PX - 10, 10):  # half the light of each, as its width is halved
        for stroke in (place, place + 4):
            assert row[max(0, stroke - 1) : stroke + 2].max() > 60
