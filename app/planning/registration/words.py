"""What a registration check says: a sentence for students, figures for technicians."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.confidence import covariance_radius
from app.core.messages import listed, sentence, sentence_of
from app.core.units import MILLIMETRE
from app.planning.registration.check import PointCheck, RegistrationAgreement, RegistrationCheck
from app.planning.registration.errors import RegistrationError

NOT_CHECKED = sentence("screen and needle: not checked")

MEANING = (
    sentence(
        "FRE says how well the points fit each other. It is not the accuracy at the target, and a "
        "small FRE does not promise one."
    ),
    sentence(
        "FLE is the error of touching one point, estimated from the FRE. TRE is the error to "
        "expect at the target: it grows with the distance from the fiducials."
    ),
    sentence(
        "A shift that all touches share, a wrong tip length for instance, does not show in the FRE."
    ),
)
"""What the technician's figures mean, one line each."""


def student_line(agreement: RegistrationAgreement | None) -> str:
    """Return the sentence for students; without a check it names no figure."""
    if agreement is None:
        return NOT_CHECKED
    return sentence("screen and needle agree within ± {mm} mm (95 %)", mm=_mm(agreement.radius, 1))


def agreement_or_reason(
    check: RegistrationCheck, p_world: FloatArray
) -> RegistrationAgreement | str:
    """Return the agreement at a point of the world [m], shape (3,), or why there is none."""
    try:
        return check.agreement(p_world)
    except RegistrationError as error:
        return sentence_of(error)


def troubles(check: RegistrationCheck) -> tuple[str, ...]:
    """Say what is wrong with the points, one line each, and what to do; empty if nothing is."""
    lines = _troubles(sentence("touched"), check.world)
    if check.patient is not None:
        lines += _troubles(sentence("picked"), check.patient, of_ct=True)
    return tuple(lines)


def technician_lines(check: RegistrationCheck) -> tuple[str, ...]:
    """FRE, FLE and their meaning per part, one line each; TRE is said with a target."""
    lines = list(_figures(sentence("touches"), check.world))
    if check.patient is not None:
        lines += _figures(sentence("picks in the CT"), check.patient)
    return tuple(lines)


def target_line(check: RegistrationCheck, p_world: FloatArray) -> str:
    """Say the error to expect at a point of the world [m], shape (3,), for technicians."""
    radius = covariance_radius(check.spread(p_world))
    rms = float(np.sqrt(np.trace(check.expected(p_world))))
    return sentence(
        "TRE at the target: {expected_mm} mm RMS expected, at least 95 % within {within_95_mm} mm "
        "({check_world_condition})",
        expected_mm=_mm(rms),
        within_95_mm=_mm(radius),
        check_world_condition=check.world.condition,
    )


def _figures(title: str, part: PointCheck) -> list[str]:
    error = part.fiducial
    return [
        sentence(
            "{title}: {fiducials} fiducials, FRE {fre_mm} mm (fit of the points, not accuracy)",
            title=title,
            fiducials=part.fit.count,
            fre_mm=_mm(part.fit.fre),
        ),
        sentence(
            "{title}: FLE {fle_mm} mm, between {lower_mm} and {upper_mm} mm "
            "with 95 % ({error_freedom} degrees of freedom)",
            title=title,
            fle_mm=_mm(error.rms),
            lower_mm=_mm(error.lower),
            upper_mm=_mm(error.upper),
            error_freedom=error.freedom,
        ),
    ]


def _troubles(verb: str, part: PointCheck, of_ct: bool = False) -> list[str]:
    if part.reordering is not None:
        moved = [part.names[i] for i in part.reordering.moved]
        return [
            sentence(
                "fiducials {moved} were {verb} in another order: exchanged, they fit "
                "within {mm} mm; name them again",
                moved=listed(moved),
                verb=verb,
                mm=_mm(part.reordering.fre),
            )
        ]
    if part.scale.wrong:
        return [_scale_words(verb, part, of_ct)]
    if part.outlier is not None:
        name = part.names[part.outlier.index]
        return [
            sentence(
                "fiducial {name} lies {distance_mm} mm from where the others put it "
                "(they agree within {agreement_mm} mm): do {name} again",
                name=name,
                distance_mm=_mm(part.outlier.distance, 1),
                agreement_mm=_mm(part.outlier.fre),
            )
        ]
    worst = (part.fit.residuals**2).sum(axis=1)
    if not part.trusted:
        name = part.names[int(worst.argmax())]
        return [
            sentence(
                "the {verb} points do not fit the plate: the largest residual is "
                "{residual_mm} mm at {name}, the limit is "
                "{limit_mm} mm; is it this plate? do all points again",
                verb=verb,
                residual_mm=_mm(float(worst.max()) ** 0.5, 1),
                name=name,
                limit_mm=_mm(part.tolerance, 1),
            )
        ]
    if part.scattered:
        return [
            sentence(
                "the {verb} points scatter more than careful work explains (FLE "
                "{mm} mm); the figure below allows for it",
                verb=verb,
                mm=_mm(part.fiducial.rms),
            )
        ]
    return []


def _scale_words(verb: str, part: PointCheck, of_ct: bool) -> str:
    off = part.scale.value - 1.0
    what = sentence(
        "lengths between the {verb} points are {off:.1%} too {direction} (± {part_scale_sd:.1%})",
        verb=verb,
        off=abs(off),
        direction=sentence("long") if off > 0 else sentence("short"),
        part_scale_sd=part.scale.sd,
    )
    if of_ct:
        return sentence(
            "{finding}: the CT's spacing is wrong, or this is another plate", finding=what
        )
    return sentence(
        "{finding}: the cameras were calibrated with a board of another size than said. Measure "
        "its line of 100 mm and its squares, calibrate again; or this is another plate",
        finding=what,
    )


def _mm(length: float, digits: int = 2) -> str:
    form = sentence("{mm:.1f}", mm=length / MILLIMETRE)
    return form if digits == 1 else sentence("{mm:.2f}", mm=length / MILLIMETRE)
