"""What a board was found to be, as a PDF: all of it, what is broken first, whole or not at all."""

from datetime import datetime

import pytest

from app.device.conformance.suite import BROKEN, KEPT, UNSEEN, Conformance, Finding
from app.device.errors import DeviceError
from app.device.links.link import BoardInfo
from app.views.people.report_pages import ReportPages
from app.views.robot.conformance_page import write_conformance

BOARD = BoardInfo("icube", "A-17", "1.2", "acus 2", 3, emulated=True)
WHEN = datetime(2026, 11, 30, 9, 5)


def conformance(count=24):
    outcomes = (KEPT, UNSEEN, BROKEN)
    findings = tuple(
        Finding(
            f"check-{k}",
            "every command is answered once, in order, within a tick",
            outcomes[k % 3],
            f"of 2000 commands {k} were answered late; those that were not are seen {k} times" * 2,
        )
        for k in range(count)
    )
    return Conformance("/dev/ttyACM0", "icube", BOARD, findings)


@pytest.fixture
def written(monkeypatch):
    """Words in the order in which they were written, of the last drawing."""
    lines, text, paragraph = [], ReportPages.text, ReportPages.paragraph

    def take_text(sheet, x, words, *rest, **named):
        lines.append(words)
        assert x + sheet.advance(words, named.get("size", rest[0] if rest else 9.5)) < sheet.width
        text(sheet, x, words, *rest, **named)

    def take_paragraph(sheet, words, *rest, **named):
        lines.append(words)
        paragraph(sheet, words, *rest, **named)
        assert sheet.y <= sheet.bottom + 4.0

    monkeypatch.setattr(ReportPages, "text", take_text)
    monkeypatch.setattr(ReportPages, "paragraph", take_paragraph)
    return lines


def test_all_findings_are_there_and_the_broken_rules_come_first(application, tmp_path, written):
    result, file = conformance(), tmp_path / "board.pdf"
    write_conformance(file, result, WHEN)
    assert file.read_bytes().startswith(b"%PDF")
    assert any(line.startswith("page 1 of ") and line != "page 1 of 1" for line in written)
    for fact in ("A-17", "1.2, acus 2", "2026-11-30 09:05", result.verdict):
        assert fact in written
    last = written[len(written) // 2 :]  # it is drawn twice, for the count of pages
    places = {k: last.index(f"check-{k}") for k in range(24)}
    broken = [place for k, place in places.items() if k % 3 == 2]
    assert max(broken) < min(place for k, place in places.items() if k % 3 != 2)
    assert all(finding.seen in last for finding in result.findings)


def test_a_file_that_cannot_be_written_is_named(application, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(DeviceError, match="cannot write"):
        write_conformance(tmp_path / "file" / "board.pdf", conformance(1), WHEN)
