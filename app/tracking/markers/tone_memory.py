"""What a camera's pictures have told of its tone curve."""

from dataclasses import dataclass
from typing import Final

SRGB: Final = 2.4
LINEAR: Final = 1.0
"""Tone curves that are tried, see `band.tone`: cameras', and none."""

_SURE, _MOST_SURE, _MOST_BY_ONE, _AGAIN = 60.0, 120.0, 40.0, 32
"""Logarithm of the likelihoods' ratio, summed over pictures, from which a camera's tone curve is
known; to which it is counted, and of one picture; and after how many pictures it is asked again."""


@dataclass(slots=True)
class ToneMemory:
    """Remembers what a camera's pictures have told of its tone curve.

    Attributes:
        evidence: log-likelihood of a linear curve over sRGB's, summed over pictures.
        age: pictures since the last that counted.
    """

    evidence: float = 0.0
    age: int = 0

    def known(self, gamma: float) -> bool:
        """Tell whether the curve is known to be this one, and need not be asked again yet."""
        sign = 1.0 if gamma == LINEAR else -1.0
        return sign * self.evidence >= _SURE and self.age < _AGAIN

    def learn(self, ratio: float) -> None:
        """Count a picture: log-likelihood of a linear curve over sRGB's."""
        ratio = min(_MOST_BY_ONE, max(-_MOST_BY_ONE, ratio))
        self.evidence = min(_MOST_SURE, max(-_MOST_SURE, self.evidence + ratio))
        self.age = 0

    @property
    def likely(self) -> tuple[float, ...]:
        """Tone curves that a picture may have, a camera's usual one first where none is known."""
        return next(((g,) for g in (SRGB, LINEAR) if self.known(g)), (SRGB, LINEAR))
