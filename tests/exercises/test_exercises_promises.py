"""What the shipped exercises' texts forbid or promise is simulated and judged."""

import re
from collections.abc import Callable
from typing import Final

import pytest

from app.exercises.guidance import GuidanceMode
from app.exercises.library import library, load_exercise
from app.exercises.locks import Lock
from app.exercises.parts import TELLING, OwnPlan, TissueSource, ViewName
from app.exercises.schema import Exercise

SHIPPED: Final = [exercise.id for exercise in library()]


def forbids(*kinds: str) -> Callable[[Exercise], bool]:
    return lambda e: set(kinds) <= set(e.rules.forbidden)


def simulates(*effects: str) -> Callable[[Exercise], bool]:
    return lambda e: set(effects) <= set(e.effects)


def breathes(exercise: Exercise) -> bool:
    part = exercise.effects.get("breathing")
    return part is not None and part.organ in ("", exercise.target_organ)


def still(exercise: Exercise) -> bool:
    return "breathing" not in exercise.effects and "breath" in exercise.without["breathing"]


def stopped(exercise: Exercise) -> bool:
    is_met = exercise.tissue is TissueSource.FIELD and "bone_contact" in exercise.effects
    return is_met and "bone" in exercise.rules.forbidden


def judged(metric: str, required: bool = False) -> Callable[[Exercise], bool]:
    def holds(exercise: Exercise) -> bool:
        limits = exercise.tolerances.get(metric)
        return limits is not None and limits.weight > 0.0 and (limits.required or not required)

    return holds


def all_of(*rules: Callable[[Exercise], bool]) -> Callable[[Exercise], bool]:
    return lambda e: all(rule(e) for rule in rules)


def keeps_off(exercise: Exercise) -> bool:
    limits = {mm for part in exercise.structures for mm in part.risks.values()}
    return limits == {5.0} and judged("risk_breach", required=True)(exercise)


def scans_alone(exercise: Exercise) -> bool:
    alone = exercise.guidance_mode is GuidanceMode.CONTROL_CT
    return alone and not set(exercise.shown_views) & TELLING


def unguided(exercise: Exercise) -> bool:
    return abs(exercise.assistance) <= 0.2 and Lock.ASSISTANCE in exercise.locked


def repels(exercise: Exercise) -> bool:
    return exercise.assistance < 0.0 and Lock.ASSISTANCE in exercise.locked


PROMISES: Final[dict[str, Callable[[Exercise], bool]]] = {
    r"neither rib nor lung nor\s+vessel": forbids("bone", "lung", "vessel"),
    r"meeting one, or lung, gut or a large vessel, fails": forbids("bone", "lung", "gut", "vessel"),
    r"[Aa] rib stops the\s+needle": stopped,
    r"touching one\s+fails": forbids("bone"),
    r"meets the vessel\s+or a rib fails": all_of(forbids("bone", "vessel"), stopped),
    r"patient\s+holds the breath": still,
    r"moves (a little )?with every\s+breath": breathes,
    r"dragged along": all_of(breathes, simulates("lateral_tissue")),
    r"Tell the patient to hold": lambda e: e.holds_breath,
    r"no two holds have it at the same place": (
        lambda e: e.effects["breathing"].parameters["spread"] > 0.0
    ),
    r"After 20 s he has to breathe": lambda e: e.longest_hold == 20.0,
    r"end the\s+attempt while he holds": judged("depth_error", required=True),
    r"at least 5 mm off": keeps_off,
    r"no guidance by the robot": lambda e: e.assistance == 0.0 and Lock.ASSISTANCE in e.locked,
    r"no other view of the needle": scans_alone,
    r"A tip outside the slices is not seen": scans_alone,
    r"Use few scans": judged("control_scans"),
    r"hardly any guidance": unguided,
    r"robot guides strongly": lambda e: e.assistance >= 0.6,
    r"lowers its help by a step": lambda e: e.fading is not None,
    r"Every fourth attempt is a probe": lambda e: (
        e.fading is not None and e.fading.probe_every == 4
    ),
    r"pushes the needle off the planned path": repels,
    r"pushes the\s+needle aside when it is about to reach": lambda e: "forbidden_region" in e.laws,
    r"before it leans too far": lambda e: "cone_wall" in e.laws,
    r"exactly\s+on the path there is no force": lambda e: "fixture" in e.laws,
    r"Whatever fails in it ends the force": lambda e: e.device == "tensegrity",
    r"below zero it pushes": lambda e: "fixture" in e.laws and Lock.ASSISTANCE not in e.locked,
    r"Find an entry": lambda e: isinstance(e.plan, OwnPlan),
    r"meets no rib and\s+little lung": all_of(
        lambda e: isinstance(e.plan, OwnPlan), forbids("bone"), judged("planned_lung")
    ),
    r"stiff\. Correct the angle": judged("angle_error"),
    r"so\s+no axial slice shows it whole": judged("angle_error"),
    r"Touch the numbered targets": judged("targets_touched", required=True),
    r"hold it there until": lambda e: e.touch is not None and e.touch.dwell_s > 0.0,
    r"Go straight to each": judged("economy_of_motion"),
    r"no force guides you": lambda e: e.fading is not None,
    r"neither overlay nor bull's-eye": lambda e: Lock.VIEWS in e.locked or e.fading is not None,
    r"Watch the motion": lambda e: ViewName.TARGET_MOTION in e.shown_views,
    r"hardly holds the needle": lambda e: e.tissue is TissueSource.FIELD,
}
"""What a text says -> whether an exercise keeps it."""

FORBIDDING: Final = re.compile(
    r"\b(no|neither|nor|nothing|never|not|at least|fails?|stops|forbid\w*|few|only|moves|"
    r"holds the breath|too far|whatever)\b",
    re.IGNORECASE,
)
"""Words of a sentence that forbids or promises something."""


def sentences(text: str) -> list[str]:
    return [part.strip() for part in re.split(r"(?<=[.:;])\s", text) if part.strip()]


@pytest.mark.parametrize("name", SHIPPED)
def test_what_a_text_says_is_simulated_and_judged(name: str) -> None:
    exercise = load_exercise(name)
    said = [text for text in PROMISES if re.search(text, exercise.description)]
    assert not [text for text in said if not PROMISES[text](exercise)]


@pytest.mark.parametrize("name", SHIPPED)
def test_every_sentence_that_forbids_or_promises_is_one_that_is_checked(name: str) -> None:
    description = load_exercise(name).description
    spans = [m.span() for text in PROMISES for m in re.finditer(text, description)]
    unread = [
        part
        for part in sentences(description)
        if FORBIDDING.search(part)
        and not any(
            description.find(part) < end and start < description.find(part) + len(part)
            for start, end in spans
        )
    ]
    assert unread == []


def test_each_promise_is_made_by_a_shipped_exercise() -> None:
    texts = " ".join(exercise.description for exercise in library())
    assert not [text for text in PROMISES if not re.search(text, texts)]
