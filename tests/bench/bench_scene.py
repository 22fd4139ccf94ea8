"""Pictures of the 3D view: while it is turned and at rest, beside the fine surfaces in every one.

Figures to reach: at most 100 ms for a picture while the view is turned, on software OpenGL and with
everything shown; what it costs in pixels is printed. Both ways are drawn in turns, in one run.
"""

import os
import time
from pathlib import Path
from statistics import median

import numpy as np

from app.core.progress import Progress
from app.imaging.body import find_body
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.planning.draft import DraftPlan
from app.views.scene.display import Display
from app.views.scene.orbit import Orbit
from app.views.scene.renderer import moving_size
from app.views.scene.stage import Stage
from app.views.scene.surfaces import extract_surfaces

ROUNDS, WARM = 15, 8
SIZE = (640, 480)
LIMIT_S = 0.1


def main() -> None:
    """Print milliseconds for the built-in patient and the real chest."""
    root = Path(__file__).resolve().parents[2]
    data = Path(os.environ.get("ACUS_TEST_DATA") or root.parent / "shared" / "data")
    patients: dict[str, tuple[Path, int | None]] = {"built-in patient": (phantom_series(1), 1)}
    if (chest := data / "ct_chest_lidc0314").is_dir():
        patients["real chest"] = (chest, None)
    for name, (folder, seed) in patients.items():
        volume = load_ct(folder)
        surfaces = extract_surfaces(volume, find_body(volume), Progress(), seed)
        stage = Stage()
        stage.open()
        stage.set_surfaces(surfaces)
        if seed is not None:
            known = anatomy(seed)
            stage.set_plan(DraftPlan(known.entry_mm, known.lesion_mm))
        points = surfaces.skin.points.astype(np.float64)
        orbit = Orbit.from_side("A", points.mean(axis=0), 1.0).fitted(points)
        for words, display in (("as usual", Display()), ("x-ray", Display(xray=True))):
            stage.set_display(display)
            _measure(f"{name}, {words}", stage, orbit)
        stage.close()


def _measure(name: str, stage: Stage, orbit: Orbit) -> None:
    size, now = 1.0, 0.0
    fine, moving, rest = [], [], []
    for number in range(WARM + ROUNDS):
        orbit = orbit.turned(7.0, 1.0)
        size = moving_size(size, now)
        shown = (int(SIZE[0] * size), int(SIZE[1] * size))
        now = _seconds(stage, orbit, shown, moving=True)
        if number >= WARM:
            moving.append(now)
            fine.append(_fine_seconds(stage, orbit))
            rest.append(_seconds(stage, orbit, SIZE, moving=False))
    print(
        f"{name}, {stage.driver}: turned {1e3 * median(moving):.0f} ms at {100 * size:.0f} % of "
        f"{SIZE[0]} × {SIZE[1]}, {median(moving) / LIMIT_S:.2f} × the limit; fine surfaces sorted "
        f"{1e3 * median(fine):.0f} ms ({median(moving) / median(fine):.2f} ×); at rest, peeled, "
        f"{1e3 * median(rest):.0f} ms"
    )


def _seconds(stage: Stage, orbit: Orbit, size: tuple[int, int], moving: bool) -> float:
    start = time.perf_counter()
    stage.render(orbit, size, moving)
    return time.perf_counter() - start


def _fine_seconds(stage: Stage, orbit: Orbit) -> float:
    """One picture as it is at rest, its triangles sorted: what a turn cost with one fineness."""
    stage.peels = False
    try:
        return _seconds(stage, orbit, SIZE, moving=False)
    finally:
        stage.peels = True


if __name__ == "__main__":
    main()
