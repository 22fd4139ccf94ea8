"""The school's store in the window: connected to, kept up to date, and off the network."""

import pytest
from PySide6.QtWidgets import QCheckBox, QLabel, QPlainTextEdit
from sqlalchemy import event
from test_views_people import record

from app.session.people import People
from app.session.roster import RosterLine
from app.session.school_store import (
    SchoolStore,
    StorePlace,
    place_of_store,
    put_place,
    synchronise,
)
from app.session.station import StationKey
from app.session.stations import fingerprint, set_name
from app.views.kit.access import ACCESS
from app.views.people.feature import PeopleFeature


def made(place):
    """Make the tables of a store."""
    store = place.store()
    store.open()
    store.close()
    return place


@pytest.fixture
def feature(window):
    yield window.feature(PeopleFeature)
    window.feature(PeopleFeature).close()


def other_station(monkeypatch, root, place, *attempts):
    """Another station meets the store, and makes it first."""
    made(place)
    with monkeypatch.context() as other:
        other.setenv("ACUS_DATA", str(root / "data"))
        set_name("Theatre 2")
        for name in attempts:
            record(root / "records", name, "Bob", 80.0)
        return synchronise(place, root / "records", People(), trust=True)


@pytest.mark.long("journey")
def test_a_station_is_connected_and_lets_another_one_in(
    window, feature, settle, tmp_path, monkeypatch
):
    folder = feature.context.services.sessions()
    place = StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}")
    other_station(monkeypatch, tmp_path / "other", place, "b")
    feature.link.connect_store()
    assert "set the instructor's password first" in feature.dialog.findChild(QLabel).text()
    feature.dialog.close()
    People().set_instructor("correct horse battery")
    ACCESS.sign_in(None, instructor=True)
    record(folder, "a", People().add(RosterLine("Ada"))[0].key, 72.0)
    feature.show()
    feature.link.connect_store()
    dialog = feature.dialog
    dialog.lines[0].setText("somewhere")
    dialog.save()
    assert "is no URL of a school's store" in dialog.note.text()
    dialog.lines[0].setText(place.url)
    dialog.findChildren(QCheckBox)[0].setChecked(True)
    dialog.lines[0].setText("postgresql://acus:secret@127.0.0.1:1/acus")
    dialog.save()
    assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
    dialog = feature.dialog  # again, with what was typed and what is wrong with it
    assert "does not answer" in dialog.note.text()
    assert dialog.lines[0].text().startswith("postgresql://acus")
    assert dialog.findChildren(QCheckBox)[0].isChecked()
    dialog.lines[0].setText(place.url)
    dialog.save()
    assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
    asked = feature.dialog
    assert asked.text() == "Let these stations in?"
    assert "Theatre 2" in asked.informativeText()
    assert not (folder / "b.mcap").exists()
    assert "1 station waits to be let in" in feature.page.board.store.text()
    next(b for b in asked.buttons() if b.text() == "Let them in").click()
    assert settle(lambda: feature.dialog is not None and feature.dialog is not asked)
    text = feature.dialog.findChild(QPlainTextEdit).toPlainText()
    assert text == "From other stations: 1 attempt added, 0 here already"
    feature.dialog.close()
    assert (folder / "b.mcap").exists()
    assert feature.page.board.store.text().startswith("School's store: up to date at ")
    known = place_of_store()
    assert known is not None
    assert (known.url, known.gives_course, known.pins) == (place.url, True, True)
    other_station(monkeypatch, tmp_path / "other", place)
    assert (tmp_path / "other" / "records" / "a.mcap").exists()


@pytest.mark.long("journey")
def test_what_comes_is_taken_in_quietly_but_not_while_an_attempt_runs(
    window, feature, settle, tmp_path, monkeypatch
):
    folder = feature.context.services.sessions()
    place = made(StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}"))
    synchronise(place, folder, People())
    other_station(monkeypatch, tmp_path / "other", place, "b")
    synchronise(place, folder, People(), trust=True)
    other_station(monkeypatch, tmp_path / "other", place, "c")
    put_place(place)
    feature.show()
    running = [True]
    feature.link._busy = lambda: running[0]
    feature.link.quietly()
    assert not feature.page.board.store.text()
    running[0] = False
    feature.link.quietly()
    feature.link.quietly()  # too fast: one at a time
    assert settle(lambda: (folder / "c.mcap").exists())
    assert settle(lambda: feature.page.board.store.text().startswith("School's store"))


@pytest.mark.long("journey")
def test_a_store_that_is_away_is_told_with_how_many_attempts_wait(
    window, feature, settle, tmp_path
):
    folder = feature.context.services.sessions()
    share = tmp_path / "share"
    share.mkdir()
    place = made(StorePlace(f"sqlite:///{share / 'school.sqlite'}"))
    put_place(place)
    synchronise(place, folder, People())
    record(folder, "a", "Ada", 72.0)
    share.rename(tmp_path / "away")
    share.mkdir()  # as the empty folder of a share that is not mounted
    feature.show()
    feature.link.quietly()
    board = feature.page.board
    assert settle(lambda: "is not there: look whether its share is mounted" in board.store.text())
    assert board.store.text().endswith("1 attempt waits to be sent.")
    assert not list(share.iterdir())
    share.rmdir()
    (tmp_path / "away").rename(share)
    feature.link.now()
    assert settle(lambda: board.store.text().startswith("School's store: up to date"))
    assert settle(lambda: feature.dialog is not None)
    feature.dialog.close()


@pytest.mark.long("journey")
def test_a_full_store_is_one_line_on_the_board_and_goes_when_there_is_room(
    window, feature, settle, tmp_path, monkeypatch
):
    folder = feature.context.services.sessions()
    place = made(StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}"))
    put_place(place)
    for number in range(3):
        record(folder, f"a{number}", "Ada", 72.0)
    opened = SchoolStore.open

    def limited(store, make=True):
        limit = "PRAGMA max_page_count = 8"
        event.listen(store._engine, "connect", lambda one, _: one.execute(limit))
        opened(store, make)

    feature.show()
    board = feature.page.board
    with monkeypatch.context() as full:
        full.setattr(SchoolStore, "open", limited)
        feature.link.quietly()
        assert settle(lambda: "has no room left: its administrator makes" in board.store.text())
    assert board.store.text().endswith("3 attempts wait to be sent.")
    assert "\n" not in board.store.text()
    assert settle(lambda: feature.link._task is None)
    feature.link.quietly()
    assert settle(lambda: board.store.text().startswith("School's store: up to date"))
    other_station(monkeypatch, tmp_path / "other", place)
    assert len(list((tmp_path / "other" / "records").glob("a*.mcap"))) == 3


@pytest.mark.long("journey")
def test_the_store_is_the_instructors(window, feature, settle, tmp_path):
    People().set_instructor("correct horse battery")
    feature.look()
    settle(lambda: not ACCESS.may_manage)
    said = []
    feature.failed.connect(said.append)
    feature.link.now()
    feature.link.connect_store()
    assert len(said) == 2
    assert feature.dialog is None


@pytest.mark.long("journey")
def test_a_station_shows_what_others_compare(window, feature, settle):
    set_name("Theatre 1")
    feature.show()
    feature.stations.show_station()
    lines = feature.dialog.findChild(QPlainTextEdit).toPlainText().splitlines()
    assert lines == ["Theatre 1", fingerprint(StationKey.of().public)]
    feature.dialog.close()
