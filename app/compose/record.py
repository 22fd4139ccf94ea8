"""What stands at the head of a record: metadata of a run and the documents attached to it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from app.core.build import BUILD, build
from app.core.errors import AcusError
from app.exchange.markups import plan_document
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.planning.registration.record import Registrations
from app.session.conditions import CONDITIONS
from app.session.context import RunContext
from app.session.ct_facts import CtFacts
from app.session.header import Attachment


def run_context(
    exercise: Exercise,
    folder: Path,
    seed: int,
    metadata: Mapping[str, dict[str, str]],
    documents: Mapping[str, Any],
    agreement: Callable[[PlacedPlan], Mapping[str, str]] = lambda _: {},
) -> RunContext:
    """Return the context of a run's records.

    Args:
        exercise: attached without what may name a patient.
        folder: of the records.
        seed: of everything random.
        metadata: `device`, `cameras`, `ct`, `trainee`.
        documents: further pydantic models to attach, by name.
        agreement: how well screen and needle agree at a plan's target; see `agreement_of`.
    """
    anonymous = _anonymous(exercise)
    attached = {"exercise": anonymous, **documents}
    return RunContext(
        folder=folder,
        seed=seed,
        metadata={**metadata, CONDITIONS: _conditions(anonymous), BUILD: build()},
        attachments=tuple(
            _attachment(f"{name}.json", document.model_dump(mode="json"))
            for name, document in attached.items()
        ),
        plan_files=lambda placed: (_attachment("plan.mrk.json", plan_document(placed.plan)),),
        agreement=agreement,
    )


def agreement_of(
    calibration: str, rig: str, simulated: bool, ct: CtFacts
) -> Callable[[PlacedPlan], Mapping[str, str]]:
    """Return what looks up how well screen and needle agree at a plan's target.

    It takes the newest registration check that holds for these cameras and this CT, and gives the
    metadata record `agreement`: `radius_mm` and the `check`'s id; nothing where nobody has checked.
    """

    def look(placed: PlacedPlan) -> Mapping[str, str]:
        try:
            record = Registrations.own().newest(
                calibration, rig, simulated, ct.pseudonym, frame=ct.frame
            )
            if record is None:
                return {}
            used = placed.T_world_patient
            radius = record.check().agreement(placed.p_target, T_world_patient=used).radius
        except AcusError:  # the status strip and the check's own page say what is wrong with it
            return {}
        return {"radius_mm": f"{1e3 * radius:.3f}", "check": record.id}

    return look


def _conditions(exercise: Exercise) -> dict[str, str]:
    """Return what the exercise sets, as a score is told with it, and a digest of its content."""
    content = exercise.model_dump(
        mode="json", exclude_defaults=True, exclude={"title", "description", "views", "assistance"}
    )
    text = json.dumps(content, sort_keys=True)
    return {
        "level": str(exercise.level),
        "views": ",".join(sorted(view.value for view in exercise.shown_views)),
        "assistance": repr(exercise.assistance),
        "content": hashlib.sha256(text.encode()).hexdigest()[:12],
    }


def _anonymous(exercise: Exercise) -> Exercise:
    """Without folders, files and series, which may name a patient; the record has a pseudonym."""
    ct = exercise.ct.model_copy(update={"folder": None, "series": None})
    structures = tuple(
        part.model_copy(update={"file": Path(f"structures-{number}")})
        for number, part in enumerate(exercise.structures, 1)
    )
    return exercise.model_copy(update={"ct": ct, "structures": structures})


def _attachment(name: str, document: Any) -> Attachment:
    return Attachment(name, "application/json", json.dumps(document, indent=1).encode())
