"""Structures of the patient in the window: files (the user's, and those of an exercise), outlines,
surfaces, distances, warnings.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import QObject, QTimer, Signal, SignalInstance
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.loading import turn
from app.core.progress import Progress
from app.exercises.parts import StructurePart
from app.imaging.structures.structure import (
    Index,
    Mask,
    Structure,
    StructureKind,
    StructureSet,
    free_name,
)
from app.imaging.volume import Volume
from app.planning.clearance import PathClearance
from app.planning.draft import DraftPlan
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import tr, translated
from app.views.shell.feature import Context, Feature
from app.views.structures.book import StructureBook
from app.views.structures.brush import Brush, BrushGrip
from app.views.structures.layer import draw_in, named
from app.views.structures.panel import StructurePanel
from app.views.structures.watch import StructureWatch, words

if TYPE_CHECKING:
    from app.imaging.structures.distance import SignedDistance
    from app.views.scene.mesh import Mesh


_FILES = "app.imaging.structures.files"
_MEASURING = "app.imaging.structures.distance", "app.views.scene.mesh"

FILES = "Structures (*.seg.nrrd *.nrrd *.nii *.nii.gz *.dcm *);;All files (*)"


class StructureFiles(QObject):
    """Reads structures into the book, and writes them.

    Signals:
        failed(object): something could not be read or written.
    """

    failed = Signal(object)

    def __init__(
        self,
        book: StructureBook,
        panel: StructurePanel,
        window: QWidget,
        indicator: Indicator,
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._book, self._panel, self._window = book, panel, window
        self._indicator = indicator
        self._wanted: tuple[StructurePart, ...] = ()

    def begin(self, parts: Sequence[StructurePart]) -> None:
        """Begin anew with the structures of an exercise; none leaves the book empty."""
        volume, self._wanted = self._book.volume, tuple(parts)
        wanted = self._wanted
        self._book.begin(StructureSet())
        if volume is None or not wanted:
            return

        def take(result: StructureSet) -> None:
            if self._book.volume is volume and self._wanted is wanted:
                self._book.begin(result)
                self._panel.set_note("\n".join(result.notes))

        run_in_background(
            self,
            lambda progress: read_parts(wanted, volume, progress),
            take,
            self.failed.emit,
            title=tr("Reading the exercise's structures"),
            indicator=self._indicator,
        )

    def ask_open(self) -> None:
        """Ask for a file of structures and read it."""
        name, _ = QFileDialog.getOpenFileName(self._window, tr("Open structures"), "", FILES)
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Read structures onto the CT that is shown, beside the window."""
        volume = self._book.volume
        if volume is None:
            self.failed.emit(tr("Open the CT that the structures belong to first."))
            return

        def read(progress: Progress) -> StructureSet:
            with turn(progress, _FILES):
                from app.imaging.structures.files import read_structures
            return read_structures(path, volume, progress)

        def take(result: StructureSet) -> None:
            if self._book.volume is volume:
                self._book.add(StructureSet(result.structures))
                said = tr("{name}: {count} structures", name=path.name, count=len(result))
                self._panel.set_note("\n".join((said, *result.notes)))

        run_in_background(
            self,
            read,
            take,
            self.failed.emit,
            title=tr("Reading structures"),
            indicator=self._indicator,
        )

    def ask_save(self) -> None:
        """Ask where to write the structures, and write them."""
        kinds = tr("3D Slicer segmentation (*.seg.nrrd);;DICOM SEG (*.dcm)")
        name, kind = QFileDialog.getSaveFileName(self._window, tr("Save structures"), "", kinds)
        if name:
            ending = ".dcm" if ".dcm" in kind else ".seg.nrrd"
            self.save(Path(name if name.endswith((".dcm", ".seg.nrrd")) else name + ending))

    def save(self, path: Path) -> None:
        """Write all structures, beside the window."""
        volume, structures = self._book.volume, self._book.structures
        if volume is None:
            return

        def write(progress: Progress) -> None:
            with turn(progress, _FILES):
                from app.imaging.structures.files import write_structures
            write_structures(path, structures, volume, progress)

        run_in_background(
            self,
            write,
            lambda _: self._panel.set_note(tr("Written: {name}", name=path.name)),
            self.failed.emit,
            title=tr("Writing structures"),
            indicator=self._indicator,
        )


def read_parts(parts: Sequence[StructurePart], volume: Volume, progress: Progress) -> StructureSet:
    """Read the files of an exercise; its risks are of that kind and warn at their distance."""
    with turn(progress, _FILES):
        from app.imaging.structures.files import read_structures
    result = StructureSet()
    for number, part in enumerate(parts):
        step = progress.part(number / len(parts), (number + 1) / len(parts))
        found = read_structures(part.file, volume, step)
        for name, limit in part.risks.items():
            risk = found.find(name).changed(kind=StructureKind.RISK, warn_mm=limit)
            found = found.with_one(risk)
        result = result.united(found)
    return result


TRIANGLES = 20_000
"""Bound of the triangles of one structure."""

SETTLE_MS = 400
"""Distances are computed anew this long after the last stroke."""


class StructuresFeature(Feature):
    """Connects the structures with panel, panes, 3D view, plan, needle and files."""

    topic: ClassVar[str] = "structures"
    place: ClassVar[int] = 120
    roles: ClassVar[frozenset[Role]] = STAFF

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._editor = context.conductor, context.editors.plan
        self._views, self._progress = context.views, context.shell.progress
        self.book = context.editors.structures
        self.brush = Brush(self)
        self.watch = StructureWatch(self.book, self)
        self.panel = StructurePanel(self.book, self.watch, self.brush)
        self.files = StructureFiles(
            self.book, self.panel, context.shell.dialog_parent, self._progress, self
        )
        self._meshes: dict[int, Mesh] = {}
        self._belongs: tuple[object, ...] = ()
        self._task: BackgroundTask | None = None
        self._settle = QTimer(self, interval=SETTLE_MS, singleShot=True)
        self._settle.timeout.connect(self._measure)
        context.shell.add_panel(self.panel, tr("Structures"))
        for pane in self._views.slices:
            draw_in(pane.canvas, self.book)
        for pane in self._views.panes:
            pane.gestures.add_grip(BrushGrip(pane.canvas, self.book, self.brush))
        self._connect()

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.book.changed,)

    def suit_room(self) -> None:
        """Write the table anew: names are hidden, or shown again."""
        self.panel.refresh()

    def _connect(self) -> None:
        viewing, conductor = self._views.viewing, self._conductor
        conductor.patient_changed.connect(self._take_patient)
        conductor.exercise_taken.connect(lambda _: self._take_patient())
        self._editor.changed.connect(self._take_plan)
        viewing.needle_changed.connect(lambda: self.watch.set_needle(viewing.needle))
        conductor.controller.add_items(self.watch.items)
        self.watch.needle_changed.connect(self._warn)
        self.watch.breached.connect(conductor.views.messages.add_event)
        self.watch.breached.connect(conductor.controller.event_seen)
        self.book.changed.connect(self._show)
        self.book.refused.connect(self._refused)
        self.files.failed.connect(self._refused)
        self.panel.import_wanted.connect(self.files.ask_open)
        self.panel.export_wanted.connect(self.files.ask_save)
        self.panel.threshold_wanted.connect(self.threshold)

    # --- what is shown ------------------------------------------------------------------------
    def _take_patient(self) -> None:
        patient = self._conductor.patient
        if patient is not None and patient.volume is not self.book.volume:
            self._stop()
            self._meshes = {}
            self.book.set_volume(patient.volume)
        self._take_exercise()

    def forget(self) -> None:
        """Let go of the structures of the patient who leaves."""
        self._stop()
        self._meshes, self._belongs = {}, ()
        self.book.set_volume(None)
        self.watch.set_draft(DraftPlan())

    def _take_exercise(self) -> None:
        """Load the structures that belong to the exercise, once for each exercise and CT."""
        conductor = self._conductor
        patient, exercise = conductor.patient, conductor.exercise
        if patient is None or exercise is None:
            return
        parts = exercise.structures if conductor.fits(patient) else ()
        belongs = (id(patient.volume), parts)
        if belongs == self._belongs:
            return
        had, self._belongs = bool(self._belongs and self._belongs[1]), belongs
        if parts or had:
            self.files.begin(parts)

    def _take_plan(self) -> None:
        self.watch.set_draft(self._editor.edit.draft)
        self.book.set_locked(self._editor.locked)

    def _show(self) -> None:
        self._views.refresh()
        self._show_surfaces()
        if self.book.unmeasured:
            self._settle.start()

    def _show_surfaces(self) -> None:
        meshes = [(one, self._meshes.get(id(one.mask))) for one in self.book.visible]
        shown = tuple((one.colour, mesh) for one, mesh in meshes if mesh is not None)
        legend = tuple((one.colour, named(one)) for one, mesh in meshes if mesh is not None)
        self._views.scene.set_structures(shown, legend)

    def _warn(self, clearance: PathClearance | None) -> None:
        self.panel.show_needle(clearance, "" if clearance is None else words(clearance))

    def _refused(self, reason: str | BaseException) -> None:
        self.panel.set_note(translated(reason))
        self.failed.emit(reason)

    # --- distances and surfaces, beside the window -----------------------------------------------
    def _measure(self) -> None:
        if self._task is not None:
            self._settle.start()
            return
        waiting = self.book.unmeasured
        if not waiting:
            return
        structure = waiting[0]
        self._task = run_in_background(
            self,
            lambda progress: _measured(structure, progress),
            lambda found: self._take(structure, *found),
            self._measuring_failed,
            self._measuring_ended,
        )

    def _take(self, structure: Structure, field: SignedDistance, mesh: Mesh) -> None:
        self._measuring_ended()
        used = {id(one.mask) for one in self.book.structures}
        self._meshes = {key: value for key, value in self._meshes.items() if key in used}
        self.book.set_field(structure, field)
        if id(structure.mask) in used:
            self._meshes[id(structure.mask)] = mesh
        self._show_surfaces()
        self._measure()

    def _measuring_failed(self, error: Exception) -> None:
        self._measuring_ended()
        self.failed.emit(error)

    def _measuring_ended(self) -> None:
        self._task = None

    def _stop(self) -> None:
        self._settle.stop()
        if self._task is not None:
            self._task.close(timeout=0.0)
            self._task = None

    @property
    def is_settled(self) -> bool:
        """Return whether all distances and surfaces are there."""
        return self._task is None and not self.book.unmeasured

    # --- marking ------------------------------------------------------------------------------
    def threshold(self) -> None:
        """Make a structure of all voxels of the body between the limits, beside the window."""
        patient, settings = self._conductor.patient, self.brush.settings
        if patient is None:
            return
        names = [one.name for one in self.book.structures]
        name = free_name(
            tr("{low:.0f} to {high:.0f} HU", low=settings.low, high=settings.high), names
        )

        def work(progress: Progress) -> tuple[Mask, Index]:
            from app.imaging.body import body_mask
            from app.imaging.structures.edit import threshold

            progress.report(0.1, tr("looking for the body"))
            within = body_mask(patient.volume, patient.body)
            progress.report(0.5, tr("threshold"))
            return threshold(patient.volume, settings.low, settings.high, within)

        def take(result: tuple[Mask, Index]) -> None:
            if self.book.volume is patient.volume:
                self.book.put(name, *result)

        run_in_background(
            self, work, take, self._refused, title=tr("Threshold"), indicator=self._progress
        )

    def close(self) -> None:
        """End what runs; idempotent."""
        self._stop()


def _measured(structure: Structure, progress: Progress) -> tuple[SignedDistance, Mesh]:
    with turn(progress, *_MEASURING):  # scipy and VTK: behind the window, not before it
        from app.imaging.structures.distance import SignedDistance
        from app.views.scene.mesh import structure_mesh
    field = SignedDistance.of(structure, progress.part(0.0, 0.6))
    return field, structure_mesh(structure, TRIANGLES, progress.part(0.6, 1.0))
