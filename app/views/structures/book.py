"""The structures of the patient that is shown: what there are, what is seen, what can be undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from app.core.errors import AcusError
from app.imaging.structures.structure import (
    COLOURS,
    Index,
    Mask,
    Structure,
    StructureKind,
    StructureSet,
    free_name,
)
from app.imaging.volume import Volume
from app.planning.history import UndoHistory

if TYPE_CHECKING:
    from app.imaging.structures.distance import SignedDistance
    from app.planning.clearance import Field


MOST_KEPT = 512 * 1024**2
"""Bytes of masks that steps to undo may hold; the last step is kept in any case."""


class StructureBook(QObject):
    """Holds the set and its history; every change of the set is one step to undo.

    Signals:
        changed(): the set, what is visible, or which one is chosen is another.
        measured(): distances of more structures are known.
        refused(object): why something was not done.
        stepped(object): this editor has made a step that can be undone.
    """

    stepped = Signal(object)
    changed = Signal()
    measured = Signal()
    refused = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.volume: Volume | None = None
        self._history = UndoHistory(StructureSet())
        self._hidden: set[str] = set()
        self._fields: dict[int, tuple[Mask, SignedDistance]] = {}
        self.chosen = ""
        self.locked = False

    # --- what there is ------------------------------------------------------------------------
    @property
    def structures(self) -> StructureSet:
        """All of them."""
        return self._history.present

    @property
    def visible(self) -> tuple[Structure, ...]:
        """Those that are drawn."""
        return tuple(one for one in self.structures if one.name not in self._hidden)

    @property
    def selected(self) -> Structure | None:
        """The one that the brush works on."""
        return next((one for one in self.structures if one.name == self.chosen), None)

    @property
    def can_undo(self) -> bool:
        """Return whether there is a step to take back."""
        return self._history.can_undo and not self.locked

    @property
    def can_redo(self) -> bool:
        """Return whether there is a step to take again."""
        return self._history.can_redo and not self.locked

    def is_visible(self, name: str) -> bool:
        """Return whether the structure of a name is drawn."""
        return name not in self._hidden

    # --- distances ----------------------------------------------------------------------------
    @property
    def fields(self) -> tuple[Field, ...]:
        """Structures whose distances are known, with them."""
        known = ((one, self._fields.get(id(one.mask))) for one in self.structures)
        return tuple((one, found[1]) for one, found in known if found is not None)

    @property
    def unmeasured(self) -> tuple[Structure, ...]:
        """Structures whose distances are still to be computed."""
        return tuple(one for one in self.structures if id(one.mask) not in self._fields)

    def set_field(self, structure: Structure, field: SignedDistance) -> None:
        """Take the distances of a structure; those of masks that are gone are forgotten."""
        used = {id(one.mask) for one in self.structures}
        self._fields = {key: value for key, value in self._fields.items() if key in used}
        if id(structure.mask) in used:  # the mask is kept, so that its identity stays its own
            self._fields[id(structure.mask)] = (structure.mask, field)
            self.measured.emit()

    # --- changes ------------------------------------------------------------------------------
    def set_volume(self, volume: Volume | None) -> None:
        """Begin anew with another CT, or with none."""
        self.volume = volume
        self._history, self._hidden, self._fields = UndoHistory(StructureSet()), set(), {}
        self.chosen = ""
        self.changed.emit()

    def begin(self, structures: StructureSet) -> None:
        """Begin anew with these structures on the same CT; nothing to undo."""
        self._history, self._hidden, self.chosen = UndoHistory(structures), set(), ""
        self.changed.emit()

    def add(self, more: StructureSet) -> None:
        """Take structures that were read from a file."""
        united = self.structures.united(more)
        if len(more):
            self.chosen = united.structures[-1].name
        self._do(united)

    def put(self, name: str, mask: Mask, corner: Index, starts_step: bool = True) -> None:
        """Give the structure of a name other voxels, or begin it; a stroke is one step."""
        if self.volume is None:
            return
        old = next((one for one in self.structures if one.name == name), None)
        if old is None:
            colour = COLOURS[len(self.structures) % len(COLOURS)]
            new = Structure(
                name,
                StructureKind.RISK,
                colour,
                mask,
                corner,
                self.volume.affine_mm,
                StructureKind.RISK.warn_mm,
            )
        else:
            new = old.changed(mask=mask, corner=corner)
        self.chosen = name
        self._do(self.structures.with_one(new), starts_step)

    def change(self, name: str, /, **fields: object) -> None:
        """Change name, kind, colour or warning distance of one."""
        try:
            old = self.structures.find(name)
            new = old.changed(**fields)
            others = [one.name for one in self.structures if one is not old]
            new = new.changed(name=free_name(new.name, others))
        except AcusError as error:
            self.refused.emit(error)
            self.changed.emit()
            return
        if name in self._hidden:
            self._hidden = self._hidden - {name} | {new.name}
        self.chosen = new.name
        self._do(self.structures.with_one(new, instead_of=name))

    def remove(self, name: str) -> None:
        """Take one away."""
        self._do(self.structures.without(name))

    def choose(self, name: str) -> None:
        """Let the brush work on this one."""
        if name != self.chosen:
            self.chosen = name
            self.changed.emit()

    def set_visible(self, name: str, visible: bool) -> None:
        """Draw one, or not; nothing to undo."""
        self._hidden = self._hidden - {name} if visible else self._hidden | {name}
        self.changed.emit()

    def set_locked(self, locked: bool) -> None:
        """Refuse changes while an attempt runs."""
        if locked != self.locked:
            self.locked = locked
            self.changed.emit()

    def undo(self) -> None:
        """Take the last step back."""
        if self.can_undo:
            self._history = self._history.undo()
            self.changed.emit()

    def redo(self) -> None:
        """Take it again."""
        if self.can_redo:
            self._history = self._history.redo()
            self.changed.emit()

    def _do(self, structures: StructureSet, starts_step: bool = True) -> None:
        if self.locked:
            self.refused.emit("structures cannot change while an attempt runs: end it first")
            return
        before = self._history
        self._history = before.do(structures) if starts_step else before.amend(structures)
        self._history = self._history.newest(max(1, self._fitting()))
        if starts_step and self._history is not before:
            self.stepped.emit(self)
        self.changed.emit()

    def _fitting(self) -> int:
        """Return how many steps, from the newest, hold no more than `MOST_KEPT` of other masks."""
        seen = {id(one.mask) for one in self.structures}
        held = 0
        for number, structures in enumerate(reversed(self._history.past)):
            for one in structures:
                if id(one.mask) not in seen:
                    seen.add(id(one.mask))
                    held += one.mask.nbytes
            if held > MOST_KEPT:
                return number
        return len(self._history.past)
