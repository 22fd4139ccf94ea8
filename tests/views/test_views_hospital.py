"""Sign-in by the hospital in the window: where configured, patient, and undone by a cancel."""

import json
import sys
import threading
import time
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QPushButton
from test_views_language import german, rebuilding

sys.path.append(str(Path(__file__).parents[1] / "exchange"))
from oidc_issuer import Issuer, signed
from oidc_rig import Provider, browse, visit

from app.exchange.openid import OpenIdPlace, linked_keys, put_openid
from app.session.audit import entries, note
from app.session.people import People
from app.session.roster import RosterLine
from app.views.kit.access import ACCESS
from app.views.kit.roles import Role
from app.views.people.dialogs import EntryDialog
from app.views.people.feature import PeopleFeature
from app.views.people.hospital import WaitingDialog

_ = german, rebuilding  # fixtures
PASSWORD = "correct horse battery"
ROLES = {"instructors": ("teachers",), "technicians": ("technicians",)}


@pytest.fixture
def issuer():
    with Issuer() as issuer:
        yield issuer


@pytest.fixture
def feature(window, issuer, settle):
    """The people of a guarded station that asks the scripted provider."""
    People().set_instructor(PASSWORD)
    put_openid(OpenIdPlace(issuer.issuer, "acus", seconds=5.0, **ROLES), People())
    feature = window.feature(PeopleFeature)
    feature.look()
    assert settle(lambda: ACCESS.guarded)
    feature.opened = []
    feature.hospital._browse = lambda address: bool(feature.opened.append(address) or True)
    yield feature
    window.feature(PeopleFeature).close()


def hospital_button(dialog):
    return [b for b in dialog.findChildren(QPushButton) if b.text() == "Sign in by the hospital…"]


def begin(feature, settle):
    """Press the button, and return the dialog that waits for the browser."""
    feature.sign_in_student()
    hospital_button(feature.dialog)[0].click()
    dialog, before = feature.dialog, len(feature.opened)
    assert isinstance(dialog, WaitingDialog)
    assert settle(lambda: len(feature.opened) > before or dialog.again.isEnabled())
    return dialog


def answered(feature, settle, issuer, dialog):
    """Let the browser answer; return the dialog that follows, or None."""
    assert visit(issuer.browser(feature.opened[-1]))[0] == 200
    assert settle(lambda: feature.dialog is not dialog)
    return feature.dialog


def fill(dialog, *texts):
    for line, text in zip(dialog.lines, texts, strict=True):
        line.setText(text)
    return dialog.save()


@pytest.mark.long("journey")
def test_the_button_exists_only_where_a_provider_is_configured(window, settle):
    feature = window.feature(PeopleFeature)
    feature.sign_in_student()
    assert hospital_button(feature.dialog) == []
    feature.dialog.close()
    People().set_instructor(PASSWORD)
    put_openid(OpenIdPlace("https://login.hospital.example", "acus"), People())
    feature.look()
    assert settle(lambda: ACCESS.guarded)
    student = next(a for a in window.findChildren(type(feature._actions[1]))
                   if a.text() == "Sign in as a student…")  # fmt: skip
    assert student.isVisible()  # although nobody has a pseudonym yet
    for ask in (feature.sign_in_student, feature.sign_in_instructor):
        ask()
        (shown,) = hospital_button(feature.dialog)
        assert not shown.isDefault()
        feature.dialog.close()
    feature.close()


@pytest.mark.long("journey")
def test_somebody_new_chooses_pseudonym_and_pin_once_and_comes_in_by_the_hospital_from_then_on(
    feature, settle, issuer
):
    following = answered(feature, settle, issuer, begin(feature, settle))
    assert isinstance(following, EntryDialog)
    assert ACCESS.student is None
    assert not fill(following, "Ada", "271828", "271829")
    assert "the two PINs are not the same" in following.note.text()
    assert not fill(following, "Ada", "27", "27")
    assert ACCESS.student is None
    assert fill(following, "Ada", "271828", "271828")
    assert ACCESS.student.pseudonym == "Ada"
    assert ACCESS.role is Role.STUDENT
    ACCESS.sign_in(None)
    assert answered(feature, settle, issuer, begin(feature, settle)) is None
    assert ACCESS.student.pseudonym == "Ada"
    texts = [w.text() for w in feature.page.window().findChildren(QPushButton)]
    assert not [text for text in texts if "Lovelace" in text]
    ACCESS.sign_in(None)
    feature.sign_in_student()
    assert fill(feature.dialog, "Ada", "271828")  # the PIN stays
    assert ACCESS.student.pseudonym == "Ada"


@pytest.mark.long("journey")
def test_who_leaves_the_choice_of_a_pseudonym_is_not_signed_in(feature, settle, issuer):
    following = answered(feature, settle, issuer, begin(feature, settle))
    following.reject()
    assert ACCESS.student is None
    assert not ACCESS.instructor
    assert linked_keys(People()) == ()


@pytest.mark.long("journey")
def test_an_instructor_by_groups_needs_the_password_once_and_is_no_technician(
    window, feature, settle, issuer
):
    issuer.claims = {"groups": ["teachers"]}
    following = answered(feature, settle, issuer, begin(feature, settle))
    assert fill(following, "Tea", "271828", "271828")
    asked = feature.dialog
    assert "Instructor" in asked.windowTitle()
    assert not ACCESS.instructor
    assert not fill(asked, "guess")
    assert fill(asked, PASSWORD)
    assert ACCESS.instructor
    assert ACCESS.role is Role.INSTRUCTOR
    key = People().find("Tea").key
    note("students changed", [key])
    assert entries()[-1].who == key
    ACCESS.sign_in(None)
    assert ACCESS.role is Role.STUDENT
    assert answered(feature, settle, issuer, begin(feature, settle)) is None
    assert (ACCESS.instructor, ACCESS.role) == (True, Role.INSTRUCTOR)
    window.roles.choose(Role.TECHNICIAN)  # asks for the password, which opens all
    assert ACCESS.role is Role.INSTRUCTOR
    assert fill(feature.dialog, PASSWORD)
    assert ACCESS.role is Role.TECHNICIAN
    note("students changed", [key])
    assert entries()[-1].who == "instructor"


@pytest.mark.long("journey")
def test_who_has_no_password_goes_on_as_a_student(feature, settle, issuer):
    issuer.claims = {"groups": ["technicians"]}
    following = answered(feature, settle, issuer, begin(feature, settle))
    assert fill(following, "Tea", "271828", "271828")
    feature.dialog.reject()
    assert ACCESS.student.pseudonym == "Tea"
    assert not ACCESS.instructor


@pytest.mark.long("journey")
def test_a_technician_by_groups_is_one_and_no_more_once_the_group_is_gone(
    window, feature, settle, issuer
):
    issuer.claims = {"groups": ["technicians"]}
    following = answered(feature, settle, issuer, begin(feature, settle))
    assert fill(following, "Tec", "271828", "271828")
    assert fill(feature.dialog, PASSWORD)
    window.roles.choose(Role.TECHNICIAN)
    assert ACCESS.role is Role.TECHNICIAN
    ACCESS.sign_in(None)
    issuer.claims = {}
    assert answered(feature, settle, issuer, begin(feature, settle)) is None
    assert ACCESS.student.pseudonym == "Tec"
    assert ACCESS.role is Role.STUDENT


@pytest.mark.long("journey")
def test_a_sign_in_that_is_cancelled_leaves_nothing_that_listens(feature, settle, issuer):
    dialog = begin(feature, settle)
    question = feature.hospital._question
    dialog.reject()
    assert feature.dialog is None
    with pytest.raises(OSError, match=r".*"):
        visit(issuer.browser(feature.opened[-1]))
    settle()
    assert ACCESS.student is None
    assert feature.hospital._task is None
    assert question.listener._server is None
    assert issuer.redeemed == []


@pytest.mark.long("journey")
def test_a_sign_in_that_is_cancelled_before_the_provider_answers_leaves_nothing_that_listens(
    feature, settle, issuer
):
    def slow(link):
        time.sleep(0.4)
        document = json.dumps(issuer._discovery()).encode()
        link.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\n\r\n" % len(document))
        link.wfile.write(document)

    issuer.faults["/.well-known/openid-configuration"] = slow
    feature.sign_in_student()
    hospital_button(feature.dialog)[0].click()
    assert settle(lambda: issuer.paths)
    feature.dialog.reject()
    assert settle(lambda: not named("acus-background"))
    assert settle(lambda: not named("acus-openid"))
    assert feature.opened == []


def named(name):
    return [one for one in threading.enumerate() if one.name == name]


@pytest.mark.long("journey")
def test_a_button_that_is_pressed_twice_asks_once(feature, settle, issuer):
    feature.sign_in_student()
    shown = hospital_button(feature.dialog)[0]
    shown.click()
    shown.click()
    dialog = feature.dialog
    feature.hospital.begin()
    assert feature.dialog is dialog
    assert settle(lambda: feature.opened)
    settle()
    assert len(feature.opened) == 1
    assert issuer.paths == ["/.well-known/openid-configuration"]
    dialog.again.click()  # the same page once more
    assert feature.opened[0] == feature.opened[1]
    dialog.copy.click()
    assert QGuiApplication.clipboard().text() == feature.opened[0]
    dialog.reject()


@pytest.mark.long("journey")
def test_where_no_browser_opens_the_address_can_be_copied(feature, settle):
    feature.hospital._browse = lambda address: bool(feature.opened.append(address))
    dialog = begin(feature, settle)
    assert "copy the address" in dialog.note.text()
    assert dialog.copy.isEnabled()
    dialog.reject()


@pytest.mark.long("journey")
def test_a_browser_that_never_answers_ends_with_what_to_do_and_can_be_tried_again(
    feature, settle, issuer
):
    feature.hospital.patience = 0.3
    dialog = begin(feature, settle)
    assert settle(lambda: "nobody signed in at" in dialog.note.text())
    assert "PIN" in dialog.note.text()
    assert dialog.isVisible()
    assert dialog.copy.isHidden()
    feature.hospital.patience = 60.0
    dialog.again.click()
    assert settle(lambda: len(feature.opened) == 2)
    assert feature.opened[0] != feature.opened[1]
    assert isinstance(answered(feature, settle, issuer, feature.dialog), EntryDialog)
    feature.dialog.reject()


@pytest.mark.long("journey")
def test_a_provider_that_is_away_or_lies_signs_nobody_in(feature, settle, issuer):
    issuer.faults["/.well-known/openid-configuration"] = b"HTTP/1.1 500 no\r\n\r\n"
    dialog = begin(feature, settle)
    assert "cannot now (500)" in dialog.note.text()
    dialog.reject()
    issuer.faults.clear()
    issuer.token = lambda claims: signed(claims, None, "none")
    dialog = begin(feature, settle)
    visit(issuer.browser(feature.opened[-1]))
    assert settle(lambda: "is not believed" in dialog.note.text())
    dialog.reject()
    assert ACCESS.student is None
    assert not ACCESS.instructor


@pytest.mark.long("journey")
def test_a_window_that_goes_while_the_browser_asks_waits_for_nobody(feature, settle, issuer):
    begin(feature, settle)
    feature.close()
    with pytest.raises(OSError, match=r".*"):
        visit(issuer.browser(feature.opened[-1]))
    assert ACCESS.student is None


@pytest.mark.long("journey")
def test_a_window_that_goes_while_a_role_is_asked_for_lets_nobody_in(feature, settle, issuer):
    issuer.claims = {"groups": ["teachers"]}
    assert fill(answered(feature, settle, issuer, begin(feature, settle)), "Tea", "2718", "2718")
    feature.close()
    settle()
    assert ACCESS.student is None
    assert not ACCESS.instructor


@pytest.mark.long("journey")
def test_another_language_while_the_browser_asks_ends_the_waiting_and_signed_in_stays_so(
    rebuilding, settle, issuer
):
    people = People()
    people.set_instructor(PASSWORD)
    put_openid(OpenIdPlace(issuer.issuer, "acus", **ROLES), people)
    tea = people.add(RosterLine("Tea", "", "2718"))[0]
    feature = rebuilding.window.feature(PeopleFeature)
    feature.opened = []
    feature.hospital._browse = lambda address: bool(feature.opened.append(address) or True)
    begin(feature, settle)
    rebuilding.change("de")
    settle()
    with pytest.raises(OSError, match=r".*"):
        visit(issuer.browser(feature.opened[-1]))
    assert ACCESS.student is None
    feature = rebuilding.window.feature(PeopleFeature)
    assert feature.dialog is None
    feature.look()
    assert settle(lambda: ACCESS.guarded)
    ACCESS.sign_in(None, True, Role.INSTRUCTOR, tea.key)
    rebuilding.change("en")
    settle()
    assert ACCESS.signed_in == (None, True, Role.INSTRUCTOR, tea.key)
    assert ACCESS.role is Role.INSTRUCTOR
    rebuilding.window.feature(PeopleFeature).close()


@pytest.mark.long("journey")
def test_somebody_signs_in_at_a_provider_that_is_not_ours_by_the_window(feature, settle):
    with Provider() as provider:
        provider.user("ada", groups=["nurses"])
        put_openid(OpenIdPlace(provider.issuer, "acus", secret="s", **ROLES), People())
        dialog = begin(feature, settle)
        assert urlsplit(feature.opened[-1]).netloc == urlsplit(provider.issuer).netloc
        browse(feature.opened[-1], sub="ada")
        assert settle(lambda: feature.dialog is not dialog)
        assert fill(feature.dialog, "Ada", "271828", "271828")
        assert ACCESS.student.pseudonym == "Ada"
