"""Coefficients of lenses as other programs write them, in OpenCV's order.

OpenCV writes 4 (k1, k2, p1, p2), 5 (k3), 8 (k4, k5, k6), 12 (s1 to s4) or 14 (τx, τy of a tilted
sensor) numbers for a pinhole camera, and 4 (k1 to k4) for a fisheye one: nothing in its files tells
these from the first. ROS names the model (REP 118): plumb_bob, rational_polynomial, equidistant.
"""

from collections.abc import Sequence
from typing import Final

from app.core.messages import sentence
from app.tracking.errors import CalibrationError
from app.tracking.optics.lens import LensModel

COUNTS: Final = {
    LensModel.BROWN: (4, 5),
    LensModel.RATIONAL: (4, 5, 8, 12, 14),
    LensModel.FISHEYE: (4,),
}
"""How many numbers files give for a model; some drivers call five numbers rational."""

_PINHOLE: Final = (4, 5, 8, 12, 14)


def lens_coefficients(
    where: str, given: Sequence[float], lens: LensModel | None = None
) -> tuple[LensModel, tuple[float, ...]]:
    """Return the model and all of its coefficients.

    Args:
        where: file and field, for messages.
        given: finite numbers.
        lens: model that the file names; None if it names none: then 4 numbers are k1, k2, p1, p2.

    Raises:
        CalibrationError: for a number of coefficients that the model does not have, and a tilted
            sensor.
    """
    counts = _PINHOLE if lens is None else COUNTS[lens]
    if len(given) not in counts:
        named = "" if lens is None else f" of the model {lens.value}"
        valid = ", ".join(str(count) for count in counts)
        raise CalibrationError(
            sentence(
                "{where}: {valid} coefficients{named} are possible, got {coefficients}",
                where=where,
                valid=valid,
                named=named,
                coefficients=len(given),
            )
        )
    if lens is LensModel.FISHEYE:
        return lens, tuple(given)
    if any(given[12:]):
        raise CalibrationError(
            sentence(
                "{where}: a tilted sensor (τx, τy = {tilt_x:g}, {tilt_y:g}) is not supported: "
                "calibrate without CALIB_TILTED_MODEL, or the pictures with `acus calibrate "
                "stereo`",
                where=where,
                tilt_x=given[12],
                tilt_y=given[13],
            )
        )
    full = (*given, *(0.0,) * 12)[:12]
    if any(full[5:]) or (lens is LensModel.RATIONAL and len(given) > 5):
        return LensModel.RATIONAL, full
    return LensModel.BROWN, full[:5]
