"""Effects or force laws of an exercise: which, why each is simulated or not, its parameters."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QGroupBox,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from app.core.plugins import StageDeclaration
from app.device.control.law import KIND as LAWS
from app.simulation import effects
from app.views.author.editing import ExerciseEditor
from app.views.author.page import number_of, plain
from app.views.kit.form import Form
from app.views.kit.parts import PlainLabel, label
from app.views.kit.text import literal, tr


class PartsBox(QWidget):
    """Effects or force laws: which, and their parameters.

    Attributes:
        boxes: on or off, by name.
        values: of parameters, by name of the part and of the parameter.
        organs: what an effect acts on, by its name.
        ways: by which an effect is computed, where there are several.
    """

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
        self._forms: dict[str, Form] = {}
        for name, declared in _declared(field).items():
            self._add(rows, name, declared)

    def _add(self, rows: QVBoxLayout, name: str, declared: StageDeclaration) -> None:
        box = self.boxes[name] = QCheckBox(f"{declared.title}  ({name})", self)
        box.clicked.connect(lambda on: self._switch(name, on))
        why = self._why[name] = label("", "dim")
        frame = self._frames[name] = QGroupBox(self)
        form = self._forms[name] = Form(parent=frame)
        QVBoxLayout(frame).addWidget(form)
        form.edited.connect(
            lambda where, value, typed: self._editor.put(*where, value=value, typed=typed)
        )
        at = self._field, name
        for key, one in declared.parameters.items():
            line = self.values[name, key] = form.text(
                *(*at, "parameters", key),
                title=f"{key} [{one.unit}]",
                hint=plain(one.default),
                read=number_of,
                write=plain,
            )
            line.setToolTip(literal(f"{one.meaning}; {one.minimum:g} … {one.maximum:g} {one.unit}"))
        if isinstance(declared, effects.Effect) and not declared.pictures:
            self.organs[name] = form.text(  # pictures act on no organ
                *at, "organ", title=tr("acts on"), hint=tr("everything"), read=_word, write=plain
            )
        if isinstance(declared, effects.Effect) and len(declared.models) > 1:
            among = [(key, f"{key}: {words}") for key, words in declared.models.items()]
            way = self.ways[name] = form.choice(*at, "model", title=tr("computed by"), among=among)
            fitting = QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
            way.setSizeAdjustPolicy(fitting)
        for widget in (box, why, frame):
            rows.addWidget(widget)

    def load(self) -> None:
        """Show which are on, why each is simulated or not, and what their parameters are."""
        parts = self._editor.get(self._field, default={})
        for name, box in self.boxes.items():
            with QSignalBlocker(box):
                box.setChecked(name in parts)
            shown = self._editor.why.get(name, "") if name in parts else ""
            self._why[name].setText(shown)
            self._why[name].setVisible(bool(shown))
            form = self._forms[name]
            form.show_values(self._editor.document)
            self._frames[name].setVisible(name in parts and bool(form.fields))

    def _switch(self, name: str, on: bool) -> None:
        self._editor.put(self._field, name, value={} if on else None)
        if not on and not self._editor.get(self._field):
            self._editor.put(self._field, value={})


def _word(text: str) -> str | None:
    return text.strip() or None


def _declared(field: str) -> dict[str, StageDeclaration]:
    if field == "effects":
        return {name: effects.declaration(name) for name in effects.effect_names()}
    return {name: LAWS.find(name) for name in LAWS.names()}
