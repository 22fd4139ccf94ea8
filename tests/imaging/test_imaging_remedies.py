"""The table of remedies: a file each, the program's and others'."""

from pathlib import Path

import pytest
from dicom_factory import Slices

from app.core import plugin_trial
from app.imaging import remedies
from app.imaging.errors import ImagingError, SeriesRefusedError
from app.imaging.reading import choose, read_with
from app.imaging.scanning import scan_folder
from app.session.ct_facts import CtFacts

ROOT = Path(__file__).resolve().parents[2]
OWN = ("resample", "straighten", "halve")
HEAD = "DECLARATION = {'title': 'Open whole', 'help': 'Whole.', 'against': 'haste'}\n"
READS = "def read(series, recipe, progress):\n    from app.imaging import reading\n"
UNEVEN = Slices(offsets=(0.0, 2.0, 4.0, 7.0, 9.0, 11.0))


@pytest.fixture
def save(tmp_path, monkeypatch):
    folder = tmp_path / "remedies"
    folder.mkdir()
    monkeypatch.setenv("ACUS_REMEDIES", str(folder))
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "cache"))

    def saved(name, offers="return True", read="    return None\n", head=""):
        text = f"{HEAD}{head}\ndef offers(series):\n    {offers}\n\n{READS}{read}"
        (folder / f"{name}.py").write_text(text)
        return folder / f"{name}.py"

    return saved


def test_the_table_names_the_programs_own_in_the_order_of_their_rank():
    assert tuple(one.name for one in remedies.remedies()) == OWN
    assert remedies.words() == ("none", *OWN)
    assert [remedies.is_word(word) for word in ("none", "halve", "paint", 5)] == [
        True, True, False, False,
    ]  # fmt: skip


def test_the_page_on_reading_names_every_remedy_by_its_word_and_by_its_button():
    page = (ROOT / "docs" / "reading.md").read_text(encoding="utf-8")
    for one in remedies.remedies():
        assert f"`{one.name}`" in page
        assert f"*{one.title}*" in page


@pytest.mark.long("journey")
def test_one_that_fails_to_say_is_not_offered_and_the_series_has_a_note_of_it(save, tmp_path):
    path = save("eager", "return 1 / 0")
    UNEVEN.write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    assert series.remedies == ("resample",)
    assert (
        series.notes[-1] == f"{path}: offers() does not work: ZeroDivisionError: division by zero"
    )


def test_one_that_cannot_be_imported_is_tried_in_a_process_of_its_own_and_not_used(
    save, tmp_path, monkeypatch
):
    monkeypatch.setattr(plugin_trial, "MOST", 1)
    path = save("ends", head="import os\nos._exit(7)\n")
    UNEVEN.write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    assert series.remedies == ("resample",)
    assert f"{path} cannot be imported: it ends the program" in series.notes[-1]


def test_what_it_fails_with_while_it_reads_names_its_file(save, tmp_path):
    path = save("hasty", read="    raise KeyError('slices')\n")
    Slices().write(tmp_path / "ct")
    series = choose(scan_folder(tmp_path / "ct"))
    assert series.remedies == ("hasty",)
    with pytest.raises(ImagingError, match=r"read\(\) does not work: KeyError") as raised:
        read_with(series, "hasty")
    assert str(path) in str(raised.value)


def test_a_volume_of_somebody_s_remedy_says_by_which_it_was_read(save, tmp_path):
    save("whole", read="    return reading.read_series(series, progress)\n")
    Slices().write(tmp_path / "ct")
    volume = read_with(choose(scan_folder(tmp_path / "ct")), "whole")
    assert (volume.recipe.remedy, volume.made) == ("whole", ("Open whole",))
    facts = CtFacts.of_volume(volume)
    assert CtFacts.of_metadata(facts.metadata()) == facts


@pytest.mark.long("journey")
def test_one_that_is_not_offered_is_refused_for_a_series_that_cannot_be_read_as_it_is(
    save, tmp_path
):
    save("never", "return False")
    UNEVEN.write(tmp_path / "ct")
    (series,) = scan_folder(tmp_path / "ct").series
    with pytest.raises(
        SeriesRefusedError,
        match=r"the remedy 'never' does not help series .*it can be read if you ask to resample",
    ):
        read_with(series, "never")


@pytest.mark.parametrize("name", ["none", "halve", "KIND"])
def test_words_of_the_program_are_no_names(save, name):
    path = save(name)
    assert "rename the file" in remedies.refused()[path]
    assert tuple(one.name for one in remedies.remedies()) == OWN


def test_a_folder_that_joins_the_package_is_read_as_the_users_is(save, tmp_path, monkeypatch):
    path = save("whole")
    monkeypatch.delenv("ACUS_REMEDIES")
    monkeypatch.setattr(remedies, "__path__", [*remedies.__path__, str(path.parent)])
    assert remedies.words() == ("none", *OWN, "whole")


def test_an_unknown_one_is_refused_with_those_that_there_are(tmp_path):
    Slices().write(tmp_path)
    with pytest.raises(ImagingError, match="no CT remedy 'paint'; there are halve, resample"):
        read_with(choose(scan_folder(tmp_path)), "paint")
