"""Five skills of the scripted trainee, ordered by how far off the needle is left.

Angles between needle and planned path that are published for CT-guided insertions: 3.4 ± 3.1°
freehand, 1.3 ± 0.9° with guidance. Three skills stand on these figures, two between them:

| skill      | angle it leaves, before the robot helps | stands for                           |
|------------|-----------------------------------------|--------------------------------------|
| novice     | 2.8 … 4.0°, mean 3.4°                   | mean freehand                        |
| beginner   | 2.1 … 3.3°, mean 2.7°                   | a third of the way to guided         |
| competent  | 1.4 … 2.6°, mean 2.0°                   | two thirds of the way                |
| proficient | 0.7 … 1.9°, mean 1.3°                   | mean with guidance                   |
| expert     | 0.1 … 0.4°                              | up to the guided mean less 1 SD      |

The names are the five stages of Dreyfus (1980). The published distance, 6.3 ± 3.6 mm freehand,
contains an error of the entry, which this device cannot have: the distance follows from the angle
at the target's depth. Durations, draws and lengths of a script do not depend on the angles, so
that records of earlier angles replay.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.core.messages import sentence
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


NOVICE = Skill(
    name="novice",
    hover=2.0,
    align=4.5,
    speed=0.013,
    start_error=_degrees(8.0, 14.0),
    aim_error=_degrees(3.0, 4.0),
    final_error=_degrees(2.8, 4.0),
    drift=float(np.deg2rad(0.5)),
    tremor=float(np.deg2rad(0.08)),
    tremor_depth=8e-5,
    redirects=1,
    overshoot=(3e-3, 6e-3),
    depth_error=(0.5e-3, 2e-3),
)

BEGINNER = Skill(
    name="beginner",
    hover=1.8,
    align=4.0,
    speed=0.014,
    start_error=_degrees(7.0, 13.0),
    aim_error=_degrees(2.4, 3.6),
    final_error=_degrees(2.1, 3.3),
    drift=float(np.deg2rad(0.4)),
    tremor=float(np.deg2rad(0.065)),
    tremor_depth=6.5e-5,
    redirects=1,
    overshoot=(2.3e-3, 4.5e-3),
    depth_error=(0.4e-3, 1.5e-3),
)

COMPETENT = Skill(
    name="competent",
    hover=1.5,
    align=3.6,
    speed=0.016,
    start_error=_degrees(6.5, 12.0),
    aim_error=_degrees(1.7, 2.9),
    final_error=_degrees(1.4, 2.6),
    drift=float(np.deg2rad(0.3)),
    tremor=float(np.deg2rad(0.05)),
    tremor_depth=5e-5,
    redirects=1,
    overshoot=(1.6e-3, 3.2e-3),
    depth_error=(0.3e-3, 1.1e-3),
)

PROFICIENT = Skill(
    name="proficient",
    hover=1.2,
    align=3.2,
    speed=0.018,
    start_error=_degrees(6.0, 10.0),
    aim_error=_degrees(0.8, 2.0),
    final_error=_degrees(0.7, 1.9),
    drift=float(np.deg2rad(0.2)),
    tremor=float(np.deg2rad(0.035)),
    tremor_depth=3.5e-5,
    redirects=0,
    overshoot=(0.8e-3, 1.8e-3),
    depth_error=(0.1e-3, 0.7e-3),
)

EXPERT = Skill(
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

SKILLS = {skill.name: skill for skill in (NOVICE, BEGINNER, COMPETENT, PROFICIENT, EXPERT)}
"""All by name, the least skilled first."""


def find_skill(skill: str | Skill) -> Skill:
    """Return a skill by name, or the one given.

    Raises:
        SimulationError: naming the skills that exist.
    """
    if isinstance(skill, Skill):
        return skill
    if skill not in SKILLS:
        raise SimulationError(
            sentence(
                "there is no skill {skill!r}; there are {skills}",
                skill=skill,
                skills=", ".join(SKILLS),
            )
        )
    return SKILLS[skill]
