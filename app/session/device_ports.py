"""What an attempt needs of the robot, and nothing more (`device.control.Loop` and its values)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from app.core.arrays import FloatArray
from app.device.checkpoint import Checkpoint

if TYPE_CHECKING:
    from app.device.control.timing import Timing


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
    def force_measured(self) -> bool:
        """Whether a gauge measures the force at the hand."""
        ...

    @property
    def measured_force(self) -> float:
        """Force at the hub that the gauge measures, across the needle [N]; 0 without one."""
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


class ClearancePort(Protocol):
    """How much force a device is cleared for (`device.readiness.Clearance`)."""

    @property
    def homed(self) -> float:
        """1 once homed and signs checked in this power cycle, else 0."""
        ...

    @property
    def force_cap(self) -> float:
        """Largest force at the hand [N]."""
        ...

    @property
    def reason(self) -> str:
        """Why it is less than full, and what to do; empty for full clearance."""
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

    def timing(self) -> Timing:
        """Lateness of the loop and deadlines missed."""
        ...

    def step(self, ticks: int) -> Any:
        """Run ticks on the virtual clock, without sleeping."""
        ...
