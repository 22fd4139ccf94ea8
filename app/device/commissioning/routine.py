"""What all commissioning routines share: a script that is stepped and ends at zero torque."""

from abc import ABC, abstractmethod
from collections.abc import Generator
from dataclasses import replace
from math import isfinite, pi
from typing import Any, ClassVar, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.messages import sentence
from app.device.commissioning.results import AnyResult, RoutineName, RoutineReport
from app.device.control.loop import Loop
from app.device.errors import CommissioningError
from app.device.faults import Fault
from app.device.state import DeviceState
from app.mechanisms.profile import DeviceProfile

Script = Generator[RoutineReport, float, AnyResult]
"""A routine's course: yields what it says, is sent the time [s], returns its result."""

Part = Generator[RoutineReport, float, Any]
"""Part of a script."""

QUIET: Final = {"test_x": 0.0, "test_y": 0.0, "test_z": 0.0, "test_left": 0.0, "test_right": 0.0}
"""Inputs of a routine that pushes nothing."""

_ARMING_PATIENCE: Final = 6.0
_REARM: Final = 0.1
_REST_TIME: Final = 0.3
_REST_COUNTS: Final = 3.0
_REST_PATIENCE: Final = 10.0


class Routine(ABC):
    """One routine on a running loop.

    Call `step` about a hundred times a second (at least thrice a second: it is also the loop's
    sign of life) until its report is `done`, and `answer` when the report `needs` something.
    However it ends, the test inputs are zero and the forces are disarmed afterwards.

    Args:
        loop: runs the table of `commissioning_table`.
        profile: of the device.
    """

    NAME: ClassVar[RoutineName]
    TITLE: ClassVar[str]

    def __init__(self, loop: Loop, profile: DeviceProfile) -> None:
        self._loop, self._profile = loop, profile
        self._course: Script | None = None
        self._report = RoutineReport(0.0, self.TITLE)
        self._answers: list[float | None] = []
        self._powered = False
        self._progress = 0.0
        self._now = 0.0

    # --- for whoever runs it ----------------------------------------------------------------------
    @property
    def report(self) -> RoutineReport:
        """Return what the last step said."""
        return self._report

    def step(self, now: float) -> RoutineReport:
        """Go on; `now` is the loop's time [s]. After the end the last report is returned again."""
        if self._report.done:
            return self._report
        try:
            self._loop.inbox.write(heartbeat=now)
            self._report = self._advance(now)
        except StopIteration as end:
            self._finish(RoutineReport(1.0, end.value.summary(), done=True, result=end.value))
        except AcusError as error:
            self._finish(
                RoutineReport(
                    self._progress, f"{self.TITLE}: failed", done=True, failure=str(error)
                )
            )
        except BaseException:
            self._quiet()
            raise
        return self._report

    def answer(self, value: float | None = None) -> None:
        """Give what the last report needs: a number, or nothing for a confirmation.

        Raises:
            CommissioningError: if nothing is asked, or the number is missing or not finite; the
                question stays.
        """
        if not self._report.needs:
            raise CommissioningError(
                sentence("{title}: nothing is asked; there is nothing to answer", title=self.TITLE)
            )
        if self._report.unit and (value is None or not isfinite(value)):
            raise CommissioningError(
                sentence(
                    "{title}: {reading} is not a number; type the reading in {report_unit}",
                    title=self.TITLE,
                    reading=value,
                    report_unit=self._report.unit,
                )
            )
        self._answers.append(value)
        self._report = replace(self._report, needs="", unit="")

    def cancel(self) -> None:
        """End at zero torque, from any state; idempotent."""
        if not self._report.done:
            self._finish(
                RoutineReport(
                    self._progress, f"{self.TITLE}: cancelled", done=True, failure="cancelled"
                )
            )

    # --- for the scripts --------------------------------------------------------------------------
    @abstractmethod
    def _script(self) -> Script:
        """Course of the routine."""

    def _say(self, message: str) -> Part:
        """Let one step pass; returns the newest state, which is without a fault while powered."""
        self._now = yield RoutineReport(self._progress, message)
        return self._checked()

    def _wait(self, duration: float, message: str) -> Part:
        """Let some time [s] pass; returns the newest state."""
        end = self._now + duration
        state = self._checked()
        while self._now < end:
            state = yield from self._say(message)
        return state

    def _ask(self, needs: str, unit: str = "") -> Part:
        """Ask for a confirmation, or for a number in a unit; returns the number."""
        while not self._answers:
            self._now = yield RoutineReport(self._progress, self.TITLE, needs, unit)
            self._checked()
        return self._answers.pop(0)

    def _arm(self, homed: float, cap: float) -> Part:
        """Arm the forces with a clearance of the routine's own and wait for the ramp.

        Nothing is pushed yet, so a fault that passes (a hiccup of the wire) is waited for:
        disarmed, because some faults stay until then, and armed again.
        """
        self._loop.inbox.write(homed=homed, force_cap=cap, enabled=1.0, **QUIET)
        end = self._now + _ARMING_PATIENCE
        state = yield from self._say("arming")
        while state.row[sv.ARMING] < 1.0 or state.fault is not Fault.NONE:
            if self._now > end:
                raise CommissioningError(_why_not_armed(state))
            if state.fault is not Fault.NONE:
                self._loop.inbox.write(enabled=0.0)
                yield from self._wait(_REARM, "waiting for the robot")
                self._loop.inbox.write(homed=homed, force_cap=cap, enabled=1.0)
            state = yield from self._say("arming")
        self._powered = True
        return state

    def _disarm(self) -> None:
        """Zero torque, forces off."""
        self._quiet()

    def _torque(self, left: float = 0.0, right: float = 0.0) -> None:
        """Ask for test torques [N·m]."""
        self._loop.inbox.write(test_left=left, test_right=right)

    def _force(self, force: FloatArray) -> None:
        """Ask for a test force at the hub [N], shape (3,)."""
        x, y, z = (float(value) for value in force)
        self._loop.inbox.write(test_x=x, test_y=y, test_z=z)

    def _at_rest(self, message: str) -> Part:
        """Wait until the joints stand still for a moment; returns their mean angles [rad], (2,)."""
        end = self._now + _REST_PATIENCE
        while True:
            since = self._loop.latest().tick
            yield from self._wait(_REST_TIME, message)
            angles = self._angles(since)
            if len(angles) and np.ptp(angles, axis=0).max() <= _REST_COUNTS * self._count:
                return angles.mean(axis=0)
            if self._now > end:
                raise CommissioningError(
                    sentence(
                        "{title}: the joints do not stand still, or are not read; hold the"
                        " needle still, or check the encoder cables",
                        title=self.TITLE,
                    )
                )

    def _angles(self, since: int) -> FloatArray:
        """Joint angles [rad] of the finite readings since a tick, shape (n, 2)."""
        angles = self._loop.rows(since)[:, sv.Q]
        return angles[np.isfinite(angles).all(axis=1)]

    @property
    def _count(self) -> float:
        """One encoder count [rad]."""
        return 2.0 * pi / self._profile.encoder.counts_per_turn

    # --- inside -----------------------------------------------------------------------------------
    def _advance(self, now: float) -> RoutineReport:
        if self._course is None:
            self._now = now
            self._course = self._script()
            return next(self._course)
        return self._course.send(now)

    def _checked(self) -> DeviceState:
        state = self._loop.latest()
        if self._powered and state.fault is not Fault.NONE:
            raise CommissioningError(
                sentence(
                    "{title}: {state_fault_message}",
                    title=self.TITLE,
                    state_fault_message=state.fault.message,
                )
            )
        return state

    def _quiet(self) -> None:
        self._powered = False
        self._loop.inbox.write(enabled=0.0, homed=0.0, force_cap=0.0, **QUIET)

    def _finish(self, report: RoutineReport) -> None:
        self._quiet()
        self._report = report
        if self._course is not None:
            self._course.close()


def _why_not_armed(state: DeviceState) -> str:
    if state.tick == 0:
        return sentence("the loop does not tick; start it before the routine")
    if state.fault is Fault.NONE:
        return sentence(
            "the loop does not answer in time to arm the forces; close other programs, try again"
        )
    return sentence(
        "the forces cannot be armed: {state_fault_message}", state_fault_message=state.fault.message
    )
