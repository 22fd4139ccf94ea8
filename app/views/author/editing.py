"""An exercise while it is being made: its document, what is wrong with it, undo and redo."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Collection, Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import QObject, Signal

from app.core import paths
from app.core.configuration import FieldProblem, checked
from app.core.documents import Document, Where, put_value, value_at
from app.core.errors import AcusError
from app.core.messages import sentence
from app.exercises.schema import Exercise
from app.exercises.writing import exercise_document, free_id, save, taken_ids
from app.imaging.series import NO_REMEDY
from app.imaging.structures.structure import StructureSet
from app.imaging.volume import Volume
from app.planning.draft import Edit
from app.planning.history import UndoHistory
from app.planning.patient import Patient
from app.scoring import metrics
from app.scoring.defaults import PUBLISHED_TOLERANCES
from app.scoring.met import FORBIDDEN
from app.views.kit.text import tr

DRAWN: Final = "as-drawn-in-the-window.seg.nrrd"
"""Stands for the file of the structures until they are written."""

Check = Callable[[Exercise], tuple[Mapping[str, str], tuple[tuple[str, str], ...]]]
"""Why each effect is simulated or not, and what cannot be used: (field, why)."""


class ExerciseEditor(QObject):
    """Holds the history; every change says anew what is wrong.

    Signals:
        changed(): the document, or what is known of it, is another.

    Attributes:
        problems: what is wrong, field by field.
        why: effect -> why it is simulated or not.
        exercise: the exercise as it stands; None while the schema refuses it.
        saved: as it was kept last; None before.
    """

    changed = Signal()

    def __init__(self, check: Check, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._check = check
        self._history: UndoHistory[Document] = UndoHistory({})
        self._kept: Document = {}
        self._typing: Where = ()
        self._taken: list[str] = []
        self._checked: tuple[Exercise, Any] | None = None
        self.problems: tuple[FieldProblem, ...] = ()
        self.why: Mapping[str, str] = {}
        self.exercise: Exercise | None = None
        self.saved: Exercise | None = None

    # --- what is there --------------------------------------------------------------------------
    @property
    def document(self) -> Document:
        """The values of the exercise's file now; not to be changed."""
        return self._history.present

    @property
    def dirty(self) -> bool:
        """Return whether something was changed since it was begun or kept."""
        return self.document != self._kept

    @property
    def can_undo(self) -> bool:
        """Return whether there is a step to take back."""
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        """Return whether there is a step to take again."""
        return self._history.can_redo

    def get(self, *where: str, default: Any = None) -> Any:
        """Value of a field; `default` where nothing is said of it."""
        return value_at(self.document, *where, default=default)

    def problems_at(self, *where: str) -> list[FieldProblem]:
        """Return what is wrong with a field, or within it."""
        return [one for one in self.problems if one.field[: len(where)] == where]

    # --- changes --------------------------------------------------------------------------------
    def begin(self, document: Document, saved: Exercise | None = None) -> None:
        """Begin anew; there is nothing to undo then.

        Args:
            document: to begin with.
            saved: the exercise that it is of, where it is one that is kept; None for a new one.
        """
        self._history, self._typing, self.saved = UndoHistory(document), (), saved
        self._taken = taken_ids()
        self._kept = document if saved is not None else {}
        self._judge()

    def put(self, *where: str, value: Any, typed: bool = False) -> None:
        """Set a field, or take it away with None; letters typed one after the other are a step."""
        self.put_all({where: value}, where if typed else ())

    def put_all(self, values: Mapping[Where, Any], typing: Where = ()) -> None:
        """Set several fields as one step."""
        document = deepcopy(self.document)
        for where, value in values.items():
            put_value(document, where, value)
        if ("rules", "pass_mark") in values:
            document["rules"].pop("mark", None)  # nobody but who types it has set this one
        if self.saved is None and ("title",) in values:
            document["id"] = free_id(str(document.get("title", "")), self._taken)
        if document == self.document:
            return
        if typing and typing == self._typing:
            self._history = self._history.amend(document)
        else:
            self._history = self._history.do(document)
        self._typing = typing
        self._judge()

    def learn(self, *where: str, value: Any) -> None:
        """Set a field that the program found out by itself: no step to undo."""
        document = deepcopy(self.document)
        put_value(document, where, value)
        kept, self._history = self.document == self._kept, self._history.amend(document)
        if kept:
            self._kept = document
        self._judge()

    def redraw(self, drawn: Collection[str]) -> None:
        """Take the structures from the window again: they were painted since they were written.

        The painting has an undo of its own, so it is no step of the form.

        Args:
            drawn: names of the structures that the window holds. Where a structure of risk is not
                among them, or several files are named, the files stay.
        """
        parts = self.get("structures", default=[])
        if len(parts) != 1 or not set(parts[0].get("risks", {})) <= set(drawn):
            return
        document = deepcopy(self.document)
        document["structures"][0]["file"] = DRAWN
        self._history = self._history.amend(document)
        self._judge()

    def undo(self) -> None:
        """Take the last step back."""
        self._typing, self._history = (), self._history.undo()
        self._judge()

    def redo(self) -> None:
        """Take it again."""
        self._typing, self._history = (), self._history.redo()
        self._judge()

    def duplicate(self, title: str) -> None:
        """Go on with a copy, under another title and id."""
        document = deepcopy(self.document) | {"title": title, "version": 1}
        document["id"] = free_id(title, taken_ids())
        self.begin(document)

    def keep(self, exercise: Exercise) -> Exercise:
        """Keep an exercise, as it will be read again, and go on from it.

        Raises:
            AcusError: if it cannot be kept.
        """
        self.saved = save(exercise)
        self._history = self._history.amend(exercise_document(self.saved))
        self._kept = self.document
        self._judge()
        return self.saved

    # --- inside ---------------------------------------------------------------------------------
    def _judge(self) -> None:
        self.why = {}
        self.exercise, self.problems = checked(self.document, Exercise)
        if self.exercise is not None:
            self.why, wrong = self._deep(self.exercise)
            drawn = self.get("structures", default=[])
            self.problems = tuple(
                FieldProblem((field,), text)
                for field, text in wrong
                if not (field == "structures" and DRAWN in str(drawn))
            )
        self.changed.emit()

    def _deep(self, exercise: Exercise) -> Any:
        """Check what an exercise names, unless only its words have changed since."""
        words = {"id": "x", "title": "x", "description": "", "level": 1, "version": 1}
        bare = exercise.model_copy(update=words)
        if self._checked is None or self._checked[0] != bare:
            self._checked = bare, self._check(exercise)
        return self._checked[1]


def default_tolerance(metric: str) -> dict[str, Any]:
    """Return bands to begin with for a metric that is to count."""
    if metric in PUBLISHED_TOLERANCES:
        found = PUBLISHED_TOLERANCES[metric].model_dump(mode="json", by_alias=True)
        return {name: value for name, value in found.items() if value is not None}
    own = {
        "risk_breach": (0.0, 0.5, 1.0),
        "control_scans": (3.0, 5.0, 8.0),
        "notional_dose": (40.0, 60.0, 95.0),
        "tracking_valid": (99.0, 95.0, 80.0),
        "risk_distance": (10.0, 7.0, 5.0),
        "plan_score": (75.0, 65.0, 50.0),
        "plan_clearance": (10.0, 7.0, 5.0),
        "planned_emphysema": (0.0, 5.0, 10.0),
        "planned_fissures": (0.0, 0.5, 1.0),
        "planned_intercostal": (6.0, 4.0, 2.7),
        "planned_lung": (20.0, 30.0, 40.0),
        "planned_pleural_angle": (10.0, 25.0, 40.0),
        "planned_rib_border": (6.0, 4.0, 2.7),
    }
    higher = metrics.find(metric).higher_is_better
    expert, good, passing = own.get(metric, (3.0, 2.0, 1.0) if higher else (1.0, 2.0, 3.0))
    bands = {"expert": expert, "good": good, "pass": passing, "weight": 1.0}
    return {**bands, "required": metric == "risk_breach"}


def bone_words(depth_mm: float, length_mm: float) -> str:
    """Warn that the needle cannot reach the target."""
    return tr(
        "Bone is in the way at {depth:.0f} mm, before the target at {length:.0f} mm: no "
        "needle reaches it. Choose another entry.",
        depth=depth_mm,
        length=length_mm,
    )


PASS_MARK: Final = 75.0
"""Total needed to pass a new exercise: between what scripted novices and beginners score along a
path of 75 mm."""

PLANNED: Final = "plan_score"
OWN_PLAN: Final = {
    "expert": 75.0,
    "good": 65.0,
    "pass": 50.0,
    "zero": 40.0,
    "weight": 9.0,
}
"""The metric by which a plan of the student's own counts, and its bands and weight in a new
exercise: half of the score, as in *Plan it yourself*; left out of it where nobody labelled what the
path goes through."""


# --- from the window ----------------------------------------------------------------------------
def opened_document(
    patient: Patient, edit: Edit, structures: StructureSet, like: Exercise | None
) -> Document:
    """Return the document of a new exercise on what is open.

    Args:
        patient: who is shown.
        edit: plan and position; a plan that lacks the entry becomes one that the student makes.
        structures: that are drawn; those that a needle keeps off are of risk.
        like: the exercise that is taken: device, cameras and needle are taken from it.
    """
    document = exercise_document(Exercise(id="exercise", title="x"))
    document |= {"title": "", "id": "exercise"}
    document["tolerances"] = {
        name: one.model_dump(mode="json", by_alias=True, exclude_none=True)
        for name, one in PUBLISHED_TOLERANCES.items()
    }
    document["rules"] = document["rules"] | {
        "pass_mark": PASS_MARK,
        "forbidden": list(FORBIDDEN),
    }
    document["ct"] = ct_document(patient)
    document["plan"] = plan_document(edit)
    document["placement"] = {
        "orientation": edit.placement.orientation.value,
        "rotation_deg": list(edit.placement.rotation_deg),
    }
    if len(structures):
        risks = {one.name: one.warn_mm for one in structures if one.kind.is_avoided}
        document["structures"] = [{"file": DRAWN, "risks": risks}]
        if risks:
            document["tolerances"]["risk_breach"] = {
                **{"expert": 0.0, "good": 0.5, "pass": 1.0, "weight": 1.0},
                "required": True,
            }
    if is_own(document):
        document["tolerances"][PLANNED] = dict(OWN_PLAN)
    if like is not None:
        document |= {"device": like.device, "rig": like.rig}
        document["needle"] = like.needle.model_dump(mode="json", exclude_none=True)
        if like.joint:
            document["joint"] = like.joint
    return document


def ct_document(patient: Patient) -> Document:
    """Return the field `ct` of a patient; the digest is added by whoever has the time."""
    if patient.phantom_seed is not None:
        return {"phantom": {"seed": patient.phantom_seed}}
    recipe, found = patient.volume.recipe, {"folder": str((patient.folder or Path()).absolute())}
    if patient.volume.series.slices:
        found["series"] = patient.volume.series.key
    if recipe.remedy != NO_REMEDY:
        found["remedy"] = recipe.remedy
    return found


def plan_document(edit: Edit, own: bool = False) -> Document | None:
    """Return the field `plan` of what is placed; None where not even a target is.

    Args:
        edit: plan and position.
        own: whether the student places the entry.
    """
    draft = edit.draft
    if draft.target_mm is None:
        return None
    if own or draft.entry_mm is None:
        return {"own": True, "target_mm": list(draft.target_mm)}
    ends = {"entry_mm": list(draft.entry_mm), "target_mm": list(draft.target_mm)}
    return {**ends, "name": draft.name}


def is_own(document: Document) -> bool:
    """Return whether the student plans."""
    plan = document.get("plan")
    return isinstance(plan, Mapping) and "own" in plan


def finished(exercise: Exercise, patient: Patient | None, structures: StructureSet) -> Exercise:
    """Return an exercise with its structures in a file, and the digest of its CT.

    Raises:
        AcusError: if they cannot be written.
    """
    changes: dict[str, Any] = {}
    if patient is not None and exercise.ct.folder is not None and exercise.ct.digest is None:
        known = {"digest": patient.volume.digest}
        changes["ct"] = exercise.ct.model_copy(update=known)
    if any(part.file.name == DRAWN for part in exercise.structures):
        if patient is None:
            raise AcusError("the structures are those of a patient who is open no more")
        file = _written(exercise.id, structures, patient.volume)
        changes["structures"] = tuple(
            part.model_copy(update={"file": file}) if part.file.name == DRAWN else part
            for part in exercise.structures
        )
    return exercise.model_copy(update=changes)


def _written(identifier: str, structures: StructureSet, volume: Volume) -> Path:
    """Write the structures where exercises find them, once for each content."""
    from app.imaging.structures.files import write_structures

    content = hashlib.sha256()
    for one in structures:
        said = repr((one.name, one.kind.value, one.colour, one.corner, one.mask.shape, one.warn_mm))
        content.update(said.encode())
        content.update(one.mask.tobytes())
    folder = paths.data() / "structures" / identifier
    path = folder / f"{content.hexdigest()[:8]}.seg.nrrd"
    if not path.is_file():
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise AcusError(
                sentence(
                    "cannot write in {folder}: {why}", folder=folder, why=error.strerror or error
                )
            ) from error
        write_structures(path, structures, volume)
    return path
