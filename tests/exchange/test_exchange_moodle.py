"""A gradebook that Moodle's own import takes, by each identifier and rule, and what it refuses."""

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sys.path.append(str(Path(__file__).parents[1] / "session"))
sys.path.append(str(Path(__file__).parent))
from moodle_reader import ImportRefusedError, MoodleCourse, fgetcsv, load_csv_content
from test_session_course import ADA, BOB, NOW, attempt

from app.exchange.errors import ExportError
from app.exchange.moodle import GradeRule, MoodleChoice, chance_words, item_names, moodle_text
from app.scoring.best_of import attempt_spread, expected_best
from app.session.accounts import Account
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.people import Person, Remarks

ACCOUNTS = {
    "p-a": {Account.EMAIL: "ada@clinic.example", Account.IDNUMBER: "007"},
    "p-b": {Account.EMAIL: "bob@clinic.example", Account.IDNUMBER: "008"},
}
USERS = [
    {"username": "ada", "email": "ADA@clinic.example", "idnumber": "007"},
    {"username": "bob", "email": "bob@clinic.example", "idnumber": "008"},
]
TITLES = {"lung": "Lung, upper lobe; “apex”", "liver": "Foie à côté"}


def board(people: Any = (ADA, BOB)) -> Any:
    some = [
        attempt("a1", "p-a", 50.25, 1),
        attempt("a2", "p-a", 70.5, 2),
        attempt("a3", "p-a", 61.0, 3),
        attempt("a4", "p-a", 63.5, 4),
        attempt("b1", "p-b", 61.25, 3, exercise="liver"),
    ]
    items = [CourseItem(exercise="lung"), CourseItem(exercise="liver")]
    return progress_board(list(people), items, some, {}, NOW)


def written(choice: MoodleChoice, semicolons: bool = False, **other: Any) -> bytes:
    given = {"accounts": ACCOUNTS, "titles": TITLES, "remarks": {}} | other
    text = moodle_text(board(), choice, **given, semicolons=semicolons)
    return b"\xef\xbb\xbf" + text.encode()


LUNG, LIVER = "Lung, upper lobe; “apex”, v1", "Foie à côté, v1"


@pytest.mark.parametrize("kind", Account)
@pytest.mark.parametrize("separator", ["comma", "semicolon"])
def test_moodle_takes_the_grades_by_each_identifier_and_separator(
    kind: Account, separator: str
) -> None:
    course = MoodleCourse(USERS)
    course.take(written(MoodleChoice(kind), separator == "semicolon"), kind.value, separator)
    assert course.grades == {LUNG: {"ada": 70.5}, LIVER: {"bob": 61.25}}


def test_a_german_moodle_takes_a_new_item_with_the_decimal_point_that_is_written() -> None:
    course = MoodleCourse(USERS)
    course.take(written(MoodleChoice(), semicolons=True), "username", "semicolon", decsep=",")
    assert course.grades[LUNG] == {"ada": 70.5}
    with pytest.raises(ImportRefusedError, match="badgrade"):
        MoodleCourse(USERS).take(b"username;New\r\nada;70,5\r\n", "username", "semicolon", ",")


@pytest.mark.parametrize(
    ("rule", "grade"),
    [("best", 70.5), ("first", 50.25), ("last", 63.5), ("mean:2", 62.25), ("mean:9", 61.31)],
)
def test_the_rule_chooses_the_attempts(rule: str, grade: float) -> None:
    course = MoodleCourse(USERS)
    course.take(written(MoodleChoice(rule=GradeRule.of(rule))), "username")
    assert course.grades[LUNG] == {"ada": grade}
    assert str(GradeRule.of(rule)) == rule


@pytest.mark.parametrize("rule", ["worst", "mean", "mean:0", "mean:x", "best:3", ""])
def test_an_unknown_rule_is_refused_with_those_that_there_are(rule: str) -> None:
    with pytest.raises(ExportError, match="take best, first, last, or mean:3"):
        GradeRule.of(rule)


def test_feedback_arrives_whatever_quotes_and_backslashes_it_holds() -> None:
    evil = 'hold "C:\\" steady; say \\"now\\", =1+1\nend\\'
    course = MoodleCourse(USERS)
    data = written(MoodleChoice(feedback=True), remarks={"a2": Remarks(comment=evil)})
    course.take(data, "username")  # makes the items, to which feedback can be mapped then
    assert course.feedback == {}
    course.take(data, "username")
    said = course.feedback[LUNG]["ada"]
    assert said.startswith("best of 4 attempts; ")
    assert "the instructor: " in said
    assert said.replace(" ", "").endswith(evil.replace(" ", "").replace("\n", ""))
    assert course.feedback[LIVER] == {"ada": "", "bob": said_of_bob(course)}


def said_of_bob(course: MoodleCourse) -> str:
    """What the only attempt's feedback is."""
    found = course.feedback[LIVER]["bob"]
    assert found.startswith("the only attempt; ")
    return found


def test_the_reader_hides_a_quote_behind_a_backslash_as_php_does() -> None:
    assert fgetcsv('"a\\",b"\n', ",") == [['a\\",b']]
    assert fgetcsv('"a""b",\'c\'', ",") == [['a"b', "'c'"]]
    with pytest.raises(ImportRefusedError):
        load_csv_content(b'a,b\n"c\\",d\n', "utf-8", "comma")


def test_nothing_is_written_of_somebody_without_the_identifier() -> None:
    with pytest.raises(ExportError, match=r"no email is known of Bob: give it by a roster"):
        written(MoodleChoice(Account.EMAIL), accounts={"p-a": ACCOUNTS["p-a"]})


def test_two_people_with_one_identifier_are_refused_by_name() -> None:
    same = {"p-a": {Account.EMAIL: "x@y.example"}, "p-b": {Account.EMAIL: "X@Y.example"}}
    with pytest.raises(ExportError, match=r"Ada, Bob have the same email, 'x@y.example'"):
        written(MoodleChoice(Account.EMAIL), accounts=same)


def test_an_identifier_that_moodle_would_change_is_refused() -> None:
    accounts = ACCOUNTS | {"p-b": {Account.IDNUMBER: "-8"}}
    with pytest.raises(ExportError, match="Moodle changes -8 as it imports"):
        written(MoodleChoice(Account.IDNUMBER), accounts=accounts)


def test_two_exercises_with_one_title_stay_two_items() -> None:
    names = item_names(board(), {"lung": "Same", "liver": "Same"})
    assert names == ["Same, v1 (lung)", "Same, v1 (liver)"]


def test_the_expected_best_of_n_is_that_of_published_tables() -> None:
    # Harter, Biometrika 48 (1961) 151-165, table 1, and Tippett (1925) for 100 and 1000
    table = {2: 0.56419, 3: 0.84628, 5: 1.16296, 10: 1.53875, 20: 1.86748, 100: 2.50759}
    for attempts, value in table.items():
        assert expected_best(attempts) == pytest.approx(value, abs=6e-6)
    assert expected_best(1000) == pytest.approx(3.24144, abs=6e-6)
    assert expected_best(1) == 0.0


def test_the_spread_of_attempts_is_found_beside_what_is_learned() -> None:
    random = np.random.default_rng(3)
    series = [
        40.0 + random.normal(0, 12) + 2.0 * np.arange(10) + random.normal(0, 7.0, 10)
        for _ in range(400)
    ]
    found = attempt_spread([list(map(float, some)) for some in series])
    assert found.pairs == 3600
    assert found.sd == pytest.approx(np.sqrt(7.0**2 + 2.0**2 / 2.0), rel=0.02)
    assert attempt_spread([[1.0] * 9]).sd is None


def test_what_chance_adds_to_the_best_is_what_simulated_students_get() -> None:
    """Students of one unchanging skill, with four attempts each."""
    random = np.random.default_rng(4)
    people = [Person(f"p-{k}", f"s{k}") for k in range(300)]
    totals = random.normal(50.0, 6.0, (300, 4))
    some = [
        attempt(f"a{k}-{n}", f"p-{k}", float(totals[k, n]), n) for k in range(300) for n in range(4)
    ]
    shown = progress_board(people, [CourseItem(exercise="lung")], some, {}, NOW)
    words = chance_words(shown, GradeRule.of("best"))
    truly = float(np.mean(totals.max(axis=1) - 50.0))
    told = float(words.split("these grades ")[1].split(" ")[0])
    assert told == pytest.approx(truly, abs=0.4)
    assert "900 pairs of attempts" in words
    mean = chance_words(shown, GradeRule.of("mean:4"))
    assert "does not rise" in mean
    uncertain = float(mean.split("uncertain by ")[1].split(" ")[0])
    assert uncertain == pytest.approx(float(np.std(totals.mean(axis=1))), abs=0.3)


def test_with_few_attempts_the_bias_is_told_without_a_figure_of_these() -> None:
    words = chance_words(board(), GradeRule.of("best"))
    assert "by 1.2 standard deviations" in words
    assert "not known yet (3 pairs of attempts)" in words
    assert chance_words(replace(board(), counted={}), GradeRule.of("last")) == ""
