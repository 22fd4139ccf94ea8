"""What holds for every command: the tree is walked, so a new one is held to it too."""

import ast
import json
from pathlib import Path

import pytest
import typer

import app.commands
from app import __version__
from app.__main__ import main
from app.commands import build

ROOT = Path(__file__).resolve().parents[2]

SAYS_NO_FACTS = {("run",), ("demo",), ("device", "emulate")}
"""They open a window, or go on until somebody ends them."""

NEEDS_MORE = {
    "calibrate export", "calibrate import", "calibrate mono", "calibrate redo", "calibrate reject",
    "calibrate show", "calibrate stereo", "calibrate undo", "calibrate use", "calibrate views",
    "calibrate world", "cohort rescore", "cohort sweep", "course begin",
    "ct digest", "ct import", "ct list", "ct path", "ct point",
    "device calibrate", "device show", "exercise bands", "exercise mark", "exercise pack",
    "exercise trial", "exercise unpack",
    "device conform", "device test", "pacs echo", "pacs find", "pacs get", "pacs move", "pacs send",
    "pen calibrate", "registration check", "session compare", "session replay", "session show",
    "session verify", "structures distance", "structures export", "structures list",
    "transform export", "transform show", "urdf import", "urdf mjcf", "camera test",
    "library remove", "course save", "course show", "people add", "people erase",
    "people instructor", "people pin", "people remark", "people rename", "people roster",
    "results curve",
    "research answer", "research begin", "research bundle", "research check", "research enrol",
    "research leave", "research lock", "research verify",
    "results export", "results lrs", "results reliability", "results send", "results xapi",
    "session delete", "session restore", "store gather", "store restore", "store revoke",
    "store sync",
}  # fmt: skip
"""They need pictures, records, a robot or a PACS: run with --json by the tests of their own."""


def walk(group=None, path=()):
    """Every command and group: its words, itself."""
    group = typer.main.get_command(build()) if group is None else group
    for name, command in group.commands.items():
        yield (*path, name), command
        if hasattr(command, "commands"):
            yield from walk(command, (*path, name))


TREE = dict(walk())
LEAVES = {path: one for path, one in TREE.items() if not hasattr(one, "commands")}


def acus(monkeypatch, capsys, *words):
    monkeypatch.setattr("sys.argv", ["acus", *map(str, words)])
    with pytest.raises(SystemExit) as ended:
        main()
    out, err = capsys.readouterr()
    return ended.value.code, out, err


@pytest.mark.parametrize("path", [(), *TREE], ids=" ".join)
def test_help_is_at_most_80_columns_wide_and_no_line_of_it_is_cut(path, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "300")
    code, out, err = acus(monkeypatch, capsys, *path, "--help")
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    cut = [line for line in out.split("Commands:")[-1].splitlines() if line.endswith("...")]
    assert cut == [] or "Commands:" not in out


@pytest.mark.parametrize("path", TREE, ids=" ".join)
def test_every_command_has_a_line_of_help(path):
    assert len(TREE[path].get_short_help_str(60)) > 10


@pytest.mark.parametrize("path", LEAVES, ids=" ".join)
def test_every_command_that_prints_facts_takes_json(path):
    options = {name for one in LEAVES[path].params for name in one.opts}
    assert ("--json" in options) == (path not in SAYS_NO_FACTS)


def test_nothing_but_the_one_printer_writes_json():
    writers = set()
    for file in Path(app.commands.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            names = [one.name for one in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom):
                names = [node.module or ""]
            if "json" in names:
                writers.add(file.name)
    assert writers == {"answer.py"}


EXAMPLES = {
    "calibrate list": (),
    "calibrate print": ("--out", "board.pdf"),
    "camera aim": ("--rig", "wide"),
    "camera latency": (),
    "camera list": (),
    "camera use": ("--left", "simulated", "--right", "simulated"),
    "course plans": (),
    "check": ("--last",),
    "device list": (),
    "exercise list": (),
    "exercise new": ("A title",),
    "exercise schema": (),
    "exercise suggest": ("laparoscopic-tool",),
    "exercise validate": ("first-insertion", "scans-only"),
    "explain": ("first-insertion",),
    "law list": (),
    "library list": (),
    "pacs add": ("here", "--host", "localhost", "--title", "X"),
    "pacs list": (),
    "pacs remove": ("here",),
    "pen list": (),
    "pen print": ("--out", "pen.pdf"),
    "plate list": (),
    "plugin list": (),
    "session gather": (),
    "session recover": (),
    "registration list": (),
    "course list": (),
    "people list": (),
    "people openid": (),
    "research new": ("--out", "design.yaml"),
    "research power": ("--effect", "9", "--sd", "10", "--simulations", "100"),
    "research status": (),
    "results board": (),
    "results lrs": (),
    "session export": ("--out", "all.csv"),
    "session list": (),
    "store audit": (),
    "store check": (),
    "store backup": ("--out", "all.acusbackup"),
    "store connect": (),
    "store empty-trash": (),
    "store rebuild": (),
    "store renew": (),
    "store results": ("--out", "results.acus"),
    "store station": ("--out", "course.acus"),
    "store stations": (),
    "store status": (),
    "study": ("list",),
    "arm urdf": ("--out", "arm.urdf"),
    "urdf export": ("--out", "robot.urdf"),
}


def test_every_command_is_tried_here_or_by_tests_of_its_own():
    tried = {" ".join(path) for path in LEAVES} - {" ".join(path) for path in SAYS_NO_FACTS}
    assert tried == set(EXAMPLES) | NEEDS_MORE


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", EXAMPLES)
def test_json_is_one_object_of_the_root_form(name, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    (tmp_path / "sessions").mkdir()
    if name == "pacs remove":
        assert acus(monkeypatch, capsys, "pacs", "add", *EXAMPLES["pacs add"])[0] == 0
    code, out, _ = acus(monkeypatch, capsys, *name.split(), *EXAMPLES[name], "--json")
    found = json.loads(out, parse_constant=pytest.fail)
    assert list(found) == ["acus", "form", "command", "answer", "facts"]
    assert (found["acus"], found["form"], found["command"]) == (__version__, 2, name)
    assert isinstance(found["facts"], dict)
    assert code == {None: 0, True: 0, False: 3}[found["answer"]]


def test_no_command_is_hidden():
    assert [path for path, one in TREE.items() if one.hidden] == []


@pytest.mark.parametrize("words", [(), ("ct",), ("device",), ("pen",)], ids=" ".join)
def test_without_a_command_the_help_is_printed_and_nothing_after_it(words, monkeypatch, capsys):
    code, out, err = acus(monkeypatch, capsys, *words)
    assert (code, err) == (0, "")
    assert out.startswith(" ".join(("Usage: acus", *words)))
    assert "acus: " not in out


def test_the_version_is_printed(monkeypatch, capsys):
    assert acus(monkeypatch, capsys, "--version") == (0, f"acus {__version__}\n", "")


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("acus ses", {"session"}),
        ("acus session ver", {"verify"}),
        ("acus run --exercise first", {"first-insertion"}),
        ("acus study slice_", {"slice_interpolation"}),
        ("acus session show 2026", {"20260101-one", "20260102-two"}),
        ("acus device test x --profile icu", {"icube"}),
    ],
)
def test_the_shell_completes_commands_and_names(words, found, monkeypatch, capsys, tmp_path):
    (tmp_path / "sessions").mkdir()
    for name in ("20260101-one", "20260102-two"):
        (tmp_path / "sessions" / f"{name}.mcap").touch()
    monkeypatch.setenv("_ACUS_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(len(words.split()) - 1))
    code, out, _ = acus(monkeypatch, capsys)
    assert (code, set(out.split())) == (0, found)


def test_the_exit_codes_are_those_of_their_page():
    from app.core.exits import Exit

    page = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    table = page.split("| exit code |")[1]
    codes = {int(line.split("|")[1]) for line in table.split("\n\n")[0].splitlines()[2:]}
    assert codes == set(map(int, Exit))
