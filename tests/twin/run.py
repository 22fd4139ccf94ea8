"""A whole run: an exercise again and again, the faults in turn, and the comparison at the end."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from app.session.interrupted import is_cut_off
from tests.twin.agreement import Agreement, Track, heard, of_gui, of_slicer, track_of
from tests.twin.laboratory import Laboratory
from tests.twin.part import BrokenRuleError
from tests.twin.trials import Trial, run_trial

SILENT_S = 300.0
"""What goes out after attempts is given up when no command has done its work for so long [s]."""
LOST_S = 1.0
"""A program that is killed loses so much of its record at most [s] (docs/sessions.md)."""


@dataclass
class Outcome:
    """What came of a run."""

    faults: Sequence[str]
    agrees: dict[str, str] = field(default_factory=dict)
    trials: dict[str, dict[str, Trial]] = field(default_factory=dict)
    broken: list[str] = field(default_factory=list)
    attempts: int = 0

    def table(self) -> str:
        """Return the table, as Markdown."""
        lines = [f"| part | agrees within | {' | '.join(self.faults)} |"]
        lines.append("|---" * (2 + len(self.faults)) + "|")
        for part, some in self.trials.items():
            cells = [some[fault].words if fault in some else "–" for fault in self.faults]
            lines.append(f"| {part} | {self.agrees.get(part, '–')} | {' | '.join(cells)} |")
        return "\n".join(lines)


class Twin:
    """One run.

    Args:
        parts: which have faults; listeners and receivers that are not named are not there.
        besides: which are there without faults.
        faults: of `part.FAULTS`, in their order.
        seed: of the hand.
        calm: time before the first fault [s].
        tell: gets a line for each thing that is done.
    """

    def __init__(
        self, parts: Sequence[str], faults: Sequence[str], seed: int, calm: float,
        tell: Callable[[str], None] = lambda _: None, besides: Sequence[str] = (),
    ) -> None:  # fmt: skip
        self._parts, self._faults, self._seed, self._calm = parts, faults, seed, calm
        self._there = frozenset({*parts, *besides})
        self._tell = tell
        self.outcome = Outcome(faults)

    def run(self, seconds: float) -> Outcome:
        """Practise for so long at least, do every fault, and compare."""
        out, began = self.outcome, time.monotonic()
        with Laboratory(self._there, self._seed) as lab:
            self._tell(f"all parts work after {time.monotonic() - began:.0f} s: {lab.folder}")
            time.sleep(self._calm)
            for part in self._parts:
                for fault in self._faults:
                    trial = run_trial(lab, part, fault)
                    out.trials.setdefault(part, {})[fault] = trial
                    out.broken += [f"{part}, {fault}: {one}" for one in trial.broken]
                    self._tell(f"{part}, {fault}: {trial.words}")
            left = began + seconds - time.monotonic()
            time.sleep(max(0.0, left))
            self._end(lab)
        return out

    def _end(self, lab: Laboratory) -> None:
        """Let the last attempt end, all be sent, and compare."""
        now = time.monotonic()
        try:
            lab.trainer.await_kind("ended", now, 90.0)
        except BrokenRuleError as error:
            self.outcome.broken.append(str(error))
        time.sleep(0.5)
        lab.trainer.stop()
        if not lab.courier.finish(SILENT_S):
            self.outcome.broken.append("not all attempts were sent")
        tracks = self._records(lab)
        for name, compare in (("slicer", of_slicer), ("gui", of_gui)):
            if name in lab.listeners:
                self._agree(name, compare(heard(lab.listeners[name].heard), tracks))
        self._sent(lab)

    def _agree(self, name: str, found: Agreement) -> None:
        self.outcome.agrees[name] = found.words
        if not found.compared:
            self.outcome.broken.append(f"{name} heard nothing that can be compared")
        if found.wrong:
            self.outcome.broken.append(f"{name}: {len(found.wrong)} poses differ: {found.wrong[0]}")

    def _records(self, lab: Laboratory) -> list[Track]:
        """Look at every record; return their needles."""
        out, tracks = self.outcome, []
        began = [one for one in lab.trainer.said if one["kind"] == "began"]
        for one in began:
            path = lab.folder / "sessions" / f"{one['id']}.mcap"
            if not path.exists():
                out.broken.append(f"the record of {one['id']} is lost")
            elif is_cut_off(path):
                out.broken.append(f"the record of {one['id']} was not closed")
            elif (track := track_of(path)) is not None:
                tracks.append(track)
        out.attempts = len(began)
        self._lost(lab, tracks)
        whole = [one for one in lab.trainer.said if one["kind"] == "ended"]
        done = sum(one["state"] == "ended" for one in whole)
        out.agrees["trainer"] = f"{len(began)} attempts, {done} to their end, each with its record"
        return tracks

    def _lost(self, lab: Laboratory, tracks: list[Track]) -> None:
        """Say how much of the record of a killed program is missing."""
        said = lab.trainer.said
        for one in said:
            if one["kind"] != "recovered":
                continue
            track = next((t for t in tracks if t.id == one["id"]), None)
            earlier = [o["t"] for o in said if o["t"] < one["t"] and o["kind"] != "recovered"]
            trial = self.outcome.trials.get("trainer", {}).get("killed")
            killed = None if trial is None else trial.moment
            if track is None or killed is None or not earlier:
                continue
            lost = killed + lab.wall - track.whole[1]
            trial.notes.append(f"the record ends {1e3 * lost:.0f} ms before")
            if lost > LOST_S:
                self.outcome.broken.append(f"{lost:.1f} s of the record of {one['id']} are lost")

    def _sent(self, lab: Laboratory) -> None:
        """Count what the archive and the university hold."""
        out = self.outcome
        if lab.archive is not None:
            held, sent = lab.archive.held(), lab.courier.objects
            wanted = {uid for some in sent.values() for uid in some}
            out.agrees["archive"] = f"{len(held)} objects of {len(sent)} attempts, each once"
            if len(held) != len(set(held)) or set(held) != wanted:
                out.broken.append(f"the archive holds {len(held)} objects, not {len(wanted)}")
        if lab.university is not None:
            counts, told = lab.university.held(), lab.courier.ended
            out.agrees["university"] = (
                f"{len(counts)} statements of {len(told)} attempts, each once"
            )
            if max(counts.values(), default=1) > 1:
                out.broken.append("the university holds a statement twice")
            if len(counts) != len(told):
                out.broken.append(f"{len(counts)} statements of {len(told)} attempts arrived")
