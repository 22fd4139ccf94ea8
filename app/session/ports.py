"""What an attempt needs of device, tracking and exercise, and nothing more.

`device.control.Loop`, `tracking.Tracker` and `exercises.Exercise` satisfy these protocols; tests
satisfy them with small fakes.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from app.core.arrays import FloatArray
from app.core.events import EventQueue
from app.core.latest import Stamped
from app.exercises.locks import Lock
from app.imaging.scan_order import ScanOrder
from app.scoring.rows import Rules
from app.scoring.tolerance import Tolerance
from app.session.device_ports import ClearancePort, DeviceStatePort, InboxPort, LoopPort

if TYPE_CHECKING:
    from app.tracking.statistics import TrackerStatistics

__all__ = [
    "ClearancePort",
    "DeviceStatePort",
    "ExercisePort",
    "FixPort",
    "InboxPort",
    "LatestFixPort",
    "LoopPort",
    "TrackerPort",
]


class FixPort(Protocol):
    """What the cameras say about the tip (`tracking.NeedleFix`)."""

    @property
    def p_tip_world(self) -> FloatArray:
        """Tip [m], shape (3,)."""
        ...

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the tip [m²], shape (3, 3)."""
        ...

    @property
    def time(self) -> float:
        """Capture time [s]."""
        ...

    @property
    def status(self) -> str:
        """One of `tracking.fix.FixStatus`."""
        ...

    @property
    def usable(self) -> bool:
        """Whether the tip is a measurement: by both cameras, or by one and the shaft's line."""
        ...

    @property
    def line_variance(self) -> float | None:
        """Of the robot's line across itself [m²]; None if the line has been used for the tip."""
        ...

    @property
    def axis(self) -> FloatArray | None:
        """Needle's direction by the robot at the capture, unit, shape (3,); None if unknown."""
        ...

    @property
    def residual_px(self) -> float:
        """Reprojection residual [px]."""
        ...


class LatestFixPort(Protocol):
    """Holder of the newest fix (`core.latest.Latest[NeedleFix]`)."""

    def read(self) -> Stamped[Any] | None:
        """Return the newest fix, or None before the first."""
        ...


class TrackerPort(Protocol):
    """The tracker (`tracking.Tracker`)."""

    @property
    def latest(self) -> LatestFixPort:
        """Newest fix."""
        ...

    @property
    def events(self) -> EventQueue:
        """What happened to cameras and tracker; kind `fault` for what ends an attempt."""
        ...

    def open(self) -> None:
        """Open the cameras and start the thread."""
        ...

    def close(self) -> None:
        """Stop the thread and the cameras."""
        ...

    def statistics(self) -> TrackerStatistics:
        """Rates, latency and shares of the statuses."""
        ...


class GuidancePort(Protocol):
    """How an exercise guides by pictures (`exercises.guidance.GuidancePart`)."""

    @property
    def streak(self) -> bool:
        """Whether the metal leaves its streak in a scan's pictures."""
        ...

    def dose(self, order: ScanOrder) -> float:
        """Notional dose-length product of a scan [mGy·cm]: a teaching estimate."""
        ...


class ExercisePort(Protocol):
    """The exercise (`exercises.Exercise`)."""

    @property
    def id(self) -> str:
        """Identifier."""
        ...

    @property
    def title(self) -> str:
        """Title for people."""
        ...

    @property
    def version(self) -> int:
        """Only attempts of one version are compared."""
        ...

    @property
    def assistance(self) -> float:
        """Assistance at the start, 0...1."""
        ...

    @property
    def locked(self) -> Container[Lock]:
        """Controls that stay as the exercise has them."""
        ...

    @property
    def tolerances(self) -> Mapping[str, Tolerance]:
        """What each metric is judged by."""
        ...

    @property
    def guidance(self) -> GuidancePort:
        """What control scans cost."""
        ...

    @property
    def rules(self) -> Rules:
        """Pass mark, and when a score is void."""
        ...
