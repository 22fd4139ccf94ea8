"""What only moving joints show: signs, limits, and that the watchdog stops more than a flag.

`PUSHES` give torque: the arms are free, and nobody's hand is near. `TURNS` watch links that a hand
turns, `RESTARTS` a board that is switched off and on.
"""

import time
from statistics import median
from typing import Final

from app.device.conformance.checks import Inquiry, KnownBoard, leaps, must
from app.device.conformance.talk import DepartureError, HeardState, Talk, UnseenError
from app.device.links import acus_protocol as acus

GENTLE: Final = 0.05
"""Share of the largest torque that finds signs."""

LEAST: Final = 0.05
"""Least acceleration that counts as one [turns/s²]."""

PULSE: Final = 0.002
"""How long the largest torque is given [s]."""

ROUNDS: Final = (3, 4)
"""How often a push is compared; the second number more where the median of the first differs."""

LOOK: Final = 0.05
"""How long is looked at a joint to know its speed [s]."""

WAITS: Final = 60.0
"""How long is waited for a hand [s]."""

Motion = tuple[float, float]
"""Speed [counts/s] or acceleration [counts/s²] of the left and the right joint."""


def _seconds(a: HeardState, b: HeardState) -> float:
    """Time between two STATEs by the board's own clock: this computer may be busy meanwhile."""
    return max(((b.time - a.time) & 0xFFFFFFFF) * 1e-6, 1e-6)


def _speed(talk: Talk) -> Motion:
    """Look at the joints without torque."""
    first = talk.ask()
    end = time.monotonic() + LOOK
    while time.monotonic() < end:
        last = talk.ask()
    elapsed = _seconds(first, last)
    left, right = ((q - p) / elapsed for p, q in zip(first.counts, last.counts, strict=True))
    return left, right


def _rest(talk: Talk) -> None:
    """Let it come to rest, without torque."""
    for _ in range(6):
        _speed(talk)


def _acceleration(
    talk: Talk, board: KnownBoard, channels: tuple[float, ...], pulse: float
) -> tuple[Motion, HeardState]:
    """Push from rest for a moment, shorter than the watchdog's time, and brake by as much.

    Returns:
        What the push brought, and the STATE that answered it.
    """
    for _ in range(25):
        _rest(talk)
        before = _speed(talk)
        begin = talk.ask(channels=channels)
        talk.pause(pulse)
        end = talk.ask()
        after = _speed(talk)
        elapsed = _seconds(begin, end)
        talk.ask(channels=tuple(-one for one in channels))
        talk.pause(min(elapsed, 0.75 * board.watchdog))
        talk.ask()
        if elapsed < 0.75 * board.watchdog:
            left, right = ((b - a) / elapsed for a, b in zip(before, after, strict=True))
            return (left, right), begin
    raise UnseenError("this computer is too busy to push for a moment")


def _shown(motion: Motion) -> str:
    return f"{motion[0]:.0f} and {motion[1]:.0f}"


def _need_joints(talk: Talk) -> None:
    if talk.version != acus.VERSION:
        raise UnseenError("joints drawn by cables do not show a torque of their own")


def _signs(talk: Talk, board: KnownBoard) -> str:
    _need_joints(talk)
    torque = GENTLE * board.largest
    seen = []
    for joint, name in enumerate(("left", "right")):
        for sign in (1.0, -1.0):
            channels = (sign * torque, 0.0) if joint == 0 else (0.0, sign * torque)
            turned, _ = _acceleration(talk, board, channels, 0.3 * board.watchdog)
            does = f"{sign * torque:+.3g} N·m on the {name} joint: {_shown(turned)} counts/s²"
            must(
                max(map(abs, turned)) >= LEAST * board.counts,
                f"{does}: its motor, its encoder or the motor supply is off, or it is blocked",
            )
            must(abs(turned[joint]) > abs(turned[1 - joint]), f"{does}: it turns the other one")
            must(turned[joint] * sign > 0.0, f"{does}: motor or encoder is reversed")
            seen.append(f"{name} {sign * torque:+.3g} N·m {turned[joint]:+.0f}")
    return ", ".join(seen) + " counts/s²"


def _limited(talk: Talk, board: KnownBoard) -> str:
    if talk.version != acus.VERSION:
        return _limited_tensions(talk, board)
    large = board.largest
    seen = []
    for joint, name in enumerate(("left", "right")):
        within, beyond = (large, 0.5 * large), (2.0 * large, large)
        if joint:
            within, beyond = within[::-1], beyond[::-1]
        pairs: list[tuple[Motion, Motion]] = []
        for pushes in ROUNDS:  # a computer that is busy pushes now and then for another time
            pairs += [_compared(talk, board, within, beyond) for _ in range(pushes)]
            asked, allowed = (
                (median(pair[k][0] for pair in pairs), median(pair[k][1] for pair in pairs))
                for k in (0, 1)  # as asked for, and as allowed
            )
            if all(_alike(board, asked[k], allowed[k]) for k in (0, 1)):
                break
        else:
            raise DepartureError(
                f"{beyond[0]:g} and {beyond[1]:g} N·m brought {_shown(asked)} counts/s²,"
                f" {within[0]:g} and {within[1]:g} N·m {_shown(allowed)}: both torques are to be"
                f" scaled down together to {large:g} N·m"
            )
        seen.append(f"{name} {_shown(asked)} for {_shown(allowed)}")
    return "twice the largest moves like the largest: " + ", ".join(seen) + " counts/s²"


def _compared(
    talk: Talk, board: KnownBoard, within: Motion, beyond: Motion
) -> tuple[Motion, Motion]:
    """Push with more than the largest, backwards, and with the largest: what each brought."""
    allowed, sound = _acceleration(talk, board, within, PULSE)
    backwards, limited = _acceleration(talk, board, (-beyond[0], -beyond[1]), PULSE)
    _flagged(board, sound, limited)
    return (-backwards[0], -backwards[1]), allowed


def _alike(board: KnownBoard, asked: float, allowed: float) -> bool:
    return abs(allowed) >= LEAST * board.counts and 0.3 < asked / allowed < 1.5


def _flagged(board: KnownBoard, within: HeardState, beyond: HeardState) -> None:
    """Look at the flag of STATEs that answered commands within and beyond the largest."""
    if board.features & acus.FEATURE_LIMITED:
        must(beyond.has(acus.LIMITED), "a command beyond the largest is not said to be limited")
        must(not within.has(acus.LIMITED), "a command within the largest is said to be limited")


def _limited_tensions(talk: Talk, board: KnownBoard) -> str:
    """Pull for one command with more than the largest tension; nothing is left of it after."""
    within, beyond = (board.largest,) * talk.channels, (1.5 * board.largest,) * talk.channels
    sound, limited = talk.ask(channels=within), talk.ask(channels=beyond)
    _flagged(board, sound, limited)
    most = max(talk.ask(channels=beyond).tensions)
    talk.ask()
    must(most <= 1.05 * board.largest, f"the tension came to {most:g} N of {board.largest:g}")
    least = min(talk.ask(channels=(-board.largest,) * talk.channels).tensions)
    talk.ask()
    must(least >= -0.05 * board.largest, f"a negative tension was given: {least:g} N")
    return f"up to {most:g} N of {board.largest:g}"


def _watchdog_stops(talk: Talk, board: KnownBoard) -> str:
    """Push and fall silent for three times the watchdog's time: it may push for one of them."""
    _need_joints(talk)
    channels = (2 * GENTLE * board.largest, -2 * GENTLE * board.largest)
    silent = 3.0 * board.watchdog
    brings, _ = _acceleration(talk, board, channels, 0.4 * board.watchdog)
    _rest(talk)
    before = _speed(talk)
    talk.ask(channels=channels)
    talk.pause(silent)
    after = _speed(talk)
    for a, b, gain in zip(before, after, brings, strict=True):
        most = abs(gain) * board.watchdog
        must(
            abs(b - a) <= 1.5 * most + 0.005 * board.counts,
            f"pushed and left without a command for {silent * 1e3:g} ms, a joint came to"
            f" {b - a:.0f} counts/s; the watchdog's {board.watchdog * 1e3:g} ms bring {most:.0f}:"
            " the motor went on",
        )
    return f"{_shown(after)} counts/s, {_shown(brings)} counts/s² for the watchdog's time"


def _turned(talk: Talk, board: KnownBoard) -> str:
    since, end = len(talk.states), time.monotonic() + WAITS
    wanted = board.counts // 72
    while time.monotonic() < end:
        state = talk.ask(enable=False)
        must(state.error == 0, f"the board reports error {state.error} while it is turned")
        leap = next(leaps(talk.states[-2:], board.counts), None)
        if leap is not None:
            raise DepartureError(f"the counters leapt from {leap[0].counts} to {leap[1].counts}")
        states = talk.states[since:]
        both = [[s.counts[k] for s in states] for k in (0, 1)]
        if all(max(q) - min(q) >= wanted and min(q) < -5 for q in both):
            return f"left {min(both[0])} to {max(both[0])}, right {min(both[1])} to {max(both[1])}"
        talk.pause(0.001)
    raise UnseenError(f"nobody turned both links back and forth by 5 degrees in {WAITS:g} s")


def _zeroed(talk: Talk, board: KnownBoard) -> str:
    """Home where the links were left: not at zero."""
    before = talk.ask(enable=False).counts
    if min(map(abs, before)) <= 20:
        raise UnseenError("the links stood at zero: turn them away from there")
    talk.send(acus.home(board.boot))
    after = talk.ask(enable=False).counts
    must(max(map(abs, after)) <= 20, f"HOME at {before} counts left the counters at {after}")
    return f"from {before} counts to {after}"


def _restarted(talk: Talk, board: KnownBoard) -> str:
    end = time.monotonic() + WAITS
    before = talk.ask(enable=False)
    while time.monotonic() < end:
        talk.send(talk.command())
        talk.hear(0.02, 1)
        state = talk.states[-1]
        if not state.has(acus.GREETED):
            must(not state.has(acus.ENABLED), "a board that was not greeted gives torque")
            must(not state.has(acus.HOMED), "it is still homed after its restart")
            must(state.error == 0, f"it begins with error {state.error}")
            must(state.time < before.time or before.time < 10_000_000, "its clock went on")
            boot = int.from_bytes(talk.hello()[4:8], "little")
            must(boot != board.boot, f"it is still power cycle {boot}")
            return f"power cycle {boot} after {board.boot}"
    raise UnseenError(f"nobody switched the board off and on in {WAITS:g} s")


PUSHES: Final = (
    Inquiry("signs", "a positive torque turns its own joint counter-clockwise", _signs),
    Inquiry("limit", "more than the largest is scaled down, and said", _limited),
    Inquiry("watchdog-stops", "the watchdog stops the motors, not only its flag", _watchdog_stops),
)
TURNS: Final = (
    Inquiry("turned", "counters of turned links go on, below zero too", _turned),
    Inquiry("zeroed", "HOME begins the counters at zero wherever the links are", _zeroed),
)
RESTARTS: Final = (
    Inquiry("restart", "a board that restarts is not greeted, not homed, and says so", _restarted),
)
