"""Rows of a score: one metric of an attempt each, and the rules that hold for all of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Annotated, Any, Final

from pydantic import Field, field_validator, model_validator

from app.core.configuration import FieldText, Strict
from app.core.messages import sentence
from app.scoring.met import FORBIDDABLE
from app.scoring.pass_mark import SetMark
from app.scoring.tolerance import PASS_UTILITY, Band, Tolerance, band, best_within, tolerance

_KEPT_AT_ZERO = frozenset({"risk_breach"})
"""Metrics that are 0 wherever a limit was kept, however far off it: what is not known of the needle
then says nothing about them, and stands beside the distance itself."""

REACHING: Final = frozenset(
    {"depth_error", "lateral_error", "planned_target_error", "target_error", "targets_touched"}
)
"""Metrics that say whether the needle came to its target: all others count only where it did."""


def shown_sd(name: str, value: float | None, sd: float | None) -> float | None:
    """Return the deviation to show beside a metric's value; None where it would say nothing true.

    Args:
        name: of the metric.
        value: what the attempt reached, in its unit; None without one.
        sd: its standard deviation; None if not known.
    """
    at_zero = name in _KEPT_AT_ZERO and value == 0.0
    return None if value is None or at_zero else sd


class ScoreRules(Strict):
    """What holds for the score as a whole.

    Attributes:
        pass_mark: total needed to pass, 0 ... 100.
        minimum_tracking: least share of the insertion with a measured depth [%]; below it the
            score is void.
        maximum_pause: longest time [s], over all pauses, that an attempt may wait for the cameras;
            beyond it the score is void.
        forbidden: kinds of tissue that fail the attempt if the needle meets them, unless the target
            lies in them: `bone`, `vessel` (2 mm radius and more), `gut`, `heart`, `lung` and the
            like; empty where what was met is information.
        mark: how people set the pass mark; none where who wrote the exercise did.
    """

    pass_mark: Annotated[float, Field(ge=0.0, le=100.0), FieldText("Total needed to pass")] = 60.0
    minimum_tracking: Annotated[
        float,
        Field(ge=0.0, le=100.0),
        FieldText("Void below this share of the insertion with a measured depth", unit="%"),
    ] = 70.0
    maximum_pause: Annotated[
        float,
        Field(ge=0.0),
        FieldText("Void beyond this time of waiting for the cameras", unit="s"),
    ] = 20.0
    forbidden: tuple[str, ...] = ()
    mark: SetMark | None = None

    @model_validator(mode="after")
    def _mark_is_the_pass_mark(self) -> ScoreRules:
        if self.mark is not None and self.mark.points != self.pass_mark:
            raise ValueError(
                sentence(
                    "mark: people set {points:g} and pass_mark is {pass_mark:g}: leave mark out, "
                    "or set both again by `acus exercise mark`",
                    points=self.mark.points,
                    pass_mark=self.pass_mark,
                )
            )
        return self

    def is_near_mark(self, total: float | None) -> bool:
        """Return whether a total lies within the error of measurement of the pass mark."""
        error = None if self.mark is None else self.mark.score_error
        return total is not None and error is not None and abs(total - self.pass_mark) <= error

    @field_validator("forbidden")
    @classmethod
    def _known_kinds(cls, kinds: tuple[str, ...]) -> tuple[str, ...]:
        unknown = [kind for kind in kinds if kind not in FORBIDDABLE]
        if unknown:
            raise ValueError(
                sentence(
                    "no tissue is called {unknown_name!r}; there are {forbiddable}",
                    unknown_name=unknown[0],
                    forbiddable=", ".join(FORBIDDABLE),
                )
            )
        if len(set(kinds)) < len(kinds):
            raise ValueError(sentence("a kind of tissue is forbidden twice"))
        return kinds


@dataclass(frozen=True, slots=True)
class Row:
    """One metric of an attempt.

    Attributes:
        name: of the metric.
        label: for display.
        unit: of the value.
        value: what the attempt reached; None if it could not be computed.
        note: why there is no value; empty otherwise.
        tolerance: bands, weight and whether it is required; None if it is only shown.
        sd: standard deviation of the value, in its unit; 0 for what is counted, None if not known.
        gate: share of the utility that counts, 0 ... 1: less than 1 where the target was missed.
    """

    name: str
    label: str
    unit: str
    value: float | None
    note: str = ""
    tolerance: Tolerance | None = None
    sd: float | None = None
    gate: float = 1.0

    @property
    def counted(self) -> float:
        """Return the utility that counts, 0 ... 1; 0 without one."""
        return self.gate * (self.utility or 0.0)

    @property
    def utility(self) -> float | None:
        """Return how good the best value within `sd` is, 0 ... 1; None without value or
        tolerance.
        """
        if self.value is None or self.tolerance is None:
            return None
        return tolerance(best_within(self.value, self.sd, self.tolerance), self.tolerance)

    @property
    def utility_ends(self) -> tuple[float, float] | None:
        """Return the utilities one `sd` to both sides; None where nothing is known of it."""
        if self.value is None or self.tolerance is None or not self.sd:
            return None
        size = best_within(self.value, self.sd, self.tolerance)
        lower, upper = (tolerance(max(0.0, size + d), self.tolerance) for d in (-self.sd, self.sd))
        return lower, upper

    @property
    def band(self) -> Band | None:
        """Band of the value; None if there is no value or no tolerance."""
        if self.value is None or self.tolerance is None:
            return None
        return band(best_within(self.value, self.sd, self.tolerance), self.tolerance)

    @property
    def weight(self) -> float:
        """Weight in the total; 0 if it is only shown or could not be computed."""
        return self.tolerance.weight if self.tolerance and self.value is not None else 0.0

    @property
    def failed(self) -> bool:
        """Return whether a required value lies beyond its pass limit."""
        return bool(self.tolerance and self.tolerance.required and self.band is Band.FAIL)

    def document(self) -> dict[str, Any]:
        """Return the row as JSON-ready values; utility and band are there for readers only."""
        limits = self.tolerance.model_dump(by_alias=True) if self.tolerance else None
        gated = {"gate": self.gate} if self.gate < 1.0 else {}
        return {
            "name": self.name,
            "label": self.label,
            "unit": self.unit,
            "value": self.value if self.value is not None and isfinite(self.value) else None,
            "sd": self.sd if self.sd is not None and isfinite(self.sd) else None,
            "note": self.note,
            "tolerance": limits,
            "utility": self.utility,
            "band": self.band,
            **gated,
        }

    @classmethod
    def of(cls, document: dict[str, Any]) -> Row:
        """Read what `document` wrote."""
        limits, value, sd = document["tolerance"], document["value"], document.get("sd")
        return cls(
            name=document["name"],
            label=document["label"],
            unit=document["unit"],
            value=None if value is None else float(value),
            note=document["note"],
            tolerance=None if limits is None else Tolerance.model_validate(limits),
            sd=None if sd is None else float(sd),
            gate=float(document.get("gate", 1.0)),
        )


def gates(rows: Sequence[Row], utilities: Mapping[str, float]) -> dict[str, float]:
    """Return by name how far each row counts: as far as the needle came to its target.

    A way that is short, quick, straight and gentle earns nothing by ending elsewhere. The share is
    that of the worst of the other rows that say where the needle ended: 1 up to its pass limit,
    falling to 0 at its `zero`, so that no total jumps; 0 where it could not be measured. Rows that
    neither count nor are required hold nothing back.

    Args:
        rows: of one attempt.
        utilities: of those that have one, by name.
    """
    reach = {
        row.name: min(1.0, utilities.get(row.name, 0.0) / PASS_UTILITY)
        for row in rows
        if row.name in REACHING
        and row.tolerance
        and (row.tolerance.weight or row.tolerance.required)
    }
    return {
        row.name: min((share for name, share in reach.items() if name != row.name), default=1.0)
        for row in rows
    }


def gated(rows: Sequence[Row]) -> tuple[Row, ...]:
    """Return rows that count as far as `gates` says."""
    shares = gates(rows, {row.name: row.utility for row in rows if row.utility is not None})
    return tuple(replace(row, gate=shares[row.name]) for row in rows)
