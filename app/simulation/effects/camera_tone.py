"""The sensor's photons and the tone curve: what a camera makes of its light.

The scene is drawn in linear light. A pixel that takes in the share L of what makes it white counts
n electrons, Poisson of mean `full_well` L and read with a noise of `read_noise`; n / full_well is
what the tone curve makes a grey value of 255 of:

    srgb     IEC 61966-2-1: 12.92 L up to L = 0.0031308, from there 1.055 L^(1/2.4) - 0.055
    linear   L itself

The number is drawn from the normal distribution of its mean and variance. The photons stand in for
the rig's constant noise: brighter is noisier in light, and dimmer is noisier in grey values, where
the curve is steep.

Where no pictures are made (a trial in virtual time) it changes nothing: the marker's centre has the
noise that `tracking.simulated.sampled` gives it. Made by `tracking.simulated.delivery`.
"""

from typing import Any, Final

DECLARATION: Final[dict[str, Any]] = {
    "title": "Cameras count photons and apply a tone curve",
    "pictures": True,
    "reads": (),
    "writes": (),
    "consumers": ("tracker with simulated cameras",),
    "needs": (),
    "models": {
        "srgb": "the curve of sRGB, as nearly every USB camera delivers its pictures",
        "linear": "grey values in proportion to the light, as some industrial cameras deliver them",
    },
    "energy": ("dissipative", "acts on pictures: no force"),
    "cost_class": "C",
    "parameters": {
        "full_well": (4000.0, "e⁻", 200.0, 100000.0, "electrons of a white pixel"),
        "read_noise": (8.0, "e⁻", 0.0, 100.0, "standard deviation of reading a pixel"),
    },
}
