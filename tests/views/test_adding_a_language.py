"""The page's way to a language: its file is begun, translated, and chosen."""

import ast
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from extending_page import files, sections

from app.compose.plugins import plugin_files
from app.core import language as core_language
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


@pytest.mark.long("journey")
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


@pytest.fixture
def brought(tmp_path, monkeypatch):
    """Folder in which somebody saves files of languages, and the one of the page in it."""
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("ACUS_TRANSLATIONS", str(tmp_path / "translations"))
    monkeypatch.setenv("ACUS_PLUGINS", "")
    monkeypatch.setattr(core_language, "texts", core_language.texts.__wrapped__)
    for name, text in files(sections()["How to add a language"]).items():
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path / "translations"


def test_the_few_texts_of_the_page_are_a_language_of_the_window_and_of_the_command_line(
    spoken, brought
):
    assert languages()["it"] == "Italiano"
    assert spoken("it", None) == "it"
    assert tr("Start attempt") == "Inizia il tentativo"
    assert tr("{share:.1f}", share=2.5) == "2,5"
    assert tr("no picture") == "no picture"
    assert core_language.texts("it").text("Slope of the path") == "Pendenza del percorso"
    assert core_language.texts("it").number(0.5, ".1f") == "0,5"
    (listed,) = (one for one in plugin_files() if one.kind == "language")
    assert (listed.name, str(listed.title), listed.refused) == ("acus_it", "3 texts", "")


def test_a_file_of_others_adds_to_a_language_and_replaces_nothing(spoken, brought):
    shipped = core_language.texts("de").text("Start attempt")
    text = (brought / "acus_it.ts").read_text(encoding="utf-8")
    (brought / "acus_de.ts").write_text(text.replace("del percorso", "des Wegs"), encoding="utf-8")
    assert shipped not in ("Start attempt", "Inizia il tentativo")
    assert spoken("de", None) == "de"
    for answer in (tr, core_language.texts("de").text):
        assert answer("Start attempt") == shipped
        assert answer("Slope of the path") == "Pendenza des Wegs"


def test_a_file_that_is_no_xml_is_named_and_leaves_the_language_as_it_was(spoken, brought):
    (brought / "acus_de.ts").write_text("<TS")
    (bad,) = (one for one in plugin_files() if one.refused)
    assert bad.path == brought / "acus_de.ts"
    assert "acus_de.ts cannot be read: unclosed token: line 1" in bad.refused
    assert core_language.texts("de").text("Start attempt") != "Start attempt"
    assert spoken("de", None) == "de"
    assert tr("Start attempt") != "Start attempt"


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


@pytest.mark.long("journey")
def test_a_text_within_an_f_string_is_collected_for_every_language(tmp_path, monkeypatch):
    (tmp_path / "app").mkdir()
    source = "from app.views.kit.text import tr\nLINE = f\"▲ {tr('within a text')}\"\n"
    (tmp_path / "app" / "words.py").write_text(source, encoding="utf-8")
    monkeypatch.setattr(translations, "ROOT", tmp_path)
    file = tmp_path / "acus_xx.ts"
    translations.update([file])
    assert "within a text" in translations.messages(file)
