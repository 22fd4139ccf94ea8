"""Figures about the tracker over the last seconds."""

import threading
from collections import Counter, deque
from dataclasses import dataclass, field

import numpy as np

from app.tracking.cameras.feed import Skew
from app.tracking.cameras.watch import CameraHealth, CameraState
from app.tracking.fix import FixStatus, NeedleFix

WINDOW = 2.0
"""Time [s] over which rate, share and latency are taken."""


@dataclass(frozen=True, slots=True)
class TrackerStatistics:
    """How the tracker does.

    Attributes:
        rate: fixes per second, valid or not.
        valid_share: share of the valid ones, 0 to 1.
        latency: median time [s] from capture to fix.
        age: time [s] since the capture of the newest fix; None before the first.
        status: of the newest fix; None before the first.
        reason: one line for people about the present trouble; empty without.
        residual_px: of the newest fix.
        missing: cameras that do not show the marker in the newest fix.
        counts: fixes of each status since the start.
        cameras: health of each camera.
        discrepancy: why cameras and robot disagree over the last seconds; empty if they do not.
        fault: message of an error inside the tracker; empty without.
        skew: how far apart the two cameras capture; None before a pair came.
        cost: median time that finding the needle in a pair of pictures takes [s]; 0 if unknown.
        told_by: who tells the fixes without pictures, by name; empty where cameras look.
        looks_for: what is looked for in the pictures: a `marker` by two cameras, a `pen` by one.
    """

    rate: float
    valid_share: float
    latency: float
    age: float | None
    status: FixStatus | None
    reason: str
    residual_px: float
    missing: tuple[str, ...]
    counts: dict[str, int] = field(default_factory=dict)
    cameras: tuple[CameraHealth, ...] = ()
    fault: str = ""
    discrepancy: str = ""
    skew: Skew | None = None
    cost: float = 0.0
    told_by: str = ""
    looks_for: str = "marker"


class TrackerMeter:
    """Counts fixes; written by the tracker's thread, read by any.

    Args:
        told_by: as in `TrackerStatistics`.
        looks_for: likewise.
    """

    def __init__(self, told_by: str = "", looks_for: str = "marker") -> None:
        self._told_by, self._looks_for = told_by, looks_for
        self._lock = threading.Lock()
        self._recent: deque[tuple[float, float, bool, float]] = deque(maxlen=2048)
        self._counts: Counter[str] = Counter()

    def count(self, fix: NeedleFix, now: float, took: float = 0.0) -> None:
        """Take in a fix that was finished at `now` [s] and took so long to find [s]."""
        with self._lock:
            self._counts[fix.status.value] += 1
            self._recent.append((now, now - fix.time, fix.status is FixStatus.VALID, took))

    def statistics(
        self,
        now: float,
        newest: NeedleFix | None,
        cameras: tuple[CameraHealth, ...],
        fault: str,
        skew: Skew | None = None,
    ) -> TrackerStatistics:
        """Figures at `now` [s]."""
        with self._lock:
            recent = [entry for entry in self._recent if now - entry[0] <= WINDOW]
            counts = dict(self._counts)
        trouble = next((c for c in cameras if c.state in _TROUBLE), None)
        reason = fault or (newest.reason if newest else "")
        if trouble is not None:
            reason = trouble.named
        span = max(now - recent[0][0], 1e-3) if len(recent) > 1 else WINDOW
        return TrackerStatistics(
            rate=(len(recent) - 1) / span if len(recent) > 1 else 0.0,
            valid_share=float(np.mean([entry[2] for entry in recent])) if recent else 0.0,
            latency=float(np.median([entry[1] for entry in recent])) if recent else 0.0,
            age=max(0.0, now - newest.time) if newest else None,
            status=newest.status if newest else None,
            reason=reason,
            residual_px=newest.residual_px if newest else 0.0,
            missing=newest.missing if newest else (),
            counts=counts,
            cameras=cameras,
            fault=fault,
            skew=skew,
            discrepancy=newest.discrepancy.words if newest else "",
            cost=float(np.median([entry[3] for entry in recent])) if recent else 0.0,
            told_by=self._told_by,
            looks_for=self._looks_for,
        )


_TROUBLE = frozenset({CameraState.STALLED, CameraState.FROZEN, CameraState.FAILED})
