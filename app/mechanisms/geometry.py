"""Lengths of the needle pantograph."""

from __future__ import annotations

from dataclasses import dataclass

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.mechanisms.errors import MechanismError


@dataclass(frozen=True, slots=True, eq=False)
class Geometry:
    """Symmetric five-bar pantograph in z = 0 below a fulcrum through which the needle slides.

    Motor axes stand at (∓base/2, 0, 0). Thesis numbering: P1 (left motor), P2, P3 (tool), P2', P1'.

    Attributes:
        proximal: length of the driven links a1 [m].
        distal: length of the passive links a2 [m].
        base: distance of the motor axes [m].
        fulcrum: P_I in world [m], shape (3,), above the plane of the links.
        needle_length: hub point to tip, C [m].

    Raises:
        MechanismError: if a length is not positive, or the fulcrum is not above the links.
    """

    proximal: float
    distal: float
    base: float
    fulcrum: FloatArray
    needle_length: float

    def __post_init__(self) -> None:
        for name in ("proximal", "distal", "base", "needle_length"):
            if not 0.0 < getattr(self, name) < float("inf"):
                raise MechanismError(
                    sentence(
                        "geometry: {name} is {length} m; a positive length is needed",
                        name=name,
                        length=getattr(self, name),
                    )
                )
        fulcrum = frozen(self.fulcrum, (3,), "fulcrum")
        if fulcrum[2] <= 0.0:
            raise MechanismError(
                sentence(
                    "geometry: the fulcrum stands at z = {fulcrum} m; it must be above the"
                    " links (z > 0)",
                    fulcrum=fulcrum[2],
                )
            )
        object.__setattr__(self, "fulcrum", fulcrum)

    @property
    def links(self) -> tuple[float, float, float]:
        """Return (a1, a2, base) [m]: what the planar kernels take."""
        return self.proximal, self.distal, self.base

    @property
    def fulcrum_xyz(self) -> tuple[float, float, float]:
        """Fulcrum as three plain numbers [m]: what the spatial kernels take."""
        x, y, z = self.fulcrum.tolist()
        return x, y, z
