"""What a command prints cannot steer the terminal, whoever chose the words."""

import ast
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.table import Table
from rich.text import Text

import app
from app.commands.output import console, printable_output
from app.core.words import printable

EVIL = "a\x1b]0;owned\x07b\x9b2Jc\rd\u202ee"


@pytest.mark.long("journey")
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


@pytest.mark.parametrize("colours", [False, True])
def test_tables_and_bars_set_colours_and_let_no_text_do_it(capsys, colours):
    table = Table(title=Text("title " + EVIL))
    table.add_row(Text(EVIL, style="red"), style="bold")
    with printable_output():
        shown = console(force_terminal=colours, width=200)
        shown.print(table)
        shown.print(Text(EVIL))
    out = capsys.readouterr().out
    assert ("\x1b[" in out) is colours
    assert out.count("\\u001b]0;owned") == 3
    own = re.sub("\x1b\\[[0-9;]*m", "", out)
    assert not set(own) & set("\x1b\x07\x9b\r\u202e")


@pytest.mark.long("journey")
def test_nobody_prints_past_the_door():
    root, past = Path(app.__file__).parent, []
    for path in sorted(root.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            words = ast.unparse(node) if isinstance(node, ast.Call | ast.Attribute) else ""
            if re.fullmatch(r"sys\.__std(out|err)__|sys\.std(out|err)\.buffer|Console\(.*", words):
                past.append(f"{path.relative_to(root).as_posix()}: {words}")
    assert past == []


@pytest.mark.long("journey")
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
