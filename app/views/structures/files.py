"""Structures in and out of files, beside the window: the user's, and those of an exercise."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.exercises.parts import StructurePart
from app.imaging.structures.structure import Kind, StructureSet
from app.imaging.volume import Volume
from app.views.kit.background import Indicator, run_in_background
from app.views.kit.text import tr
from app.views.structures.book import StructureBook
from app.views.structures.panel import StructurePanel

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

        def take(found: StructureSet) -> None:
            if self._book.volume is volume and self._wanted is wanted:
                self._book.begin(found)
                self._panel.set_note("\n".join(found.notes))

        run_in_background(
            self, lambda progress: read_parts(wanted, volume, progress), take, self.failed.emit,
            title=tr("Reading the exercise's structures"), indicator=self._indicator,
        )  # fmt: skip

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
            with ONE_AT_A_TIME:
                from app.imaging.structures.files import read_structures
            return read_structures(path, volume, progress)

        def take(found: StructureSet) -> None:
            if self._book.volume is volume:
                self._book.add(StructureSet(found.structures))
                said = tr("{name}: {count} structures", name=path.name, count=len(found))
                self._panel.set_note("\n".join((said, *found.notes)))

        run_in_background(self, read, take, self.failed.emit,
                          title=tr("Reading structures"), indicator=self._indicator)  # fmt: skip

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
            with ONE_AT_A_TIME:
                from app.imaging.structures.files import write_structures
            write_structures(path, structures, volume, progress)

        run_in_background(
            self, write, lambda _: self._panel.set_note(tr("Written: {name}", name=path.name)),
            self.failed.emit, title=tr("Writing structures"), indicator=self._indicator,
        )  # fmt: skip


def read_parts(parts: Sequence[StructurePart], volume: Volume, progress: Progress) -> StructureSet:
    """Read the files of an exercise; its risks are of that kind and warn at their distance."""
    with ONE_AT_A_TIME:
        from app.imaging.structures.files import read_structures
    result = StructureSet()
    for number, part in enumerate(parts):
        step = progress.part(number / len(parts), (number + 1) / len(parts))
        found = read_structures(part.file, volume, step)
        for name, limit in part.risks.items():
            risk = found.find(name).changed(kind=Kind.RISK, warn_mm=limit)
            found = found.with_one(risk)
        result = result.united(found)
    return result
