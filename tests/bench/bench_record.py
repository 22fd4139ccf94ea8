"""How long the debrief of an hour's record takes, beside the way in which it was read before.

Run as `make bench BENCH=record [MINUTES=60]`. Before: every message of the file was parsed, samples
one by one from JSON and all ticks decoded, and the place of the tip on the pad was computed sample
by sample in every paint. Now: the index at the file's end, samples in columns, ticks when wanted.
The figure to keep: 2 s for 60 minutes, the score computed again included.
"""

import os
import sys
import tempfile
from collections.abc import Callable
from datetime import UTC, datetime
from math import atan2
from pathlib import Path
from time import perf_counter

import numpy as np

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.events import Event
from app.device.state import DeviceState
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.score import score
from app.session import blocks
from app.session.facts import PLAN, plan_record
from app.session.header import Attachment, SessionHeader
from app.session.machine import State
from app.session.needle import DepthSource, NeedlePose
from app.session.recorder import Recorder
from app.session.recording import Recording, _recording, _samples, open_recording
from app.session.review import Review, review
from app.session.sample import Sample
from app.session.sample_columns import attachment
from app.session.samples import SampleHistory
from app.session.scan import scan
from app.session.scored import score_document, trajectory
from app.session.ticks import read_inputs
from app.views.debrief.page import DebriefPage
from app.views.shell.application import start

FULCRUM = np.array([0.0, 0.16056, 0.090])
PLACED = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0]), "bench"), Placement(), FULCRUM)
ORIGIN = 100.0


def record(folder: Path, minutes: float) -> Path:
    """Write an attempt of so many minutes: aligning, a slow insertion, a hand that trembles."""
    rng, clock = np.random.default_rng(1), VirtualClock(ORIGIN)
    head = SessionHeader(
        "hour", datetime(2026, 1, 1, tzinfo=UTC), ORIGIN, "s-1", "bench",
        metadata={PLAN: plan_record(PLACED)},
    )  # fmt: skip
    recorder, history = Recorder(folder, head, clock=clock), SampleHistory()
    recorder.open()
    state = np.tile(rng.normal(size=sv.SLOTS), (100, 1))
    state[:, sv.TICK] = np.arange(1, 101)
    ticks = blocks.pack(state, 0)  # a tenth of a second; the same again, the reader cannot tell
    count = round(minutes * 60.0 * 50.0)
    for k in range(count):
        clock.sleep(0.02)
        inside = k > count // 20
        depth = -0.01 + 0.07 * max(0.0, k / count - 0.05)
        sample = _sample(clock.now(), depth, rng, State.INSERTING if inside else State.ALIGNING)
        history.add(sample)
        recorder.sample(sample)
        if k % 5 == 0:
            recorder._file.message("/loop/inputs", head.nanoseconds(clock.now()), ticks)
        if k % 3000 == 0:
            recorder.event(Event(clock.now(), "scan", "control scan", {"number": k // 3000 + 1}))
        recorder.drain()
    samples = history.arrays()
    document = score_document(score(trajectory(samples, PLACED)))
    files = (_json("score.json", document), attachment(samples))
    recorder.finish(files, {"state": "ended", "duration_s": repr(minutes * 60.0)})
    return recorder.status().path


def _sample(now: float, depth: float, rng: np.random.Generator, state: State) -> Sample:
    axis = np.array([*(0.002 * rng.normal(size=2)), -1.0])
    axis /= np.linalg.norm(axis)
    row = sv.empty_state()
    row[sv.TIME], row[sv.TICK] = now, round(1e3 * now)
    row[sv.HUB_X : sv.HUB_X + 3] = FULCRUM - (0.2 - depth) * axis
    row[sv.FELT_X : sv.FELT_X + 3] = 0.1 * rng.normal(size=3)
    row[sv.LIMIT_SCALE] = 1.0
    pose = NeedlePose(
        p_tip=FULCRUM + depth * axis, axis=axis, depth=depth, time=now, orientation_age=0.0,
        depth_age=0.0, depth_source=DepthSource.TRACKED, valid=True, covariance=1e-8 * np.eye(3),
    )  # fmt: skip
    return Sample(now, state, pose, DeviceState.from_row(row), PLACED.p_target, "valid", 0.2, 0.7)


def _json(name: str, document: object) -> Attachment:
    from app.session.sample import encode

    return Attachment(name, "application/json", encode(document))


def read_before(path: Path) -> Recording:
    """Read a record as every version before did: all messages, one by one, and all ticks."""
    content = scan(path)
    problems = content.problems
    samples = _samples(content, problems)
    inputs = read_inputs(content, problems)
    return _recording(path, content, samples, problems, inputs, inputs.lost)


def track_before(shown: Review) -> None:
    """Place the tip on the pad as `paintEvent` did, each time."""
    frame, scale = shown.frame, shown.scale
    offsets = np.column_stack(
        [(shown.tip - shown.placed.p_entry) @ axis for axis in (frame.right, frame.up)]
    )
    lengths = np.hypot(offsets[:, 0], offsets[:, 1])
    np.array([scale.radius(atan2(r, scale.length)) for r in lengths])


def timed(what: str, work: Callable[[], object], times: int = 3) -> float:
    """Print and return the shortest of a few runs [s]."""
    best = min(_once(work) for _ in range(times))
    print(f"    {what:<52} {best:8.3f} s")
    return best


def _once(work: Callable[[], object]) -> float:
    begin = perf_counter()
    work()
    return perf_counter() - begin


def page_of(shown: Review) -> None:
    """Show it on the page, until the last curve is drawn and all is painted."""
    from PySide6.QtCore import QEventLoop

    page = DebriefPage()
    page.resize(1366, 768)
    loop = QEventLoop()
    page.curves.drawn.connect(loop.quit)
    page.show_review(shown)
    page.show()
    loop.exec()
    page.grab()
    page.close()


def main() -> None:
    """Measure a short attempt and a long one."""
    application = start(offscreen=True)
    minutes = float(os.environ.get("MINUTES") or (sys.argv[1] if len(sys.argv) > 1 else 60.0))
    with tempfile.TemporaryDirectory() as name:
        for length in (1.0, minutes):
            path = record(Path(name) / f"{length:g}", length)
            print(f"{length:g} minutes, {path.stat().st_size / 1e6:.0f} MB")
            shown = review(open_recording(path))
            before = timed("before: all messages and ticks", lambda p=path: read_before(p), 1)
            before += timed(
                "before: the tip's places, every paint", lambda r=shown: track_before(r)
            )
            now = timed("now: index and columns", lambda p=path: open_recording(p))
            found = open_recording(path)
            now += timed("now: score again, curves, figures", lambda f=found: review(f))
            now += timed("now: the tip's places, once", shown.track)
            timed("page with its curves, drawn (in both)", lambda r=shown: page_of(r))
            print(f"    reading until it can be shown: {before:.2f} s before, {now:.2f} s now, "
                  f"ratio {now / before:.3f}")  # fmt: skip
    application.quit()


if __name__ == "__main__":
    main()
