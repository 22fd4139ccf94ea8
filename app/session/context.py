"""What a trainer is told once about its runs: it goes into the head of every record."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from app.core.clock import Clock
from app.core.errors import AcusError
from app.core.paths import sessions
from app.device.checkpoint import Checkpoint
from app.planning.placement import PlacedPlan
from app.session.conditions import (
    AGREEMENT,
    BANDS,
    BANDS_SOURCE,
    CONDITIONS,
    TRAINEE,
    hand_of,
)
from app.session.facts import PLAN, plan_record
from app.session.header import TRASH, Attachment, SessionHeader, new_id
from app.session.recorder import Recorder

if TYPE_CHECKING:
    from app.device.control.loop import Loop
    from app.exercises.schema import Exercise

_DRAWS: Final = 16
"""An id that is taken is drawn anew so many times."""


@dataclass(frozen=True, slots=True)
class RunContext:
    """Where records go and what their head says beside plan and exercise.

    Attributes:
        folder: of the records; `core.paths.sessions()` by default.
        seed: of every random number of the run.
        metadata: records by name, such as `device`, `cameras`, `ct`; values as text.
        attachments: exercise and profiles as files.
        plan_files: makes the files of a plan that go beside them.
        agreement: how well screen and needle agree at a plan's target; empty where nobody knows.
        wall: wall-clock time, for the head only.
        identify: makes a session id from the wall-clock time.
    """

    folder: Path = field(default_factory=sessions)
    seed: int = 0
    metadata: Mapping[str, Mapping[str, str]] = field(default_factory=lambda: MappingProxyType({}))
    attachments: tuple[Attachment, ...] = ()
    plan_files: Callable[[PlacedPlan], tuple[Attachment, ...]] = lambda _: ()
    agreement: Callable[[PlacedPlan], Mapping[str, str]] = lambda _: {}
    wall: Callable[[], datetime] = lambda: datetime.now(UTC)
    identify: Callable[[datetime], str] = new_id

    def header(
        self, exercise: Exercise, placed: PlacedPlan, student: str, now: float, hand: str = ""
    ) -> SessionHeader:
        """Head of a record that begins at monotonic time `now` [s].

        Raises:
            SessionError: for a `hand` that is not one of `conditions.HANDS`.
        """
        trainee = dict(self.metadata.get(TRAINEE, {}))
        trainee["hand"] = hand_of(trainee, hand)
        bands = self._bands(exercise, trainee["hand"])
        agreement = dict(self.agreement(placed))
        checked = {AGREEMENT: agreement} if agreement else {}
        started = self.wall()
        return SessionHeader(
            id=self._free_id(started),
            started=started,
            origin=now,
            student=student,
            exercise_id=exercise.id,
            exercise_title=exercise.title,
            exercise_version=exercise.version,
            seed=self.seed,
            metadata={
                PLAN: plan_record(placed),
                **self.metadata,
                TRAINEE: trainee,
                **bands,
                **checked,
            },
            attachments=(*self.plan_files(placed), *self.attachments),
        )

    def _bands(self, exercise: Exercise, hand: str) -> dict[str, dict[str, str]]:
        """Return the record of conditions with whose bands judge; nothing without."""
        whose = exercise.bands_for(hand)
        if whose is None:
            return {}
        said = {BANDS: whose.value, BANDS_SOURCE: exercise.bands[whose].source.value}
        return {CONDITIONS: {**self.metadata.get(CONDITIONS, {}), **said}}

    def _free_id(self, started: datetime) -> str:
        """Return an id that no record has, deleted ones included; the last one tried if all have.

        Two programs that draw the same one at the same moment are told apart by the file's name,
        which only one of them can take.
        """
        for _ in range(_DRAWS):
            name = self.identify(started)
            if not any((place / f"{name}.mcap").exists() for place in self._places()):
                break
        return name

    def _places(self) -> tuple[Path, Path]:
        return self.folder, self.folder / TRASH

    def recorder(
        self,
        header: SessionHeader,
        loop: Loop,
        placed: PlacedPlan,
        clock: Clock,
    ) -> Recorder:
        """Return a recorder for one attempt, not yet open, that goes on from the loop's present.

        A loop that gives no checkpoint makes a record that cannot be replayed, and says so.
        """
        start: Checkpoint | None = None
        with suppress(AcusError):  # a loop that does not tick is told by the attempt itself
            start = loop.checkpoint()
        since_tick = 0 if start is not None else int(loop.latest().tick)
        place = placed.T_world_patient
        return Recorder(self.folder, header, loop.rows, since_tick, place, clock, start)
