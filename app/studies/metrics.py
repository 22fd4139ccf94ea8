"""Survey: do the metrics of smoothness and of deviation give the values that are published?

Smoothness on the bell of the authors' own programs, the deviations on paths whose distance is known
in closed form.
"""

from typing import Any, Final

import numpy as np

from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.scoring.paths import frechet, raw_length, resampled, smooth_length, time_warping
from app.scoring.smoothness import log_dimensionless_jerk, spectral_arc_length
from app.studies.findings import Cell, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Metrics against what is published of them",
    "question": "Do the metrics give the published values?",
    "reference": "the example of the SPARC programs; closed forms of straight and bent paths",
}

SPARC: Final = -1.41403
LDLJ: Final = -5.81636


def _measure(progress: Progress | None = None) -> Findings:
    del progress  # it takes milliseconds
    rate = 100.0
    bell = np.exp(-5.0 * np.arange(-1.0, 1.0, 1.0 / rate) ** 2)  # their example
    line = resampled(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.1]]))
    beside = line + np.array([3.0 * MILLIMETRE, 0.0, 0.0])
    bent = resampled(np.array([[0.0, 0.0, 0.0], [0.005, 0.0, 0.05], [0.0, 0.0, 0.1]]))
    time = np.arange(0.0, 60.0, 1.0 / rate)  # a minute along a half circle of 50 mm
    turn = np.pi * time / time[-1]
    half = 50.0 * MILLIMETRE * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(len(turn))])
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (name, case, f"{found:.5f}", f"{published:.5f}", abs(found - published))
        for name, case, found, published in (
            ("SPARC", "bell exp(-5t²)", spectral_arc_length(bell, rate), SPARC),
            ("LDLJ", "bell exp(-5t²)", log_dimensionless_jerk(bell, rate), LDLJ),
            ("Fréchet [mm]", "3 mm beside", frechet(line, beside) / MILLIMETRE, 3.0),
            ("DTW [mm]", "3 mm beside", time_warping(line, beside) / MILLIMETRE, 3.0),
            ("Fréchet [mm]", "bent by 5 mm", frechet(line, bent) / MILLIMETRE, 5.0),
            ("path, PerkTutor [mm]", "half circle", raw_length(half) / MILLIMETRE, 50.0 * np.pi),
            (
                "path, blocks [mm]",
                "half circle",
                smooth_length(time, half) / MILLIMETRE,
                50 * np.pi,
            ),
        )
    )
    columns = ("metric", "case", "found", "published or closed form", "difference")
    sheet = Sheet("references", "Metrics and their references", columns, rows)
    worst = max(abs(float(row[4])) for row in rows[:2])
    line_said = f"Smoothness differs from what is published by at most {worst:.1g}."
    return Findings((sheet,), lines=(line_said,))


STUDY: Final = Survey(measure=_measure)
"""Found against published."""
