"""The steps of the daily check, each a verdict, what was found, and what to do. Pure."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from app.core.messages import joined, listed, sentence
from app.core.units import MILLIMETRE
from app.session.checks.facts import CameraFacts, DailyFacts

STALE: Final = 0.02
"""Joint angles older than this fade the force [s]."""
RATE_SHARE: Final = 0.8
DARKEST: Final = 20.0
MOST_DARK: Final = 0.9
MOST_BRIGHT: Final = 0.1
WIDEST_EDGE: Final = 5.0
"""An outline wider than this [px] costs accuracy: the lens is out of focus or the marker moves."""
GOOD_RESIDUAL: Final = 1.0
LARGEST_RESIDUAL: Final = 2.0


class CheckVerdict(StrEnum):
    """How a step came out."""

    GOOD = "good"
    WARNING = "warning"
    BAD = "bad"
    WAITING = "waiting"


@dataclass(frozen=True, slots=True)
class StepResult:
    """One step.

    Attributes:
        name: for files and `--json`.
        title: for people.
        verdict: how it came out.
        found: what was found, one line.
        todo: what to do, one line; empty for a good one.
    """

    name: str
    title: str
    verdict: CheckVerdict
    found: str
    todo: str = ""


def daily_check(facts: DailyFacts) -> tuple[StepResult, ...]:
    """All steps in the order in which they are looked at."""
    return tuple(step(facts) for step in _STEPS)


def overall(results: tuple[StepResult, ...]) -> CheckVerdict:
    """Return the worst of all; waiting while a step waits and none is bad."""
    found = {result.verdict for result in results}
    for verdict in (CheckVerdict.BAD, CheckVerdict.WAITING, CheckVerdict.WARNING):
        if verdict in found:
            return verdict
    return CheckVerdict.GOOD


def _homing(facts: DailyFacts) -> StepResult:
    robot, title = facts.robot, sentence("Homing")
    if not robot.ticking:
        return StepResult(
            "homing",
            title,
            CheckVerdict.BAD,
            sentence("the robot's loop does not run"),
            sentence(
                "wait a moment; if it stays so, check cable and power, start the exercise again"
            ),
        )
    if robot.simulated:
        return StepResult(
            "homing", title, CheckVerdict.GOOD, sentence("simulated robot: its zero is known")
        )
    if robot.homed:
        return StepResult(
            "homing", title, CheckVerdict.GOOD, sentence("homed since it was switched on")
        )
    return StepResult(
        "homing",
        title,
        CheckVerdict.BAD,
        sentence("not homed since it was switched on"),
        sentence("menu Robot, Commissioning, step Homing"),
    )


def _signs(facts: DailyFacts) -> StepResult:
    robot, title = facts.robot, sentence("Signs")
    if robot.simulated:
        return StepResult(
            "signs", title, CheckVerdict.GOOD, sentence("simulated robot: its signs are known")
        )
    if robot.signs:
        return StepResult("signs", title, CheckVerdict.GOOD, sentence("motors and encoders agree"))
    return StepResult(
        "signs",
        title,
        CheckVerdict.BAD,
        sentence("not checked since it was switched on"),
        sentence("menu Robot, Commissioning, step Signs"),
    )


def _force(facts: DailyFacts) -> StepResult:
    robot, title = facts.robot, sentence("Force")
    if robot.fault:
        return StepResult(
            "force",
            title,
            CheckVerdict.BAD,
            robot.fault,
            sentence("do what the message says; see the page Robot"),
        )
    if not robot.encoder_age <= STALE:
        return StepResult(
            "force",
            title,
            CheckVerdict.BAD,
            sentence("joint angles come late, so the force is held back"),
            sentence("check the robot's cable; close other programs"),
        )
    clearance = robot.clearance
    if robot.simulated or (clearance is not None and clearance.full):
        return StepResult("force", title, CheckVerdict.GOOD, sentence("cleared for its full force"))
    if clearance is None:
        return StepResult(
            "force", title, CheckVerdict.WAITING, sentence("the robot has not said yet")
        )
    verdict = CheckVerdict.WARNING if clearance.force_cap > 0.0 else CheckVerdict.BAD
    return StepResult(
        "force",
        title,
        verdict,
        sentence("at most {force:g} N", force=clearance.force_cap),
        clearance.reason,
    )


def _pictures(facts: DailyFacts) -> StepResult:
    title = sentence("Pictures")
    if len(facts.cameras) < 2:
        return StepResult(
            "pictures",
            title,
            CheckVerdict.BAD,
            sentence("{cameras} of 2 cameras", cameras=len(facts.cameras)),
            sentence("plug both cameras in; menu Cameras"),
        )
    worst = [(_picture(camera), camera.name) for camera in facts.cameras]
    for verdict in (CheckVerdict.BAD, CheckVerdict.WAITING, CheckVerdict.WARNING):
        for (found, text, todo), name in worst:
            if found is verdict:
                return StepResult("pictures", title, verdict, joined(": ", (name, text)), todo)
    rates = listed(f"{camera.rate:.0f}" for camera in facts.cameras)
    return StepResult(
        "pictures",
        title,
        CheckVerdict.GOOD,
        sentence("both bright and sharp, {rates} a second", rates=rates),
    )


def _picture(camera: CameraFacts) -> tuple[CheckVerdict, str, str]:
    quality = camera.quality
    if camera.trouble:
        return CheckVerdict.BAD, camera.trouble, sentence("check the camera's cable; menu Cameras")
    if quality is None:
        return CheckVerdict.WAITING, sentence("no picture yet"), sentence("wait a moment")
    if quality.level < DARKEST or quality.dark > MOST_DARK:
        return (
            CheckVerdict.BAD,
            sentence("the picture is dark"),
            sentence("lens cap, light, exposure"),
        )
    if quality.bright > MOST_BRIGHT:
        return (
            CheckVerdict.WARNING,
            sentence("{share:.0f} % of the picture is overexposed", share=100.0 * quality.bright),
            sentence("less light, or a shorter exposure"),
        )
    if camera.rate and camera.rate < RATE_SHARE * camera.wanted_rate:
        return (
            CheckVerdict.WARNING,
            sentence(
                "{rate:.0f} pictures a second instead of {wanted:.0f}",
                rate=camera.rate,
                wanted=camera.wanted_rate,
            ),
            sentence("own USB port for each camera; lock the exposure"),
        )
    if quality.edge_width is not None and quality.edge_width > WIDEST_EDGE:
        return (
            CheckVerdict.WARNING,
            sentence("the marker's edge is {width:.1f} px wide", width=quality.edge_width),
            sentence("focus the lens on the needle and lock it"),
        )
    return CheckVerdict.GOOD, "", ""


def _marker(facts: DailyFacts) -> StepResult:
    title = sentence("Marker")
    missed = [(camera.name, camera.miss) for camera in facts.cameras if camera.miss]
    if len(facts.cameras) == 2 and not missed:
        return StepResult("marker", title, CheckVerdict.GOOD, sentence("found in both pictures"))
    if not facts.cameras:
        return StepResult(
            "marker",
            title,
            CheckVerdict.WAITING,
            sentence("no pictures yet"),
            sentence("pictures first"),
        )
    text = joined("; ", (joined(": ", pair) for pair in missed)) or sentence("only one camera")
    return StepResult(
        "marker",
        title,
        CheckVerdict.BAD,
        text,
        sentence(
            "push the needle on until both cameras see the red band; look for other red things"
        ),
    )


def _agreement(facts: DailyFacts) -> StepResult:
    title = sentence("Cameras agree")
    if facts.residual_px is None:
        return StepResult(
            "residual",
            title,
            CheckVerdict.WAITING,
            facts.status or sentence("no point yet"),
            sentence("the marker must be seen by both cameras"),
        )
    text = sentence("residual {residual:.2f} px", residual=facts.residual_px)
    if facts.status:
        return StepResult(
            "residual",
            title,
            CheckVerdict.BAD,
            joined(": ", (text, facts.status)),
            sentence("a camera was moved, or robot and cameras differ: `acus calibrate world`"),
        )
    if facts.residual_px <= GOOD_RESIDUAL:
        return StepResult("residual", title, CheckVerdict.GOOD, text)
    verdict = CheckVerdict.WARNING if facts.residual_px <= LARGEST_RESIDUAL else CheckVerdict.BAD
    return StepResult(
        "residual",
        title,
        verdict,
        text,
        sentence("a camera was bumped? calibrate again: menu Cameras"),
    )


def _touch(facts: DailyFacts) -> StepResult:
    title, touch = sentence("Touch one point"), facts.touch
    if touch is None:
        found = facts.touch_failure or sentence("not touched yet")
        return StepResult(
            "touch",
            title,
            CheckVerdict.WAITING,
            found,
            sentence("rest the tip in a known mark and hold still for a second"),
        )
    distance, radius = touch.distance / MILLIMETRE, touch.radius / MILLIMETRE
    text = sentence(
        "{touch_name}: {distance:.2f} mm off, measured to ± {radius:.2f} mm (95 %)",
        touch_name=touch.name,
        distance=distance,
        radius=radius,
    )
    if touch.radius > max(touch.tolerance, touch.distance):
        return StepResult(
            "touch",
            title,
            CheckVerdict.WARNING,
            text,
            sentence(
                "the cameras do not measure this point well enough to tell: look at "
                "their pictures and rate, touch again"
            ),
        )
    if touch.distance <= touch.tolerance:
        return StepResult("touch", title, CheckVerdict.GOOD, text)
    limit = sentence(
        "the limit is {touch_tolerance_mm:.1f} mm", touch_tolerance_mm=touch.tolerance / MILLIMETRE
    )
    return StepResult(
        "touch",
        title,
        CheckVerdict.BAD,
        text,
        sentence(
            "{limit}: touch again; is it {touch_name}, is the plate in its place? then "
            "check with all fiducials: menu Checks, Registration check",
            limit=limit,
            touch_name=touch.name,
        ),
    )


_STEPS: Final[tuple[Callable[[DailyFacts], StepResult], ...]] = (
    _homing,
    _signs,
    _force,
    _pictures,
    _marker,
    _agreement,
    _touch,
)
