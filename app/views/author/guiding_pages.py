"""Pages of the form of an exercise: how the robot assists, and what the student sees."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox

from app.exercises.guidance import FadingKind, GuidanceMode, Purpose
from app.exercises.locks import Lock
from app.exercises.parts import TELLING, ViewName
from app.imaging.window import PRESETS
from app.views.author.editing import ExerciseEditor
from app.views.author.page import Page
from app.views.author.parts_box import PartsBox
from app.views.kit.document import Where
from app.views.kit.parts import button
from app.views.kit.text import literal, tr
from app.views.reading.lock_words import view_title


class HelpPage(Page):
    """Assistance: fixed, by a schedule, fading; and force laws."""

    def __init__(self, editor: ExerciseEditor) -> None:
        super().__init__(editor, tr("Assistance"), ("assistance", "fading", "laws"))
        self.number("assistance")
        ways = (
            (None, tr("Fixed: the same at every attempt")),
            (FadingKind.SCHEDULE.value, tr("Schedule: a dial for each attempt")),
            (
                FadingKind.PERFORMANCE.value,
                tr("Fading: less after good attempts, more after poor ones"),
            ),
        )
        self.way = self.choice("fading", "kind", among=ways)
        self.dials = self.text(
            "fading", "dials", hint="0.7, 0.4, 0", read=_dials_of, write=_dial_words
        )
        for name in ("least", "step", "good", "poor"):
            self.number("fading", name)
        self.probes = self.count("fading", "probe_every")
        self.note(("fading",))
        self.laws = PartsBox(editor, "laws", tr("Force laws"))
        self.rows.addWidget(self.laws)
        self.note(("laws",))
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says; of fading only what its kind has."""
        super().load()
        self.laws.load()
        kind = self.editor.get("fading", "kind")
        belongs = {"schedule": ("dials", "probe_every"), None: ()}.get(
            kind, ("least", "step", "good", "poor", "probe_every")
        )
        for where in self.fields:
            if where[0] == "fading" and where[1] != "kind":
                self.show_row(where[1] in belongs, *where)

    def put(self, where: Where, value: Any, typed: bool) -> None:
        """Put it into the document; another way of fading begins with what that way needs."""
        if where == ("fading", "kind"):
            dials = {"dials": [0.7, 0.4, 0.2, 0.0]} if value == "schedule" else {}
            where, value = ("fading",), None if value is None else {"kind": value, **dials}
        super().put(where, value, typed)


def _dials_of(text: str) -> list[float] | str:
    """Return dials: `0.7, 0.4`, or `0,7; 0,4`; of another text itself: the reader says why."""
    parts = text.replace(",", ".").split(";") if ";" in text else text.split(",")
    try:
        return [float(part) for part in parts if part.strip()]
    except ValueError:
        return text


def _dial_words(dials: Any) -> str:
    return dials if isinstance(dials, str) else ", ".join(f"{one:g}" for one in dials)


class SightPage(Page):
    """Views, locks, and how the CT is read.

    Signals:
        reading_wanted(): take window and slab from the axial pane.
    """

    reading_wanted = Signal()

    def __init__(self, editor: ExerciseEditor) -> None:
        covers = ("views", "locks", "hand", "unsteady_hand", "reading", "guidance", "touch")
        super().__init__(editor, tr("What is seen"), covers)
        self.views = self.flags("views", among=[(one.value, view_title(one)) for one in ViewName])
        locks = {
            Lock.ASSISTANCE: tr("The assistance"),
            Lock.VIEWS: tr("What is shown"),
            Lock.READING: tr("Window, slab and layout"),
            Lock.HAND: tr("What moves the hand"),
            Lock.MODELS: tr("The way effects are computed"),
        }
        self.locks = self.flags("locks", among=[(one.value, title) for one, title in locks.items()])
        hands = (
            (None, tr("The student's own")),
            ("mouse", tr("Mouse")),
            ("tablet", tr("Tablet")),
            ("gamepad", tr("Gamepad")),
        )
        self.choice("hand", among=hands)
        steadiness = (
            (None, tr("As the exercise's level has it")),
            (0, tr("Steady")),
            *((level, tr("Unsteady as at level {n}", n=level)) for level in range(1, 6)),
        )
        self.choice("unsteady_hand", among=steadiness)
        windows = [
            (None, tr("The student's own")),
            *(({"width": one.width, "level": one.level}, name) for name, one in PRESETS.items()),
        ]
        self.choice("reading", "window", among=windows)
        layouts = (
            (None, tr("The student's own")),
            ("2x2", "2×2"),
            ("1+3", "1+3"),
            ("6-up", "6"),
            ("needle", tr("Along the needle")),
        )
        self.choice("reading", "layout", among=layouts)
        kinds_of_slabs = (
            (None, tr("The student's own")),
            ("mean", tr("Mean")),
            ("mip", tr("Brightest")),
            ("minip", tr("Darkest")),
        )
        self.choice("reading", "slab", "kind", among=kinds_of_slabs)
        self.number("reading", "slab", "thickness_mm")
        self.take = button(tr("Take window and slab from the axial pane"))
        self.take.clicked.connect(self.reading_wanted)
        self.rows.addWidget(self.take)
        self.check("reading", "locked")
        self.note(("reading",))
        self.note(("touch",))
        self.count("guidance", "slices")
        self.number("guidance", "slice_mm")
        self.number("guidance", "dose_per_slice")
        self.check("guidance", "streak")
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says; the thickness of a slab only where there is one."""
        super().load()
        there = self.editor.get("reading", "slab") is not None
        self.show_row(there, "reading", "slab", "thickness_mm")
        self._show_what_holds()

    def _show_what_holds(self) -> None:
        """Show what an assessment, or guidance by control scans alone, makes of views and locks."""
        assesses = self.editor.get("purpose") == Purpose.ASSESSMENT.value
        usual = GuidanceMode.CONTROL_CT if assesses else GuidanceMode.LIVE
        scans = self.editor.get("guidance", "mode", default=usual) == GuidanceMode.CONTROL_CT
        hidden = {view.value for view in TELLING} if scans else set()
        only_scans = tr("Not shown: the needle is seen on control scans alone")
        for value, box in self.views.items():
            _hold(box, False if value in hidden else None, only_scans)
        by_scans = tr("Where control scans guide, the assistance is the exercise's own")
        for value, box in self.locks.items():
            held = assesses or (scans and value == Lock.ASSISTANCE.value)
            why = tr("An assessment locks all of them") if assesses else by_scans
            _hold(box, True if held else None, why)

    def put(self, where: Where, value: Any, typed: bool) -> None:
        """Put it into the document; a slab of another kind stays as thick as it was."""
        if where == ("reading", "slab", "kind"):
            thick = self.editor.get("reading", "slab", "thickness_mm", default=5.0)
            where = where[:2]
            value = None if value is None else {"kind": value, "thickness_mm": thick}
        super().put(where, value, typed)


def _hold(box: QCheckBox, on: bool | None, reason: str) -> None:
    """Let a box stand on or off, whatever was chosen, and say why; None sets it free."""
    box.setEnabled(on is None)
    box.setToolTip(literal("" if on is None else reason))
    if on is not None:
        with QSignalBlocker(box):
            box.setChecked(on)
