"""How a scripted trainee behaves: frozen skills, and the two that ship.

Aiming error and spread follow the published comparison of freehand and guided placement (angular
error 3.4 ± 3.1° against 1.3 ± 0.9°; target error 6.3 mm against 4.0 mm, Gruber-Rouh 2015). Tremor,
speeds and pauses are engineering defaults.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.simulation.errors import SimulationError


@dataclass(frozen=True, slots=True)
class Skill:
    """Behaviour of a scripted trainee. Ranges are (least, most), drawn per seed.

    Attributes:
        name: for display.
        hover: time above the skin before anything [s].
        align: time to turn onto the path [s].
        speed: mean speed of insertion [m/s].
        start_error: needle against path at the start [rad], range.
        aim_error: left after aligning [rad], range.
        final_error: left after the last redirection [rad], range.
        drift: slow wander of the direction while inserting [rad], amplitude.
        tremor: 8-12 Hz [rad], standard deviation; its share along the needle is `tremor_depth` [m].
        redirects: partial withdrawals with a new aim.
        overshoot: past the target before the correction [m], range.
        depth_error: left after the correction, either sign [m], range.
        hold: time held at the end [s].
    """

    name: str
    hover: float
    align: float
    speed: float
    start_error: tuple[float, float]
    aim_error: tuple[float, float]
    final_error: tuple[float, float]
    drift: float
    tremor: float
    tremor_depth: float
    redirects: int
    overshoot: tuple[float, float]
    depth_error: tuple[float, float]
    hold: float = 1.5


def _degrees(low: float, high: float) -> tuple[float, float]:
    return float(np.deg2rad(low)), float(np.deg2rad(high))


EXPERT: Final = Skill(
    name="expert",
    hover=1.0,
    align=2.8,
    speed=0.020,
    start_error=_degrees(5.0, 9.0),
    aim_error=_degrees(0.2, 0.8),
    final_error=_degrees(0.1, 0.4),
    drift=float(np.deg2rad(0.08)),
    tremor=float(np.deg2rad(0.02)),
    tremor_depth=2e-5,
    redirects=0,
    overshoot=(0.2e-3, 0.8e-3),
    depth_error=(0.0, 0.3e-3),
)

NOVICE: Final = Skill(
    name="novice",
    hover=2.0,
    align=4.5,
    speed=0.013,
    start_error=_degrees(8.0, 14.0),
    aim_error=_degrees(3.0, 4.0),
    final_error=_degrees(1.2, 2.4),
    drift=float(np.deg2rad(0.5)),
    tremor=float(np.deg2rad(0.08)),
    tremor_depth=8e-5,
    redirects=1,
    overshoot=(3e-3, 6e-3),
    depth_error=(0.5e-3, 2e-3),
)

SKILLS: Final[dict[str, Skill]] = {skill.name: skill for skill in (NOVICE, EXPERT)}


def find_skill(skill: str | Skill) -> Skill:
    """Return a skill by name, or the one given.

    Raises:
        SimulationError: naming the skills that exist.
    """
    if isinstance(skill, Skill):
        return skill
    if skill not in SKILLS:
        raise SimulationError(f"there is no skill {skill!r}; there are {', '.join(SKILLS)}")
    return SKILLS[skill]
