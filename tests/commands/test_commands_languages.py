"""The command line answers people in their language; JSON and help are English in every one."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QSettings

from app.__main__ import main
from app.commands.shown import lines
from app.core import language
from app.core.messages import counted, joined, listed, sentence
from tools.translations import unmarked_texts

COMMANDS = Path(__file__).resolve().parents[2] / "app" / "commands"


@pytest.fixture
def answered(monkeypatch, capsys):
    def answer(locale, *words):
        monkeypatch.setenv("LC_ALL", locale)
        monkeypatch.setattr("sys.argv", ["acus", *map(str, words)])
        with pytest.raises(SystemExit):
            main()
        told = capsys.readouterr()
        return told.out, told.err

    return answer


@pytest.mark.parametrize(
    ("locale", "line"),
    [
        ("de_DE.UTF-8", "noch keine Teilnehmer: `acus people add` oder `acus people roster`\n"),
        ("fr_CA.UTF-8", "pas encore d’étudiants : `acus people add` ou `acus people roster`\n"),
        ("en_GB.UTF-8", "no students yet: `acus people add` or `acus people roster`\n"),
        ("xx_XX.UTF-8", "no students yet: `acus people add` or `acus people roster`\n"),
        ("C.UTF-8", "no students yet: `acus people add` or `acus people roster`\n"),
    ],
)
def test_an_answer_is_in_the_system_s_language(answered, locale, line):
    assert answered(locale, "people", "list") == (line, "")


def test_the_language_that_was_chosen_in_the_window_comes_first(answered, tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path))
    settings = QSettings(str(tmp_path / "window.ini"), QSettings.Format.IniFormat)
    settings.setValue("other/language", "xx")
    settings.setValue("language", "fr")
    settings.sync()
    assert answered("de_DE.UTF-8", "people", "list")[0].startswith("pas encore")


def test_an_error_from_below_is_in_the_reader_s_language_with_its_values(answered, tmp_path):
    told = answered("de_DE.UTF-8", "ct", "list", tmp_path / "none")[1]
    assert told == f"acus: {tmp_path / 'none'} gibt es nicht; nennen Sie einen Ordner mit " + (
        "DICOM-Dateien\n"
    )
    told = answered("fr_FR.UTF-8", "session", "export", "--out", "a.txt")[1]
    assert told == "acus: Valeur non valable : --out a.txt : seul .csv peut être écrit\n"


@pytest.mark.long("journey")
@pytest.mark.parametrize("words", [("people", "list"), ("exercise", "list"), ("session", "list")])
def test_json_is_the_same_in_every_language(answered, words):
    told = [answered(at, *words, "--json") for at in ("C.UTF-8", "de_DE.UTF-8", "fr_FR.UTF-8")]
    assert told[0] == told[1] == told[2]
    assert json.loads(told[0][0])["command"] == " ".join(words)


@pytest.mark.long("journey")
def test_help_is_english_and_reads_no_language():
    code = (
        "import sys; sys.argv = ['acus', 'people', '--help']\n"
        "from app.__main__ import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "print([m for m in sys.modules if m.split('.')[0] in ('xml', 'PySide6')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True,
        env={"LC_ALL": "de_DE.UTF-8", **_environment()},
    )  # fmt: skip
    assert "Students, groups, and the instructor." in done.stdout
    assert done.stdout.splitlines()[-1] == "[]"


def _environment():
    import os

    return {name: value for name, value in os.environ.items() if name != "LC_ALL"}


def test_rows_dates_and_numbers_are_the_reader_s(monkeypatch):
    monkeypatch.setenv("LC_ALL", "de_DE.UTF-8")
    monkeypatch.setenv("TZ", "UTC")
    facts = {"started": "2026-11-29T12:05:00+00:00", "total": 12.5, "best": 40.0, "median": 7.25}
    shown = "{started:@}  {total:5.1f}  best {best:5.1f}  median {median:5.1f}"
    (line,) = lines(shown, facts)
    assert line.split("  ", 1)[1] == " 12,5  Bestwert  40,0  Median   7,2"
    assert line.startswith("29.11.2026, ")
    assert list(lines("{title:~}", {"title": "First insertion"})) == ["Erste Punktion"]
    assert list(lines("{share:.1%}", {"share": 0.125})) == ["12,5 %"]


def test_sentences_within_sentences_counts_and_lists_are_the_reader_s():
    german, french = language.texts("de"), language.texts("fr")
    attempts = counted("{n} attempt", "{n} attempts", 1)
    assert attempts == "1 attempt"
    assert german.translated(joined(": ", ("x", attempts))) == "x: 1 Versuch"
    none = counted("{n} attempt", "{n} attempts", 0)
    assert (none, german.translated(none)) == ("0 attempts", "0 Versuche")
    assert french.translated(none) == "0 essai"  # nothing and one have the same form
    names = listed(["a", "b", sentence("student")])
    assert (names, german.translated(names)) == ("a, b and student", "a, b und Teilnehmer")
    assert (listed([]), listed(["a"])) == ("", "a")


def test_numbers_within_a_text_have_the_reader_s_decimal_point():
    passes = sentence("The path passes {length_mm:.1f} mm of {tissue}, {depth_mm:.0f} mm deep.",
                      length_mm=2.5, tissue="x", depth_mm=20.0)  # fmt: skip
    for code, number in (("de", "2,5"), ("fr", "2,5"), ("en", "2.5")):
        told = language.texts(code).translated(passes)
        assert number in told
        assert (told == passes) is (code == "en")


def test_a_file_that_is_no_language_leaves_the_answers_english(tmp_path):
    (tmp_path / "acus_de.ts").write_text("<TS")
    assert language.texts("de", tmp_path).translated(sentence("not passed")) == "not passed"
    assert language.texts("nl", tmp_path).translated(sentence("not passed")) == "not passed"


def test_no_answer_of_the_command_line_is_left_in_english():
    """Seen: 66 texts that nobody had marked, the verdict on a calibration among them."""
    files = sorted(COMMANDS.glob("*.py"))
    assert len(files) > 30
    left = {path.name: unmarked_texts(ast.parse(path.read_text("utf-8"))) for path in files}
    assert {name: texts for name, texts in left.items() if texts} == {}


def test_what_nobody_marked_is_told_from_names_of_threads_and_help():
    code = """
LONG_HELP = "a text of the help"
def _help():
    return f"more of {LONG_HELP} of it"
wanted = ContextVar("whether it is wanted", default=False)
Thread(target=read, name="acus reads lines")
echo("nobody marked this")
echo(sentence("somebody marked this"))
parse(document, "acus camera use")
"""
    assert unmarked_texts(ast.parse(code)) == ["nobody marked this"]


@pytest.mark.parametrize(
    ("locale", "line"),
    [
        ("en_GB.UTF-8", "turns by 0.000°, millimetres, LPS as in the file"),
        ("de_DE.UTF-8", "dreht um 0,000°, Millimeter, LPS wie in der Datei"),
        ("fr_FR.UTF-8", "tourne de 0,000°, millimètres, LPS comme dans le fichier"),
    ],
)
def test_a_line_beside_figures_is_in_the_reader_s_language(answered, tmp_path, locale, line):
    file = tmp_path / "still.tfm"
    file.write_text(
        "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\n"
        "Parameters: 1 0 0 0 1 0 0 0 1 0 0 0\nFixedParameters: 0 0 0\n"
    )
    assert answered(locale, "transform", "show", file)[0].splitlines()[-1] == line
