"""One look at everything: forces, cameras and robot, the attempt; and what it shows."""

from app.core.errors import AcusError
from app.core.events import EventQueue
from app.core.latest import Latest
from app.planning.placement import PlacedPlan
from app.session.arming import Arming
from app.session.inputs import LoopInputs
from app.session.observation import Observation
from app.session.running import Running
from app.session.snapshot import Snapshot, take
from app.session.watch import Watch
from app.session.withdrawal import Withdrawal


class Sight:
    """Looks for a trainer, which holds the lock, and publishes what was seen.

    Args:
        inputs: of the loop.
        arming: of the forces.
        watch: of loop and tracker.
        running: the attempt.
        events: where the tracker's news go.
        withdrawal: brings the needle out before an attempt.
    """

    def __init__(
        self,
        inputs: LoopInputs,
        arming: Arming,
        watch: Watch,
        running: Running,
        events: EventQueue,
        withdrawal: Withdrawal,
    ) -> None:
        self._inputs, self._arming, self._watch = inputs, arming, watch
        self._running, self._events = running, events
        self._withdrawal = withdrawal
        self._latest: Latest[Snapshot] = Latest()

    @property
    def newest(self) -> Snapshot | None:
        """What was published last; None before the first."""
        stamped = self._latest.read()
        return stamped.value if stamped is not None else None

    def look(self, placed: PlacedPlan, now: float) -> str:
        """Pull the latest values and move the attempt; returns why it must be aborted, or nothing.

        Args:
            placed: the plan.
            now: time [s].
        """
        try:
            self._arming.look()
            seen = self._watch.look(placed, now)
            was_paused = self._running.paused
            reason = self._running.look(
                seen, self._inputs, self._arming.held, self._withdrawal.simulated
            )
            self._arming.pause(was_paused, self._running.paused)
            reason = reason or self._bring_out(seen)
            return reason or self._watch.news(self._running, self._events)
        except AcusError as error:
            self._watch.blind(placed, now, str(error))
            return str(error)

    def _bring_out(self, seen: Observation) -> str:
        """Begin an attempt once the needle is out; returns why it must be ended, or nothing."""
        running, withdrawal = self._running, self._withdrawal
        if running.withdrawing:
            step = withdrawal.look(seen.device, seen.pose, seen.time)
            if step.known is not None:
                running.release(step.known, seen.time)
                self._arming.begin()
            return step.failure
        withdrawal.stop()
        return withdrawal.refuted(seen.pose, seen.time) if running.counts else ""

    def publish(self, placed: PlacedPlan, now: float) -> Snapshot:
        """Publish what the last look saw, with the attempt as it is now."""
        seen = self._watch.newest(placed, now)
        snapshot = take(
            now, seen, self._running, self._inputs, self._arming, self._watch, self._withdrawal
        )
        self._latest.publish(snapshot, now)
        return snapshot
