"""What the user changes of a patient: three editors whose steps are undone in one order."""

from __future__ import annotations

from dataclasses import dataclass

from app.views.measure.editor import MeasureEditor
from app.views.plan.editor import PlanEditor
from app.views.structures.book import StructureBook


@dataclass(frozen=True, slots=True, eq=False)
class Editors:
    """The editors, each with a history of its own (`shell.undo.UndoOrder` puts them in order).

    Attributes:
        plan: entry, target and position of the patient.
        measures: distances, angles, regions.
        structures: organs and risks: files, and what was marked by hand.
    """

    plan: PlanEditor
    measures: MeasureEditor
    structures: StructureBook
