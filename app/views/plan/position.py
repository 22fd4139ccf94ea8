"""Where the patient lies in front of the robot, to and from 3D Slicer as `.tfm` files.

Written is what `acus transform export` writes: from the robot's frame to the patient's (LPS).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import ClassVar

import numpy as np
from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QFileDialog

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.units import MILLIMETRE
from app.exchange.errors import TransformError
from app.exchange.transforms import read_tfm, write_tfm
from app.planning.placement import placement_of
from app.views.kit.menu_entries import add_entries
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import number, tr
from app.views.shell.feature import Context, Feature

SUFFIX = ".tfm"
_NEAR_MM = 0.1
_FAR_MM = 1.0


class PositionFeature(Feature):
    """Exports and imports the position; failures and notes are told as those of plans are."""

    topic: ClassVar[str] = "plan"
    place: ClassVar[int] = 140
    roles: ClassVar[frozenset[Role]] = STAFF

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._editor, self._conductor = context.editors.plan, context.conductor
        self._window = context.shell.dialog_parent
        add_entries(
            context.shell.menu(tr("&File"), tr("3D Slicer")),
            [
                None,
                (tr("Import position of the patient (.tfm)…"), "", self.ask_open),
                (tr("Export position of the patient (.tfm)…"), "", self.ask_export),
            ],
        )

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted,)

    def opens(self, path: Path) -> bool:
        """Take the position from a dropped file."""
        if path.suffix != SUFFIX:
            return False
        self.open(path)
        return True

    def ask_export(self) -> None:
        """Ask where, and write the position of the present plan."""
        start = str(Path.home() / f"{self._editor.edit.draft.name}{SUFFIX}")
        name, _ = QFileDialog.getSaveFileName(
            self._window, tr("Export position of the patient"), start, _kinds()
        )
        if name:
            self.export(Path(name if name.endswith(SUFFIX) else name + SUFFIX))

    def export(self, path: Path) -> None:
        """Write the transform from the robot to the patient."""
        self._try(lambda: self._export(path))

    def ask_open(self) -> None:
        """Ask for a file and take the position from it."""
        name, _ = QFileDialog.getOpenFileName(
            self._window, tr("Import position of the patient"), str(Path.home()), _kinds()
        )
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Lay the patient as a file says; one step to undo."""
        self._try(lambda: self._open(path))

    def _try(self, work: Callable[[], None]) -> None:
        try:
            work()
        except AcusError as error:
            self.failed.emit(error)

    def _fulcrum(self) -> FloatArray:
        profile = self._conductor.profile
        if profile is None:
            raise TransformError(
                tr("choose an exercise first: its device says where its fulcrum is")
            )
        return profile.fulcrum

    def _export(self, path: Path) -> None:
        edit, fulcrum = self._editor.edit, self._fulcrum()
        T_world_patient = edit.placement.T_world_patient(edit.draft.plan(), fulcrum)
        write_tfm(path, T_world_patient.inverse())
        self.noted.emit(tr("Exported {name}", name=path.name))

    def _open(self, path: Path) -> None:
        T_patient_world, fulcrum = read_tfm(path), self._fulcrum()
        entry = self._editor.edit.draft.entry_mm
        off_mm = other_mm = 0.0
        if entry is not None:
            p_entry = np.asarray(entry) * MILLIMETRE
            off_mm = _mm(T_patient_world @ fulcrum - p_entry)
            other_mm = _mm(T_patient_world.inverse() @ fulcrum - p_entry)
        if off_mm > _FAR_MM and other_mm < _NEAR_MM:
            raise TransformError(
                tr(
                    "{name} goes from the patient to the robot; needed is the other direction: "
                    "invert it in Slicer",
                    name=path.name,
                )
            )
        self._editor.set_placement(placement_of(T_patient_world.inverse().rotation))
        self.noted.emit(self._note(path, off_mm))

    def _note(self, path: Path, off_mm: float) -> str:
        if off_mm <= _NEAR_MM:
            return tr("Position taken from {name}", name=path.name)
        return tr(
            "Rotation taken from {name}. Its shift would put the robot's fulcrum {off} mm from the "
            "entry of this plan and was left out: the entry lies on the fulcrum.",
            name=path.name,
            off=number(off_mm, ".1f"),
        )


def _kinds() -> str:
    return f"{tr('Transforms')} (*{SUFFIX} *.txt)"


def _mm(offset: FloatArray) -> float:
    return float(np.linalg.norm(offset)) / MILLIMETRE
