"""Templates make the same lines of facts as an f-string would."""

import json
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from app.commands.answer import Answer, Commands
from app.commands.shown import Each, lines


@pytest.mark.parametrize(
    ("template", "facts", "line"),
    [
        ("{id:6}|{score:5.1f}", {"id": "a", "score": 2.25}, "a     |  2.2"),
        ("{files} of {none}", {"files": [Path("a"), Path("b")], "none": None}, "a, b of None"),
        ("{groups:4}{ct.digest:.3}…", {"groups": [], "ct": {"digest": "abcdef"}}, "-   abc…"),
        ("{size.0}x{size.1:g}", {"size": (640, 48.0)}, "640x48"),
        ("{share:4.0%} of {share:%}", {"share": 0.125}, "  12 % of 12.500000 %"),
        ("{n:#} {n:#1 pen|# pens}", {"n": 1}, "1 1 pen"),
        ("{n:#} {n:#1 pen|# pens}", {"n": []}, "0 0 pens"),
        ("{n:#1 pen|# pens|no pen}", {"n": {}}, "no pen"),
        ("{a:?yes {b}|no {c:?{c}|at all}}", {"a": True, "b": "{x}|y"}, "yes {x}|y"),
        ("{a:?yes {b}|no {c:?{c}|at all}}", {"a": ""}, "no at all"),
        ("{a:?yes {b}|no {c:?{c}|at all}}", {"c": 3}, "no 3"),
    ],
)
def test_a_template_makes_a_line(template, facts, line):
    assert list(lines(template, facts)) == [line]


@pytest.mark.parametrize("value", [0, 0.0, -1, "0", [0], True])
def test_a_zero_is_something(value):
    assert list(lines("{a:?{a}|nothing}", {"a": value})) != ["nothing"]


@pytest.mark.parametrize("facts", [{}, {"a": None}, {"a": False}, {"a": ""}, {"a": []}, {"a": {}}])
def test_a_line_of_nothing_is_left_out(facts):
    assert list(lines(("{a:?{a}}", "end"), facts)) == ["end"]


def test_rows_are_of_lists_and_mappings_and_within_each_other():
    facts = {
        "rows": [{"id": 1, "notes": ["x", "y"]}, {"id": 2, "notes": []}],
        "pins": {"Ada": "1843"},
        "sides": {"left": {"sd": 0.5}},
        "empty": [],
        "folder": "here",
    }
    notes = Each("notes", "  {}", none="  {id} has none")
    assert list(lines(Each("rows", ("{id}", notes)), facts)) == [
        *("1", "  x", "  y"),
        *("2", "  2 has none"),
    ]
    assert list(lines(Each("pins", "{key:4} {value}"), facts)) == ["Ada  1843"]
    assert list(lines(Each("sides", "{key} ± {value.sd}"), facts)) == ["left ± 0.5"]
    assert list(lines(Each("empty", none="nothing in {folder}"), facts)) == ["nothing in here"]
    assert list(lines(Each("", "{key}={value}"), {"a": 1, "b": "c"})) == ["a=1", "b=c"]


def test_a_key_that_the_facts_lack_is_a_mistake():
    with pytest.raises(KeyError, match="score"):
        list(lines("{score}", {}))


def test_the_facts_come_before_lines_of_their_own(capsys):
    app = Commands()

    @app.command("ask")
    def ask() -> Answer:
        return Answer({"n": 2}, ["and {more}"], shown="{n:#1 thing|# things}")

    @app.command("other")
    def other() -> None:
        raise typer.Exit

    assert CliRunner().invoke(app, ["ask"]).output == "2 things\nand {more}\n"
    assert json.loads(CliRunner().invoke(app, ["ask", "--json"]).output)["facts"] == {"n": 2}
