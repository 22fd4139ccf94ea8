"""A patient as the window holds it: volume, body and, for the phantom, a proposed plan."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.arrays import frozen
from app.core.loading import ONE_AT_A_TIME, turn
from app.core.progress import Progress
from app.imaging.series import NO_REMEDY, Series
from app.imaging.volume import Volume
from app.imaging.window import PRESETS
from app.mechanisms.profile import load_profile
from app.planning.placement import Placement
from app.planning.plan import Plan
from app.planning.reach import reach

if TYPE_CHECKING:
    from app.imaging.body import Body

DEVICE: Final = "icube"
"""Any device will do to load the kernels of the verdict."""


@dataclass(frozen=True, slots=True, eq=False)
class Patient:
    """What is looked at and planned on.

    Attributes:
        volume: the CT.
        body: what of it is patient, for skin and inside.
        label: for the title; never a name from the files.
        proposed: plan that comes with the patient; None for a CT of one's own.
        folder: where it was opened; None for the phantom.
        phantom_seed: of the procedural patient; None for a CT of one's own.
    """

    volume: Volume
    body: Body
    label: str
    proposed: Plan | None = None
    folder: Path | None = None
    phantom_seed: int | None = None


def load_phantom(seed: int, progress: Progress) -> Patient:
    """Make (once) and read the procedural patient.

    Raises:
        AcusError: if it cannot be written or read; says why.
        Cancelled: if `progress` was cancelled.
    """
    with ONE_AT_A_TIME:  # pydicom and scipy: behind the window, not before it
        from app.imaging.body import find_body
        from app.imaging.phantom.anatomy import anatomy
        from app.imaging.phantom.series import phantom_series
        from app.imaging.reading import load_ct

    folder = phantom_series(seed, progress.part(0.0, 0.5))
    volume = load_ct(folder, progress=progress.part(0.5, 0.8))
    known = anatomy(seed)
    plan = Plan(frozen(known.entry_mm), frozen(known.lesion_mm), f"phantom-{seed}")
    body = find_body(volume, progress.part(0.8, 0.85))
    _load_verdict(progress.part(0.85, 1.0))
    return Patient(volume, body, f"Phantom {seed}", plan, phantom_seed=seed)


def read_patient(
    series: Series, folder: Path, progress: Progress, remedy: str = NO_REMEDY
) -> Patient:
    """Read a series that the user chose, as it is or in the way asked for.

    Raises:
        AcusError: if it cannot be read; says why.
        Cancelled: if `progress` was cancelled.
    """
    with ONE_AT_A_TIME:
        from app.imaging.body import find_body
        from app.imaging.reading import read_with

    volume = read_with(series, remedy, progress.part(0.0, 0.75))
    body = find_body(volume, progress.part(0.75, 0.85))
    _load_verdict(progress.part(0.85, 1.0))
    return Patient(volume, body, label_of(volume), folder=folder)


def label_of(volume: Volume) -> str:
    """Pseudonym of a volume, and what a reader must know of how it was made."""
    series = volume.series
    tilt = f"gantry tilt {volume.tilt_deg:.1f}°" if series.tilt_deg and not volume.made else ""
    kind = "" if volume.unit == "HU" else f"{series.modality} without Hounsfield units"
    return ", ".join(filter(None, (series.pseudonym, kind, tilt, *volume.made)))


def _load_verdict(progress: Progress) -> None:
    """Load the kernels behind the verdict on a plan, by asking for two, and those of its pictures.

    First called on the window's thread they would wait there for all that other threads compile: a
    first start waits here, and shows how far that is.
    """
    with turn(progress):
        from app.imaging.screen import STROKE, draw_strokes, screen_pixels
    profile = load_profile(DEVICE)
    for entry in ((0.0, -50.0, 0.0), (50.0, -10.0, 0.0)):  # straight down, and too oblique
        reach(Plan(frozen(entry), frozen((0.0, 0.0, 0.0))), Placement(), profile)
    soft, place = PRESETS["Soft tissue"], (0.0, 0.0, 1.0, 1.0)
    for kind in (np.int16, np.float32):
        pixels = screen_pixels(np.zeros((1, 1), kind), soft, False, place, (1, 1))
        draw_strokes(pixels, np.zeros((0, STROKE)), (0.0, 0.0), 1.0, 1.0)
