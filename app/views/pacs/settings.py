"""Where PACS are entered, changed, tried and removed; what `acus pacs add` writes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialogButtonBox,
    QDoubleSpinBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QMessageBox,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from app.core.configuration import parse
from app.core.errors import AcusError, ConfigurationError
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import PlainLabel, add_row
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import literal, tr, translated
from app.views.kit.verdict import Verdict

if TYPE_CHECKING:
    from app.imaging.pacs.settings import PacsSettings


Values = dict[str, object]
_FILES = ("authority", "certificate", "key")
_DEFAULTS: Values = {
    "name": "",
    "host": "",
    "port": 104,
    "title": "",
    "own_title": "ACUS",
    "own_host": "",
    "own_port": 11112,
    "senders": (),
    "timeout_s": 30.0,
    "retrieve": "get",
}


_TEXTS = ("name", "host", "title", "own_title", "own_host")
_WEB = ("url", "user", "password")


class PacsForm(QWidget):
    """Edits the settings of one PACS as text; whether they can be used is judged elsewhere.

    Attributes:
        fields: lines of text by the names of the settings.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.fields = {name: QLineEdit(self) for name in _TEXTS}
        self.senders = QLineEdit(self)
        self.port, self.own_port = _port(self), _port(self)
        self.timeout, self.retrieve = QDoubleSpinBox(self), QComboBox(self)
        self.timeout.setRange(1.0, 600.0)
        self.timeout.setDecimals(0)
        self.timeout.setSuffix(" s")
        self.retrieve.addItem(tr("C-GET: over the same connection"), "get")
        self.retrieve.addItem(tr("C-MOVE: it connects to us"), "move")
        self.retrieve.addItem(tr("DICOMweb: by https"), "web")
        self.web = {name: QLineEdit(self) for name in _WEB}
        self.web["password"].setEchoMode(QLineEdit.EchoMode.Password)
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
        senders = values["senders"]
        self.senders.setText(
            ", ".join(map(str, senders if isinstance(senders, list | tuple) else ()))
        )
        self.port.setValue(int(str(values["port"])))
        self.own_port.setValue(int(str(values["own_port"])))
        self.timeout.setValue(float(str(values["timeout_s"])))
        self.retrieve.setCurrentIndex(self.retrieve.findData(values["retrieve"]))
        web = values.get("web")
        for name, field in self.web.items():
            field.setText(str(web.get(name, "")) if isinstance(web, Mapping) else "")
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
            "port": self.port.value(),
            "own_port": self.own_port.value(),
            "senders": tuple(self.senders.text().replace(",", " ").split()),
            "timeout_s": self.timeout.value(),
            "retrieve": self.retrieve.currentData(),
        }
        by_web = values["retrieve"] == "web"
        if by_web:  # the address says them
            for name in ("host", "port", "title"):
                del values[name]
        if by_web or any(field.text().strip() for field in self.web.values()):
            values["web"] = {
                name: field.text() if name == "password" else field.text().strip()
                for name, field in self.web.items()
            }
        if self.tls.isChecked():
            files = {name: field.text().strip() for name, field in self.files.items()}
            values["tls"] = {**files, "check_name": self.check_name.isChecked()}
        return values

    def _enable(self) -> None:
        moves, by_web = (self.retrieve.currentData() == way for way in ("move", "web"))
        for field in (self.fields["host"], self.fields["title"], self.fields["own_title"]):
            field.setEnabled(not by_web)
        self.port.setEnabled(not by_web)
        for field in self.web.values():
            field.setEnabled(by_web)
        self.fields["own_host"].setEnabled(moves)
        self.senders.setEnabled(moves)
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
            (tr("Web address"), self.web["url"], tr("https://…/dicom-web, before /studies")),
            (tr("User"), self.web["user"], tr("name that the archive gave you; may stay empty")),
            (tr("Password"), self.web["password"], tr("kept in a file that only you can read")),
            (tr("Own address"), fields["own_host"], tr("empty: the one that leads to the archive")),
            (tr("Own port"), self.own_port, ""),
            (tr("Other senders"), self.senders, tr("empty: pictures come from the host alone")),
            (tr("Longest silence"), self.timeout, ""),
        ):
            if isinstance(widget, QLineEdit):
                widget.setPlaceholderText(hint)
                widget.setToolTip(literal(hint))
            add_row(form, title, widget)
        form.addRow(self.tls)
        for title, name, hint in (
            (tr("Authority"), "authority", tr("PEM; empty: those that the system trusts")),
            (tr("Own certificate"), "certificate", tr("PEM; where the archive asks for one")),
            (tr("Own key"), "key", tr("PEM without a password")),
        ):
            self.files[name].setPlaceholderText(hint)
            self._rows.append(self._file(self.files[name]))
            add_row(form, title, self._rows[-1])
        form.addRow("", self.check_name)
        self._rows.append(self.check_name)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(form)
        note = PlainLabel(
            tr(
                "Own address and port are where C-MOVE's pictures come; the port is open only "
                "while a retrieval lasts."
            ),
            self,
        )
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


class PacsSettingsDialog(SettingsDialog):
    """A list of PACS and a form for the chosen one; nothing is written before Save.

    Signals:
        kept(): the configuration was written.
    """

    kept = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        confirm = QDialogButtonBox.StandardButton.Save
        super().__init__(tr("PACS: configuration"), (860, 640), confirm, parent)
        self._task: BackgroundTask | None = None
        self._shown = -1
        self._forms: list[dict[str, object]] = []
        self._as_read: list[dict[str, object]] = []
        self.list, self.form, self.strip = QListWidget(self), PacsForm(self), ProgressStrip(self)
        self.add_button = QPushButton(tr("Add"), self)
        self.remove_button = QPushButton(tr("Remove"), self)
        self.test_button = QPushButton(tr("Test"), self)
        self._lay_out()
        self._connect()
        self._read()

    # --- commands -------------------------------------------------------------------------------
    def add(self) -> None:
        """Begin another PACS."""
        self._take_form()
        taken = {str(one.get("name")) for one in self._forms}
        names = (f"pacs{n}" if n > 1 else "pacs" for n in range(1, len(taken) + 2))
        self._forms.append({"name": next(n for n in names if n not in taken), "port": 104})
        self._show_list(len(self._forms) - 1)
        self.form.fields["name"].setFocus()

    def remove(self) -> None:
        """Take the chosen PACS off the list; Save makes it last."""
        row = self.list.currentRow()
        if row >= 0:
            del self._forms[row]
            self._show_list(min(row, len(self._forms) - 1))

    def test(self) -> None:
        """Ask the PACS of the form whether it is there, without keeping anything."""
        try:
            settings = _parsed(self.form.values())
        except AcusError as error:
            self.say(translated(error), Verdict.BAD)
            return
        self._stop()
        self.say(tr("Asking {name}…", name=settings.name))
        self.test_button.setEnabled(False)
        self._task = run_in_background(
            self,
            lambda progress: _echo(settings, progress),
            lambda seconds: self.say(
                tr("{name} answers in {time} ms", name=settings.name, time=f"{1e3 * seconds:.1f}"),
                Verdict.GOOD,
            ),
            lambda error: self.say(translated(error), Verdict.BAD),
            lambda: self.say(tr("Cancelled")),
            title=tr("Asking {name}", name=settings.name),
            indicator=self.strip,
        )
        self._task.finished.connect(self._enable)

    def check(self) -> None:
        """Do nothing where every PACS can be used; else show the one that cannot, and say why."""
        self._take_form()
        names = []
        for row, form in enumerate(self._forms):
            try:
                names.append(_parsed(form).name)
            except AcusError:
                self._show_list(row)
                raise
        twice = next((name for name in names if names.count(name) > 1), "")
        if twice:
            raise ConfigurationError(tr("The name {name} is given twice", name=twice))

    def keep(self) -> None:
        """Write the configuration."""
        from app.imaging.pacs.settings import keep

        try:
            keep(tuple(_parsed(form) for form in self._forms))
        except OSError as error:
            why = error.strerror or translated(error)
            raise ConfigurationError(tr("It cannot be written: {why}", why=why)) from error
        self._as_read = list(self._forms)
        self.kept.emit()

    def reject(self) -> None:
        """Close, after a question if something was changed."""
        self._take_form()
        if self._forms != self._as_read and not self._may_lose():
            return
        super().reject()

    # --- inside ---------------------------------------------------------------------------------
    def _may_lose(self) -> bool:
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self,
            tr("PACS: configuration"),
            tr("The changes are not saved. Save them first?"),
            buttons.Save | buttons.Discard | buttons.Cancel,
            buttons.Save,
        )
        if answer == buttons.Save:
            self.save()
            return False  # it is closed already, or says what is wrong
        return answer == buttons.Discard

    def _read(self) -> None:
        from app.imaging.pacs.settings import configured

        try:
            found = [one.model_dump(exclude_none=True) for one in configured()]
        except AcusError as error:
            found = []
            self.say(translated(error) + "\n" + tr("Save replaces the file."), Verdict.BAD)
        self._forms = [self.form.complete(one) for one in found]
        self._as_read = list(self._forms)
        self._show_list(0 if found else -1)

    def _take_form(self) -> None:
        row = self.list.currentRow()
        if 0 <= row < len(self._forms):
            self._forms[row] = self.form.values()

    def _show_list(self, row: int) -> None:
        with QSignalBlocker(self.list):
            self.list.clear()
            self.list.addItems([str(one.get("name", "")) for one in self._forms])
            self.list.setCurrentRow(row)
        self._shown = row
        self.form.show_values(self._forms[row] if row >= 0 else {})
        self._enable()

    def _choose(self, row: int) -> None:
        if 0 <= self._shown < len(self._forms) and row != self._shown:
            self._forms[self._shown] = self.form.values()
            self._show_list(row)

    def _renamed(self, name: str) -> None:
        item = self.list.currentItem()
        if item is not None:
            item.setText(name)

    def _enable(self) -> None:
        chosen = self.list.currentRow() >= 0
        self.form.setEnabled(chosen)
        self.remove_button.setEnabled(chosen)
        running = self._task is not None and self.strip.count > 0
        self.test_button.setEnabled(chosen and not running)

    def _stop(self) -> None:
        if self._task is not None and self.strip.count:
            self._task.cancel()
        self._task = None

    def _connect(self) -> None:
        self.list.currentRowChanged.connect(self._choose)
        self.form.fields["name"].textEdited.connect(self._renamed)
        for button, command in (
            (self.add_button, self.add),
            (self.remove_button, self.remove),
            (self.test_button, self.test),
        ):
            button.setAutoDefault(False)
            button.clicked.connect(lambda _=False, command=command: command())
        self.finished.connect(lambda _: self._stop())

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.addWidget(self.list, 1)
        pair = QHBoxLayout()
        pair.addWidget(self.add_button)
        pair.addWidget(self.remove_button)
        left.addLayout(pair)
        self.list.setFixedWidth(200)
        self.list.setAccessibleName(tr("Configured PACS"))
        both = QHBoxLayout()
        both.setSpacing(theme.MARGIN)
        both.addLayout(left)
        both.addWidget(self.form, 1)
        foot = QHBoxLayout()
        foot.addWidget(self.test_button)
        foot.addStretch()
        foot.addWidget(self.buttons)
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        column.addLayout(both, 1)
        column.addWidget(self.note)
        column.addWidget(self.strip)
        column.addLayout(foot)


def _parsed(form: dict[str, object]) -> PacsSettings:
    from app.imaging.pacs.settings import PacsSettings

    return parse(form, PacsSettings, str(form.get("name") or tr("without a name")))


def _echo(settings: PacsSettings, progress: Progress) -> float:
    with ONE_AT_A_TIME:
        from app.imaging.pacs.archive import archive_of
    return archive_of(settings).echo(progress)
