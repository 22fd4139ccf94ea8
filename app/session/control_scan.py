"""A control scan of an attempt: what was ordered, what it saw, and its notional dose.

The picture is never recorded: order, needle and the patient's motion are, and `imaging.scanned`
makes the same picture of them again from the CT.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.errors import AcusError
from app.core.events import Event
from app.core.messages import joined, sentence
from app.core.units import MILLIMETRE
from app.exercises.guidance import GuidancePart, ScanChoice
from app.exercises.parts import TipShape
from app.imaging.field import TissueField
from app.imaging.inside import Inside
from app.imaging.scan_look import NeedleEnds, ScanLook, look_of
from app.imaging.scan_order import (
    NEEDLE_RADIUS_MM,
    ScanNeedle,
    ScanOrder,
    ScanTip,
    Seen,
    seen,
)
from app.imaging.skin_grid import GridSpec
from app.imaging.volume import Volume
from app.planning.placement import PlacedPlan
from app.scoring.errors import TrajectoryError
from app.scoring.scans import ScanMark
from app.session.errors import IllegalTransitionError, ScanNotPossibleError
from app.session.observation import Observation
from app.simulation.needles import OUTER_DIAMETER

KIND: Final = "scan"
"""Kind of the event."""

ROOM: Final = "room"
"""Kind of the event that says that somebody leaves, is back, or could not be scanned."""

VERSION: Final = 3
"""Of the event's data."""

PLAIN_VERSION: Final = 2
"""Of that of a scan with nothing but adjacent straight slices and a plain picture."""

INNER_MM: Final = {17: 1.156, 18: 0.910, 20: 0.635, 21: 0.547, 22: 0.440, 25: 0.292}
"""Gauge -> least diameter of the bore of a thin-walled tube [mm], ISO 9626."""

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
        look: what else they look like.
        choice: what the student chose beside the slices.
        hand_usv: dose of his hand [µSv]: a teaching estimate; None where nobody asks.
    """

    number: int
    time: float
    order: ScanOrder
    needle: ScanNeedle
    shift_mm: FloatArray
    dose: float
    streak: bool = False
    look: ScanLook = field(default_factory=ScanLook)
    choice: ScanChoice = field(default_factory=ScanChoice)
    hand_usv: float | None = None
    inside: Inside | None = None

    @property
    def tissue_range_mm(self) -> tuple[float, float]:
        """Return LPS z of the tissue that the slices show, where it would rest."""
        low, high = self.order.range_mm
        moved = float(self.shift_mm[2])
        return low - moved, high - moved

    def picture(self, volume: Volume, tissue: TissueField | None = None) -> Volume:
        """Make its slices of the CT: the same ones, whenever it is asked.

        Args:
            volume: the CT.
            tissue: the patient's field, by which complications change it.
        """
        # Compiled parts: only who scans waits for them.
        from app.imaging.fallen_lung import changed_ct
        from app.imaging.scanned import scan_image

        if self.inside is not None and tissue is not None:
            volume = changed_ct(volume, tissue, self.inside, self.tissue_range_mm)
        look = replace(self.look, streak=self.streak)
        return scan_image(volume, self.order, self.needle, self.streak, self.shift_mm, look)

    @property
    def seen(self) -> Seen:
        """Return how much of the needle the slices show."""
        return seen(self.order, self.needle)

    def data(self) -> dict[str, object]:
        """JSON-ready values for the event; `of` reads them back to the last bit."""
        order, bent, more = self.order, self.needle.corners_mm, self._more()
        return {
            "version": VERSION if more else PLAIN_VERSION,
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
            **({} if bent is None else {"bent_lps_mm": bent.tolist()}),
            **more,
        }

    def _more(self) -> dict[str, object]:
        """Return what a plain scan does not have."""
        order, needle, more = self.order, self.needle, dict[str, object]()
        stack = {
            name: value
            for name in ("interval_mm", "tilt_deg", "pivot_mm")
            if (value := getattr(order, name)) not in (None, 0.0)
        }
        metal = {
            name: value
            for name in ("radius_mm", "tip", "hollow", "inner_radius_mm")
            if (value := getattr(needle, name)) != getattr(_PLAIN_NEEDLE, name)
        }
        for name, document in (
            ("stack", stack),
            ("metal", metal),
            ("look", self.look.document()),
        ):
            if document:
                more[name] = document
        if self.choice.tube_current_ma is not None:
            more["tube_current_ma"] = self.choice.tube_current_ma
        if self.inside is not None:
            more["inside"] = self.inside.document()
        if self.hand_usv is not None:
            more["hand_usv"] = self.hand_usv
            more["left_room"] = self.choice.leaves
        return more

    @classmethod
    def of(cls, event: Event) -> ControlScan | None:
        """Read an event; None where it is no scan, one without an order, or not whole."""
        data: dict[str, Any] = dict(event.data)
        if event.kind != KIND or "order" not in data:
            return None
        try:
            order, stack = data["order"], data.get("stack", {})
            metal, current = data.get("metal", {}), data.get("tube_current_ma")
            interval, hand = stack.get("interval_mm"), data.get("hand_usv")
            streak = data["streak"] is True
            return cls(
                int(data["number"]),
                event.time,
                ScanOrder(
                    float(order["centre_mm"]),
                    int(order["slices"]),
                    float(order["slice_mm"]),
                    None if interval is None else float(interval),
                    float(stack.get("tilt_deg", 0.0)),
                    float(stack.get("pivot_mm", 0.0)),
                ),
                ScanNeedle(
                    data["hub_lps_mm"],
                    data["tip_lps_mm"],
                    float(metal.get("radius_mm", NEEDLE_RADIUS_MM)),
                    data.get("bent_lps_mm"),
                    ScanTip(metal.get("tip", ScanTip.FLAT)),
                    metal.get("hollow") is True,
                    float(metal.get("inner_radius_mm", 0.0)),
                ),
                frozen(data["shift_lps_mm"], (3,), "shift_lps_mm"),
                float(data["dose_mgy_cm"]),
                streak,
                look_of(streak, data.get("look", {})),
                ScanChoice(
                    None if current is None else float(current), data.get("left_room") is True
                ),
                None if hand is None else float(hand),
                None if data.get("inside") is None else Inside.of(data["inside"]),
            )
        except (AcusError, AttributeError, LookupError, TypeError, ValueError):
            return None  # of a damaged record; the scan is still counted

    def document(self, origin: float) -> dict[str, Any]:
        """JSON-ready mapping, times counted from `origin` [s]; the keys stand in docs/json.md."""
        return {"number": self.number, "time_s": self.time - origin, **self.data()}

    def sentence(self, origin: float) -> str:
        """Say it in one line, the time counted from `origin` [s]."""
        order = self.order
        told = sentence(
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
        chosen = self.chosen
        return told if not chosen else sentence("{told}; {chosen}", told=told, chosen=chosen)

    @property
    def chosen(self) -> str:
        """Say what was chosen beside the slices; empty where there was nothing to choose."""
        order, current, parts = self.order, self.choice.tube_current_ma, list[str]()
        if order.interval_mm is not None:
            parts.append(sentence("every {mm:g} mm", mm=order.interval_mm))
        if order.tilt_deg != 0.0:
            parts.append(sentence("gantry tilted by {deg:g}°", deg=order.tilt_deg))
        if current is not None:
            parts.append(sentence("{ma:g} mA", ma=current))
        if self.needle.hollow:
            parts.append(sentence("stylet out"))
        if self.hand_usv is not None and self.choice.leaves:
            parts.append(sentence("out of the room"))
        elif self.hand_usv is not None:
            parts.append(sentence("hand {usv:.1f} µSv (teaching estimate)", usv=self.hand_usv))
        return joined(", ", parts)


_PLAIN_NEEDLE: Final = ScanNeedle(np.zeros(3), np.array([0.0, 0.0, 1.0]))

SEEN_WORDS: Final = {
    Seen.TIP: "shows the tip",
    Seen.BETWEEN: sentence("shows the shaft, the tip lies in the gap between two slices"),
    Seen.SHAFT: "shows the shaft, the tip lies outside",
    Seen.NOTHING: "does not show the needle",
}


@dataclass(frozen=True, slots=True)
class Taking:
    """A control scan that is to be taken.

    Attributes:
        order: which slices.
        guidance: as the exercise has it.
        choice: what the student chose.
        gauge: of the needle.
        tip: how it is ground.
        hollow: whether its stylet is out.
        grid: of metal on the skin; None for none.
        inside: what complications have changed in the patient; None for nothing.
    """

    order: ScanOrder
    guidance: GuidancePart
    choice: ScanChoice = field(default_factory=ScanChoice)
    gauge: int = 18
    tip: TipShape = TipShape.SYMMETRIC
    hollow: bool = False
    grid: GridSpec | None = None
    inside: Inside | None = None

    def needle(self, hub_mm: FloatArray, tip_mm: FloatArray, bent: FloatArray | None) -> ScanNeedle:
        """Return the metal: the exercise's own needle where its ends are drawn."""
        if self.guidance.needle_ends is NeedleEnds.PLAIN:
            return ScanNeedle(hub_mm, tip_mm, corners_mm=bent)
        shape = ScanTip.BEVEL if self.tip is TipShape.BEVEL else ScanTip.CONE
        return ScanNeedle(
            hub_mm,
            tip_mm,
            0.5 * OUTER_DIAMETER[self.gauge] / MILLIMETRE,
            bent,
            ScanTip.FLAT if self.hollow else shape,
            self.hollow,
            0.5 * INNER_MM[self.gauge] if self.hollow else 0.0,
        )


@dataclass(frozen=True, slots=True)
class Leave:
    """One way out of the room and back, in the attempt's own time, which counts.

    Half of the time is for leaving, then the scan is taken, and the other half is for coming back.
    Nobody holds the needle meanwhile: a simulated hand stays where it is. The patient breathes on.

    Attributes:
        taking: the scan that is taken outside.
        began: when the student left [s].
        lasts: until he is back [s].
        taken: whether the scan has been taken.
    """

    taking: Taking
    began: float
    lasts: float
    taken: bool = False

    @property
    def due(self) -> float:
        """Return when the scan is taken [s]."""
        return self.began + 0.5 * self.lasts

    @property
    def back(self) -> float:
        """Return when the student is at the patient again [s]."""
        return self.began + self.lasts

    def left(self, now: float) -> float:
        """Time until he is back [s]."""
        return max(0.0, self.back - now)


def require_inside(leave: Leave | None, now: float) -> None:
    """Refuse what needs a student in the room.

    Raises:
        IllegalTransitionError: saying how long it takes until he is back.
    """
    if leave is not None:
        raise IllegalTransitionError(
            sentence(
                "you are out of the room for a control scan: back in {left:.0f} s",
                left=leave.left(now),
            )
        )


def take(
    number: int,
    taking: Taking,
    now: float,
    look: Observation | None,
    placed: PlacedPlan,
) -> ControlScan:
    """Take a scan at `now` [s].

    Args:
        number: in its attempt, from 1.
        taking: slices, and what the exercise and the student want.
        now: time [s].
        look: newest observation of robot and cameras.
        placed: the plan, for where the patient lies.

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
    x, y, z = placed.plan.target_mm.tolist()
    guidance, choice = taking.guidance, taking.choice
    return ControlScan(
        number,
        now,
        taking.order,
        taking.needle(hub_mm / MILLIMETRE, tip_mm / MILLIMETRE, bent),
        frozen(moved / MILLIMETRE, (3,), "shift"),
        guidance.dose(taking.order, choice),
        guidance.streak,
        replace(guidance.look(choice, (x, y, z), number), grid=taking.grid),
        choice,
        guidance.hand_dose(choice),
        taking.inside,
    )


def scans_of(events: Iterable[Event]) -> tuple[ControlScan, ...]:
    """Control scans with an order among events, in order."""
    found = (ControlScan.of(event) for event in events)
    return tuple(scan for scan in found if scan is not None)


def scan_marks(events: Iterable[Event]) -> tuple[ScanMark, ...]:
    """Every control scan among events as scoring counts it; without an order it has no dose."""
    marks = []
    for event in events:
        if event.kind == KIND:
            dose, hand = (_number(event.data.get(key)) for key in ("dose_mgy_cm", "hand_usv"))
            try:
                marks.append(ScanMark(event.time, dose or 0.0, hand))
            except TrajectoryError:
                marks.append(ScanMark(0.0))  # of a damaged record; the scan is still counted
    return tuple(marks)


def _number(value: object) -> float | None:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if is_number else None  # type: ignore[arg-type]
