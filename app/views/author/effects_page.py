"""FormPage of the form of an exercise: effects with what they cost, and the layers of tissue."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.exercises.parts import LayerPart
from app.views.author.editing import ExerciseEditor
from app.views.author.page import FormPage, number_of
from app.views.author.parts_box import PartsBox
from app.views.kit import theme
from app.views.kit.parts import button, label
from app.views.kit.text import tr


class EffectsPage(FormPage):
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
        self.add(("layers",), name, self.layers, lambda _: self.layers.load())
        self.choice(
            "layers_from",
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
        self.rows.addStretch(1)

    def load(self) -> None:
        """Show what the document says, and why each effect is simulated or not."""
        super().load()
        self.parts.load()

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
            value = number_of(text) if text else text
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
