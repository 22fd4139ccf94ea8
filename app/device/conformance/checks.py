"""What every board can be asked while its motors give no torque: docs/protocol.md, rule by rule.

A check takes a `Talk` and what INFO said, and returns what it saw; a departure from the protocol is
raised. Torques are zero throughout: nothing moves.
"""

import math
import struct
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from app.device.conformance.talk import ANSWER, DepartureError, HeardState, Talk, UnseenError
from app.device.links import acus_protocol as acus
from app.device.links import cable_protocol as cables
from app.device.links import framing
from app.device.links.link import BoardError


@dataclass(frozen=True, slots=True)
class KnownBoard:
    """What is known of a board that answered: fields of its INFO, and of the profile.

    Attributes:
        boot, counts, largest, watchdog, features: as in INFO; `watchdog` in seconds.
        rate_hz: of the profile's loop.
        watchdog_allowed: of the profile [s].
        is_terminal: whether another program is at the other end of the port.
    """

    boot: int
    counts: int
    largest: float
    watchdog: float
    features: int
    rate_hz: float
    watchdog_allowed: float
    is_terminal: bool


@dataclass(frozen=True, slots=True)
class Inquiry:
    """One rule.

    Attributes:
        name: of the check.
        rule: what docs/protocol.md asks for.
        run: looks; returns what it saw, or raises `DepartureError` or `UnseenError`.
    """

    name: str
    rule: str
    run: Callable[[Talk, KnownBoard], str]


def must(holds: bool, otherwise: str) -> None:
    """Raise `DepartureError` with words unless something holds."""
    if not holds:
        raise DepartureError(otherwise)


def has(state: HeardState, enabled: bool, error: int = 0, after: str = "") -> None:
    """Raise `DepartureError` unless a STATE is enabled or not, and has an error or none."""
    must(
        state.has(acus.ENABLED) is enabled and state.error == error,
        f"{after}: STATE says {'enabled' if state.has(acus.ENABLED) else 'not enabled'}, error"
        f" {state.error}; it is to say {'enabled' if enabled else 'not enabled'}, error {error}",
    )


def _info(talk: Talk, board: KnownBoard) -> str:
    first, second = talk.hello(), talk.hello()
    must(first == second, "two HELLOs got two different INFOs in one power cycle")
    must(len(first) == acus.INFO_BYTES, f"INFO has {len(first)} bytes, not {acus.INFO_BYTES}")
    for name, field in (("serial number", first[18:34]), ("profile", first[34:50])):
        text = field.rstrip(b"\0")
        good = all(32 < byte < 127 for byte in text)
        must(good, f"the {name} in INFO is {field!r}: ASCII, padded with zeros")
    must(math.isfinite(board.largest) and board.largest > 0.0, f"largest is {board.largest}")
    must(
        0.0 < board.watchdog <= board.watchdog_allowed + 1e-9,
        f"INFO's watchdog waits {board.watchdog * 1e3:g} ms, the profile allows"
        f" {board.watchdog_allowed * 1e3:g}",
    )
    must(
        board.is_terminal or not board.features & acus.FEATURE_EMULATED,
        "INFO says that a program plays the board: firmware on hardware does not say so",
    )
    return f"power cycle {board.boot}, twice the same"


def _other_version(talk: Talk, board: KnownBoard) -> str:
    for version in (talk.version + 1, 77, 0):
        info = talk.hello(version)
        must(info[1] == talk.version, f"HELLO of version {version} got an INFO of {info[1]}")
        state = talk.ask()
        must(not state.has(acus.GREETED), f"HELLO of version {version} counts as a greeting")
        has(state, False, after="a command with enable before the greeting")
    talk.hello()
    has(talk.ask(), True, after="a command with enable after the greeting")
    return "named its own version, and was greeted in that alone"


def _greeting_stops(talk: Talk, board: KnownBoard) -> str:
    has(talk.ask(), True, after="a command with enable")
    talk.hello()
    talk.pause(board.watchdog + 0.01)
    state = talk.ask(enable=False)
    must(not state.has(acus.TRIPPED), "HELLO left the motors on: the watchdog tripped after it")
    talk.send(acus.home(board.boot ^ 1))
    has(talk.ask(), False, BoardError.HOME_REFUSED, "HOME in another power cycle")
    talk.hello()
    has(talk.ask(), True, after="a command after HELLO, which clears an error")
    return "motors off and error cleared by HELLO"


def _damaged(talk: Talk, board: KnownBoard) -> str:
    frame = talk.command()
    for k in range(len(frame) - 1):
        for bit in (1, 0x40):
            if frame[k] ^ bit:
                damaged = bytearray(frame)
                damaged[k] ^= bit
                talk.unanswered(bytes(damaged), f"a COMMAND with byte {k} damaged")
    for end in (1, 5, len(frame) - 2):
        talk.unanswered(frame[:end] + b"\0", f"the first {end} bytes of a COMMAND")
    talk.ask()
    return f"{2 * len(frame)} damaged frames were dropped"


def _in_step(talk: Talk, board: KnownBoard) -> str:
    for count in (1, 40, 67, 68, 69, 100, 300, 1500):
        for byte in (0x55, 0xFF, 0x01):
            talk.send(bytes([byte]) * count + b"\0")
            talk.ask()
            talk.unanswered(
                bytes([byte]) * count + talk.command(),
                f"a COMMAND behind {count} bytes 0x{byte:02x} without a zero",
            )
            talk.ask()
    talk.send(b"\0" * 20)
    talk.ask()
    return "in step one frame after any garbage"


def _unknown(talk: Talk, board: KnownBoard) -> str:
    own = acus.COMMAND if talk.version == acus.VERSION else cables.COMMAND
    length = 4 + 4 * talk.channels
    body = struct.pack("<BHf", acus.ENABLE, 7, 0.0) + bytes(60)
    talk.ask(enable=False)
    for kind in (
        0,
        *range(5, 16),
        0x41,
        0x7F,
        0x81,
        0x82,
        0x84,
        0xFF,
        acus.COMMAND,
        cables.COMMAND,
    ):
        for count in {length, 12, 20}:
            if kind != own or count != length:
                message = bytes([kind]) + body[: count - 1]
                talk.send(framing.frame(message))
    for count in (*range(1, length), *range(length + 1, 60)):
        talk.send(framing.frame(bytes([own]) + body[: count - 1]))
    for message in (bytes([acus.HELLO]), bytes([acus.HOME]), struct.pack("<BIB", 3, 0, 0)):
        talk.send(framing.frame(message))
    talk.unanswered(b"", "a message of unknown type or other length")
    state = talk.ask(enable=False)
    must(state.error == 0, f"unknown messages made error {state.error}")
    return "ignored"


def _pieces(talk: Talk, board: KnownBoard) -> str:
    frame = talk.command()
    for byte in frame[:-1]:
        talk.send(bytes([byte]))
        talk.pause(0.0005)
    talk.send(frame[-1:])
    must(len(talk.hear(ANSWER, 1)) == 1, "a COMMAND that came byte by byte got no answer")
    before = len(talk.states)
    frames = [talk.command() for _ in range(8)]
    talk.send(b"".join(frames))
    talk.hear(ANSWER, 8)
    got = [state.sequence for state in talk.states[before:]]
    wanted = [(talk.sequence - 7 + k) & 0xFFFF for k in range(8)]
    must(got == wanted, f"of eight commands in one piece {len(got)} were answered: {got}")
    return "byte by byte, and eight at once"


def _sequence(talk: Talk, board: KnownBoard) -> str:
    for sequence in (0, 1, 254, 255, 256, 257, 511, 4660, 0x0100, 0xFF00, 32767, 32768, 65535, 0):
        talk.sequence = (sequence - 1) & 0xFFFF
        talk.ask()
    return "each STATE has its command's number, up to 65535 and 0 again"


def _clock(talk: Talk, board: KnownBoard) -> str:
    first = talk.ask()
    talk.pause(0.5)
    second = talk.ask()
    theirs = ((second.time - first.time) & 0xFFFFFFFF) * 1e-6
    ours = second.heard - first.heard
    must(
        abs(theirs - ours) < 0.02 * ours + 0.02,
        f"the board's clock went on by {theirs:.6f} s in {ours:.3f} s: it is to count microseconds",
    )
    return f"{theirs * 1e3:.1f} ms in {ours * 1e3:.1f} ms"


def _unasked(talk: Talk, board: KnownBoard) -> str:
    talk.ask()
    heard = talk.hear(0.5, 1)
    must(not heard, "something came although nothing was sent")
    return "silent for half a second"


def _enable(talk: Talk, board: KnownBoard) -> str:
    for _ in range(2):
        has(talk.ask(), True, after="a command with enable")
        for flags in (0, 2, 4, 0x80, 0xFE):
            has(talk.ask(enable=False, flags=flags), False, after=f"a command with flags {flags}")
    return "by bit 0 alone"


def _not_finite(talk: Talk, board: KnownBoard) -> str:
    for bad in (math.nan, -math.nan, math.inf, -math.inf):
        for k in range(talk.channels):
            channels = [0.0] * talk.channels
            channels[k] = bad
            after = f"{bad} in channel {k + 1}"
            has(talk.ask(), True, after="a good command")
            has(talk.ask(channels=tuple(channels)), False, 1, after)
            has(talk.ask(enable=bool(k % 2)), bool(k % 2), 0, f"a good command after {after}")
    return f"error 1 by each of {talk.channels} channels, until the next good command"


def _home_refused(talk: Talk, board: KnownBoard) -> str:
    homed = talk.ask(enable=False).has(acus.HOMED)
    for boot in (board.boot ^ 1, board.boot ^ 0x80000000, board.boot ^ 0x100):
        talk.send(acus.home(boot))
        state = talk.ask(enable=False)
        has(state, False, 2, f"HOME in power cycle {boot}, which is {board.boot},")
        must(state.has(acus.HOMED) is homed, "a HOME of another power cycle was obeyed")
    has(talk.ask(), False, 2, "a good command while HOME is refused")
    talk.hello()
    has(talk.ask(), True, after="a command with enable after HELLO")
    talk.send(acus.home(board.boot))
    has(talk.ask(), False, 2, "HOME while enabled, then a command with enable")
    talk.hello()
    return "in another power cycle and while enabled; error 2 stays"


def _home(talk: Talk, board: KnownBoard) -> str:
    talk.send(acus.home(board.boot ^ 1))
    before = talk.ask(enable=False)
    talk.send(acus.home(board.boot))
    state = talk.ask(enable=False)
    has(state, False, 0, "a HOME that is obeyed, after one that was refused")
    must(state.has(acus.HOMED), "after HOME the STATE does not say homed")
    must(
        max(map(abs, state.counts)) <= max(4, board.counts // 500),
        f"after HOME the counters are at {state.counts}, not at zero",
    )
    return f"counters at {before.counts} before, at {state.counts} after"


def _gap(talk: Talk, seconds: float, between: Callable[[], None] | None = None) -> tuple[int, bool]:
    """Enable, leave the board alone, ask: the gap by its own clock [µs], and whether it tripped."""
    first = talk.ask()
    has(first, True, after="a command with enable")
    must(not first.has(acus.TRIPPED), "a command with enable left the watchdog's flag")
    end = time.monotonic() + seconds
    while between is not None and time.monotonic() < end - 0.001:
        between()
    talk.pause(end - time.monotonic())
    if between is not None:
        talk.send(b"\0")  # whatever that was, it is over
    second = talk.ask(enable=False)
    return (second.time - first.time) & 0xFFFFFFFF, second.has(acus.TRIPPED)


def _watchdog(talk: Talk, board: KnownBoard) -> str:
    gaps = [_gap(talk, k * board.watchdog) for k in _GAPS]
    on = max((gap for gap, tripped in gaps if not tripped), default=0)
    off = min((gap for gap, tripped in gaps if tripped), default=0)
    must(off > 0, "it did not trip within twice its time")
    must(
        on <= board.watchdog * 1e6,
        f"the motors were still on {on / 1e3:.1f} ms after the last command with enable, the"
        f" watchdog's time is {board.watchdog * 1e3:g} ms",
    )
    return f"on after {on / 1e3:.1f} ms, off after {off / 1e3:.1f} ms"


_GAPS: Final = (0.2, 0.5, 0.7, 0.8, 0.85, 0.9, 0.95, 1.0, 1.02, 1.05, 1.1, 1.2, 1.4, 2.0)


def _watchdog_deaf(talk: Talk, board: KnownBoard) -> str:
    damaged = bytearray(talk.command())
    damaged[5] ^= 0x20
    other = cables.COMMAND if talk.version == acus.VERSION else acus.COMMAND
    feeds = (
        ("garbage", b"\x55" * 40),
        ("zeros", b"\0\0\0"),
        ("a damaged COMMAND", bytes(damaged)),
        ("an unknown message", framing.frame(bytes([other, acus.ENABLE]) + bytes(9))),
    )
    for what, feed in feeds:

        def send(feed: bytes = feed) -> None:
            talk.send(feed)
            talk.pause(0.001)

        gap, tripped = _gap(talk, 1.5 * board.watchdog, send)
        must(tripped, f"{what} kept the motors on for {gap / 1e3:.1f} ms: no COMMAND was among it")
    return "garbage, damaged and unknown messages do not feed it"


def _watchdog_ends(talk: Talk, board: KnownBoard) -> str:
    must(_gap(talk, 1.5 * board.watchdog)[1], "it did not trip")
    state = talk.ask(enable=False)
    must(state.has(acus.TRIPPED), "a command without enable cleared the watchdog's flag")
    talk.ask()
    talk.pause(1.5 * board.watchdog)
    talk.send(acus.home(board.boot))  # obeyed only with the motors off
    state = talk.ask(enable=False)
    must(state.error == 0, "HOME was refused after the watchdog had tripped: the motors were on")
    state = talk.ask()
    has(state, True, after="a command with enable after the watchdog")
    must(not state.has(acus.TRIPPED), "a command with enable left the watchdog's flag")
    talk.ask(enable=False)
    talk.pause(1.5 * board.watchdog)
    must(not talk.ask(enable=False).has(acus.TRIPPED), "it tripped although the motors were off")
    return "motors off when it trips; the next command with enable ends it"


def _stream(talk: Talk, board: KnownBoard) -> str:
    """Commands at the loop's rate; every answer has to come once, in its order."""
    count, tick = int(2.0 * board.rate_hz), 1.0 / board.rate_hz
    talk.hear(0.001)
    before, damaged = len(talk.states), talk.damaged
    sent: dict[int, float] = {}
    begin = time.monotonic()
    for k in range(count):
        frame = talk.command()
        sent[talk.sequence] = talk.send(frame)
        talk.hear(max(begin + (k + 1) * tick - time.monotonic(), 1e-5))
    talk.hear(ANSWER)
    states = talk.states[before:]
    answered = [state.sequence for state in states]
    lost = len(sent) - len(sent.keys() & set(answered))
    twice = len(answered) - len(set(answered))
    swapped = sum(((b - a) & 0xFFFF) >= 0x8000 for a, b in pairwise(answered))
    trips = sorted(state.heard - sent[state.sequence] for state in states if state.sequence in sent)
    seen = f"{count} commands: {lost} lost, {twice} twice, {swapped} out of order"
    must(not (lost or twice or swapped), f"{seen}, {talk.damaged - damaged} answers damaged")
    backwards = sum(((b.time - a.time) & 0xFFFFFFFF) >= 1 << 31 for a, b in pairwise(states))
    must(not backwards, f"the board's clock went backwards {backwards} times")
    middle = trips[len(trips) // 2]
    must(
        middle < tick,
        f"{seen}; half of the answers took more than {middle * 1e3:.2f} ms, a tick is"
        f" {tick * 1e3:g} ms",
    )
    return f"{seen}; half within {middle * 1e3:.2f} ms, all within {trips[-1] * 1e3:.1f} ms"


def leaps(states: list[HeardState], counts_per_turn: int) -> Iterator[list[HeardState]]:
    """Return pairs of successive STATEs whose counts are further apart than 3°/ms and a count."""
    for a, b in pairwise(states):
        elapsed = ((b.time - a.time) & 0xFFFFFFFF) * 1e-3  # [ms]
        most = min(3.0 * max(elapsed, 1.0), 180.0) / 360.0 * counts_per_turn + 1.0
        if any(abs(q - p) > most for p, q in zip(a.counts, b.counts, strict=True)):
            yield [a, b]


def _continuous(talk: Talk, board: KnownBoard) -> str:
    since = len(talk.states)
    for _ in range(200):
        talk.ask(enable=False)
    leap = next(leaps(talk.states[since:], board.counts), None)
    if leap is not None:
        raise DepartureError(f"the counters leapt from {leap[0].counts} to {leap[1].counts}")
    span = [
        max(s.counts[k] for s in talk.states) - min(s.counts[k] for s in talk.states)
        for k in (0, 1)
    ]
    if max(span) < board.counts // 360:
        raise UnseenError("the joints stood still: run it with --turn and move the links by hand")
    return f"{span[0]} and {span[1]} counts without a leap"


CHECKS: Final = (
    Inquiry("info", "INFO: fixed in a power cycle, texts padded, a watchdog in time", _info),
    Inquiry("versions", "HELLO of another version is answered, and greets nobody", _other_version),
    Inquiry("greeting", "HELLO stops the motors and clears the error", _greeting_stops),
    Inquiry("damaged", "a frame with a wrong CRC is dropped", _damaged),
    Inquiry("in-step", "in step again one frame after any garbage", _in_step),
    Inquiry("unknown", "messages of unknown type or other length are ignored", _unknown),
    Inquiry("pieces", "a frame may come in pieces, and several in one", _pieces),
    Inquiry("sequence", "STATE has the sequence number of its command", _sequence),
    Inquiry("clock", "time since power-up in microseconds", _clock),
    Inquiry("unasked", "nothing is sent unasked", _unasked),
    Inquiry("stream", "every command is answered once, in order, within a tick", _stream),
    Inquiry("enable", "bit 0 enables, and nothing else", _enable),
    Inquiry("not-finite", "what is not finite is reported, and gives no torque", _not_finite),
    Inquiry(
        "home-refused", "HOME is refused while enabled and in another power cycle", _home_refused
    ),
    Inquiry("home", "HOME begins the counters at zero and ends error 2", _home),
    Inquiry("watchdog", "torque zero when no command comes for its time", _watchdog),
    Inquiry("watchdog-fed", "only a valid COMMAND with enable feeds the watchdog", _watchdog_deaf),
    Inquiry("watchdog-ends", "the next valid command with enable ends it", _watchdog_ends),
    Inquiry("counters", "counters go on without a leap", _continuous),
)
"""In the order in which they are done; before each the board is greeted."""
