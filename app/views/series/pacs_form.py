"""The fields of one PACS, with what each is for."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.text import tr

Values = dict[str, object]
_FILES = ("authority", "certificate", "key")
_DEFAULTS: Values = {
    "name": "", "host": "", "port": 104, "title": "", "own_title": "ACUS", "own_host": "",
    "own_port": 11112, "timeout_s": 30.0, "retrieve": "get",
}  # fmt: skip


class PacsForm(QWidget):
    """Edits the settings of one PACS as text; whether they can be used is judged elsewhere.

    Attributes:
        fields: lines of text by the names of the settings.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.fields = {
            name: QLineEdit(self) for name in ("name", "host", "title", "own_title", "own_host")
        }
        self.port, self.own_port = _port(self), _port(self)
        self.timeout, self.retrieve = QDoubleSpinBox(self), QComboBox(self)
        self.timeout.setRange(1.0, 600.0)
        self.timeout.setDecimals(0)
        self.timeout.setSuffix(" s")
        self.retrieve.addItem(tr("C-GET: over the same connection"), "get")
        self.retrieve.addItem(tr("C-MOVE: it connects to us"), "move")
        self.tls = QCheckBox(tr("Encrypted connection (TLS)"), self)
        self.files = {name: QLineEdit(self) for name in _FILES}
        self.check_name = QCheckBox(tr("Its certificate must name the host"), self)
        self._rows: list[QWidget] = []
        self._lay_out()
        self.tls.toggled.connect(self._enable)
        self.retrieve.currentIndexChanged.connect(lambda _: self._enable())

    def complete(self, given: Mapping[str, object]) -> Values:
        """Return settings with the defaults of what they leave out, as `values` gives them."""
        self.show_values(given)
        return self.values()

    def show_values(self, given: Mapping[str, object]) -> None:
        """Show settings; what they leave out gets its default."""
        values = _DEFAULTS | dict(given)
        for name, field in self.fields.items():
            field.setText(str(values[name]))
        self.port.setValue(int(str(values["port"])))
        self.own_port.setValue(int(str(values["own_port"])))
        self.timeout.setValue(float(str(values["timeout_s"])))
        self.retrieve.setCurrentIndex(self.retrieve.findData(values["retrieve"]))
        tls = values.get("tls")
        self.tls.setChecked(isinstance(tls, Mapping))
        tls = tls if isinstance(tls, Mapping) else {}
        for name, field in self.files.items():
            field.setText(str(tls.get(name, "")))
        self.check_name.setChecked(bool(tls.get("check_name", True)))
        self._enable()

    def values(self) -> Values:
        """Return the settings as they would stand in the file."""
        values: Values = {name: field.text().strip() for name, field in self.fields.items()}
        values |= {
            "port": self.port.value(), "own_port": self.own_port.value(),
            "timeout_s": self.timeout.value(), "retrieve": self.retrieve.currentData(),
        }  # fmt: skip
        if self.tls.isChecked():
            files = {name: field.text().strip() for name, field in self.files.items()}
            values["tls"] = {**files, "check_name": self.check_name.isChecked()}
        return values

    def _enable(self) -> None:
        moves = self.retrieve.currentData() == "move"
        self.fields["own_host"].setEnabled(moves)
        self.own_port.setEnabled(moves)
        for widget in self._rows:
            widget.setEnabled(self.tls.isChecked())

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setHorizontalSpacing(theme.MARGIN)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        fields = self.fields
        for title, widget, hint in (
            (tr("Name"), fields["name"], tr("what it is called here; no blanks")),
            (tr("Host"), fields["host"], tr("name or address of the archive")),
            (tr("Port"), self.port, ""),
            (tr("AE title"), fields["title"], tr("the archive's, at most 16 characters")),
            (tr("Own AE title"), fields["own_title"], tr("tell the archive's administrator")),
            (tr("Retrieve by"), self.retrieve, ""),
            (tr("Own address"), fields["own_host"], tr("empty: the one that leads to the archive")),
            (tr("Own port"), self.own_port, ""),
            (tr("Longest silence"), self.timeout, ""),
        ):  # fmt: skip
            if isinstance(widget, QLineEdit):
                widget.setPlaceholderText(hint)
                widget.setToolTip(hint)
            form.addRow(title, widget)
        form.addRow(self.tls)
        for title, name, hint in (
            (tr("Authority"), "authority", tr("PEM; empty: those that the system trusts")),
            (tr("Own certificate"), "certificate", tr("PEM; where the archive asks for one")),
            (tr("Own key"), "key", tr("PEM without a password")),
        ):
            self.files[name].setPlaceholderText(hint)
            self._rows.append(self._file(self.files[name]))
            form.addRow(title, self._rows[-1])
        form.addRow("", self.check_name)
        self._rows.append(self.check_name)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(form)
        note = QLabel(
            tr("Own address and port are where C-MOVE's pictures come; the port is open only "
               "while a retrieval lasts."), self,
        )  # fmt: skip
        note.setProperty("role", "dim")
        note.setWordWrap(True)
        column.addWidget(note)
        column.addStretch()

    def _file(self, field: QLineEdit) -> QWidget:
        holder = QWidget(self)
        row = QHBoxLayout(holder)
        row.setContentsMargins(0, 0, 0, 0)
        button = QPushButton(tr("Choose…"), holder)
        button.setAutoDefault(False)
        button.clicked.connect(lambda: self._choose(field))
        row.addWidget(field, 1)
        row.addWidget(button)
        return holder

    def _choose(self, field: QLineEdit) -> None:
        kinds = f"{tr('Certificates')} (*.pem *.crt *.cer *.key);;{tr('All')} (*)"
        name, _ = QFileDialog.getOpenFileName(self, tr("Choose a file"), field.text(), kinds)
        if name:
            field.setText(name)


def _port(parent: QWidget) -> QSpinBox:
    box = QSpinBox(parent)
    box.setRange(1, 65535)
    return box
