"""Which models of a lens there are, and what their parameters are called."""

from enum import StrEnum
from typing import Final

from app.core.messages import sentence
from app.tracking.optics import distortion

LINEAR: Final = ("fx", "fy", "cx", "cy")
"""Parameters that every model has."""


class LensModel(StrEnum):
    """Model of a lens' distortion; named as ROS' camera_info names them (REP 118)."""

    BROWN = "plumb_bob"
    RATIONAL = "rational_polynomial"
    FISHEYE = "equidistant"

    @property
    def coefficients(self) -> tuple[str, ...]:
        """Names of its coefficients, in OpenCV's order."""
        return _COEFFICIENTS[self]

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of all parameters of a camera with it, in the order of its covariance."""
        return (*LINEAR, *self.coefficients)

    @property
    def words(self) -> str:
        """Return what it is, for people."""
        return _WORDS[self]


_COEFFICIENTS: Final = {
    LensModel.BROWN: ("k1", "k2", "p1", "p2", "k3"),
    LensModel.RATIONAL: (
        *("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"),
        *("s1", "s2", "s3", "s4"),
    ),
    LensModel.FISHEYE: ("k1", "k2", "k3", "k4"),
}

_WORDS: Final = {
    LensModel.BROWN: "five coefficients",
    LensModel.RATIONAL: "rational model with thin prism, twelve coefficients",
    LensModel.FISHEYE: "fisheye model, four coefficients",
}


def lens_of(count: int) -> LensModel:
    """Return the model with so many coefficients; see `distortion`.

    Raises:
        ValueError: if none has.
    """
    for lens, names in _COEFFICIENTS.items():
        if len(names) == count:
            return lens
    raise ValueError(
        sentence(
            "{count} coefficients: {distortion_brown}, {distortion_rational} (rational with thin "
            "prism) or {distortion_fisheye} (fisheye) are possible",
            count=count,
            distortion_brown=distortion.BROWN,
            distortion_rational=distortion.RATIONAL,
            distortion_fisheye=distortion.FISHEYE,
        )
    )
