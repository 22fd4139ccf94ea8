"""Errors of the lower rooms are shown in the user's language, with their values."""

import ast
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtCore import QCoreApplication, QTranslator

from app.core.errors import AcusError
from app.core.messages import joined, sentence
from app.device.links import port
from app.imaging.reading import load_ct
from app.tracking.calibration.boards import parse_board
from app.views.kit.text import tr, translated
from app.views.shell.message_bar import MessageBar
from tools.words import templates

ROOT = Path(__file__).resolve().parents[2]
LUPDATE = Path(sys.executable).parent / "pyside6-lupdate"

GERMAN = {
    "board {spec!r} is not {forms}": "{forms} wird verlangt, nicht {spec!r}",
    "{path} is not a serial port; see `acus device list`": "{path} ist kein serieller Anschluss",
    "{settings_name}: {reason}": "In {settings_name}: {reason}",
    "{listing_path} is empty; name a folder with DICOM files": "Keine Dateien in {listing_path}",
    "line {line}": "Zeile {line}",
    "{n} mm": "{nonsense} mm",
}


class German(QTranslator):
    def translate(self, context, source, disambiguation=None, n=-1):
        return GERMAN.get(source)

    def isEmpty(self):
        return False


@pytest.fixture
def german(application):
    translator = German(application)
    QCoreApplication.installTranslator(translator)
    yield
    QCoreApplication.removeTranslator(translator)
    translator.deleteLater()


def raised(operation):
    with pytest.raises(AcusError) as error:
        operation()
    return error.value


def test_errors_of_three_rooms_are_shown_in_german_with_their_values(german, application, tmp_path):
    bar = MessageBar()
    board = raised(lambda: parse_board("a:b"))
    bar.show_error(board)
    assert bar.text.endswith("wird verlangt, nicht 'a:b'")
    assert str(board).startswith("board 'a:b' is not checkerboard:")

    wrong = port.reason("/dev/null", 115200, OSError(25, "Inappropriate ioctl"))
    bar.show_error(
        AcusError(sentence("{settings_name}: {reason}", settings_name="a", reason=wrong))
    )
    assert bar.text == "In a: /dev/null ist kein serieller Anschluss"

    empty = raised(lambda: load_ct(tmp_path))
    bar.show_error(empty)
    assert bar.text == f"Keine Dateien in {tmp_path}"
    assert str(empty) == f"{tmp_path} is empty; name a folder with DICOM files"
    bar.deleteLater()


def test_what_is_told_within_a_text_of_the_window_is_translated_as_well(german):
    error = AcusError(joined("; ", [sentence("line {line}", line=3), "fertig"]))
    assert tr("Out of reach: {reasons}.", reasons=error) == "Out of reach: Zeile 3; fertig."
    assert tr("{a} {b}", a="x", b=sentence("line {line}", line=1.5)) == "x Zeile 1.5"


def test_what_no_translation_fits_is_english(german, tmp_path):
    assert translated(sentence("{n} mm", n=3)) == "3 mm"
    assert translated("{plain}") == "{plain}"
    missing = raised(lambda: load_ct(tmp_path / "none"))
    assert translated(missing) == str(missing)
    assert translated(OSError(2, "No such file")) == "[Errno 2] No such file"


def test_lupdate_finds_every_template_below_the_window(tmp_path):
    if not LUPDATE.exists():
        pytest.skip("pyside6-lupdate is not installed")
    source = tmp_path / "acus_de.ts"
    files = sorted((ROOT / "app").rglob("*.py"))
    command = [LUPDATE, "-tr-function-alias", "tr+=sentence", *files, "-ts", source]
    subprocess.run([str(part) for part in command], check=True, capture_output=True, timeout=120)
    (context,) = ElementTree.parse(source).iter("context")
    assert context.findtext("name") == ""  # the context of `tr`
    there = {message.findtext("source") for message in context.iter("message")}
    wanted = set(templates())
    assert len(wanted) > 1500
    assert wanted - there == set()


def test_a_template_is_found_by_its_literal_only():
    from tools.words import templates_in

    with pytest.raises(ValueError, match="no literal"):
        list(templates_in(ast.parse("sentence(f'{x} is wrong')")))
