from pathlib import Path
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMainWindow
from views_exercise_attempts import placed_plan, review

from app.session.errors import SessionError
from app.session.facts import plan_record
from app.session.recording import Recording
from app.session.review import review_of_result
from app.session.samples import Samples
from app.session.sidecar import write_summary
from app.session.summary import Summary
from app.session.ticks import Inputs
from app.views.debrief.feature import DebriefController
from app.views.debrief.page import DebriefPage
from app.views.debrief.sessions import (
    DURATION,
    NOTE,
    SCORE,
    STATE,
    STUDENT,
    SUMMARY_ROLE,
    SessionsPage,
    score_text,
)


def summary(name: str, **changes: object) -> Summary:
    values = {
        "started": f"2026-11-2{name}T10:15:00.000+00:00", "student": f"student-0{name}",
        "exercise_title": "First insertion", "state": "ended", "duration": 60.0 + int(name),
        "score": MappingProxyType({"total": 80.0 - 10 * int(name), "passed": True, "rows": []}),
    }  # fmt: skip
    return Summary(id=f"s{name}", **(values | changes))


def fill(folder: Path) -> None:
    """Two sessions and a file that is none."""
    for name in ("1", "2"):
        path = folder / f"s{name}.mcap"
        path.write_bytes(b"not opened: the sidecar is enough")
        write_summary(path, summary(name))
    (folder / "broken.mcap").write_bytes(b"text")


def wait_until(condition, timeout=30.0):
    for _ in range(int(timeout / 0.01)):
        if condition():
            return
        QTest.qWait(10)
    raise AssertionError("timed out")


@pytest.fixture
def page(qt, tmp_path):
    fill(tmp_path)
    widget = SessionsPage(tmp_path)
    widget.resize(1000, 500)
    widget.show()
    widget.refresh()
    wait_until(lambda: widget.model.rowCount() == 3)
    yield widget
    widget.close()
    widget.deleteLater()


def shown(page, column):
    return [page.proxy.index(row, column).data() for row in range(page.proxy.rowCount())]


def test_newest_first_then_by_whatever_column_is_clicked(page):
    assert [name for name in shown(page, STUDENT) if name] == ["student-02", "student-01"]
    page.table.sortByColumn(SCORE, Qt.SortOrder.DescendingOrder)
    assert shown(page, SCORE) == ["✔ 70", "✔ 60", ""]
    page.table.sortByColumn(DURATION, Qt.SortOrder.AscendingOrder)
    assert shown(page, DURATION) == ["", "1:01", "1:02"]


def test_a_broken_file_is_listed_with_the_reason_and_cannot_be_opened(page):
    said = []
    page.failed.connect(said.append)
    row = next(i for i, text in enumerate(shown(page, STATE)) if "Broken" in text)
    page.table.selectRow(row)
    assert not page.open_button.isEnabled()
    assert not page.export.isEnabled()
    assert page.delete_button.isEnabled()
    page._open(page.proxy.index(row, 0))
    assert "MCAP" in said[0]


def test_a_filter_that_hides_all_leaves_the_columns_wide_enough(page):
    widths = [page.table.columnWidth(column) for column in range(4)]
    page.search.setText("nobody at all")
    model = page.model
    page.show_summaries([model.index(n, 0).data(SUMMARY_ROLE) for n in range(model.rowCount())])
    page.search.clear()
    assert [page.table.columnWidth(column) for column in range(4)] == widths


def test_the_filter_looks_at_every_column(page):
    page.search.setText("student-01")
    assert shown(page, STUDENT) == ["student-01"]
    assert "1 of 3" in page._count.text()
    page.search.setText("nobody")
    assert page.proxy.rowCount() == 0


def test_the_keys_of_undo_are_the_tables_even_beside_a_window_that_has_them_too(page, tmp_path, qt):
    window, heard = QMainWindow(), []
    action = QAction("Undo", window)
    action.setShortcut("Ctrl+Z")
    action.triggered.connect(lambda: heard.append("window"))
    window.addAction(action)
    window.setCentralWidget(page)
    window.show()
    window.activateWindow()
    page.table.setFocus()
    qt.processEvents()
    page.undo_delete = lambda: heard.append("table")
    QTest.keyClick(page.table, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert heard == ["table"]
    window.takeCentralWidget()
    window.close()


def test_what_is_deleted_comes_back_with_undo(page, tmp_path):
    page.search.setText("student-01")
    page.table.selectRow(0)
    page.delete_selected()
    wait_until(lambda: page.model.rowCount() == 2)
    assert not (tmp_path / "s1.mcap").exists()
    assert page.undo.isEnabled()
    page.undo_delete()
    wait_until(lambda: page.model.rowCount() == 3)
    assert (tmp_path / "s1.mcap").exists()
    assert not page.undo.isEnabled()


def test_a_selected_session_is_opened_by_button_and_double_click(page):
    opened = []
    page.open_requested.connect(opened.append)
    page.search.setText("student-02")
    page.table.selectRow(0)
    page.open_button.click()
    page.table.doubleClicked.emit(page.proxy.index(0, 0))
    assert [s.id for s in opened] == ["s2", "s2"]


def test_an_empty_or_missing_folder_says_what_to_do(qt, tmp_path):
    widget = SessionsPage(tmp_path / "none")
    done = []
    widget.model.modelReset.connect(lambda: done.append(1))
    widget.refresh()
    wait_until(lambda: done)
    assert "No sessions yet" in widget._count.text()
    widget.deleteLater()


def test_a_void_score_is_called_void():
    assert score_text(summary("1", score={"total": None, "void_reason": "x"})) == "void"
    assert score_text(summary("1", score={"total": 41.0, "passed": False})) == "✖ 41"
    assert score_text(summary("1", score=None)) == ""


@pytest.fixture
def desk(page, tmp_path):
    debrief = DebriefPage()
    target = tmp_path / "out"
    controller = DebriefController(
        debrief, page, tmp_path, ask_path=lambda _p, _t, start, _k: str(target / Path(start).name)
    )
    said, saved = [], []
    controller.failed.connect(said.append)
    controller.saved.connect(saved.append)
    yield SimpleNamespace(controller=controller, page=debrief, out=target, said=said, saved=saved)
    debrief.deleteLater()


def test_the_report_is_written_where_the_user_says(desk):
    desk.page.show_review(review())
    desk.page.report.click()
    wait_until(lambda: desk.saved)
    assert Path(desk.saved[0]).read_bytes().startswith(b"%PDF")


def test_selected_sessions_are_exported_as_one_table(desk, page):
    page.table.selectAll()
    page.export.click()
    wait_until(lambda: desk.saved)
    text = Path(desk.saved[0]).read_text(encoding="utf-8-sig")
    assert len(text.splitlines()) == 3
    assert "Training only" in text


def test_a_record_that_cannot_be_read_is_said_in_words(desk):
    desk.controller.open_session("broken")
    wait_until(lambda: desk.said)
    assert "MCAP" in desk.said[0]


def test_a_folder_that_cannot_be_written_is_said_in_words(desk):
    desk.out.write_text("a file, not a folder")
    desk.page.show_review(review())
    desk.page.report.click()
    wait_until(lambda: desk.said)
    assert desk.said[0].startswith("Cannot write")


def test_saying_no_in_the_dialog_writes_nothing(desk, page, tmp_path):
    controller = DebriefController(desk.page, page, tmp_path, ask_path=lambda *_: "")
    controller.save_report(review())
    QTest.qWait(50)
    assert not desk.out.exists()


def result(samples):
    """An attempt that could not be recorded, as it is in memory."""
    placed = placed_plan()
    recording = Recording(
        path=Path("s1.mcap"), complete=False, problems=("disk full",),
        metadata=MappingProxyType({
            "session": {"id": "s1", "student": "student-07"}, "exercise": {"id": "x"},
            "plan": plan_record(placed), "result": {"state": "ended", "duration_s": "4.0"},
        }),
        attachments=MappingProxyType({}), events=(), samples=samples,
        inputs=Inputs((), np.empty((0, 0)), 0),
    )  # fmt: skip
    known = None if samples is None else object()
    return SimpleNamespace(
        record=None, trajectory=known, recording=recording, reason="", unscored=""
    )


def test_an_attempt_that_could_not_be_recorded_is_shown_from_memory():
    placed, nothing = placed_plan(), np.zeros((5, 3))
    samples = Samples(
        time=np.arange(5.0), valid=np.ones(5, dtype=bool), depth=np.linspace(0.0, 0.05, 5),
        state=np.array(["aligning", "inserting", "inserting", "holding", "holding"]),
        tip=placed.p_entry + np.linspace(0.0, 0.05, 5)[:, None] * placed.axis,
        axis=np.tile(placed.axis, (5, 1)), depth_source=np.array(["tracked"] * 5),
        target=np.tile(placed.p_target, (5, 1)), hub=nothing, guide=nothing, felt=nothing,
        measured=np.full(5, np.nan),
    )  # fmt: skip
    shown = review_of_result(result(samples))
    assert [s.state for s in shown.spans] == ["aligning", "inserting", "holding"]
    assert shown.problems[0] == "disk full"
    assert shown.score is not None


def test_an_attempt_that_left_nothing_is_refused_in_words():
    with pytest.raises(SessionError, match="nothing to show"):
        review_of_result(result(None))


def test_columns_stand_apart_so_that_a_score_and_what_follows_are_two_words(page):
    table, model = page.table, page.table.model()
    for column in range(NOTE):
        widest = max(
            table.fontMetrics().horizontalAdvance(str(model.index(row, column).data() or ""))
            for row in range(model.rowCount())
        )
        assert table.columnWidth(column) >= widest + 10, column
