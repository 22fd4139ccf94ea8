"""What the system and libraries say in English alone is answered in the reader's language."""

import errno
import os

import pytest

from app.core.configuration import Strict, parse_text
from app.core.errors import ConfigurationError
from app.core.language import texts
from app.core.messages import Sentence, sentence
from app.session.errors import SessionNotFoundError
from app.session.store import find

COMMON = (
    errno.ENOENT,
    errno.EACCES,
    errno.EISDIR,
    errno.ENOTDIR,
    errno.ENOSPC,
    errno.EROFS,
    errno.EEXIST,
    errno.ECONNREFUSED,
)


class Model(Strict):
    whole: int
    size: float
    name: str
    places: list[float]


@pytest.fixture(params=["de", "fr"])
def here(request):
    return texts(request.param)


@pytest.mark.parametrize("number", COMMON)
def test_an_error_of_the_system_is_told_in_the_language(here, number):
    said = os.strerror(number)
    for why in (said, OSError(number, said, "/there"), OSError(number, said)):
        told = here.translated(sentence("cannot read {path}: {error_strerror}",
                                        path="/x", error_strerror=why))  # fmt: skip
        assert said not in told
        assert "Errno" not in told


def test_in_english_the_system_speaks_for_itself():
    said = os.strerror(errno.ENOENT)
    told = texts("en").translated(sentence("{why}", why=OSError(errno.ENOENT, said, "/x")))
    assert told == "[Errno 2] No such file or directory: '/x'"
    assert texts("en").translated(sentence("{why}", why=said)) == said


def test_what_a_check_of_fields_says_is_told_in_the_language(here):
    text = "whole: 1.5\nsize: many\nname: 3\nplaces: {a: 1}\nmore: 1\n"
    with pytest.raises(ConfigurationError) as raised:
        parse_text(text, Model, "file.yaml")
    english = str(raised.value)
    assert english.startswith(
        "file.yaml: whole: Input should be a valid integer, got a number with"
    )
    assert "Extra inputs are not permitted, got 1; valid names: whole, size" in english
    assert "(line 1)" in english
    told = here.translated(raised.value)
    for word in ("should", "Input", "valid", "got", "line", "not permitted", "mapping"):
        assert f"{word} " not in told.replace(":", " ").replace(")", " "), told


def test_what_is_missing_is_told_in_the_language(here):
    with pytest.raises(ConfigurationError) as raised:
        parse_text("whole: 1\n", Model, "file.yaml")
    assert "required and missing: size, name, places" in str(raised.value)
    assert "missing" not in here.translated(raised.value)


def test_a_session_that_is_not_there_is_told_in_the_language(here, tmp_path):
    with pytest.raises(SessionNotFoundError) as raised:
        find(tmp_path, "none")
    assert "'none' is no session in" in str(raised.value)
    told = here.translated(raised.value)
    assert "is no session" not in told
    assert isinstance(raised.value.args[0], Sentence)
