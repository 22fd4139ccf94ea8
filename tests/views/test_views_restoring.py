"""A backup is brought back in the window, and what came of it is told."""

import zipfile

import pytest
from PySide6.QtWidgets import QCheckBox, QPlainTextEdit
from test_views_people import record

from app.session.archive import backup
from app.session.people import People
from app.session.roster import RosterLine
from app.views.kit.access import ACCESS
from app.views.people.feature import PeopleFeature


@pytest.fixture
def feature(window):
    yield window.feature(PeopleFeature)
    window.feature(PeopleFeature).close()


def test_attempts_that_are_missing_come_back_and_it_is_told_what_stays(
    window, feature, settle, tmp_path
):
    folder = feature.context.services.sessions()
    person, _ = People().add(RosterLine("Ada"))
    record(folder, "a", person.key, 72.0)
    record(folder, "b", person.key, 82.0)
    backup(tmp_path / "all.acusbackup", folder)
    (folder / "b.mcap").unlink()
    People().add(RosterLine("Bob"))
    feature.show()
    feature.restorer.ask(tmp_path / "all.acusbackup")
    dialog = feature.dialog
    dialog.save()
    assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
    text = feature.dialog.findChild(QPlainTextEdit).toPlainText()
    assert text.splitlines() == [
        "1 attempt was here already.",
        "Students and courses here stay as they are.",
        "There is no station's key in the backup.",
    ]
    feature.dialog.close()
    assert (folder / "b.mcap").exists()
    assert {one.pseudonym for one in People().everybody()} == {"Ada", "Bob"}


def test_students_of_the_backup_take_the_place_of_those_here_where_that_is_asked(
    window, feature, settle, tmp_path
):
    folder = feature.context.services.sessions()
    People().add(RosterLine("Ada"))
    backup(tmp_path / "all.acusbackup", folder)
    People().add(RosterLine("Bob"))
    feature.show()
    feature.restorer.ask(tmp_path / "all.acusbackup")
    dialog = feature.dialog
    dialog.findChild(QCheckBox).setChecked(True)
    dialog.save()
    assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
    assert "those of the backup" in feature.dialog.findChild(QPlainTextEdit).toPlainText()
    feature.dialog.close()
    assert {one.pseudonym for one in People().everybody()} == {"Ada"}


def test_a_file_that_is_no_backup_and_a_wrong_key_change_nothing(window, feature, settle, tmp_path):
    said = []
    feature.failed.connect(said.append)
    with zipfile.ZipFile(tmp_path / "other.acusbackup", "w") as archive:
        archive.writestr("a", "b")
    feature.show()
    feature.restorer.restore(tmp_path / "other.acusbackup")
    assert settle(lambda: len(said) == 1)
    assert "is no backup of Acus" in str(said[0])
    People().set_instructor("correct horse battery")
    backup(tmp_path / "all.acusbackup", feature.context.services.sessions())
    feature.restorer.restore(tmp_path / "all.acusbackup", "AAAA-BBBB")
    assert settle(lambda: len(said) == 2)


def test_backups_are_the_instructors(window, feature, settle, tmp_path):
    People().set_instructor("correct horse battery")
    feature.look()
    settle(lambda: not ACCESS.may_manage)
    said = []
    feature.failed.connect(said.append)
    feature.restorer.choose()
    feature.restorer.restore(tmp_path / "all.acusbackup")
    assert len(said) == 2
