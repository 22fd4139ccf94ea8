"""The spelling of translations: which words are looked at, and that a wrong one is noticed."""

import pytest

from tools import spelling


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("&Datei: {n:.1f} mm <b>tief</b>", ["Datei", "tief"]),
        ("siehe docs/pen.md, `acus run` und --keep", ["siehe", "und"]),
        ("l’aiguille d'Acus", ["l'aiguille", "d'Acus"]),
        ("{a:?{b} Nadeln|keine} CT-gesteuert", ["CT-gesteuert"]),
    ],
)
def test_words_are_looked_at_and_fields_markup_code_and_paths_are_not(text, words):
    assert list(spelling.words_of(text)) == words


@pytest.mark.parametrize(
    ("code", "right", "wrong"),
    [("de", "Nadelspitze", "Nadelspizte"), ("fr", "l'aiguille", "l'aigiulle")],
)
def test_a_wrong_word_is_noticed_and_a_right_one_is_not(code, right, wrong):
    try:
        assert spelling.unknown([right, wrong], code) == {wrong}
    except FileNotFoundError as error:
        pytest.skip(f"{error} is not installed")


def test_a_language_without_its_dictionary_is_skipped_with_the_reason(monkeypatch, capsys):
    monkeypatch.setattr(spelling.shutil, "which", lambda name: None)
    monkeypatch.setattr("sys.argv", ["spelling"])
    with pytest.raises(SystemExit) as ended:
        spelling.main()
    assert not ended.value.code
    assert "de: skipped, hunspell is not installed" in capsys.readouterr().out
