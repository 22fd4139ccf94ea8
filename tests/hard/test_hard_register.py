"""The register of hard cases holds; each bound has a defect that breaks it; its table is fresh."""

import json
from dataclasses import replace
from decimal import Decimal

import mpmath
import pytest

from app.studies.errors import StudyError
from app.studies.hard import cases
from app.studies.hard_cases.case import (
    REFERENCES,
    SUBSYSTEMS,
    analytic,
    digits,
    reference_folders,
    tried,
)
from tests.hard.defects import defects
from tools import hard_page, hard_references
from tools.exact import ENTRIES, WORKING

ALL = pytest.mark.parametrize("case", cases(), ids=lambda case: case.name)


@pytest.mark.long("statistics")
@ALL
def test_the_case_holds_and_what_is_said_of_the_step_beyond_happens(case):
    outcome = tried(case)
    if outcome.skipped:
        pytest.skip(outcome.skipped)
    assert outcome.trouble == ""


@ALL
def test_its_deliberate_defect_makes_the_case_fail(case):
    if case.missing():
        pytest.skip(case.missing())
    assert not case.error(defects()[case.name].way) <= case.bound


def test_every_case_has_a_defect_in_words_that_is_not_the_programs_own_way():
    own = {case.name: case.way for case in cases()}
    assert defects().keys() == own.keys()
    for name, defect in defects().items():
        assert defect.text, name
        assert defect.way is not own[name], name


def test_every_subsystem_has_more_than_one_case():
    found = [case.subsystem for case in cases()]
    assert [name for name in SUBSYSTEMS if found.count(name) < 2] == []


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"reference": None}, "has no reference"),
        ({"reference": analytic("nothing", ())}, "has no reference"),
        ({"bound": float("nan")}, "bound is nan; give 0 or more"),
        ({"bound": -1.0}, r"bound is -1\.0; give 0 or more"),
        ({"subsystem": "optics"}, "there are kinematics, statics"),
        ({"unit": ""}, "unit is empty"),
    ],
)
def test_a_case_without_reference_bound_or_words_is_refused(change, message):
    with pytest.raises(StudyError, match=message):
        replace(cases()[0], **change)


def test_a_reference_that_is_not_kept_is_refused():
    with pytest.raises(StudyError, match="no reference 'nowhere'"):
        digits("nowhere")


def test_what_is_no_number_or_a_named_error_counts_as_infinitely_wrong():
    case = next(case for case in cases() if case.case.startswith("smoothness"))
    assert case.error(lambda *_: float("nan")) == float("inf")


def test_a_case_whose_extra_is_missing_is_skipped_and_says_which(monkeypatch):
    case = next(case for case in cases() if case.needs)
    monkeypatch.setattr("app.studies.hard_cases.case.find_spec", lambda name: None)
    assert tried(case).skipped == "needs mujoco: make extra NAME=physics"


@pytest.mark.parametrize("name", sorted(ENTRIES))
def test_a_kept_reference_is_what_many_digits_give_for_its_input(name):
    kept = digits(name)
    with mpmath.workdps(WORKING):
        found = [mpmath.nstr(v, 50) for v in ENTRIES[name][2](*map(mpmath.mpf, kept.given))]
    for value, right in zip(found, kept.value, strict=True):
        assert abs(Decimal(value) - right) <= Decimal("1e-45") * max(abs(right), Decimal("1e-200"))


def test_every_kept_reference_is_still_made_and_every_made_one_kept():
    files = [folder / REFERENCES for folder in reference_folders()]
    kept = [
        name for file in files if file.is_file() for name in json.loads(file.read_text("utf-8"))
    ]
    assert sorted(kept) == sorted(ENTRIES)
    assert hard_references.PARTS


def test_the_table_in_the_documentation_is_that_of_the_register():
    assert hard_page.PAGE.read_text(encoding="utf-8") == hard_page.text(), (
        "run python -m tools.hard_page"
    )
