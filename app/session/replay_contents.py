"""What a record holds for a replay, without computing anything."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.core.build import BUILD
from app.scoring.risks import RiskMark
from app.session.blocks import INPUTS
from app.session.control_scan import ControlScan
from app.session.ct_facts import UNKNOWN_CT, CtFacts
from app.session.recording import Recording
from app.session.replay import is_simulated, why_not
from app.session.risks import event_of, risk_marks, sentence


@dataclass(frozen=True, slots=True)
class ReplayContents:
    """What can be replayed of a record.

    Attributes:
        session: id of the session.
        why_not: why it cannot be replayed; empty if it can.
        simulated: whether the robot is simulated, so that its encoders are recomputed.
        ticks: ticks of the loop in the record.
        seconds: time from the first to the last [s].
        rate_hz: rate of the ticks, from their median distance [Hz].
        stages: of the tick, in order, with the size of their memory.
        changing: inputs that change during the attempt, with the number of changes.
        missed: deadlines missed during the attempt.
        gaps: (first tick, count) of every stretch of ticks that is missing.
        build: what recorded it.
        scans: control scans with an order.
        origin: monotonic time of the beginning, which their times are told from [s].
        ct: the CT, and how it was read.
        risks: structures of risk, and how near the needle came.
    """

    session: str
    why_not: str
    simulated: bool
    ticks: int
    seconds: float
    rate_hz: float
    stages: Mapping[str, int]
    changing: Mapping[str, int]
    missed: int
    gaps: tuple[tuple[int, int], ...]
    build: Mapping[str, str]
    scans: tuple[ControlScan, ...] = ()
    origin: float = 0.0
    ct: CtFacts = UNKNOWN_CT
    risks: tuple[RiskMark, ...] = ()

    def sentences(self) -> list[str]:
        """Say it, one line each."""
        robot = "the simulated robot" if self.simulated else "a real robot"
        lines = [
            f"{self.ticks} ticks ({self.seconds:.1f} s at {self.rate_hz:.0f} Hz) of {robot}, "
            f"{self.missed} deadlines missed",
            "can be replayed: add --check" if not self.why_not else f"no replay: {self.why_not}",
        ]
        stages = ", ".join(f"{name} ({size})" for name, size in self.stages.items())
        lines.append(f"stages: {stages or 'not recorded'}")
        inputs = ", ".join(f"{name} ({count})" for name, count in self.changing.items())
        lines.append(f"inputs that change (how often): {inputs or 'none'}")
        lines += [f"{count} ticks from tick {first} on are missing" for first, count in self.gaps]
        if self.ct.recipe is not None:
            lines.append(f"CT {self.ct.pseudonym}: {self.ct.words()}")
        lines += [scan.sentence(self.origin) for scan in self.scans]
        lines += [sentence(mark) for mark in self.risks]
        build = ", ".join(f"{name} {value}" for name, value in self.build.items())
        return [*lines, f"build: {build or 'not recorded'}"]

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "session": self.session,
            "replayable": not self.why_not,
            "why_not": self.why_not,
            "simulated": self.simulated,
            "ticks": self.ticks,
            "seconds": self.seconds,
            "rate_hz": self.rate_hz,
            "stages": dict(self.stages),
            "changing_inputs": dict(self.changing),
            "missed": self.missed,
            "gaps": [{"first_tick": first, "ticks": count} for first, count in self.gaps],
            "build": dict(self.build),
            "ct": self.ct.document(),
            "risks": [dict(event_of(mark).data) for mark in self.risks],
            "scans": [scan.document(self.origin) for scan in self.scans],
        }


def contents(recording: Recording) -> ReplayContents:
    """Look into a record."""
    inputs = recording.inputs
    recorded, enough = inputs.checkpoint, len(inputs.values) > 1
    time = inputs.column("time") if enough else np.zeros(2)
    period = float(np.median(np.diff(time)))
    missed = inputs.column("missed") if enough and "missed" in inputs.columns else np.zeros(1)
    start = recorded.checkpoint if recorded is not None else None
    return ReplayContents(
        session=recording.id,
        why_not=why_not(inputs),
        simulated=is_simulated(recording),
        ticks=len(inputs.values),
        seconds=float(time[-1] - time[0]),
        rate_hz=1.0 / period if period > 0.0 else 0.0,
        stages=dict(zip(start.names, start.sizes, strict=True)) if start is not None else {},
        changing=_changing(recording) if enough else {},
        missed=int(missed[-1] - missed[0]),
        gaps=inputs.gaps(),
        build=recording.metadata.get(BUILD, {}),
        scans=recording.control_scans(),
        origin=recording.origin,
        ct=recording.ct,
        risks=risk_marks(recording.events),
    )


def _changing(recording: Recording) -> dict[str, int]:
    inputs = recording.inputs
    counts = {}
    for name in INPUTS:
        if name in inputs.columns:
            values = np.nan_to_num(inputs.column(name), nan=0.0)
            counts[name] = int(np.count_nonzero(np.diff(values)))
    return {name: count for name, count in counts.items() if count}
