"""What a registration check says: a sentence for students, figures for technicians."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.confidence import covariance_radius
from app.core.units import MILLIMETRE
from app.planning.registration.check import PointCheck, RegistrationAgreement, RegistrationCheck
from app.planning.registration.errors import RegistrationError

NOT_CHECKED = "screen and needle: not checked"

MEANING = (
    "FRE says how well the points fit each other. It is not the accuracy at the target, and a "
    "small FRE does not promise one.",
    "FLE is the error of touching one point, estimated from the FRE. TRE is the error to expect "
    "at the target: it grows with the distance from the fiducials.",
    "A shift that all touches share, a wrong tip length for instance, does not show in the FRE.",
)
"""What the technician's figures mean, one line each."""


def student_line(agreement: RegistrationAgreement | None) -> str:
    """Return the sentence for students; without a check it names no figure."""
    if agreement is None:
        return NOT_CHECKED
    return f"screen and needle agree within ± {_mm(agreement.radius, 1)} mm (95 %)"


def agreement_or_reason(
    check: RegistrationCheck, p_world: FloatArray
) -> RegistrationAgreement | str:
    """Return the agreement at a point of the world [m], shape (3,), or why there is none."""
    try:
        return check.agreement(p_world)
    except RegistrationError as error:
        return str(error)


def troubles(check: RegistrationCheck) -> tuple[str, ...]:
    """Say what is wrong with the points, one line each, and what to do; empty if nothing is."""
    parts = [("touched", check.world)]
    if check.patient is not None:
        parts.append(("picked", check.patient))
    return tuple(line for verb, part in parts for line in _troubles(verb, part))


def technician_lines(check: RegistrationCheck) -> tuple[str, ...]:
    """FRE, FLE and their meaning per part, one line each; TRE is said with a target."""
    lines = list(_figures("touches", check.world))
    if check.patient is not None:
        lines += _figures("picks in the CT", check.patient)
    return tuple(lines)


def target_line(check: RegistrationCheck, p_world: FloatArray) -> str:
    """Say the error to expect at a point of the world [m], shape (3,), for technicians."""
    radius = covariance_radius(check.spread(p_world))
    rms = float(np.sqrt(np.trace(check.expected(p_world))))
    return (
        f"TRE at the target: {_mm(rms)} mm RMS expected, at least 95 % within {_mm(radius)} mm "
        f"({check.world.condition})"
    )


def _figures(title: str, part: PointCheck) -> list[str]:
    error = part.fiducial
    return [
        f"{title}: {part.fit.count} fiducials, FRE {_mm(part.fit.fre)} mm (fit of the points, not "
        "accuracy)",
        f"{title}: FLE {_mm(error.rms)} mm, between {_mm(error.lower)} and {_mm(error.upper)} mm "
        f"with 95 % ({error.freedom} degrees of freedom)",
    ]


def _troubles(verb: str, part: PointCheck) -> list[str]:
    if part.reordering is not None:
        moved = [part.names[i] for i in part.reordering.moved]
        return [
            f"fiducials {' and '.join(moved)} were {verb} in another order: exchanged, they fit "
            f"within {_mm(part.reordering.fre)} mm; name them again"
        ]
    if part.scale.wrong:
        return [_scale_words(verb, part)]
    if part.outlier is not None:
        name = part.names[part.outlier.index]
        return [
            f"fiducial {name} lies {_mm(part.outlier.distance, 1)} mm from where the others put it "
            f"(they agree within {_mm(part.outlier.fre)} mm): do {name} again"
        ]
    worst = (part.fit.residuals**2).sum(axis=1)
    if not part.trusted:
        name = part.names[int(worst.argmax())]
        return [
            f"the {verb} points do not fit the plate: the largest residual is "
            f"{_mm(float(worst.max()) ** 0.5, 1)} mm at {name}, the limit is "
            f"{_mm(part.tolerance, 1)} mm; is it this plate? do all points again"
        ]
    if part.scattered:
        return [
            f"the {verb} points scatter more than careful work explains (FLE "
            f"{_mm(part.fiducial.rms)} mm); the figure below allows for it"
        ]
    return []


def _scale_words(verb: str, part: PointCheck) -> str:
    off = part.scale.value - 1.0
    what = (
        f"lengths between the {verb} points are {abs(off):.1%} too {'long' if off > 0 else 'short'}"
        f" (± {part.scale.sd:.1%})"
    )
    if verb == "picked":
        return f"{what}: the CT's spacing is wrong, or this is another plate"
    return (
        f"{what}: the cameras were calibrated with a board of another size than said. Measure its "
        "line of 100 mm and its squares, calibrate again; or this is another plate"
    )


def _mm(length: float, digits: int = 2) -> str:
    return f"{length / MILLIMETRE:.{digits}f}"
