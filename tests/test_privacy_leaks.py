"""Forty invented identifiers in a CT's header: none of them reaches anything that Acus writes.

The series is imported, opened, planned, practised on, scored and exported by the real commands,
and opened and imported in the real window; then every file they left, every line they printed and
the window's log are searched. Its folder and files are named like the patient. In a whole attempt
in the window it is searched by `test_other_systems`.
"""

import json
import shutil
from pathlib import Path

import pydicom
import pytest
from marked_ct import FOLDER, TEXTS, Acus, leaks, marked, needles, readable


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return marked(tmp_path_factory.mktemp("outside"))


@pytest.fixture(scope="module")
def words(source: Path) -> set[str]:
    return needles(pydicom.dcmread(next(source.iterdir())))


def spoilt(source: Path, target: Path) -> Path:
    """Folders that cannot be opened: files cut off, and one that is no DICOM at all."""
    (target / "Zqmustermann_cut").mkdir(parents=True)
    for path in sorted(source.iterdir())[:5]:
        (target / "Zqmustermann_cut" / path.name).write_bytes(path.read_bytes()[:-1000])
    (target / "Zqmustermann_none").mkdir()
    (target / "Zqmustermann_none" / "Zqmustermann.dcm").write_bytes(b"Zqmustermann" * 1000)
    return target


@pytest.mark.long("journey")
@pytest.mark.promise("docs/sessions.md: A record holds pseudonyms, never a patient's data")
@pytest.mark.timeout(900)
def test_no_identifier_of_a_ct_reaches_anything_that_is_written(tmp_path, capfd, source, words):
    assert len(TEXTS) == 40
    assert len(leaks(next(source.iterdir()).read_bytes(), words)) > 40  # they can be found
    acus = Acus(tmp_path / "inside", capfd)
    # Of the source itself UIDs are told, to name a series by; nothing else.
    listing = acus("ct", "list", source, "--json", says=False)
    assert not leaks(
        listing.replace(str(source), "").encode(), {w for w in words if "2.25" not in w}
    )
    imported = json.loads(acus.apart("app", "ct", "import", source, "--json"))["facts"]
    acus("ct", "import", source)
    acus("library", "list", "--json")
    acus("ct", "list", imported["folder"], "--json")
    acus("ct", "point", imported["folder"], "--voxel", "3,4,5", "--json")
    out = tmp_path / "inside" / "out"
    # On the original where it lies, which says more than the copy would.
    assert "score" in acus.apart("tests.virtual_attempt", source, out)
    sessions = ("--folder", out / "sessions")
    (attempt,) = json.loads(acus("session", "list", *sessions, "--json"))["facts"]["sessions"]
    acus("session", "show", attempt["id"], *sessions, "--json")
    path = out / f"{attempt['id']}.csv"
    acus("session", "export", attempt["id"], *sessions, "--trajectory", "--out", path)
    acus("transform", "export", out / "plan.mrk.json", "--out", out / "placed.tfm")
    written = [path for path in (tmp_path / "inside").rglob("*") if path.is_file()]
    kinds = {path.suffix for path in written}
    assert kinds >= {".dcm", ".json", ".mcap", ".csv", ".pdf", ".tfm"}, kinds
    for path in written:
        assert leaks(str(path).encode() + readable(path), words) == [], path
    assert leaks(acus.said.encode(), words) == []


@pytest.mark.long("journey")
@pytest.mark.timeout(900)
def test_no_identifier_reaches_the_log_of_the_window_or_what_it_writes(
    tmp_path, capfd, source, words
):
    acus = Acus(tmp_path / "inside", capfd)
    broken = spoilt(source, tmp_path / "outside" / "broken")
    out = tmp_path / "inside" / "out"
    assert int(acus.apart("tests.window_ways_in", source, broken, out).split()[0]) >= 4
    written = [path for path in (tmp_path / "inside").rglob("*") if path.is_file()]
    assert {path.suffix for path in written} >= {".dcm", ".log"}
    assert b"the log is open" in (out / "window.log").read_bytes()
    for path in written:
        if path.name != "window.ini":  # recent folders that the user opened: docs/privacy.md
            assert leaks(str(path).encode() + readable(path), words) == [], path
    assert leaks(acus.said.encode(), words) == []


@pytest.mark.long("journey")
@pytest.mark.promise("docs/reading.md: Messages never quote a header")
def test_errors_of_an_import_quote_neither_values_nor_paths(tmp_path, capfd, source, words):
    annotated = shutil.copytree(source, tmp_path / "outside" / FOLDER)
    acus = Acus(tmp_path / "inside", capfd)
    for path in annotated.iterdir():
        dataset = pydicom.dcmread(path)
        dataset.BurnedInAnnotation = "YES"
        dataset.save_as(path)
    acus("ct", "import", annotated, code=2)
    assert "BurnedInAnnotation" in acus.said
    assert leaks(acus.said.encode(), words) == []
