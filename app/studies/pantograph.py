"""Study: the thesis' validation of the pantograph (figures 24 to 27), redone with numbers.

Forward and inverse kinematics close on each other everywhere but at one place; so does the complete
system. Beside each: the error of the formulas as the thesis prints them and as the laboratory's
public code has them. At the end: what joint torque the largest force at the hand needs by depth.
"""

from collections.abc import Callable
from functools import partial
from typing import Any, Final

from app.core.progress import Progress
from app.mechanisms.profile import load_profile
from app.studies.findings import Figure, Findings, Sheet, Survey
from app.studies.validation import numbers, pictures

DECLARATION: Final[dict[str, Any]] = {
    "title": "The pantograph's formulas: closure, and the errors of the printed ones",
    "question": "Are the formulas right, everywhere? How wrong are the printed ones?",
    "reference": "each map against its inverse, derivatives against differences; icube geometry",
}

_DEVICE: Final = "icube"


def _measure(progress: Progress | None) -> Findings:
    profile = load_profile(_DEVICE)
    geometry = profile.pantograph
    steps: tuple[tuple[str, Callable[[], Sheet]], ...] = (
        ("closure", lambda: numbers.closures(geometry)),
        ("singular place", lambda: numbers.singular_places(geometry)),
        ("printed formulas", lambda: numbers.printed_errors(geometry)),
        ("forces", lambda: numbers.forces(profile)),
        ("torques", lambda: numbers.torques(profile)),
    )
    sheets: list[Sheet] = []
    for number, (name, step) in enumerate(steps):
        if progress is not None:
            progress.report(number / len(steps), name)
        sheets.append(step())
    return Findings(
        tuple(sheets),
        (
            Figure("joints", partial(pictures.joints, geometry=geometry), (13.0, 4.6)),
            Figure("workspace", partial(pictures.workspace, geometry=geometry), (12.0, 7.5)),
            Figure("system", partial(pictures.system, geometry=geometry), (12.0, 4.0)),
            Figure("vectors", partial(pictures.vectors, geometry=geometry), (11.0, 5.2)),
            Figure(
                "torque",
                partial(pictures.torque, profile=profile, sheet=sheets[-1]),
                (10.0, 4.2),
            ),
        ),
        _lines(*sheets),
    )


def _lines(
    closure: Sheet, singular: Sheet, printed: Sheet, forces: Sheet, torques: Sheet
) -> tuple[str, ...]:
    tool = next(row for row in closure.rows if str(row[0]).startswith("all poses: P3"))
    skin = next(row for row in torques.rows if row[0] == 0.0)
    place = next(row for row in singular.rows if str(row[2]).startswith("above"))
    worst = max(printed.rows, key=lambda row: float(row[5]) if row[2] == "rad" else 0.0)
    return (
        f"Forward, inverse, forward over {tool[2]} poses: median {tool[4]:.2g} m, "
        f"worst {tool[5]:.2g} m.",
        f"Forward kinematics fails at one place above the motors: q1 = {place[0]:.3f}°, "
        f"q2 = {place[1]:.3f}° (and at its mirror image); neither lies in the 45° cone.",
        f"The largest error of a printed or coded formula: {worst[0]}, {worst[5]:.3g} rad.",
        f"2 N wanted at 45°: the printed law 4.12 gives {forces.rows[-1][3]:.3f} N.",
        f"5 N at the skin need {skin[1]:.3f} N·m upright, {skin[3]:.3f} N·m over the cone; the "
        f"profile's torque gives {skin[4]:.2f} N there in the worst direction.",
    )


STUDY: Final = Survey(
    measure=_measure,
)
