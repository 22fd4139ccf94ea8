"""Unsteadiness of the hand of mouse, keys, pen tablet and gamepad, by the level of an exercise.

| | level 1 | level 5 and above | published |
|---|---|---|---|
| turn in a push of 85 mm at one go, mean | 3.4° | 6.6° | see below |
| tremor at the hub, RMS | 40 µm | 160 µm | 15 to 254 µm (PMC3032442), 38 and 182 µm in surgery |
| unrest of the hub, RMS | 50 µm | 130 µm | 49 µm held still, 133 µm in work (Riviere 1997) |
| its memory | 1 s | 1 s | estimate; below 2 Hz (Riviere 1997) |
| lag | 0.10 s | 0.15 s | estimate |
| depth moved by 10° turned while pushing | 0.9 mm | 2.6 mm | estimate |

*Push.* What a freehand insertion under CT leaves, of which nobody sees the push: 3.4 ± 3.1°
(Gruber-Rouh 2015, PMC4499536) and, out of the plane, 7.0 and 6.3° (doi 10.1007/s00330-019-06477-1).
That is aim and push together; all of it is taken for the push, so it is an upper bound. That the
error grows in proportion to the way is measured for the hand alone (Gordon 1994); how large it is
with a needle in it is an estimate, none found: searched "directional variability of reaching
movements degrees", "needle angle change during insertion". 85 mm is the way of `simulation.hands`.

*No drift of its own.* A hand that is not seen drifts 5 cm in 88 movements of 15 cm (PMC5607024),
the more the more it moves (Brown 2003, doi 10.1007/s00221-003-1601-7): 0.4 % of the way, 0.3 mm in
an insertion, less than a tenth of a push's error. An earlier hand wandered by 5.0 to 6.5° while it
pushed: nothing published supports that, and it is gone.

*Estimates*, none found: lag and damping (searched "hand weight lag mouse movement delay") and the
depth (searched "needle tilt depth coupling insertion"). To see and to answer takes 0.2 s more,
which is the person's and not the hand's. Fitts' law needs no size of its own: speed and
acceleration of the hand are bounded in `mechanisms.hand_motion`.

The push's two parts are independent: their standard deviation is the mean angle / √(π/2).
"""

from math import pi, radians, sqrt
from typing import Final

from app.core.parameters import Stage
from app.core.units import MILLIMETRE
from app.mechanisms.profile import DeviceProfile
from app.simulation.unsteady_hand import Unsteadiness, unsteady_stage

HIGHEST: Final = 5
"""From this level on a hand does not get any worse."""


AN_INSERTION: Final = 0.085
"""Way after which a push of one go has turned the needle by the angle in the table [m]."""


def _unsteadiness(
    lag: float, tremor_mm: float, unrest_mm: float, turn_deg: float, slip_mm: float
) -> Unsteadiness:
    return Unsteadiness(
        lag=lag,
        tremor=tremor_mm * MILLIMETRE,
        tremor_along=tremor_mm * MILLIMETRE,
        unrest=unrest_mm * MILLIMETRE,
        memory=1.0,
        aside=radians(turn_deg) / sqrt(0.5 * pi) / AN_INSERTION,
        slip=slip_mm * MILLIMETRE / radians(10.0),
    )


LEVEL_1: Final = _unsteadiness(0.10, 0.04, 0.05, 3.4, 0.9)
LEVEL_5: Final = _unsteadiness(0.15, 0.16, 0.13, 6.6, 2.6)


def hand_unsteady_by_level(profile: DeviceProfile) -> Stage:
    """Build the stage for a device; it rests until an attempt says which level."""
    return unsteady_stage(profile.needle_length, LEVEL_1, LEVEL_5, HIGHEST)
