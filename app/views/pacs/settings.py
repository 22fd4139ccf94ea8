"""Where PACS are entered, changed, tried and removed; what `acus pacs add` writes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialogButtonBox,
    QFileDialog,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QMessageBox,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.core.configuration import parse
from app.core.documents import Document, Where
from app.core.errors import AcusError, ConfigurationError
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.form import Form
from app.views.kit.parts import button, label
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict

if TYPE_CHECKING:
    from app.imaging.pacs.settings import PacsSettings


class PacsForm(Form):
    """Edits the settings of one PACS; whether they can be used is judged elsewhere."""

    def __init__(self, parent: QWidget | None = None) -> None:
        from app.imaging.pacs.settings import PacsSettings

        super().__init__(PacsSettings, parent)
        self._choosers: list[QPushButton] = []
        for name in ("name", "host"):
            self.text(name, read=str.strip)
        self.count("port", within=(1, 65535, 104))
        for name in ("title", "own_title"):
            self.text(name, read=str.strip)
        ways = (
            ("get", tr("C-GET: over the same connection")),
            ("move", tr("C-MOVE: it connects to us")),
            ("web", tr("DICOMweb: by https")),
        )
        self.retrieve = self.choice("retrieve", among=ways)
        for name in ("url", "user"):
            self.text("web", name, read=str.strip)
        self.text("web", "password", secret=True)
        self.text("own_host", read=str.strip)
        self.count("own_port")
        self.text("senders", read=_senders, write=", ".join)
        self.number("timeout_s", within=(1.0, 600.0, 30.0), decimals=0)
        self.tls = QCheckBox(tr("Encrypted connection (TLS)"), self)
        self.wide(self.tls)
        for name in ("authority", "certificate", "key"):
            self._file(name)
        self.check("tls", "check_name", indented=True)
        note = label(
            tr(
                "Own address and port are where C-MOVE's pictures come; the port is open only "
                "while a retrieval lasts."
            ),
            "dim",
        )
        self.rows.addWidget(note)
        self.rows.addStretch()
        self.tls.toggled.connect(self._enable)
        self.edited.connect(lambda *_: self._enable())

    def complete(self, given: Mapping[str, Any]) -> Document:
        """Return settings with the defaults of what they leave out, as `values` gives them."""
        self.show_values(given)
        return self.values()

    def show_values(self, document: Mapping[str, Any]) -> None:
        """Show settings; what they leave out gets its default."""
        super().show_values(document)
        self.tls.setChecked(isinstance(document.get("tls"), Mapping))
        self._enable()

    def values(self) -> Document:
        """Return the settings as they would stand in the file."""
        values = super().values()
        if values["retrieve"] == "web":  # the address says them
            for name in ("host", "port", "title"):
                del values[name]
        elif not any(text.strip() for text in values["web"].values()):
            del values["web"]
        if not self.tls.isChecked():
            del values["tls"]
        return values

    def _enable(self) -> None:
        moves, by_web = (self.retrieve.currentData() == way for way in ("move", "web"))
        may = dict.fromkeys(("host", "title", "own_title", "port"), not by_web)
        may |= dict.fromkeys(("own_host", "senders", "own_port"), moves)
        may |= {"web": by_web, "tls": self.tls.isChecked()}
        for where, field in self.fields.items():
            field.setEnabled(may.get(where[0], True))
        for chooser in self._choosers:
            chooser.setEnabled(may["tls"])

    def _file(self, name: str) -> None:
        with self.together("tls", name) as line:
            field = self.text("tls", name, read=str.strip)
            chooser = button(tr("Choose…"))
            chooser.clicked.connect(lambda: self._choose(field))
            line.addWidget(chooser)
        self._choosers.append(chooser)

    def _choose(self, field: QLineEdit) -> None:
        kinds = f"{tr('Certificates')} (*.pem *.crt *.cer *.key);;{tr('All')} (*)"
        name, _ = QFileDialog.getOpenFileName(self, tr("Choose a file"), field.text(), kinds)
        if name:
            field.setText(name)


def _senders(text: str) -> tuple[str, ...]:
    return tuple(text.replace(",", " ").split())


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
        self.form.fields["name",].setFocus()

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

    def _renamed(self, where: Where, name: Any) -> None:
        item = self.list.currentItem()
        if item is not None and where == ("name",):
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
        self.form.edited.connect(lambda where, value, _: self._renamed(where, value))
        for one, command in (
            (self.add_button, self.add),
            (self.remove_button, self.remove),
            (self.test_button, self.test),
        ):
            one.setAutoDefault(False)
            one.clicked.connect(lambda _=False, command=command: command())
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
