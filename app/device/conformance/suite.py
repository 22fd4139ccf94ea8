"""Run what a board is asked, and say what it kept, what it broke and what could not be seen."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, dataclass
from datetime import datetime
from typing import Any, Final

from app.core.messages import sentence
from app.device.conformance.checks import CHECKS, Inquiry, KnownBoard
from app.device.conformance.motion import PUSHES, RESTARTS, TURNS
from app.device.conformance.talk import DepartureError, Talk, UnseenError
from app.device.errors import BoardVersionError, LinkError, LoopError
from app.device.link_test import measure_link
from app.device.links import acus_protocol as acus
from app.device.links import cable_protocol as cables
from app.device.links.link import BoardError, BoardInfo, describe_error
from app.device.links.port import Port
from app.device.links.protocols import AcusSpeech
from app.mechanisms.profile import DeviceProfile, Protocol

KEPT: Final = "kept"
BROKEN: Final = "broken"
UNSEEN: Final = "not seen"


@dataclass(frozen=True, slots=True)
class Finding:
    """What a check found.

    Attributes:
        check: its name.
        rule: what docs/protocol.md asks for.
        outcome: `kept`, `broken` or `not seen`.
        seen: what was seen, what departs from the rule, or what would show it.
    """

    check: str
    rule: str
    outcome: str
    seen: str


@dataclass(frozen=True, slots=True)
class Conformance:
    """What a board was found to be.

    Attributes:
        port: where it was.
        profile: for which it was asked.
        board: who it says that it is.
        findings: of every check.
    """

    port: str
    profile: str
    board: BoardInfo
    findings: tuple[Finding, ...]

    @property
    def good(self) -> bool:
        """Return whether no rule is broken."""
        return all(finding.outcome != BROKEN for finding in self.findings)

    @property
    def verdict(self) -> str:
        """One sentence: how many rules are kept, broken and not seen."""
        count = [
            sum(one.outcome == kind for one in self.findings) for kind in (KEPT, BROKEN, UNSEEN)
        ]
        kept, broken, unseen = count
        if self.good:
            return sentence(
                "the board conforms: {kept} rules kept, {unseen} not seen", kept=kept, unseen=unseen
            )
        return sentence(
            "the board does not conform: {broken} rules broken, {kept} kept, {unseen} not seen",
            broken=broken,
            kept=kept,
            unseen=unseen,
        )

    def document(self) -> dict[str, Any]:
        """Return it JSON-ready."""
        return asdict(self) | {"good": self.good, "verdict": self.verdict}

    def lines(self) -> list[str]:
        """Return it for people."""
        board = self.board
        name, serial = board.profile or self.profile, board.serial or "none"
        return [
            f"{name} on {self.port}: serial number {serial}, firmware {board.firmware},"
            f" {board.protocol}, {board.kind}",
            *(f"{one.outcome:<9} {one.check:<15} {one.rule}: {one.seen}" for one in self.findings),
            self.verdict,
        ]

    def report(self, when: datetime) -> str:
        """Return it as a page of text to keep beside the board."""
        head = [f"Conformance of a board with docs/protocol.md, {when:%Y-%m-%d %H:%M}", ""]
        return "\n".join([*head, *self.lines(), ""])


def conform(
    path: str,
    profile: DeviceProfile,
    push: bool = False,
    turn: bool = False,
    restart: bool = False,
    tell: Callable[[str], None] = lambda _: None,
) -> Conformance:
    """Ask a board everything; its motors give no torque unless it may `push`.

    Args:
        path: of its port.
        profile: of its robot.
        push: give torques, up to the largest for milliseconds: the arms are free.
        turn: watch both links turned by a hand.
        restart: watch the board switched off and on.
        tell: called with each line for whoever stands there.

    Raises:
        LinkError: if nobody answers in this protocol and version, the board reports an error that
            only mending ends, or it is homed: the test would take that away.
    """
    if profile.wire.protocol is not Protocol.ACUS:
        raise LinkError(
            sentence(
                "the profile {profile} speaks {protocol}; what can be held against docs/protocol.md"
                " is Acus' own protocol",
                profile=profile.name,
                protocol=profile.wire.protocol,
            )
        )
    version = acus.VERSION if profile.tension_range is None else cables.VERSION
    port = Port(path, profile.wire.baud)
    port.open()
    try:
        talk = Talk(port, version)
        info = _greeted(talk, port, profile)
        board = _known(talk, port, profile)
        _sound(talk, info, port.is_pseudo_terminal)
        findings = [_ask(check, talk, board) for check in CHECKS]
        for wanted, checks, what in _ASIDE:
            if {"push": push, "turn": turn, "restart": restart}[wanted]:
                tell(what)
                findings += [_ask(check, talk, board) for check in checks]
            else:
                without = f"only with --{wanted}"
                findings += [Finding(one.name, one.rule, UNSEEN, without) for one in checks]
    finally:
        port.close()
    return Conformance(path, profile.name, info, (*findings, _loop(path, profile)))


_ASIDE: Final = (
    ("turn", TURNS, "turn both links by hand, a few degrees to either side, and leave them aside"),
    ("push", PUSHES, "the arms move now: keep hands away"),
    ("restart", RESTARTS, "switch the board off and on again"),
)


def _greeted(talk: Talk, port: Port, profile: DeviceProfile) -> BoardInfo:
    """Greet like the program; a board whose INFO has rubbish for texts is asked all the same."""
    try:
        return AcusSpeech(profile).greet(port.exchange)
    except BoardVersionError:
        raise
    except LinkError:
        with suppress(DepartureError):
            info = acus.read_info(talk.hello(), talk.version)[0]
            if not info.profile.isascii():
                return info
        raise


def _known(talk: Talk, port: Port, profile: DeviceProfile) -> KnownBoard:
    info = talk.hello()
    _, counts, largest, watchdog = acus.read_info(info, talk.version)
    return KnownBoard(
        boot=int.from_bytes(info[4:8], "little"),
        counts=counts,
        largest=largest,
        watchdog=watchdog,
        features=info[16],
        rate_hz=profile.loop.rate_hz,
        watchdog_allowed=profile.wire.watchdog_ms * 1e-3,
        is_terminal=port.is_pseudo_terminal,
    )


def _sound(talk: Talk, info: BoardInfo, is_terminal: bool) -> None:
    """Refuse a board of which nothing can be found out, or that a test would spoil."""
    talk.send(talk.command(enable=False))
    talk.hear(0.1, 1)
    if not talk.states:
        return  # the checks say it
    state = talk.states[-1]
    if state.error >= BoardError.ENCODER:
        raise LinkError(
            sentence(
                "the board reports error {board_error}, {meaning}; then test again",
                board_error=state.error,
                meaning=describe_error(state.error),
            )
        )
    if state.has(acus.HOMED) and not is_terminal:
        raise LinkError(
            sentence(
                "the robot of the board {serial} is homed, and this test homes it anew wherever it"
                " stands: switch the board off and on, test it, and home it then",
                serial=info.serial,
            )
        )


def _ask(check: Inquiry, talk: Talk, board: KnownBoard) -> Finding:
    try:
        talk.send(b"\0")
        talk.hello()
        return Finding(check.name, check.rule, KEPT, check.run(talk, board))
    except DepartureError as error:
        return Finding(check.name, check.rule, BROKEN, str(error))
    except UnseenError as error:
        return Finding(check.name, check.rule, UNSEEN, str(error))
    finally:
        talk.hear(0.02)


def _loop(path: str, profile: DeviceProfile) -> Finding:
    """Let the program's own loop drive it, compiled and without a pause."""
    rule = "the program's loop loses no answer"
    try:
        link = measure_link(path, profile, 2.0)
    except LinkError as error:
        return Finding("loop", rule, BROKEN, str(error))
    except LoopError as error:  # of this computer
        return Finding("loop", rule, UNSEEN, str(error))
    seen = f"{link.lost} of {link.commands} lost, {link.errors} damaged, {link.late} late"
    return Finding("loop", rule, KEPT if link.lost == 0 else BROKEN, seen)
