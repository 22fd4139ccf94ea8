"""What every section of a profile is made of: bounded numbers with their origin.

The upper bounds are far above any desktop robot; they are there to catch a value in millimetres or
grams before a mechanism is built of it.
"""

from enum import StrEnum
from typing import Annotated

from pydantic import Field, model_validator

from app.core.configuration import Strict

Length = Annotated[float, Field(gt=0.0, le=2.0)]
"""[m]"""
Distance = Annotated[float, Field(ge=0.0, le=2.0)]
"""[m], may be zero"""
Coordinate = Annotated[float, Field(ge=-2.0, le=2.0)]
"""[m], of either sign"""
Mass = Annotated[float, Field(gt=0.0, le=20.0)]
"""[kg]"""
LinkMass = Annotated[float, Field(ge=1e-3, le=20.0)]
"""[kg] of a link; less than a gram holds no needle and breaks the equations"""
MassOrNone = Annotated[float, Field(ge=0.0, le=20.0)]
"""[kg], may be zero"""
Inertia = Annotated[float, Field(gt=0.0, le=5.0)]
"""[kg·m²]"""
InertiaOrNone = Annotated[float, Field(ge=0.0, le=5.0)]
"""[kg·m²], may be zero"""
Torque = Annotated[float, Field(gt=0.0, le=20.0)]
"""[N·m]"""
Angle = Annotated[float, Field(ge=-12.6, le=12.6)]
"""[rad], two turns either way"""
Acceleration = Annotated[float, Field(ge=-25.0, le=25.0)]
"""[m/s²]"""


class Provenance(StrEnum):
    """Where a value comes from.

    `MEASURED`: on this device. `PUBLISHED`: by whoever built it. `ESTIMATED`: by whoever wrote the
    profile. `IMPORTED`: from a file that does not say, such as a URDF.
    """

    MEASURED = "measured"
    PUBLISHED = "published"
    ESTIMATED = "estimated"
    IMPORTED = "imported"


class Section(Strict):
    """Part of a profile; `provenance` names the origin of each value that the file gives."""

    provenance: dict[str, Provenance]

    @model_validator(mode="after")
    def _every_value_has_one(self) -> "Section":
        fields = set(type(self).model_fields) - {"provenance"}
        wanted = {name for name in fields if getattr(self, name) is not None}
        if missing := sorted(wanted - set(self.provenance)):
            raise ValueError(f"no provenance for {', '.join(missing)}")
        if unknown := sorted(set(self.provenance) - wanted):
            raise ValueError(f"provenance of {', '.join(unknown)}, which the section does not have")
        return self
