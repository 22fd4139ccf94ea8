"""Light before the cameras: dimmer, from one side, flickering.

A picture's brightness is multiplied by

    level (1 + gradient u) (1 + flicker x_k),   u from -1 at its left edge to 1 at its right,

x_k drawn anew for every picture of each camera, normal, cut off at 2: lamps on mains beat with the
exposure. The model `gradient` leaves the flicker out. The camera's gain stays: the noise is what it
was, so a dim picture has less contrast to it, and a bright one saturates.

Where no pictures are made (a trial in virtual time) the marker's centre is noisier instead, as
measured in rendered pictures. Made by `tracking.simulated.picture_effects`.
"""

from typing import Any, Final

DECLARATION: Final[dict[str, Any]] = {
    "title": "Light before the cameras",
    "pictures": True,
    "reads": (),
    "writes": (),
    "consumers": ("tracker with simulated cameras",),
    "needs": (),
    "models": {
        "flicker": "dimmer, from one side, and another brightness in every picture",
        "gradient": "dimmer and from one side, the same in every picture",
    },
    "energy": ("dissipative", "acts on pictures: no force"),
    "cost_class": "C",
    "parameters": {
        "level": (0.6, "-", 0.1, 2.0, "brightness over that of the rig"),
        "gradient": (0.3, "-", -0.9, 0.9, "by which the right edge is brighter than the middle"),
        "flicker": (0.1, "-", 0.0, 0.4, "standard deviation from picture to picture (flicker)"),
    },
}
