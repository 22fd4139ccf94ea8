"""The entry as it is marked on the skin, and the needle's angles as a protractor has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, radians, sin
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.messages import Sentence, sentence
from app.imaging.scan_order import ScanOrder
from app.imaging.skin_grid import GridPlace, SkinGrid
from app.planning.plan import Plan

BORE_MM: Final = 350.0
"""Radius of a scanner's bore: 70 cm is usual."""


@dataclass(frozen=True, slots=True)
class NeedleAngles:
    """Direction of a path as it is dialled.

    Attributes:
        in_plane_deg: in the slice, from straight down; positive towards growing grid numbers.
        cranio_caudal_deg: out of the slice, positive towards the head.
    """

    in_plane_deg: float
    cranio_caudal_deg: float


def needle_angles(plan: Plan, up: tuple[float, float], tilt_deg: float = 0.0) -> NeedleAngles:
    """Return the angles of a path; with a tilted gantry those to its slices.

    Args:
        plan: entry and target.
        up: direction that lies up, (x, y) of LPS.
        tilt_deg: of the gantry.
    """
    order = ScanOrder(0.0, tilt_deg=tilt_deg)
    way = order.to_gantry @ (plan.target_mm - plan.entry_mm)
    across = float(way @ np.array([-up[1], up[0], 0.0]))
    down = float(way @ np.array([-up[0], -up[1], 0.0]))
    return NeedleAngles(
        degrees(atan2(across, down)), degrees(atan2(float(way[2]), hypot(across, down)))
    )


def direction_of(
    angles: NeedleAngles, up: tuple[float, float], tilt_deg: float = 0.0
) -> FloatArray:
    """Return the direction that is dialled, hub to tip, LPS, unit, shape (3,).

    It is the other way of `needle_angles`.
    """
    plane, head = radians(angles.in_plane_deg), radians(angles.cranio_caudal_deg)
    across, down = np.array([-up[1], up[0], 0.0]), np.array([-up[0], -up[1], 0.0])
    in_slice = sin(plane) * across + cos(plane) * down
    way = cos(head) * in_slice + sin(head) * np.array([0.0, 0.0, 1.0])
    return frozen(ScanOrder(0.0, tilt_deg=tilt_deg).to_gantry.T @ way)


def bore_room_mm(order: ScanOrder, isocentre_mm: FloatArray, plan: Plan, needle_mm: float) -> float:
    """Return the room between bore and hub of a needle at the entry [mm]; negative for none.

    The bore is as wide all along: a tilted one narrows what is left above the patient.

    Args:
        order: where the table stands, and how the gantry is tilted.
        isocentre_mm: place of the gantry's axis on the patient, LPS, shape (3,).
        plan: the path, along which the needle stands on the skin.
        needle_mm: its length.
    """
    way = (plan.entry_mm - plan.target_mm) / np.linalg.norm(plan.entry_mm - plan.target_mm)
    hub = order.in_gantry(plan.entry_mm + needle_mm * way)
    return BORE_MM - hypot(float(hub[0] - isocentre_mm[0]), float(hub[1] - isocentre_mm[1]))


@dataclass(frozen=True, slots=True, eq=False)
class EntryMark:
    """An entry that was marked on the skin.

    Attributes:
        place: as it was found with the grid.
        marked_mm: the marked point of the skin, LPS, shape (3,): the needle goes in there.
        planned_mm: the entry that was planned, LPS, shape (3,).
        error_mm: the way along the skin between the two.
        angles: of the planned path.
    """

    place: GridPlace
    marked_mm: FloatArray
    planned_mm: FloatArray
    error_mm: float
    angles: NeedleAngles

    @classmethod
    def of(cls, grid: SkinGrid, place: GridPlace, plan: Plan) -> EntryMark:
        """Mark a place for a plan.

        Raises:
            InvalidEntryError: if the grid does not reach the place or the planned entry.
        """
        marked = grid.point(place)
        error = grid.distance_mm(marked, plan.entry_mm)
        angles = needle_angles(plan, grid.spec.up)
        return cls(place, marked, frozen(plan.entry_mm, (3,), "planned"), error, angles)

    @property
    def words(self) -> Sentence:
        """Say it in one line."""
        return sentence(
            "entry marked at table {table:.1f} mm, line {line} {offset:+.1f} mm: {error:.1f} mm on "
            "the skin from the planned entry",
            table=self.place.table_mm,
            line=self.place.line,
            offset=self.place.offset_mm,
            error=self.error_mm,
        )

    def data(self) -> dict[str, object]:
        """Return JSON-ready values; `mark_of` reads them back."""
        return {
            "table_mm": self.place.table_mm,
            "line": self.place.line,
            "offset_mm": self.place.offset_mm,
            "marked_lps_mm": self.marked_mm.tolist(),
            "planned_lps_mm": self.planned_mm.tolist(),
            "error_mm": self.error_mm,
            "in_plane_deg": self.angles.in_plane_deg,
            "cranio_caudal_deg": self.angles.cranio_caudal_deg,
        }


def mark_of(data: Mapping[str, Any]) -> EntryMark:
    """Read `EntryMark.data` back.

    Raises:
        LookupError, TypeError, ValueError, AcusError: if it is damaged.
    """
    return EntryMark(
        GridPlace(float(data["table_mm"]), int(data["line"]), float(data["offset_mm"])),
        frozen(data["marked_lps_mm"], (3,), "marked_lps_mm"),
        frozen(data["planned_lps_mm"], (3,), "planned_lps_mm"),
        float(data["error_mm"]),
        NeedleAngles(float(data["in_plane_deg"]), float(data["cranio_caudal_deg"])),
    )
