"""How scripted hands answer complications: an expert soon and rightly, a novice late.

They see what a student sees: the monitor, and the pictures of the control scans that they take,
measured by `scan_reading`. What nobody scanned, or overlooked, is not answered. Delays, misses and
times between scans are teaching estimates; none measured was found.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.events import Event
from app.core.units import MILLIMETRE
from app.imaging.scan_order import ScanNeedle
from app.scoring.complications.answers import (
    GuidelineRow,
    Kind,
    Reaction,
    row_of_air,
    row_of_blood,
)
from app.scoring.complications.course import Vitals
from app.session.complication_case import KIND, ComplicationCase
from app.session.complications import Complications
from app.session.control_scan import KIND as SCAN
from app.session.control_scan import ControlScan, Taking
from app.session.needle_now import NeedleNow
from app.session.scan_reading import ScanReading, air_rim_mm, blood_radius_mm

if TYPE_CHECKING:
    from app.imaging.volume import Volume

Pictures = Callable[[ControlScan], "Volume"]
"""Makes the picture of a control scan, as the student is delivered it."""


@dataclass(frozen=True, slots=True)
class Manner:
    """How somebody watches and answers.

    Attributes:
        delay: from when a complication, or a worse stage of it, was seen until it is answered [s].
        is_right: whether by what the table calls right; else oxygen is given, which is not enough.
        every: from one scan to the next once the needle is in [s].
        least_mm: a thinner rim of air, or of blood, is not seen.
        overlooks: share of the scans in which nothing is seen, whatever they show.
    """

    delay: float
    is_right: bool
    every: float
    least_mm: float
    overlooks: float


MANNERS: Final = MappingProxyType(
    {
        "expert": Manner(4.0, True, 10.0, 3.0, 0.02),
        "proficient": Manner(7.0, True, 15.0, 4.0, 0.05),
        "competent": Manner(12.0, True, 25.0, 5.0, 0.1),
        "beginner": Manner(25.0, False, 35.0, 8.0, 0.2),
        "novice": Manner(40.0, False, 45.0, 12.0, 0.35),
    }
)

WATCHED_S: Final = 100.0
"""A script stays so much longer where a complication can happen [s]."""

HIGHER_FROM_MM: Final = 10.0
"""Blood of this radius is more than 2 cm about the needle: of a higher grade (Tai 2016)."""

_AWAY: Final = ScanNeedle(np.array([0.0, 0.0, 9.0e4]), np.array([0.0, 0.0, 9.1e4]))
"""No needle lies in the planning CT."""

SHAFT: Final = 0.15
"""Length of needle that a script's scan shows [m]."""


@dataclass(slots=True)
class ScriptedAnswers:
    """Answers the complications of one attempt, by what scans and monitor show.

    Attributes:
        manner: how.
        seed: of what is overlooked.
    """

    manner: Manner
    seed: int = 0
    _due: dict[Kind, tuple[int, float]] = field(default_factory=dict)
    _answered: dict[Kind, int] = field(default_factory=dict)
    _reading: ScanReading = field(default_factory=ScanReading)
    _aspirated_mm: float | None = None
    _scans: int = 0
    _next: float = 0.0
    _heard: float | None = None
    _reported: bool = False

    @classmethod
    def of(cls, skill: str, seed: int = 0) -> ScriptedAnswers | None:
        """Return those of a skill by its name; None for none that is known."""
        from app.simulation.hands import SUFFIX  # compiled: the start page waits for no kernels

        manner = MANNERS.get(skill.removesuffix(SUFFIX))
        return None if manner is None else cls(manner, seed)

    def wants_scan(self, inside: bool, now: float) -> bool:
        """Return whether the hand takes a scan at `now` [s]; `inside`: a needle is in the body."""
        return inside and now >= self._next

    def see(self, reading: ScanReading, now: float) -> None:
        """Take in what the picture of a scan shows, as far as this hand sees it."""
        self._next = now + self.manner.every
        random = np.random.default_rng([self.seed, self._scans])
        self._scans += 1
        if random.random() < self.manner.overlooks:
            return
        least = self.manner.least_mm
        self._reading = ScanReading(
            reading.rim_mm if reading.rim_mm >= least else 0.0,
            reading.blood_mm if reading.blood_mm >= least else 0.0,
        )

    def notices(self, monitor: Vitals, now: float) -> bool:
        """Return whether the hand says at `now` [s] that something is wrong, once for each cough.

        Who answers rightly hears it at once, before any scan can show why.
        """
        if not monitor.coughs:
            self._heard, self._reported = None, False
            return False
        self._heard = now if self._heard is None else self._heard
        due = self.manner.is_right and now >= self._heard + self.manner.delay
        before, self._reported = self._reported, self._reported or due
        return due and not before

    def rows(self, monitor: Vitals) -> tuple[GuidelineRow, ...]:
        """Return the rows of the table of answers that hold by what was seen."""
        found, seen = [], self._reading
        if seen.rim_mm > 0.0:
            before = self._aspirated_mm
            in_vain = before is not None and seen.rim_mm >= 0.5 * before
            found.append(row_of_air(seen.rim_mm, monitor.has_symptoms, in_vain))
        if seen.blood_mm > 0.0 or monitor.coughs_blood:
            found.append(row_of_blood(seen.blood_mm >= HIGHER_FROM_MM, monitor.coughs_blood))
        return tuple(found)

    def look(self, monitor: Vitals, now: float) -> Reaction | None:
        """Return what is answered at `now` [s] to what was seen; None for nothing yet."""
        rows: Sequence[GuidelineRow] = self.rows(monitor)
        for row in sorted(rows, key=lambda one: -one.severity):
            if row.severity <= self._answered.get(row.kind, 0):
                continue
            severity, due = self._due.get(row.kind, (0, 0.0))
            if row.severity > severity:
                due = now + self.manner.delay
                self._due[row.kind] = row.severity, due
            if now >= due:
                self._answered[row.kind] = row.severity
                return self._of(row)
        return None

    def _of(self, row: GuidelineRow) -> Reaction:
        if not self.manner.is_right:
            return Reaction.OXYGEN
        answer = next(answer for answer in Reaction if answer in row.right)
        if answer is Reaction.ASPIRATE:
            self._aspirated_mm = self._reading.rim_mm
        return answer


@dataclass(frozen=True, slots=True, eq=False)
class ScanReader:
    """Reads the pictures of scans as a student could, of one exercise.

    Attributes:
        case: the patient, for where he lies and what is aimed at.
        pictures: makes them.
    """

    case: ComplicationCase
    pictures: Pictures

    def read(self, scan: ControlScan) -> ScanReading:
        """Measure what a scan shows of complications, in its picture alone."""
        placed = self.case.placed
        up = placed.T_world_patient.inverse().rotate(np.array([0.0, 0.0, 1.0]))
        picture, look = self.pictures(scan), replace(scan.look, noise_hu=0.0)
        planning = replace(scan, inside=None, shift_mm=np.zeros(3), needle=_AWAY, look=look)
        before, ends = self.pictures(planning), (scan.needle.hub_mm, scan.needle.tip_mm)
        return ScanReading(
            air_rim_mm(picture, placed.plan.target_mm, up, *ends),
            blood_radius_mm(picture, before, *ends),
        )


@dataclass(slots=True)
class ScriptedPatient:
    """A patient whose complications a scripted hand answers, where no trainer runs.

    Attributes:
        happens: complications of the attempt.
        case: what they stand on.
        answers: who answers them; None for nobody.
        taking: the scan that the hand takes; None where it takes none.
        reader: of its pictures; None where nobody can make them: then the monitor alone tells.
    """

    happens: Complications
    case: ComplicationCase
    answers: ScriptedAnswers | None = None
    taking: Taking | None = None
    reader: ScanReader | None = None
    _scans: int = 0

    @classmethod
    def of(
        cls,
        case: ComplicationCase | None,
        skill: str,
        seed: int,
        taking: Taking | None = None,
        pictures: Pictures | None = None,
    ) -> ScriptedPatient | None:
        """Return the patient of an attempt; None where nothing can happen."""
        if case is None:
            return None
        reader = None if pictures is None else ScanReader(case, pictures)
        answers = ScriptedAnswers.of(skill, seed)
        return cls(Complications(case, seed), case, answers, taking, reader)

    def look(self, needle: NeedleNow, is_outer: bool, now: float) -> list[Event]:
        """Let time pass to `now` [s]; returns what the record would keep."""
        happened = self.happens.look(needle, is_outer, now)
        events = [Event(now, KIND, one.words, one.data) for one in happened]
        if self.answers is None:
            return events
        inside = is_outer and needle.measured and needle.depth > 0.0
        if self.taking is not None and self.answers.wants_scan(inside, now):
            scan = self._scan(self.taking, needle, now)
            reading = ScanReading() if self.reader is None else self.reader.read(scan)
            self.answers.see(reading, now)
            data = {"number": scan.number, **scan.data()}
            events.append(Event(now, SCAN, "", data))
        monitor = self.happens.state.vitals
        if self.answers.notices(monitor, now):
            said = self.happens.notice()
            events.append(Event(now, KIND, said.words, said.data))
        answer = self.answers.look(monitor, now)
        if answer is not None:
            given = self.happens.answer(answer)
            events.append(Event(now, KIND, given.words, given.data))
        return events

    def _scan(self, taking: Taking, needle: NeedleNow, now: float) -> ControlScan:
        """Take a scan of the patient as he is now."""
        self._scans += 1
        placed, guidance, choice = self.case.placed, taking.guidance, taking.choice
        to_patient = placed.T_world_patient.inverse()
        hub = needle.p_tip - SHAFT * needle.tip_axis / np.linalg.norm(needle.tip_axis)
        hub_mm, tip_mm = (to_patient @ place / MILLIMETRE for place in (hub, needle.p_tip))
        moved = to_patient.rotate(needle.p_target - placed.p_target) / MILLIMETRE
        x, y, z = placed.plan.target_mm.tolist()
        return ControlScan(
            self._scans,
            now,
            taking.order,
            taking.needle(hub_mm, tip_mm, None),
            np.where(np.isfinite(moved), moved, 0.0),
            guidance.dose(taking.order, choice),
            guidance.streak,
            guidance.look(choice, (x, y, z), self._scans),
            choice,
            guidance.hand_dose(choice),
            self.happens.scanned(),
        )
