"""Sign check: does the torque of each motor turn its own joint, and the right way?"""

from typing import ClassVar, Final

import numpy as np
from numpy.typing import ArrayLike

from app.device.commissioning.errors import CommissioningError
from app.device.commissioning.pulses import (
    HALF,
    HALF_FORCE,
    LET_GO_AND_CONFIRM,
    SIDES,
    PulseRoutine,
    index,
)
from app.device.commissioning.results import Side, Signs, Step
from app.device.commissioning.routine import Part, Script
from app.device.control.loop import Loop
from app.mechanisms.profile import DeviceProfile

_RATE: Final = 0.04  # [N·m/s]
_COUNTS: Final = 8.0
_TURN: Final = 0.05  # [rad] that the user turns a link at least
_OUTWARDS: Final = {Side.LEFT: 1.0, Side.RIGHT: -1.0}  # counter-clockwise from above is positive


class SignCheck(PulseRoutine):
    """First the encoders by hand, then each motor by small pulses in both directions.

    Args:
        loop, profile: as in `Routine`.
        by_hand: ask the user to turn each link. Without it a motor and its encoder that are
            reversed together are not seen: for boards without hardware only.
    """

    NAME: ClassVar[Step] = Step.SIGNS
    TITLE: ClassVar[str] = "Sign check"

    def __init__(self, loop: Loop, profile: DeviceProfile, by_hand: bool = True) -> None:
        super().__init__(loop, profile)
        self._by_hand = by_hand

    def _script(self) -> Script:
        self._disarm()
        if self._by_hand:
            for side in SIDES:
                yield from self._turned(side)
        self._progress = 0.4
        yield from self._ask(LET_GO_AND_CONFIRM)
        yield from self._arm(HALF, HALF_FORCE)
        response = np.zeros((2, 2))
        for side in SIDES:
            for sign in (1.0, -1.0):
                message = f"pulse on the {side} motor, {'forwards' if sign > 0 else 'backwards'}"
                enough = _COUNTS * self._count
                moved, _ = yield from self._ramp(side, sign, _RATE, enough, message)
                response[index(side)] += 0.5 * sign * moved
                self._progress += 0.15
        if problems := diagnose(response):
            raise CommissioningError(f"{self.TITLE}: " + "; ".join(problems))
        (ll, lr), (rl, rr) = response.tolist()
        return Signs(response=((ll, lr), (rl, rr)), by_hand=self._by_hand)

    def _turned(self, side: Side) -> Part:
        """Have one link turned outwards by hand and look at the encoders."""
        before = yield from self._at_rest("hold the needle still")
        yield from self._ask(
            f"turn the {side} motor's link outwards by hand, by about 10°, hold it there and"
            " confirm; the other link stays as still as it can"
        )
        after = yield from self._at_rest("hold it there")
        self._progress += 0.15
        moved, own = after - before, index(side)
        if problem := hand_problem(side, moved, own):
            raise CommissioningError(f"{self.TITLE}: {problem}")


def hand_problem(side: Side, moved: ArrayLike, own: int) -> str:
    """Say what is wrong if the link of one side was turned outwards and the encoders moved so.

    Args:
        side: the link that the user turned.
        moved: change of (left, right) joint angle [rad], shape (2,).
        own: place of that side in `moved`.
    """
    turned = np.asarray(moved, dtype=np.float64)
    if not np.abs(turned).max() >= _TURN:
        return (
            f"no encoder saw the {side} link move (at least {np.degrees(_TURN):.0f}° were asked"
            " for): check the encoder's cable and supply"
        )
    if abs(turned[own]) < abs(turned[1 - own]):
        return (
            f"the other encoder moved more when the {side} link was turned: the encoders of left"
            " and right are swapped (exchange their plugs), or the wrong link was turned"
        )
    if turned[own] * _OUTWARDS[side] < 0.0:
        return (
            f"the {side} encoder counts backwards: exchange its channels A and B, or reverse it in"
            " the board's settings"
        )
    return ""


def diagnose(response: ArrayLike) -> list[str]:
    """Say what is wrong with the motors; empty if each turns its own joint the right way.

    Args:
        response: movement [rad] of (left, right) joint by a pulse on the left (row 0) and right
            (row 1) motor, shape (2, 2); a row of zeros where nothing moved.
    """
    moved = np.asarray(response, dtype=np.float64)
    strongest = [int(np.argmax(np.abs(row))) for row in moved]
    idle = [side for side in SIDES if not np.abs(moved[index(side)]).max() > 0.0]
    if len(idle) == 2:
        return [
            "no motor moves anything: check the switch of the motor supply, the amplifiers' enable"
            " and the motor cables, and that nothing blocks the needle"
        ]
    if idle:
        return [
            f"the {idle[0]} motor moves nothing up to 0.03 N·m: its joint is blocked, or its"
            " amplifier has no power or no enable"
        ]
    if strongest == [1, 0]:
        return ["the motors are swapped: exchange the motor cables of left and right"]
    if strongest[0] == strongest[1]:
        other = SIDES[1 - strongest[0]]
        return [
            f"both motors move the same encoder: the {other} encoder does not count, its joint is"
            " blocked, or both motors are wired to one amplifier"
        ]
    return [
        f"the {side} motor turns backwards: exchange its two leads, or reverse it in the board's"
        " settings"
        for side in SIDES
        if moved[index(side), index(side)] < 0.0
    ]
