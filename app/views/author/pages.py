"""Pages of the form of an exercise: what it is, patient and path, help and views, and the check."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QDoubleSpinBox, QPlainTextEdit, QTableWidgetItem

from app.core.configuration import FieldProblem
from app.core.documents import Where
from app.core.errors import AcusError
from app.exercises.guidance import FadingKind, GuidanceMode, Purpose
from app.exercises.library import profile_names
from app.exercises.locks import Lock
from app.exercises.parts import TELLING, ViewName
from app.exercises.scene import plan_of
from app.imaging.structures.structure import StructureSet
from app.imaging.window import PRESETS
from app.simulation.needles import OUTER_DIAMETER
from app.views.author.editing import DRAWN, ExerciseEditor, bone_words, default_tolerance
from app.views.author.page import FormPage
from app.views.author.parts_box import PartsBox
from app.views.kit import theme
from app.views.kit.coordinates import lps_words
from app.views.kit.field_words import problem_words
from app.views.kit.form import Choice
from app.views.kit.parts import button, label, table
from app.views.kit.text import literal, tr
from app.views.kit.wheel import wheel_scrolls
from app.views.reading.lock_words import view_title


class HelpPage(FormPage):
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


class SightPage(FormPage):
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


FOLLOW, OWN, SCANS = "follow", "own", "scans"


def kinds() -> Choice:
    """Types of exercises, with their names."""
    return (
        (FOLLOW, tr("Follow the path")),
        (OWN, tr("Plan it yourself")),
        (SCANS, tr("Control scans")),
    )


class TaskPage(FormPage):
    """Type, title, level, briefing.

    Signals:
        kind_wanted(str): another type.
    """

    kind_wanted = Signal(str)

    def __init__(self, editor: ExerciseEditor) -> None:
        covers = ("id", "version", "title", "level", "description", "purpose")
        super().__init__(editor, tr("Exercise"), covers)
        self.name = self.text("title", hint=tr("one line for people"))
        self.kind = self.choice("kind", title=tr("Type"), among=kinds())
        self.level = self.count("level")
        self.briefing = self.lines("description")
        practice, test = tr("Practice"), tr("Assessment: all controls are locked")
        self.purpose = self.choice("purpose", among=(("practice", practice), ("assessment", test)))
        self.note(("id",))
        self.kept = label("", "dim")
        self.rows.addWidget(self.kept)
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says, and under which name and version it is kept."""
        self.show_values({**self.editor.document, "kind": self._kind()})
        self.tell(self.editor.problems)
        name, saved = self.editor.get("id", default=""), self.editor.saved
        if saved is None:
            self.kept.setText(tr("Will be kept as “{name}”.", name=name))
        else:
            more = tr("; changes become the next version") if self.editor.dirty else ""
            said = tr("Kept as “{name}”, version {n}", name=name, n=saved.version)
            self.kept.setText(said + more + ".")

    def _kind(self) -> str:
        if self.editor.get("guidance", "mode") == "control_ct":
            return SCANS
        return OWN if self.editor.get("plan", "own") else FOLLOW

    def put(self, where: Where, value: Any, typed: bool) -> None:
        """Put it into the document; of an assessment all is locked, and nothing fades."""
        if where == ("kind",):
            self.kind_wanted.emit(value)
        elif value == "assessment" and where == ("purpose",):
            self.editor.put_all({where: value, ("locks",): None, ("fading",): None})
        else:
            super().put(where, value, typed)


class PatientPage(FormPage):
    """CT, path, position, structures, needle, device.

    Signals:
        plan_wanted(): take plan and position from the window.
    """

    plan_wanted = Signal()

    def __init__(self, editor: ExerciseEditor, structures: Callable[[], StructureSet]) -> None:
        covers = (
            "ct",
            "plan",
            "placement",
            "structures",
            "needle",
            "device",
            "joint",
            "rig",
            "target_organ",
            "seed",
        )
        super().__init__(editor, tr("Patient and path"), covers)
        self._structures = structures
        self.where = label()
        self.take = button(tr("Take path and position from the window"))
        self.take.clicked.connect(self.plan_wanted)
        self.add(("plan",), "", self.where, lambda _: self._show_path())
        self.rows.addWidget(self.take)
        self.note(("ct",))
        self.note(("placement",))
        self.risks = table((tr("Structure"), tr("Of risk"), tr("Keep off [mm]")))
        self.risks.setFixedHeight(theme.px(150))
        self.undrawn = label(
            tr("None is drawn: draw or import some on the page Structures."), "dim"
        )
        title = tr("Structures, drawn in the window")
        self.add(("structures",), title, self.risks, lambda _: self._show_risks())
        self.rows.addWidget(self.undrawn)
        gauges = [(gauge, f"{gauge} G") for gauge in OUTER_DIAMETER]
        self.choice("needle", "gauge", among=gauges)
        self.number("needle", "length_mm", within=(0.0, 400.0, 0.0), lowest="")
        devices = [(name, name) for name in profile_names("device")]
        rigs = [(name, name) for name in profile_names("rig")]
        self.choice("device", among=devices)
        self.text("joint")
        self.choice("rig", among=rigs)
        self.text("target_organ", hint=tr("such as liver"))
        self.count("seed")
        self.rows.addStretch(1)

    def _show_path(self) -> None:
        plan, phantom = self.editor.get("plan"), self.editor.get("ct", "phantom", "seed")
        if phantom is not None:
            lines = [tr("Phantom {n}", n=phantom)]
        else:
            known = self.editor.get("ct", "digest")
            lines = [tr("Own CT, digest {digest}…", digest=known[:12]) if known else tr("Own CT")]
        for name, key in ((tr("Entry"), "entry_mm"), (tr("Target"), "target_mm")):
            point = plan.get(key) if isinstance(plan, Mapping) else None
            place = (
                tr("the student's to place") if key == "entry_mm" else tr("the phantom's lesion")
            )
            shown = lps_words((point[0], point[1], point[2])) if point else place
            lines.append(f"{name}: {shown}")
        lies = self.editor.get("placement", "orientation", default="supine")
        lines.append(tr("Position: {name}", name=str(lies).replace("_", " ")))
        self.where.setText("\n".join(lines))

    def _show_risks(self) -> None:
        given = self.editor.get("structures", default=[])
        risks = {name: mm for part in given for name, mm in part.get("risks", {}).items()}
        names = [one.name for one in self._structures()]
        names += [name for name in risks if name not in names]
        rows = self.risks
        rows.setVisible(bool(names))
        self.undrawn.setVisible(not names)
        with QSignalBlocker(rows):
            rows.setRowCount(len(names))
            for row, name in enumerate(names):
                box, far = rows.cellWidget(row, 1), rows.cellWidget(row, 2)
                if not isinstance(box, QCheckBox) or not isinstance(far, QDoubleSpinBox):
                    box, far = QCheckBox(rows), QDoubleSpinBox(rows)
                    far.setRange(0.0, 50.0)
                    far.setKeyboardTracking(False)
                    rows.setCellWidget(row, 1, box)
                    rows.setCellWidget(row, 2, far)
                    wheel_scrolls(far)
                    box.clicked.connect(lambda _: self._take_risks())
                    far.valueChanged.connect(lambda _: self._take_risks())
                with QSignalBlocker(box), QSignalBlocker(far):
                    rows.setItem(row, 0, QTableWidgetItem(name))
                    box.setChecked(name in risks)
                    far.setValue(risks.get(name, 5.0))
                    far.setEnabled(name in risks)

    def _take_risks(self) -> None:
        chosen: dict[str, float] = {}
        for row in range(self.risks.rowCount()):
            name, box = self.risks.item(row, 0), self.risks.cellWidget(row, 1)
            far = self.risks.cellWidget(row, 2)
            if name is None or not isinstance(far, QDoubleSpinBox):
                continue
            if isinstance(box, QCheckBox) and box.isChecked():
                chosen[name.text()] = far.value()
        given = self.editor.get("structures", default=[])
        file = given[0]["file"] if len(given) == 1 else DRAWN
        values: dict[Where, Any] = {("structures",): [{"file": file, "risks": chosen}]}
        scored = self.editor.get("tolerances", "risk_breach")
        if chosen and scored is None:
            values[("tolerances", "risk_breach")] = default_tolerance("risk_breach")
        elif not chosen and scored is not None:
            values[("tolerances", "risk_breach")] = None
        self.editor.put_all(values)


class ReviewPage(FormPage):
    """All that is wrong, and the file that it will be."""

    def __init__(
        self,
        editor: ExerciseEditor,
        text: Callable[[], str],
        named: Callable[[FieldProblem], str],
    ) -> None:
        super().__init__(editor, tr("Check and keep"), ())
        self._text, self._named = text, named
        self.verdict = label()
        self.file = QPlainTextEdit(self)
        self.file.setReadOnly(True)
        self.file.setAccessibleName(tr("File of the exercise"))
        self.rows.addWidget(self.verdict)
        self.rows.addWidget(self.file, 1)

    def load(self) -> None:
        """Say what is wrong, or that nothing is; show the file."""
        super().load()
        said = [f"✖ {self._named(one)}: {problem_words(one)}" for one in self.editor.problems]
        warned = "" if said else self._warning()
        self.verdict.setText(
            "\n".join(said)
            or (tr("▲ The exercise can be used, but: {why}", why=warned) if warned else "")
            or tr("✔ The exercise can be used.")
        )
        colour = theme.BAD if said else theme.WARNING if warned else theme.GOOD
        self.verdict.setStyleSheet(f"color: {colour};")
        self.file.setPlainText(self._text())

    def _warning(self) -> str:
        """Say that bone stands before the target; empty where it does not."""
        from app.exercises.tissue import bone_before  # scipy

        exercise = self.editor.exercise
        if exercise is None or exercise.is_own_plan:
            return ""
        with suppress(AcusError):
            length = plan_of(exercise).length_mm
            depth = bone_before(exercise.layers, length)
            return "" if depth is None else bone_words(depth, length)
        return ""
