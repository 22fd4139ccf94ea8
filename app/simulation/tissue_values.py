"""Values of the tissues of a field: one row for each code, by kind and name."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.simulation.scene import TissueLayer
from app.simulation.tissues import BONE, FAT, KIDNEY, LIVER, LUNG, MUSCLE, SKIN

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
    "gut": replace(LIVER, puncture_force=0.5),
    "heart": replace(MUSCLE, puncture_force=1.0),
    "bone": BONE,
}
"""An organ is taken for liver; walls of vessel, gut and heart are estimates, none found."""

_BY_NAME: Final = {"kidney": KIDNEY}


def tissue_values(tissues: "Iterable[FieldTissue]") -> tuple[TissueLayer, ...]:
    """Return the published values of a field's tissues by code; their thickness means nothing."""
    return tuple(replace(_values(one), name=one.words, thickness=0.0) for one in tissues)


def _values(tissue: "FieldTissue") -> TissueLayer:
    words = tissue.name.casefold()
    named = [values for name, values in _BY_NAME.items() if name in words]
    return named[0] if named and str(tissue.kind) == "organ" else _BY_KIND[str(tissue.kind)]
