"""Questionnaires are scored as they were published, and wrong answers are refused in one line."""

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from app.core.errors import ConfigurationError
from app.research import ResearchError
from app.research.questionnaires import (
    Questionnaire,
    find_questionnaire,
    numbers_of,
    read_answers,
)

# The example of Brooke 1996, as Tullis & Albert print it (Measuring the User Experience, fig. 6.8):
# contributions 4, 1, 1, 4, 1, 2, 1, 1, 4, 3 make 22, times 2.5 is 55.
BROOKE = dict(zip([f"q{k}" for k in range(1, 11)], (5, 4, 2, 1, 2, 3, 2, 4, 5, 2), strict=True))


def test_sus_scores_the_example_of_brooke_55():
    assert find_questionnaire("sus").scored(BROOKE) == {"sus": pytest.approx(55.0)}


@given(st.lists(st.integers(1, 5), min_size=10, max_size=10))
def test_sus_is_the_sum_of_its_contributions_times_two_and_a_half(answers):
    odd, even = answers[::2], answers[1::2]
    expected = 2.5 * (sum(x - 1 for x in odd) + sum(5 - x for x in even))
    found = find_questionnaire("sus").scored({f"q{k}": x for k, x in enumerate(answers, 1)})
    assert found["sus"] == pytest.approx(expected)


TLX = ("mental", "physical", "temporal", "performance", "effort", "frustration")


def test_raw_tlx_is_the_mean_and_weighted_tlx_the_weighted_sum_over_15():
    """As Hart & Staveland 1988 define them: sum of rating times tally, over 15."""
    ratings, tallies = (30, 15, 60, 40, 30, 40), (3, 0, 5, 1, 3, 3)
    answers = dict(zip(TLX, ratings, strict=True))
    tlx = find_questionnaire("nasa-tlx")
    assert tlx.scored(answers) == {"raw": pytest.approx(215 / 6)}
    weights = {f"{name}_weight": tally for name, tally in zip(TLX, tallies, strict=True)}
    expected = (3 * 30 + 5 * 60 + 1 * 40 + 3 * 30 + 3 * 40) / 15
    assert tlx.scored(answers | weights)["weighted"] == pytest.approx(expected)


def test_realism_is_the_mean_of_five_items_and_leaves_teaching_out():
    items = ("pictures", "needle", "force", "workflow", "breathing")
    answers = dict(zip(items, (1, 2, 3, 4, 5), strict=True)) | {"teaching": 5}
    assert find_questionnaire("realism").scored(answers) == {"realism": pytest.approx(3.0)}


EVEN = {f"{name}_weight": 2.5 for name in TLX}
WRONG = {
    "no answer to q10": ("sus", {k: v for k, v in BROOKE.items() if k != "q10"}),
    "q1 is 6; it must be 1 to 5": ("sus", BROOKE | {"q1": 6}),
    "has no item 'q11'": ("sus", BROOKE | {"q11": 3}),
    "has no item 'q1_weight'": ("sus", BROOKE | {"q1_weight": 3}),
    "15 in all": ("nasa-tlx", dict.fromkeys(TLX, 50) | EVEN),
}


@pytest.mark.parametrize("reason", WRONG)
def test_answers_that_cannot_be_are_refused(reason):
    name, answers = WRONG[reason]
    with pytest.raises(ResearchError, match=reason):
        find_questionnaire(name).scored(answers)


def test_a_questionnaire_of_ones_own_is_read_by_its_path(tmp_path):
    path = tmp_path / "own.yaml"
    own = {
        "id": "own",
        "version": "1",
        "title": "Own",
        "low": 0,
        "high": 10,
        "items": [{"name": "calm", "wording": "Calm?"}],
        "scores": [{"name": "all", "lowest": 0, "highest": 1, "items": ["calm"]}],
    }
    path.write_text(yaml.safe_dump(own))
    assert find_questionnaire(str(path)).scored({"calm": 5}) == {"all": 0.5}
    for change, reason in (
        ({"high": 0}, "greater than low"),
        ({"items": own["items"] * 2}, "stands there twice"),
        ({"scores": [own["scores"][0] | {"items": ["x"]}]}, "has no item 'x'"),
        ({"scores": [own["scores"][0] | {"weighted": True}]}, "needs weights"),
    ):
        path.write_text(yaml.safe_dump(own | change))
        with pytest.raises(ConfigurationError, match=reason):
            find_questionnaire(str(path))
    with pytest.raises(ResearchError, match="there are nasa-tlx, realism, sus"):
        find_questionnaire("none")


def test_answers_are_read_with_commas_or_as_excel_writes_them_in_german(tmp_path):
    path = tmp_path / "a.csv"
    for text in ("student,q1\nAda,2.5\n", "\ufeffstudent;q1\r\nAda;2,5\r\n"):
        path.write_text(text)
        (row,) = read_answers(path)
        assert (row.pop("student"), numbers_of(row)) == ("Ada", {"q1": 2.5})
    path.write_text("student,q1\n")
    with pytest.raises(ResearchError, match="no row of answers"):
        read_answers(path)
    with pytest.raises(ResearchError, match="is no number"):
        numbers_of({"q1": "nan"})


def test_every_shipped_questionnaire_names_its_source_and_is_scored_at_both_ends():
    for name in ("sus", "nasa-tlx", "realism"):
        one = find_questionnaire(name)
        assert isinstance(one, Questionnaire)
        assert one.source
        for high in (False, True):
            ends = {
                item.name: one.high if high is not item.reversed else one.low for item in one.items
            }
            for rule in one.scores:
                if not rule.weighted:
                    wanted = rule.highest if high else rule.lowest
                    assert one.scored(ends)[rule.name] == pytest.approx(wanted)
