"""The table of parts names files that are there, and what names a part that is gone is seen."""

import pytest

from tools import without
from tools.without import PARTS, ROOT, Part, naming, pattern_of


def left_out(part):
    return sorted(
        path.relative_to(ROOT).as_posix() for pattern in part.files for path in ROOT.glob(pattern)
    )


@pytest.mark.parametrize("name", PARTS)
def test_every_pattern_of_the_table_is_of_some_file(name):
    assert [one for one in PARTS[name].files if not list(ROOT.glob(one))] == []


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", PARTS)
def test_nothing_else_in_the_program_names_a_part(name):
    gone = left_out(PARTS[name])
    pattern = pattern_of(PARTS[name], gone)
    named = [
        line
        for line in naming(ROOT, pattern, ("app", "acus", "resources"))
        if not any(line.startswith((f"{one}:", f"{one}/")) for one in gone)
    ]
    assert named == []


@pytest.mark.parametrize(
    "line",
    [
        "from app.claw.grip import hold",
        "from app import claw",
        'import_module("app.claw.grip")',
        "see app/claw/grip.py",
        'load("rusty-claw")',
    ],
)
def test_a_line_that_names_what_is_gone_is_seen_with_its_file_and_number(tmp_path, line):
    (tmp_path / "app").mkdir()
    (tmp_path / "app" / "rest.py").write_text(f"x = 1\n{line}\n")
    pattern = pattern_of(Part(()), ["app/claw", "resources/devices/rusty-claw.yaml"])
    assert list(naming(tmp_path, pattern, ("app",))) == [f"app/rest.py:2: {line}"]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("from app import (\n    arrays,\n    claw,\n)", 3),
        ("from app.claw import (  # noqa\n    grip,\n)", 1),
        ("from . import (\n    claw as hand,\n)", 2),
        ("from .claw.grip import hold", 1),
        ('import_module(\n    "app."\n    "claw"\n)', 2),
        ('Path("app", "claw", "grip.py")', 1),
        ('ROOT / "app" / "claw"', 1),
        ('load("rusty-"\n    "claw.yaml", "app/"\n    "claw")', 2),
    ],
)
def test_what_is_spelled_over_several_lines_or_pieces_is_seen(tmp_path, text, line):
    (tmp_path / "app").mkdir()
    (tmp_path / "app" / "rest.py").write_text(text + "\n")
    pattern = pattern_of(Part(()), ["app/claw"])
    seen = list(naming(tmp_path, pattern, ("app",)))
    assert any(place.startswith(f"app/rest.py:{line}: ") for place in seen)


def test_a_name_that_only_begins_alike_is_not_taken_for_what_is_gone(tmp_path):
    (tmp_path / "app").mkdir()
    text = 'from app import (\n    claws,\n)\nx = "app/" "clawing"\n'
    (tmp_path / "app" / "rest.py").write_text(text)
    pattern = pattern_of(Part(()), ["app/claw"])
    assert list(naming(tmp_path, pattern, ("app",))) == []


def test_a_test_that_concerns_a_part_or_rests_on_one_that_does_is_left_out(tmp_path):
    folder = tmp_path / "tests"
    folder.mkdir()
    (folder / "rig.py").write_text("from app.claw import grip\n")
    (folder / "test_rig.py").write_text("from rig import grip\n")
    (folder / "test_claw.py").write_text("import app.claw\n")
    (folder / "test_rest.py").write_text("import app.core\n")
    part = Part(())
    left = without.tests_left(tmp_path, part, pattern_of(part, ["app/claw"]), [])
    assert left == ["tests/test_rest.py"]


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("without")


@pytest.mark.long("journey")
@pytest.mark.timeout(550)  # the first compiles for all what the checkout has not compiled
@pytest.mark.parametrize("name", PARTS)
def test_the_program_goes_on_without_a_part(name, place, capfd):
    first = ("first-insertion",)  # `python -m tools.without` asks for every exercise
    assert without.goes_on(name, place, explained=first), capfd.readouterr().out
