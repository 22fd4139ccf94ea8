"""Statements to a real record store, Ralph: it takes them by its own models of xAPI, once each."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "session"))
sys.path.append(str(Path(__file__).parent))
from ralph_rig import Ralph, program
from test_exchange_xapi import HOME, SOME, results, scored
from test_session_course import attempt

from app.exchange.lrs import Lrs, LrsError, LrsPlace, UnreachableLrsError, deliver, tell_attempts
from app.session.people import Remarks
from app.session.statement_queue import StatementQueue

pytestmark = [pytest.mark.long("journey"), pytest.mark.timeout(900)]


@pytest.fixture(scope="module")
def command(tmp_path_factory):
    return program(tmp_path_factory.mktemp("programs"))


@pytest.fixture
def ralph(command, tmp_path):
    with Ralph(command, tmp_path / "lrs") as store:
        yield store


@pytest.fixture
def queue(tmp_path):
    return StatementQueue(tmp_path / "statements")


def place_of(ralph, **other):
    return LrsPlace(ralph.url, HOME, ralph.user, ralph.password, batch=25, **other)


def attempts():
    rows = [{"name": "lateral_error", "unit": "mm", "value": 2.1}]
    some = [attempt(f"r{k}", "p-a", float(k), k % 30) for k in range(60)]
    return [*SOME, *(scored(one, 40.0, one.total >= 40.0, *rows) for one in some)]


def test_a_store_takes_each_statement_once_across_its_own_absence(ralph, queue):
    where = place_of(ralph, seconds=60.0)
    Lrs(where).about()
    assert tell_attempts(results(*attempts()), where, queue) == 64
    told = {one.id: dict(one.statement) for one in queue.waiting()}
    ralph.stop()
    with pytest.raises(UnreachableLrsError):
        deliver(where, queue)
    ralph.start_again()
    done = deliver(where, queue)
    assert (done.sent, done.waiting, done.refused) == (64, 0, ())
    held = ralph.held()
    assert len(held) == 64
    for one in held:
        mine = told[one["id"]]
        assert {name: one[name] for name in mine if name != "timestamp"} == {
            name: value for name, value in mine.items() if name != "timestamp"
        }
    # The note of what was sent is lost: all is sent again, and the store has each once.
    for path in queue.folder.glob("sent-*"):
        path.unlink()
    late = attempt("late", "p-b", 70.0, 3)
    assert tell_attempts(results(*attempts(), late), where, queue) == 65
    assert deliver(where, queue).sent == 65
    assert len({one["id"] for one in ralph.held()}) == len(ralph.held()) == 65


def test_another_statement_by_the_same_id_is_not_taken_for_ours(ralph, queue):
    where = place_of(ralph, seconds=60.0)
    tell_attempts(results(SOME[0]), where, queue)
    deliver(where, queue)
    for path in queue.folder.iterdir():
        path.unlink()
    tell_attempts(results(replace(SOME[0], total=99.0, passed=True)), where, queue)
    done = deliver(where, queue)
    assert (done.sent, done.waiting) == (0, 1)
    assert "has another statement by the id" in done.refused[0]
    assert len(ralph.held()) == 1


def test_what_is_void_is_voided_there(ralph, queue):
    where = place_of(ralph, seconds=60.0)
    tell_attempts(results(*SOME), where, queue)
    deliver(where, queue)
    tell_attempts(results(*SOME, said={"a1": Remarks(void="the phone rang")}), where, queue)
    assert deliver(where, queue).sent == 1
    voiding = ralph.held()[-1]
    assert voiding["verb"]["id"] == "http://adlnet.gov/expapi/verbs/voided"


def test_a_wrong_password_and_a_wrong_address_are_said(ralph, queue):
    where = place_of(ralph, seconds=60.0)
    tell_attempts(results(*SOME), where, queue)
    with pytest.raises(LrsError, match="give name and password again"):
        deliver(replace(where, password="wrong"), queue)
    with pytest.raises(LrsError, match="stands before /statements"):
        deliver(replace(where, endpoint=ralph.url + "/else"), queue)
    assert len(queue.waiting()) == 4
    assert json.dumps(ralph.held()) == "[]"
