"""The library compares images, not names: a part never hides the whole; what opens on request."""

import json
import shutil

import pytest
from dicom_factory import SERIES, Slices
from pacs_rig import FakePacs
from typer.testing import CliRunner

from app.commands import build
from app.core.progress import Progress
from app.imaging.errors import SeriesRefusedError
from app.imaging.library import CtLibrary, ImportFailedError
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.incoming import Incoming
from app.imaging.pacs.taking import RemedyWantedError, take
from app.imaging.privacy.burned_in import MaskBox
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder

UNEVEN = Slices(offsets=(0.0, 2.0, 4.0, 7.0, 9.0, 11.0))


@pytest.fixture
def whole(tmp_path):
    Slices().write(tmp_path / "whole")
    return tmp_path / "whole"


def part(whole, name, numbers):
    """Folder with some of the pictures of a series."""
    folder = whole.parent / name
    folder.mkdir()
    files = [one.path for one in scan_folder(whole).series[0].slices]
    for number in numbers:
        shutil.copy(files[number], folder)
    return folder


def taken(folder, **how):
    return CtLibrary().import_series(scan_folder(folder).series[0], **how)


def test_the_full_series_replaces_a_part_of_it_and_says_so(whole):
    first = taken(part(whole, "part", (0, 1, 2)))
    assert (first.again, first.before, first.entry.files) == (False, 0, 3)
    second = taken(whole)
    assert not second.again
    assert (second.before, second.given, second.entry.files) == (3, 5, 5)
    assert "in place of 3 of its 5 images" in second.words
    assert second.entry.name == first.entry.name
    assert load_ct(second.entry.folder).size[2] == 5
    assert len(CtLibrary().entries()) == 1


def test_a_part_changes_nothing_where_the_whole_lies_and_the_same_is_kept(whole):
    full = taken(whole)
    again = taken(whole)
    assert again.again
    assert again.words == "was in the library already, image for image"
    less = taken(part(whole, "part", (1, 2, 3)))
    assert less.again
    assert "all 5 images of this series are in the library already; the 3 given" in less.words
    assert less.entry == full.entry
    assert less.entry.files == 5


def test_other_images_of_a_series_are_refused_with_what_lies_there(whole):
    kept = taken(part(whole, "lower", (0, 1, 2)))
    upper = part(whole, "upper", (2, 3, 4))
    with pytest.raises(
        ImportFailedError, match=r"holds 3 images .* 3 given 1 are among them and 2"
    ):
        taken(upper)
    assert CtLibrary().entries() == (kept.entry,)
    CtLibrary().remove(kept.entry.name)
    assert taken(upper).entry.files == 3


def test_a_masked_part_does_not_replace_the_whole(whole):
    full = taken(whole)
    with pytest.raises(ImportFailedError, match="2 of those there are not given"):
        taken(part(whole, "part", (0, 1, 2)), boxes=[MaskBox(2, 3, 4, 5)])
    assert CtLibrary().entries() == (full.entry,)
    assert not taken(whole, boxes=[MaskBox(2, 3, 4, 5)]).again


def test_an_entry_that_does_not_list_its_images_is_looked_at(whole):
    first = taken(part(whole, "part", (0, 1, 2)))
    about = first.entry.folder / "about.json"
    document = json.loads(about.read_text())
    del document["images"], document["remedy"]
    about.write_text(json.dumps(document))
    second = taken(whole)
    assert (second.again, second.before, second.entry.files) == (False, 3, 5)


def test_a_series_that_opens_on_request_is_taken_in_on_request(tmp_path):
    UNEVEN.write(tmp_path / "in")
    with pytest.raises(SeriesRefusedError, match="--remedy resample"):
        taken(tmp_path / "in")
    with pytest.raises(SeriesRefusedError, match="--remedy resample"):
        taken(tmp_path / "in", remedy="halve")
    assert CtLibrary().entries() == ()
    command = ["ct", "import", str(tmp_path / "in"), "--remedy", "resample"]
    result = CliRunner().invoke(build(), command, catch_exceptions=False)
    assert result.exit_code == 0
    assert "it opens with --remedy resample" in result.stdout
    (entry,) = CtLibrary().entries()
    assert (entry.files, entry.remedy) == (6, "resample")
    before, after = scan_folder(tmp_path / "in").series[0], scan_folder(entry.folder).series[0]
    assert after.remedy == before.remedy
    assert [one.plane for one in after.slices] == [one.plane for one in before.slices]


@pytest.mark.long("journey")
def test_what_a_pacs_gave_is_kept_aside_when_it_opens_only_on_request(tmp_path):
    UNEVEN.write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        settings = pacs.settings()
        with pytest.raises(RemedyWantedError, match=r"--remedy resample.*kept aside for a day"):
            take(Pacs(settings), "2.25.1", SERIES, CtLibrary(), Progress())
        assert Incoming(settings, SERIES).folder.exists()
        assert CtLibrary().entries() == ()
        how = {"remedy": "resample"}
        found = take(Pacs(settings), "2.25.1", SERIES, CtLibrary(), Progress(), **how)
        assert found.entry.files == 6
        assert not Incoming(settings, SERIES).folder.exists()
