"""What a feature of the window is, and what it is made from.

A feature is one object that brings everything of its own: menu entries, panel, page, messages, what
it forgets at a change of patient, what it ends with the window. `shell.features` finds
them; the window goes through its list. How to add one is told in docs/extending.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import QObject, Signal, SignalInstance

from app.views.exercise.conductor import Conductor
from app.views.exercise.equipment import Equipment
from app.views.exercise.runs import Runs
from app.views.kit.roles import STAFF, Role
from app.views.reading.editors import Editors
from app.views.reading.patient_views import PatientViews
from app.views.series.open_ct import OpenCt
from app.views.shell.services import Services
from app.views.shell.shell import Shell


@dataclass(frozen=True, slots=True, eq=False)
class Context:
    """What every feature is made from: state with its signals, services, a place in the window.

    Attributes:
        services: what the program below the window does.
        views: where the patient is seen: slices with their state, and the 3D view.
        editors: what the user changes, each step to be undone: plan, measurements, structures.
        runs: the trainer that runs, if one does.
        conductor: patient and exercise, and what happens between the parts.
        equipment: which robot, pen and cameras are used.
        patients: opens patients.
        shell: places for menus, panels and pages, messages, a parent for dialogs.
    """

    services: Services
    views: PatientViews
    editors: Editors
    runs: Runs
    conductor: Conductor
    equipment: Equipment
    patients: OpenCt
    shell: Shell

    def leave_page(self) -> None:
        """Go to the panes; to the start page where no patient is open, as they would be empty."""
        if self.conductor.patient is None:
            self.conductor.start_wanted.emit()
        else:
            self.shell.show_workspace()


class Feature(QObject):
    """Base of all features. The constructor adds what is to be seen; the rest is asked for.

    Signals:
        failed(object): an exception, or a sentence, that is shown until one of `over` says more.
        noted(str): something worked; shown for a while.

    Attributes:
        topic: name of its messages; one of a topic replaces the last one.
        place: where its panel stands, and its entries in menus that several share.
        help: page and heading about the widgets of its folder.
        roles: for whom it exists: its menu entries, panels and pages are not there for others.
            A part of it that is for fewer is added within `Shell.made_for`.
    """

    failed = Signal(object)
    noted = Signal(str)
    topic: ClassVar[str] = ""
    place: ClassVar[int] = 1000
    help: ClassVar[str] = ""
    roles: ClassVar[frozenset[Role]] = STAFF

    def __init__(self, context: Context) -> None:
        super().__init__(context.shell.dialog_parent)
        self.context = context

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of `failed`: the signals after which it is true no more."""
        return ()

    def watching(self) -> Mapping[str, str]:
        """Return keys by which an exercise is watched, and who shows it, for the sheet of keys."""
        return {}

    def forget(self) -> None:
        """Empty everything that belongs to the patient: another one is coming."""

    def suit_room(self) -> None:
        """Take another size of text or other colours, and hide names or show them."""

    def unsaved(self) -> str:
        """Say what would be lost with the patient or the window; empty where nothing would."""
        return ""

    def save(self) -> bool:
        """Save what `unsaved` names; return whether that is done."""
        return True

    def may_go(self) -> bool:
        """Ask whether what `unsaved` names may go, or save it; True where there is nothing."""
        return True

    def opens(self, path: Path) -> bool:
        """Open a file that was dropped on the window; return whether it is this feature's."""
        return False

    def close(self) -> None:
        """End what runs, and dialogs that are open: the window closes; idempotent."""
