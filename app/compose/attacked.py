"""An exercise as the study `adversary` attacks it: plays attacks in virtual time, and tells what
the needle truly met, whatever the cameras saw and the exercise forbids.

Attempts run as those of `acus exercise trial`. Beside the score stands the truth, told twice: the
tip by the simulated robot's own depth, walked through the patient's field as the judgement does it;
and the tissue that the loop itself had under the tip. What is hidden from the judgement is hidden
from neither, a wrong walk not from the second, and where the two disagree the study says so.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Collection
from typing import TYPE_CHECKING, Final

import numpy as np

from app.compose.exercise_ct import load_field, load_risks, read_ct
from app.compose.exercise_field import resolve_tissue, trial_plan
from app.compose.loop_truth import disagreements, met_in_loop, tissue_key
from app.compose.trial import Trials
from app.compose.trial_parts import PlayedHand, PlayedTrial
from app.core.arrays import FloatArray
from app.core.build import build
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.exercises.library import load_exercise
from app.exercises.locks import Lock
from app.exercises.parts import LayersFrom
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.tissue import with_tissue
from app.imaging.body import find_body, nearest_skin
from app.scoring.met import FORBIDDEN, Met
from app.scoring.result import TRACKING
from app.scoring.rows import Row, gated
from app.session.risks import risk_marks_of
from app.session.tissues import tissues_met_of
from app.simulation.trainee import tangent_basis, tangents
from app.studies.attacks.attack import Aim, Attack
from app.studies.attacks.search import AttackVerdict
from app.studies.errors import StudyError

if TYPE_CHECKING:
    from app.planning.placement import PlacedPlan
    from app.planning.plan import Plan
    from app.session.samples import Samples

CAMERAS: Final = (
    "sampled depths of rig {rig}: noise and misses by the tracker's own solver, no pictures; "
    "covered cameras capture nothing"
)

ENTRY_STEP_MM: Final = 5.0
"""Entries of the student's own plan are tried on such a grid: each is compiled for itself."""

ENTRIES: Final = 24
"""So many stay compiled."""

TOUCHED: Final = 0.3
"""How bad it is to meet a thing at all, 0 to 1; through `WORST_MM` of it, 1."""

WORST_MM: Final = 20.0


class Attacked:
    """An exercise, ready to be attacked.

    Args:
        name: of the exercise, or its file.
        seed: of the cameras' noise.
        progress: told how far reading its CT is.

    Raises:
        AcusError: if the exercise, its CT or its structures cannot be used; says why.
        Cancelled: if `progress` was cancelled.
    """

    def __init__(self, name: str, seed: int, progress: Progress | None = None) -> None:
        progress, self._seed = progress or Progress(), seed
        self._exercise = load_exercise(name)
        self._profile = device_of(self._exercise)
        self._plan = trial_plan(self._exercise)
        self._volume = read_ct(self._exercise, progress.part(0.0, 0.3))
        self._risks = load_risks(self._exercise, self._volume, progress.part(0.3, 0.5))
        self._field = load_field(self._exercise, self._volume, self._plan, progress.part(0.5, 0.9))
        if self._field is None:
            raise StudyError(
                sentence(
                    "exercise {name} has no CT in Hounsfield values: nothing tells what its needle"
                    " meets",
                    name=name,
                )
            )
        self._plans_itself = self._exercise.is_own_plan
        self._body = find_body(self._volume) if self._plans_itself else None
        self._ready: OrderedDict[object, tuple[Trials, PlacedPlan]] = OrderedDict()
        self._of(Attack())
        progress.report(1.0)

    @property
    def id(self) -> str:
        """Return the exercise's name."""
        return self._exercise.id

    @property
    def cameras(self) -> str:
        """Say which model of the cameras is used."""
        return CAMERAS.format(rig=self._exercise.rig)

    @property
    def shut(self) -> frozenset[str]:
        """Genes of an attack that the exercise does not leave to the student."""
        shut = set() if self._plans_itself else {"entry_1_mm", "entry_2_mm"}
        if Lock.ASSISTANCE in self._exercise.locked or not self._exercise.laws:
            shut.add("dial")
        if Lock.VIEWS in self._exercise.locked:
            shut.add("views_hidden")
        return frozenset(shut)

    def facts(self) -> tuple[object, ...]:
        """Return all that a verdict depends on beside genes and the program's files, JSON-ready."""
        field = "" if self._field is None else self._field.digest
        content = self._exercise.model_dump(mode="json")
        return content, build(), field, self.cameras, self._seed

    def play(self, attack: Attack) -> AttackVerdict:
        """Play an attack and judge it; the same for the same attack.

        An attack that cannot be played (the plan is out of reach, say) is worth nothing.
        """
        try:
            trials, placed = self._of(attack)
            deepest = float(self._profile.depth_range[1])
            script = attack.script(placed.axis, self._aims(placed), deepest)
            dial = None if "dial" in self.shut else attack.dial
            hand = PlayedHand(script, dial, attack.covered(script))
            played = trials.play(hand, self._seed)
        except AcusError:
            return AttackVerdict(None, False, closest_mm=self._plan.length_mm)
        return self._verdict(trials, placed, played)

    def _verdict(self, trials: Trials, placed: PlacedPlan, played: PlayedTrial) -> AttackVerdict:
        score, true = played.score, trials.truth(played.rows)
        walked = tissues_met_of(true, placed, self._field) or ()
        looped = met_in_loop(played.rows, self._field, placed)
        met = self._forbidden(walked)
        told = {tissue_key(one) for one in met}  # is not told again; what the walk missed is
        met += [one for one in self._forbidden(looped or ()) if tissue_key(one) not in told]
        known = self._forbidden(score.met or () if score is not None else ())
        risks = [mark for mark in risk_marks_of(true, placed, self._risks) if mark.closest_mm < 0.0]
        entered = [f"{mark.name} entered at {mark.depth_mm:.1f} mm" for mark in risks]
        bad = _bad([one.length_mm for one in met])
        judged: tuple[str, ...] = ()
        seen = otherwise = 0.0
        if score is not None:
            otherwise = _total(score.rows)
            seen = next((row.value or 0.0 for row in score.rows if row.name == TRACKING), 0.0)
            judged = (*score.hard_fails, *(row.name for row in score.failures))
        return AttackVerdict(
            total=None if score is None else score.total,
            passed=score is not None and score.passed,
            fines=(*(one.sentence for one in met), *entered),
            fine=min(1.0, bad + _bad([-mark.closest_mm for mark in risks])),
            closest_mm=self._closest_mm(true, placed),
            judged=judged,
            hidden=max(0.0, 1.0 - _bad([one.length_mm for one in known]) / bad) if met else 0.0,
            seen=seen / 100.0,
            otherwise=otherwise,
            disagree=disagreements(walked, looped),
        )

    def _forbidden(self, met: Collection[Met]) -> list[Met]:
        """Return what of all that was met no needle may meet, here or anywhere."""
        kinds = {*FORBIDDEN, *self._exercise.rules.forbidden}
        return [one for one in met if one.is_forbidden(kinds)]

    def _closest_mm(self, true: Samples, placed: PlacedPlan) -> float:
        """Return how near the true tip came to the target, or to the furthest of several [mm]."""
        task = self._exercise.touch_task(placed)
        shift = true.target - placed.p_target
        targets = placed.p_target[None] if task is None else task.p_targets
        tips = true.tip - np.where(np.isfinite(shift), shift, 0.0)
        away = np.linalg.norm(tips[:, None] - targets, axis=2)
        away = np.where(np.isfinite(away), away, np.inf)
        nearest = float(away.min(axis=0).max()) / MILLIMETRE
        return nearest if np.isfinite(nearest) else self._plan.length_mm

    def _aims(self, placed: PlacedPlan) -> list[Aim]:
        """Return where the tip has to go, one place after the other."""
        task = self._exercise.touch_task(placed)
        if task is None:
            return [(0.0, 0.0, placed.length)]
        ways = task.p_targets - placed.p_entry
        depths = np.linalg.norm(ways, axis=1)
        e1, e2 = tangents(ways / depths[:, None], placed.axis, tangent_basis(placed.axis))
        return list(zip(e1.tolist(), e2.tolist(), depths.tolist(), strict=True))

    def _of(self, attack: Attack) -> tuple[Trials, PlacedPlan]:
        """Return the exercise compiled for an attack's entry and views."""
        steps = np.zeros(2)
        if self._plans_itself:
            steps = np.rint(np.array([attack.entry_1_mm, attack.entry_2_mm]) / ENTRY_STEP_MM)
        hides = attack.views_hidden > 0.0 and "views_hidden" not in self.shut
        key = (*steps.tolist(), hides)
        if key in self._ready:
            self._ready.move_to_end(key)
            return self._ready[key]
        exercise = self._exercise.showing(()) if hides else self._exercise
        placed = placed_plan_of(exercise, self._profile, self._entering(steps))
        if exercise.layers_from is LayersFrom.CT:
            exercise = with_tissue(exercise, self._volume, placed.plan)
        exercise, _ = resolve_tissue(exercise, placed, self._field)
        self._ready[key] = Trials(exercise, placed, self._risks, self._field), placed
        if len(self._ready) > ENTRIES:
            self._ready.popitem(last=False)
        return self._ready[key]

    def _entering(self, steps: FloatArray) -> Plan:
        """Return the plan with its entry moved along the skin."""
        if self._body is None or not steps.any():
            return self._plan
        across = ENTRY_STEP_MM * steps @ tangent_basis(self._plan.direction)
        return self._plan.with_entry(nearest_skin(self._body, self._plan.entry_mm + across))


def _bad(lengths_mm: Collection[float]) -> float:
    """Return how bad it is to go through so much of so many things, from 0 on."""
    return sum(TOUCHED + (1.0 - TOUCHED) * length / WORST_MM for length in lengths_mm)


def _total(rows: Collection[Row]) -> float:
    """Return the total of rows, whether they are void or not."""
    weight = sum(row.weight for row in rows)
    if weight <= 0.0:
        return 0.0
    return 100.0 * sum(row.weight * row.counted for row in gated(tuple(rows))) / weight
