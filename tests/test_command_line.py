import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import typer
import yaml
from typer.testing import CliRunner

from app.__main__ import main
from app.commands import build
from app.core.errors import AcusError

ROOT = Path(__file__).resolve().parents[1]


def acus(*arguments, **options):
    command = [sys.executable, "-m", "app", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def one_line(text):
    return text.count("\n") == 1 and text.startswith("acus: ")


def test_help_names_every_noun():
    result = acus("--help")
    assert result.returncode == 0
    nouns = {words[0] for words, _ in commands()}
    assert {"camera", "calibrate", "check", "pen", "registration"} < nouns
    for noun in nouns:
        assert f" {noun} " in result.stdout


def commands(group=None, path=()):
    """Every command of the program: its words and what it is."""
    group = typer.main.get_command(build()) if group is None else group
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands(command, (*path, name))
        else:
            yield (*path, name), command


def test_every_command_stands_on_its_page():
    text = (Path(__file__).parents[1] / "docs" / "command-line.md").read_text(encoding="utf-8")
    listed = text.split("## Commands")[1].split("```")[1].splitlines()
    lines = [re.split(r"[ |]+", line.replace("acus ", "")) for line in listed if line]
    missing = [words for words, _ in commands()
               if not any(set(words) <= set(line) for line in lines)]  # fmt: skip
    assert missing == []


@pytest.mark.parametrize(("words", "command"), list(commands()), ids=lambda v: str(v)[:30])
def test_no_bracket_is_cut_out_of_the_help(words, command, monkeypatch, capsys):
    told = [command.help or "", *(getattr(p, "help", None) or "" for p in command.params)]
    brackets = [found for text in told for found in re.findall(r"\[[^\]]*\]", text)]
    monkeypatch.setattr("sys.argv", ["acus", *words, "--help"])
    monkeypatch.setenv("COLUMNS", "200")
    with pytest.raises(SystemExit):
        main()
    shown = capsys.readouterr().out
    assert [one for one in brackets if one not in " ".join(shown.split())] == []


def test_help_loads_no_room():
    code = (
        "import sys; from app.commands import build; build();"
        "print([m for m in sys.modules if m.split('.')[0] in"
        " ('numpy', 'numba', 'PySide6', 'pydicom', 'cv2', 'vtkmodules')])"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == "[]"


@pytest.mark.long("journey")
def test_an_unknown_command_is_one_line_and_exit_code_2():
    result = acus("dance")
    assert result.returncode == 2
    assert one_line(result.stderr)


@pytest.mark.long("journey")
def test_a_path_that_does_not_exist_is_one_line_and_exit_code_2(tmp_path):
    result = acus("ct", "list", tmp_path / "nowhere")
    assert result.returncode == 2
    assert one_line(result.stderr)
    assert "nowhere" in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.long("journey")
def test_a_demonstration_of_an_exercise_that_there_is_not_names_those_that_there_are(tmp_path):
    done = acus("demo", "--headless", "--exercise", "nothing", "--out", tmp_path)
    assert done.returncode == 2
    assert one_line(done.stderr)
    assert "plan-it-yourself" in done.stderr


def test_a_demonstration_that_nothing_could_be_kept_of_is_refused_before_it_begins(tmp_path):
    (tmp_path / "file").touch()
    done = CliRunner().invoke(build(), ["demo", "--headless", "--out", str(tmp_path / "file/out")])
    assert done.exit_code != 0
    assert "nothing can be written" in f"{done.exception} {done.output}"
    assert "opening the patient" not in done.output


def mine(tmp_path, **changes):
    """A file of an exercise that is in no library."""
    text = (ROOT / "resources" / "exercises" / "first-insertion.yaml").read_text("utf-8")
    document = yaml.safe_load(text) | {"id": "mine", "title": "Mine"} | changes
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    return path


@pytest.mark.long("journey")
@pytest.mark.parametrize("given", ["mine.yaml", "first-insertion"])
def test_a_demonstration_is_of_the_exercise_of_a_file_or_of_a_name(tmp_path, monkeypatch, given):
    mine(tmp_path)
    monkeypatch.chdir(tmp_path)
    offered = []

    def no_window(desktop):
        offered.extend(desktop.exercises())
        raise AcusError("no window")

    monkeypatch.setattr("app.views.shell.application.start", lambda offscreen: None)
    monkeypatch.setattr("app.views.shell.window.open_window", no_window)
    done = CliRunner().invoke(build(), ["demo", "--headless", "--exercise", given])
    assert str(done.exception) == "no window"
    names = [one.id for one in offered]
    assert len(names) == len(set(names))
    assert ("mine" in names) == given.endswith(".yaml")
    assert [one.level for one in offered] == sorted(one.level for one in offered)


@pytest.mark.long("journey")
def test_a_demonstration_of_a_file_that_is_not_there_or_wrong_says_so_in_one_line(tmp_path):
    path = mine(tmp_path, device="leg")
    for file, words in (
        (path, "device: 'leg' is not known"),
        (tmp_path / "no.yaml", "cannot read"),
    ):
        done = acus("demo", "--headless", "--exercise", file, "--out", tmp_path / "out")
        assert done.returncode == 2
        assert one_line(done.stderr)
        assert words in done.stderr


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("named", "words"),
    [("no.yaml", "cannot read"), ("laparoscopic-tool", "targets are touched")],
)
def test_the_arm_does_not_begin_before_the_exercise_is_known_to_be_one_for_it(
    tmp_path, named, words
):
    named = tmp_path / named if named.endswith("yaml") else named
    out = tmp_path / "out"
    done = acus("demo", "--device", "arm", "--headless", "--exercise", named, "--out", out)
    assert done.returncode == 2
    assert one_line(done.stderr)
    assert words in done.stderr
    assert not done.stdout
    assert not out.exists()


def test_an_unknown_device_is_named_with_those_that_there_are_in_our_own_words():
    done = acus("demo", "--device", "leg")
    assert done.returncode == 2
    assert done.stderr.rstrip().endswith("'--device': 'leg' is not one of 'pantograph', 'arm'.")


@pytest.mark.long("journey")
def test_a_demonstration_on_a_folder_without_ct_is_refused_at_once(tmp_path):
    (tmp_path / "note.txt").write_text("no CT here")
    result = acus("demo", "--headless", "--ct", tmp_path, "--out", tmp_path / "out")
    assert result.returncode == 2
    assert one_line(result.stderr)
    assert "note.txt" in result.stderr


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--ct", "/nonexistent"), "/nonexistent does not exist"),
        (("--device", "/dev/none"), "there is no port /dev/none"),
        (("--exercise", "nope"), "no exercise 'nope'; there are first-insertion"),
    ],
)
def test_a_window_is_not_opened_for_what_is_not_there(arguments, words):
    result = acus("run", *arguments, timeout=60)
    assert result.returncode == 2
    assert words in result.stderr
    assert one_line(result.stderr)


@pytest.mark.long("journey")
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
@pytest.mark.parametrize(
    "words", [["exercise", "list"], ["--help"], ["exercise", "list", "--json"]]
)
def test_a_full_disk_behind_the_output_is_one_line_and_exit_code_2(words):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "app", *words]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2
    assert one_line(done.stderr)
    assert "No space left" in done.stderr


@pytest.mark.long("journey")
@pytest.mark.parametrize("words", [["exercise", "list"], ["session", "list"], ["--help"]])
def test_a_closed_output_is_no_fault_of_the_program(words):
    command = f"exec {shlex.quote(sys.executable)} -m app {' '.join(words)} >&-"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.long("journey")
@pytest.mark.parametrize("words", [["exercise", "list"], ["--help"]])
def test_a_reader_that_goes_early_ends_the_program_quietly(words):
    command = [sys.executable, "-u", "-m", "app", *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        running.stdout.close()
        assert running.stderr.read() == b""
    assert running.returncode == 0
