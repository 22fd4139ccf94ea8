"""Contact along the needle in many digits: relaxing tissue, bone under a sliding mass."""

from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import matrix

from tools.exact import exact

for words, tau in (("a millionth of its time", 1000.0), ("a thousand times its time", 1e-6)):

    @exact(
        f"spring of relaxing tissue after {words}",
        "e exp(-h/τ) + Δ τ/h (1 - exp(-h/τ))",
        2e-3,
        1e-4,
        1e-3,
        tau,
    )
    def _(stretch: Any, change: Any, h: Any, tau: Any) -> Any:
        decayed = mpmath.exp(-h / tau)
        return [stretch * decayed + change * tau / h * (1 - decayed)]


for stiffness, mass in ((1.0, 0.05), (4e4, 0.05), (5e5, 5.0)):

    @exact(
        f"bone of {stiffness:g} N/m under {mass:g} kg",
        "-m Φ₂₁/T and m (1 - Φ₂₂)/T of Φ = exp(A T)",
        stiffness,
        10.0,
        mass,
        1e-3,
    )
    def _(k: Any, b: Any, m: Any, tick: Any) -> Any:
        grown = mpmath.expm(matrix([[0, 1], [-k / m, -b / m]]) * tick, method="taylor")
        return [-m * grown[1, 0] / tick, m * (1 - grown[1, 1]) / tick]
