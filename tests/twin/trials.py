"""One fault of one part: done, borne, measured, and held against the rules."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from tests.twin.laboratory import Laboratory
from tests.twin.part import BrokenRuleError

LOOP_S = 0.100
"""From here on encoder values are too old for any force [s] (docs/architecture.md)."""

BOARD_S = 0.020
"""The board's own watchdog [s]."""

UNSEEN_S = 0.2 + 1.0 + 0.033 + 0.020
"""A depth is held so long without a picture, then the attempt pauses after a second [s]; a picture
may be on its way, and the trainer looks every 20 ms."""

LATE_S = 0.030
"""How late this computer may look or be woken [s]: what is measured includes it."""

BUSY = r"encoders have not been read for 100 ms|the robot does not answer|the loop has stopped"
"""What ends an attempt beside a robot that was left alone: the loop or its link was not served."""

TRIES, PUSH_A = 4, 0.02
"""So often it is tried to have the motors push, and from when on they do [A]."""

PUSHED_S = 0.2
"""So long the hand has leaned the needle aside before a fault [s]."""

BACK_S = 60.0


@dataclass
class Trial:
    """What was seen of one fault.

    Attributes:
        moment: when it was done [s].
        zero_s: until there was no torque [s]; None where it has to go on.
        said: the words in which it was told.
        back_s: from the moment that the part was there again until it worked [s].
        notes: what else was measured.
        broken: rules that were not kept.
    """

    moment: float = 0.0
    zero_s: float | None = None
    said: str = ""
    back_s: float | None = None
    notes: list[str] = field(default_factory=list)
    broken: list[str] = field(default_factory=list)

    @property
    def words(self) -> str:
        parts = []
        if self.zero_s is not None:
            parts.append(f"no torque after {1e3 * self.zero_s:.0f} ms")
        if self.said:
            parts.append(f"“{self.said}”")
        if self.back_s is not None:
            parts.append(f"back after {self.back_s:.1f} s")
        return "; ".join([*parts, *self.notes, *(f"BROKEN: {one}" for one in self.broken)])

    def zero(self, seconds: float, limit: float, where: str) -> None:
        """Take when the torque ended, and hold it against a limit."""
        self.zero_s = max(self.zero_s or 0.0, seconds)
        if seconds > limit + LATE_S:
            self.broken.append(
                f"{where} had torque for {1e3 * seconds:.0f} ms, {1e3 * limit:.0f} allowed"
            )

    def pushed(self, size: float, unit: str) -> None:
        """Take how hard the motors pushed before; without any the trial would show nothing."""
        self.notes.append(f"{size:.2f} {unit} before")
        if not size > 0.0:
            self.broken.append("nothing pushed before it")

    def hear(self, words: list[str], wanted: str) -> None:
        """Look for what has to be said."""
        for one in words:
            if re.search(wanted, one):
                self.said = one if len(one) <= 200 else one[:197] + "…"
                return
        self.broken.append(f"nobody said {wanted!r}")


def run_trial(lab: Laboratory, name: str, fault: str) -> Trial:
    """Do a fault to a part, and see what comes of it."""
    trial = Trial()
    try:
        TRIALS[name](lab, name, fault, trial)
        for place in (lab.nodes, lab.folder):
            trial.said = trial.said.replace(str(place), "…")
    except (BrokenRuleError, OSError) as error:
        trial.broken.append(str(error))
    return trial


def _begin(
    lab: Laboratory, name: str, fault: str, trial: Trial
) -> tuple[float, Callable[[], None]]:
    """Do the fault; return when, and what makes it good again."""
    part = lab.parts[name]
    moment = trial.moment = time.monotonic()
    if fault == "killed":
        part.kill()
        return moment, part.start
    if fault == "hung":
        part.hang()
        return moment, part.go_on
    part.stop()
    return moment, part.start


def _again(lab: Laboratory, since: float, trial: Trial) -> None:
    """Wait until an attempt goes on."""
    began = lab.trainer.await_kind("began", since, BACK_S)
    trial.notes.append(f"next attempt after {began['t'] - since:.1f} s")


def _lean(lab: Laboratory) -> None:
    """Have the needle leaned aside, so that the motors push.

    Raises:
        BrokenRuleError: if they do not, also not in later attempts.
    """
    for _ in range(TRIES):
        with lab.trainer.board:
            lab.robot.pull()
            time.sleep(PUSHED_S)
            if max(map(abs, lab.robot.torques())) > PUSH_A:
                return
            lab.robot.give_way()
        lab.inserting()
    raise BrokenRuleError(
        f"in {TRIES} attempts the motors did not push a needle that was leaned aside"
    )


def _robot(lab: Laboratory, name: str, fault: str, trial: Trial) -> None:
    lab.inserting()
    if fault == "hung":
        _frozen(lab, trial)
        lab.inserting()
    _lean(lab)
    with lab.trainer.board:
        if fault == "restarted":  # its power goes, and comes again at once
            moment = trial.moment = time.monotonic()
            good = bool
            lab.robot.order("reset")
        else:
            moment, good = _begin(lab, name, fault, trial)
    time.sleep(1.0)
    last, before = lab.trainer.quiet(moment)
    trial.zero(last, LOOP_S, "the loop")
    trial.pushed(before, "N·m")
    at = time.monotonic()
    with lab.trainer.board:
        good()
        if fault == "hung":
            went = time.monotonic()
            lab.robot.give_way()
            with lab.robot.watched() as watch:
                pass
            trial.zero(max(0.0, watch.last - went), BOARD_S, "the board that goes on")
    found = lab.trainer.find(
        lambda one: one["kind"] == "event" and one["words"].startswith("connected to"),
        moment, BACK_S, "the robot's link",
    )  # fmt: skip
    trial.back_s = max(0.0, found["t"] - at)
    _again(lab, at, trial)
    wanted = r"is gone; looking for it" if fault != "restarted" else r"no force|not homed|homed"
    trial.hear(lab.words_after(moment), wanted)


def _frozen(lab: Laboratory, trial: Trial) -> None:
    """Let the board's main program hang, while its timer goes on."""
    for _ in range(TRIES):
        _lean(lab)
        with lab.trainer.board:
            with lab.robot.watched() as watch:
                time.sleep(0.05)
                moment = time.monotonic()
                lab.robot.freeze()
            time.sleep(0.7)
            lab.robot.order("freeze 0")
            lab.robot.give_way()
        lab.trainer.await_kind("began", moment, BACK_S)
        if watch.last > moment:  # a busy computer may have cut the force just before
            break
        lab.inserting()
    silent = max(0.0, watch.last - moment)
    trial.zero(silent, BOARD_S, "the board whose program hangs")
    trial.notes.append(f"its motors, with its program hanging: {1e3 * silent:.0f} ms")


def _trainer(lab: Laboratory, name: str, fault: str, trial: Trial) -> None:
    lab.inserting()
    _lean(lab)
    with lab.trainer.board:
        with lab.robot.watched() as watch:
            time.sleep(0.05)
            moment, good = _begin(lab, name, fault, trial)
            ended = time.monotonic()
        since = ended if fault == "restarted" else moment
        trial.zero(max(0.0, watch.last - since), BOARD_S, "the board")
        lab.robot.give_way()
    trial.pushed(watch.most, "A")
    time.sleep(2.0 if fault == "hung" else 0.5)
    at = time.monotonic()
    good()
    if fault == "hung":
        trial.hear(_heard(lab, at, r"stood still|slept|aborted|paused|no force"), r"")
        trial.back_s = lab.trainer.await_kind("state", at, BACK_S)["t"] - at
    else:
        trial.back_s = lab.trainer.await_kind("ready", at, BACK_S)["t"] - at
    if fault == "killed":
        one = lab.trainer.await_kind("recovered", at, BACK_S)
        trial.said = f"recovered {one['id']}"
        trial.notes.append(f"closed after {one['t'] - at:.0f} s")
    if fault == "restarted":
        trial.hear(lab.words_after(moment), r"the trainer was closed|aborted")
    _again(lab, at, trial)


def _heard(lab: Laboratory, since: float, wanted: str) -> list[str]:
    lab.trainer.find(
        lambda one: one["kind"] in ("words", "event") and bool(re.search(wanted, one["words"])),
        since, 20.0, f"a word like {wanted!r}",
    )  # fmt: skip
    return [one for one in lab.words_after(since) if re.search(wanted, one)]


def _camera(lab: Laboratory, name: str, fault: str, trial: Trial) -> None:
    lab.inserting()
    _lean(lab)
    moment, good = _begin(lab, name, fault, trial)
    time.sleep(2.5)
    if name == "cameras":
        last, before = lab.trainer.quiet(moment)
        trial.zero(last, UNSEEN_S, "the loop")
        trial.pushed(before, "N·m")
    with lab.trainer.board:
        lab.robot.give_way()
    at = time.monotonic()
    good()
    seen = lab.trainer.find(
        lambda one: one["kind"] == "event" and "delivers pictures again" in one["words"],
        at, BACK_S, "a camera that delivers again",
    )  # fmt: skip
    trial.back_s = seen["t"] - at
    trial.hear(lab.words_after(moment), r"camera (left|right)|(left|right) camera")
    if name == "cameras":
        went = lab.trainer.find(
            lambda one: one["kind"] == "event" and "the attempt goes on" in one["words"],
            at, 20.0, "the attempt that goes on",
        )  # fmt: skip
        trial.notes.append(f"the same attempt goes on after {went['t'] - at:.1f} s")
    else:
        _undisturbed(lab, moment, trial)


def _undisturbed(lab: Laboratory, since: float, trial: Trial) -> None:
    """No attempt was aborted for it."""
    told = [one for one in lab.trainer.said if one["t"] >= since and one["kind"] == "event"]
    aborted = [one["words"] for one in told if one["about"] == "abort"]
    other = [one for one in aborted if not re.search(BUSY, one)]
    if other:
        trial.broken.append(f"an attempt was aborted: {other[0]}")
    elif aborted:
        trial.notes.append(f"this computer was too busy for {len(aborted)} attempts")
    else:
        trial.notes.append("the attempt went on")


def _listener(lab: Laboratory, name: str, fault: str, trial: Trial) -> None:
    lab.inserting()
    part = lab.listeners[name]
    moment, good = _begin(lab, name, fault, trial)
    time.sleep(3.0)
    at = time.monotonic()
    good()
    end = at + BACK_S
    while time.monotonic() < end:
        one = part.last()
        fresh = one is not None and one["at"] > at + lab.wall
        if fresh and one["at"] - _stamp(one) < 0.25:
            trial.back_s = one["at"] - lab.wall - at
            break
        time.sleep(0.02)
    else:
        trial.broken.append("no pose came again")
    if fault != "hung":
        trial.hear(lab.words_after(moment), r"[\d.:]+ is (gone|dropped)")
    _undisturbed(lab, moment, trial)


def _stamp(line: dict) -> float:
    if "stamp" in line:
        return line["stamp"]
    header = line["message"].get("header") or line["message"].get("transforms", [{}])[0].get(
        "header"
    )
    return header["stamp"]["sec"] + 1e-9 * header["stamp"]["nanosec"] if header else 0.0


def _receiver(lab: Laboratory, name: str, fault: str, trial: Trial) -> None:
    """Archive or university: gone while something is to be sent."""
    lab.inserting()
    if name == "university" and fault == "killed":
        moment = time.monotonic()
        lab.university.kill_in_answer()  # it stores what comes next, and dies before it says so
        end = moment + BACK_S
        while not lab.university.is_dead and time.monotonic() < end:
            time.sleep(0.05)
        lab.university.kill()
        good = lab.university.start
    else:
        moment, good = _begin(lab, name, fault, trial)
        if name == "archive":
            lab.courier.send_again(name)
    failed = lab.courier.find(name, False, moment, BACK_S)
    if failed is None:
        some = [one for one in lab.courier.sendings if one.to == name and one.ended > moment]
        failed = next((one for one in some if not one.done), None)
    if failed is None:
        trial.broken.append("no sending failed while it was away")
    else:
        trial.hear([failed.words], r".+")
    at = time.monotonic()
    good()
    done = lab.courier.find(name, True, at, BACK_S)
    if done is None:
        trial.broken.append("what waited was not sent")
    else:
        trial.back_s = done.ended - at
    _undisturbed(lab, moment, trial)


TRIALS = {
    "robot": _robot, "trainer": _trainer, "left camera": _camera, "cameras": _camera,
    "slicer": _listener, "gui": _listener, "archive": _receiver, "university": _receiver,
}  # fmt: skip
