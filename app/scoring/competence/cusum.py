"""CUSUM tests of a series that passes or fails: what an attempt adds to the score.

Of an attempt x is 1 where it failed. At a failure rate p it has the likelihood p^x (1 - p)^(1 - x).
The test of a hypothesis against another one sums the logarithm of their likelihood ratio, never
below 0, and signals when the sum reaches a limit h (Page 1954, Biometrika 41:100):

    S_n = max(0, S_n-1 + log(likelihood of the alternative / likelihood of the null)),  S_0 = 0

- **Learning** (LC-CUSUM: Biau et al. 2008, doi 10.1002/bjs.6056; Biau and Porcher 2010,
  doi 10.1002/sim.3947). Null: *not competent*, p1. Alternative: *competent*, p0 < p1. A pass adds
  log((1 - p0)/(1 - p1)), a failure takes log(p1/p0) away; the signal says "competent". Whoever has
  shown nothing is not competent: that is where it differs from the CUSUM.
- **Watching** (CUSUM; Steiner et al. 2000, Biostatistics 1:441, without risk adjustment). Null:
  *still competent*, p0. Alternative: *not any more*, p1. Signs are turned: a failure adds
  log(p1/p0), a pass takes log((1 - p0)/(1 - p1)) away; the signal says "relapse".

Some print the score downwards, min(0, S - W), with the limit at -h: the same test.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log

from app.core.messages import sentence
from app.scoring.errors import ScoringError


class CompetenceError(ScoringError, ValueError):
    """Rates, errors or attempts for which no test can be made; says which would do."""


@dataclass(frozen=True, slots=True)
class CusumWeights:
    """What attempts do to a score.

    Attributes:
        gain: added by an attempt that speaks for the alternative, > 0.
        loss: taken away by one that speaks for the null, > 0.
        failing_gains: whether it is a failure that adds (watching), or a pass (learning).
    """

    gain: float
    loss: float
    failing_gains: bool

    def after(self, score: float, passed: bool) -> float:
        """Return the score after one more attempt."""
        if passed != self.failing_gains:
            return score + self.gain
        return max(0.0, score - self.loss)

    def chance(self, failure_rate: float) -> float:
        """Return the probability that an attempt adds, at a failure rate."""
        return failure_rate if self.failing_gains else 1.0 - failure_rate


def learning_weights(acceptable: float, unacceptable: float) -> CusumWeights:
    """Return the weights of the LC-CUSUM.

    Raises:
        CompetenceError: unless 0 < acceptable < unacceptable < 1.
    """
    passing, failing = _ratios(acceptable, unacceptable)
    return CusumWeights(passing, failing, failing_gains=False)


def watching_weights(acceptable: float, unacceptable: float) -> CusumWeights:
    """Return the weights of the CUSUM that watches for a relapse.

    Raises:
        CompetenceError: unless 0 < acceptable < unacceptable < 1.
    """
    passing, failing = _ratios(acceptable, unacceptable)
    return CusumWeights(failing, passing, failing_gains=True)


def _ratios(acceptable: float, unacceptable: float) -> tuple[float, float]:
    """Return what a pass and what a failure weigh."""
    if not 0.0 < acceptable < unacceptable < 1.0:
        raise CompetenceError(
            sentence(
                "failure rates {acceptable:g} (acceptable) and {unacceptable:g} (unacceptable): "
                "the first must be less than the second, both between 0 and 1",
                acceptable=acceptable,
                unacceptable=unacceptable,
            )
        )
    passing = log((1.0 - acceptable) / (1.0 - unacceptable))
    return passing, log(unacceptable / acceptable)
