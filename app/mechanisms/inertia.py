"""Inertias of the pantograph, lumped to the constants of its equations of motion."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LumpedInertia:
    """Constants of the equations of motion, the same for both arms.

    Attributes:
        driven: A = I1 + m1 c1² + m2 a1² + reflected rotor [kg·m²].
        passive: D = I2 + m2 c2² [kg·m²].
        coupling: B = m2 a1 c2 [kg·m²].
        tool: mass at P3, m3 [kg].
    """

    driven: float
    passive: float
    coupling: float
    tool: float

    @property
    def values(self) -> tuple[float, float, float, float]:
        """Return (driven, passive, coupling, tool): what the kernels take."""
        return self.driven, self.passive, self.coupling, self.tool
