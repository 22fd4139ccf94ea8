"""What raises the odds of a pneumothorax, and the case mix that the published odds are put into."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import isclose
from types import MappingProxyType
from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import ScoringError
from app.scoring.odds import (
    AGAIN_OR,
    BULLA_OR,
    DEEP_OR,
    EMPHYSEMA_OR,
    FISSURE_OR,
    FREE_OR,
    ON_BACK_OR,
    PNEUMOTHORAX_PERCENT,
    SMALL_OR,
    THICK_OR,
    UPWARDS_PRONE_OR,
    UPWARDS_SUPINE_OR,
)

SMALL_MM: Final = 40.0
"""Smaller lesions count as small (HUO)."""

THICK_GAUGE: Final = 18
"""Needles of this gauge and thicker count as thick (HUO)."""


class Lying(StrEnum):
    """How the biopsied lung lies."""

    DOWN = "down"
    """On the side, the biopsied lung below."""
    SUPINE = "supine"
    PRONE = "prone"
    UP = "up"
    """On the side, the biopsied lung above."""


@dataclass(frozen=True, slots=True)
class Factor:
    """Something that raises the odds.

    Attributes:
        name: for records.
        words: for people.
        odds_ratio: published: crude, of patients with it against those without.
        share: of the case mix that has it, 0 to 1: a teaching estimate.
    """

    name: str
    words: str
    odds_ratio: float
    share: float


FACTORS: Final = (
    Factor("emphysema", sentence("emphysema"), EMPHYSEMA_OR, 0.25),
    Factor("small", sentence("lesion smaller than 4 cm"), SMALL_OR, 0.75),
    Factor("free", sentence("lesion without contact to the pleura"), FREE_OR, 0.65),
    Factor("deep", sentence("3 cm of lung or more on the way"), DEEP_OR, 0.40),
    Factor("thick", sentence("needle of 18 G or thicker"), THICK_OR, 0.60),
    Factor("again", sentence("pleura punctured more than once"), AGAIN_OR, 0.20),
    Factor("fissure", sentence("fissure crossed"), FISSURE_OR, 0.08),
    Factor("bulla", sentence("bulla crossed"), BULLA_OR, 0.04),
)
"""Factors that are there or not."""

FACTOR_NAMES: Final = tuple(factor.name for factor in FACTORS)

LYING_SHARES: Final[Mapping[Lying, float]] = MappingProxyType(
    {Lying.DOWN: 0.10, Lying.SUPINE: 0.45, Lying.PRONE: 0.40, Lying.UP: 0.05}
)
"""Positions in the case mix: a teaching estimate."""

CONTRASTS: Final = (
    ((Lying.SUPINE, Lying.PRONE), (Lying.DOWN,), ON_BACK_OR),
    ((Lying.UP,), (Lying.SUPINE,), UPWARDS_SUPINE_OR),
    ((Lying.UP,), (Lying.PRONE,), UPWARDS_PRONE_OR),
)
"""Positions against positions, and the published odds ratio of the first against the second."""


@dataclass(frozen=True, slots=True)
class CaseMix:
    """The patients among whom the published odds hold; the factors are independent of each other.

    Attributes:
        shares: factor -> share of patients who have it, in the order of `FACTORS`.
        lying: position -> share of patients.
        incidence: share of patients with a pneumothorax.

    Raises:
        ScoringError: naming what is no share, or does not add up.
    """

    shares: tuple[float, ...] = tuple(factor.share for factor in FACTORS)
    lying: tuple[float, ...] = tuple(LYING_SHARES[one] for one in Lying)
    incidence: float = PNEUMOTHORAX_PERCENT / 100.0

    def __post_init__(self) -> None:
        if len(self.shares) != len(FACTORS) or len(self.lying) != len(Lying):
            raise ScoringError(
                sentence(
                    "a case mix has {factors} shares of factors and {positions} of positions",
                    factors=len(FACTORS),
                    positions=len(Lying),
                )
            )
        for number in (*self.shares, *self.lying, self.incidence):
            if not 0.0 < number < 1.0:
                raise ScoringError(
                    sentence("{share} is no share: it must lie between 0 and 1", share=number)
                )
        if not isclose(sum(self.lying), 1.0, abs_tol=1e-9):
            raise ScoringError(
                sentence(
                    "the shares of positions add up to {total:g}, not 1", total=sum(self.lying)
                )
            )


@dataclass(frozen=True, slots=True)
class Facts:
    """What is known of one attempt.

    Attributes:
        lying: how the biopsied lung lies; None if not known.
        known: factor -> whether it is there; a factor that is missing is not known, and counts as
            in the case mix.

    Raises:
        ScoringError: for a factor that there is not.
    """

    lying: Lying | None = None
    known: Mapping[str, bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        unknown = sorted(set(self.known) - set(FACTOR_NAMES))
        if unknown:
            raise ScoringError(
                sentence(
                    "{name!r} is no factor; there are {names}",
                    name=unknown[0],
                    names=", ".join(FACTOR_NAMES),
                )
            )
        object.__setattr__(self, "known", MappingProxyType(dict(self.known)))

    def document(self) -> dict[str, Any]:
        """Return it as JSON-ready values; what is not known is left out."""
        lying = {} if self.lying is None else {"lying": self.lying.value}
        return {**lying, **{name: self.known[name] for name in FACTOR_NAMES if name in self.known}}
