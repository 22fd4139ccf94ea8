"""The page's way to a language: its file is begun, translated, and chosen."""

import ast
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from app.core.messages import sentence
from app.views.kit.language import languages, use_language
from app.views.kit.text import declared, number, tr, translated
from tools import translations

ROOT = Path(__file__).resolve().parents[2]
TOOLS = Path(sys.executable).parent


@pytest.fixture
def spoken(application):
    """Put a language on; English again afterwards."""
    yield lambda code, within: use_language(application, code, within)
    assert use_language(application, "en") == "en"


def run(*command):
    subprocess.run([str(part) for part in command], check=True, capture_output=True, timeout=120)


def begun(folder, code, words):
    """Begin a language as the page says, with a few words."""
    source = folder / f"acus_{code}.ts"
    texts = sorted((ROOT / "app").rglob("*.py"))
    run(TOOLS / "pyside6-lupdate", "-tr-function-alias", "tr+=sentence", *texts, "-ts", source)
    tree = ElementTree.parse(source)
    messages = {message.findtext("source"): message for message in tree.iter("message")}
    assert len(messages) > 3000
    for text, translation in words.items():
        node = messages[text].find("translation")
        node.text = translation  # unreviewed, as it begins: shown all the same
    tree.write(source, encoding="utf-8", xml_declaration=True)
    return source


def test_a_language_is_added_as_the_page_says(spoken, tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    words = {
        "no picture": "kein Bild",
        "A file of your own cannot be used: {why}": "Eine eigene Datei taugt nicht: {why}",
        "0.5": "0,5",
    }
    begun(tmp_path, "de", words)
    assert languages(tmp_path) == {"en": "English", "de": "Deutsch"}
    assert spoken("de", tmp_path) == "de"
    assert tr("no picture") == "kein Bild"
    why = tr("A file of your own cannot be used: {why}", why="Zeile 3")
    assert why == "Eine eigene Datei taugt nicht: Zeile 3"
    inner = sentence("A file of your own cannot be used: {why}", why=0.5)
    assert translated(inner) == "Eine eigene Datei taugt nicht: 0,5"
    assert tr("can be used") == "can be used"  # not translated: stays English
    assert tr("{share:.1f} of {name}", share=2.5, name="a.b") == "2,5 of a.b"
    assert number(1.25, ".2f") == "1,25"
    assert declared("of nobody's") == "of nobody's"
    assert spoken("en", tmp_path) == "en"
    assert tr("no picture") == "no picture"
    assert tr("{share:.1f}", share=2.5) == "2.5"


def test_a_language_that_is_not_there_is_english(spoken, tmp_path):
    assert spoken("xx", tmp_path) == "en"
    assert tr("no picture") == "no picture"


def test_a_file_that_is_no_translation_leaves_the_window_english(spoken, tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    (tmp_path / "acus_de.ts").write_text("<TS")
    spoken("de", tmp_path)
    assert tr("no picture") == "no picture"
    assert not list((tmp_path / "cache").rglob("acus*.qm"))


def test_a_text_that_is_marked_within_another_is_not_missed():
    tree = ast.parse("f\"{tr('All')} (*)\"\ntr('seen without help')\nf\"{sentence('x {n}', n=1)}\"")
    assert list(translations._within_texts(tree)) == ["All", "x {n}"]


def test_a_text_within_an_f_string_is_collected_for_every_language(tmp_path, monkeypatch):
    (tmp_path / "app").mkdir()
    source = "from app.views.kit.text import tr\nLINE = f\"▲ {tr('within a text')}\"\n"
    (tmp_path / "app" / "words.py").write_text(source, encoding="utf-8")
    monkeypatch.setattr(translations, "ROOT", tmp_path)
    file = tmp_path / "acus_xx.ts"
    translations.update([file])
    assert "within a text" in translations.messages(file)
