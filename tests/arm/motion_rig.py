"""Things about the arm for tests: a post, a distance from it, and a tool in a trocar."""

from itertools import pairwise

import numpy as np

from app.arm.mechanics import ArmProfile, link_frames, load_arm
from app.arm.motion.pivot import HeldTool, Pivot
from app.arm.motion.searching import Collisions

ARM = load_arm()
TOOL = HeldTool(length=0.35, grip=0.25, axis_tool=[1.0, 0.0, 0.0])
PIVOT = Pivot(ARM, TOOL, [0.55, 0.0, 0.25], [0.05, -0.1, -1.0])
_ALONG = np.linspace(0.0, 1.0, 16)[:, None]


def post(arm: ArmProfile = ARM, at=(0.5, 0.0), radius=0.06, height=0.7, thick=0.05):
    """An upright post; the arm is three lines as thick as `thick`, looked at in 16 places each."""

    def distance(q):
        frames = link_frames(arm, q)
        shoulder, elbow, wrist = (frames[k][:3, 3] for k in (1, 3, 6))
        ends = (shoulder, elbow, wrist, wrist + arm.flange * frames[6][:3, 2])
        nearest = np.inf
        for a, b in pairwise(ends):
            places = a + _ALONG * (b - a)
            aside = np.hypot(places[:, 0] - at[0], places[:, 1] - at[1]) - radius
            above = places[:, 2] - height
            nearest = min(nearest, float((np.maximum(aside, above) - thick).min()))
        return nearest

    return Collisions(lambda q: distance(q) > 0.0, distance, beyond=0.0)
