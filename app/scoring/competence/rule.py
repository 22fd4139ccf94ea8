"""The rule by which a course calls somebody competent: two failure rates, two errors, defaults."""

from __future__ import annotations

from typing import Annotated, Final

from pydantic import Field, model_validator

from app.core.configuration import Strict
from app.core.messages import sentence

Share = Annotated[float, Field(gt=0.0, lt=1.0)]
Error = Annotated[float, Field(ge=0.001, le=0.5)]


class CompetenceRule(Strict):
    """When somebody is called competent at a skill, and with which errors.

    The default rates are this project's own. A failure rate of 10 % is what published curves of
    trainees call acceptable (ERCP: Wani et al. 2016, doi 10.1016/j.gie.2015.10.022). They call
    20 % unacceptable; two rates so near need more than a hundred attempts to be told apart
    (`acus study competence`), more than anybody makes at one exercise of a course. From 40 % on a
    student is called not competent here, which 24 attempts tell.

    Attributes:
        acceptable: failure rate of somebody who is competent, p0.
        unacceptable: failure rate from which on somebody is not, p1; more than `acceptable`.
        false_alarm: at most this share of students who fail at `unacceptable` is called competent
            within the planned attempts, alpha.
        missed: at most this share of those who fail at `acceptable` is not, beta.
        gap_days: so long a time between two attempts is a gap (see `following`).
    """

    acceptable: Share = 0.10
    unacceptable: Share = 0.40
    false_alarm: Error = 0.05
    missed: Error = 0.10
    gap_days: Annotated[float, Field(gt=0.0)] = 28.0

    @model_validator(mode="after")
    def _in_order(self) -> CompetenceRule:
        if self.unacceptable <= self.acceptable:
            raise ValueError(
                sentence(
                    "the unacceptable failure rate is {unacceptable:g}, the acceptable one "
                    "{acceptable:g}: it must be more",
                    unacceptable=self.unacceptable,
                    acceptable=self.acceptable,
                )
            )
        return self


RULE: Final = CompetenceRule()
"""Where a course states none."""
