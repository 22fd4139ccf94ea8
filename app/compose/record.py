"""What stands at the head of a record: metadata of a run and the documents attached to it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from app.core.build import BUILD, build
from app.exchange.markups import plan_document
from app.exercises.schema import Exercise
from app.session.context import RunContext
from app.session.header import Attachment


def run_context(
    exercise: Exercise,
    folder: Path,
    seed: int,
    metadata: Mapping[str, dict[str, str]],
    documents: Mapping[str, Any],
) -> RunContext:
    """Return the context of a run's records.

    Args:
        exercise: attached without what may name a patient.
        folder: of the records.
        seed: of everything random.
        metadata: `device`, `cameras`, `ct`, `trainee`.
        documents: further pydantic models to attach, by name.
    """
    attached = {"exercise": _anonymous(exercise), **documents}
    return RunContext(
        folder=folder,
        seed=seed,
        metadata={**metadata, BUILD: build()},
        attachments=tuple(
            _attachment(f"{name}.json", document.model_dump(mode="json"))
            for name, document in attached.items()
        ),
        plan_files=lambda placed: (_attachment("plan.mrk.json", plan_document(placed.plan)),),
    )


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
