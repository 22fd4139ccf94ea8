"""Sign-in by the hospital: at a provider that is not ours, and at one that answers by a script."""

import json
import logging
import socket
import sys
import threading
import time
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest

sys.path.append(str(Path(__file__).parent))
from oidc_issuer import CURVE, EDWARDS, OTHER, RSA, SMALL, Issuer, jwk, pem, signed
from oidc_rig import Provider, browse, visit

from app.core.progress import Cancelled, Progress
from app.exchange.openid import (
    HospitalIdentity,
    OpenIdError,
    OpenIdPlace,
    StationRole,
    ask,
    discover,
    enter,
    give_role,
    link,
    linked_keys,
    place_of_openid,
    put_openid,
    unlink,
)
from app.exchange.openid.roles import role_by_groups
from app.session.audit import audit_file, entries
from app.session.erasing import erase_person
from app.session.people import People
from app.session.roster import RosterLine
from app.session.station import StationKey
from app.session.tries import WrongPasswordError

PASSWORD = "correct horse battery"
PAGES = ("That is all.", "No answer.")
ADA = HospitalIdentity("https://login.hospital.example", "sub-of-ada")


@pytest.fixture
def people(tmp_path):
    people = People(tmp_path / "people")
    people.set_instructor(PASSWORD)
    return people


@pytest.fixture
def issuer():
    with Issuer() as issuer:
        yield issuer


@pytest.fixture(scope="module")
def provider():
    with Provider() as provider:
        yield provider


def place(server, **other):
    return OpenIdPlace(server.issuer, "acus", **({"seconds": 5.0} | other))


def there(provider, **other):
    """The provider that is not ours lets no client without a secret have a token; it takes any."""
    return place(provider, **({"secret": "a secret/+:"} | other))


def signed_in(issuer, patience=5.0, **other):
    """Who is signed in at the scripted provider, through a browser."""
    question = ask(place(issuer, **other), *PAGES)
    threading.Thread(target=visit, args=(issuer.browser(question.address),), daemon=True).start()
    return question.identity(patience=patience)


# --- a provider that is not ours ------------------------------------------------------------------
@pytest.mark.long("journey")
def test_somebody_signs_in_at_a_provider_that_is_not_ours(provider):
    provider.user("ada-at-the-hospital", groups=["radiology", "teachers"], name="Ada Lovelace")
    where = there(provider, instructors=("teachers",))
    question = ask(where, *PAGES)
    asked = {name: values[0] for name, values in parse_qs(urlsplit(question.address).query).items()}
    assert (asked["prompt"], asked["scope"], asked["response_type"]) == ("login", "openid", "code")
    assert urlsplit(asked["redirect_uri"]).hostname == "127.0.0.1"
    assert question.verifier not in question.address
    status, page = browse(question.address)
    assert status == 200
    assert "That is all." in page
    identity = question.identity()
    assert identity.subject == "ada-at-the-hospital"
    assert identity.allowed is StationRole.INSTRUCTOR
    assert "ada" not in repr(identity)
    assert "Lovelace" not in repr(identity)


@pytest.mark.long("journey")
def test_who_declines_at_the_provider_is_not_signed_in(provider):
    question = ask(there(provider), *PAGES)
    status, page = browse(question.address, action="deny")
    assert (status, "No answer." in page) == (400, True)  # it says so without the state
    with pytest.raises(OpenIdError, match="belongs to another question"):
        question.identity(patience=0.3)


@pytest.mark.long("journey")
def test_a_code_of_another_question_is_refused_by_the_nonce(provider):
    first, second = ask(there(provider), *PAGES), ask(there(provider), *PAGES)
    body = "sub=eve"
    head = {"Content-Type": "application/x-www-form-urlencoded"}
    _, brought, _ = visit(first.address, "POST", body, head)
    code = parse_qs(urlsplit(brought).query)["code"][0]
    where = f"{second.listener.redirect}?code={code}&state={second.listener.state}"
    assert visit(where)[0] == 200
    with pytest.raises(OpenIdError, match=r"gives no token|answers another question"):
        second.identity()
    first.close()


@pytest.mark.long("journey")
def test_a_provider_that_has_gone_is_named_and_says_what_to_do(people):
    with Provider() as provider:
        where = there(provider)
        question = ask(where, *PAGES)
        browse(question.address)
    with pytest.raises(OpenIdError, match=r"/oauth2/token does not answer.*PIN"):
        question.identity()
    with pytest.raises(OpenIdError, match=r"does not answer.*PIN"):
        ask(where, *PAGES)


# --- a provider by a script -----------------------------------------------------------------------
@pytest.mark.parametrize(
    ("private", "alg"),
    [(RSA, "RS256"), (CURVE, "ES256"), (EDWARDS, "EdDSA"), (EDWARDS, "Ed25519")],
)
def test_a_token_of_each_signature_that_is_taken_lets_in(issuer, private, alg):
    issuer.keys = [jwk(OTHER, "other"), jwk(private)]
    issuer.token = lambda claims: signed(claims, private, alg)
    issuer.document = {"id_token_signing_alg_values_supported": [alg]}
    assert signed_in(issuer) == HospitalIdentity(issuer.issuer, "sub-of-ada")
    assert issuer.paths == [
        "/.well-known/openid-configuration", "/token", "/keys",
    ]  # fmt: skip
    assert "client_secret" not in issuer.redeemed[0]


NOW = int(time.time())
TOKENS = {
    "alg none": (lambda c: signed(c, RSA, "none"), "not signed by any of RS256"),
    "alg None": (lambda c: signed(c, RSA, "NonE"), "not signed by any of"),
    "HS256 by the public key": (lambda c: signed(c, pem(RSA), "HS256"), "not signed by any of"),
    "HS256 by the modulus": (
        lambda c: signed(c, json.dumps(jwk(RSA)).encode(), "HS256"), "not signed by any of"
    ),
    "RS512": (lambda c: signed(c, RSA, "RS512"), "not signed by any of"),
    "another key": (lambda c: signed(c, OTHER), "no key that it publishes"),
    "an unknown kid": (lambda c: signed(c, RSA, kid="other"), "no key that it publishes"),
    "its own key in the head": (
        lambda c: signed(c, OTHER, jwk=jwk(OTHER), kid=None), "no key that it publishes"
    ),
    "ES256 by an RSA key": (lambda c: signed(c, CURVE, "ES256"), "no key that it publishes"),
    "a head it must know": (lambda c: signed(c, RSA, crit=["x"], x=1), "no key that it publishes"),
    "altered": (lambda c: signed(c, RSA)[:-6] + "AAAAAA", "no key that it publishes"),
    "no token": (lambda c: "nonsense", "or it is damaged"),
    "two parts": (lambda c: signed(c, RSA).rpartition(".")[0], "or it is damaged"),
    "a list": (lambda c: signed([c], RSA), "or it is damaged"),
    "huge": (lambda c: signed(c | {"x": "x" * 300_000}, RSA), "or it is damaged"),
    "empty": (lambda c: "", "gives no ID token"),
    "a number": (lambda c: 7, "gives no ID token"),
}  # fmt: skip


@pytest.mark.parametrize("name", TOKENS)
def test_a_token_that_is_not_signed_as_it_should_be_lets_nobody_in(issuer, name):
    issuer.token, expected = TOKENS[name]
    with pytest.raises(OpenIdError, match=expected) as refused:
        signed_in(issuer)
    assert "\n" not in str(refused.value)


CLAIMS = {
    "another issuer": ({"iss": "https://evil.example"}, "another provider made it"),
    "its issuer with a slash": ({"iss": "SLASH"}, "another provider made it"),
    "no issuer": ({"iss": None}, "lacks iss"),
    "another audience": ({"aud": "mail"}, "for another program"),
    "no audience": ({"aud": None}, "lacks aud"),
    "an audience of numbers": ({"aud": [1]}, "for another program"),
    "two audiences, no azp": ({"aud": ["acus", "mail"]}, "for another program"),
    "another azp": ({"azp": "mail"}, "for another program"),
    "two audiences, another azp": ({"aud": ["acus", "mail"], "azp": "mail"}, "another program"),
    "expired": ({"exp": NOW - 3600}, "this computer's clock"),
    "no end": ({"exp": None}, "lacks exp"),
    "an end that is no number": ({"exp": "never"}, "this computer's clock"),
    "an end that is not finite": ({"exp": float("nan")}, "this computer's clock"),
    "of tomorrow": ({"iat": NOW + 86400}, "this computer's clock"),
    "not before tomorrow": ({"nbf": NOW + 86400}, "this computer's clock"),
    "no time": ({"iat": None}, "lacks iat"),
    "another nonce": ({"nonce": "other"}, "answers another question"),
    "no nonce": ({"nonce": None}, "lacks nonce"),
    "an empty nonce": ({"nonce": ""}, "answers another question"),
    "a list of nonces": ({"nonce": {"x": 1}}, "answers another question"),
    "nobody": ({"sub": None}, "lacks sub"),
    "an empty name": ({"sub": ""}, "lacks sub"),
    "a number": ({"sub": 7}, "lacks sub"),
    "an endless name": ({"sub": "x" * 300}, "lacks sub"),
    "who had signed in before": ({"auth_time": NOW - 7200}, "did not ask who is here"),
    "a sign-in at nonsense": ({"auth_time": "noon"}, "lacks auth_time"),
    "a sign-in at no time": ({"auth_time": float("nan")}, "did not ask who is here"),
}  # fmt: skip


@pytest.mark.parametrize("name", CLAIMS)
def test_a_token_whose_claims_do_not_hold_lets_nobody_in(issuer, name):
    changes, expected = CLAIMS[name]
    issuer.claims = {k: f"{issuer.issuer}/" if v == "SLASH" else v for k, v in changes.items()}
    with pytest.raises(OpenIdError, match=expected) as refused:
        signed_in(issuer)
    assert "nobody was signed in" in str(refused.value) or "try again" in str(refused.value)
    assert "Lovelace" not in str(refused.value)
    assert "sub-of-ada" not in str(refused.value)


def test_a_list_of_nonces_with_the_right_one_is_not_the_nonce(issuer):
    made = issuer.token
    issuer.token = lambda claims: made(claims | {"nonce": [claims["nonce"], "other"]})
    with pytest.raises(OpenIdError, match="answers another question"):
        signed_in(issuer)


def test_a_token_for_several_programs_names_this_one(issuer):
    issuer.claims = {"aud": ["acus", "mail"], "azp": "acus", "auth_time": int(time.time())}
    assert signed_in(issuer).subject == "sub-of-ada"


def test_keys_that_are_changed_while_somebody_signs_in_are_asked_for_anew(issuer):
    issuer.keys, issuer.token = [jwk(OTHER, "old")], lambda claims: signed(claims, RSA, kid="new")
    question = ask(place(issuer), *PAGES)
    issuer.keys = [jwk(OTHER, "old"), jwk(RSA, "new")]
    visit(issuer.browser(question.address))
    assert question.identity().subject == "sub-of-ada"
    issuer.keys = [jwk(OTHER, "old")]  # taken back, for it was stolen
    with pytest.raises(OpenIdError, match="no key that it publishes"):
        signed_in(issuer)


KEYS = {
    "short": lambda: [jwk(SMALL)],
    "to encrypt with": lambda: [jwk(RSA, use="enc")],
    "secret": lambda: [{"kty": "oct", "k": "c2VjcmV0c2VjcmV0c2VjcmV0c2VjcmV0", "kid": "k"}],
    "none": list,
    "nonsense": lambda: [7, {}, {"kty": "RSA", "n": "!", "e": 1, "kid": "k"}],
    "for another signature": lambda: [jwk(RSA, alg="RS512")],
}


@pytest.mark.parametrize("name", KEYS)
def test_keys_that_cannot_have_signed_are_left_out(issuer, name):
    issuer.keys = KEYS[name]()
    if name == "short":
        issuer.token = lambda claims: signed(claims, SMALL)
    with pytest.raises(OpenIdError, match="no key that it publishes"):
        signed_in(issuer)


@pytest.mark.parametrize("verifier", ["", "another" * 10])
def test_without_the_verifier_of_pkce_a_code_is_worth_nothing(issuer, verifier):
    question = ask(place(issuer), *PAGES)
    object.__setattr__(question, "verifier", question.verifier)
    where = issuer.browser(question.address)
    object.__setattr__(question, "verifier", verifier)
    visit(where)
    with pytest.raises(OpenIdError, match=r"gives no token \(invalid_grant\)") as refused:
        question.identity()
    assert "Lovelace" not in str(refused.value)  # the provider's description


def hang(link):
    time.sleep(2.0)


def dribble(link):
    link.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 9999\r\n\r\n")
    for _ in range(60):
        link.wfile.write(b" ")
        link.wfile.flush()
        time.sleep(0.05)


def giant(link):
    link.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 99999999\r\n\r\n")
    for _ in range(100):
        link.wfile.write(b" " * (1 << 16))


def http(status, body=b"{}", *lines):
    head = (f"HTTP/1.1 {status} said", f"Content-Length: {len(body)}", *lines)
    return "\r\n".join(head).encode() + b"\r\n\r\n" + body


FAULTS = {
    "500": (http(500), r"no provider of OpenID Connect, or cannot now \(500\)"),
    "404": (http(404), r"\(404\)"),
    "a page": (http(200, b"<html>Guests' network</html>"), "no provider of OpenID Connect"),
    "a list": (http(200, b"[]"), "no provider of OpenID Connect"),
    "deep": (http(200, b"[" * 100_000), "no provider of OpenID Connect"),
    "half an answer": (http(200, b"{").replace(b": 1", b": 99"), "not to the end, within 0.5 s"),
    "half a head": (b"HTTP/1.1 200 s", "does not answer|no provider"),
    "nothing": (b"", "does not answer"),
    "hangs": (hang, "within 0.5 s"),
    "dribbles": (dribble, "within 0.5 s"),
    "giant": (giant, "does not answer, or not to the end"),
    "sends on": (http(302, b"", "Location: http://evil.example/x"), "sends on to evil.example"),
}


@pytest.mark.parametrize("path", ["/.well-known/openid-configuration", "/token", "/keys"])
@pytest.mark.parametrize("name", FAULTS)
def test_a_provider_that_answers_badly_lets_nobody_in_and_is_named(issuer, name, path):
    issuer.faults[path], expected = FAULTS[name]
    begun = time.monotonic()
    with pytest.raises(OpenIdError, match=expected) as refused:
        signed_in(issuer, seconds=0.5)
    assert time.monotonic() - begun < 5.0
    assert path in str(refused.value)
    assert "\n" not in str(refused.value)
    assert ";" in str(refused.value) or ":" in str(refused.value)


DOCUMENTS = {
    "another issuer": ({"issuer": "https://evil.example"}, "issuer 'https://evil.example', not of"),
    "no issuer": ({"issuer": None}, "letter by letter"),
    "no token endpoint": ({"token_endpoint": None}, "its token_endpoint"),
    "plain http elsewhere": ({"token_endpoint": "http://evil.example/token"}, "plain http"),
    "keys by plain http": ({"jwks_uri": "http://evil.example/keys"}, "plain http"),
    "a file": ({"jwks_uri": "file:///etc/passwd"}, "is no address"),
    "a script": ({"authorization_endpoint": "javascript:alert(1)"}, "is no address"),
    "a user": ({"token_endpoint": "https://a:b@evil.example/"}, "holds a user"),
    "a number": ({"authorization_endpoint": 7}, "its authorization_endpoint"),
    "a fragment": ({"authorization_endpoint": "https://a.example/#x"}, "its authorization_end"),
    "HS256 alone": ({"id_token_signing_alg_values_supported": ["HS256"]}, "offers none of RS256"),
    "plain alone": ({"code_challenge_methods_supported": ["plain"]}, "offers none of S256"),
    "implicit alone": ({"response_types_supported": ["id_token"]}, "offers none of code"),
    "nonsense": ({"code_challenge_methods_supported": 7}, "offers none of S256"),
}  # fmt: skip


@pytest.mark.parametrize("name", DOCUMENTS)
def test_a_discovery_document_that_cannot_be_trusted_is_refused_before_a_browser_opens(
    issuer, name
):
    issuer.document, expected = DOCUMENTS[name]
    with pytest.raises(OpenIdError, match=expected):
        ask(place(issuer), *PAGES)
    assert issuer.paths == ["/.well-known/openid-configuration"]


def test_a_remote_provider_sends_nothing_to_this_computer(monkeypatch):
    remote = OpenIdPlace("https://login.hospital.example", "acus")
    document = {"issuer": remote.issuer, "authorization_endpoint": "https://a.example/x"}
    document |= {"token_endpoint": "http://127.0.0.1:22/", "jwks_uri": "https://a.example/k"}

    class Answer:
        status, body = 200, json.dumps(document).encode()

    monkeypatch.setattr("app.exchange.openid.provider.exchange", lambda *_: Answer)
    with pytest.raises(OpenIdError, match="is this computer, which the provider is not"):
        discover(remote)


# --- the browser's answer -------------------------------------------------------------------------
@pytest.mark.parametrize(
    "query",
    ["code=a&state=other", "code=a", "state={s}", "code=a&error=b&state={s}",
     "code=a&code=b&state={s}", "code=a&state={s}&state={s}", "", "code=a&state=%ED%A0%80"],
)  # fmt: skip
def test_an_answer_that_is_none_is_refused_and_waited_past(issuer, query):
    question = ask(place(issuer), *PAGES)
    right = issuer.browser(question.address)
    base = question.listener.redirect
    status, _, page = visit(f"{base}?{query.format(s=question.listener.state)}")
    assert (status, "No answer." in page) == (400, True)
    assert visit(right.replace("/acus?", "/other?"))[0] == 404
    assert visit(right, head={"Host": "evil.example"})[0] == 404
    assert visit(right, "POST")[0] == 501
    assert visit(right)[0] == 200
    assert visit(right)[0] == 400  # it is taken once
    assert question.identity().subject == "sub-of-ada"
    with pytest.raises(OSError, match=r".*"):
        visit(right)  # nobody listens any more


def test_where_only_wrong_answers_come_nobody_is_signed_in(issuer):
    question = ask(place(issuer), *PAGES)
    visit(f"{question.listener.redirect}?code=a&state=other")
    with pytest.raises(OpenIdError, match="belongs to another question"):
        question.identity(patience=0.3)


def test_a_browser_that_never_answers_is_waited_for_no_longer_than_said(issuer):
    question = ask(place(issuer), *PAGES)
    host, port = "127.0.0.1", urlsplit(question.listener.redirect).port
    with socket.create_connection((host, port)):  # opened ahead, as browsers do
        with pytest.raises(OpenIdError, match=r"nobody signed in at 127.0.0.1:\d+ within 0.005"):
            question.identity(patience=0.3)
        with pytest.raises(OSError, match=r".*"):
            visit(question.listener.redirect)


def test_a_connection_that_says_nothing_holds_up_no_answer(issuer):
    question = ask(place(issuer), *PAGES)
    with socket.create_connection(("127.0.0.1", urlsplit(question.listener.redirect).port)):
        visit(issuer.browser(question.address))
        assert question.identity().subject == "sub-of-ada"


def test_a_sign_in_that_is_cancelled_ends_at_once(issuer):
    progress = Progress()
    question = ask(place(issuer), *PAGES)
    threading.Timer(0.2, progress.cancel).start()
    begun = time.monotonic()
    with pytest.raises(Cancelled):
        question.identity(progress, patience=60.0)
    assert time.monotonic() - begun < 3.0


@pytest.mark.parametrize(
    ("reply", "expected"),
    [({"iss": "https://evil.example"}, "is not of"), ({"iss": None}, "is not of"),
     ({"code": None, "error": "login_required", "iss": "ISSUER"}, r"\(login_required\)"),
     ({"code": None, "error": "Ada Lovelace!", "iss": "ISSUER"}, r"\(\?\)")],
)  # fmt: skip
def test_a_provider_that_names_itself_in_its_answer_is_held_to_it(issuer, reply, expected):
    issuer.document = {"authorization_response_iss_parameter_supported": True}
    issuer.reply = {k: issuer.issuer if v == "ISSUER" else v for k, v in reply.items()}
    with pytest.raises(OpenIdError, match=expected):
        signed_in(issuer)
    assert issuer.redeemed == []


@pytest.mark.parametrize(
    ("fault", "shown"), [("access_denied", r"\(access_denied\)"), ("Ada Lovelace", r"\(\?\)")]
)
def test_a_sign_in_that_is_declined_says_so_in_the_short_words_of_the_standard(
    issuer, fault, shown
):
    issuer.reply = {"code": None, "error": fault, "error_description": "Ada Lovelace"}
    with pytest.raises(OpenIdError, match=rf"did not sign you in {shown}.*PIN") as refused:
        signed_in(issuer)
    assert "Lovelace" not in str(refused.value)
    assert issuer.redeemed == []


# --- roles ----------------------------------------------------------------------------------------
GROUPS = {
    StationRole.STUDENT: ("students",),
    StationRole.INSTRUCTOR: ("teachers", "a b"),
    StationRole.TECHNICIAN: ("technicians",),
}


@pytest.mark.parametrize(
    ("claims", "role"),
    [
        ({}, "student"),
        ({"groups": []}, "student"),
        ({"groups": ["nurses"]}, "student"),
        ({"groups": ["teachers"]}, "instructor"),
        ({"groups": "teachers"}, "instructor"),
        ({"groups": "teachers technicians"}, "student"),
        ({"groups": ["nurses", "technicians"]}, "technician"),
        ({"groups": ["technicians", "teachers"]}, "instructor"),
        ({"groups": ["technicians", "students"]}, "student"),
        ({"groups": {"teachers": 1}}, "student"),
        ({"groups": [["teachers"], 7, None]}, "student"),
        ({"groups": ["Teachers"]}, "student"),
        ({"Groups": ["teachers"]}, "student"),
    ],
)
def test_groups_allow_the_least_of_the_roles_that_they_are_mapped_to(claims, role):
    assert role_by_groups(claims, "groups", GROUPS) == role


def test_a_claim_is_a_name_or_a_path_of_names():
    held = {"realm_access": {"roles": ["teachers"]}, "https://a.example/groups": ["technicians"]}
    assert role_by_groups(held, "realm_access.roles", GROUPS) is StationRole.INSTRUCTOR
    assert role_by_groups(held, "https://a.example/groups", GROUPS) is StationRole.TECHNICIAN
    assert role_by_groups(held, "realm_access.roles.x", GROUPS) is StationRole.STUDENT


# --- links ----------------------------------------------------------------------------------------
def everything(folder):
    return b"".join(path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file())


def test_what_is_kept_of_who_somebody_is_at_the_hospital_is_a_salted_digest(issuer, people, caplog):
    caplog.set_level(logging.DEBUG)
    identity = signed_in(issuer)
    assert enter(people, identity) is None
    entered = link(people, identity, "Ada", "271828")
    assert entered.role is StationRole.STUDENT
    held = everything(people.folder) + caplog.text.encode()
    for secret in (b"sub-of-ada", b"Lovelace", b"ada@hospital", issuer.issuer.encode()):
        assert secret not in held
    assert people.sign_in("Ada", "271828") == entered.person  # the PIN stays
    said = [(one.who, one.what, one.about) for one in entries(people.folder)][-3:]
    assert enter(people, identity) == entered
    assert entries(people.folder)[-1].what == "signed in by hospital"
    key = entered.person.key
    assert said[:2] == [(key, "sign-in linked", (key,)), (key, "signed in by hospital", (key,))]
    assert b"Ada" not in audit_file(people.folder).read_bytes()


def test_another_station_or_issuer_tells_the_same_person_by_another_digest(people, tmp_path):
    other = People(tmp_path / "other")
    other.set_instructor(PASSWORD)
    for where in (people, other):
        link(where, ADA, "Ada", "271828")
    digests = [
        {value for entry, value in where.names().items() if entry.endswith(" openid")}
        for where in (people, other)
    ]
    assert digests[0].isdisjoint(digests[1])
    assert {len(digest) for some in digests for digest in some} == {64}
    assert enter(people, HospitalIdentity("https://else.example", "sub-of-ada")) is None
    assert enter(people, HospitalIdentity(ADA.issuer, "sub-of-ad")) is None


def test_a_link_outlives_a_renewed_key_of_the_station_and_is_told_by_the_new_one(people):
    entered = link(people, ADA, "Ada", "271828")
    before = people.names()
    key = StationKey.of(people.folder)
    key.renewed().keep(people.folder)
    assert enter(people, ADA).person == entered.person
    assert people.names() != before
    assert enter(people, ADA).person == entered.person


def test_who_is_here_already_links_by_pseudonym_and_pin_and_nobody_else_does(people):
    ada, _ = people.add(RosterLine("Ada", "Ada Lovelace", "314159"))
    with pytest.raises(WrongPasswordError, match="ada is known here already, and pseudonym or PIN"):
        link(people, ADA, "ada", "271828")
    assert linked_keys(people) == ()
    assert link(people, ADA, "ADA", "314159").person.key == ada.key
    assert people.names()[ada.key] == "Ada Lovelace"
    eve = HospitalIdentity(ADA.issuer, "sub-of-eve")
    with pytest.raises(OpenIdError, match="is linked already"):
        link(people, eve, "Ada", "314159")
    with pytest.raises(OpenIdError, match="is linked already"):
        link(people, ADA, "Bea", "314159")
    assert enter(people, ADA).person.key == ada.key


def test_guesses_at_somebodys_pin_wait_as_at_the_door(people):
    people.add(RosterLine("Ada", "", "314159"))
    for guess in ("1111", "2222", "3333"):
        with pytest.raises(WrongPasswordError):
            link(people, ADA, "Ada", guess)
    with pytest.raises(WrongPasswordError, match="too many wrong tries"):
        link(people, ADA, "Ada", "314159")


@pytest.mark.parametrize(
    ("pseudonym", "pin"),
    [("", "1234"), ("Ada", ""), ("Ada", "12"), ("a/b", "1234"), ("Ada", "pin!")],
)
def test_a_pseudonym_or_pin_that_cannot_be_one_links_nobody(people, pseudonym, pin):
    with pytest.raises(Exception, match=r"PIN|pseudonym"):
        link(people, ADA, pseudonym, pin)
    assert linked_keys(people) == ()
    assert enter(people, ADA) is None


def test_a_role_is_given_once_by_the_password_and_taken_by_the_groups_at_any_time(people):
    teacher = HospitalIdentity(ADA.issuer, ADA.subject, StationRole.INSTRUCTOR)
    entered = link(people, teacher, "Ada", "271828")
    assert (entered.role, entered.may_be_more) == (StationRole.STUDENT, True)
    with pytest.raises(WrongPasswordError):
        give_role(people, entered, "guess")
    assert enter(people, teacher).role is StationRole.STUDENT
    assert give_role(people, entered, PASSWORD).role is StationRole.INSTRUCTOR
    later = enter(people, teacher)
    assert (later.role, later.may_be_more) == (StationRole.INSTRUCTOR, False)
    assert enter(people, ADA).role is StationRole.STUDENT  # out of the group
    more = enter(people, HospitalIdentity(ADA.issuer, ADA.subject, StationRole.TECHNICIAN))
    assert (more.role, more.may_be_more) == (StationRole.INSTRUCTOR, True)
    given = [one for one in entries(people.folder) if one.what == "role given"]
    assert [(one.who, one.about) for one in given] == [("instructor", (entered.person.key,))]


def test_who_is_erased_or_unlinked_is_somebody_new(people, tmp_path):
    link(people, ADA, "Ada", "271828")
    erase_person("Ada", tmp_path / "sessions", True, people)
    assert people.names() == {}
    assert enter(people, ADA) is None
    teacher = HospitalIdentity(ADA.issuer, ADA.subject, StationRole.INSTRUCTOR)
    entered = give_role(people, link(people, teacher, "Bea", "271828"), PASSWORD)
    assert unlink(people, "p-nobody") == 0
    assert unlink(people, entered.person.key) == 1
    assert enter(people, teacher) is None
    again = link(people, teacher, "Bea", "271828")
    assert again.role is StationRole.STUDENT


# --- what is configured ---------------------------------------------------------------------------
def test_what_is_configured_is_read_back_and_forgotten_with_all_links(people):
    where = OpenIdPlace(ADA.issuer, "acus", "roles", ("s",), ("t", "u"), ("w",), 7.0)
    put_openid(where, people)
    assert place_of_openid(people.folder) == where
    file = people.folder / "openid.json"
    assert file.stat().st_mode & 0o777 == 0o600
    link(people, ADA, "Ada", "271828")
    put_openid(OpenIdPlace(ADA.issuer, "acus2"), people)
    assert len(linked_keys(people)) == 1
    put_openid(OpenIdPlace("https://else.example", "acus"), people)
    assert linked_keys(people) == ()
    link(people, ADA, "Ada", "271828")
    put_openid(None, people)
    assert place_of_openid(people.folder) is None
    assert linked_keys(people) == ()
    assert people.find("Ada").has_pin


@pytest.mark.parametrize(
    ("other", "expected"),
    [
        ({"issuer": "login.hospital.example"}, "is no address"),
        ({"issuer": "http://login.hospital.example"}, "plain http"),
        ({"issuer": "https://login.hospital.example/?x=1"}, "is no address"),
        ({"issuer": "https://login.hospital.example/#x"}, "behind #"),
        ({"client": " "}, "client: ' ' cannot be one"),
        ({"claim": ""}, "claim: '' cannot be one"),
        ({"instructors": ("a\nb",)}, "instructor: .* cannot be one"),
        ({"instructors": ("a",), "technicians": ("a",)}, "'a' stands for two roles"),
    ],
)
def test_what_cannot_be_a_provider_is_refused(people, other, expected):
    given = {"issuer": ADA.issuer, "client": "acus"} | other
    with pytest.raises(OpenIdError, match=expected):
        put_openid(OpenIdPlace(**given), people)
    assert place_of_openid(people.folder) is None


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"issuer": "x"}', '{"issuer": "https://a.example", "client": "a", '
             '"claim": "g", "groups": {"student": "x"}}', "[" * 100_000]
)  # fmt: skip
def test_a_damaged_file_is_named_with_what_to_do(people, text):
    (people.folder / "openid.json").write_text(text)
    with pytest.raises(OpenIdError, match=r"openid.json does not say.*acus people openid"):
        place_of_openid(people.folder)
    put_openid(OpenIdPlace(ADA.issuer, "acus"), people)
    assert place_of_openid(people.folder).client == "acus"


def test_without_an_instructors_password_no_provider_is_named(tmp_path):
    with pytest.raises(OpenIdError, match="set the instructor's password first"):
        put_openid(OpenIdPlace(ADA.issuer, "acus"), People(tmp_path / "people"))


def test_without_the_package_the_error_names_its_extra(issuer, monkeypatch):
    monkeypatch.setitem(sys.modules, "joserfc", None)
    with pytest.raises(OpenIdError, match=r"joserfc is not installed.*`school`.*PIN"):
        ask(place(issuer), *PAGES)
    assert issuer.paths == []
