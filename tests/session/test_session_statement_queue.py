"""Statements that wait: twice is once, order does not matter, and a kill leaves before or after."""

import random
from pathlib import Path

import pytest

from app.core.files import watched
from app.session.errors import SessionError
from app.session.people import People
from app.session.roster import RosterLine
from app.session.statement_queue import FOLDER, QueuedStatement, StatementQueue


def statement(number: int, student: str = "p-a") -> QueuedStatement:
    return QueuedStatement(student, {"id": f"00-{number:03d}", "said": "ü\nł"})


def ids(queue: StatementQueue) -> list[str]:
    return [one.id for one in queue.waiting()]


def test_what_was_put_twice_or_was_sent_waits_once_or_no_more(tmp_path: Path) -> None:
    queue = StatementQueue(tmp_path / "q")
    assert ids(queue) == []
    assert queue.put([statement(1), statement(2)]) == 2
    assert queue.put([statement(2), statement(3)]) == 1
    assert queue.waiting() == [statement(1), statement(2), statement(3)]
    queue.sent(["00-001", "00-002"])
    queue.sent(["00-002"])
    assert ids(queue) == ["00-003"]
    assert queue.put([statement(1), statement(3)]) == 0
    assert len(list(queue.folder.glob("waiting-*"))) == 1  # the emptied file has gone


@pytest.mark.long("journey")
def test_any_order_of_putting_and_sending_ends_with_the_same_queue(tmp_path: Path) -> None:
    random_ = random.Random(7)
    for trial in range(60):
        queue = StatementQueue(tmp_path / str(trial))
        deeds = [("put", [n, (n + 1) % 12]) for n in range(12)]
        deeds += [("sent", [n]) for n in range(0, 12, 3)] * 2
        random_.shuffle(deeds)
        for deed, numbers in deeds:
            if deed == "put":
                queue.put([statement(n) for n in numbers])
            else:
                queue.sent([f"00-{n:03d}" for n in numbers])
        assert ids(queue) == [f"00-{n:03d}" for n in range(12) if n % 3]


class Killed(BaseException):
    """The program ends here."""


def test_a_kill_at_any_step_leaves_the_queue_as_before_or_after(tmp_path: Path) -> None:
    before, after = ["00-001", "00-002"], ["00-002", "00-003"]
    seen = set()
    for at in range(20):
        queue = StatementQueue(tmp_path / str(at))
        queue.put([statement(1)])
        queue.put([statement(2)])
        steps = 0

        def killed(deed: str, path: Path, at: int = at) -> None:
            nonlocal steps
            if steps == at:
                raise Killed
            steps += 1

        try:
            with watched(killed):
                queue.sent(["00-001"])
                queue.put([statement(3)])
        except Killed:
            left = ids(queue)
            assert left in (before, ["00-002"], after)
            seen.add(tuple(left))
            queue.sent(["00-001"])
            queue.put([statement(3), statement(2)])
        assert ids(queue) == after
    assert {tuple(before), ("00-002",)} <= seen


def test_who_is_erased_leaves_the_queue_and_the_file_of_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    people = People()
    email = {"email": "ada@clinic.example"}
    ada, _ = people.add(RosterLine("Ada", "Ada L", "1843", accounts=email))
    bob, _ = people.add(RosterLine("Bob", "Bob L", "1844", accounts={"email": "bob@x.example"}))
    queue = StatementQueue(people.folder / FOLDER)
    queue.put([statement(1, ada.key), statement(2, bob.key), statement(3, ada.key)])
    assert people.names()[f"{ada.key} email"] == "ada@clinic.example"
    people.forget_keys([ada.key])
    assert ids(queue) == ["00-002"]
    everything = b"".join(p.read_bytes() for p in people.folder.rglob("*") if p.is_file())
    assert b"ada@clinic" not in everything
    assert ada.key not in "".join(people.names())
    assert people.names()[f"{bob.key} email"] == "bob@x.example"


def test_what_no_longer_holds_leaves_the_queue_or_is_voided_where_it_was_sent(
    tmp_path: Path,
) -> None:
    queue = StatementQueue(tmp_path)
    queue.put([statement(1), statement(2), statement(3)])
    queue.sent(["00-001"])
    voiding = {f"00-{n:03d}": QueuedStatement("p-a", {"id": f"v-{n}"}) for n in (1, 2)}
    assert queue.take_back(voiding) == 1
    assert ids(queue) == ["00-003", "v-1"]
    assert queue.take_back(voiding) == 0
    queue.sent(["v-1"])
    assert queue.take_back(voiding) == 0
    assert ids(queue) == ["00-003"]
    queue.put([statement(2)])  # it counts again, and nobody was told otherwise
    assert ids(queue) == ["00-002", "00-003"]


def test_a_damaged_file_is_named_with_what_to_do(tmp_path: Path) -> None:
    queue = StatementQueue(tmp_path)
    queue.put([statement(1)])
    next(tmp_path.glob("waiting-*")).write_text('{"student": 3}\n')
    with pytest.raises(SessionError, match="is damaged: move it away"):
        queue.waiting()
