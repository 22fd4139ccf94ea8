"""The form of the window: a row for each field of a model, by its title, type, range and unit.

A field says itself what it is called and what helps to fill it in (`core.configuration.FieldText`),
and within what it must lie (pydantic's own limits); who adds a row may say it otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import Any, TypeVar

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLayout,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from app.core.configuration import FieldProblem, FieldText
from app.core.documents import Document, Range, Where, field_of, limits, put_value, value_at
from app.views.kit import theme
from app.views.kit.field_words import place_words, problem_words
from app.views.kit.parts import PlainLabel, column, label
from app.views.kit.text import declared, literal

Choice = Sequence[tuple[Any, str]]
"""Values with their titles."""

Spin = TypeVar("Spin", QSpinBox, QDoubleSpinBox)

UNITS = {"mm": "mm", "s": "s"}
"""Ends of names that say a unit."""


class Form(QWidget):
    """Rows of values, their names beside them, or above them on a page.

    Signals:
        edited(tuple, object, bool): a field, its value now, and whether letter by letter.

    Args:
        model: whose fields are edited; None where every row says its own limits.
        parent: dialog or page.
        title: of the form, for messages; a page shows it.
        page: whether it is a page: names above, and below each field what is wrong with it.
        spacing: between rows that are not a page's [px]; the usual one without.

    Attributes:
        fields, names: editors and labels of the rows.
        rows: the column that holds them, for what is not a row.
    """

    edited = Signal(object, object, bool)
    follows_typing = True
    """Whether a number is told while it is typed; else when it is left."""

    def __init__(
        self,
        model: type[BaseModel] | None = None,
        parent: QWidget | None = None,
        title: str = "",
        page: bool = False,
        spacing: int = -1,
    ) -> None:
        super().__init__(parent)
        self._model, self.title = model, title
        self.fields: dict[Where, QWidget] = {}
        self.names: dict[Where, QLabel] = {}
        self._bound: dict[Where, tuple[Callable[[Any], object], Callable[[], Any]]] = {}
        self._notes: list[tuple[Where, QLabel]] = []
        self._together: QHBoxLayout | None = None
        self._beside = None if page else QFormLayout()
        self.rows = column(self, title) if page else QVBoxLayout(self)
        if self._beside is not None:
            self._beside.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
            self._beside.setVerticalSpacing(spacing)
            self.rows.setContentsMargins(0, 0, 0, 0)
            self.rows.addLayout(self._beside)

    # --- values ---------------------------------------------------------------------------------
    def show_values(self, document: Mapping[str, Any]) -> None:
        """Show what a document says; where it says nothing of a field, its default."""
        with QSignalBlocker(self):
            for where, (show, _) in self._bound.items():
                show(value_at(document, *where))

    def values(self) -> Document:
        """Return what stands in the rows as a document, unchecked."""
        document: Document = {}
        for where, (_, value) in self._bound.items():
            put_value(document, where, value())
        return document

    def tell(self, problems: Sequence[FieldProblem]) -> None:
        """Say below each field that has a line for it what is wrong with it."""
        for where, note in self._notes:
            found = [one for one in problems if one.field[: len(where)] == where]
            note.setText("\n".join(self._sentence(one, where) for one in found))
            note.setVisible(bool(found))

    def _sentence(self, problem: FieldProblem, where: Where) -> str:
        """Say what is wrong, and where within the field if it is a part of it."""
        inner = self.inner_words(problem.field[len(where) :])
        return "✖ " + ": ".join(filter(None, (inner, problem_words(problem))))

    def inner_words(self, parts: Sequence[str | int]) -> str:
        """Say where within a field something stands."""
        return place_words(parts)

    def name_of(self, problem: FieldProblem) -> str:
        """Name the field of a problem as its row does."""
        for length in range(len(problem.field), 0, -1):
            name = self.names.get(tuple(map(str, problem.field[:length])))
            if name is not None:
                inner = self.inner_words(problem.field[length:])
                return ", ".join(filter(None, (name.text(), inner)))
        return ", ".join(filter(None, (self.title, self.inner_words(problem.field[1:]))))

    # --- rows -----------------------------------------------------------------------------------
    def row(self, title: str, field: QWidget | QLayout) -> QLabel:
        """Add a row that no value is bound to; its title, which may have a `&`, leads to it."""
        name = PlainLabel(title, self)
        parts = [field] if isinstance(field, QWidget) else _parts(field)
        for part in parts:  # a screen reader calls each of several by the row's name
            if not part.accessibleName():
                part.setAccessibleName(title.replace("&", ""))
        name.setBuddy(parts[0])
        if self._beside is not None:
            self._beside.addRow(name, field)
        else:
            self.rows.addWidget(name)
            self.wide(field)
        return name

    def wide(self, field: QWidget | QLayout) -> None:
        """Add a row without a name."""
        if self._beside is not None:
            self._beside.addRow(field)
        elif isinstance(field, QWidget):
            self.rows.addWidget(field)
        else:
            self.rows.addLayout(field)

    @contextmanager
    def together(self, *where: str, title: str = "") -> Iterator[QHBoxLayout]:
        """Put the rows that follow side by side into one, beside what else is put there.

        Args:
            where: the field whose title the row has, where it is given none.
            title: of the row.
        """
        before, self._together = set(self.fields), QHBoxLayout()
        yield self._together
        line, self._together = self._together, None
        name = self.row(title or declared(self._shown(where).title), line)
        self.names |= dict.fromkeys(set(self.fields) - before, name)

    def add(
        self,
        where: Where,
        title: str,
        field: QWidget,
        show: Callable[[Any], object],
        value: Callable[[], Any] = lambda: None,
    ) -> None:
        """Add the row of a field.

        Args:
            where: the field.
            title: of the row; the model's own where it is empty, none if that has none.
            field: its editor.
            show: shows a value, None for none.
            value: reads it.
        """
        title = title or declared(self._shown(where).title)
        if self._together is not None:
            field.setAccessibleName(title.replace("&", ""))
            self._together.addWidget(field)
        elif title:
            self.names[where] = self.row(title, field)
        else:
            self.wide(field)
        self.bind(where, field, show, value)

    def bind(
        self,
        where: Where,
        field: QWidget,
        show: Callable[[Any], object],
        value: Callable[[], Any],
    ) -> None:
        """Let an editor that is in the form show and say a field."""
        self.fields[where], self._bound[where] = field, (show, value)
        words = self._shown(where).help
        if words and not field.toolTip():
            field.setToolTip(literal(declared(words)))
        if self._beside is None:
            self.note(where)

    def note(self, where: Where) -> None:
        """Add a line that says what is wrong with a field."""
        note = label()
        note.setStyleSheet(f"color: {theme.BAD};")
        note.hide()
        self.rows.addWidget(note)
        self._notes.append((where, note))

    def show_row(self, on: bool, *where: str) -> None:
        """Show or hide a field with its name."""
        self.fields[where].setVisible(on)
        self.names[where].setVisible(on)

    def _field(self, where: Where) -> FieldInfo | None:
        with suppress(KeyError):
            return None if self._model is None else field_of(self._model, *where)
        return None

    def _shown(self, where: Where) -> FieldText:
        found = getattr(self._field(where), "metadata", ())
        return next((one for one in found if isinstance(one, FieldText)), FieldText())

    # --- kinds of fields ------------------------------------------------------------------------
    def text(
        self,
        *where: str,
        title: str = "",
        hint: str = "",
        secret: bool = False,
        read: Callable[[str], Any] = str,
        write: Callable[[Any], str] = str,
    ) -> QLineEdit:
        """Add a line of text; what `read` finds to be the same is not written anew."""
        line, field = QLineEdit(self), self._field(where)
        line.setPlaceholderText(hint or declared(self._shown(where).help))
        if secret:
            line.setEchoMode(QLineEdit.EchoMode.Password)
        default = read("") if field is None or field.is_required() else field.default

        def show(value: Any) -> None:
            value = default if value is None else value
            if read(line.text()) != value:
                line.setText(write(value))

        show(None)
        line.textEdited.connect(lambda text: self.edited.emit(where, read(text), True))
        self.add(where, title, line, show, lambda: read(line.text()))
        return line

    def lines(self, *where: str, title: str = "") -> QPlainTextEdit:
        """Add a text of several lines."""
        box = QPlainTextEdit(self)
        box.setTabChangesFocus(True)
        box.setFixedHeight(6 * theme.FONT_PX)

        def value() -> str | None:
            return box.toPlainText() or None

        def show(text: Any) -> None:
            if value() != (text or None):
                box.setPlainText(text or "")

        box.textChanged.connect(lambda: self.edited.emit(where, value(), True))
        self.add(where, title, box, show, value)
        return box

    def number(
        self,
        *where: str,
        title: str = "",
        unit: str = "",
        within: Range | None = None,
        decimals: int = 2,
        lowest: str | None = None,
    ) -> QDoubleSpinBox:
        """Add a number; `lowest` is what its smallest value says, which stands for none then."""
        box = QDoubleSpinBox(self)
        box.setDecimals(decimals)
        low, high, _ = within = within or limits(self._model or BaseModel, *where)
        box.setSingleStep(0.1 if high - low <= 4.0 else 1.0)
        unit = unit or self._shown(where).unit or UNITS.get(where[-1].rpartition("_")[2], "")
        box.setSuffix(f" {unit}" if unit.strip("°") else unit)
        return self._spin(box, where, title, within, lowest)

    def count(
        self,
        *where: str,
        title: str = "",
        within: Range | None = None,
        lowest: str | None = None,
    ) -> QSpinBox:
        """Add a whole number; the rest as of `number`."""
        return self._spin(QSpinBox(self), where, title, within, lowest)

    def _spin(
        self, box: Spin, where: Where, title: str, within: Range | None, lowest: str | None
    ) -> Spin:
        low, high, default = within or limits(self._model or BaseModel, *where)
        kind = int if isinstance(box, QSpinBox) else int | float
        box.setRange(low, high)
        box.setSpecialValueText(lowest or "")
        box.setKeyboardTracking(self.follows_typing)

        def value() -> Any:
            found = box.value()
            return None if lowest is not None and found == low else found

        def show(given: Any) -> None:
            box.setValue(given if isinstance(given, kind) else low if default is None else default)

        show(None)
        box.valueChanged.connect(lambda _: self.edited.emit(where, value(), False))
        self.add(where, title, box, show, value)
        return box

    def choice(self, *where: str, title: str = "", among: Choice) -> QComboBox:
        """Add a choice; a value that is not among them joins them when it is shown."""
        box = QComboBox(self)
        for value, words in among:
            box.addItem(words, value)

        def show(value: Any) -> None:
            place = next((n for n in range(box.count()) if box.itemData(n) == value), -1)
            if place < 0 and value is not None:  # a file of one's own
                box.addItem(_choice_words(value), value)
                place = box.count() - 1
            box.setCurrentIndex(max(place, 0))

        box.currentIndexChanged.connect(lambda _: self.edited.emit(where, box.currentData(), False))
        self.add(where, title, box, show, box.currentData)
        return box

    def flags(self, *where: str, title: str = "", among: Choice) -> dict[Any, QCheckBox]:
        """Add a list of which any may hold; what cannot be chosen now keeps what was said of it."""
        frame = QWidget(self)
        inner = QVBoxLayout(frame)
        inner.setContentsMargins(0, 0, 0, 0)
        boxes = {value: QCheckBox(words, frame) for value, words in among}
        held: list[Any] = []

        def value() -> list[Any]:
            on = {
                one: box.isChecked() if box.isEnabled() else one in held
                for one, box in boxes.items()
            }
            return [one for one in boxes if on[one]]

        def show(given: Any) -> None:
            held[:] = given or ()
            for one, box in boxes.items():
                box.setChecked(one in held)

        for box in boxes.values():
            inner.addWidget(box)
            box.clicked.connect(lambda _: self.edited.emit(where, value(), False))
        self.add(where, title, frame, show, value)
        return boxes

    def check(self, *where: str, title: str = "", indented: bool = False) -> QCheckBox:
        """Add a yes or no; `indented` where it belongs to the row before."""
        box, field = (
            QCheckBox(title or declared(self._shown(where).title), self),
            self._field(where),
        )
        if indented and self._beside is not None:
            self._beside.addRow("", box)
        else:
            self.wide(box)

        def show(on: Any) -> None:
            box.setChecked(bool(on if on is not None or field is None else field.default))

        box.toggled.connect(lambda on: self.edited.emit(where, on, False))
        self.bind(where, box, show, box.isChecked)
        return box


def _parts(layout: QLayout) -> list[QWidget]:
    """Return what of a line has no text that names it."""
    items = (layout.itemAt(place) for place in range(layout.count()))
    parts = [item.widget() for item in items if item is not None]
    return [one for one in parts if one is not None and not isinstance(one, QLabel | QPushButton)]


def _choice_words(value: object) -> str:
    """Return a value for a list that does not have it: a window, or a file of one's own."""
    if isinstance(value, Mapping) and "width" in value:
        return f"W {value['width']:g}  L {value.get('level', 0.0):g}"
    return str(value)
