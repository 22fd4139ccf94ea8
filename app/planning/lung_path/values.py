"""Values of the path report of a lung biopsy: what a straight path crosses, and what it comes near.

A figure is a number, or None: nobody labelled what would tell it. Records and windows read them;
nothing here computes.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from math import isfinite
from typing import Any, Final

Place = tuple[float, float, float]
"""LPS [mm]."""

LOOK_MM: Final = 40.0
"""Ribs and intercostal vessels are looked for so far from the path; the figure is no larger."""

PROTECTED_FROM_MM: Final = 60.0
"""Nearer to the spine than this the rib's border does not protect the intercostal artery: it was
shielded in 17 % at 3 cm and 97 % at 6 cm (Helm et al. 2013, doi 10.1378/chest.12-1285)."""

LEAST_TUBE_MM: Final = 3.0
"""Vessels and bronchi of this diameter are named."""

TUBE_ROOM_MM: Final = 3.0
"""And those that the path does not meet, where they are no farther from it."""


@dataclass(frozen=True, slots=True)
class LungCrossing:
    """A pleura or fissure on the way.

    Attributes:
        depth_mm: along the path, from the entry.
        angle_deg: between the path and the normal, 0 straight through; None where another tissue
            lies on the fissure.
        place_mm: LPS.
        goes_in: of the pleura: whether the path enters the lung here.
        beyond: of a fissure: the lobe that begins.
    """

    depth_mm: float
    angle_deg: float | None
    place_mm: Place
    goes_in: bool = True
    beyond: str = ""


@dataclass(frozen=True, slots=True)
class TubeNear:
    """A vessel or bronchus that the path meets, or comes near.

    Attributes:
        name: of the tissue.
        diameter_mm: of it, its wall included.
        away_mm: from the path to its wall; 0 where it is met.
        depth_mm: along the path where it is nearest.
        place_mm: on the path there, LPS.
    """

    name: str
    diameter_mm: float
    away_mm: float
    depth_mm: float
    place_mm: Place


@dataclass(frozen=True, slots=True)
class LungPathReport:
    """What a straight path to a target in the lung goes through; None is not known.

    Attributes:
        entry_mm, target_mm: ends of the path, LPS.
        length_mm: of the path.
        unknown_mm: of it, through what nobody labelled.
        pleura: where it is crossed, in order.
        fissures: likewise; each is two more layers of pleura, and not in `pleura`.
        lung_mm: length within the pleura up to the lesion: aerated lung, and the vessels and
            bronchi that run in it, as published lengths of needle in lung have it.
        emphysema_mm: of that, through emphysema.
        rib_below_mm: from the path in the chest wall to the upper border of the rib below;
            `LOOK_MM` where there is none nearer. A rib that the path meets is 0 away, on the side
            on which most of it lies.
            None too where the labels end before a rib.
        rib_above_mm: likewise to the lower border of the rib above.
        rib_below_at, rib_above_at: the rib's nearest place, LPS; None where there is none.
        intercostal_mm: from the path to the nearest intercostal vessel, at most `LOOK_MM`.
        spine_mm: from the place where the pleura is entered to the vertebral bodies' mid-line:
            sideways where the place lies behind their front, else across the body.
        is_protected: whether a rib's border covers the artery there.
        vessels, bronchi: of `LEAST_TUBE_MM` and more, met or near, the first on the path first.
    """

    entry_mm: Place
    target_mm: Place
    length_mm: float
    unknown_mm: float
    pleura: tuple[LungCrossing, ...] | None
    fissures: tuple[LungCrossing, ...] | None
    lung_mm: float | None
    emphysema_mm: float | None
    rib_below_mm: float | None
    rib_above_mm: float | None
    rib_below_at: Place | None
    rib_above_at: Place | None
    intercostal_mm: float | None
    spine_mm: float | None
    is_protected: bool | None
    vessels: tuple[TubeNear, ...] | None
    bronchi: tuple[TubeNear, ...] | None

    @property
    def pleural_deg(self) -> float | None:
        """Angle at which the lung is first entered; None where nobody knows."""
        entered = [one.angle_deg for one in self.pleura or () if one.goes_in]
        return entered[0] if entered else None

    @property
    def rib_mm(self) -> float | None:
        """Distance from the nearer rib's border; None where nobody knows."""
        both = [mm for mm in (self.rib_below_mm, self.rib_above_mm) if mm is not None]
        return min(both, default=None)

    def document(self) -> dict[str, Any]:
        """Return it as JSON-ready values; None stays null."""
        found: dict[str, Any] = _plain(asdict(self))
        return found

    @classmethod
    def of(cls, document: dict[str, Any]) -> LungPathReport:
        """Read what `document` wrote.

        Raises:
            LookupError, TypeError, ValueError: if it is no such document.
        """
        several = {
            "pleura": LungCrossing,
            "fissures": LungCrossing,
            "vessels": TubeNear,
            "bronchi": TubeNear,
        }
        known: dict[str, Any] = {}
        for name in cls.__dataclass_fields__:
            value = document[name]
            if name in several:
                kind = several[name]
                known[name] = (
                    None
                    if value is None
                    else tuple(kind(**one | {"place_mm": _place(one["place_mm"])}) for one in value)
                )
            elif name in ("entry_mm", "target_mm") or (name.endswith("_at") and value is not None):
                known[name] = _place(value)
            elif value is None or isinstance(value, bool):
                known[name] = value
            else:
                known[name] = float(value)
                if not isfinite(known[name]):
                    raise ValueError(value)
        return cls(**known)


def _place(values: Any) -> Place:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value
