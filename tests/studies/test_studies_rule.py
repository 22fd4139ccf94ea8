"""The default of every study is what the rule finds in the kept table, and what really runs."""

import json
import subprocess
import sys
from dataclasses import replace
from functools import cache

import pytest

from app.commands.study import lent
from app.studies.errors import StudyError
from app.studies.in_use import called, default_of
from app.studies.kept import keep, kept, kept_names, place, read, was_of
from app.studies.rule import departure, sweet_spot
from app.studies.runner import KIND, declaration, find_study, study_names
from app.studies.study import Failure, Limit, Point, Prepared, Result, Setting, Study, Way

OWN = [
    name
    for name in study_names()
    if KIND.is_own(declaration(name).path)
    and "= Study(" in declaration(name).path.read_text(encoding="utf-8")
]
"""The program's studies that compare ways, those of its own folders of plug-ins too."""


@cache
def study(name):
    return find_study(name)


def default(name):
    return next(way for way in study(name).ways if way.name == study(name).default)


@pytest.mark.parametrize("name", OWN)
def test_what_the_program_really_calls_is_the_default_of_its_study(name):
    in_use = study(name).in_use
    assert in_use is not None, "say with in_use= what the program calls"
    found = in_use(*map(lent, study(name).borrows))
    assert found == default(name).used
    others = [way.used for way in study(name).ways if way.name != study(name).default]
    assert all(found != other for other in others), "two ways cannot be told apart by `used`"


@pytest.mark.parametrize("name", OWN)
def test_the_kept_table_is_of_this_study(name):
    found, now = kept(name), study(name)
    renew = f"measure it anew: acus study {name} --write"
    assert was_of(found, now) == (), renew
    measured = {(p.way, p.setting) for p in found.points}
    measured |= {(f.way, f.setting) for f in found.result.failures}
    assert measured == {(w.name, s.name) for w in now.ways for s in now.settings}, renew


@pytest.mark.parametrize("name", OWN)
def test_the_default_is_the_sweet_spot_of_the_kept_table_or_says_why_not(name):
    found = kept(name)
    if found.sweet_spot == found.default:
        assert found.exception == study(name).exception == "", "no exception is needed"
    else:
        assert study(name).exception, f"the rule finds {found.sweet_spot}: {found.exception}"
        assert study(name).exception in found.exception
        assert any(digit in found.exception for digit in "0123456789")


def test_no_table_is_kept_of_a_study_that_is_not_there():
    assert set(kept_names()) == set(OWN)


def test_a_table_says_when_it_was_measured_and_nothing_of_the_machine():
    for name in kept_names():
        data = json.loads(place(name).read_text(encoding="utf-8"))
        assert set(data["measured"]) == {"date", "version", "repeats"}
        text = json.dumps(data)
        assert "/home" not in text
        assert "/work" not in text


def test_reading_a_kept_table_needs_none_of_what_running_a_study_needs():
    code = (
        "import sys; from app.studies.kept import kept; kept('velocity').exception;"
        "print(*[m for m in ('scipy','matplotlib','numba','cv2','PySide6') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def result(*rows, settings=("a", "b"), exception="", chosen="x"):
    """A result of rows (way, setting, error, seconds); noticed from 1, in time within 1 s."""
    names = list(dict.fromkeys(row[0] for row in rows))
    study = Study(
        name="made",
        error_label="error [m]",
        ways=tuple(Way(name, name, lambda case: Prepared(lambda: 0)) for name in names),
        settings=tuple(Setting(name, {}) for name in settings),
        case=lambda setting: None,
        deadline=Limit(1.0, "1 s"),
        perception=Limit(1.0, "1 m"),
        default=chosen,
        exception=exception,
    )
    points = tuple(
        Point(way, way, setting, error, seconds, error <= 1.0, seconds <= 1.0, 1.0)
        for way, setting, error, seconds in rows
        if error is not None
    )
    failures = tuple(Failure(r[0], r[1], "no answer") for r in rows if r[2] is None)
    return Result(study, points, failures)


def test_the_cheapest_way_below_the_line_in_all_settings_and_in_time_is_chosen():
    found = result(
        ("coarse", "a", 0.5, 0.001), ("coarse", "b", 1.5, 0.001),
        ("silent", "a", 0.1, 0.001), ("silent", "b", None, 0.0),
        ("slow", "a", 0.0, 0.1), ("slow", "b", 0.0, 1.5),
        ("x", "a", 0.5, 0.010), ("x", "b", 0.5, 0.010),
        ("fine", "a", 0.1, 0.020), ("fine", "b", 0.1, 0.020),
    )  # fmt: skip
    assert sweet_spot(found) == "x"
    assert departure(found) == ""


@pytest.mark.parametrize(("factor", "expected"), [(1.15, "fine"), (1.25, "x")])
def test_within_a_fifth_of_the_least_time_the_more_exact_way_is_chosen(factor, expected):
    found = result(
        ("x", "a", 0.5, 0.010), ("x", "b", 0.5, 0.010),
        ("fine", "a", 0.1, 0.010 * factor), ("fine", "b", 0.1, 0.010),
    )  # fmt: skip
    assert sweet_spot(found) == expected


def test_noise_of_five_percent_in_the_times_changes_no_kept_choice():
    for name in kept_names():
        found = kept(name).result
        once = sweet_spot(found)
        for sign in (1.0, -1.0):
            shaken = tuple(
                replace(p, seconds=p.seconds * (1.0 + 0.05 * sign * (-1) ** k))
                for k, way in enumerate(found.study.ways)
                for p in found.points
                if p.way == way.name
            )
            assert sweet_spot(Result(found.study, shaken, found.failures)) == once, name


def test_a_departure_tells_its_number():
    found = result(
        ("x", "a", 0.5, 0.010), ("x", "b", 0.1, 0.010),
        ("cheap", "a", 0.9, 0.001), ("cheap", "b", 0.5, 0.001),
        exception="It is beautiful.",
    )  # fmt: skip
    assert departure(found) == (
        "`x` takes 10 times the time of `cheap` (10 ms against 1 ms); "
        "its error is 0.5 of what is noticed against 0.9. It is beautiful."
    )


def test_where_no_way_keeps_the_limits_the_rule_says_by_how_much_the_default_misses():
    found = result(("x", "a", 1.9, 0.01), ("x", "b", 0.1, 3.0), ("y", "a", 2.0, 0.01),
                   ("y", "b", 0.1, 0.01))  # fmt: skip
    assert sweet_spot(found) is None
    assert departure(found) == (
        "no way keeps all limits; `x` has 1.9 times what is noticed in a "
        "and takes 3 times the deadline"
    )


def test_a_table_is_read_as_it_was_kept(tmp_path):
    was = result(("x", "a", 0.123456789, 1e-7), ("x", "b", None, 0.0), exception="Because.")
    found = read(keep(was, 5, tmp_path / "made.json"))
    assert found.repeats == 5
    assert found.points[0].error == 0.12346
    assert found.result.failures == was.failures
    assert found.default == "x"
    assert found.exception == departure(was)
    with pytest.raises(StudyError, match="cannot be measured again"):
        found.result.study.ways[0].prepare(None)


@pytest.mark.parametrize("content", ["", "{}", "[1]", '{"measured": {}}', "\x00"])
def test_a_broken_table_is_named(tmp_path, content):
    path = tmp_path / "broken.json"
    path.write_text(content)
    with pytest.raises(StudyError, match=r"broken\.json is no table of a study"):
        read(path)


def test_a_table_that_is_not_kept_is_refused_with_the_names_of_those_that_are():
    with pytest.raises(StudyError, match=r"'nothing' is kept; there are .*velocity"):
        kept("nothing")


def test_a_default_that_is_no_way_is_refused_with_the_ways():
    with pytest.raises(StudyError, match=r"'z' is no way; there are x, y"):
        result(("x", "a", 0.1, 0.1), ("y", "a", 0.1, 0.1), chosen="z")


def outer():
    return helper()


def helper(size=3):
    return size


def test_what_a_function_calls_is_found_where_its_code_finds_it():
    assert called(outer, "helper") is helper
    assert default_of(helper, "size") == 3
    with pytest.raises(StudyError, match="outer does not call other"):
        called(outer, "other")
    with pytest.raises(StudyError, match="no default for number"):
        default_of(helper, "number")
