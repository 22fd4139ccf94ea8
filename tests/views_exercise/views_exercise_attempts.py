"""A made-up attempt with a plausible course, for tests and pictures of the debrief."""

import numpy as np

from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.result import Score, judge
from app.scoring.rows import Row, ScoreRules
from app.session.curves import Curves
from app.session.review import Review, TimeMark, spans

FULCRUM = (0.0, 0.16056, 0.090)


def placed_plan() -> PlacedPlan:
    plan = Plan(np.array([-40.0, -120.0, 60.0]), np.array([-52.0, -40.0, 66.0]), "plan")
    return PlacedPlan.of(plan, Placement(), FULCRUM)


def curves(
    placed: PlacedPlan, duration: float = 64.0, seed: int = 3
) -> tuple[Curves, np.ndarray, np.ndarray]:
    """Figures, tip and state of an attempt that aligns, inserts in two goes and holds."""
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, duration, 0.02)
    goes = np.interp(t, [0, 14, 30, 38, 56, duration], [-0.01, -0.004, 0.045, 0.045, 0.079, 0.0795])
    depth = goes + 1e-4 * rng.standard_normal(len(t))
    decay = np.exp(-t / 9.0)[:, None]
    tilts = 0.20 * decay * np.column_stack([np.cos(0.5 * t), np.sin(0.5 * t)]) + [0.012, -0.018]
    right = np.cross(placed.axis, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, placed.axis)
    axis = placed.axis + tilts[:, :1] * right + tilts[:, 1:] * up
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    tip = placed.p_entry + depth[:, None] * axis
    tip[1500:1540] = np.nan
    beyond = tip - placed.p_target
    along = beyond @ placed.axis
    lateral = np.linalg.norm(beyond - along[:, None] * placed.axis, axis=1)
    angle = np.arctan2(np.linalg.norm(np.cross(axis, placed.axis), axis=1), axis @ placed.axis)
    felt = np.clip(22.0 * angle + 0.15 * np.abs(rng.standard_normal(len(t))), 0.0, 5.0)
    depth = np.where(np.isnan(tip[:, 0]), np.nan, depth)
    state = np.where(t < 15, "aligning", np.where(t < 57, "inserting", "holding"))
    return Curves(t, depth, lateral, -along, angle, felt), tip, state


def score(void: bool = False) -> Score:
    """A score with every band, a missing value and rows that do not count."""
    values = {
        "lateral_error": ("Off the path", "mm", 2.4),
        "depth_error": ("Depth error", "mm", -0.9),
        "angle_error": ("Angle error", "°", 2.7),
        "path_ratio": ("Path ratio", "", 1.72),
        "total_time": ("Total time", "s", 64.0),
        "peak_force": ("Peak force", "N", 4.4),
        "mean_force": ("Mean force", "N", 1.1),
        "guidance_work": ("Guidance work", "J", 0.031),
        "tracking_valid": ("Tracking valid", "%", 97.5),
    }
    rows = [
        Row(name, label, unit, value, "", DEFAULT_TOLERANCES.get(name))
        for name, (label, unit, value) in values.items()
    ]
    rows.append(Row("holding_time", "Holding time", "s", None, "the needle was never held"))
    return judge(tuple(rows), ScoreRules(), "the attempt was aborted: student" if void else "")


def review(**changes: object) -> Review:
    """The attempt as the debrief shows it."""
    placed = placed_plan()
    figures, tip, state = curves(placed)
    values: dict[str, object] = {
        "id": "20261121-101500-ab12", "student": "student-07",
        "exercise": "First insertion: liver lesion", "started": "2026-11-21T10:15:00.000+00:00",
        "state": "ended", "reason": "", "duration": 64.0, "scans": 2, "software": "0.1.0",
        "problems": (), "score": score(), "curves": figures, "spans": spans(figures.time, state),
        "marks": (TimeMark(33.0, "scan", "1"), TimeMark(59.0, "scan", "2")),
        "placed": placed, "tip": tip,
        "force_limit": 5.0,
    }  # fmt: skip
    return Review(**(values | changes))  # type: ignore[arg-type]
