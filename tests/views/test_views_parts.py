import os
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QObject
from PySide6.QtWidgets import QProgressBar, QWidget

from app.core.errors import AcusError
from app.core.progress import Progress
from app.imaging.errors import ImagingError
from app.imaging.series import Ignored, Listing
from app.views.kit import theme
from app.views.kit.background import run_in_background
from app.views.kit.parts import BulletLabel
from app.views.kit.progress_strip import ElidedLabel, ProgressStrip
from app.views.kit.text import tr
from app.views.reading.layouts import BULLSEYE, CORONAL, FIVE, FOUR, ViewGrid
from app.views.series.browser import SeriesBrowser
from app.views.shell.message_bar import MessageBar


# --- text, theme, background -------------------------------------------------------------------
def test_text_is_filled_in_after_translation():
    assert tr("Slice {number} / {count}", number=1, count=2) == "Slice 1 / 2"


def test_marks_differ_in_more_than_colour():
    planes = [theme.AXIAL, theme.SAGITTAL, theme.CORONAL]
    assert len({mark.dash for mark in planes}) == 3
    points = [theme.ENTRY, theme.TARGET, theme.NEEDLE_TIP]
    assert len({mark.symbol for mark in points}) == 3


def test_the_style_sheet_has_no_hole():
    assert "$" not in theme.style_sheet()


def test_work_beside_the_window_reports_and_answers_on_its_thread(application, settle):
    parent, seen = QObject(), []

    def work(progress: Progress) -> str:
        progress.report(0.5, "half")
        time.sleep(0.05)
        return threading.current_thread().name

    task = run_in_background(
        parent, work, lambda name: seen.append((name, threading.current_thread())), seen.append
    )
    reports = []
    task.progressed.connect(lambda share, text: reports.append((share, text)))
    assert settle(lambda: bool(seen))
    assert seen == [("acus-background", threading.main_thread())]
    assert reports == [(0.5, "half")]


def test_an_error_beside_the_window_is_handed_over(application, settle):
    parent, errors = QObject(), []

    def work(_: Progress) -> None:
        raise AcusError("no such thing")

    run_in_background(parent, work, lambda _: None, errors.append)
    assert settle(lambda: bool(errors))
    assert str(errors[0]) == "no such thing"


def test_cancelling_ends_the_work_without_an_error(application, settle):
    parent, ended = QObject(), []

    def work(progress: Progress) -> None:
        while True:
            progress.report(0.1)
            time.sleep(0.002)

    task = run_in_background(parent, work, ended.append, ended.append, lambda: ended.append("off"))
    task.cancel()
    assert settle(lambda: bool(ended))
    assert ended == ["off"]
    assert settle(lambda: "acus-background" not in {t.name for t in threading.enumerate()})


def test_a_closed_task_calls_nobody(application, settle):
    parent, ended = QObject(), []
    task = run_in_background(parent, lambda p: time.sleep(0.05), ended.append, ended.append)
    task.close()
    settle(timeout=0.15)
    assert not ended


def test_work_that_is_replaced_holds_nobody_and_leaves_the_strip(application, settle):
    strip, ended = ProgressStrip(), []
    gate = threading.Event()
    task = run_in_background(strip, lambda _: gate.wait(60.0), ended.append, ended.append,
                             title="Reading", indicator=strip)  # fmt: skip
    began = time.monotonic()
    task.drop()
    assert time.monotonic() - began < 30.0  # the work hears of it when it reports next, after 60
    assert strip.count == 0
    gate.set()
    settle(timeout=0.15)
    assert not ended


def test_work_that_has_ended_can_still_be_dropped_and_closed(application, settle):
    parent, ended = QObject(), []
    task = run_in_background(parent, lambda _: 1, ended.append, ended.append)
    assert settle(lambda: ended == [1])
    settle(timeout=0.1)  # Qt deletes it
    task.drop()
    task.close()
    assert not task.is_running()


def test_the_strip_shows_a_task_and_its_cancel(application, settle):
    strip, ended = ProgressStrip(), []
    gate = threading.Event()
    run_in_background(strip, lambda _: gate.wait(60.0), ended.append, ended.append,
                      title="Reading", indicator=strip)  # fmt: skip
    assert strip.count == 1
    assert not strip.isHidden()
    gate.set()
    assert settle(lambda: strip.count == 0)
    assert strip.isHidden()


def test_a_long_title_ends_in_an_ellipsis_and_its_tooltip_has_the_whole(application, settle):
    strip, gate = ProgressStrip(), threading.Event()
    strip.resize(420, 40)
    title = "Starting robot and cameras: waiting for the program to be compiled, a minute or two"
    run_in_background(strip, lambda _: gate.wait(60.0), print, print, title=title, indicator=strip)
    strip.show()
    settle(timeout=0.1)
    (label,) = strip.findChildren(ElidedLabel)
    assert label.text().endswith("…")
    assert label.fontMetrics().horizontalAdvance(label.text()) <= label.width()
    assert label.toolTip() == title
    strip.resize(1200, 40)
    settle(timeout=0.1)
    assert (label.text(), label.toolTip()) == (title, "")
    gate.set()
    assert settle(lambda: strip.count == 0)


def test_the_message_bar_says_what_happened_and_keeps_the_details(application):
    bar = MessageBar()
    bar.show_error(ImagingError("no DICOM files in x: choose the folder that holds them"))
    assert "choose the folder" in bar.text
    bar.show_error("y" * 1000)
    assert len(bar.text) <= 260
    bar.show_error(KeyError("k"))
    assert "KeyError" in bar.text
    bar.deleteLater()


def test_the_grid_arranges_maximises_and_restores(application):
    panes = {name: QWidget() for name in FIVE.panes}
    grid = ViewGrid(panes)
    hidden = lambda: [name for name, pane in panes.items() if pane.isHidden()]  # noqa: E731
    assert hidden() == [BULLSEYE]
    grid.arrange(FIVE)
    assert not hidden()
    grid.toggle(panes[CORONAL])
    assert [name for name in panes if name not in hidden()] == [CORONAL]
    grid.toggle(panes[CORONAL])
    assert not hidden()
    grid.arrange(FOUR)
    assert hidden() == [BULLSEYE]
    grid.deleteLater()


def test_qt_calls_that_return_nothing_take_no_reference_of_none(application):
    """PySide6 6.12.0 loses one at every void call on CPython 3.11 and aborts within minutes."""
    widget = QWidget()
    before = sys.getrefcount(None)
    for _ in range(1000):
        widget.update()
    assert sys.getrefcount(None) >= before - 50
    widget.deleteLater()


# --- series chooser ----------------------------------------------------------------------------
def test_the_chooser_says_why_a_series_cannot_be_used(application, volume):
    good = volume.series
    bad = type(good)(**{name: getattr(good, name) for name in good.__slots__}
                     | {"uid": "9", "usable": False, "reason": "slices are missing"})  # fmt: skip
    browser = SeriesBrowser(Listing(Path("x"), (bad, good), ()))
    first, second = browser.cards
    assert second.verdict.text() == "✖  slices are missing"
    assert second.buttons == []
    chosen = []
    browser.chosen.connect(lambda *what: chosen.append(what))
    second.open()
    assert chosen == []
    first.open()
    assert chosen == [(good, "none")]
    browser.deleteLater()


def test_the_chooser_offers_what_would_help(application, volume):
    uneven = replace(
        volume.series, usable=False, reason="uneven spacing", remedies=("resample",), notes=("MR",)
    )
    browser = SeriesBrowser(Listing(Path("x"), (uneven,), (Ignored(Path("x/a"), "empty file"),)))
    (card,) = browser.cards
    assert card.verdict.text() == "▲  uneven spacing"
    assert [button.text() for button, _ in card.buttons] == ["Open resampled"]
    assert browser.ignored.toPlainText() == "a: empty file"
    chosen = []
    browser.chosen.connect(lambda *what: chosen.append(what))
    card.buttons[0][0].click()
    assert chosen == [(uneven, "resample")]
    browser.deleteLater()


LAST_REFERENCE = """
import time
from PySide6.QtCore import QCoreApplication, QEvent, QObject
from app.views.kit.background import run_in_background

application = QCoreApplication([])


class Owner(QObject):
    def begin(self):
        run_in_background(self, lambda _: None, self.end, self.end)

    def end(self, _):
        print("delivered", flush=True)


for _ in range(20):
    owner = Owner()
    owner.begin()
    del owner
    end = time.monotonic() + 0.2
    while time.monotonic() < end:
        QCoreApplication.processEvents()
        time.sleep(0.01)
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
print("alive")
"""


@pytest.mark.long("journey")
def test_work_whose_callback_holds_the_last_reference_to_its_owner_ends_both_once():
    # freed memory is overwritten at once: what is destroyed twice shows
    environment = os.environ | {"MALLOC_PERTURB_": "165"}
    done = subprocess.run(
        [sys.executable, "-c", LAST_REFERENCE],
        capture_output=True,
        text=True,
        env=environment,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout.split()[-1:]) == (0, ["alive"]), done.stderr


def test_of_two_tasks_one_bar_is_seen_with_the_number_of_others_and_the_next_follows(
    application, settle
):
    strip, gates = ProgressStrip(), (threading.Event(), threading.Event())
    parent = QObject()
    for title, gate in zip(("Reading", "Starting robot"), gates, strict=True):
        run_in_background(
            parent, lambda _, gate=gate: gate.wait(30.0), print, print, title=title, indicator=strip
        )
    try:
        strip.show()

        def seen():
            bars = [one for one in strip.findChildren(QProgressBar) if one.isVisible()]
            texts = [one.whole for one in strip.findChildren(ElidedLabel) if one.isVisible()]
            return len(bars), texts

        assert seen() == (1, ["Reading (and 1 more)"])
        assert strip.count == 2
        one_row = strip.sizeHint().height()
        gates[0].set()
        assert settle(lambda: strip.count == 1)
        assert seen() == (1, ["Starting robot"])
        assert strip.sizeHint().height() == one_row
    finally:
        for gate in gates:
            gate.set()
    assert settle(lambda: strip.isHidden())


def test_a_line_with_a_bullet_hangs_beside_it(application):
    """Seen: its second line stood under the bullet, as if it were a point of its own."""
    label, items = BulletLabel(), ["must be kept " * 12, "short"]
    label.show_items(items)
    (first, long), (second, short) = label._rows(300)
    indent = label.fontMetrics().horizontalAdvance(BulletLabel.BULLET)
    assert label.text().splitlines() == [first, second] == [f"•  {item}" for item in items]
    assert long.left() == short.left() == indent
    assert long.height() > 2 * short.height()
    assert short.top() == long.top() + long.height()
    assert label.heightForWidth(300) >= long.height() + short.height()
    assert label.heightForWidth(1500) < label.heightForWidth(300)
    label.show_items(["alone"])
    assert label._rows(300)[0][1].left() == 0
    label.deleteLater()


def test_a_hanging_line_is_drawn_right_of_its_bullet_alone(application):
    label = BulletLabel()
    label.setStyleSheet("background: #000000; color: #ffffff;")
    label.show_items(["must be kept " * 12, "short"])
    label.resize(300, label.heightForWidth(300))
    picture = label.grab().toImage()
    indent = label.fontMetrics().horizontalAdvance(BulletLabel.BULLET)
    (_, long), (_, short) = label._rows(300)

    def drawn(top, bottom):
        return any(
            picture.pixelColor(x, y).lightness() > 100
            for y in range(top, bottom)
            for x in range(indent - 1)
        )

    line = label.fontMetrics().lineSpacing()
    assert drawn(long.top(), line)
    assert not drawn(line + 2, long.bottom() - 1)
    assert drawn(short.top(), short.bottom())
    label.deleteLater()
