"""Inertias of the pantograph and its needle, lumped to the constants of the equations of motion."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LumpedInertia:
    """Constants of the equations of motion, the same for both arms.

    Attributes:
        driven: A = I1 + m1 c1² + m2 a1² + reflected rotor [kg·m²].
        passive: D = I2 + m2 c2² [kg·m²].
        coupling: B = m2 a1 c2 [kg·m²].
        tool: mass at P3, m3 [kg].
        driven_moment: m1 c1 + m2 a1 [kg·m], which gravity acts on.
        passive_moment: m2 c2 [kg·m].
        needle_mass: of the needle with its hub [kg].
        needle_inertia: about its centre of mass, across the shaft [kg·m²].
        needle_centre: centre of mass from the hub point [m].
    """

    driven: float
    passive: float
    coupling: float
    tool: float
    driven_moment: float = 0.0
    passive_moment: float = 0.0
    needle_mass: float = 0.0
    needle_inertia: float = 0.0
    needle_centre: float = 0.0

    @property
    def values(self) -> tuple[float, float, float, float]:
        """Return (driven, passive, coupling, tool): what the kernels of the links take."""
        return self.driven, self.passive, self.coupling, self.tool
