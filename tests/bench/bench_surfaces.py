"""Surfaces of skin and bone of about 300 slices, and how soon they stop when cancelled.

Figures to reach: at most 4 s for both, body found before (the patient has it already); a cancel is
obeyed within 1 s, wherever it comes (the body's mask is the longest step that does not look).
"""

import os
import threading
import time
from pathlib import Path
from statistics import median

from app.core.progress import Cancelled, Progress
from app.imaging.body import Body, find_body
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.volume import Volume
from app.views.scene.surfaces import extract_surfaces

ROUNDS = 3
LIMIT_S, CANCEL_S = 4.0, 1.0


def main() -> None:
    """Print seconds and triangles for the phantom and the real chest."""
    root = Path(__file__).resolve().parents[2]
    data = Path(os.environ.get("ACUS_TEST_DATA") or root.parent / "shared" / "data")
    folders = {"phantom, 300 slices": phantom_series(1)}
    if (chest := data / "ct_chest_lidc0314").is_dir():
        folders["real chest, 275 slices"] = chest
    for name, folder in folders.items():
        volume = load_ct(folder)
        _measure(name, volume, find_body(volume))


def _measure(name: str, volume: Volume, body: Body) -> None:
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        surfaces = extract_surfaces(volume, body, Progress())
        times.append(time.perf_counter() - start)
    took = median(times)
    ratio = took / LIMIT_S
    print(f"{name}: {took:.2f} s ({min(times):.2f} to {max(times):.2f}), {surfaces.count} "
          f"triangles, {ratio:.2f} × the limit of {LIMIT_S:g} s")  # fmt: skip
    late = [_cancelled(volume, body, share * took) for share in (0.1, 0.3, 0.5, 0.7, 0.9)]
    print(f"{name}: cancelled after at most {max(late):.2f} s,"
          f" {max(late) / CANCEL_S:.2f} × the limit of {CANCEL_S:g} s")  # fmt: skip


def _cancelled(volume: Volume, body: Body, after: float) -> float:
    """Seconds from a cancel to the end of the work; 0 where it had ended before."""
    progress, at = Progress(), [0.0]

    def cancel() -> None:
        at[0] = time.perf_counter()
        progress.cancel()

    timer = threading.Timer(after, cancel)
    timer.start()
    try:
        extract_surfaces(volume, body, progress)
    except Cancelled:
        return time.perf_counter() - at[0]
    finally:
        timer.cancel()
    return 0.0


if __name__ == "__main__":
    main()
