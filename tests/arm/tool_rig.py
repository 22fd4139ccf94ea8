"""A table before two cameras, a tool and a trocar on it, drawn once per session."""

from functools import cache

import numpy as np

from app.arm.eyes.pictures import ToolRenderer, eyes, tool_outline
from app.arm.laparoscopy import ToolBody, TrocarRing

TOOL = ToolBody()
OUTLINE = tool_outline(TOOL)
TROCAR = TrocarRing(np.array([0.15, 0.0, 0.002]), np.array([0.05, -0.1, 1.0]))
LYING = ([0.1, 0.03, 0.009], [0.9, 0.3, 0.0])


@cache
def models():
    return eyes()


@cache
def renderers(tool=TOOL):
    return tuple(ToolRenderer(model, tool, TROCAR) for model in models())


def pictures(scene, sd_grey=4.0, seed=0, tool=TOOL):
    """Noisy pictures of both cameras."""
    rng = np.random.default_rng(seed)
    drawn = [renderer.render(scene) for renderer in renderers(tool)]
    noisy = [image + rng.normal(0.0, sd_grey, image.shape) for image in drawn]
    return tuple(np.clip(np.rint(image), 0, 255).astype(np.uint8) for image in noisy)
