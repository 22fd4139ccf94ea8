"""A sentence is the English text that it always was, and remembers what it was made of."""

import copy
import json
import multiprocessing
import pickle
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from app.core import configuration  # noqa: F401  (which lets YAML write a sentence)
from app.core.errors import AcusError, ConfigurationError
from app.core.messages import Sentence, joined, sentence, sentence_of

numbers = st.floats(allow_nan=True, allow_infinity=True) | st.integers()
texts = st.text()


def raised(number):
    raise ConfigurationError(sentence("line {line} is wrong", line=number))


@given(texts, numbers, st.integers(-9, 9))
def test_a_sentence_is_the_f_string_that_it_replaces(name, length, count):
    text = sentence(
        "{name!r}: {length:.3g} mm {{of}} {count:+d}, {name}", name=name, length=length, count=count
    )
    assert text == f"{name!r}: {length:.3g} mm {{of}} {count:+d}, {name}"
    assert hash(text) == hash(str(text))
    assert type(str(text)) is str


@given(st.lists(texts | texts.map(lambda text: sentence("({text})", text=text)), max_size=5), texts)
def test_joined_sentences_are_the_joined_texts(parts, separator):
    assert joined(separator, parts) == separator.join(parts)
    assert list(joined(separator, parts).values.values()) == parts


def test_a_value_that_can_change_is_remembered_as_it_was():
    array, path = np.array([1.5, 2.5]), Path("ct") / "1.dcm"
    text = sentence("{path} holds {array}, {first:>8.2f}", path=path, array=array, first=array[0])
    array[:] = 0.0
    assert text == f"{path} holds [1.5 2.5],     1.50"
    assert text.template.format(**text.values) == text
    with pytest.raises(AttributeError):
        text.template = "other"
    with pytest.raises(TypeError):
        text.values["path"] = "other"


def test_an_error_within_an_error_stays_a_sentence_of_its_own():
    inner = AcusError(sentence("there is no port {path}", path="/dev/ttyACM0"))
    outer = AcusError(sentence("profile {name!r}: {reason}", name="desk", reason=inner))
    assert str(outer) == "profile 'desk': there is no port /dev/ttyACM0"
    assert sentence_of(outer).values["reason"].template == "there is no port {path}"
    foreign = sentence("{reason}", reason=KeyError("x"))
    assert foreign == str(KeyError("x"))
    assert sentence_of(KeyError(sentence("two words"))) == str(KeyError("two words"))


def test_sentences_that_are_added_keep_their_templates():
    text = "At once: " + sentence("line {line}", line=3) + "; end"
    text += sentence(" of {name}", name="it")
    assert text == "At once: line 3; end of it"
    assert isinstance(text, Sentence)


def through_pickle(text):
    return pickle.loads(pickle.dumps(text))


@pytest.mark.parametrize("way", [copy.copy, copy.deepcopy, through_pickle])
def test_copies_are_sentences(way):
    text = sentence("{path}: {reason}", path=Path("a"), reason=sentence("line {line}", line=3))
    again = way(text)
    assert again == "a: line 3"
    assert (again.template, dict(again.values)) == (text.template, dict(text.values))
    assert again.values["reason"].values == {"line": 3}


@pytest.mark.long("journey")
def test_an_error_keeps_its_template_across_processes():
    with (
        multiprocessing.get_context("spawn").Pool(1) as pool,
        pytest.raises(ConfigurationError, match="line 7 is wrong") as error,
    ):
        pool.apply(raised, (7,))
    assert error.value.args[0].template == "line {line} is wrong"
    assert error.value.args[0].values == {"line": 7}


def test_files_hold_the_plain_text():
    text = sentence("line {line}", line=3)
    assert json.loads(json.dumps([text])) == ["line 3"]
    assert yaml.safe_load(yaml.safe_dump({"reason": text})) == {"reason": "line 3"}
