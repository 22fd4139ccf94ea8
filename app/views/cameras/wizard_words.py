"""What the wizard says of a calibration: verdict, figures, parameters, views, cameras' places."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.core.units import MILLIMETRE
from app.tracking.calibration.checks import check_baseline
from app.tracking.calibration.mono import MonoResult
from app.tracking.calibration.run import StereoResult
from app.tracking.calibration.verdict import Grade, Why, judge
from app.tracking.calibration.views import Rejection
from app.tracking.calibration.world import WorldFrame
from app.tracking.optics.calibration import CameraCalibration, StereoCalibration
from app.views.kit.text import listing, number, tr
from app.views.kit.verdict import Verdict

Line = tuple[Verdict, str]


def pairs_words(pairs: int, different: int | None, refused: Sequence[Rejection]) -> str:
    """Say how many pairs there are.

    Args:
        pairs: in which both cameras see the board.
        different: of them that show it as no other does; None if there are only such.
        refused: pictures of no use.
    """
    if different is None:
        words = tr("{pairs} pairs taken: both cameras see the board in each", pairs=pairs)
    elif not pairs:
        words = tr("no pair in which both cameras see the board")
    else:
        words = tr(
            "{pairs} pairs, all of which are used; {different} of them show the board unlike the "
            "others: only those count below",
            pairs=pairs,
            different=different,
        )
    if refused:
        alike = len({view.text for view in refused}) == 1
        each = [view.name if alike else f"{view.name} ({view.text})" for view in refused[:4]]
        names = listing(each) if len(refused) <= 4 else ", ".join(each) + " …"
        words += "; " + tr("not used: {names}", names=names)
        words += f" ({refused[0].text})" if alike else ""
    return words


def verdict_of(calibration: StereoCalibration) -> Line:
    """Return whether a calibration is of use, and why not; `calibration.verdict` decides."""
    found = judge(calibration)
    verdict = {
        Grade.GOOD: Verdict.GOOD,
        Grade.USABLE: Verdict.WARNING,
        Grade.NOT_GOOD_ENOUGH: Verdict.BAD,
    }[found.grade]
    if found.grade is Grade.NOT_GOOD_ENOUGH:
        return verdict, tr(
            "Not good enough to use: glue the board on something flat, take sharper pictures, and "
            "check the board's counts and sizes."
        )
    if found.why is Why.UNCHECKED:
        return verdict, tr(
            "It fits, but was not checked: there were too few pairs to hold some back. Take at "
            "least eight."
        )
    if found.why is Why.APART:
        return verdict, tr(
            "Usable, but the pairs do not belong together: the board or a camera moved between "
            "the two pictures. What is stated is wider for it; hold the board still and take them "
            "again."
        )
    if found.why is Why.ROLLING:
        return verdict, tr(
            "Usable, but the board moved while its pictures were read row by row (rolling "
            "shutter): distances come out wrong. Hold the board against something still and take "
            "them again."
        )
    if found.why is Why.RAYS:
        return verdict, tr(
            "Usable, but only where the board was seen: elsewhere in the pictures the rays are "
            "hardly known. Take more pairs with the board near the edges and corners."
        )
    if found.grade is Grade.USABLE:
        return verdict, tr("Usable, but worse than usual: more and sharper views will do better.")
    return verdict, tr("Good: pairs that took no part come out right.")


def ruler_line(calibration: StereoCalibration, known_mm: float) -> Line:
    """Say what a distance of the cameras by ruler [mm] tells of the board's size; 0: none."""
    if known_mm <= 0.0:
        return Verdict.WARNING, tr("The board's size is not checked: nothing else here can tell.")
    check = check_baseline(calibration, known_mm)
    return Verdict.GOOD if check.passed else Verdict.BAD, check.text


def figures(calibration: StereoCalibration) -> list[tuple[str, str]]:
    """Titles and values of the result."""
    left, right = calibration.cameras
    rows = [
        (
            tr("Residual"),
            tr(
                "{pair:.2f} px both, {left:.2f} px {l}, {right:.2f} px {r}",
                pair=calibration.rms_px,
                left=left.rms_px,
                l=left.name,
                right=right.rms_px,
                r=right.name,
            ),
        ),
        (
            tr("Distance of the cameras"),
            tr(
                "{mm:.2f} ± {sd:.2f} mm",
                mm=calibration.baseline / MILLIMETRE,
                sd=baseline_sd(calibration) / MILLIMETRE,
            ),
        ),
    ]
    checked = calibration.validation
    if checked is not None:
        words = tr(
            "{n} pairs, {points} corners: {rms:.3f} mm RMS, {most:.3f} mm at most",
            n=checked.views,
            points=checked.points,
            rms=checked.rms_mm,
            most=checked.max_mm,
        )
        rows.append((tr("Pairs held back"), words))
        rows.append(
            (
                tr("Lengths in them"),
                tr(
                    "{scale:.5f} ± {sd:.5f} times the true ones",
                    scale=checked.scale,
                    sd=checked.scale_sd,
                ),
            )
        )
    return rows


def baseline_sd(calibration: StereoCalibration) -> float:
    """Return the standard deviation of the distance between the cameras [m].

    The twist (ρ, ω) on the left moves t to t + ρ + ω×t; |t| changes by t·ρ / |t|.
    """
    t = calibration.pose.transform.translation
    u = t / max(1e-12, calibration.baseline)
    spread = calibration.pose.pose_covariance[:3, :3]
    return float(np.sqrt(max(0.0, float(u @ spread @ u))))


def parameter_rows(mono: MonoResult, camera: CameraCalibration) -> list[tuple[str, str]]:
    """Each parameter with its standard deviation; in brackets what the views do not tell.

    Args:
        mono: the camera by itself, which decided on the distortion's coefficients.
        camera: as it came out with the other one.
    """
    values = (*camera.focal_px, *camera.centre_px, *camera.distortion)
    dropped = {one.name: one for one in mono.dropped}
    rows = []
    for i, (name, value) in enumerate(zip(camera.lens.parameters, values, strict=True)):
        sd = max(0.0, camera.covariance[i][i]) ** 0.5
        if name in camera.estimated:
            digits = 2 if i < 4 else 4
            form = f".{digits}f"
            words = f"{number(value, form)} ± {number(sd, form)}"
            rows.append((f"{name} [px]" if i < 4 else name, words))
        elif name in dropped:
            lost = dropped[name]
            rows.append((name, f"({number(lost.value, '.1g')} ± {number(lost.sd, '.1g')})"))
        else:
            rows.append((name, tr("(dropped)")))
    return rows


def other_notes(calibration: StereoCalibration) -> list[str]:
    """Return notes that neither the table of parameters nor that of pairs tells."""
    told = ("the views do not tell", "does not fit")
    notes = [note for note in calibration.notes if not any(words in note for words in told)]
    return [tr("In brackets: the views do not tell it; 0 is used."), *notes]


def view_rows(result: StereoResult) -> list[tuple[str, float, Verdict, str]]:
    """Name, residual [px], verdict and remark of every pair; the worst first."""
    remarks = {
        "used": (Verdict.IDLE, ""),
        "outlier": (Verdict.WARNING, tr("outlier, left out")),
        "held_back": (Verdict.GOOD, tr("held back")),
    }
    rows = [(row.name, row.rms_px, *remarks[row.role]) for row in result.residuals]
    return sorted(rows, key=lambda row: -row[1])


def world_lines(calibration: StereoCalibration, world: WorldFrame) -> list[Line]:
    """Return where the cameras stand, how sure that is, and what to look at."""
    lines: list[Line] = []
    for camera, centre in zip(calibration.cameras, world.centres, strict=True):
        x, y, z = centre / MILLIMETRE
        lines.append(
            (
                Verdict.GOOD,
                tr(
                    "{camera} camera at x {x:.0f}, y {y:.0f}, z {z:.0f} mm",
                    camera=camera.name,
                    x=x,
                    y=y,
                    z=z,
                ),
            )
        )
    lines.append((Verdict.GOOD, tr("corners within {px:.2f} px", px=world.rms_px)))
    if world.watched_sd_mm is not None:
        lines.append(
            (
                Verdict.GOOD,
                tr(
                    "at the fulcrum the frame is sure to ± {mm:.2f} mm (standard deviation per "
                    "axis)",
                    mm=world.watched_sd_mm,
                ),
            )
        )
    if world.disagreement_mm > 0.0:
        lines.append(
            (Verdict.GOOD, tr("places agree within {mm:.1f} mm", mm=world.disagreement_mm))
        )
    return lines + [(Verdict.WARNING, remark) for remark in world.remarks]
