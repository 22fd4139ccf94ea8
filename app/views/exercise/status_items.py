"""Health of every part as words: a verdict, what it is, and what to do about it. Pure."""

from dataclasses import dataclass
from math import inf
from typing import Final

from app.core.staleness import (
    ENCODER_FADE,
    ENCODER_ZERO,
    HEARTBEAT,
    TRACKER_FRESH,
    TRACKER_HOLD,
)
from app.views.kit.text import tr
from app.views.kit.verdict import StatusItem, Verdict

LATE_WARNING: Final = 0.2e-3
"""Median lateness [s] from which the loop is called late: the figure the loop has to keep."""
MISSED_WINDOW: Final = 10.0
"""The share of missed deadlines is that of so many last seconds."""
MISSED_WARNING: Final = 0.001
MISSED_BAD: Final = 0.05
SHARE_WARNING: Final = 0.9


@dataclass(frozen=True, slots=True)
class LoopFigures:
    """How the loop keeps its time.

    Attributes:
        rate: ticks a second over the last second.
        median, p99: lateness [s].
        missing: share of the deadlines missed in the last `MISSED_WINDOW` seconds, 0…1.
        missed: deadlines missed since the start, of `ticks` so far.
    """

    rate: float
    median: float
    p99: float
    missing: float
    missed: int
    ticks: int


def loop_item(figures: LoopFigures) -> StatusItem:
    """Return the loop's health now; what it missed long ago stands in the help only."""
    verdict = Verdict.GOOD
    if figures.median > LATE_WARNING or figures.missing > MISSED_WARNING:
        verdict = Verdict.WARNING
    if figures.missing > MISSED_BAD:
        verdict = Verdict.BAD
    text = tr(
        "{rate:.0f} Hz · late {median:.2f} / {p99:.2f} ms · {missing:.1f} % missed",
        rate=figures.rate,
        median=1e3 * figures.median,
        p99=1e3 * figures.p99,
        missing=100.0 * figures.missing,
    )
    return StatusItem(
        verdict,
        tr("Robot loop"),
        text,
        tr(
            "Rate of the force loop, its lateness (median / 99th percentile) and the share of "
            "deadlines it missed in the last {seconds:.0f} s; since the start it missed {missed} "
            "of {ticks}. If it is late, close other programs; forces stay limited either way.",
            seconds=MISSED_WINDOW,
            missed=figures.missed,
            ticks=figures.ticks,
        ),
        detail=True,
    )


def encoder_item(age: float, fault: str = "") -> StatusItem:
    """Return the encoders' health: age [s], and the fault that holds the force at zero."""
    verdict = Verdict.BAD if fault else _by_age(age, ENCODER_FADE, ENCODER_ZERO)
    text = tr("fault: no force") if fault else age_text(age)
    return StatusItem(
        verdict,
        tr("Encoders"),
        text,
        tr(
            "Age of the robot's joint angles. The force fades from 20 ms and is zero from 100 ms. "
            "If it stays old, check the robot's cable and power, then start the attempt again."
        )
        + (f"\n{fault}" if fault else ""),
        detail=True,
    )


@dataclass(frozen=True, slots=True)
class TipTeller:
    """What tells where the needle is.

    Attributes:
        simulated: whether this computer draws what cameras see.
        told_by: who tells it without pictures, by name; empty where cameras look.
        pen: whether one webcam looks at a pen, in place of two cameras at a marker.
    """

    simulated: bool = False
    told_by: str = ""
    pen: bool = False

    @property
    def title(self) -> str:
        """Name it."""
        if self.told_by:
            return tr("Needle")
        return tr("Webcam") if self.pen else tr("Cameras")


CAMERAS: Final = TipTeller()


def tracker_item(
    rate: float, valid_share: float, age: float, problem: str, teller: TipTeller = CAMERAS
) -> StatusItem:
    """Return the health of what tells where the needle is.

    Args:
        rate: of its fixes [Hz].
        valid_share: of the usable ones, 0…1.
        age: of the last fix [s].
        problem: what keeps it from one; empty if nothing does.
        teller: what it is.
    """
    verdict = _by_age(age, TRACKER_FRESH, TRACKER_HOLD)
    if verdict is Verdict.GOOD and (problem or valid_share < SHARE_WARNING):
        verdict = Verdict.WARNING
    text = problem or tr(
        "{rate:.0f} Hz · {share:.0f} % valid · {age}",
        rate=rate,
        share=100 * valid_share,
        age=age_text(age),
    )
    plain = _seen_words(verdict, problem, teller)
    return StatusItem(verdict, teller.title, text, _teller_help(teller), plain)


def _teller_help(teller: TipTeller) -> str:
    if teller.told_by:
        return tr(
            "Rate of what {source} says of the needle, share of it that can be used, age of the "
            "last such word. No camera looks at the needle. If it tells nothing, look at its "
            "cable, its power and its program.",
            source=teller.told_by,
        )
    if teller.pen:
        return tr(
            "Rate of the tracker, share of pictures in which the webcam saw the pen, age of the "
            "last such fix. If the pen is out of view, bring it back before the webcam; look at "
            "the picture for dirt, light or something in the way."
        )
    if teller.simulated:
        return tr(
            "Rate of the tracker, share of pictures in which both cameras saw the marker, age of "
            "the last such fix. The cameras are simulated: this computer draws what they see. "
            "Where their pictures come late, close other programs."
        )
    return tr(
        "Rate of the tracker, share of pictures in which both cameras saw the marker, age of "
        "the last such fix. If the marker is out of view, bring it back between the cameras; "
        "look at the camera pictures for dirt, light or something in the way."
    )


def _seen_words(verdict: Verdict, problem: str, teller: TipTeller) -> str:
    """Say in a student's words how the needle is seen; `simulated` cameras are never to blame."""
    if problem:
        return problem
    if teller.told_by:
        words = {
            Verdict.GOOD: tr("told by {source}", source=teller.told_by),
            Verdict.WARNING: tr("told by {source} now and then", source=teller.told_by),
        }
        return words.get(verdict, tr("not told by {source}", source=teller.told_by))
    if teller.pen:
        words = {
            Verdict.GOOD: tr("sees the pen"),
            Verdict.WARNING: tr("sees the pen now and then"),
        }
        return words.get(verdict, tr("does not see the pen"))
    if teller.simulated and verdict is not Verdict.GOOD:
        return tr("pictures come late: this computer is busy, close other programs")
    return {
        Verdict.GOOD: tr("see the marker"),
        Verdict.WARNING: tr("see the marker now and then"),
    }.get(verdict, tr("do not see the marker"))


def no_cameras_item() -> StatusItem:
    """Return what is said where there are no cameras: nothing of theirs can be amiss."""
    return StatusItem(
        Verdict.IDLE,
        tr("Cameras"),
        tr("no cameras"),
        tr("There are no cameras here: the depth comes from elsewhere, or from nowhere."),
    )


def depth_item(source: str, age: float, teller: TipTeller = CAMERAS) -> StatusItem:
    """Say where the shown depth comes from: one of `session.needle.DepthSource`, by whom."""
    seen = tr("from the webcam") if teller.pen else tr("from the cameras")
    known = {
        "tracked": (
            Verdict.GOOD,
            tr("from {source}", source=teller.told_by) if teller.told_by else seen,
        ),
        "one_camera": (Verdict.WARNING, tr("from one camera")),
        "held": (Verdict.WARNING, tr("held, {age} old", age=age_text(age))),
        "model": (Verdict.BAD, tr("not measured")),
        "none": (Verdict.BAD, tr("unknown")),
    }
    verdict, text = known.get(source, known["none"])
    plain = {"tracked": tr("measured"), "held": tr("measured a moment ago")}
    return StatusItem(
        verdict,
        tr("Depth"),
        text,
        tr(
            "The depth is told by {source}. Without its word it is held for 200 ms. After that, "
            "and until ten in a row agree, nobody knows it: the force is held back for the worst "
            "depth that the needle can have.",
            source=teller.told_by or tr("the webcam"),
        )
        if teller.told_by or teller.pen
        else tr(
            "The depth is measured by the cameras; by one of them and the needle's line, less "
            "exactly, while the other does not see the marker. Without a fix it is held for 200 "
            "ms. After that, and until ten pictures in a row agree, nobody knows it: the force is "
            "held back for the worst depth that the needle can have. Wait until the cameras see "
            "the marker again."
        ),
        plain=plain.get(source, text),
    )


def heartbeat_item(age: float) -> StatusItem:
    """Return the age [s] of this window's sign of life to the loop."""
    verdict = _by_age(age, 0.5 * HEARTBEAT, HEARTBEAT)
    return StatusItem(
        verdict,
        tr("Heartbeat"),
        age_text(age),
        tr(
            "The window's sign of life to the robot. After 1 s without one the force goes to zero. "
            "If it stops, the window is frozen: wait, or end the program."
        ),
        detail=True,
    )


def robot_item(
    loop: StatusItem | None,
    encoders: StatusItem,
    heartbeat: StatusItem,
    fault: str = "",
    guard_acts: bool = False,
    at_most: bool = False,
) -> StatusItem:
    """Return the one light that stands for everything of the robot: ready, held back, stopped.

    Args:
        loop: item of the whole strip; None without a robot.
        encoders: likewise.
        heartbeat: likewise.
        fault: what holds the force at zero, if something does.
        guard_acts: whether the guard takes energy out now.
        at_most: whether the force is held back because the depth is not certain.
    """
    ready = tr("Robot ready")
    verdicts = (loop.verdict if loop else Verdict.IDLE, heartbeat.verdict)
    if loop is None:
        verdict, words = Verdict.IDLE, tr("No robot")
    elif fault:
        verdict, words = Verdict.BAD, tr("Robot stopped: {why}", why=fault)
    elif encoders.verdict is Verdict.BAD:
        verdict, words = Verdict.BAD, tr("Robot stopped: {why}", why=tr("it does not answer"))
    elif heartbeat.verdict is Verdict.BAD:
        why = tr("computer busy, close programs")
        verdict, words = Verdict.BAD, tr("Robot stopped: {why}", why=why)
    elif guard_acts:
        verdict, words = (
            Verdict.WARNING,
            tr("Robot held back: {why}", why=tr("it calms the needle")),
        )
    elif encoders.verdict is Verdict.WARNING:
        verdict, words = Verdict.WARNING, tr("Robot held back: {why}", why=tr("it answers late"))
    elif at_most:
        verdict, words = (
            Verdict.WARNING,
            tr("Robot held back: {why}", why=tr("the depth is not certain")),
        )
    elif Verdict.BAD in verdicts or Verdict.WARNING in verdicts:
        verdict, words = Verdict.WARNING, tr("Computer busy: close programs")
    else:
        verdict, words = Verdict.GOOD, ready
    guard = tr("acts: the force is weakened or damped") if guard_acts else tr("at rest")
    lines = [
        f"{part.verdict.colour_and_symbol[1]} {part.title}: {part.text}"
        for part in (loop, encoders, heartbeat)
        if part is not None
    ]
    lines.append(tr("Energy guard: {words}", words=guard))
    return StatusItem(verdict, words, "", "\n".join(lines))


def recorder_item(recording: bool, lost: int = 0, failure: str = "") -> StatusItem:
    """Return the recorder's health: whether it writes, what it lost, why it cannot write."""
    verdict, text = Verdict.IDLE, tr("not recording")
    if recording:
        verdict, text = Verdict.GOOD, tr("recording")
    if lost:
        verdict, text = Verdict.WARNING, tr("{lost} samples lost", lost=lost)
    if failure:
        verdict, text = Verdict.BAD, tr("failed")
    return StatusItem(
        verdict,
        tr("Recorder"),
        text,
        tr(
            "Every attempt is written to disk, flushed each second. If samples are lost, the disk "
            "is too slow or full: free some space."
        )
        + (f"\n{failure}" if failure else ""),
    )


def age_text(age: float) -> str:
    """Say an age [s] in milliseconds or seconds."""
    if not age < inf or age > 1e6:
        return tr("never")
    if age < 1.0:
        return tr("{ms:.0f} ms", ms=1e3 * age)
    return tr("{s:.1f} s", s=age)


def _by_age(age: float, warning: float, bad: float) -> Verdict:
    """NaN counts as too old."""
    if not age < bad:
        return Verdict.BAD
    return Verdict.GOOD if age <= warning else Verdict.WARNING
