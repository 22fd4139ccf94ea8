"""The adversary finds holes that were made on purpose, and none in a judgement without."""

import json
from dataclasses import dataclass, replace
from math import hypot

import numpy as np
import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.progress import Cancelled, Progress
from app.planning.judged import JudgedPlan
from app.simulation.trainee import ScriptPhase
from app.studies.adversary import attack_exercises
from app.studies.attacks.attack import GENES, HONEST, RANGES, Attack, honest_genes
from app.studies.attacks.search import FAR_MM, AttackJournal, AttackVerdict, Hole, search, worst
from app.studies.errors import StudyError
from app.studies.findings import Survey
from app.studies.runner import find_study

AXIS = np.array([0.0, 0.0, -1.0])
LENGTH = 0.080
RIB_MM = (18.0, 30.0)  # depths between which it lies
RIB_BESIDE_MM = (1.5, 12.0)  # distance from the path, to one side


@dataclass
class Patient:
    """A closed form of an exercise: a straight path, a rib beside it, and a judge with faults."""

    rib_fails: bool = True
    gate: bool = True
    sees_all: bool = True
    name: str = "closed-form"
    played: int = 0

    @property
    def id(self):
        return self.name

    @property
    def cameras(self):
        return "closed form"

    @property
    def shut(self):
        return frozenset({"entry_1_mm", "entry_2_mm", "dial", "views_hidden"})

    def facts(self):
        return (self.name, self.rib_fails, self.gate, self.sees_all)

    def play(self, attack):
        self.played += 1
        script = attack.script(AXIS, [(0.0, 0.0, LENGTH)], 0.13)
        rows = script.rows
        time, depth = np.arange(len(rows)) * script.row, 1e3 * rows[:, 2]
        tip = depth[:, None] * rows[:, :2]
        covered = np.zeros(len(rows), bool)
        for begin, end in attack.covered(script):
            covered |= (time >= begin) & (time < end)
        in_rib = (depth > RIB_MM[0]) & (depth < RIB_MM[1]) & (abs(tip[:, 1]) < 6.0)
        in_rib &= (tip[:, 0] > RIB_BESIDE_MM[0]) & (tip[:, 0] < RIB_BESIDE_MM[1])
        closest = float(np.hypot(np.hypot(*tip.T), depth - 1e3 * LENGTH).min())
        inside = depth > 2.0
        reached = bool(inside.any())
        seen = 1.0 - float(covered[inside].mean()) if reached else 1.0
        last = int(np.flatnonzero(inside)[-1]) if reached else 0
        last = last if attack.leaves <= 0.0 else int(depth.argmax())
        miss, deep = hypot(*tip[last]), abs(depth[last] - 1e3 * LENGTH)
        total = 30.0 * max(0.0, 1.0 - miss / 5.4) + 40.0 * max(0.0, 1.0 - deep / 5.4)
        total += 30.0 * (script.duration < 60.0)
        if not reached or max(deep, miss) > 10.0:
            total = 0.0 if self.gate else 70.0
        known = in_rib & ~covered if not self.sees_all else in_rib
        hard = self.rib_fails and bool(known.any())
        void = seen < 0.8
        passed = bool(not void and total >= 75.0 and miss < 2.7 and deep < 2.7 and not hard)
        ways = np.abs(np.diff(depth, prepend=depth[0]))
        length, hidden = float(ways[in_rib].sum()), float(ways[in_rib & ~known].sum())
        return AttackVerdict(
            None if void else float(total),
            passed,
            ("rib touched at 18.0 mm",) if in_rib.any() else (),
            min(1.0, 0.3 + 0.015 * length) if in_rib.any() else 0.0,
            closest,
            ("rib touched at 18.0 mm",) if hard else (),
            hidden / length if length else 0.0,
            seen,
            float(total),
        )


def _holes(patient, seed):
    tried = search(patient.play, 500, seed, patient.shut)
    assert len(tried) == 500
    return tried, {hole for one in tried for hole in one.verdict.holes}


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize(
    ("patient", "hole"),
    [
        (Patient(rib_fails=False), Hole.FINED_PASS),
        (Patient(gate=False), Hole.POINTS_FOR_NOTHING),
        (Patient(sees_all=False), Hole.FINED_PASS),
    ],
    ids=["a rib without judgement", "70 points for nothing", "a hidden camera"],
)
def test_each_planted_hole_is_shown_within_500_attempts(patient, hole, seed):
    tried, holes = _holes(patient, seed)
    assert holes == {hole}
    verdict = worst(tried, hole).verdict
    assert verdict.fines if hole is Hole.FINED_PASS else verdict.total == 70.0
    if not patient.sees_all:
        assert not verdict.judged
        attack = worst(tried, hole).attack
        assert max(attack.covered_share, attack.covered_astray) > 0.0


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", [1])
def test_a_judgement_without_a_hole_shows_none_though_attempts_pass_and_ribs_are_met(seed):
    tried, holes = _holes(Patient(), seed)
    assert holes == set()
    assert sum(one.verdict.passed for one in tried) > 50
    assert sum(bool(one.verdict.fines) for one in tried) > 20


def test_an_honest_attack_ends_on_the_target_and_covers_nothing():
    attack = Attack.of(honest_genes())
    assert attack == Attack()
    script = attack.script(AXIS, [(0.0, 0.0, LENGTH)], 0.13)
    assert script.rows[-1].tolist() == [0.0, 0.0, LENGTH, float(ScriptPhase.DONE)]
    assert attack.covered(script) == ()
    assert attack.words() == "nothing out of the ordinary"


def test_genes_reach_both_ends_of_what_they_stand_for_and_no_script_leaves_the_machine():
    assert set(HONEST) == set(GENES)
    for gene, end in ((0.0, 0), (1.0, 1)):
        attack = Attack.of([gene] * len(GENES))
        assert [getattr(attack, name) for name in GENES] == pytest.approx(
            [RANGES[name][end] for name in GENES]
        )
    random = np.random.default_rng(3)
    for _ in range(50):
        attack = Attack.of(random.random(len(GENES)))
        rows = attack.script(AXIS, [(0.0, 0.0, LENGTH), (0.1, 0.0, 0.07)], 0.13).rows
        assert np.isfinite(rows).all()
        assert rows[:, 2].min() >= -0.0150001
        assert rows[:, 2].max() <= 0.1300001
        assert rows[-1, 3] == ScriptPhase.DONE


def test_no_hole_is_an_attempt_that_missed_by_less_than_the_length_of_a_nodule():
    assert AttackVerdict(90.0, True, closest_mm=FAR_MM - 1.0).holes == ()
    assert AttackVerdict(90.0, True, closest_mm=FAR_MM + 1.0).holes == (
        Hole.MISSED_PASS,
        Hole.POINTS_FOR_NOTHING,
    )
    assert AttackVerdict(None, False, ("rib",), 1.0, 70.0).holes == ()
    assert AttackVerdict(80.0, False, ("rib",), 1.0).holes == ()


@pytest.mark.long("statistics")
def test_a_search_that_was_cancelled_goes_on_where_it_stopped_and_ends_as_a_whole_one(tmp_path):
    whole = Patient(rib_fails=False)
    expected = attack_exercises(None, lambda *_: whole, ["x"], 150, 1, tmp_path / "whole")
    first = Patient(rib_fails=False)
    progress = Progress(lambda fraction, _: progress.cancel() if fraction > 0.5 else None)
    with pytest.raises(Cancelled):
        attack_exercises(progress, lambda *_: first, ["x"], 150, 1, tmp_path / "parts")
    assert 50 < first.played < 100
    (file,) = (tmp_path / "parts").iterdir()
    with file.open("a", encoding="utf-8") as journal:
        journal.write('{"genes": [0.5, 0.')  # the machine went off in the middle of a line
    second = Patient(rib_fails=False)
    found = attack_exercises(None, lambda *_: second, ["x"], 150, 1, tmp_path / "parts")
    assert second.played == whole.played - first.played
    assert found.sheets[1] == expected.sheets[1]
    assert len(
        AttackJournal("closed-form", file.stem.removeprefix("closed-form-"), file.parent)
    ) == (whole.played)
    assert json.loads(file.read_text("utf-8").splitlines()[0])["exercise"] == "closed-form"


def test_a_changed_exercise_or_seed_begins_another_journal(tmp_path):
    for patient, seed in ((Patient(), 1), (Patient(gate=False), 1), (Patient(gate=False), 1)):
        attack_exercises(None, lambda *_, p=patient: p, ["x"], 5, seed, tmp_path)
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.long("statistics")
def test_the_study_names_its_camera_model_and_answers_no_where_it_shows_a_hole(tmp_path):
    sound = attack_exercises(None, lambda *_: Patient(), ["x"], 100, 1, tmp_path)
    assert sound.passed
    assert sound.sheets[0].rows[0][-1] == "closed form"
    assert sound.lines == ("no hole, as far as was tried: closed-form",)
    broken = attack_exercises(None, lambda *_: Patient(gate=False), ["x"], 100, 1, tmp_path)
    assert broken.passed is False
    assert "points for nothing" in broken.lines[0]


def test_where_walk_and_loop_differ_the_study_says_so_and_a_journal_remembers_it(tmp_path):
    line = "rib: the loop had it, the walk had not"

    class Differs(Patient):
        def play(self, attack):
            return replace(super().play(attack), disagree=(line,))

    found = attack_exercises(None, lambda *_: Differs(), ["x"], 30, 1, tmp_path)
    (sheet,) = (one for one in found.sheets if one.name == "differences")
    assert sheet.rows[0][:3] == ("closed-form", line, 30)
    assert found.sheets[0].rows[0][-2] == 30
    assert found.passed, "what differs is told; a hole is what is paid"
    again = Differs()
    known = attack_exercises(None, lambda *_: again, ["x"], 30, 1, tmp_path)
    assert again.played == 0
    assert known.sheets[1].rows == sheet.rows
    older = AttackVerdict(80.0, True).document()
    del older["disagree"]
    assert AttackVerdict.of(older) == AttackVerdict(80.0, True)


def test_options_of_the_adversary_are_its_own():
    study = find_study("adversary")
    assert isinstance(study, Survey)
    for name, option in (("stability", "evaluations"), ("all", "seed")):
        with pytest.raises(StudyError, match=f"study {name} takes no --{option}; leave it out"):
            CliRunner().invoke(build(), ["study", name, f"--{option}", "5"], catch_exceptions=False)


@pytest.mark.long("machine")
def test_a_shipped_exercise_is_attacked_in_virtual_time(tmp_path):
    from app.compose.attacked import Attacked

    target = Attacked("first-insertion", 1)
    honest = target.play(Attack())
    assert honest.passed
    assert honest.fines == ()
    assert honest.closest_mm < 2.0
    idle = target.play(Attack(end_mm=-130.0, dwell_s=16.0))
    assert not idle.passed
    assert idle.closest_mm > 60.0
    again = Attacked("first-insertion", 1)
    assert again.play(Attack()) == honest
    found = attack_exercises(None, lambda *_: target, ["first-insertion"], 12, 1, tmp_path)
    assert found.sheets[0].rows[0][1] == 12
    assert "rig wide" in found.sheets[0].rows[0][-1]


@pytest.mark.long("machine")
def test_what_covered_cameras_do_not_see_the_truth_tells():
    """All the way in and out behind covered cameras: the judge knows no depth, the study does."""
    from app.compose.attacked import Attacked

    target, into_vein = Attacked("scans-only", 1), Attack(tilt_2_deg=-9.0)
    open_eyes = target.play(into_vein)
    hidden = target.play(replace(into_vein, covered_from=0.1, covered_share=1.0))
    assert "hepatic vein" in open_eyes.fines[0]
    assert hidden.total is None
    assert hidden.fines == open_eyes.fines


@pytest.mark.long("machine")
def test_a_judge_that_is_blind_to_what_it_walks_through_is_found_by_the_loop(monkeypatch):
    """The walk is the judgement's own: where it tells nothing, the loop's state still does."""
    from app.compose import attacked

    target, through_vein = attacked.Attacked("plan-it-yourself", 1), Attack(entry_1_mm=25.0)
    through_vein = replace(through_vein, entry_2_mm=-25.0)
    open_eyes = target.play(through_vein)
    assert "hepatic vein" in open_eyes.fines[0]
    assert open_eyes.disagree == ()
    assert not open_eyes.passed
    for place in ("app.compose.attacked", "app.compose.trial", "app.session.attempt_log"):
        monkeypatch.setattr(f"{place}.tissues_met_of", lambda *_: ())
    good = JudgedPlan(100.0, 80.0, 0.0, 30.0)
    for place in ("app.compose.trial", "app.session.attempt_log"):  # nor does it see the plan
        monkeypatch.setattr(f"{place}.judged_plan_of", lambda *_: good)
    target._ready.clear()
    blind = target.play(through_vein)
    assert blind.passed, "the judge sees nothing"
    assert "hepatic vein" in blind.fines[0]
    assert blind.holes == (Hole.FINED_PASS,)
    assert "hepatic vein: the loop had it, the walk had not" in blind.disagree
