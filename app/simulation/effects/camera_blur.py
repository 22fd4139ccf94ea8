"""Blurred pictures: out of focus, and moved during the exposure.

The defocus is a point spread of standard deviation σ beside that of the rig's own lens:
`gaussian`, cut off at 4 σ, or `box`, the mean over the square of the nearest odd width
sqrt(12 σ² + 1), which costs less and has the same spread for whole odd widths only. The motion is
that of a camera that shakes: the mean over a line of the picture, the same in all of them.

The tracker's model of the marker knows the lens' own spread (0.7 px): 0.6 px more make its centre
noisier by a quarter, 0.8 px more hide it.

Where no pictures are made (a trial in virtual time) the marker's centre is noisier instead, as
measured in rendered pictures. Made by `tracking.simulated.picture_effects`.
"""

from typing import Any, Final

DECLARATION: Final[dict[str, Any]] = {
    "title": "Cameras are out of focus or shake",
    "pictures": True,
    "reads": (),
    "writes": (),
    "consumers": ("tracker with simulated cameras",),
    "needs": (),
    "models": {
        "gaussian": "out of focus as a Gaussian",
        "box": "as the mean over a square: cheaper, its width a whole odd number of pixels",
    },
    "energy": ("dissipative", "acts on pictures: no force"),
    "cost_class": "C",
    "parameters": {
        "defocus": (0.6, "px", 0.0, 8.0, "standard deviation of the point spread"),
        "motion": (0.0, "px", 0.0, 30.0, "length of the line that a point becomes by shaking"),
        "direction": (0.0, "rad", -3.2, 3.2, "of that line, from the rows clockwise"),
    },
}
