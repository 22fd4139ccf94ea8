"""How large a record gets and what writing it costs, against float64 columns as they are.

Run as `python -m tests.bench.bench_recording`. Three attempts on the composed simulated robot: a
guided insertion by the scripted expert, ten minutes of rest (both in virtual time), and a hand led
by inputs in real time on the compiled loop, whose times are noisy. The figure to keep: 100 MB an
hour for the loop's own channel; the peer is what version 1 stored, with the outputs added.
"""

import shutil
import tempfile
import time
from pathlib import Path
from time import perf_counter

import numpy as np
import zstandard

from app.compose.recomputed import replay_recording
from app.compose.trainer import Rig, TrainerSetup, build_rig
from app.core.clock import Clock, SystemClock, VirtualClock
from app.exercises.scene import device_of, placed_plan_of
from app.planning.plan import Plan
from app.session import blocks
from app.session.ct_facts import CtFacts
from app.session.recording import read_recording
from app.session.scan import scan
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "bench")
MEGABYTE = 1e6


def rig(folder: Path, clock: Clock, skill: str | None) -> Rig:
    """Build a trainer on the simulated robot; nothing looks at its cameras."""
    exercise = layered("thick-tissue")
    placed = placed_plan_of(exercise, device_of(exercise), PLAN)
    return build_rig(TrainerSetup(exercise, placed, CtFacts("bench"), skill, 1, folder, clock))


def virtual(folder: Path, seconds: float, skill: str | None) -> Path:
    """Record an attempt in virtual time, guided at 0.7."""
    built = rig(folder, VirtualClock(100.0), skill)
    built.loop.open()
    built.trainer.step(300)
    built.trainer.assistance(0.7)
    built.trainer.begin("bench")
    for _ in range(round(seconds / 0.02)):
        built.trainer.step(20)
    record = built.trainer.end().record
    built.trainer.close()
    assert record is not None
    return record


def real(folder: Path, seconds: float) -> Path:
    """Record an attempt on the compiled loop whose hand moves at 50 Hz."""
    built = rig(folder, SystemClock(), None)
    built.loop.open()
    while built.loop.latest().tick == 0:
        time.sleep(0.05)
    trainer, rng = built.trainer, np.random.default_rng(1)
    trainer.assistance(0.7)
    trainer.begin("bench")
    for k in range(round(seconds / 0.02)):
        x, y = 0.1 * np.sin(0.05 * k) + rng.normal(0.0, 1e-3, 2)
        trainer.hand(float(x), float(y), 1e-4 * k)
        trainer.heartbeat()
        trainer.tick(time.monotonic())
        time.sleep(0.02)
    record = trainer.end().record
    trainer.close()
    assert record is not None
    return record


def report(title: str, path: Path) -> None:
    """Print the record's size per hour by channel group, the peer, and the replay's verdict."""
    recording, content = read_recording(path), scan(path)
    dt = recording.inputs.column("dt")
    hours = float(dt.sum()) / 3600.0
    seconds = max(1, round(float(dt.sum())))
    sizes = {t: sum(map(_packed, _parts(m, seconds))) for t, m in content.messages.items()}
    loop = sizes.pop("/loop/inputs")
    peer = sum(map(_packed, _plain(recording.inputs.values)))
    print(f"{title}: {len(dt)} ticks, file {path.stat().st_size / MEGABYTE / hours:.0f} MB/h")
    print(
        f"    loop's channel {loop / MEGABYTE / hours:6.1f} MB/h, {loop / len(dt):5.1f} B a tick   "
        f"as plain float64 {peer / MEGABYTE / hours:6.1f} MB/h   ratio {loop / peer:.2f}"
    )
    checkpoint = sizes.pop("/loop/checkpoint") / 1e3
    rest = sum(sizes.values()) / MEGABYTE / hours
    print(f"    JSON channels {rest:.1f} MB/h; checkpoint {checkpoint:.0f} kB, once")
    start = perf_counter()
    verdict = replay_recording(recording).sentences()[0]
    speed = float(dt.sum()) / (perf_counter() - start)
    print(f"    replay: {verdict}; {speed:.0f} times as fast as the attempt")


def costs() -> None:
    """Print what a block costs: at rest, and full of noise."""
    rng, size = np.random.default_rng(2), blocks.slots.SLOTS
    rest = np.tile(rng.normal(size=size), (100, 1))
    for title, rows in (("at rest", rest), ("all noise", rng.normal(size=(100, size)))):
        times = []
        for _ in range(50):
            start = perf_counter()
            blocks.pack(rows, 0)
            times.append(perf_counter() - start)
        median = float(np.median(times))
        print(f"block of 0.1 s, {title:<10} {1e3 * median:6.2f} ms, {1e3 * median:.2f} % of a core")


def _parts(messages: list[bytes], count: int) -> list[bytes]:
    """Messages in so many pieces: the recorder compresses about a second at a time."""
    step = max(1, -(-len(messages) // count))
    return [b"".join(messages[k : k + step]) for k in range(0, len(messages), step)]


def _plain(values: np.ndarray) -> list[bytes]:
    """The same columns as version 1 stored them, a second at a time."""
    parts = np.array_split(values, max(1, len(values) // 1000))
    return [np.ascontiguousarray(part.T).tobytes() for part in parts]


def _packed(data: bytes) -> int:
    return len(zstandard.compress(data))


def main() -> None:
    """Measure all three, and the cost."""
    folder = Path(tempfile.mkdtemp())
    try:
        report("guided insertion by the script, 20 s", virtual(folder, 20.0, "expert"))
        report("hand in real time, 20 s", real(folder, 20.0))
        report("ten minutes of rest", virtual(folder, 600.0, None))
    finally:
        shutil.rmtree(folder)
    costs()


if __name__ == "__main__":
    main()
