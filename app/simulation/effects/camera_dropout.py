"""Cameras that lose pictures: what is lost arrives black, and the marker is not in it.

A share of the pictures is lost, in bursts: a loose plug or a busy bus loses several in a row
(Gilbert's channel of two states, good and lost). Each camera loses its own.

    good -> lost with p = q s / (1 - s),   lost -> good with q = 1 / burst,

s the share that is lost in the long run. The model `single` loses each picture by itself.

Where no pictures are made (a trial in virtual time) the marker is missed in as many, by the same
chain. Made by `tracking.simulated.picture_effects`.
"""

from typing import Any, Final

DECLARATION: Final[dict[str, Any]] = {
    "title": "Cameras lose pictures",
    "pictures": True,
    "reads": (),
    "writes": (),
    "consumers": ("tracker with simulated cameras",),
    "needs": (),
    "models": {
        "bursts": "several in a row, by a chain of two states",
        "single": "each by itself",
    },
    "energy": ("dissipative", "acts on pictures: no force"),
    "cost_class": "C",
    "parameters": {
        "share": (0.05, "-", 0.0, 0.5, "of the pictures that are lost"),
        "burst": (6.0, "-", 1.0, 300.0, "pictures that are lost in a row, on average (bursts)"),
    },
}
