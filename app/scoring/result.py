"""The score as a value: it can be stored, read back and computed again."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import hypot
from typing import Any

from pydantic import ValidationError

from app.core.messages import sentence
from app.scoring.errors import ScoreFormatError, UnknownMetricError
from app.scoring.met import Met, fails
from app.scoring.rows import REACHING, Row, ScoreRules, gated, gates
from app.scoring.tolerance import Tolerance
from app.scoring.version import GATED, SCORING_VERSION

FORMAT = "acus-score/1"
"""Name and version of the stored form."""

TRACKING = "tracking_valid"
"""Metric that decides whether a score is void."""


@dataclass(frozen=True, slots=True)
class Score:
    """Result of an attempt.

    Attributes:
        rows: every metric: first the ones that count, in the exercise's order, then the others.
        total: 0 ... 100; None if the score is void.
        passed: total at or above the pass mark, no required metric beyond its pass limit, and
            nothing met that the rules forbid.
        void_reason: why there is no score; empty if there is one.
        rules: what it was judged by.
        attempt_void: the part of `void_reason` that comes from the course of the attempt.
        version: `SCORING_VERSION` of the program that made it.
        met: what the needle met; None where nothing could tell.
    """

    rows: tuple[Row, ...]
    total: float | None
    passed: bool
    void_reason: str
    rules: ScoreRules
    attempt_void: str = ""
    version: int = SCORING_VERSION
    met: tuple[Met, ...] | None = None

    @property
    def total_sd(self) -> float | None:
        """Standard deviation of `total`, of those of the rows, as if they were independent.

        Each row is moved by its deviation to both sides, and what it holds back of the others with
        it.
        """
        weight = sum(row.weight for row in self.rows)
        if self.total is None or weight <= 0.0:
            return None
        utilities = {row.name: row.utility for row in self.rows if row.utility is not None}
        parts = []
        for row in self.rows:
            ends = row.utility_ends
            if ends is not None:
                lower, upper = (self._points({**utilities, row.name: end}) for end in ends)
                parts.append(0.5 * (upper - lower))
        return 100.0 * hypot(*parts) / weight

    def _points(self, utilities: Mapping[str, float]) -> float:
        """Return the weighted sum of utilities, each as far as it counts."""
        shares = gates(self.rows, utilities) if self.version >= GATED else {}
        return sum(
            row.weight * shares.get(row.name, 1.0) * utilities.get(row.name, 0.0)
            for row in self.rows
        )

    @property
    def is_near_mark(self) -> bool:
        """Return whether the total lies within the error of measurement of the pass mark."""
        return self.rules.is_near_mark(self.total)

    @property
    def unseen(self) -> bool:
        """Return whether it is void for want of pictures, not for what the hand did."""
        return bool(self.void_reason) and (not self.attempt_void or "cameras" in self.attempt_void)

    @property
    def failures(self) -> tuple[Row, ...]:
        """Required metrics beyond their pass limit."""
        return tuple(row for row in self.rows if row.failed)

    @property
    def hard_fails(self) -> tuple[str, ...]:
        """Say what the needle met though the rules forbid it: "rib touched at 12.0 mm"."""
        return fails(self.met or (), self.rules.forbidden)

    @property
    def losses(self) -> tuple[tuple[float, Row], ...]:
        """Points of 100 that each row lost, one at least, the most first; none if void.

        What others lost because the target was missed, the row lost that says so.
        """
        weight = sum(row.weight for row in self.rows)
        if self.total is None or weight <= 0.0:
            return ()
        judged = [row for row in self.rows if row.utility is not None and row.weight > 0.0]
        lost = {row.name: row.weight * (1.0 - row.counted) for row in judged}
        reach = [row for row in judged if row.name in REACHING]
        if reach:
            worst = min(reach, key=lambda row: row.utility or 0.0)
            for row in judged:
                held = row.weight * ((row.utility or 0.0) - row.counted)
                lost[row.name] -= held
                lost[worst.name] += held
        found = [(100.0 * lost[row.name] / weight, row) for row in judged]
        return tuple(sorted((one for one in found if one[0] >= 1.0), key=lambda one: -one[0]))

    def row(self, name: str) -> Row:
        """Return one row by the name of its metric.

        Raises:
            UnknownMetricError: listing the rows that there are.
        """
        for row in self.rows:
            if row.name == name:
                return row
        names = ", ".join(row.name for row in self.rows)
        raise UnknownMetricError(
            sentence("the score has no row {name!r}; it has {names}", name=name, names=names)
        )

    def recomputed(
        self, tolerances: Mapping[str, Tolerance] | None = None, rules: ScoreRules | None = None
    ) -> Score:
        """Judge the stored values again, with the stored or with other tolerances and rules."""
        rows = self.rows
        if tolerances is not None:
            rows = tuple(replace(row, tolerance=tolerances.get(row.name)) for row in rows)
        return judge(rows, rules or self.rules, self.attempt_void, self.met, self.version)

    def document(self) -> dict[str, Any]:
        """Return the score with all its parameters as JSON-ready values; never NaN."""
        return {
            "format": FORMAT,
            "scoring_version": self.version,
            "total": self.total,
            "total_sd": self.total_sd,
            "passed": self.passed,
            "void_reason": self.void_reason,
            "attempt_void": self.attempt_void,
            "rules": self.rules.model_dump(exclude_none=True),
            "rows": [row.document() for row in self.rows],
            "tissues_met": None if self.met is None else [met.document() for met in self.met],
            "hard_fails": list(self.hard_fails),
        }

    def to_json(self, indent: int | None = None) -> str:
        """Write `document` as JSON."""
        return json.dumps(self.document(), indent=indent, allow_nan=False, ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> Score:
        """Read a stored score back.

        Raises:
            ScoreFormatError: if it is no score, or of another format; says what is wrong.
        """
        try:
            document = json.loads(text, parse_constant=_refuse)
            if document["format"] != FORMAT:
                raise ScoreFormatError(
                    sentence(
                        "format {format!r}; only {known_format} is known",
                        format=document["format"],
                        known_format=FORMAT,
                    )
                )
            return cls(
                rows=tuple(Row.of(row) for row in document["rows"]),
                total=document["total"],
                passed=document["passed"],
                void_reason=document["void_reason"],
                rules=ScoreRules.model_validate(document["rules"]),
                attempt_void=document["attempt_void"],
                version=int(document["scoring_version"]),
                met=_met(document.get("tissues_met")),
            )
        except (KeyError, TypeError, AttributeError, ValueError, ValidationError) as error:
            reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
            raise ScoreFormatError(
                sentence("not a stored score ({reason})", reason=reason)
            ) from error


def judge(
    rows: tuple[Row, ...],
    rules: ScoreRules,
    attempt_void: str = "",
    met: tuple[Met, ...] | None = None,
    version: int = SCORING_VERSION,
) -> Score:
    """Make a score of rows whose values are known: the weighted mean of the utilities times 100.

    Each utility counts as far as the target was reached (`rows.gated`), from version `GATED` on.
    """
    if version >= GATED:
        rows = gated(rows)
    void = attempt_void or _rows_void(rows, rules)
    weight = sum(row.weight for row in rows)
    if not void and weight <= 0.0:
        void = "no metric with a weight could be computed"
    if void:
        return Score(rows, None, False, void, rules, attempt_void, version, met)
    total = 100.0 * sum(row.weight * row.counted for row in rows) / weight
    passed = total >= rules.pass_mark and not any(row.failed for row in rows)
    passed = passed and not fails(met or (), rules.forbidden)
    return Score(rows, total, passed, "", rules, attempt_void, version, met)


def _rows_void(rows: tuple[Row, ...], rules: ScoreRules) -> str:
    for row in rows:
        if row.name == TRACKING and row.value is not None and row.value < rules.minimum_tracking:
            return sentence(
                "the tip was tracked for {row:.0f} % of the insertion; "
                "{rules_minimum_tracking:g} % are needed",
                row=row.value,
                rules_minimum_tracking=rules.minimum_tracking,
            )
    for row in rows:
        if row.tolerance and row.tolerance.required and row.value is None:
            return sentence(
                "{row_label} is required and cannot be computed: {row_note}",
                row_label=row.label.lower(),
                row_note=row.note,
            )
    return ""


def _met(documents: list[dict[str, Any]] | None) -> tuple[Met, ...] | None:
    return None if documents is None else tuple(map(Met.of, documents))


def _refuse(constant: str) -> float:
    raise ScoreFormatError(sentence("it holds {constant}", constant=constant))
