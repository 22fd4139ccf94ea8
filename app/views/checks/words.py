"""How well screen and needle agree, for the status strip. Pure."""

from __future__ import annotations

from app.core.units import MILLIMETRE
from app.planning.registration.check import Agreement
from app.views.exercise.status_items import StatusItem, Verdict
from app.views.kit.text import tr

GOOD_MM = 2.0
"""Up to this radius [mm] the agreement counts as good; a lesion of 10 mm is then hit."""


def agreement_item(
    agreement: Agreement | None, reason: str = "", checked: str = "", known: bool = True
) -> StatusItem:
    """Return the line of the status strip.

    Args:
        agreement: at the target; None where nobody checked.
        reason: why there is none, although somebody did.
        checked: when and with what it was checked, for the help.
        known: whether the cameras' calibration says how sure it is.
    """
    title = tr("Screen and needle")
    if agreement is None:
        text = tr("check failed") if reason else tr("not checked")
        verdict = Verdict.WARNING if reason else Verdict.IDLE
        help_ = reason or tr(
            "Nobody has checked how well the needle on the screen agrees with the real one. "
            "Menu Checks, Registration check: touch the fiducials of a plate."
        )
        return StatusItem(verdict, title, text, help_)
    radius = agreement.radius / MILLIMETRE
    text = tr("agree within ± {mm:.1f} mm (95 %)", mm=radius)
    help_ = tr(
        "How far the needle on the screen may be from the real one at the target: what the "
        "registration check found, with the cameras' error. {checked}", checked=checked,
    )  # fmt: skip
    if not known:
        text = tr("{size}; the calibration's own uncertainty is not known", size=text)
        help_ += " " + tr(
            "The calibration was imported and does not say how sure it is: the radius leaves its "
            "error out. Calibrate with pictures of a board to know it."
        )
    good = radius <= GOOD_MM and known
    return StatusItem(Verdict.GOOD if good else Verdict.WARNING, title, text, help_)
