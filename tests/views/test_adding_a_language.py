"""The page's way to a language: the program's texts are found, translated, loaded and shown."""

import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

from PySide6.QtCore import QCoreApplication, QLocale, QTranslator

from app.views.kit.text import install_translation, tr

ROOT = Path(__file__).resolve().parents[2]
TOOLS = Path(sys.executable).parent


def run(*command):
    subprocess.run([str(part) for part in command], check=True, capture_output=True, timeout=120)


def test_a_language_is_added_as_the_page_says(application, tmp_path):
    source, compiled = tmp_path / "acus_de.ts", tmp_path / "acus_de.qm"
    texts = sorted((ROOT / "app").rglob("*.py"))
    run(TOOLS / "pyside6-lupdate", "-tr-function-alias", "tr+=sentence", *texts, "-ts", source)
    tree = ElementTree.parse(source)
    found = {message.findtext("source"): message for message in tree.iter("message")}
    assert len(found) > 3000
    for text, german in (
        ("no picture", "kein Bild"),
        ("A file of your own cannot be used: {why}", "Eine eigene Datei taugt nicht: {why}"),
    ):
        translation = found[text].find("translation")
        translation.text = german
        translation.attrib.clear()
    tree.write(source, encoding="utf-8", xml_declaration=True)
    run(TOOLS / "pyside6-lrelease", source, "-qm", compiled)
    assert install_translation(application, QLocale("de_DE"), tmp_path)
    try:
        assert tr("no picture") == "kein Bild"
        why = tr("A file of your own cannot be used: {why}", why="Zeile 3")
        assert why == "Eine eigene Datei taugt nicht: Zeile 3"
        assert tr("can be used") == "can be used"  # not translated: stays English
    finally:
        for translator in application.findChildren(QTranslator):
            QCoreApplication.removeTranslator(translator)
            translator.setParent(None)
    assert tr("no picture") == "no picture"
