"""The tissue field: labels of all that a needle can reach, and where in a voxel they end.

`making.field_of` makes it, of any CT; what stands here needs nothing compiled.
"""

from app.imaging.field.errors import FieldError
from app.imaging.field.storing import from_bytes, read, to_bytes, write
from app.imaging.field.tissue_field import (
    FARTHEST_MM,
    NOBODYS,
    STEPS_PER_MM,
    UNKNOWN,
    FieldTissue,
    Lookup,
    TissueField,
    TissueKind,
)

__all__ = [
    "FARTHEST_MM",
    "NOBODYS",
    "STEPS_PER_MM",
    "UNKNOWN",
    "FieldError",
    "FieldTissue",
    "Lookup",
    "TissueField",
    "TissueKind",
    "from_bytes",
    "read",
    "to_bytes",
    "write",
]
