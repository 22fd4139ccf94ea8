"""What `acus device conform` has found, as a PDF to keep beside the board; vector text, A4."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Final

from PySide6.QtWidgets import QApplication

from app.core.files import write_atomically
from app.core.messages import sentence
from app.device.conformance.suite import BROKEN, KEPT, UNSEEN, Conformance
from app.device.errors import DeviceError
from app.views.debrief.report import DIM, INK
from app.views.kit.text import tr
from app.views.people.report_pages import ReportPages, draw_pdf

_MARKS: Final = {KEPT: "✔", BROKEN: "✖", UNSEEN: "–"}
_LEFT: Final = 92.0
"""Where the words of a rule begin [pt]."""


def write_conformance(path: Path, result: Conformance, when: datetime) -> None:
    """Write the report, whole or not at all; works without a display.

    Raises:
        DeviceError: if the file cannot be written.
    """
    # Text needs an application; a QApplication, for the process may open a window later.
    application = QApplication.instance() or QApplication(["acus", "-platform", "offscreen"])
    title = tr("Conformance of a board")
    try:
        write_atomically(path, draw_pdf(lambda sheet: _fill(sheet, title, result, when), title))
    except OSError as error:
        raise DeviceError(
            sentence("cannot write {path}: {reason}", path=path, reason=error.strerror or error)
        ) from error
    del application


def _fill(sheet: ReportPages, title: str, result: Conformance, when: datetime) -> None:
    board = result.board
    sheet.y += 12.0
    sheet.text(sheet.margin, title, 17.0, bold=True)
    sheet.y += 22.0
    for name, value in (
        (tr("Robot"), f"{board.profile or result.profile}, {board.kind}, {result.port}"),
        (tr("Serial number"), board.serial or "–"),
        (tr("Firmware"), f"{board.firmware}, {board.protocol}"),
        (tr("Asked"), f"{when:%Y-%m-%d %H:%M}"),
    ):
        sheet.text(sheet.margin, name, 9.5, DIM)
        sheet.text(sheet.margin + _LEFT, value, 9.5)
        sheet.y += 15.0
    sheet.y += 8.0
    sheet.paragraph(result.verdict, 11.0)
    sheet.y += 4.0
    # what is broken first: nobody looks for it among what is right
    for finding in sorted(result.findings, key=lambda one: one.outcome != BROKEN):
        sheet.need(44.0)
        sheet.text(sheet.margin, _MARKS[finding.outcome], 9.0, bold=True)
        sheet.text(sheet.margin + 14.0, finding.check, 9.0, bold=True)
        sheet.paragraph(finding.rule, 9.0, INK, left=_LEFT)
        sheet.paragraph(finding.seen, 8.5, DIM, left=_LEFT)
        sheet.y += 4.0
