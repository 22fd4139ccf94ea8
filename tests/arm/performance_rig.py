"""What an arm did along a plan, made up: no MuJoCo, no planner, a few seconds in all."""

import numpy as np

from app.arm.scene.layout import ArmScene
from app.arm.scene.performance import ArmPerformance, ArmTimeline
from app.core.transform import RigidTransform, rotation_between

PHASES = ("approach", "grasp", "lift", "transfer", "align", "pivot", "insert")
OUTSIDE = -0.005
"""Depth of the tip when the shaft stands over the entry [m]."""


def performance_of(placed, fetch=0.6, pivot=0.4, insert=2.0, askew=0.05):
    """Fetch for `fetch` s, turn from `askew` rad beside the path for `pivot` s, insert."""
    scene = ArmScene.seeded(1)
    # The scene's trocar is the entry; its axes are those of the bench.
    T_scene_world = RigidTransform.from_translation(scene.trocar.p_world - placed.p_entry)
    end = fetch + pivot + insert
    time = np.linspace(0.0, end, int(50 * end) + 1)
    across = np.cross(placed.axis, np.eye(3)[int(np.argmin(np.abs(placed.axis)))])
    across /= np.linalg.norm(across)
    turn = np.clip((fetch + pivot - time) / pivot, 0.0, 1.0) * askew
    axes = np.cos(turn)[:, None] * placed.axis + np.sin(turn)[:, None] * across
    share = np.clip((time - fetch - pivot) / insert, 0.0, 1.0)
    depth = OUTSIDE + share * (placed.length - OUTSIDE)
    tips = scene.trocar.p_world + depth[:, None] * axes
    fetched = np.clip(time / fetch, 0.0, 1.0)[:, None]
    lying = scene.T_world_tool @ np.array([0.0, 0.0, scene.tool.length])
    tips = np.where(fetched < 1.0, lying + fetched * (tips - lying), tips)
    q = scene.home + 0.3 * fetched * np.ones(7)
    phase = np.minimum(5 * time / fetch, 4).astype(int)
    phase[time >= fetch - 1e-9] = 5
    phase[time >= fetch + pivot - 1e-9] = 6
    timeline = ArmTimeline(
        time=time,
        q=q,
        fingers=np.full((len(time), 3, 2), 0.5),
        p_tool=tips - scene.tool.length * axes,
        R_tool=np.array([rotation_between([0.0, 0.0, 1.0], axis) for axis in axes]),
        held=phase > 0,
        phase=phase,
        names=PHASES,
    )
    return ArmPerformance(scene, timeline, T_scene_world, {}, (), 1)
