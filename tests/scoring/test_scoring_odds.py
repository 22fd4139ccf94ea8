"""Published odds of what a needle met: as their sources state them, and no part of a score."""

import pytest
from scoring_attempts import Attempt

from app.scoring.met import Met
from app.scoring.odds import published_risks
from app.scoring.score import score


def met(kind, name="", length=24.0, entered=20.0, **more):
    return Met(kind, name, entered, length, ((0, 0, 0), (0, length, 0)), **more)


LUNG = met("lung", before="fat", after="organ", angle_deg=42.0)


def texts(*what):
    return [risk.sentence for risk in published_risks(what)]


def test_a_needle_through_lung_is_told_what_series_say_with_their_source():
    """Huo 2020, abstract: 25.9 % pneumothorax, 6.9 % drain, more than one puncture 2.43."""
    said = texts(LUNG)
    assert said[0] == (
        "Pleural crossings: 2; aerated lung: 24 mm. In published series 25.9 % of lung biopsies "
        "had a pneumothorax, 6.9 % a drain. "
        "(Huo et al. 2020, Br J Radiol, PMC7362905: 36 series, 23 104 patients)"
    )
    assert not any("2.43" in line for line in said)
    assert any("42° from straight in: series contradict each other" in line for line in said)
    assert any("Not known here: emphysema (odds ratio 3.33)" in line for line in said)
    assert any("31.4 %" in line and "7 %" in line and "3 %" in line for line in said)


@pytest.mark.parametrize(
    ("what", "ratio"),
    [
        ((LUNG, met("lung", before="fat", after="", entered=15.0)), 2.43),
        ((met("lung", length=31.0, before="fat", holds_target=True),), 2.38),
    ],
)
def test_a_factor_that_the_attempt_has_is_told_with_its_odds_ratio(what, ratio):
    ratios = [risk.odds_ratio for risk in published_risks(what) if risk.odds_ratio is not None]
    assert ratios == [ratio]


def test_a_vessel_has_no_rate_of_its_own_and_an_organ_that_of_its_biopsies():
    said = texts(met("vessel", "portal vein"), met("organ", "liver"), met("organ", "left kidney"))
    assert said[0] == "Portal vein met: no published rate of bleeding for that vessel was found."
    assert said[1].startswith("Of liver biopsies 0.48 % bled majorly.")
    assert "11 % had a haematoma, 1.6 % bled" in said[2]
    assert texts(met("vessel", "small vessel")) == []


def test_nothing_is_told_of_what_was_not_met_or_only_grazed():
    assert published_risks(None) == ()
    assert texts(met("skin"), met("fat"), met("lung", length=0.2)) == []


def test_no_score_knows_of_them():
    attempt = Attempt(lateral=0.004, tilt=0.03)
    assert len(published_risks((LUNG,))) > 3
    with_odds, without = score(attempt.trajectory(met=(LUNG,))), score(attempt.trajectory(met=()))
    assert 0.0 < with_odds.total < 100.0
    assert (with_odds.total, with_odds.passed) == (without.total, without.passed)
    counted = [[row.document() for row in one.rows if row.weight] for one in (with_odds, without)]
    assert counted[0] == counted[1]
    assert "Huo" not in with_odds.to_json()


def test_how_deep_a_lesion_lies_in_the_lung_is_not_told_of_one_in_the_liver():
    """Huo 2020 counts the depth of lung lesions; the liver's dome is reached through lung too."""
    through = met("lung", length=31.0, before="fat", after="organ")
    ratios = [one.odds_ratio for one in published_risks((through, met("organ", "liver")))]
    assert 2.38 not in ratios


@pytest.mark.parametrize("name", ["Liver", "liver segment 4"])
def test_a_liver_by_another_name_is_a_liver(name):
    assert texts(met("organ", name))[0].startswith("Of liver biopsies 0.48 % bled majorly.")


def test_the_way_out_of_a_nodule_in_the_lung_meets_no_pleura():
    lung = {"holds_target": True, "angle_deg": 10.0}
    way = (
        met("lung", before="fat", after="organ", **lung),
        met("organ", "nodule", entered=44.0, before="lung", after="lung", holds_target=True),
        met("lung", entered=50.0, before="organ", **{**lung, "angle_deg": 70.0}),
    )
    assert any("Pleura met 10° from straight in" in line for line in texts(*way))
