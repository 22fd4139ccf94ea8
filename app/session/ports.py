"""What an attempt needs of device, tracking and exercise, and nothing more.

`device.control.Loop`, `tracking.Tracker` and `exercises.Exercise` satisfy these protocols; tests
satisfy them with small fakes.
"""

from collections.abc import Mapping
from typing import Any, Protocol

from app.core.arrays import FloatArray
from app.core.events import EventQueue
from app.core.latest import Stamped
from app.device.checkpoint import Checkpoint
from app.scoring.rows import Rules
from app.scoring.tolerance import Tolerance


class DeviceStatePort(Protocol):
    """One row of the loop as a value (`device.control.DeviceState`); SI, world."""

    @property
    def row(self) -> FloatArray:
        """The whole state vector, shape (SLOTS,)."""
        ...

    @property
    def time(self) -> float:
        """Monotonic time of the tick [s]."""
        ...

    @property
    def tick(self) -> int:
        """Number of the tick; 0 before the first."""
        ...

    @property
    def q(self) -> FloatArray:
        """Joint angles [rad], shape (2,)."""
        ...

    @property
    def qd(self) -> FloatArray:
        """Joint velocities [rad/s], shape (2,)."""
        ...

    @property
    def axis(self) -> FloatArray:
        """Needle direction, hub to tip, shape (3,)."""
        ...

    @property
    def tip(self) -> FloatArray:
        """Tip [m], shape (3,)."""
        ...

    @property
    def hub(self) -> FloatArray:
        """Hub point, where the hand is [m], shape (3,)."""
        ...

    @property
    def depth(self) -> float:
        """Depth of the tip beyond the fulcrum [m]."""
        ...

    @property
    def force(self) -> FloatArray:
        """Wanted force at the hub point [N], shape (3,)."""
        ...

    @property
    def guide(self) -> FloatArray:
        """The virtual fixture's share of it [N], shape (3,)."""
        ...

    @property
    def felt(self) -> FloatArray:
        """Force at the hub point after all limits [N], shape (3,)."""
        ...

    @property
    def torque(self) -> FloatArray:
        """Joint torques sent [N·m], shape (2,)."""
        ...

    @property
    def limit_scale(self) -> float:
        """1 where no limit acts, else the factor on both torques."""
        ...

    @property
    def safety_scale(self) -> float:
        """Fade for stale encoders and arming, 0...1."""
        ...

    @property
    def fault(self) -> int:
        """Code of the fault that holds the force at zero; 0 none."""
        ...


class InboxPort(Protocol):
    """Where other threads write the loop's inputs."""

    def write(self, **inputs: float) -> None:
        """Write input slots by their lower-case names."""
        ...


class LoopPort(Protocol):
    """The real-time loop (`device.control.Loop`)."""

    @property
    def inbox(self) -> InboxPort:
        """The loop's inputs."""
        ...

    def open(self) -> None:
        """Start the kernel in its thread."""
        ...

    def close(self) -> None:
        """End at zero force."""
        ...

    def latest(self) -> DeviceStatePort:
        """Return the newest state; its tick is 0 before the first."""
        ...

    def rows(self, since_tick: int) -> FloatArray:
        """Rows of the history ring after tick `since_tick`, shape (n, SLOTS)."""
        ...

    def checkpoint(self) -> Checkpoint:
        """Return all that the next tick depends on besides its inputs."""
        ...

    def timing(self) -> Any:
        """Lateness of the loop and deadlines missed."""
        ...

    def step(self, ticks: int) -> Any:
        """Run ticks on the virtual clock, without sleeping."""
        ...


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
        """`valid`, `out_of_view`, `one_camera`, `inconsistent` or `no_orientation`."""
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

    def statistics(self) -> Any:
        """Rates, latency and shares of the statuses."""
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
    def tolerances(self) -> Mapping[str, Tolerance]:
        """What each metric is judged by."""
        ...

    @property
    def rules(self) -> Rules:
        """Pass mark, and when a score is void."""
        ...
