"""Pictures that come through JPEG, as from a USB camera in its mode MJPG.

The finished picture of 8 bits is coded and decoded again by OpenCV's own codec: blocks of 8 × 8
pixels, brightness at full resolution, the two colour differences at less: by half across and down
(`4:2:0`), by half across (`4:2:2`), or not (`4:4:4`). A red marker's edge is mostly colour, so the
subsampling spreads it over two pixels, and the quantisation leaves steps at the blocks' borders.

The time is that of coding and decoding; a real camera codes by itself. Where no pictures are made
(a trial in virtual time) it changes nothing: the marker's centre has the noise that
`tracking.simulated.sampled` gives it. Made by `tracking.simulated.delivery`.
"""

from typing import Any, Final

DECLARATION: Final[dict[str, Any]] = {
    "title": "Cameras deliver JPEG",
    "pictures": True,
    "reads": (),
    "writes": (),
    "consumers": ("tracker with simulated cameras",),
    "needs": (),
    "models": {
        "4:2:0": "colour at half the resolution in both directions",
        "4:2:2": "colour at half the resolution across, as most USB cameras have it",
        "4:4:4": "colour at full resolution",
    },
    "energy": ("dissipative", "acts on pictures: no force"),
    "cost_class": "C",
    "parameters": {
        "quality": (90.0, "-", 30.0, 100.0, "of the coding; 100 is nearly lossless"),
    },
}
