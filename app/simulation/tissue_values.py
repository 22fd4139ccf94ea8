"""Values of the tissues of a field: one row for each code, by kind and name."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.simulation.scene import BONE, FAT, LIVER, LUNG, MUSCLE, SKIN, TissueLayer

if TYPE_CHECKING:
    from app.imaging.field import FieldTissue

_NOTHING: Final = TissueLayer(
    name="air",
    thickness=0.0,
    side_stiffness=0.0,
    friction=0.0,
    static_friction=0.0,
    viscous_friction=0.0,
    indentation_stiffness=0.0,
    indentation_hardening=0.0,
)
"""Air holds no needle."""

_UNKNOWN: Final = replace(MUSCLE, puncture_force=0.0)
"""What nobody labelled: as muscle without its fascia, so that it is felt and stops nothing."""

_BY_KIND: Final = {
    "unknown": _UNKNOWN,
    "air": _NOTHING,
    "lung": LUNG,
    "skin": SKIN,
    "fat": FAT,
    "muscle": MUSCLE,
    "organ": LIVER,
    "vessel": replace(LIVER, puncture_force=0.8, toughness=240.0),
    "gut": replace(LIVER, puncture_force=0.5, side_stiffness=10e3),
    "heart": replace(MUSCLE, puncture_force=1.0),
    "bone": BONE,
}
"""An organ is taken for liver; walls of vessel, gut and heart are estimates."""


def tissue_values(tissues: "Iterable[FieldTissue]") -> tuple[TissueLayer, ...]:
    """Return the values of a field's tissues by code; their thickness means nothing and is 0."""
    return tuple(
        replace(_BY_KIND[str(one.kind)], name=one.words, thickness=0.0) for one in tissues
    )
