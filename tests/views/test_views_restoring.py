"""A backup is brought back in the window, and what came of it is told."""

import zipfile
from itertools import pairwise

import pytest
from PySide6.QtWidgets import QApplication, QCheckBox, QPlainTextEdit
from test_views_people import record

from app.session.archive import backup, backup_into, check_backup
from app.session.backup_folder import backups_of, is_encrypted
from app.session.people import People
from app.session.roster import RosterLine
from app.views.kit.access import ACCESS
from app.views.people.dialogs import EntryDialog
from app.views.people.feature import PeopleFeature


@pytest.fixture
def feature(window):
    yield window.feature(PeopleFeature)
    window.feature(PeopleFeature).close()


@pytest.mark.long("journey")
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


@pytest.mark.long("journey")
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


@pytest.mark.long("journey")
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


@pytest.mark.long("journey")
def test_backups_are_the_instructors(window, feature, settle, tmp_path):
    People().set_instructor("correct horse battery")
    feature.look()
    settle(lambda: not ACCESS.may_manage)
    said = []
    feature.failed.connect(said.append)
    feature.restorer.choose()
    feature.restorer.restore(tmp_path / "all.acusbackup")
    assert len(said) == 2


@pytest.mark.long("journey")
def test_an_encrypted_backup_asks_for_its_passphrase(window, feature, settle, tmp_path):
    folder = feature.context.services.sessions()
    person, _ = People().add(RosterLine("Ada"))
    record(folder, "a", person.key, 72.0)
    path = backup_into(tmp_path / "backups", folder, passphrase="correct horse").path
    (folder / "a.mcap").unlink()
    feature.show()
    feature.restorer.ask(path)
    dialog = feature.dialog
    assert dialog.names == ["Recovery key", "Passphrase of the backup"]
    dialog.lines[1].setText("wrong horse")
    assert not dialog.save()  # it is said while it can be typed again
    assert "that is not its passphrase" in dialog.note.text()
    assert feature.dialog is dialog
    dialog.lines[1].setText("correct horse")
    assert dialog.save()
    assert settle(lambda: (folder / "a.mcap").exists())
    assert settle(lambda: feature.dialog is not None and feature.dialog is not dialog)
    feature.dialog.close()


@pytest.mark.long("journey")
def test_backups_into_a_folder_keep_its_passphrase(window, feature, settle, tmp_path):
    folder, room = feature.context.services.sessions(), tmp_path / "backups"
    person, _ = People().add(RosterLine("Ada"))
    record(folder, "a", person.key, 72.0)
    said = []
    feature.noted.connect(said.append)
    feature.show()
    feature.folder_backups.ask(room)
    first = feature.dialog
    first.lines[0].setText("correct horse")
    assert not first.save()
    assert "not the same" in first.note.text()
    first.lines[1].setText("correct horse")
    assert first.save()
    assert settle(lambda: any("1 attempt saved" in text for text in said))
    assert is_encrypted(room)
    feature.folder_backups.ask(room)
    second = feature.dialog
    assert len(second.lines) == 1
    second.lines[0].setText("wrong horse")
    assert not second.save()
    assert "that is not its passphrase" in second.note.text()
    second.lines[0].setText("correct horse")
    assert second.save()
    assert settle(lambda: len(backups_of(room)) == 2)
    check_backup(room, passphrase="correct horse")


def test_a_backup_into_a_folder_that_is_not_encrypted_asks_for_nothing(
    window, feature, settle, tmp_path
):
    folder = feature.context.services.sessions()
    backup_into(tmp_path, folder)
    feature.show()
    feature.folder_backups.ask(tmp_path)
    assert feature.dialog.lines == []
    assert feature.dialog.save()
    assert settle(lambda: len(backups_of(tmp_path)) == 2)


def test_fields_do_not_lie_over_each_other_below_long_words(window):
    fields = [(name, False) for name in ("Address", "Ids begin with", "User", "Password")]
    dialog = EntryDialog("Record store", fields, lambda *_: None, "a long sentence " * 20, window)
    dialog.show()
    dialog.say("what a busy server answered, and what to do " * 6)
    QApplication.processEvents()
    boxes = [line.geometry() for line in dialog.lines]
    assert all(a.bottom() < b.top() for a, b in pairwise(boxes))
    assert dialog.note.geometry().top() > boxes[-1].bottom()
    dialog.deleteLater()
