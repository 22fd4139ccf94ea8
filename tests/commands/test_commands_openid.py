"""`acus people openid`: a provider is named, tried, and forgotten."""

import json
import sys
import threading
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "exchange"))
from oidc_issuer import Issuer
from oidc_rig import Provider, browse, visit

from app.__main__ import main
from app.exchange.openid import HospitalIdentity, OpenIdPlace, link, place_of_openid, put_openid
from app.session.audit import entries
from app.session.people import People

PASSWORD = "correct horse battery"


@pytest.fixture
def acus(monkeypatch, capsys):
    def run(*words, code=0):
        monkeypatch.setattr("sys.argv", ["acus", "people", "openid", *words, "--json"])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        return json.loads(out)["facts"] if out else err

    monkeypatch.setenv("ACUS_INSTRUCTOR_PASSWORD", PASSWORD)
    People().set_instructor(PASSWORD)
    return run


@pytest.fixture
def issuer():
    with Issuer() as issuer:
        yield issuer


@pytest.mark.long("journey")
def test_a_provider_is_asked_before_it_is_kept_and_forgotten_with_its_links(acus, issuer):
    assert acus()["issuer"] is None
    words = ("--issuer", issuer.issuer, "--client", "acus", "--instructor", "a", "--instructor")
    facts = acus(*words, "b", "--technician", "c", "--student", "d", "--claim", "roles")
    assert facts == {
        "issuer": issuer.issuer, "client": "acus", "claim": "roles", "linked": 0, "tried": None,
        "groups": {"student": ["d"], "instructor": ["a", "b"], "technician": ["c"]},
    }  # fmt: skip
    assert issuer.paths == ["/.well-known/openid-configuration", "/keys"]
    link(People(), HospitalIdentity(issuer.issuer, "sub"), "Ada", "271828")
    assert acus()["linked"] == 1
    assert acus("--unlink", "ada")["linked"] == 0
    assert acus("--forget")["issuer"] is None
    assert [one.what for one in entries() if "sign-in" in one.what] == [
        "sign-in configured", "sign-in linked", "sign-in unlinked", "sign-in configured",
    ]  # fmt: skip


@pytest.mark.long("journey")
def test_what_answers_but_is_no_provider_is_not_kept(acus, issuer):
    issuer.document = {"issuer": f"{issuer.issuer}/"}
    err = acus("--issuer", issuer.issuer, "--client", "acus", code=2)
    assert "is the document of the issuer" in err
    assert err.count("\n") == 1
    assert "is no address" in acus("--issuer", "hospital", "--client", "acus", code=2)
    assert "client" in acus("--issuer", issuer.issuer, code=2)
    assert "no provider is named" in acus("--try", code=2)
    assert place_of_openid() is None


def test_without_the_package_nothing_is_kept_and_its_extra_is_named(acus, issuer, monkeypatch):
    monkeypatch.setitem(sys.modules, "joserfc", None)
    err = acus("--issuer", issuer.issuer, "--client", "acus", code=2)
    assert "joserfc is not installed" in err
    assert "`school`" in err
    assert place_of_openid() is None


def test_a_secret_is_read_from_its_variable_and_shown_nowhere(acus, issuer, monkeypatch):
    monkeypatch.setenv("ACUS_OPENID_SECRET", "very secret")
    facts = acus("--issuer", issuer.issuer, "--client", "acus", "--secret")
    assert "very secret" not in json.dumps(facts)
    assert place_of_openid().secret == "very secret"
    assert "very secret" not in repr(place_of_openid())


def test_a_try_says_the_role_and_signs_nobody_in(acus, issuer, monkeypatch, capsys):
    put_openid(OpenIdPlace(issuer.issuer, "acus", instructors=("teachers",)), People())
    issuer.claims = {"groups": ["teachers"]}
    monkeypatch.setattr("webbrowser.open", lambda address: visit(issuer.browser(address)))
    before = len(entries())
    assert acus("--try")["tried"] == "instructor"
    assert len(entries()) == before
    assert acus()["linked"] == 0


@pytest.mark.long("journey")
def test_a_try_at_a_provider_that_is_not_ours(acus, monkeypatch):
    with Provider() as provider:
        monkeypatch.setenv("ACUS_OPENID_SECRET", "any")
        words = ("--issuer", provider.issuer, "--client", "acus", "--secret")
        assert acus(*words, "--technician", "engineers")["issuer"] == provider.issuer
        provider.user("ada", groups=["engineers"])
        monkeypatch.setattr("webbrowser.open", lambda address: browse(address, sub="ada"))
        assert acus("--try")["tried"] == "technician"
    assert not [one for one in threading.enumerate() if one.name == "acus-openid"]
