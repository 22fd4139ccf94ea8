"""A control scan of an attempt: what was ordered, what it saw, and its notional dose.

The picture is never recorded: order, needle and the patient's motion are, and `imaging.scanned`
makes the same picture of them again from the CT.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.errors import AcusError
from app.core.events import Event
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.inside import Inside
from app.imaging.scan_order import ScanNeedle, ScanOrder, Seen, seen
from app.planning.placement import PlacedPlan
from app.scoring.errors import TrajectoryError
from app.scoring.scans import ScanMark
from app.session.errors import ScanNotPossibleError
from app.session.observation import Observation

KIND: Final = "scan"
"""Kind of the event."""

VERSION: Final = 2
"""Of the event's data."""

TEACHING_ESTIMATE: Final = sentence("teaching estimate")
"""Stands wherever a dose is shown: it is no dose of any scanner."""


@dataclass(frozen=True, slots=True, eq=False)
class ControlScan:
    """One control scan.

    Attributes:
        number: in its attempt, from 1.
        time: monotonic time [s].
        order: which slices.
        needle: where the needle was, DICOM LPS [mm].
        shift_mm: how far breathing had moved the target, LPS, shape (3,), read-only.
        dose: notional dose-length product [mGy·cm]: a teaching estimate.
        streak: whether its pictures show the metal's streak.
        inside: what complications have changed in the patient; None for nothing.
    """

    number: int
    time: float
    order: ScanOrder
    needle: ScanNeedle
    shift_mm: FloatArray
    dose: float
    streak: bool = False
    inside: Inside | None = None

    @property
    def tissue_range_mm(self) -> tuple[float, float]:
        """Return LPS z of the tissue that the slices show, where it would rest."""
        low, high = self.order.range_mm
        moved = float(self.shift_mm[2])
        return low - moved, high - moved

    @property
    def seen(self) -> Seen:
        """Return how much of the needle the slices show."""
        return seen(self.order, self.needle)

    def data(self) -> dict[str, object]:
        """JSON-ready values for the event; `of` reads them back to the last bit."""
        order, bent = self.order, self.needle.corners_mm
        inside = {} if self.inside is None else {"inside": self.inside.document()}
        return (
            inside
            | {
                "version": VERSION,
                "order": {
                    "centre_mm": order.centre_mm,
                    "slices": order.slices,
                    "slice_mm": order.slice_mm,
                },
                "range_mm": list(order.range_mm),
                "streak": self.streak,
                "seen": self.seen.value,
                "dose_mgy_cm": self.dose,
                "dose_note": str(TEACHING_ESTIMATE),
                "hub_lps_mm": self.needle.hub_mm.tolist(),
                "tip_lps_mm": self.needle.tip_mm.tolist(),
                "shift_lps_mm": self.shift_mm.tolist(),
            }
            | ({} if bent is None else {"bent_lps_mm": bent.tolist()})
        )

    @classmethod
    def of(cls, event: Event) -> ControlScan | None:
        """Read an event; None where it is no scan, one without an order, or not whole."""
        data: dict[str, Any] = dict(event.data)
        if event.kind != KIND or "order" not in data:
            return None
        try:
            order = data["order"]
            return cls(
                int(data["number"]),
                event.time,
                ScanOrder(
                    float(order["centre_mm"]), int(order["slices"]), float(order["slice_mm"])
                ),
                ScanNeedle(
                    data["hub_lps_mm"], data["tip_lps_mm"], corners_mm=data.get("bent_lps_mm")
                ),
                frozen(data["shift_lps_mm"], (3,), "shift_lps_mm"),
                float(data["dose_mgy_cm"]),
                data["streak"] is True,
                None if data.get("inside") is None else Inside.of(data["inside"]),
            )
        except (AcusError, LookupError, TypeError, ValueError):
            return None  # of a damaged record; the scan is still counted

    def document(self, origin: float) -> dict[str, Any]:
        """JSON-ready mapping, times counted from `origin` [s]; the keys stand in docs/json.md."""
        return {"number": self.number, "time_s": self.time - origin, **self.data()}

    def sentence(self, origin: float) -> str:
        """Say it in one line, the time counted from `origin` [s]."""
        order = self.order
        return sentence(
            "control scan {scan_number} at {time:.1f} s: {order_slices} slices of "
            "{order_slice_mm:g} mm about z {order_centre_mm:.1f} mm, {seen_words}, "
            "{dose:.1f} mGy·cm ({teaching_estimate})",
            scan_number=self.number,
            time=self.time - origin,
            order_slices=order.slices,
            order_slice_mm=order.slice_mm,
            order_centre_mm=order.centre_mm,
            seen_words=SEEN_WORDS[self.seen],
            dose=self.dose,
            teaching_estimate=TEACHING_ESTIMATE,
        )


SEEN_WORDS: Final = {
    Seen.TIP: "shows the tip",
    Seen.SHAFT: "shows the shaft, the tip lies outside",
    Seen.NOTHING: "does not show the needle",
}


def take(
    number: int,
    order: ScanOrder,
    dose: float,
    now: float,
    look: Observation | None,
    placed: PlacedPlan,
    streak: bool = False,
    inside: Inside | None = None,
) -> ControlScan:
    """Take a scan at `now` [s].

    Args:
        number: in its attempt, from 1.
        order: which slices.
        dose: notional, of the whole scan [mGy·cm].
        now: time [s].
        look: newest observation of robot and cameras.
        placed: the plan, for where the patient lies.
        streak: whether its pictures show the metal's streak.
        inside: what complications have changed in the patient.

    Raises:
        ScanNotPossibleError: if nobody knows where the needle is: a picture would be a guess.
    """
    device = None if look is None else look.device
    if look is None or device is None or not look.pose.measured:
        raise ScanNotPossibleError(
            sentence(
                "no control scan: the needle's depth is not measured now, so that a picture "
                "would be a guess; nothing was counted. Let both cameras see the marker and "
                "press again"
            )
        )
    length = float(np.linalg.norm(device.tip - device.hub))
    pose, to_patient = look.pose, placed.T_world_patient.inverse()
    hub = pose.p_straight - length * pose.axis
    hub_mm, tip_mm = to_patient @ [hub, pose.p_tip]
    bent = None
    if pose.bend is not None and pose.depth > 0.0:
        bent = to_patient @ np.vstack([hub, pose.curve]) / MILLIMETRE
    moved = placed.T_world_patient.inverse().rotate(look.p_target - placed.p_target)
    return ControlScan(
        number,
        now,
        order,
        ScanNeedle(hub_mm / MILLIMETRE, tip_mm / MILLIMETRE, corners_mm=bent),
        frozen(moved / MILLIMETRE, (3,), "shift"),
        dose,
        streak,
        inside,
    )


def scans_of(events: Iterable[Event]) -> tuple[ControlScan, ...]:
    """Control scans with an order among events, in order."""
    found = (ControlScan.of(event) for event in events)
    return tuple(scan for scan in found if scan is not None)


def scan_marks(events: Iterable[Event]) -> tuple[ScanMark, ...]:
    """Every control scan among events as scoring counts it; without an order it has no dose."""
    found = []
    for event in events:
        if event.kind == KIND:
            dose = event.data.get("dose_mgy_cm", 0.0)
            known = isinstance(dose, int | float) and not isinstance(dose, bool)
            try:
                found.append(ScanMark(event.time, float(dose) if known else 0.0))  # type: ignore[arg-type]
            except TrajectoryError:
                found.append(ScanMark(0.0))  # of a damaged record; the scan is still counted
    return tuple(found)
