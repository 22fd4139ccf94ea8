"""What the needle met in the patient: tissue after tissue, and what of it an exercise forbids.

Told from the path that the tip really took, bent and redirected, not from the plan. Tissue that
nobody labelled is none: it is neither safe nor failed.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import asdict, dataclass, fields
from math import isfinite
from typing import Any, Final

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.imaging.field.tissue_words import tissue_words
from app.planning.tissues import SMALL_VESSELS
from app.scoring.errors import TrajectoryError

FORBIDDEN: Final = ("bone", "vessel", "gut", "heart", "lung")
"""What a new exercise forbids; the lung, as all of them, is allowed where the target lies in it."""

FORBIDDABLE: Final = tuple(
    kind.value for kind in TissueKind if kind not in (TissueKind.UNKNOWN, TissueKind.AIR)
)

LEAST_MM: Final = 0.5
"""Soft tissue that the tip was in for less than this was grazed: told, and no fail."""

LEAST_CONFIDENCE: Final = 0.5
"""A label less sure than this fails nobody."""

LEAST_N: Final = 0.05
"""A smaller force along the needle is none that is told in words [N]."""

BY_TIP, BY_SHAFT = "tip", "shaft"


@dataclass(frozen=True, slots=True)
class Met:
    """One stretch of one tissue that the needle went through, once.

    Attributes:
        kind: of the tissue, one of `TissueKind`.
        name: of it, "rib", "liver"; empty where it has none.
        entered_mm: depth of the tip where it began, from the entry.
        length_mm: of the way in it; 0 where it was touched alone.
        points: where it began and ended, LPS [mm].
        sd_mm: standard deviation of `entered_mm`, from what the cameras left unsure of the tip and
            how flatly the boundary was met; None if not known.
        angle_deg: between the way and the boundary's normal, 0 straight in.
        time: monotonic time at which it began [s].
        confidence: of the label, 0 to 1.
        holds_target: whether the target lies in it.
        before, after: kind of tissue on either side on the way; empty where the way began or ended.
        by: `tip`, or `shaft` for what the shaft alone was pushed into.
        force_n: largest force along the needle while the tip was in it, or stood on it [N]; None
            where no hand felt one, or nothing of it was kept.

    Raises:
        TrajectoryError: if a number is not finite, or the kind is none.
    """

    kind: str
    name: str
    entered_mm: float
    length_mm: float
    points: tuple[tuple[float, float, float], tuple[float, float, float]]
    sd_mm: float | None = None
    angle_deg: float = 0.0
    time: float = 0.0
    confidence: float = 1.0
    holds_target: bool = False
    before: str = ""
    after: str = ""
    by: str = BY_TIP
    force_n: float | None = None

    def __post_init__(self) -> None:
        unsure = (self.sd_mm or 0.0, self.force_n or 0.0)
        numbers = (self.entered_mm, self.length_mm, self.angle_deg, self.time, *unsure)
        places = (value for point in self.points for value in point)
        if not all(map(isfinite, (*numbers, self.confidence, *places))) or self.length_mm < 0.0:
            raise TrajectoryError(
                sentence(
                    "{tissue} at {entered_mm} mm: a number is not finite",
                    tissue=self.words,
                    entered_mm=self.entered_mm,
                )
            )
        if self.kind not in set(TissueKind):
            raise TrajectoryError(sentence("{kind!r} is no kind of tissue", kind=self.kind))

    @property
    def words(self) -> str:
        """Return what was met, for people: the name, else the kind."""
        return tissue_words(self.name or self.kind)

    @property
    def is_bone(self) -> bool:
        """Return whether it is bone, which is touched, not entered."""
        return self.kind == TissueKind.BONE

    @property
    def counts(self) -> bool:
        """Return whether it is sure and long enough to be counted: bone always, if it is sure."""
        sure = self.confidence >= LEAST_CONFIDENCE
        return sure and (self.is_bone or self.length_mm >= LEAST_MM)

    def is_forbidden(self, kinds: Collection[str]) -> bool:
        """Return whether it fails an attempt where some kinds of tissue are forbidden."""
        small = self.kind == TissueKind.VESSEL and self.name in SMALL_VESSELS
        return self.counts and self.kind in kinds and not self.holds_target and not small

    @property
    def sentence(self) -> str:
        """Say it in one line: "rib touched at 12.0 mm, 8.4 N"."""
        text = self._bone_sentence() if self.is_bone else self._soft_sentence()
        if self.force_n is None or self.force_n < LEAST_N:
            return text
        return sentence("{met}, {force:.1f} N", met=text, force=self.force_n)

    def _depth(self) -> str:
        if self.sd_mm is not None and self.sd_mm >= 0.05:
            return sentence("{depth:.1f} ± {sd:.1f} mm", depth=self.entered_mm, sd=self.sd_mm)
        return sentence("{depth:.1f} mm", depth=self.entered_mm)

    def _bone_sentence(self) -> str:
        bone, depth, crossed_mm = self.words, self._depth(), self.length_mm
        if self.by == BY_SHAFT and crossed_mm >= 1.0:
            return sentence(
                "{bone} touched by the shaft at {depth}, {crossed_mm:.1f} mm crossed",
                bone=bone,
                depth=depth,
                crossed_mm=crossed_mm,
            )
        if self.by == BY_SHAFT:
            return sentence("{bone} touched by the shaft at {depth}", bone=bone, depth=depth)
        if crossed_mm >= 1.0:
            return sentence(
                "{bone} touched at {depth}, {crossed_mm:.1f} mm crossed",
                bone=bone,
                depth=depth,
                crossed_mm=crossed_mm,
            )
        return sentence("{bone} touched at {depth}", bone=bone, depth=depth)

    def _soft_sentence(self) -> str:
        tissue, depth, length_mm = self.words, self._depth(), self.length_mm
        if self.by == BY_SHAFT and length_mm < LEAST_MM:
            return sentence("{tissue} by the shaft at {depth}: grazed", tissue=tissue, depth=depth)
        if self.by == BY_SHAFT:
            return sentence(
                "{tissue} by the shaft at {depth}: {length_mm:.1f} mm",
                tissue=tissue,
                depth=depth,
                length_mm=length_mm,
            )
        if length_mm < LEAST_MM:
            return sentence("{tissue} at {depth}: grazed", tissue=tissue, depth=depth)
        return sentence(
            "{tissue} at {depth}: {length_mm:.1f} mm",
            tissue=tissue,
            depth=depth,
            length_mm=length_mm,
        )

    def document(self) -> dict[str, Any]:
        """Return it as JSON-ready values."""
        return asdict(self) | {"points": [list(point) for point in self.points]}

    @classmethod
    def of(cls, document: dict[str, Any]) -> Met:
        """Read what `document` wrote; what is not known is left out.

        Raises:
            TrajectoryError, LookupError, TypeError, ValueError: if it is no such document.
        """
        known = {one.name: document[one.name] for one in fields(cls) if one.name in document}
        (a, b, c), (d, e, f) = ((float(v) for v in point) for point in known["points"])
        optional = {name: known.get(name) for name in ("sd_mm", "force_n")}
        numbers = ("entered_mm", "length_mm", "angle_deg", "time", "confidence")
        known |= {name: float(known[name]) for name in numbers if name in known}
        known |= {name: str(known[name]) for name in ("kind", "name", "before", "after", "by")}
        return cls(
            **known
            | {"points": ((a, b, c), (d, e, f))}
            | {name: None if value is None else float(value) for name, value in optional.items()}
            | {"holds_target": bool(known.get("holds_target", False))}
        )


def fails(met: Collection[Met], kinds: Collection[str]) -> tuple[str, ...]:
    """Say what was met though it is forbidden, once for each tissue, the first of it."""
    first: dict[str, Met] = {}
    for one in met:
        if one.is_forbidden(kinds):
            first.setdefault(one.words, one)
    return tuple(one.sentence for one in first.values())
