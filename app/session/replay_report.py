"""What a replay found, for people and for programs."""

from dataclasses import dataclass
from math import isfinite
from typing import Any

from app.session.comparison import Difference


@dataclass(frozen=True, slots=True)
class ReplayReport:
    """Result of a replay.

    Attributes:
        session: id of the session.
        ticks: ticks that were recomputed.
        seconds: time that they stand for [s].
        recorded_ticks: ticks in the record; more than `ticks` if some are missing between.
        first_difference: None if every bit is the same.
        largest_difference: relative to the slot's own size; None if there is none.
        every_slot: whether every slot of every tick was compared; otherwise only those recorded.
        changes: what differs between the build that recorded and this one, one line each.
        gaps: (first tick, count) of every stretch of ticks that the record lacks.
    """

    session: str
    ticks: int
    seconds: float
    recorded_ticks: int
    first_difference: Difference | None
    largest_difference: Difference | None
    every_slot: bool
    changes: tuple[str, ...] = ()
    gaps: tuple[tuple[int, int], ...] = ()

    @property
    def same_build(self) -> bool:
        """Whether the record was made by this very build on this kind of processor."""
        return not self.changes

    @property
    def identical(self) -> bool:
        """Whether nothing differs."""
        return self.first_difference is None

    def sentences(self) -> list[str]:
        """Say it, one line each."""
        lines = [self._verdict()]
        if not self.every_slot:
            lines.append("compared were only the slots that the record holds by value")
        for first, count in self.gaps:
            lines.append(f"{count} ticks from tick {first} on are not in the record")
        if self.gaps:
            left = self.recorded_ticks - self.ticks
            lines.append(f"the replay ends there: {left} recorded ticks were not recomputed")
        lines += [f"another build: {change}" for change in self.changes]
        if self.changes and not self.identical:
            lines.append("with another build, differences in the last digits are expected")
        return lines

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "session": self.session,
            "identical": self.identical,
            "ticks": self.ticks,
            "seconds": self.seconds,
            "recorded_ticks": self.recorded_ticks,
            "every_slot": self.every_slot,
            "first_difference": _document(self.first_difference),
            "largest_difference": _document(self.largest_difference),
            "same_build": self.same_build,
            "build_changes": list(self.changes),
            "gaps": [{"first_tick": first, "ticks": count} for first, count in self.gaps],
        }

    def _verdict(self) -> str:
        if self.first_difference is None:
            return f"identical over {self.ticks} ticks ({self.seconds:.1f} s)"
        text = f"differs from tick {self.first_difference.tick} on: {_words(self.first_difference)}"
        most = self.largest_difference
        if most is not None and most != self.first_difference:
            text += f"; the largest difference is in tick {most.seen_at}: {_words(most)}"
        return text


def _words(difference: Difference) -> str:
    d = difference
    if not d.slot:
        return f"at {d.time:.4f} s, in a slot that is not recorded in every tick"
    where = "" if d.seen_at == d.tick else f" (as seen in tick {d.seen_at})"
    size = f", by {d.size:.2g}" if isfinite(d.size) else ""
    return f"{d.slot} was {d.recorded!r}, is now {d.recomputed!r}{size}{where}"


def _document(difference: Difference | None) -> dict[str, Any] | None:
    if difference is None:
        return None
    return {
        "tick": difference.tick,
        "time_s": difference.time,
        "slot": difference.slot,
        "recorded": difference.recorded,
        "recomputed": difference.recomputed,
        "seen_at_tick": difference.seen_at,
    }
