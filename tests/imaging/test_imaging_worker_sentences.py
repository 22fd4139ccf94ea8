"""Errors of the worker process stay translatable, and what a hostile child sends cannot harm."""

import json
import math
from pathlib import Path

import pytest

from app.core.messages import Sentence, joined, sentence
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, SeriesRefusedError, WorkerLostError
from app.imaging.worker.answers import ForeignSentenceError, arrived, crossing, failed, outcome
from app.imaging.worker.pool import ImagingWorker
from app.imaging.worker.service import read_headers

ROWS = "{path!r} has {rows} rows of {share:.1f} %: {fault}"


def over(text):
    """What the other side of the socket makes of a text."""
    return arrived(json.loads(json.dumps(crossing(text))))


def test_template_and_values_cross_with_the_sentences_inside_them():
    inner = sentence("the file ends {missing} bytes early", missing=12)
    text = sentence(ROWS, path="a.dcm", rows=512, share=99.95, fault=inner)
    came = over(text)
    assert came == "'a.dcm' has 512 rows of 100.0 %: the file ends 12 bytes early"
    assert came.template == ROWS
    assert came.values["rows"] == 512
    assert came.values["fault"].template == "the file ends {missing} bytes early"


@pytest.mark.parametrize(
    "text",
    [
        "plain {text} of {0} nobody",
        sentence("{{braces}} that are meant: {n:04d}", n=7),
        sentence("{path}", path=Path("x") / "y"),
        sentence("{share:.2f} of {word:>8}", share=math.nan, word="all"),
        joined("; ", (sentence("a {n}", n=1), "b")),
        sentence("{count} voxels of {size}", count=1 << 80, size=-(1 << 70)),
    ],
)
def test_every_text_comes_as_it_went(text):
    assert over(text) == text
    assert isinstance(over(text), Sentence) == isinstance(text, Sentence)


@pytest.mark.parametrize(
    "message",
    [
        {"template": "{a.__class__}", "values": {"a": 1}},
        {"template": "{a[0]}", "values": {"a": "x"}},
        {"template": "{a:999999999}", "values": {"a": 1}},
        {"template": "{a:{b}}", "values": {"a": 1, "b": 99999999}},
        {"template": "{a:.999f}", "values": {"a": 1.0}},
        {"template": "{0}", "values": {"a": 1}},
        {"template": "{", "values": {}},
        {"template": "{a}", "values": {}},
        {"template": "{a:d}", "values": {"a": "x"}},
        {"template": "{a}", "values": {"a": [1]}},
        {"template": "{a}", "values": {"a": 1 << 70}},
        {"template": "{a}" * 150, "values": {"a": "x" * 600}},
        {"template": "x" * 601, "values": {}},
        {"template": 3, "values": {}},
        {"values": {}},
        {"formatted": 3},
        ["no"],
        None,
        7,
    ],
)
def test_what_is_no_harmless_sentence_is_refused(message):
    with pytest.raises(ForeignSentenceError):
        arrived(message)
    assert isinstance(outcome(str, ["failed", "FileDamagedError", message], None), WorkerLostError)


def test_sentences_inside_one_another_without_end_are_refused():
    message = "x"
    for _ in range(20):
        message = {"template": "{a}", "values": {"a": message}}
    with pytest.raises(ForeignSentenceError):
        arrived(message)


@pytest.mark.parametrize(
    ("error", "kind", "template"),
    [
        (MemoryError(), FileDamagedError, "it needs more than {size} MB of memory to be read"),
        (KeyError("JANE"), FileDamagedError, "it cannot be read ({kind})"),
        (
            SeriesRefusedError(sentence("{count} slices are missing", count=3)),
            SeriesRefusedError,
            "{count} slices are missing",
        ),
    ],
)
def test_an_error_of_a_job_comes_as_template_and_values(error, kind, template):
    came = outcome(str, json.loads(json.dumps(failed(error, 64 << 20))), None)
    assert type(came) is kind
    assert came.args[0].template == template
    assert "JANE" not in str(came)


def test_the_reason_of_a_file_that_cannot_be_read_is_a_sentence_to_whoever_lists_it():
    worker = ImagingWorker(1, "tests.imaging.hostile_child")
    try:
        paths = [Path("/nowhere", name) for name in ("memory", "surprise", "exit")]
        found = [one.reason for one in read_headers(paths, Progress(), worker)]
    finally:
        worker.close()
    assert found[0].template == "it needs more than {size} MB of memory to be read"
    assert found[1].template == "it cannot be read ({kind})"
    assert found[2].values["reason"].template == "ended with code {code}"
