"""A PACS: asking, finding, retrieving; refusals, wrong data, silence and cuts in words."""

import logging
import re
import socket
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from dicom_factory import SERIES, Slices
from pacs_rig import FakePacs, free_port

from app.core.errors import ConfigurationError
from app.core.progress import Cancelled, Progress
from app.imaging import pacs
from app.imaging.errors import SeriesRefusedError
from app.imaging.library import CtLibrary
from app.imaging.pacs import statuses
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.errors import (
    PacsDataError,
    PacsError,
    PacsRefusedError,
    PacsUnreachableError,
)
from app.imaging.pacs.incoming import Incoming, sweep
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import PacsSettings, chosen, configured, keep
from app.imaging.pacs.taking import take
from app.imaging.reading import load_ct

STUDY = "2.25.1"


@pytest.fixture
def stored(tmp_path):
    Slices().write(tmp_path / "stored")
    return tmp_path / "stored"


def fetch(pacs, progress=None):
    return take(Pacs(pacs), STUDY, SERIES, CtLibrary(), progress or Progress())


def empty():
    folder = CtLibrary().folder
    return not folder.exists() or not list(folder.iterdir())


def incoming(settings):
    return Incoming(settings, SERIES)


def test_echo_tells_how_long_the_answer_took(stored):
    with FakePacs(stored) as pacs:
        assert 0.0 < Pacs(pacs.settings()).echo() < 60.0


def test_studies_and_series_are_found(stored):
    with FakePacs(stored) as pacs:
        client = Pacs(pacs.settings())
        (study,) = client.find_studies(Query(patient_id="SECRET*"))
        assert (study.uid, study.patient_id, study.instances) == (STUDY, "SECRET-ID", 5)
        (series,) = client.find_series(study)
        assert (series.uid, series.modality, series.number) == (SERIES, "CT", "3")
        assert pacs.asked[0].QueryRetrieveLevel == "STUDY"
        assert pacs.asked[0].PatientID == "SECRET*"


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_series_enters_the_library_de_identified(stored, way):
    with FakePacs(stored) as pacs:
        settings = pacs.settings(retrieve=way)
        imported = fetch(settings)
    before, after = load_ct(stored), load_ct(imported.entry.folder)
    np.testing.assert_array_equal(before.hu, after.hu)
    np.testing.assert_allclose(before.affine_mm, after.affine_mm)
    assert b"Secret" not in b"".join(p.read_bytes() for p in imported.entry.folder.iterdir())
    assert not incoming(settings).folder.exists()


@pytest.mark.long("journey")
def test_progress_counts_the_pictures(stored):
    told = []
    with FakePacs(stored) as pacs:
        fetch(pacs.settings(), Progress(lambda share, text: told.append((share, text))))
    assert "3 of 5 pictures received" in [text for _, text in told]
    assert [share for share, _ in told] == sorted(share for share, _ in told)


# --- refusals


def test_a_wrong_title_is_said_in_words(stored):
    with FakePacs(stored) as pacs, pytest.raises(PacsRefusedError, match="another AE title"):
        Pacs(pacs.settings(title="OTHER")).echo()


def test_an_unknown_caller_is_told_what_to_ask_for(stored):
    with (
        FakePacs(stored, calling=("SOMEBODY",)) as pacs,
        pytest.raises(PacsRefusedError, match="administrator must enter it"),
    ):
        Pacs(pacs.settings()).echo()


def test_a_service_that_is_not_offered_is_said(stored):
    with FakePacs(stored, "no find") as pacs, pytest.raises(PacsRefusedError, match="supports"):
        Pacs(pacs.settings()).find_studies(Query(name="S*"))


@pytest.mark.parametrize(
    ("ill", "words"),
    [("find fails", "out of resources"), ("not authorized", "not authorised")],
)
def test_a_failure_is_said_in_words(stored, ill, words):
    with FakePacs(stored, ill) as pacs:
        client = Pacs(pacs.settings())
        ask = client.echo if ill == "not authorized" else client.find_studies
        with pytest.raises(PacsError, match=words):
            ask(*[Query(name="S*")] * (ill == "find fails"))


@pytest.mark.long("journey")
def test_too_many_matches_are_refused(stored):
    with FakePacs(stored, "many") as pacs, pytest.raises(PacsError, match="more than 200"):
        Pacs(pacs.settings()).find_studies(Query(name="*"))


def test_an_answer_without_what_was_asked_for_is_empty_not_a_crash(stored):
    with FakePacs(stored, "junk find") as pacs:
        (study,) = Pacs(pacs.settings()).find_studies(Query(name="S*"))
    assert study.uid == ""


@pytest.mark.long("journey")
def test_nobody_there_a_wrong_name_and_something_else_there_are_told_apart():
    settings = PacsSettings(name="p", host="127.0.0.1", port=free_port(), title="X", timeout_s=1)
    with pytest.raises(PacsUnreachableError, match="refused"):
        Pacs(settings).echo()
    with socket.socket() as mute:
        mute.bind(("127.0.0.1", 0))
        mute.listen()
        there = settings.model_copy(update={"port": mute.getsockname()[1]})
        with pytest.raises(PacsUnreachableError, match="DICOM service"):
            Pacs(there).echo()


@pytest.mark.long("journey")
def test_silence_ends_after_the_configured_time(stored):
    with FakePacs(stored, "silent") as pacs:
        start = time.monotonic()
        with pytest.raises(PacsUnreachableError, match="no answer"):
            Pacs(pacs.settings(timeout_s=1.0)).echo()
        assert time.monotonic() - start < 20.0


# --- retrieving goes wrong


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/pacs.md: nothing enters the library; what came is kept aside for a day; the same "
    "command again fetches only the rest"
)
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_cut_in_the_middle_leaves_nothing_and_is_resumed(stored, way):
    with FakePacs(stored, "cut") as pacs:
        settings = pacs.settings(retrieve=way)
        with pytest.raises(PacsError):
            fetch(settings)
        assert empty()
        assert incoming(settings).count() == 2
        pacs.ill = ""
        pacs.sent.clear()
        imported = fetch(settings)
        assert len(pacs.sent) == 3  # only what was missing
    assert imported.entry.files == 5
    assert not incoming(settings).folder.exists()


@pytest.mark.long("journey")
def test_a_stall_in_the_middle_ends_in_time_and_is_resumed(stored):
    with FakePacs(stored, "stalls") as pacs:
        settings = pacs.settings(timeout_s=1.0)
        with pytest.raises(PacsUnreachableError, match="no answer while sending"):
            fetch(settings)
        assert empty()
        assert incoming(settings).count() == 2


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_picture_of_another_series_is_refused_and_nothing_is_kept(stored, way):
    with FakePacs(stored, "other series") as pacs:
        settings = pacs.settings(retrieve=way)
        with pytest.raises(PacsDataError, match="another series"):
            fetch(settings)
        assert empty()
        assert not incoming(settings).folder.exists()


@pytest.mark.long("journey")
@pytest.mark.promise("docs/pacs.md: refused at once; all of it is deleted")
@pytest.mark.parametrize("way", ["get", "move"])
@pytest.mark.parametrize(
    ("ill", "words"),
    [
        ("other patient", "several patients"),
        ("other study", "another study"),
        ("garbage", "another series"),
        ("too much", "had not listed"),
    ],
)
def test_what_was_not_asked_for_is_refused_and_nothing_is_kept(stored, way, ill, words):
    with FakePacs(stored, ill) as pacs:
        settings = pacs.settings(retrieve=way)
        with pytest.raises(PacsDataError, match=words):
            fetch(settings)
        assert empty()
        assert not incoming(settings).folder.exists()


def test_a_picture_that_is_left_out_is_counted(stored):
    with FakePacs(stored, "forgets") as pacs:
        with pytest.raises(PacsDataError, match="did not send 1 of 5"):
            fetch(pacs.settings())
        assert empty()


def test_a_damaged_picture_keeps_the_series_out(stored):
    with FakePacs(stored, "damaged") as pacs:
        settings = pacs.settings()
        with pytest.raises(SeriesRefusedError):
            fetch(settings)
        assert empty()
        assert not incoming(settings).folder.exists()


def test_a_retrieval_that_fails_is_said_in_words(stored):
    with FakePacs(stored, "get fails") as pacs, pytest.raises(PacsError, match="cannot send"):
        fetch(pacs.settings())
    assert empty()


def test_an_unknown_destination_is_told_what_to_ask_for(stored):
    with (
        FakePacs(stored, "unknown destination") as pacs,
        pytest.raises(PacsError, match="where to move to"),
    ):
        fetch(pacs.settings(retrieve="move"))


def test_a_port_that_is_taken_is_named(stored):
    with FakePacs(stored) as pacs, socket.socket() as other:
        other.bind(("127.0.0.1", pacs.own_port))
        other.listen()
        with pytest.raises(PacsError, match="cannot be used to receive"):
            fetch(pacs.settings(retrieve="move"))


def test_an_unknown_series_is_said(stored):
    with FakePacs(stored) as pacs:
        pacs.files = []
        with pytest.raises(PacsDataError, match="no such study or series"):
            fetch(pacs.settings())


@pytest.mark.long("journey")
@pytest.mark.parametrize("ill", ["", "stalls"])
def test_a_cancel_ends_at_once_even_in_silence_and_is_resumed(stored, ill):
    with FakePacs(stored, ill) as pacs:
        settings = pacs.settings(timeout_s=30.0)
        progress = Progress(
            lambda _, text: progress.cancel() if text.startswith("2 of 5") else None
        )
        start = time.monotonic()
        with pytest.raises(Cancelled):
            fetch(settings, progress)
        assert time.monotonic() - start < 20.0
        assert empty()
        assert incoming(settings).count() >= 2
        pacs.ill = ""
        assert fetch(settings).entry.files == 5


def test_what_was_never_finished_is_deleted_after_a_day(stored):
    with FakePacs(stored, "cut") as pacs:
        settings = pacs.settings()
        with pytest.raises(PacsError):
            fetch(settings)
    assert incoming(settings).folder.stat().st_mode & 0o077 == 0
    assert sweep() == 0
    assert sweep(time.time() + 25 * 3600) == 1
    assert not incoming(settings).folder.exists()


@pytest.mark.long("journey")
@pytest.mark.promise("docs/pacs.md: names are never logged or stored, and not in the JSON")
def test_no_patient_reaches_the_log(stored, caplog):
    caplog.set_level(logging.DEBUG)
    with FakePacs(stored) as pacs:
        client = Pacs(pacs.settings())
        client.find_studies(Query(name="Secret*"))
        fetch(pacs.settings())
    assert "secret" not in caplog.text.lower()


def test_no_thread_is_left_behind(stored):
    with FakePacs(stored) as pacs:
        before = {t for t in threading.enumerate() if t.name.startswith("acus pacs")}
        Pacs(pacs.settings()).echo()
        after = {t for t in threading.enumerate() if t.name.startswith("acus pacs")}
    assert after == before


# --- questions and configuration


@pytest.mark.parametrize("date", ["2024", "20240101-2024", "yesterday", "20240101 - 20240102"])
def test_a_date_that_is_none_is_refused(date):
    with pytest.raises(ConfigurationError, match="YYYYMMDD"):
        Query(date=date)


def test_a_question_for_everything_is_refused():
    with pytest.raises(ConfigurationError, match="what to look for"):
        Query()


def test_the_configuration_is_kept_and_chosen_from():
    with pytest.raises(ConfigurationError, match="no PACS is configured"):
        chosen(None)
    one = PacsSettings(name="main", host="pacs.example", port=104, title="ARCHIVE")
    keep((one,))
    assert configured() == (one,)
    assert chosen(None) == one
    keep((one, one.model_copy(update={"name": "other"})))
    assert chosen("other").name == "other"
    with pytest.raises(ConfigurationError, match="main, other"):
        chosen(None)
    with pytest.raises(ConfigurationError, match="no PACS 'third'"):
        chosen("third")


@pytest.mark.parametrize(
    "field", [{"title": "A" * 17}, {"title": "A\\B"}, {"port": 0}, {"host": ""}, {"timeout_s": 0}]
)
def test_settings_that_cannot_be_used_are_refused(field):
    given = {"name": "p", "host": "h", "port": 104, "title": "T"}
    with pytest.raises(ValueError, match=next(iter(field))):
        PacsSettings(**(given | field))


@pytest.mark.parametrize("status", [0x0000, 0x0122, 0xA700, 0xA801, 0xC123, 0xFE00, 0xB000, 0x1234])
def test_every_status_has_words_and_its_number(status):
    text = statuses.words(status)
    assert f"0x{status:04X}" in text
    assert len(text) > 15


@pytest.mark.promise("docs/pacs.md: none of them stores, changes or deletes anything there")
def test_an_archive_is_asked_for_nothing_that_changes_it():
    """What changes an archive are C-STORE, and N-CREATE, N-SET, N-DELETE and N-ACTION (PS3.7)."""
    folder = Path(pacs.__file__).parent
    asked = {
        found
        for path in folder.rglob("*.py")
        if path.name != "storing.py"  # what `acus pacs send` sends, and only that
        for found in re.findall(r"\bsend_[cn]_\w+", path.read_text(encoding="utf-8"))
    }
    assert asked == {"send_c_echo", "send_c_find", "send_c_get", "send_c_move"}
