"""Statements to a record store that misbehaves in each way: nothing lost, nothing twice."""

import errno
import json
import logging
import os
import random
import socket
import ssl
import sys
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from ipaddress import ip_address
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "session"))
sys.path.append(str(Path(__file__).parent))
from lrs_server import CLOSE, DRIBBLE, HANG, ScriptedLrs, answer
from test_exchange_xapi import HOME, SOME, results

from app.core.files import watched
from app.exchange.lrs import (
    Backoff,
    Lrs,
    LrsError,
    LrsPlace,
    UnreachableLrsError,
    deliver,
    place_of_lrs,
    put_lrs,
    tell_attempts,
)
from app.session import statement_queue
from app.session.errors import SessionError
from app.session.people import Remarks
from app.session.statement_queue import StatementQueue

PASSWORD = "correct horse"


@pytest.fixture
def queue(tmp_path):
    return StatementQueue(tmp_path / "statements")


def place(server, **other):
    return LrsPlace(server.url, HOME, "acus", PASSWORD, **({"seconds": 1.0} | other))


def filled(queue, server, **other):
    """A place and a queue of four statements."""
    where = place(server, **other)
    assert tell_attempts(results(*SOME), where, queue) == 4
    return where


def ids(queue):
    return [one.id for one in queue.waiting()]


def test_what_waits_is_posted_in_batches_and_leaves_the_queue(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server, batch=3)
        before = ids(queue)
        done = deliver(where, queue)
    assert (done.sent, done.waiting, done.refused) == (4, 0, ())
    assert ids(queue) == []
    assert server.posts() == [before[:3], before[3:]]
    assert set(server.held) == set(before)
    _, target, headers, _ = server.requests[0]
    assert target == "/xAPI/statements"
    assert headers["X-Experience-API-Version"] == "1.0.3"
    assert headers["Authorization"] == "Basic YWN1czpjb3JyZWN0IGhvcnNl"  # by RFC 7617


HTML = answer(200, b"<html>Log in to the guests' network</html>")
FAULTS = {
    "500": (answer(500), UnreachableLrsError, "cannot take statements now"),
    "503": (answer(503, Retry_After="120"), UnreachableLrsError, "is sent later"),
    "429": (answer(429, Retry_After="3"), UnreachableLrsError, "is sent later"),
    "hangs": (HANG, UnreachableLrsError, "within 0.3 s"),
    "dribbles": (DRIBBLE, UnreachableLrsError, "within 0.3 s"),
    "closes": (CLOSE, UnreachableLrsError, "nothing is lost"),
    "half a head": (b"HTTP/1.1 200 s", UnreachableLrsError, "does not say which"),
    "half a body": (answer(200, b'["', Content_Length=99), UnreachableLrsError, "not to the end"),
    "no http": (b"\x00\x01\x02", UnreachableLrsError, "does not answer"),
    "a page": (HTML, UnreachableLrsError, "does not say which"),
    "no ids": (answer(200, {"ids": []}), UnreachableLrsError, "does not say which"),
    "202": (answer(202), LrsError, "is no record store"),
    "401": (answer(401), LrsError, "give name and password again"),
    "403": (answer(403), LrsError, "does not let 'acus' in"),
    "404": (answer(404), LrsError, "stands before /statements"),
    "301": (answer(301, Location="https://else.example/x"), LrsError, "sends on to else.example"),
    "307": (answer(307, Location="http://[::bad"), LrsError, r"sends on to \?"),
}  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_loses_nothing_and_is_told_in_one_line(queue, fault, caplog):
    said, kind, words = FAULTS[fault]
    caplog.set_level(logging.DEBUG)
    with ScriptedLrs(said) as server:
        where = filled(queue, server, seconds=0.3)
        before = ids(queue)
        with pytest.raises(kind, match=words) as caught:
            deliver(where, queue)
        assert ids(queue) == before
        assert deliver(where, queue).sent == 4  # the store has recovered
    assert set(server.held) == set(before)
    line = str(caught.value)
    assert "\n" not in line
    for secret in (PASSWORD, "YWN1czpjb3JyZWN0IGhvcnNl"):
        assert secret not in line + caplog.text + repr(where)


def test_a_store_says_how_long_to_wait(queue):
    with ScriptedLrs(FAULTS["503"][0]) as server, pytest.raises(UnreachableLrsError) as caught:
        deliver(filled(queue, server), queue)
    assert caught.value.wait == 120.0


def test_nobody_is_there(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)
    with pytest.raises(UnreachableLrsError, match="nothing is lost"):
        deliver(where, queue)
    assert len(ids(queue)) == 4


def test_what_was_taken_before_the_line_broke_is_not_taken_twice(queue):
    with ScriptedLrs() as server:
        server.script.append(lambda _, __, body: server.take(json.loads(body))[:-5])
        where = filled(queue, server)
        with pytest.raises(UnreachableLrsError):
            deliver(where, queue)
        assert len(ids(queue)) == 4
        assert len(server.held) == 4
        done = deliver(where, queue)
    assert (done.sent, ids(queue)) == (4, [])
    assert len(server.posts()) == 2  # the second was refused as a whole: 409


@pytest.mark.parametrize("said", [answer(204), answer(200, []), answer(200, ["x", None])])
def test_what_the_store_does_not_name_is_asked_for(queue, said):
    with ScriptedLrs(said) as server:
        where = filled(queue, server)
        first = queue.waiting()[0]
        server.held[first.id] = dict(first.statement)
        assert deliver(where, queue).sent == 4
    assert [len(post) for post in server.posts()] == [4, 1, 1, 1]


def test_after_409_what_the_store_lacks_is_posted_alone(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        first = queue.waiting()[0]
        server.held[first.id] = dict(first.statement) | {"version": "1.0.0"}
        assert deliver(where, queue).sent == 4
    assert [len(post) for post in server.posts()] == [4, 1, 1, 1]


def test_409_is_delivered_only_if_the_store_shows_the_same(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        other = queue.waiting()[1]
        server.held[other.id] = json.loads(json.dumps(other.statement)) | {"verb": {"id": "x:y"}}
        done = deliver(where, queue)
        assert (done.sent, done.waiting) == (3, 1)
        assert ids(queue) == [other.id]
        assert "has another statement by the id" in done.refused[0]
        server.script += [answer(409), answer(404), answer(404)]
        done = deliver(where, queue)
    assert (done.sent, ids(queue)) == (0, [other.id])
    assert "does not show it" in done.refused[0]


def test_a_statement_that_was_voided_there_counts_as_delivered(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        first = queue.waiting()[0]
        server.held[first.id], server.voided = dict(first.statement), {first.id}
        assert deliver(where, queue).sent == 4


def test_the_times_of_a_store_may_be_written_otherwise(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        for one in queue.waiting():
            moment = one.statement["timestamp"].replace("Z", "+00:00")
            server.held[one.id] = dict(one.statement) | {"timestamp": moment}
        assert deliver(where, queue).sent == 4


@pytest.mark.parametrize("status", [400, 413])
def test_one_that_is_refused_stays_and_the_others_go(queue, status):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        bad = ids(queue)[2]

        def picky(method, _, body):
            some = json.loads(body)
            if bad in [one["id"] for one in some]:
                return answer(status, b'{"detail": "no\n\x1b[31m good"}')
            return server.take(some)

        server.script += [picky] * 9
        done = deliver(where, queue)
    assert (done.sent, ids(queue)) == (3, [bad])
    assert len(done.refused) == 1
    assert f"refuses {bad} ({status}" in done.refused[0]
    assert done.refused[0].isprintable()


def test_an_attempt_that_is_declared_void_after_it_was_sent_is_voided(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        deliver(where, queue)
        said = {"a1": Remarks(void="the phone rang")}
        assert tell_attempts(results(*SOME, said=said), where, queue) == 1
        assert deliver(where, queue).sent == 1
    assert list(server.held.values())[-1]["verb"]["id"].endswith("/voided")


def test_a_program_that_ends_before_it_notes_the_sending_sends_nothing_twice(queue):
    with ScriptedLrs() as server:
        where = filled(queue, server)

        def die(deed, path):
            if path.name.startswith("sent-") or ".sent-" in path.name:
                raise KeyboardInterrupt

        with watched(die), pytest.raises(KeyboardInterrupt):
            deliver(where, queue)
        assert len(ids(queue)) == 4
        assert deliver(where, queue).sent == 4
    assert len(server.held) == 4


def full(monkeypatch, *kinds):
    """Have the disk full for files of these kinds; returns what ends it."""
    write = statement_queue.write_atomically

    def refuse(path, text):
        if path.name.startswith(kinds):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(path, text)

    monkeypatch.setattr(statement_queue, "write_atomically", refuse)
    return lambda: monkeypatch.setattr(statement_queue, "write_atomically", write)


def test_a_full_disk_takes_no_statement_and_loses_none(queue, monkeypatch):
    with ScriptedLrs() as server:
        where = place(server)
        assert tell_attempts(results(*SOME[:2]), where, queue) == 2
        before, freed = ids(queue), full(monkeypatch, "waiting-")
        with pytest.raises(SessionError, match=r"cannot write .*: No space left on device"):
            tell_attempts(results(*SOME), where, queue)
        assert ids(queue) == before
        freed()
        assert tell_attempts(results(*SOME), where, queue) == 2
        assert deliver(where, queue).sent == 4
    assert len(server.held) == 4


def test_what_arrived_while_the_disk_was_full_is_not_there_twice(queue, monkeypatch):
    with ScriptedLrs() as server:
        where = filled(queue, server)
        freed = full(monkeypatch, "sent-")
        with pytest.raises(SessionError, match="No space left on device"):
            deliver(where, queue)
        assert len(ids(queue)) == 4
        freed()
        assert deliver(where, queue).sent == 4
    assert len(server.held) == 4


def test_a_computer_without_a_network_is_told_in_one_line_and_keeps_all(queue, monkeypatch):
    def no_network(*_, **__):
        raise socket.gaierror(socket.EAI_AGAIN, "Temporary failure in name resolution")

    with ScriptedLrs() as server:
        where = filled(queue, server)
    monkeypatch.setattr(socket, "getaddrinfo", no_network)
    with pytest.raises(UnreachableLrsError) as caught:
        deliver(where, queue)
    assert "nothing is lost" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(ids(queue)) == 4


@pytest.mark.parametrize("fault", ["hangs", "500", "closes"])
def test_a_store_that_does_not_answer_at_first_is_not_connected_and_nothing_waits(fault):
    with ScriptedLrs(FAULTS[fault][0]) as server:
        with pytest.raises(LrsError, match="was not connected; look at the address") as caught:
            Lrs(place(server, seconds=0.3)).about()
        assert "sent later" not in str(caught.value)


def test_what_answers_is_looked_at_before_it_is_kept():
    with ScriptedLrs(HTML, answer(200, {"statements": [], "more": ""})) as server:
        with pytest.raises(LrsError, match="is no record store"):
            Lrs(place(server)).about()
        Lrs(place(server)).about()


@pytest.mark.parametrize(
    ("url", "words"),
    [
        ("http://lrs.school.example/xAPI", "by plain http"),
        ("http://10.0.0.1/xAPI", "by plain http"),
        ("https://acus:secret@lrs.example/xAPI", "holds a user"),
        ("ftp://lrs.example", "is no address"),
        ("https://lrs.example/x?y=1", "is no address"),
        ("https://lrs.example/\r\nX: y", "is no address"),
        ("https://[::1", "is no address"),
        ("https://lrs.example:99999/", "is no address"),
        ("somewhere", "is no address"),
    ],
)
def test_an_address_that_would_show_pupils_or_is_none_is_refused(url, words):
    with pytest.raises(LrsError, match=words) as caught:
        LrsPlace(url, HOME).checked()
    assert "secret" not in str(caught.value)


def test_an_address_is_taken_as_people_write_it():
    for url in ("https://l.example/xAPI/", "https://l.example/xAPI/statements"):
        assert LrsPlace(url, HOME).checked().endpoint == "https://l.example/xAPI"
    for host in ("127.0.0.1", "localhost", "[::1]"):
        assert LrsPlace(f"http://{host}:8100/xAPI", HOME + "/").checked().home == HOME


def test_the_place_is_kept_for_this_user_and_a_broken_file_is_named(tmp_path):
    assert place_of_lrs(tmp_path) is None
    kept = LrsPlace("https://l.example/xAPI", HOME, "acus", PASSWORD)
    put_lrs(kept, tmp_path)
    assert place_of_lrs(tmp_path) == kept
    assert (tmp_path / "lrs.json").stat().st_mode & 0o077 == 0
    (tmp_path / "lrs.json").write_text('{"endpoint": 3')
    with pytest.raises(LrsError, match=r"lrs\.json does not say"):
        place_of_lrs(tmp_path)
    put_lrs(None, tmp_path)
    assert place_of_lrs(tmp_path) is None


def _certificate(folder):
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes, serialization
    from cryptography.hazmat.primitives.asymmetric import ec

    key, now = ec.generate_private_key(ec.SECP256R1()), datetime.now(UTC)
    name = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, "lrs")])
    here = x509.SubjectAlternativeName([x509.IPAddress(ip_address("127.0.0.1"))])
    made = (
        x509.CertificateBuilder(name, name, key.public_key(), 1, now, now + timedelta(days=1))
        .add_extension(here, critical=False)
        .add_extension(x509.BasicConstraints(ca=True, path_length=None), critical=True)
        .sign(key, hashes.SHA256())
    )
    pem = serialization.Encoding.PEM
    forms = serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    (folder / "key.pem").write_bytes(key.private_bytes(pem, *forms))
    (folder / "cert.pem").write_bytes(made.public_bytes(pem))
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(folder / "cert.pem", folder / "key.pem")
    return context


def test_a_certificate_that_nobody_trusts_is_told_nothing(queue, tmp_path, monkeypatch):
    with ScriptedLrs(tls=_certificate(tmp_path)) as server:
        where = filled(queue, server)
        where = replace(where, endpoint=server.url.replace("http:", "https:"))
        with pytest.raises(LrsError, match="SSL_CERT_FILE"):
            deliver(where, queue)
        assert server.requests == []
        monkeypatch.setenv("SSL_CERT_FILE", str(tmp_path / "cert.pem"))
        assert deliver(where, queue).sent == 4


def test_waiting_doubles_with_chance_up_to_an_hour_and_begins_anew():
    backoff = Backoff(60.0, 3600.0, random.Random(7))
    waits = [backoff.failed() for _ in range(12)]
    for number, wait in enumerate(waits):
        whole = min(3600.0, 60.0 * 2**number)
        assert whole / 2 <= wait <= whole
    assert len(set(waits)) == 12
    assert backoff.failed(7200.0) == 7200.0
    backoff.worked()
    assert backoff.failed() <= 60.0
