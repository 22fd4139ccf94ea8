"""What a command prints cannot steer the terminal, whoever chose the words."""

import json
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.commands.output import printable, printable_output

EVIL = "a\x1b]0;owned\x07b\x9b2Jc\rd\u202ee"


@given(st.text())
def test_nothing_that_steers_a_terminal_is_left_and_nothing_else_is_touched(text):
    shown = printable(text)
    assert not any((ord(c) < 32 and c not in "\n\t") or 127 <= ord(c) < 160 for c in shown)
    assert not set(shown) & set("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
    if text.isprintable():
        assert shown == text


@given(st.text())
def test_json_means_the_same_after_it(text):
    assert json.loads(printable(json.dumps(text, ensure_ascii=False))) == text


def test_the_streams_are_given_back(capsys):
    before = sys.stdout
    with printable_output():
        print(EVIL)
        print(EVIL, file=sys.stderr)
    assert sys.stdout is before
    out, err = capsys.readouterr()
    assert out == err == "a\\u001b]0;owned\\u0007b\\u009b2Jc\\u000dd\\u202ee\n"


@pytest.mark.parametrize(
    "words",
    [("exercise", "validate", EVIL), ("session", "show", EVIL), ("study", EVIL), (EVIL,),
     ("ct", "list", EVIL), ("people", "add", EVIL, "--json")],
)  # fmt: skip
def test_words_of_others_come_through_one_door(words, tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path))
    done = subprocess.run(
        [sys.executable, "-m", "app", *words], capture_output=True, check=False, text=True
    )
    assert "Traceback" not in done.stderr
    assert not set(done.stdout + done.stderr) & set("\x1b\x07\x9b\r\u202e")
