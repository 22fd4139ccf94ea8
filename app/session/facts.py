"""The plan and its placement as a metadata record, so that a record can be scored by itself."""

import json
from typing import Final

from app.core.errors import AcusError
from app.core.messages import sentence
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.errors import BrokenRecordingError

PLAN: Final = "plan"
"""Name of the metadata record that holds plan and placement."""


def plan_record(placed: PlacedPlan) -> dict[str, str]:
    """Plan, placement and fulcrum as text values; numbers in full precision."""
    return {
        "name": placed.plan.name,
        "entry_lps_mm": json.dumps(placed.plan.entry_mm.tolist()),
        "target_lps_mm": json.dumps(placed.plan.target_mm.tolist()),
        "orientation": str(placed.placement.orientation),
        "rotation_deg": json.dumps(list(placed.placement.rotation_deg)),
        "fulcrum_m": json.dumps(placed.p_entry.tolist()),
    }


def placed_plan(record: dict[str, str]) -> PlacedPlan:
    """Inverse of `plan_record`.

    Raises:
        BrokenRecordingError: if a value is missing or not usable.
    """
    try:
        plan = Plan(
            json.loads(record["entry_lps_mm"]), json.loads(record["target_lps_mm"]), record["name"]
        )
        x, y, z = json.loads(record["rotation_deg"])
        placement = Placement(PatientOrientation(record["orientation"]), (x, y, z))
        return PlacedPlan.of(plan, placement, json.loads(record["fulcrum_m"]))
    except KeyError as error:
        raise BrokenRecordingError(
            sentence("the record's plan has no {error}", error=error)
        ) from error
    except (AcusError, ValueError, TypeError) as error:
        raise BrokenRecordingError(
            sentence("the record's plan is not usable: {error}", error=error)
        ) from error
