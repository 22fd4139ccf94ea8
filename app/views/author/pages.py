"""The pages of the form that an exercise is made with; each field says below it what is wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any

from PySide6.QtCore import QPointF, QRectF, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QFormLayout,
    QGroupBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.configuration import FieldProblem
from app.core.errors import AcusError
from app.core.plugins import StageDeclaration
from app.device.control.law import KIND as LAWS
from app.exercises.guidance import FadingKind, GuidanceMode, Purpose
from app.exercises.library import profile_names
from app.exercises.locks import Lock
from app.exercises.parts import TELLING, LayerPart, ViewName
from app.exercises.scene import plan_of
from app.imaging.structures.structure import StructureSet
from app.imaging.window import PRESETS
from app.scoring import metrics
from app.scoring.defaults import PUBLISHED_TOLERANCES
from app.simulation import effects
from app.simulation.needles import OUTER_DIAMETER
from app.views.author.editing import DRAWN, ExerciseEditor, Where, bone_words, limits
from app.views.kit import theme
from app.views.kit.coordinates import lps_words
from app.views.kit.field_words import place_words, problem_words
from app.views.kit.parts import PlainLabel, add_row, button, column, label, table
from app.views.kit.text import literal, tr
from app.views.kit.wheel import wheel_scrolls
from app.views.reading.lock_words import view_title

Choice = Sequence[tuple[Any, str]]


class Form(QWidget):
    """A page of fields, each bound to a place in the document; loaded while it is shown.

    Attributes:
        covers: fields whose problems belong to this page.
    """

    def __init__(self, editor: ExerciseEditor, title: str, covers: Sequence[str]) -> None:
        super().__init__()
        self.editor, self.title, self.covers = editor, title, tuple(covers)
        self.rows = column(self, title)
        self.fields: dict[Where, QWidget] = {}
        self.names: dict[Where, QLabel] = {}
        self._loads: list[Callable[[], None]] = []
        self._notes: list[tuple[Where, QLabel]] = []

    def load(self) -> None:
        """Show what the document says, and what is wrong with it."""
        for load in self._loads:
            load()
        for where, note in self._notes:
            found = self.editor.problems_at(*where)
            note.setText("\n".join(self._sentence(one, where) for one in found))
            note.setVisible(bool(found))

    @property
    def problems(self) -> list[FieldProblem]:
        """Return what is wrong with the fields of this page."""
        return [one for one in self.editor.problems if one.field and one.field[0] in self.covers]

    def _sentence(self, problem: FieldProblem, where: Where) -> str:
        """Say what is wrong, and where within the field if it is a part of it."""
        inner = self.inner_words(problem.field[len(where) :])
        text = problem_words(problem)
        return f"✖ {inner}: {text}" if inner else f"✖ {text}"

    def inner_words(self, parts: Sequence[str | int]) -> str:
        """Say where within a field of this page something stands."""
        return place_words(parts)

    def name_of(self, problem: FieldProblem) -> str:
        """Name the field of a problem as this page calls it."""
        for length in range(len(problem.field), 0, -1):
            where = tuple(map(str, problem.field[:length]))
            if where in self.names:
                inner = self.inner_words(problem.field[length:])
                return ", ".join(filter(None, (self.names[where].text(), inner)))
        return ", ".join(filter(None, (self.title, self.inner_words(problem.field[1:]))))

    # --- kinds of fields ------------------------------------------------------------------------
    def add(self, where: Where, name: str, widget: QWidget, load: Callable[[], None]) -> None:
        """Add a field with its name, and the line that says what is wrong with it."""
        if name:
            self.names[where] = PlainLabel(name, self)
            self.rows.addWidget(self.names[where])
            widget.setAccessibleName(name)
        self.rows.addWidget(widget)
        self.fields[where] = widget
        self._loads.append(load)
        self.note(where)

    def note(self, where: Where) -> None:
        """Add a line that says what is wrong with a field."""
        note = label()
        note.setStyleSheet(f"color: {theme.BAD};")
        note.hide()
        self.rows.addWidget(note)
        self._notes.append((where, note))

    def text(self, *where: str, name: str, hint: str = "") -> QLineEdit:
        """Add a line of text."""
        line = QLineEdit(self)
        line.setPlaceholderText(hint)
        line.textEdited.connect(lambda text: self.editor.put(*where, value=text, typed=True))
        self.add(where, name, line, lambda: _show_line(line, self.editor.get(*where, default="")))
        return line

    def lines(self, *where: str, name: str) -> QPlainTextEdit:
        """Add a text of several lines."""
        box = QPlainTextEdit(self)
        box.setTabChangesFocus(True)
        box.setFixedHeight(6 * theme.FONT_PX)

        def load() -> None:
            text = self.editor.get(*where, default="")
            if box.toPlainText() != text:
                with QSignalBlocker(box):
                    box.setPlainText(text)

        box.textChanged.connect(
            lambda: self.editor.put(*where, value=box.toPlainText() or None, typed=True)
        )
        self.add(where, name, box, load)
        return box

    def number(
        self,
        *where: str,
        name: str,
        unit: str = "",
        within: tuple[float, float, float] | None = None,
    ) -> QDoubleSpinBox:
        """Add a number with two digits behind the point; its limits are those of an exercise."""
        box = QDoubleSpinBox(self)
        low, high, default = within or limits(*where)
        box.setRange(low, high)
        box.setDecimals(2)
        box.setSingleStep(0.1 if high - low <= 4.0 else 1.0)
        box.setSuffix(f" {unit}" if unit else "")
        box.setKeyboardTracking(False)
        box.valueChanged.connect(lambda value: self.editor.put(*where, value=float(value)))

        def load() -> None:
            value = self.editor.get(*where, default=default)
            with QSignalBlocker(box):
                box.setValue(float(value) if isinstance(value, int | float) else default)

        self.add(where, name, box, load)
        return box

    def count(self, *where: str, name: str) -> QSpinBox:
        """Add a whole number; its limits are those of an exercise."""
        box = QSpinBox(self)
        low, high, default = limits(*where)
        box.setRange(low, high)
        box.setKeyboardTracking(False)
        box.valueChanged.connect(lambda value: self.editor.put(*where, value=int(value)))

        def load() -> None:
            value = self.editor.get(*where, default=default)
            with QSignalBlocker(box):
                box.setValue(value if isinstance(value, int) else default)

        self.add(where, name, box, load)
        return box

    def choice(
        self,
        *where: str,
        name: str,
        among: Choice,
        read: Callable[[], Any] | None = None,
        write: Callable[[Any], object] | None = None,
    ) -> QComboBox:
        """Add a choice; `read` and `write` where it is more than one field."""
        box = QComboBox(self)
        for value, title in among:
            box.addItem(title, value)
        put = write or (lambda value: self.editor.put(*where, value=value))
        get = read or (lambda: self.editor.get(*where))
        box.activated.connect(lambda _: put(box.currentData()))

        def load() -> None:
            value = get()
            place = next((n for n in range(box.count()) if box.itemData(n) == value), -1)
            if place < 0 and value is not None:  # a file of one's own
                box.addItem(_shown(value), value)
                place = box.count() - 1
            with QSignalBlocker(box):
                box.setCurrentIndex(max(place, 0))

        self.add(where, name, box, load)
        return box

    def flags(self, *where: str, name: str, among: Choice) -> dict[Any, QCheckBox]:
        """Add a list of which any may hold; what cannot be chosen now keeps what was said of it."""
        frame = QWidget(self)
        inner = QVBoxLayout(frame)
        inner.setContentsMargins(0, 0, 0, 0)
        boxes = {value: QCheckBox(title, frame) for value, title in among}

        def put() -> None:
            held = self.editor.get(*where, default=[])
            chosen = [
                value
                for value, box in boxes.items()
                if (box.isChecked() if box.isEnabled() else value in held)
            ]
            self.editor.put(*where, value=chosen)

        def load() -> None:
            held = self.editor.get(*where, default=[])
            for value, box in boxes.items():
                with QSignalBlocker(box):
                    box.setChecked(value in held)

        for box in boxes.values():
            inner.addWidget(box)
            box.clicked.connect(lambda _: put())
        self.add(where, name, frame, load)
        return boxes

    def check(self, *where: str, name: str) -> QCheckBox:
        """Add a yes or no."""
        box = QCheckBox(name, self)
        box.clicked.connect(lambda on: self.editor.put(*where, value=bool(on)))

        def load() -> None:
            with QSignalBlocker(box):
                box.setChecked(bool(self.editor.get(*where)))

        self.add(where, "", box, load)
        return box


def _hold(box: QCheckBox, on: bool | None, reason: str) -> None:
    """Let a box stand on or off, whatever was chosen, and say why; None sets it free."""
    box.setEnabled(on is None)
    box.setToolTip(literal("" if on is None else reason))
    if on is not None:
        with QSignalBlocker(box):
            box.setChecked(on)


def _shown(value: object) -> str:
    """Return a value for a list that does not have it: a window, or a file of one's own."""
    if isinstance(value, Mapping) and "width" in value:
        return f"W {value['width']:g}  L {value.get('level', 0.0):g}"
    return str(value)


def _show_line(line: QLineEdit, text: object) -> None:
    if line.text() != str(text):
        with QSignalBlocker(line):
            line.setText(str(text))


# --- pages --------------------------------------------------------------------------------------
FOLLOW, OWN, SCANS = "follow", "own", "scans"


def kinds() -> Choice:
    """Types of exercises, with their names."""
    return (
        (FOLLOW, tr("Follow the path")),
        (OWN, tr("Plan it yourself")),
        (SCANS, tr("Control scans")),
    )


class TaskPage(Form):
    """Type, title, level, briefing.

    Signals:
        kind_wanted(str): another type.
    """

    kind_wanted = Signal(str)

    def __init__(self, editor: ExerciseEditor) -> None:
        covers = ("id", "version", "title", "level", "description", "purpose")
        super().__init__(editor, tr("Exercise"), covers)
        self.name = self.text("title", name=tr("Title"), hint=tr("one line for people"))
        self.kind = self.choice(
            "kind", name=tr("Type"), among=kinds(), read=self._kind, write=self.kind_wanted.emit
        )
        self.level = self.count("level", name=tr("Level (1 easiest)"))
        self.briefing = self.lines("description", name=tr("Briefing"))
        practice, test = tr("Practice"), tr("Assessment: all controls are locked")
        self.choice(
            "purpose",
            name=tr("Purpose"),
            among=(("practice", practice), ("assessment", test)),
            write=self._set_purpose,
        )
        self.note(("id",))
        self.kept = label("", "dim")
        self.rows.addWidget(self.kept)
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says, and under which name and version it is kept."""
        super().load()
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

    def _set_purpose(self, purpose: str) -> None:
        values: dict[Where, Any] = {("purpose",): purpose}
        if purpose == "assessment":  # all is locked, and nothing fades
            values |= {("locks",): None, ("fading",): None}
        self.editor.put_all(values)


class PatientPage(Form):
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
        self.add(("plan",), "", self.where, self._show_path)
        self.rows.addWidget(self.take)
        self.note(("ct",))
        self.note(("placement",))
        self.risks = table((tr("Structure"), tr("Of risk"), tr("Keep off [mm]")))
        self.risks.setFixedHeight(theme.px(150))
        self.undrawn = label(
            tr("None is drawn: draw or import some on the page Structures."), "dim"
        )
        self.rows.addWidget(self.undrawn)
        self.add(
            ("structures",), tr("Structures, drawn in the window"), self.risks, self._show_risks
        )
        gauges = [(gauge, f"{gauge} G") for gauge in OUTER_DIAMETER]
        self.choice("needle", "gauge", name=tr("Needle"), among=gauges)
        self.number(
            "needle",
            "length_mm",
            name=tr("Length of the needle, 0 for the device's own"),
            within=(0.0, 400.0, 0.0),
            unit="mm",
        ).valueChanged.connect(self._no_zero)
        devices = [(name, name) for name in profile_names("device")]
        rigs = [(name, name) for name in profile_names("rig")]
        self.choice("device", name=tr("Robot"), among=devices)
        self.text("joint", name=tr("Ball joint, empty for the robot's own"))
        self.choice("rig", name=tr("Cameras"), among=rigs)
        self.text("target_organ", name=tr("Organ of the target"), hint=tr("such as liver"))
        self.count("seed", name=tr("Seed of everything random"))
        self.rows.addStretch(1)

    def _no_zero(self, value: float) -> None:
        if value == 0.0:
            self.editor.put("needle", "length_mm", value=None)

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


class HelpPage(Form):
    """Assistance: fixed, by a schedule, fading; and force laws."""

    def __init__(self, editor: ExerciseEditor) -> None:
        super().__init__(editor, tr("Assistance"), ("assistance", "fading", "laws"))
        self.number(
            "assistance",
            name=tr("Dial at the start: 1 guides, 0 nothing, −1 repels"),
        )
        ways = (
            (None, tr("Fixed: the same at every attempt")),
            (FadingKind.SCHEDULE.value, tr("Schedule: a dial for each attempt")),
            (
                FadingKind.PERFORMANCE.value,
                tr("Fading: less after good attempts, more after poor ones"),
            ),
        )
        self.way = self.choice(
            "fading", "kind", name=tr("Over the attempts"), among=ways, write=self._set_way
        )
        self.dials = self.text(
            "fading", "dials", name=tr("Dials of the 1st, 2nd, … attempt"), hint="0.7, 0.4, 0"
        )
        self.dials.textEdited.disconnect()
        self.dials.textEdited.connect(self._set_dials)
        self._loads[-1] = self._show_dials
        self.number("fading", "least", name=tr("Dial never falls below"))
        self.number("fading", "step", name=tr("Step of the dial"))
        self.number("fading", "good", name=tr("Good from a total of"))
        self.number("fading", "poor", name=tr("Poor below a total of"))
        self.probes = self.count(
            "fading",
            "probe_every",
            name=tr("Every so many attempts a probe without help; 0: none"),
        )
        self.note(("fading",))
        self.laws = PartsBox(editor, "laws", tr("Force laws"))
        self.rows.addWidget(self.laws)
        self.note(("laws",))
        self._loads.append(self.laws.load)
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says; of fading only what its kind has."""
        super().load()
        kind = self.editor.get("fading", "kind")
        for where, widget in self.fields.items():
            if where[0] == "fading" and where[1] != "kind":
                belongs = {"schedule": ("dials", "probe_every"), None: ()}.get(
                    kind, ("least", "step", "good", "poor", "probe_every")
                )
                widget.setVisible(where[1] in belongs)
                self.names[where].setVisible(where[1] in belongs)

    def _set_way(self, kind: str | None) -> None:
        dials = {"dials": [0.7, 0.4, 0.2, 0.0]} if kind == "schedule" else {}
        self.editor.put("fading", value=None if kind is None else {"kind": kind, **dials})

    def _show_dials(self) -> None:
        dials = self.editor.get("fading", "dials", default=[])
        if dials and dials == _dials_of(self.dials.text()):
            return  # what somebody writes is not rewritten under his hands
        if not self.dials.hasFocus() or not dials:
            shown = dials if isinstance(dials, str) else ", ".join(f"{one:g}" for one in dials)
            _show_line(self.dials, shown)

    def _set_dials(self, text: str) -> None:
        self.editor.put("fading", "dials", value=_dials_of(text), typed=True)


def _dials_of(text: str) -> list[float] | str:
    """Return dials: `0.7, 0.4`, or `0,7; 0,4`; of another text itself: the reader says why."""
    parts = text.replace(",", ".").split(";") if ";" in text else text.split(",")
    try:
        return [float(part) for part in parts if part.strip()]
    except ValueError:
        return text


class SightPage(Form):
    """Views, locks, and how the CT is read.

    Signals:
        reading_wanted(): take window and slab from the axial pane.
    """

    reading_wanted = Signal()

    def __init__(self, editor: ExerciseEditor) -> None:
        covers = ("views", "locks", "hand", "unsteady_hand", "reading", "guidance", "touch")
        super().__init__(editor, tr("What is seen"), covers)
        self.views = self.flags(
            "views", name=tr("Views"), among=[(one.value, view_title(one)) for one in ViewName]
        )
        locks = {
            Lock.ASSISTANCE: tr("The assistance"),
            Lock.VIEWS: tr("What is shown"),
            Lock.READING: tr("Window, slab and layout"),
            Lock.HAND: tr("What moves the hand"),
            Lock.MODELS: tr("The way effects are computed"),
        }
        self.locks = self.flags(
            "locks",
            name=tr("Locked for the student"),
            among=[(one.value, title) for one, title in locks.items()],
        )
        hands = (
            (None, tr("The student's own")),
            ("mouse", tr("Mouse")),
            ("tablet", tr("Tablet")),
            ("gamepad", tr("Gamepad")),
        )
        self.choice("hand", name=tr("Hand"), among=hands)
        steadiness = (
            (None, tr("As the exercise's level has it")),
            (0, tr("Steady")),
            *((level, tr("Unsteady as at level {n}", n=level)) for level in range(1, 6)),
        )
        self.choice("unsteady_hand", name=tr("Simulated hand"), among=steadiness)
        windows = [
            (None, tr("The student's own")),
            *(({"width": one.width, "level": one.level}, name) for name, one in PRESETS.items()),
        ]
        self.choice("reading", "window", name=tr("Window of the CT"), among=windows)
        layouts = (
            (None, tr("The student's own")),
            ("2x2", "2×2"),
            ("1+3", "1+3"),
            ("6-up", "6"),
            ("needle", tr("Along the needle")),
        )
        self.choice("reading", "layout", name=tr("Layout of the panes"), among=layouts)
        kinds_of_slabs = (
            (None, tr("The student's own")),
            ("mean", tr("Mean")),
            ("mip", tr("Brightest")),
            ("minip", tr("Darkest")),
        )
        self.choice(
            "reading", "slab", "kind", name=tr("Slab"), among=kinds_of_slabs, write=self._set_slab
        )
        self.number(
            "reading",
            "slab",
            "thickness_mm",
            name=tr("Thickness of the slab"),
            unit="mm",
        )
        self.take = button(tr("Take window and slab from the axial pane"))
        self.take.clicked.connect(self.reading_wanted)
        self.rows.addWidget(self.take)
        self.check("reading", "locked", name=tr("Window, slab and layout stay as given here"))
        self.note(("reading",))
        self.note(("touch",))
        self.count("guidance", "slices", name=tr("Slices of a control scan"))
        self.number(
            "guidance",
            "slice_mm",
            name=tr("Thickness of a slice"),
            unit="mm",
        )
        self.number(
            "guidance",
            "dose_per_slice",
            name=tr("Dose of a slice, a teaching estimate"),
            unit="mGy·cm",
        )
        self.check("guidance", "streak", name=tr("Metal leaves a streak in control scans"))
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says; the thickness of a slab only where there is one."""
        super().load()
        where = ("reading", "slab", "thickness_mm")
        there = self.editor.get("reading", "slab") is not None
        self.fields[where].setVisible(there)
        self.names[where].setVisible(there)
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

    def _set_slab(self, kind: str | None) -> None:
        thick = self.editor.get("reading", "slab", "thickness_mm", default=5.0)
        slab = None if kind is None else {"kind": kind, "thickness_mm": thick}
        self.editor.put("reading", "slab", value=slab)


class EffectsPage(Form):
    """Effects with the live plan of what is simulated, why, and at what cost."""

    def __init__(self, editor: ExerciseEditor) -> None:
        super().__init__(
            editor, tr("Effects"), ("effects", "without", "tissue", "layers", "layers_from")
        )
        self.parts = PartsBox(editor, "effects", "")
        self.rows.addWidget(self.parts)
        self.note(("effects",))
        self.layers = LayersBox(editor)
        name = tr("Layers of tissue, from the skin inwards")
        self.add(("layers",), name, self.layers, self.layers.load)
        self.choice(
            "layers_from",
            name=tr("Where they come from"),
            among=(
                ("file", tr("this table")),
                ("ct", tr("the CT along the path, found when an attempt begins")),
            ),
        )
        self.calls = label("", "dim")
        self.rows.addWidget(self.calls)
        self.complete = QPushButton(tr("Add what is absent"), self)
        self.complete.setVisible(False)
        self.complete.clicked.connect(self._add_absent)
        self.rows.addWidget(self.complete)
        self._absent: Mapping[str, Any] = {}
        self.cost = label("", "dim")
        self.rows.addWidget(self.cost)
        self._loads.append(self.parts.load)
        self.rows.addStretch(1)

    def show_cost(self, result: Mapping[str, Any] | None) -> None:
        """Write what a tick costs; None while it is measured."""
        self._show_calls(result or {})
        if result is None:
            self.cost.setText(tr("measuring what it costs …"))
            return
        ticking = [one for one in result["simulated"] if one["picture_ns"] is None]
        costs = {one["effect"]: one["cost_ns"] for one in ticking}
        costs |= {one["law"]: one["cost_ns"] for one in result["laws"]}
        lines = [
            tr("{name}: {ns:.0f} ns of each tick", name=name, ns=ns) for name, ns in costs.items()
        ]
        share = sum(costs.values()) / 1e4
        lines.append(tr("together {share:.2f} % of the millisecond that a tick has", share=share))
        lines += [
            tr(
                "{name}: {ms:.2f} ms for each picture of a camera",
                name=one["effect"],
                ms=one["picture_ns"] / 1e6,
            )
            for one in result["simulated"]
            if one["picture_ns"] is not None
        ]
        self.cost.setText("\n".join(lines))

    def show_no_cost(self, reason: str) -> None:
        """Say why neither costs nor what the patient calls for are known."""
        self._show_calls({})
        self.cost.setText(tr("It cannot be measured: {reason}", reason=reason))

    def _show_calls(self, result: Mapping[str, Any]) -> None:
        """List what the patient calls for and the exercise lacks, with the cost of each."""
        self._absent = result.get("add", {})
        absent = [call for call in result.get("called_for", ()) if call["absent"]]
        lines = [
            tr(
                "✖ {name} is called for: {reason} ({ns:.0f} ns of each tick)",
                name=call["effect"],
                reason=call["reason"],
                ns=call["cost_ns"] or 0.0,
            )
            for call in absent
        ]
        self.calls.setText("\n".join(lines))
        self.calls.setVisible(bool(lines))
        self.complete.setVisible(bool(self._absent))

    def _add_absent(self) -> None:
        """Put all that is absent into the exercise, as one step that undo takes back."""
        effects = self._absent.get("effects", {})
        values: dict[tuple[str, ...], Any] = {
            ("effects", name): dict(part) for name, part in effects.items()
        }
        if "tissue" in self._absent:
            values[("tissue",)] = self._absent["tissue"]
        self.editor.put_all(values)


LAYER_NUMBERS = (
    *("thickness_mm", "side_stiffness_kpa", "friction", "static_friction", "viscous_friction"),
    *("puncture_force", "toughness", "indentation_stiffness", "indentation_hardening"),
    *("relaxation_share", "relaxation_time", "pressing", "rigid"),
)
"""Columns of the table of layers after the name, as `LayerPart` has them."""

NEW_LAYER = {"name": "tissue", "thickness_mm": 20.0}


class LayersBox(QWidget):
    """The layers of tissue as a table: each cell, row and move is a step that undo takes back.

    Signals:
        ct_wanted(): fill it with what the CT holds along the path.
    """

    ct_wanted = Signal()

    def __init__(self, editor: ExerciseEditor) -> None:
        super().__init__()
        self._editor = editor
        inner = QVBoxLayout(self)
        inner.setContentsMargins(0, 0, 0, 0)
        self.none = label(tr("None is given: the body is of one tissue."), "dim")
        self.table = QTableWidget(0, 1 + len(LAYER_NUMBERS), self)
        self.table.setTabKeyNavigation(False)
        self.table.setHorizontalHeaderLabels(
            [
                tr("Layer"),
                tr("thick\n[mm]"),
                tr("side stiffness\n[kPa]"),
                tr("friction\n[N/m]"),
                tr("break-away\n[N/m]"),
                tr("viscous\n[N·s/m²]"),
                tr("puncture,\n18 G [N]"),
                tr("toughness\n[J/m²]"),
                tr("dimple\n[N/m]"),
                tr("dimple\n[N/m²]"),
                tr("relaxing\nshare"),
                tr("relaxing\n[s]"),
                tr("bone"),
            ]
        )
        self.table.setAccessibleName(tr("Layers of tissue, from the skin inwards"))
        self.table.setFixedHeight(theme.px(190))
        self.table.itemChanged.connect(self._take)
        self.table.itemSelectionChanged.connect(self._allow)
        self.more, self.less = button(tr("Add a layer")), button(tr("Remove"))
        self.up, self.down = button(tr("Outwards")), button(tr("Inwards"))
        self.from_ct = button(tr("From the CT"))
        self.from_ct.setToolTip(tr("Fills the table with what the needle meets on its path."))
        buttons = QHBoxLayout()
        for one, command in (
            (self.more, self._add),
            (self.less, self._remove),
            (self.up, lambda: self._move(-1)),
            (self.down, lambda: self._move(1)),
            (self.from_ct, self.ct_wanted.emit),
        ):
            one.clicked.connect(command)
            buttons.addWidget(one)
        inner.addWidget(self.none)
        inner.addWidget(self.table)
        inner.addLayout(buttons)

    def load(self) -> None:
        """Show the layers of the document."""
        given = self._given()
        self.none.setVisible(not given)
        self.table.setVisible(bool(given))
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(given))
            for row, layer in enumerate(given):
                for place, key in enumerate(("name", *LAYER_NUMBERS)):
                    default = LayerPart.model_fields[key].default if place > 1 else ""
                    value = layer.get(key, default)
                    text = f"{value:g}" if isinstance(value, int | float) else str(value)
                    if isinstance(value, bool):
                        text = tr("yes") if value else ""
                    item = self.table.item(row, place) or QTableWidgetItem()
                    if item.tableWidget() is None:
                        self.table.setItem(row, place, item)
                    item.setText(text)
        self._allow()

    def _given(self) -> list[dict[str, Any]]:
        return [dict(layer) for layer in self._editor.get("layers", default=[]) or []]

    def _put(self, layers: list[dict[str, Any]], row: int | None = None) -> None:
        self._editor.put("layers", value=layers or None)
        if row is not None:
            self.table.setCurrentCell(row, 0)

    def _take(self, item: QTableWidgetItem) -> None:
        layers, text = self._given(), item.text().strip()
        key = ("name", *LAYER_NUMBERS)[item.column()]
        value: Any = text
        if key == "rigid":
            value = text.casefold() in ("yes", "true", "1", tr("yes").casefold())
        elif key != "name":
            with suppress(ValueError):  # the reader says what is wrong with it
                value = float(text.replace(",", "."))
        if text or key in ("name", "thickness_mm"):
            layers[item.row()][key] = value
        else:
            layers[item.row()].pop(key, None)  # back to what it is where nothing is given
        self._put(layers)

    def _add(self) -> None:
        layers, row = self._given(), self.table.currentRow() + 1
        row = row if 0 < row <= len(layers) else len(layers)
        layers.insert(row, dict(NEW_LAYER))
        self._put(layers, row)

    def _remove(self) -> None:
        layers, row = self._given(), self.table.currentRow()
        if 0 <= row < len(layers):
            del layers[row]
            self._put(layers, min(row, len(layers) - 1))

    def _move(self, by: int) -> None:
        layers, row = self._given(), self.table.currentRow()
        if 0 <= row < len(layers) and 0 <= row + by < len(layers):
            layers.insert(row + by, layers.pop(row))
            self._put(layers, row + by)

    def _allow(self) -> None:
        row, rows = self.table.currentRow(), self.table.rowCount()
        self.less.setEnabled(0 <= row < rows)
        self.up.setEnabled(0 < row < rows)
        self.down.setEnabled(0 <= row < rows - 1)


class PartsBox(QWidget):
    """Effects or force laws: which, and their parameters."""

    def __init__(self, editor: ExerciseEditor, field: str, title: str) -> None:
        super().__init__()
        self._editor, self._field = editor, field
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        if title:
            rows.addWidget(PlainLabel(title))
        self.boxes: dict[str, QCheckBox] = {}
        self.values: dict[tuple[str, str], QLineEdit] = {}
        self.organs: dict[str, QLineEdit] = {}
        self.ways: dict[str, QComboBox] = {}
        self._why: dict[str, QLabel] = {}
        self._frames: dict[str, QGroupBox] = {}
        for name, declared in _declared(field).items():
            self._add(rows, name, declared)

    def _add(self, rows: QVBoxLayout, name: str, declared: StageDeclaration) -> None:
        box = self.boxes[name] = QCheckBox(f"{declared.title}  ({name})", self)
        box.clicked.connect(lambda on, name=name: self._switch(name, on))
        why = self._why[name] = label("", "dim")
        frame = self._frames[name] = QGroupBox(self)
        form = QFormLayout(frame)
        for key, one in declared.parameters.items():
            line = self.values[name, key] = QLineEdit(frame)
            line.setPlaceholderText(_plain(one.default))
            line.setToolTip(literal(f"{one.meaning}; {one.minimum:g} … {one.maximum:g} {one.unit}"))
            line.textEdited.connect(lambda text, at=(name, key): self._set(at, text))
            add_row(form, f"{key} [{one.unit}]", line)
        if isinstance(declared, effects.Effect):
            self._add_words(form, name, declared)
        for widget in (box, why, frame):
            rows.addWidget(widget)

    def _add_words(self, form: QFormLayout, name: str, declared: effects.Effect) -> None:
        """Add what an effect acts on, and the way to compute it where there are several."""
        if not declared.pictures:  # which act on no organ
            organ = self.organs[name] = QLineEdit(self)
            organ.setPlaceholderText(tr("everything"))
            organ.textEdited.connect(
                lambda text: self._editor.put(
                    self._field, name, "organ", value=text.strip() or None, typed=True
                )
            )
            add_row(form, tr("acts on"), organ)
        if len(declared.models) < 2:
            return
        way = self.ways[name] = QComboBox(self)
        for key, words in declared.models.items():
            way.addItem(f"{key}: {words}", key)
        way.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        way.activated.connect(
            lambda _: self._editor.put(self._field, name, "model", value=way.currentData())
        )
        add_row(form, tr("computed by"), way)

    def load(self) -> None:
        """Show which are on, why each is simulated or not, and what their parameters are."""
        parts = self._editor.get(self._field, default={})
        for name, box in self.boxes.items():
            with QSignalBlocker(box):
                box.setChecked(name in parts)
            shown = self._editor.why.get(name, "") if name in parts else ""
            self._why[name].setText(shown)
            self._why[name].setVisible(bool(shown))
            has_values = name in self.organs or any(one == name for one, _ in self.values)
            self._frames[name].setVisible(name in parts and has_values)
        for (name, key), line in self.values.items():
            given = (parts.get(name) or {}).get("parameters", {}).get(key, "")
            if not line.hasFocus():
                _show_line(line, _plain(given))
        for name, line in self.organs.items():
            if not line.hasFocus():
                _show_line(line, (parts.get(name) or {}).get("organ", ""))
        for name, way in self.ways.items():
            place = way.findData((parts.get(name) or {}).get("model", ""))
            with QSignalBlocker(way):
                way.setCurrentIndex(max(place, 0))

    def _switch(self, name: str, on: bool) -> None:
        self._editor.put(self._field, name, value={} if on else None)
        if not on and not self._editor.get(self._field):
            self._editor.put(self._field, value={})

    def _set(self, at: tuple[str, str], text: str) -> None:
        name, key = at
        value: Any = text
        if text.strip():
            try:
                value = float(text.replace(",", "."))
            except ValueError:
                value = text  # the reader says what is wrong with it
        else:
            value = None
        self._editor.put(self._field, name, "parameters", key, value=value, typed=True)


def _plain(value: object) -> str:
    return f"{value:g}" if isinstance(value, int | float) else str(value or "")


def _declared(field: str) -> dict[str, StageDeclaration]:
    if field == "effects":
        return {name: effects.declaration(name) for name in effects.effect_names()}
    return {name: LAWS.find(name) for name in LAWS.names()}


USUAL = (
    *("lateral_error", "depth_error", "angle_error", "path_ratio", "total_time", "target_error"),
    *("risk_breach", "control_scans", "notional_dose"),
)
"""Metrics that stand first in the table."""

BANDS = ("expert", "good", "pass", "zero", "weight")


class SkillsPlot(QWidget):
    """A dot for each attempt's score, a column for each skill, and the line to pass.

    Attributes:
        scores: what is drawn, skill → scores of 0 to 100.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.scores: dict[str, list[float]] = {}
        self._passed: dict[str, float] = {}
        self._pass_mark = 60.0
        self.setFixedHeight(theme.px(140))
        self.setAccessibleName(tr("What scripted skills would score (scripts, not people)"))

    def show_scores(self, rows: Sequence[Mapping[str, Any]], pass_mark: float) -> None:
        """Draw rows of `acus exercise trial --json`; none where nothing is known."""
        self._pass_mark = pass_mark
        self._passed = {row["skill"]: row["share_passed"] for row in rows}
        self.scores = {
            row["skill"]: [score for score in row["scores"] if score is not None] for row in rows
        }
        self.setAccessibleDescription(
            "; ".join(
                f"{name} " + ", ".join(f"{score:.0f}" for score in scores)
                for name, scores in self.scores.items()
            )
        )
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw it."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        line = self.fontMetrics().height()
        left, top, bottom = 2.5 * line, 0.5 * line, self.height() - 2.4 * line
        right = self.width() - 0.5 * line

        def height(score: float) -> float:
            return bottom - (bottom - top) * score / 100.0

        painter.setPen(QColor(theme.TEXT_DIM))
        for score in (0.0, 50.0, 100.0):
            painter.drawText(QPointF(0.0, height(score) + 0.35 * line), f"{score:.0f}")
            painter.drawLine(QPointF(left, height(score)), QPointF(right, height(score)))
        painter.setPen(QPen(QColor(theme.TEXT), 1.0, Qt.PenStyle.DashLine))
        at = height(self._pass_mark)
        painter.drawLine(QPointF(left, at), QPointF(right, at))
        width = (right - left) / max(len(self.scores), 1)
        for number, (name, scores) in enumerate(self.scores.items()):
            column = QRectF(left + number * width, bottom + 0.1 * line, width, 2.2 * line)
            passes = f"{self._passed[name]:.0%} " + tr("pass")
            painter.setPen(QColor(theme.TEXT))
            painter.drawText(column, Qt.AlignmentFlag.AlignHCenter, f"{name}\n{passes}")
            good = self._passed[name] > 0.5
            painter.setBrush(QColor(theme.GOOD if good else theme.BAD))
            painter.setPen(Qt.PenStyle.NoPen)
            step = min(0.5 * line, 0.85 * width / max(len(scores), 1))
            for place, score in enumerate(scores):
                beside = (place - 0.5 * (len(scores) - 1)) * step
                middle = QPointF(column.center().x() + beside, height(score))
                painter.drawEllipse(middle, 0.25 * line, 0.25 * line)
        painter.end()


class ScorePage(Form):
    """What counts: bands, weights, hard fails; and what scripted skills would score.

    Signals:
        looked_at(): the page is shown.
    """

    looked_at = Signal()

    def __init__(self, editor: ExerciseEditor) -> None:
        super().__init__(editor, tr("Score"), ("tolerances", "bands", "rules"))
        there = {name: one for name, one in metrics.available().items() if not one.fault}
        first = [name for name in USUAL if name in there]
        self.metrics = {name: there[name] for name in dict.fromkeys((*first, *there))}
        self.bands = QTableWidget(len(self.metrics), 7, self)
        self.bands.setTabKeyNavigation(False)
        heads = [tr("Counts"), tr("expert"), tr("good"), tr("pass"), tr("zero"), tr("weight")]
        heads.append(tr("must"))
        self.bands.setHorizontalHeaderLabels(heads)
        self.bands.setVerticalHeaderLabels(
            [
                f"{one.title} [{one.unit}]" if one.unit else one.title
                for one in self.metrics.values()
            ]
        )
        self.bands.setMinimumHeight(theme.px(250))
        for place, words in enumerate(heads):
            needed = self.bands.fontMetrics().horizontalAdvance(words) + 2 * theme.SPACING
            self.bands.setColumnWidth(place, max(theme.px(50), needed))
        self.bands.verticalHeader().setMaximumWidth(theme.px(230))
        self.bands.itemChanged.connect(self._take)
        self.add(
            ("tolerances",),
            tr("Bands: from “expert” on all points, beyond “zero” none"),
            self.bands,
            self._show,
        )
        self.rows.addWidget(
            PlainLabel(tr("What scripted skills would score (scripts, not people)"))
        )
        self.skills = SkillsPlot(self)
        self.rows.addWidget(self.skills)
        self.tried = label("", "dim")
        self.rows.addWidget(self.tried)
        self.number("rules", "pass_mark", name=tr("Total needed to pass"))
        self.number(
            "rules",
            "minimum_tracking",
            name=tr("Void below this share of the insertion with a measured depth"),
            unit="%",
        )
        self.number(
            "rules",
            "maximum_pause",
            name=tr("Void beyond this time of waiting for the cameras"),
            within=(0.0, 3600.0, 20.0),
            unit="s",
        )
        self.note(("rules",))
        self.drawn = label(
            tr("The rings of “Off the path” are drawn on the CT as you change them."), "dim"
        )
        self.rows.addWidget(self.drawn)

    def inner_words(self, parts: Sequence[str | int]) -> str:
        """Name a metric by its title."""
        known = self.metrics.get(str(parts[0])) if parts else None
        if known is None:
            return super().inner_words(parts)
        return ", ".join(filter(None, (known.title, super().inner_words(parts[1:]))))

    def showEvent(self, event: QShowEvent) -> None:
        """Tell that somebody looks."""
        super().showEvent(event)
        self.looked_at.emit()

    def _show(self) -> None:
        given = self.editor.get("tolerances", default={})
        wrong = {one.field[1] for one in self.editor.problems_at("tolerances") if one.field[1:]}
        with QSignalBlocker(self.bands):
            for row, name in enumerate(self.metrics):
                limits = given.get(name)
                self._flag(row, 0, limits is not None, name in wrong)
                self._flag(row, 6, bool(limits and limits.get("required")), False)
                for place, key in enumerate(BANDS, 1):
                    value = "" if limits is None else limits.get(key, "")
                    self._cell(
                        row, place, _plain(value) if value != 0.0 else "0", limits is not None
                    )

    def _flag(self, row: int, place: int, on: bool, wrong: bool) -> None:
        item = self.bands.item(row, place) or QTableWidgetItem()
        item.setFlags(Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsEnabled)
        item.setCheckState(Qt.CheckState.Checked if on else Qt.CheckState.Unchecked)
        item.setText("✖" if wrong else "")
        if item.tableWidget() is None:
            self.bands.setItem(row, place, item)

    def _cell(self, row: int, place: int, text: str, on: bool) -> None:
        item = self.bands.item(row, place) or QTableWidgetItem()
        edited = Qt.ItemFlag.ItemIsEditable | Qt.ItemFlag.ItemIsEnabled
        item.setFlags(edited | Qt.ItemFlag.ItemIsSelectable if on else Qt.ItemFlag.NoItemFlags)
        item.setText(text)
        if item.tableWidget() is None:
            self.bands.setItem(row, place, item)

    def _take(self, item: QTableWidgetItem) -> None:
        name, place = list(self.metrics)[item.row()], item.column()
        on = item.checkState() is Qt.CheckState.Checked
        if place == 0:
            self.editor.put("tolerances", name, value=default_tolerance(name) if on else None)
        elif place == 6:
            self.editor.put("tolerances", name, "required", value=on)
        else:
            text, key = item.text().strip(), BANDS[place - 1]
            value: Any = None
            if text:
                try:
                    value = float(text.replace(",", "."))
                except ValueError:
                    value = text
            self.editor.put("tolerances", name, key, value=value)


class ReviewPage(Form):
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
