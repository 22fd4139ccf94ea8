"""What the wizard needs of a robot on the bench (`device.commissioning.bench.Bench`)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from app.core.clock import Clock
    from app.device.commissioning.records import DeviceRecord
    from app.device.commissioning.report import Report
    from app.device.commissioning.results import AnyResult, Step
    from app.device.links.link import BoardInfo
    from app.device.readiness import Clearance
    from app.mechanisms.profile import DeviceProfile


class RoutinePort(Protocol):
    """One routine; ends at zero torque however it ends."""

    def step(self, now: float) -> Report:
        """Go on at the loop's time [s]."""
        ...

    def answer(self, value: float | None = None) -> None:
        """Give what the last report needs.

        Raises:
            AcusError: if the number is missing or not finite; the question stays.
        """
        ...

    def cancel(self) -> None:
        """End at zero torque; idempotent."""
        ...


class BenchPort(Protocol):
    """A robot that is open for commissioning, without force while no routine runs."""

    @property
    def clock(self) -> Clock:
        """Time of its loop."""
        ...

    @property
    def profile(self) -> DeviceProfile:
        """Of the robot."""
        ...

    @property
    def info(self) -> BoardInfo:
        """Who is at the other end."""
        ...

    @property
    def record(self) -> DeviceRecord:
        """What was found on it so far."""
        ...

    def clearance(self) -> Clearance:
        """How much force it is cleared for now."""
        ...

    def done(self, *steps: Step) -> bool:
        """Whether any of some routines succeeded in this power cycle."""
        ...

    def routine(self, step: Step) -> RoutinePort:
        """Make a routine.

        Raises:
            AcusError: if another one must come first.
        """
        ...

    def keep(self, result: AnyResult) -> Path:
        """Put a result into the record and use it.

        Raises:
            AcusError: if the record cannot be written.
        """
        ...

    def undo(self, *steps: Step) -> Path:
        """Take the newest result back.

        Raises:
            AcusError: if there is none, or the record cannot be written.
        """
        ...

    def close(self) -> None:
        """End at zero torque and let go of the robot; idempotent."""
        ...
