"""What the page of the pen says: how well the tip is known, what is seen, what to do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from app.core.units import DEGREE, MILLIMETRE
from app.tracking.fix import FixStatus
from app.views.kit.text import tr
from app.views.kit.verdict import Verdict

if TYPE_CHECKING:
    from app.tracking.pen.body import PenProfile
    from app.tracking.pen.calibrating import PenCalibration
    from app.tracking.pen.step import PenObservation
    from app.tracking.pen.webcam import Webcam

FAST: Final = 0.15
"""Speed [m/s] from which a webcam's picture of the markers blurs: 2 px in 1/60 s."""

WELL: Final = 2.0e-3
"""Radius [m] up to which a tip counts as well known: a target's usual tolerance is 5 mm."""

POOR: Final = 6.0e-3


@dataclass(frozen=True, slots=True)
class Line:
    """One line: its verdict and its words."""

    verdict: Verdict
    text: str


def accuracy_line(seen: PenObservation | None, trouble: str = "") -> Line:
    """Return how well the tip is known, in one sentence; or why it is not.

    Args:
        seen: newest picture.
        trouble: of webcam or tracker; empty without.
    """
    if trouble:
        return Line(Verdict.BAD, tr("The needle is not seen: {why}", why=trouble))
    if seen is None:
        return Line(Verdict.IDLE, tr("waiting for the first picture …"))
    if seen.needle is None:
        return Line(Verdict.BAD, tr("The needle's position is unknown: {why}", why=seen.fix.reason))
    radius, cone = seen.needle.tip_radius(), seen.needle.axis_cone()
    verdict = Verdict.GOOD if radius <= WELL else Verdict.WARNING
    return Line(
        verdict if radius <= POOR else Verdict.BAD,
        tr(
            "The tip is known to ±\N{NO-BREAK SPACE}{mm:.1f} mm (95 %), the direction to "
            "±\N{NO-BREAK SPACE}{deg:.1f}°",
            mm=radius / MILLIMETRE,
            deg=cone / DEGREE,
        ),
    )


def known_lens_words() -> str:
    """Return where the lens of a simulated webcam is known from."""
    return tr("known exactly: the webcam is simulated")


def status_lines(
    seen: PenObservation | None,
    pen: PenProfile,
    webcam: Webcam | None,
    speed: float,
    simulated: bool = False,
) -> tuple[Line, ...]:
    """Return what is seen, whether the pen is held still, and where tip and lens are known from."""
    lines = [] if seen is None else [_faces(seen, pen), *_advice(seen)]
    if seen is not None and seen.needle is not None:
        lines.append(_stillness(speed))
    lines.append(tip_line(pen))
    if simulated:
        lines.append(Line(Verdict.GOOD, tr("the lens is {source}", source=known_lens_words())))
    elif webcam is not None:
        verdict = Verdict.WARNING if webcam.guessed else Verdict.GOOD
        text = tr("the lens is calibrated")
        if webcam.guessed:
            text = tr(
                "the lens is guessed: `acus calibrate mono` measures it, then choose its file"
            )
        lines.append(Line(verdict, text))
    return tuple(lines)


def tip_line(pen: PenProfile) -> Line:
    """Return where the tip is known from."""
    if pen.tip.calibrated:
        return Line(Verdict.GOOD, tr("the tip is measured"))
    return Line(Verdict.WARNING, tr("the tip is where the drawing has it: measure it"))


def result_lines(result: PenCalibration) -> tuple[Line, ...]:
    """Return what a calibration of the tip found."""
    tip, check = result.tip, result.check
    good = Verdict.GOOD if tip.sd_mm <= 1.0 else Verdict.WARNING
    lines = [
        Line(
            good, tr("tip known to {sd:.2f} mm (standard deviation, worst direction)", sd=tip.sd_mm)
        ),
        Line(
            Verdict.GOOD,
            tr(
                "it stood still to {rms:.2f} mm in {n} positions, {out} left out",
                rms=tip.rms / MILLIMETRE,
                n=tip.poses,
                out=tip.left_out,
            ),
        ),
    ]
    if check is None:
        lines.append(Line(Verdict.WARNING, tr("too few positions to hold any back")))
    else:
        held = Verdict.GOOD if check.rms <= 2.0 * tip.rms + 5e-4 else Verdict.WARNING
        lines.append(
            Line(
                held,
                tr(
                    "{n} positions held back: {rms:.2f} mm off (at most {worst:.1f} mm)",
                    n=check.poses,
                    rms=check.rms / MILLIMETRE,
                    worst=check.worst / MILLIMETRE,
                ),
            )
        )
    lines.append(
        Line(Verdict.GOOD, tr("direction of the shaft to {deg:.2f}°", deg=result.axis.sd_deg))
    )
    return tuple(lines)


def _faces(seen: PenObservation, pen: PenProfile) -> Line:
    found = {marker.id for marker in seen.sightings.markers}
    body, base = pen.body.board(), pen.base.board()
    faces = len(found & {marker.id for marker in body.markers})
    sheet = len(found & {marker.id for marker in base.markers})
    verdict = Verdict.GOOD if faces > 1 and sheet else Verdict.WARNING
    text = tr(
        "{faces} of {all} faces of the {name} and {sheet} markers of the sheet are seen",
        faces=faces,
        all=len(body.markers),
        name=body.name,
        sheet=sheet,
    )
    if faces == 1 and sheet:
        text += tr(
            "; two faces tell more: turn a corner of the {name} to the webcam", name=body.name
        )
    return Line(verdict if faces and sheet else Verdict.BAD, text)


def _advice(seen: PenObservation) -> list[Line]:
    todo = {
        FixStatus.OUT_OF_VIEW: tr("show a whole face to the webcam; come nearer, give more light"),
        FixStatus.NO_ORIENTATION: tr("show the sheet too, with nothing lying on its markers"),
    }.get(seen.fix.status)
    return [] if todo is None else [Line(Verdict.WARNING, todo)]


def _stillness(speed: float) -> Line:
    if speed <= FAST:
        return Line(Verdict.GOOD, tr("the pen is held still enough"))
    return Line(
        Verdict.WARNING,
        tr("hold still: at {speed:.0f} mm/s the picture blurs", speed=speed / MILLIMETRE),
    )
