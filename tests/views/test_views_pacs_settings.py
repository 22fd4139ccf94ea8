"""The configuration of PACS in the window: entered, tried, refused, removed."""

import sys
from pathlib import Path

import pytest
from PySide6.QtWidgets import QDialogButtonBox, QMessageBox, QToolButton

sys.path.append(str(Path(__file__).parents[1] / "imaging"))

from dicom_factory import Slices
from pacs_rig import FakePacs

from app.imaging.pacs.settings import TlsSettings, configured, keep, pacs_path
from app.views.pacs.settings import PacsSettingsDialog


@pytest.fixture
def open_dialog(application, destroy):
    made = []

    def make():
        made.append(PacsSettingsDialog())
        destroy(made[-1])
        made[-1].open()
        return made[-1]

    yield make
    for dialog in made:
        dialog.done(0)  # without the question about changes


def enter(dialog, **values):
    dialog.form.show_values(dialog.form.values() | values)


@pytest.fixture
def pacs(tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        yield pacs


def test_what_is_entered_is_kept_and_read_again(open_dialog):
    dialog = open_dialog()
    assert not dialog.form.isEnabled()
    dialog.add()
    tls = {"authority": "/a.pem", "certificate": "", "key": "", "check_name": False}
    enter(dialog, name="archive", host="pacs.example", port=2762, title="ARCHIVE", tls=tls)
    assert dialog.save()
    (one,) = configured()
    assert (one.name, one.host, one.port, one.title) == ("archive", "pacs.example", 2762, "ARCHIVE")
    assert one.tls == TlsSettings(**tls)
    again = open_dialog()
    assert again.list.item(0).text() == "archive"
    assert again.form.values() == dialog.form.values()
    again.reject()  # nothing was changed: no question


def test_a_name_is_taken_over_into_the_list_while_it_is_typed(open_dialog):
    dialog = open_dialog()
    dialog.add()
    dialog.form.fields["name",].textEdited.emit("other")
    assert dialog.list.currentItem().text() == "other"
    dialog.add()
    assert dialog.list.count() == 2


def test_what_cannot_be_used_is_said_and_nothing_is_written(open_dialog):
    dialog = open_dialog()
    dialog.add()
    enter(dialog, name="archive", host="h", title="A" * 16)
    dialog.add()
    enter(dialog, name="other", host="h", title="FAR TOO LONG A TITLE")
    dialog.list.setCurrentRow(0)
    assert not dialog.save()
    assert dialog.list.currentRow() == 1
    assert "title" in dialog.note.text()
    enter(dialog, name="archive", title="B")
    assert not dialog.save()
    assert "twice" in dialog.note.text()
    assert not pacs_path().exists()


def test_the_test_asks_the_archive_of_the_form_without_keeping_it(open_dialog, pacs, settle):
    dialog = open_dialog()
    dialog.add()
    wanted = pacs.settings(timeout_s=10.0).model_dump(exclude_none=True)
    enter(dialog, **wanted)
    dialog.test()
    assert settle(lambda: "answers in" in dialog.note.text()), dialog.note.text()
    enter(dialog, **(wanted | {"title": "WRONG"}))
    settle(dialog.test_button.isEnabled)
    dialog.test()
    assert settle(lambda: "another AE title" in dialog.note.text()), dialog.note.text()
    assert not pacs_path().exists()


@pytest.mark.long("journey")
def test_a_test_of_a_silent_archive_can_be_cancelled(open_dialog, pacs, settle):
    pacs.ill = "silent"
    dialog = open_dialog()
    dialog.add()
    enter(dialog, **pacs.settings(timeout_s=60.0).model_dump(exclude_none=True))
    dialog.test()
    settle(timeout=0.5)
    dialog.strip.findChild(QToolButton).click()
    assert settle(lambda: dialog.note.text() == "Cancelled")
    assert settle(dialog.test_button.isEnabled)


def test_one_is_removed_and_a_close_with_changes_asks(open_dialog, pacs, monkeypatch):
    keep((pacs.settings(name="a"), pacs.settings(name="b")))
    dialog = open_dialog()
    dialog.remove()
    asked = []
    answers = iter((QMessageBox.StandardButton.Cancel, QMessageBox.StandardButton.Save))
    monkeypatch.setattr(QMessageBox, "question",
                        staticmethod(lambda *_: (asked.append(1), next(answers))[1]))  # fmt: skip
    dialog.reject()
    assert dialog.isVisible()
    dialog.reject()
    assert not dialog.isVisible()
    assert len(asked) == 2
    assert [one.name for one in configured()] == ["b"]


def test_a_damaged_configuration_is_said_and_can_be_replaced(open_dialog):
    pacs_path().parent.mkdir(parents=True, exist_ok=True)
    pacs_path().write_text("servers: 7\n")
    dialog = open_dialog()
    assert "servers" in dialog.note.text()
    dialog.add()
    enter(dialog, name="a", host="h", title="A")
    dialog.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert len(configured()) == 1


def test_an_archive_by_the_web_is_entered_kept_and_read_again(open_dialog):
    dialog = open_dialog()
    dialog.add()
    form = dialog.form
    assert not form.fields["web", "url"].isEnabled()
    form.retrieve.setCurrentIndex(form.retrieve.findData("web"))
    assert form.fields["web", "url"].isEnabled()
    assert not form.fields["host",].isEnabled()
    form.fields["name",].setText("house")
    form.fields["web", "url"].setText("http://pacs.example/dicom-web")
    assert not dialog.save()
    assert "https" in dialog.note.text()
    form.fields["web", "url"].setText(" https://pacs.example/dicom-web ")
    form.fields["web", "user"].setText("acus")
    form.fields["web", "password"].setText(" s3cret")
    assert dialog.save()
    (one,) = configured()
    assert (one.host, one.port, one.retrieve) == ("pacs.example", 443, "web")
    assert (one.web.url, one.web.password) == ("https://pacs.example/dicom-web", " s3cret")
    again = open_dialog()
    assert again.form.values() == form.values()
    again.reject()  # nothing was changed: no question


def test_without_a_web_address_the_field_is_named(open_dialog):
    dialog = open_dialog()
    dialog.add()
    dialog.form.fields["name",].setText("house")
    dialog.form.retrieve.setCurrentIndex(dialog.form.retrieve.findData("web"))
    assert not dialog.save()
    assert "web" in dialog.note.text()
