"""Unsteadiness of the hand of mouse, keys, pen and gamepad, by the level of an exercise.

| | level 1 | level 5 and above | stands on |
|---|---|---|---|
| tremor at the hub, RMS | 40 µm | 160 µm | 15 to 254 µm measured (PMC3032442) |
| mean angle of the drift, pushing at 20 mm/s | 5.0° | 6.5° | see below |
| share of it at rest | 10 % | 10 % | estimated |
| lag | 0.10 s | 0.15 s | estimated |
| memory of the drift | 6 s | 6 s | estimated |
| bend while pushing 20 mm/s | 2.0° | 3.0° | estimated |
| depth moved by 10° turned while pushing | 0.9 mm | 2.6 mm | estimated |

Freehand insertions leave 3.4 ± 3.1° (Gruber-Rouh 2015), with all that the hand sees and mends on
the way: one that pushes without looking is taken as worse, by half that deviation and by all of it.
That share, and what is called estimated, was chosen so that who drags once and wheels in without a
second look does not score as who checks (`compose.pointer_hands`); no hand was measured for it.

The direction's two parts are independent: their standard deviation is the mean angle / √(π/2).
"""

from math import pi, radians, sqrt
from typing import Final

from app.core.parameters import Stage
from app.core.units import MILLIMETRE
from app.mechanisms.profile import DeviceProfile
from app.simulation.unsteady_hand import Unsteadiness, unsteady_stage

HIGHEST: Final = 5
"""From this level on a hand does not get any worse."""


def _unsteadiness(
    lag: float,
    tremor_mm: float,
    drift_deg: float,
    rest: float,
    memory: float,
    bend_deg: float,
    slip_mm: float,
) -> Unsteadiness:
    return Unsteadiness(
        lag=lag,
        tremor=tremor_mm * MILLIMETRE,
        tremor_along=tremor_mm * MILLIMETRE,
        drift=radians(drift_deg) / sqrt(0.5 * pi),
        rest=rest,
        memory=memory,
        bend=radians(bend_deg) / 0.02,
        slip=slip_mm * MILLIMETRE / radians(10.0),
    )


LEVEL_1: Final = _unsteadiness(0.10, 0.04, 5.0, 0.1, 6.0, 2.0, 0.9)
LEVEL_5: Final = _unsteadiness(0.15, 0.16, 6.5, 0.1, 6.0, 3.0, 2.6)


def hand_unsteady_by_level(profile: DeviceProfile) -> Stage:
    """Build the stage for a device; it rests until an attempt says which level."""
    return unsteady_stage(profile.needle_length, LEVEL_1, LEVEL_5, HIGHEST)
