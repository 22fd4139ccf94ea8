"""Bands from experienced people's attempts: whose attempts set them, and when there are none."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np
import pytest

from app.__main__ import main
from app.exercises.hand_bands import BandsSource
from app.exercises.library import load_exercise
from app.exercises.locks import HandName
from app.scoring.conditions import Conditions, DeviceKind
from app.session.errors import SessionError
from app.session.index import Index, Indexed
from app.session.people import NOTHING_SAID, People, Person, Remarks
from app.session.people_bands import EACH, GroupAttempts, attempts_of, fit
from app.session.roster import RosterLine
from app.session.summary import Summary

EXERCISE = load_exercise("first-insertion")
RNG = np.random.default_rng(28)
METRIC = "angle_error"


def attempt(number: int, who: str, value: float, **other: object) -> Indexed:
    """Make an attempt of which one metric is known."""
    hand = str(other.pop("hand", "mouse"))
    under = Conditions(EXERCISE.id, 1, hand=hand, kind=DeviceKind.SIMULATED, scoring_version=7)
    rows = [{"name": METRIC, "value": value}, {"name": "depth_error", "value": value}]
    summary = Summary(f"a{number:04}", "", score={"total": 80.0, "rows": rows})
    values = {
        "id": summary.id, "started": f"2026-11-20T10:{number % 60:02}:00+00:00", "student": who,
        "exercise": EXERCISE.id, "version": EXERCISE.version, "state": "ended", "duration": 30.0,
        "total": 80.0, "passed": True, "verdict": "unsigned", "counts": True,
        "under": json.dumps(under.document()), "document": "{}",
    }  # fmt: skip
    made = Indexed(**(values | other))  # type: ignore[arg-type]
    made.__dict__["summary"] = summary  # as read from its document
    return made


def group(name: str, count: int) -> list[Person]:
    return [Person(f"p-{name}-{number}", f"{name}{number}", (name,)) for number in range(count)]


def by(people: list[Person], middle: float, each: int = 4) -> Iterator[Indexed]:
    """Attempts of people about a value."""
    for place, person in enumerate(people):
        for number in range(each):
            value = float(abs(RNG.normal(middle, 0.1 * middle)))
            yield attempt(1000 * int(middle * 10) + 10 * place + number, person.key, value)


EXPERTS, STUDENTS = group("consultant", 4), group("student", 6)


def of(people: list[Person], some: list[Indexed], remarks: dict[str, Remarks] | None = None):
    return attempts_of("g", people, EXERCISE, HandName.MOUSE, some, remarks or {})


def test_bands_lie_between_what_the_two_groups_do() -> None:
    """Normal about 1 and 3 with a tenth as spread: they part at 1.5 ± 0.5, far from both."""
    some = [*by(EXPERTS, 1.0), *by(STUDENTS, 3.0)]
    result = fit(EXERCISE, HandName.MOUSE, of(EXPERTS, some), of(STUDENTS, some))
    bands = result.bands.metrics[METRIC]
    assert result.bands.source is BandsSource.PEOPLE
    assert 0.9 < bands.expert < 1.25
    assert 1.1 < bands.pass_ < 2.6
    assert bands.zero == pytest.approx(3.0, rel=0.1)
    assert set(result.bands.metrics) == {METRIC}  # where it ended is the same for every hand


def test_whoever_practises_much_counts_as_often_as_anybody() -> None:
    busy = [attempt(number, EXPERTS[0].key, 9.0) for number in range(200)]
    others = [*by(EXPERTS[1:], 1.0, EACH)]
    taken = of(EXPERTS, busy + others)
    assert sorted(taken.values(METRIC), reverse=True)[:EACH] == [9.0] * EACH
    assert len(taken.values(METRIC)) == len(EXPERTS) * EACH


def test_a_persons_newest_attempts_stand_for_him() -> None:
    better = [attempt(number, EXPERTS[0].key, 20.0 - number) for number in range(12)]
    taken = of(EXPERTS, better + [*by(EXPERTS[1:], 1.0, 1)])
    assert sorted(taken.values(METRIC))[-EACH:] == [9.0, 10.0, 11.0, 12.0, 13.0]


def test_people_without_an_attempt_are_not_counted_and_the_sign_of_a_value_is_left_out() -> None:
    some = [attempt(number, person.key, -2.0) for number, person in enumerate(EXPERTS[:3])]
    taken = of(EXPERTS, some)
    assert (taken.people, taken.values(METRIC)) == (3, [2.0, 2.0, 2.0])


def test_metrics_without_weight_or_of_which_more_is_better_have_no_bands() -> None:
    limits = EXERCISE.tolerances[METRIC]
    tolerances = {
        METRIC: limits,
        "more_is_better": limits.model_copy(
            update={"expert": limits.pass_, "pass_": limits.expert}
        ),
        "weightless": limits.model_copy(update={"weight": 0.0}),
        "alike": limits,
    }
    exercise = EXERCISE.model_copy(update={"tolerances": tolerances})

    def of_all(value: float) -> GroupAttempts:
        values = dict.fromkeys(tolerances, value) | {"alike": 1.0}
        rows = [{"name": name, "value": each} for name, each in values.items()]
        return GroupAttempts("g", 3, ({"rows": rows},) * 3)

    result = fit(exercise, HandName.MOUSE, of_all(1.0), of_all(3.0))
    assert set(result.bands.metrics) == {METRIC}
    assert result.alike == ("alike",)


@pytest.mark.parametrize(
    "other",
    [
        {"counts": False},
        {"total": None},
        {"version": EXERCISE.version + 1},
        {"exercise": "kidney"},
        {"hand": "gamepad"},
    ],
)
def test_attempts_of_another_kind_set_no_bands(other: dict[str, object]) -> None:
    some = [attempt(number, person.key, 1.0, **other) for number, person in enumerate(EXPERTS)]
    with pytest.raises(SessionError, match="0 people of g have attempts at first-insertion"):
        of(EXPERTS, some)


def test_what_the_instructor_declared_void_sets_none() -> None:
    some = [attempt(number, person.key, 1.0) for number, person in enumerate(EXPERTS)]
    void = {one.id: Remarks(void="slipped") for one in some[:2]}
    assert of(EXPERTS, some, {some[0].id: NOTHING_SAID}).people == 4
    with pytest.raises(SessionError, match="2 people of g"):
        of(EXPERTS, some, void)


def test_where_the_others_are_no_worse_the_tolerances_stay() -> None:
    some = [*by(EXPERTS, 3.0), *by(STUDENTS, 1.0)]
    with pytest.raises(SessionError, match="nothing parts g from g in first-insertion"):
        fit(EXERCISE, HandName.MOUSE, of(EXPERTS, some), of(STUDENTS, some))


@pytest.fixture
def acus(monkeypatch, capsys):
    def run(*words: str, code: int = 0):
        monkeypatch.setattr("sys.argv", ["acus", *words, "--json"])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        return json.loads(out)["facts"] if out else err

    return run


@pytest.mark.long("journey")
def test_the_instructor_prints_them_and_keeps_them_as_a_new_exercise(acus, monkeypatch) -> None:
    people = People()
    lines = [RosterLine(f"c{n}", groups=("consultants",)) for n in range(3)]
    people.take_roster(lines + [RosterLine(f"s{n}", groups=("A",)) for n in range(3)])
    there = {person.pseudonym: person for person in people.everybody()}
    experts = [there[f"c{n}"] for n in range(3)]
    some = [*by(experts, 1.0), *by([there[f"s{n}"] for n in range(3)], 3.0)]
    monkeypatch.setattr(Index, "attempts", lambda *_: some)
    words = ("exercise", "bands", EXERCISE.id, "--experienced", "consultants")
    facts = acus(*words)
    assert facts["experienced"] == {"people": 3, "attempts": 12}
    assert facts["kept"] is None
    kept = acus(*words, "--title", "First insertion of ours")["kept"]
    own = load_exercise(kept["id"])
    assert own.bands[HandName.MOUSE].source is BandsSource.PEOPLE
    assert own.bands[HandName.MOUSE].metrics[METRIC].pass_ == facts["metrics"][0]["pass"]
    assert "3 at least" in acus(*words[:-1], "nobody", code=2)
    assert "give one of them" in acus(*words, "--title", "x", "--save", code=2)
