"""Dialogs that would wait for a person for ever: a test that opens one unasked fails at once."""

import pytest
from PySide6.QtWidgets import QColorDialog, QDialog, QFileDialog, QInputDialog, QMessageBox

_ASKING = {
    QMessageBox: ("about", "critical", "exec", "information", "question", "warning"),
    QFileDialog: ("getExistingDirectory", "getOpenFileName", "getOpenFileNames", "getSaveFileName"),
    QInputDialog: ("getDouble", "getInt", "getItem", "getMultiLineText", "getText"),
    QColorDialog: ("getColor",),
    QDialog: ("exec",),
}


def forbid(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let each of them fail; a test that answers one puts its own in the place."""
    for kind, names in _ASKING.items():
        for name in names:
            monkeypatch.setattr(kind, name, _refusal(f"{kind.__name__}.{name}"))


def _refusal(name):
    def refuse(*arguments, **options):
        pytest.fail(f"{name}() opened with nobody to answer: {arguments[1:3]}")

    return staticmethod(refuse)
