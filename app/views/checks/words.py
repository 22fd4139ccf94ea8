"""How well screen and needle agree, for the status strip. Pure."""

from __future__ import annotations

from app.core.units import MILLIMETRE
from app.planning.registration.check import Agreement
from app.views.exercise.status_items import StatusItem, Verdict
from app.views.text import tr

GOOD_MM = 2.0
"""Up to this radius [mm] the agreement counts as good; a lesion of 10 mm is then hit."""


def agreement_item(agreement: Agreement | None, reason: str = "", checked: str = "") -> StatusItem:
    """Return the line of the status strip.

    Args:
        agreement: at the target; None where nobody checked.
        reason: why there is none, although somebody did.
        checked: when and with what it was checked, for the help.
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
    return StatusItem(
        Verdict.GOOD if radius <= GOOD_MM else Verdict.WARNING, title,
        tr("agree within ± {mm:.1f} mm (95 %)", mm=radius),
        tr("How far the needle on the screen may be from the real one at the target: what the "
           "registration check found, with the cameras' error. {checked}", checked=checked),
    )  # fmt: skip
