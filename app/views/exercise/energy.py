"""The robot's energy as figures and words. Pure.

The passivity guard keeps a tank: every force law declares the energy it stores and how much it may
store at most; that is the tank's size. Energy let out at the motors' port is drawn from it. What a
law would let out beyond is taken out by the guard, which weakens or damps the force.
"""

from dataclasses import dataclass

import numpy as np

from app.core import state_vector as sv
from app.session.snapshot import Snapshot
from app.views.exercise.status_items import Verdict
from app.views.kit.text import tr

LITTLE = 0.1
"""Share of the tank from which on there is little left."""


@dataclass(frozen=True, slots=True)
class EnergyFigures:
    """The energy of one moment; energies in J.

    Attributes:
        stored: what the force laws store now.
        tank: what may still be let out.
        bound: size of the tank; 0 while no guard accounts for energy.
        out: let out at the motors' port since arming; negative: taken in.
        scale: factor of the guard on the torques, 1 while it does not act.
        damping: that the guard adds [N·m·s/rad].
        loss: taken out by the guard since arming.
    """

    stored: float
    tank: float
    bound: float
    out: float
    scale: float
    damping: float
    loss: float

    @property
    def known(self) -> bool:
        """Whether a guard accounts for the energy."""
        return self.bound > 0.0

    @property
    def acting(self) -> bool:
        """Whether the guard takes energy out now."""
        return self.known and (self.scale < 1.0 or self.damping > 0.0)

    @property
    def share_left(self) -> float:
        """Share of the tank that may still be let out, 0…1."""
        return min(1.0, max(0.0, self.tank / self.bound)) if self.known else 0.0

    @property
    def share_stored(self) -> float:
        """What the laws store as a share of the tank, 0…1."""
        return min(1.0, max(0.0, self.stored / self.bound)) if self.known else 0.0


def energy_figures(snapshot: Snapshot) -> EnergyFigures | None:
    """Energy of a snapshot; None where the robot says nothing, or nothing finite."""
    if snapshot.device is None:
        return None
    slots = [sv.POTENTIAL, sv.ENERGY_TANK, sv.ENERGY_BOUND, sv.ENERGY_OUT, sv.GUARD_SCALE,
             sv.GUARD_DAMPING, sv.GUARD_LOSS]  # fmt: skip
    values = snapshot.device.row[slots]
    return EnergyFigures(*values.tolist()) if np.isfinite(values).all() else None


def millijoules(energy: float) -> str:
    """Say an energy [J]; a hand's springs store thousandths."""
    value = 1e3 * energy
    if abs(value) >= 1e3:
        return tr("{joules:.3g} J", joules=energy)
    return tr("{value:.1f} mJ", value=value) if abs(value) < 100 else tr("{v:.0f} mJ", v=value)


def guard_words(figures: EnergyFigures | None) -> tuple[Verdict, str]:
    """Verdict on the guard, and what it does, in words."""
    if figures is None or not figures.known:
        return Verdict.IDLE, tr("no energy account")
    if figures.acting:
        parts = []
        if figures.scale < 1.0:
            parts.append(tr("force at {share:.0f} %", share=100 * max(0.0, figures.scale)))
        if figures.damping > 0.0:
            parts.append(tr("damping added"))
        return Verdict.WARNING, tr("guard acts: {what}", what=", ".join(parts))
    if figures.share_left < LITTLE:
        return Verdict.WARNING, tr("tank nearly empty")
    return Verdict.GOOD, tr("guard at rest")


def gauge_help() -> str:
    """Say what the gauge shows and what to do."""
    return tr(
        "Energy of the robot's force. Filled: what the force laws store now, as springs do. Line: "
        "what may still be let out to the hand, of the most they have declared. When it runs out, "
        "the guard weakens or damps the force, so that the robot cannot run away; that is no "
        "fault. If it acts often, lower the assistance, or look at the loop's lateness."
    )
