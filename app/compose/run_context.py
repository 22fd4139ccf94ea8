"""What every record of a run says beside its ticks: conditions, build, attachments, agreement."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from app.core.build import BUILD, build
from app.core.errors import AcusError
from app.exchange.markups import plan_document
from app.exercises.parts import LayersFrom
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.planning.registration.record import Registrations
from app.session.conditions import CONDITIONS, EXERCISE_FILE
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
    bare = anonymous(exercise)
    attached = {"exercise": bare, **documents}
    return RunContext(
        folder=folder,
        seed=seed,
        metadata={**metadata, CONDITIONS: conditions_of(bare), BUILD: dict(_build())},
        attachments=tuple(
            _attachment(f"{name}.json", document.model_dump(mode="json"))
            for name, document in attached.items()
        ),
        plan_files=lambda placed: (_attachment("plan.mrk.json", plan_document(placed.plan)),),
        agreement=agreement,
    )


@cache
def _build() -> Mapping[str, str]:
    """Return the build that this process runs: a file that changes now is not loaded any more."""
    return build()


def agreement_of(
    calibration: str, rig: str, simulated: bool, ct: CtFacts
) -> Callable[[PlacedPlan], Mapping[str, str]]:
    """Return what looks up how well screen and needle agree at a plan's target.

    It takes the newest registration check that holds for these cameras and this CT, and gives the
    metadata record `agreement`: `radius_mm` and the `check`'s id; nothing where nobody has checked.
    """

    def distances(placed: PlacedPlan) -> Mapping[str, str]:
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

    return distances


def conditions_of(exercise: Exercise) -> dict[str, str]:
    """Return what the exercise sets, as a score is told with it, and a digest of its content."""
    left_out = {"title", "description", "views", "assistance", "without"}
    if exercise.layers_from is LayersFrom.CT:  # what they are follows from CT and path
        left_out.add("layers")
    content = exercise.model_dump(mode="json", exclude_defaults=True, exclude=left_out)
    text = json.dumps(content, sort_keys=True)
    drill = {} if exercise.drill is None else {"drill": exercise.drill.kind.value}
    return {
        "level": str(exercise.level),
        "views": ",".join(sorted(view.value for view in exercise.shown_views)),
        "assistance": repr(exercise.assistance),
        "content": hashlib.sha256(text.encode()).hexdigest()[:12],
        **drill,
    }


def anonymous(exercise: Exercise) -> Exercise:
    """Return an exercise without folders, files and series, which may name a patient."""
    ct = exercise.ct.model_copy(update={"folder": None, "series": None, "digest": None})
    structures = tuple(
        part.model_copy(update={"file": Path(f"structures-{number}")})
        for number, part in enumerate(exercise.structures, 1)
    )
    return exercise.model_copy(update={"ct": ct, "structures": structures})


def with_exercise(context: RunContext, exercise: Exercise) -> RunContext:
    """Return a context whose records say that this was the exercise."""
    bare = anonymous(exercise)
    file = _attachment(EXERCISE_FILE, bare.model_dump(mode="json"))
    return replace(
        context,
        metadata={**context.metadata, CONDITIONS: conditions_of(bare)},
        attachments=tuple(file if a.name == EXERCISE_FILE else a for a in context.attachments),
    )


def _attachment(name: str, document: Any) -> Attachment:
    return Attachment(name, "application/json", json.dumps(document, indent=1).encode())
