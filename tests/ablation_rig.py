"""A liver with a round lesion, a vessel and gut beside it, and three electrodes by one entry."""

import numpy as np

from app.exercises.ablation import AblationPart
from app.exercises.procedure import ProcedurePart
from app.imaging.field import TissueKind
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.ablation import AblationState
from app.session.procedure import NeedleNow, ProcedureState
from tests.field_rig import ball, beyond, field_of_shapes

FULCRUM = np.array([0.0, 0.16056, 0.090])
ENTRY = (0.0, -80.0, 0.0)
TARGETS = ((7.0, 15.0, 0.0), (-4.0, 15.0, 6.5), (-4.0, 15.0, -6.5))


def liver(capsule_mm=60.0, vessel_mm=None, gut_mm=None):
    """Return the field of a liver.

    Args:
        capsule_mm: the liver ends so far to the left of the lesion's middle.
        vessel_mm: a hepatic vein, a ball of 3 mm radius, lies so far to the right of the middle.
        gut_mm: colon begins so far below the middle.
    """
    shapes = [
        (TissueKind.ORGAN, "liver", ball((0.0, 0.0, 0.0), 70.0)),
        (TissueKind.FAT, "", beyond((1.0, 0.0, 0.0), capsule_mm)),
    ]
    if gut_mm is not None:
        shapes.append((TissueKind.GUT, "colon", beyond((0.0, 0.0, -1.0), gut_mm)))
    shapes.append((TissueKind.ORGAN, "lesion", ball((0.0, 0.0, 0.0), 11.0)))
    if vessel_mm is not None:
        shapes.append((TissueKind.VESSEL, "hepatic vein", ball((-vessel_mm, 0.0, 0.0), 3.0)))
    return field_of_shapes(shapes, (-50.0, -50.0, -50.0), (101, 101, 101))


def part(**changes):
    """Return what is asked for: three electrodes, 40 W for 20 min."""
    asked = {
        "power_w": 40.0,
        "minutes": 20.0,
        "lesion_mm": (0.0, 0.0, 0.0),
        "electrodes": tuple({"target_mm": target} for target in TARGETS[1:]),
    }
    return ProcedurePart(ablation=AblationPart(**(asked | changes)))


def placed(target=TARGETS[0]):
    """Return the first electrode's path."""
    plan = Plan(np.array(ENTRY), np.array(target), "first")
    return PlacedPlan.of(plan, Placement(), FULCRUM)


def begin(field, asked=None):
    """Return how an attempt begins."""
    asked = asked or part()
    return ProcedureState.at_begin(asked, ablation=AblationState.of(asked, placed(), field))


def needle(plan, off=(0.0, 0.0, 0.0), depth=None, target=None):
    """Return the needle whose tip is at a path's target, or off it [m, in world].

    `target` is where the one at hand is now; None for that of the path, which rests.
    """
    tip = plan.p_target + np.array(off)
    target = plan.p_target if target is None else target
    return NeedleNow(tip, plan.axis, plan.length if depth is None else depth, target, True)
