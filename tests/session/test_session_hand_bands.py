"""An attempt is judged by the bands of the hand that made it: in score, record and again."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from session_fakes import Bench

from app.exercises.schema import Exercise
from app.session.conditions import EXERCISE_FILE
from app.session.header import Attachment
from app.session.recording import Recording, read_recording
from app.session.review import review
from app.session.verify import conditions, verify
from app.views.debrief.score_words import bands_words, facts_of, short_words

KNOTS = {"expert": 0.2, "good": 0.4, "pass": 0.6, "zero": 3.0}
EXERCISE = Exercise.model_validate(
    {
        "id": "liver-01",
        "title": "Liver",
        "bands": {"mouse": {"source": "scripts", "metrics": {"angle_error": KNOTS}}},
    }
)
OWN = tuple(KNOTS.values())
ROBOTS = (1.0, 2.0, 3.0, 6.0)


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    document = json.dumps(EXERCISE.model_dump(mode="json")).encode()
    file = Attachment(EXERCISE_FILE, "application/json", document)
    bench.trainer._exercise = EXERCISE
    bench.trainer._context = replace(bench.context, attachments=(file,))
    yield bench
    bench.trainer.close()


def attempt(bench: Bench, hand: str) -> Recording:
    bench.run(0.2)
    bench.trainer.begin("s", hand=hand)
    bench.insertion()
    result = bench.trainer.end()
    assert result.score is not None
    return read_recording(result.record)


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("hand", "knots", "bands"),
    [
        ("mouse", OWN, "mouse"),
        ("keyboard", OWN, "mouse"),
        ("tablet", ROBOTS, ""),
        ("robot", ROBOTS, ""),
        ("script", ROBOTS, ""),
    ],
)
def test_the_hand_that_held_the_needle_says_by_what_it_is_judged(
    bench: Bench, hand: str, knots: tuple[float, ...], bands: str
) -> None:
    recording = attempt(bench, hand)
    found = verify(recording)
    assert found.confirmed
    for score in (found.written, found.recomputed):
        assert score is not None
        assert score.row("angle_error").tolerance.knots == knots
        assert score.row("lateral_error").tolerance == EXERCISE.tolerances["lateral_error"]
    under = conditions(recording, found.standing)
    assert (under.hand, under.bands) == (hand, bands)
    assert type(under).of(under.document()) == under
    assert review(recording).tolerances["angle_error"].knots == knots


WORDS = "scoring bands for the mouse, set from scripted runs, not from people"


@pytest.mark.long("journey")
def test_the_debrief_says_whose_bands_judged_and_that_they_are_from_scripts(bench: Bench) -> None:
    shown = review(attempt(bench, "mouse")).conditions
    assert bands_words(shown) == WORDS
    assert ("Bands", WORDS) in facts_of(shown)
    assert WORDS in short_words(shown)
    other = review(attempt(bench, "robot")).conditions
    assert "Bands" not in dict(facts_of(other))
    assert "bands" not in short_words(other)


@pytest.mark.long("journey")
def test_a_record_whose_bands_were_taken_away_is_judged_by_what_its_score_says(
    bench: Bench,
) -> None:
    recording = attempt(bench, "mouse")
    document = json.loads(recording.attachments[EXERCISE_FILE]) | {"bands": {}}
    files = dict(recording.attachments) | {EXERCISE_FILE: json.dumps(document).encode()}
    again = verify(replace(recording, attachments=files)).recomputed
    assert again is not None
    assert again.row("angle_error").tolerance.knots == OWN


@pytest.mark.long("journey")
def test_a_record_from_before_there_were_bands_is_judged_as_it_was(bench: Bench) -> None:
    recording = attempt(bench, "mouse")
    document = json.loads(recording.attachments[EXERCISE_FILE])
    del document["bands"]
    said = {"conditions": {}}
    files = dict(recording.attachments) | {EXERCISE_FILE: json.dumps(document).encode()}
    before = replace(recording, attachments=files, metadata=dict(recording.metadata) | said)
    again = verify(before).recomputed
    assert again is not None
    assert again.row("angle_error").tolerance.knots == ROBOTS
