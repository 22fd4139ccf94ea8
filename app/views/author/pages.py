"""Pages of the form of an exercise: what it is, patient and path, and the check at the end."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QDoubleSpinBox, QPlainTextEdit, QTableWidgetItem

from app.core.configuration import FieldProblem
from app.core.errors import AcusError
from app.exercises.library import profile_names
from app.exercises.scene import plan_of
from app.imaging.structures.structure import StructureSet
from app.simulation.needles import OUTER_DIAMETER
from app.views.author.editing import DRAWN, ExerciseEditor, bone_words, default_tolerance
from app.views.author.page import Page
from app.views.kit import theme
from app.views.kit.coordinates import lps_words
from app.views.kit.document import Where
from app.views.kit.field_words import problem_words
from app.views.kit.form import Choice
from app.views.kit.parts import button, label, table
from app.views.kit.text import tr
from app.views.kit.wheel import wheel_scrolls

FOLLOW, OWN, SCANS = "follow", "own", "scans"


def kinds() -> Choice:
    """Types of exercises, with their names."""
    return (
        (FOLLOW, tr("Follow the path")),
        (OWN, tr("Plan it yourself")),
        (SCANS, tr("Control scans")),
    )


class TaskPage(Page):
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
        self.choice("purpose", among=(("practice", practice), ("assessment", test)))
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


class PatientPage(Page):
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
        self.rows.addWidget(self.undrawn)
        title = tr("Structures, drawn in the window")
        self.add(("structures",), title, self.risks, lambda _: self._show_risks())
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


class ReviewPage(Page):
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
