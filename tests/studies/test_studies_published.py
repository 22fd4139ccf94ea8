"""Needles in tissue, measured and ours: the cases, their file, their page, and others' list."""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from app.simulation import scene, tissues
from app.simulation.effects import declaration, effect_names
from app.simulation.errors import SimulationError
from app.studies.errors import StudyError
from app.studies.published import (
    KINDS,
    PublishedCase,
    cases,
    cases_file,
    measure,
    read_cases,
)
from tools import published_page

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("ACUS_TEST_DATA", ROOT.parent / "shared" / "data"))
FACTS = SHARED.parent / "facts" / "published.json"

OF_PEOPLE = {
    *("force-jnd", "tremor-rms", "hand-intermittency"),
    *("expert-error", "procedure-time", "sparc-monotone"),
}
"""Cases of the shared list that no effect answers."""


def facts() -> list[dict[str, Any]]:
    return json.loads(FACTS.read_text(encoding="utf-8")) if FACTS.exists() else []


@pytest.mark.long("statistics")
@pytest.mark.parametrize("case", cases(), ids=lambda case: case.name)
def test_what_is_followed_holds(case: PublishedCase) -> None:
    assert case.holds(case.ours()) is case.chosen


@pytest.mark.long("statistics")
@pytest.mark.skipif(not FACTS.exists(), reason=f"{FACTS} is not here")
@pytest.mark.parametrize("fact", facts(), ids=lambda fact: fact["id"])
def test_every_shared_case_of_effects_holds(fact: dict[str, Any]) -> None:
    ours = {case.name: case for case in cases()}
    if fact["id"] in OF_PEOPLE:
        assert fact["id"] not in ours
        pytest.skip("no effect answers it: it is of people")
    least, most = fact["range"]
    assert least <= ours[fact["id"]].ours() <= most


def test_the_models_of_before_still_do_what_they_did() -> None:
    """So a record is replayed by the values and models that it was made with."""
    before = {
        "cut-second-pass": 1.0,
        "liver-capsule-total": 1.38,
        "friction-gauge": 1.0,
        "insertion-split": 0.79,
        "okamura-60mm": 0.94,
        "friction-before-puncture": 0.191,
        "bevel-22g-80mm": 3.52,
    }
    by_name = {case.name: case for case in cases()}
    for name, value in before.items():
        assert by_name[name].ours(tissues.FIRST) == pytest.approx(value, rel=0.01), name
    first = tissues.TISSUES[tissues.FIRST]
    assert [first[name] for name in ("skin", "fat", "muscle", "liver")] == list(
        scene.DEFAULT_LAYERS
    )
    for effect, model in tissues.MODELS[tissues.PUBLISHED].items():
        assert declaration(effect).model("") != model, "a new model is not what an old name means"


def test_every_case_says_where_from_and_of_what_and_two_that_exclude_each_other_say_why() -> None:
    for case in cases():
        assert case.least <= case.value <= case.most
        assert case.kind in KINDS
        assert case.source
        assert case.read
        assert case.chosen or case.choice
    told = {(case.drive, tuple(case.protocol.items())) for case in cases() if not case.chosen}
    assert told


def test_every_published_range_of_an_effect_holds_what_was_measured_and_its_default() -> None:
    numbers = 0
    for name in effect_names():
        declared = declaration(name)
        assert declared.unpublished(declared.checked({})) == (), name
        for key, known in declared.published.items():
            for value in known.measured:
                numbers += 1
                assert known.least <= value <= known.most, (name, key)
    assert numbers > 20


def test_nobody_calls_the_respondents_radiologists() -> None:
    """De Jong's 153 are respondents, of whom 125 are radiologists."""
    folders = ("app", "resources", "docs")
    files = [path for folder in folders for path in (ROOT / folder).rglob("*")]
    texts = [path for path in files if path.suffix in (".py", ".md", ".yaml")]
    assert len(texts) > 100
    for path in texts:
        words = " ".join(path.read_text(encoding="utf-8").split())
        assert "153 interventional" not in words, path
        assert "153 radiologists" not in words, path


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"value": 4.0}, "4 N was measured, and the range 2 to 3 excludes it"),
        ({"range": [3.0, 2.0]}, r"range is \[3.0, 2.0\]; give \[least, most\]"),
        ({"range": [2.0, float("inf")]}, "finite numbers"),
        ({"drive": "guess"}, "drive is 'guess'; there are puncture_peak"),
        ({"kind": "hearsay"}, "kind is 'hearsay'; there are gel, organ"),
        ({"means": "roughly"}, "means is 'roughly'; there are mean"),
        ({"protocol": {"tissue": "jelly"}}, "tissue is 'jelly'; there are skin"),
        ({"protocol": {"gauge": 19}}, "gauge is 19; there are 17"),
        ({"chosen": False, "choice": None}, "choice is None"),
        ({"chosen": False}, "is not chosen; say in `choice` why"),
        ({"colour": "red"}, "check 'colour'"),
        ({"source": ""}, "source is ''"),
    ],
)
def test_a_case_that_cannot_be_is_refused_by_name(
    tmp_path: Path, change: dict[str, Any], words: str
) -> None:
    row = yaml.safe_load(cases_file().read_text(encoding="utf-8"))["cases"][0]
    row.pop("choice", None)
    path = tmp_path / "published.yaml"
    path.write_text(yaml.safe_dump({"cases": [row | change]}), encoding="utf-8")
    with pytest.raises(StudyError, match=words) as refused:
        read_cases(path)
    assert str(path) in str(refused.value)
    assert "skin-18g" in str(refused.value)


def test_files_without_cases_or_with_one_twice_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "published.yaml"
    for text, words in (
        ("cases: []", "no list `cases`"),
        ("- 1", "no list `cases`"),
        ("cases: [3]", "case 1: is 3|case 1 is 3"),
    ):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(StudyError, match=words):
            read_cases(path)
    rows = yaml.safe_load(cases_file().read_text(encoding="utf-8"))["cases"][:1]
    path.write_text(yaml.safe_dump({"cases": rows * 2}), encoding="utf-8")
    with pytest.raises(StudyError, match="two cases are called 'skin-18g'"):
        read_cases(path)


def test_tissues_are_had_by_name_and_version() -> None:
    assert tissues.tissue("liver").side_stiffness < 9e3
    assert tissues.tissue("cirrhotic liver").side_stiffness == 20e3
    assert tissues.tissue("liver", "first") == scene.LIVER
    with pytest.raises(SimulationError, match="no tissue 'jelly'; they have skin"):
        tissues.tissue("jelly")
    with pytest.raises(SimulationError, match="called 'newest'; there are first, published"):
        tissues.tissue("liver", "newest")


@pytest.mark.long("statistics")
def test_what_only_reads_a_value_is_called_a_definition_and_not_counted_as_holding() -> None:
    verdicts = {row[0]: row[9] for row in measure().sheets[0].rows}
    for name in ("liver-J", "fat-J", "liver-E", "fat-E", "liver-capsule-total"):
        assert verdicts[name] == "definition"
    assert verdicts["okamura-60mm"] == "within"
    assert verdicts["hold-relaxation"] == "not followed"
    driven = [case for case in cases() if case.chosen and not case.is_definition]
    assert f"{len(driven)} of {len(driven)} measurements" in measure().lines[0]
    assert not any("memory" in case.read for case in cases())


def test_young_modulus_of_a_side_stiffness_is_that_of_a_rod_in_an_organ() -> None:
    """k = 4πG / (ln(R/a) - 1), E = 3G: 18 G in an organ held at 50 mm, by hand."""
    shear = 4.7 * (np.log(50.0 / 0.635) - 1.0) / (4.0 * np.pi)
    by_name = {case.name: case for case in cases()}
    assert by_name["liver-E"].ours() == pytest.approx(3.0 * shear, rel=1e-9)


@pytest.mark.long("statistics")
def test_the_page_is_what_the_study_prints() -> None:
    written = published_page.PAGE.read_text(encoding="utf-8")
    assert written == published_page.text(), "run python -m tools.published_page"
