"""What only something known otherwise can tell: whether the board's squares were entered right.

A board with wrong squares leaves the residual as it is; cameras, baseline and everything measured
later are too large or too small by one factor. A baseline measured with a ruler, or pictures of a
second board (of known squares), give it away.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.calibration.boards import parse_board
from app.tracking.calibration.validation import ViewPair, validate
from app.tracking.optics.calibration import StereoCalibration

TOLERANCE = 0.03
"""Deviation of a length measured by hand that is no contradiction."""

BOARD_TOLERANCE = 0.01
"""Deviation of a second board's squares that is no contradiction."""


@dataclass(frozen=True)
class Check:
    """A length that is known, against what the calibration makes of it.

    Attributes:
        name: `baseline` or `second_board`.
        known_mm, measured_mm: the length.
        passed: whether they agree.
        text: one line for people.
    """

    name: str
    known_mm: float
    measured_mm: float
    passed: bool
    text: str

    @property
    def ratio(self) -> float:
        """Measured over known."""
        return self.measured_mm / self.known_mm


def check_baseline(calibration: StereoCalibration, known_mm: float) -> Check:
    """Compare the distance of the cameras with one measured by hand [mm]."""
    measured = calibration.baseline / MILLIMETRE
    return _check("baseline", "the cameras", calibration, known_mm, measured, TOLERANCE)


def check_second_board(calibration: StereoCalibration, pairs: Sequence[ViewPair]) -> Check:
    """Compare the squares of another board, triangulated, with what is known of them.

    Raises:
        CalibrationError: if the pairs share too few corners.
    """
    found = validate(calibration, pairs)
    known = pairs[0][0].board.square / MILLIMETRE
    measured = known * found.scale
    limit = BOARD_TOLERANCE + 3.0 * found.scale_sd
    return _check("second_board", "its corners", calibration, known, measured, limit)


def _check(
    name: str,
    what: str,
    calibration: StereoCalibration,
    known: float,
    measured: float,
    limit: float,
) -> Check:
    ratio = measured / known
    passed = abs(ratio - 1.0) <= limit
    text = sentence(
        "{points} are {measured:.4g} mm apart, {known:.4g} mm known ({ratio:+.1%})",
        points=what,
        measured=measured,
        known=known,
        ratio=ratio - 1.0,
    )
    if not passed and calibration.board:
        square = parse_board(calibration.board).square / MILLIMETRE
        text += sentence(
            ": more than {limit:.0%}; measure the board: squares of {fitting_mm:.4g} mm "
            "instead of {stated_mm:g} mm would explain it",
            limit=limit,
            fitting_mm=square / ratio,
            stated_mm=square,
        )
    return Check(name, known, measured, passed, text)
