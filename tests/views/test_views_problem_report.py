import logging

import pytest
from PySide6.QtWidgets import QApplication

from app import __version__
from app.core.log_file import LogFile
from app.views.kit.names import NAMES
from app.views.shell.help import ProblemReport


@pytest.mark.promise("docs/user-guide.md: names no patient, student, path or file")
def test_a_report_holds_versions_and_the_log_and_nobody_is_named(application, tmp_path):
    log = LogFile()
    log.open()
    NAMES.learn("Miller-Lüdenscheid")
    logging.getLogger("acus").warning("the CT of Miller-Lüdenscheid in /data/ml/x.dcm")
    log.close()
    report = ProblemReport()
    text = report.text.toPlainText()
    assert f"Acus {__version__}" in text
    assert "the CT of" in text
    assert "Miller" not in text
    assert "/data" not in text
    report.copy.click()
    assert QApplication.clipboard().text() == text
    report.save_as(str(tmp_path / "problem.txt"))
    assert (tmp_path / "problem.txt").read_text() == text
    report.save_as(str(tmp_path / "problem.txt" / "problem.txt"))
    assert report.said.text().startswith("✖ not saved")
    report.deleteLater()
