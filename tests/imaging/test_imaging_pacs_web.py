"""DICOMweb in: found and fetched from Orthanc's plug-in, and what a hostile server may not do."""

import json
import threading
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pydicom
import pytest
from dicom_factory import SERIES, Slices
from orthanc_rig import Orthanc
from typer.testing import CliRunner

from app.commands import build
from app.core.configuration import parse
from app.core.errors import ConfigurationError
from app.core.progress import Cancelled, Progress
from app.imaging.library import CtLibrary
from app.imaging.pacs.archive import archive_of
from app.imaging.pacs.errors import (
    PacsDataError,
    PacsError,
    PacsRefusedError,
    PacsUnreachableError,
)
from app.imaging.pacs.incoming import Incoming
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import PacsSettings, chosen, keep, pacs_path
from app.imaging.pacs.taking import take
from app.imaging.reading import load_ct

STUDY = "2.25.1"
CT = "1.2.840.10008.5.1.4.1.1.2"


def settings_of(url, **changed):
    web = {"url": url, "user": changed.pop("user", ""), "password": changed.pop("password", "")}
    given = {"name": "web", "retrieve": "web", "timeout_s": 5.0, "web": web}
    return parse(given | changed, PacsSettings, "test")


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stored")
    recipe = Slices(offsets=tuple(2.0 * k for k in range(40)), shape=(64, 64))
    recipe.tags["StudyDate"] = "20240229"
    recipe.write(folder)
    return folder


@pytest.fixture(scope="module")
def orthanc(tmp_path_factory, stored):
    with Orthanc(tmp_path_factory.mktemp("orthanc"), web=True) as archive:
        archive.store(stored)
        yield archive


@pytest.mark.long("journey")
def test_what_was_stored_is_found_by_patient_and_by_date(orthanc):
    archive = archive_of(settings_of(orthanc.web))
    assert archive.echo() < 5.0
    for query in (Query(patient_id="SECRET*"), Query(date="20240201-20240301")):
        (study,) = archive.find_studies(query)
        assert (study.uid, study.date, study.instances) == (STUDY, "20240229", 40)
        assert "CT" in study.modalities
        (series,) = archive.find_series(study)
        assert (series.uid, series.modality, series.instances) == (SERIES, "CT", 40)
    assert archive.find_studies(Query(patient_id="NOBODY")) == []
    assert archive.find_studies(Query(patient_id="SECRET*", modality="MR")) == []


@pytest.mark.long("journey")
def test_a_series_enters_the_library_with_the_same_voxels_and_no_names(orthanc, stored):
    settings = settings_of(orthanc.web)
    imported = take(archive_of(settings), STUDY, SERIES, CtLibrary(), Progress())
    before, after = load_ct(stored), load_ct(imported.entry.folder)
    np.testing.assert_array_equal(before.hu, after.hu)
    np.testing.assert_allclose(before.affine_mm, after.affine_mm)
    assert "Secret" not in str(pydicom.dcmread(min(imported.entry.folder.glob("*.dcm"))))
    assert not Incoming(settings, SERIES).folder.exists()


@pytest.mark.long("journey")
def test_only_what_is_missing_is_fetched_again_and_a_cancel_keeps_what_came(orthanc):
    settings = settings_of(orthanc.web)
    archive, told = archive_of(settings), []

    def stop(_, text):
        if text.startswith("9 of"):
            progress.cancel()

    progress = Progress(stop)
    with pytest.raises(Cancelled):
        take(archive, STUDY, SERIES, CtLibrary(), progress)
    incoming = Incoming(settings, SERIES).open()
    assert incoming.count() == 9
    archive.retrieve(STUDY, SERIES, incoming, Progress(lambda _, text: told.append(text)))
    assert incoming.count() == 40
    assert sum("received" in text for text in told) == 31
    assert not list(incoming.folder.glob("*.spooled"))
    incoming.forget()


@pytest.mark.long("journey")
def test_a_series_it_has_not_got_is_said(orthanc):
    archive = archive_of(settings_of(orthanc.web))
    with pytest.raises(PacsDataError, match="no such study or series"):
        take(archive, STUDY, "2.25.404", CtLibrary(), Progress())


@pytest.mark.long("journey")
def test_the_commands_configure_find_and_take(orthanc, tmp_path):
    run = CliRunner()

    def acus(*words):
        return run.invoke(build(), ["pacs", *words], catch_exceptions=False)

    assert "acus pacs echo" in acus("add", "house", "--web", orthanc.web).stdout
    assert "DICOMweb" in acus("list").stdout
    assert "answers in" in acus("echo").stdout
    found = acus("find", "--patient-id", "SECRET*").stdout
    assert SERIES in found
    assert "Secret" not in found
    assert "C-MOVE" in acus("move", STUDY, SERIES).output
    assert acus("get", STUDY, SERIES).exit_code == 0
    assert len(CtLibrary().entries()) == 1


class Scripted:
    """A server that answers each path as a test says, and remembers what it was asked."""

    def __init__(self):
        self.asked, self.answers, self.stop = [], {}, threading.Event()
        rig = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                parts = urlsplit(self.path)
                rig.asked.append((parts.path, parse_qs(parts.query), dict(self.headers)))
                answer = rig.answers.get(parts.path, (404, {}, b""))
                answer = answer(parse_qs(parts.query)) if callable(answer) else answer
                status, headers, body = answer
                self.send_response(status)
                for name, value in headers.items():
                    self.send_header(name, value)
                if not isinstance(body, bytes):
                    self.end_headers()
                    with suppress(OSError):  # the other end has gone
                        for piece in body:
                            self.wfile.write(piece)
                            self.wfile.flush()
                    return
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)

            def log_message(self, *_):
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.daemon_threads = True
        self.url = f"http://127.0.0.1:{self.server.server_port}/dicom-web"

    def __enter__(self):
        self.thread = threading.Thread(target=self.server.serve_forever, args=(0.02,))
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.stop.set()
        self.server.shutdown()
        self.thread.join()
        self.server.server_close()


JSON = {"Content-Type": "application/dicom+json"}


def tagged(**values):
    tags = {
        "study": "0020000D", "series": "0020000E", "instance": "00080018", "kind": "00080016",
        "patient": "00100010",
    }  # fmt: skip
    return {tags[name]: {"vr": "UI", "Value": [value]} for name, value in values.items()}


@pytest.fixture
def server(stored):
    with Scripted() as rig:
        files = {str(pydicom.dcmread(f).SOPInstanceUID): f for f in sorted(stored.iterdir())[:4]}
        base = "/dicom-web/studies"
        rig.files, rig.place = files, f"{base}/{STUDY}/series/{SERIES}/instances"
        listed = [tagged(instance=uid, kind=CT) for uid in files]

        def page(query):
            start, size = int(query["offset"][0]), 3  # less than was asked for
            return 200, JSON, json.dumps(listed[start : start + size]).encode()

        rig.answers = {base: (200, JSON, b"[]"), rig.place: page}
        for uid, file in files.items():
            rig.answers[f"{rig.place}/{uid}"] = part_of(file.read_bytes())
        yield rig


def part_of(*objects, end=b"--"):
    head = b"--edge\r\nContent-Type: application/dicom\r\n\r\n"
    body = b"".join(head + one + b"\r\n" for one in objects) + b"--edge" + end + b"\r\n"
    return 200, {"Content-Type": 'multipart/related; type="application/dicom"; boundary=edge'}, body


def retrieved(settings):
    incoming = Incoming(settings, SERIES, STUDY).open()
    archive_of(settings).retrieve(STUDY, SERIES, incoming, Progress())
    return incoming


@pytest.mark.long("journey")
def test_pages_that_are_shorter_than_asked_are_all_read(server):
    assert retrieved(settings_of(server.url)).count() == 4
    starts = [query["offset"][0] for path, query, _ in server.asked if path == server.place]
    assert starts == ["0", "3", "4"]


def test_an_archive_that_knows_no_pages_is_read_once(server):
    server.answers[server.place] = (
        200, JSON, json.dumps([tagged(instance=uid, kind=CT) for uid in server.files]).encode(),
    )  # fmt: skip
    assert retrieved(settings_of(server.url)).count() == 4


def test_name_and_password_go_in_the_head_and_nowhere_else(server):
    settings = settings_of(server.url, user="acus", password="s3cret")
    archive_of(settings).echo()
    ((path, query, headers),) = server.asked
    assert headers["Authorization"] == "Basic YWN1czpzM2NyZXQ="
    assert "s3cret" not in path + str(query)
    keep((settings,))
    assert chosen("web").web.password == "s3cret"
    assert pacs_path().stat().st_mode & 0o077 == 0
    assert "s3cret" not in repr(settings)
    told = CliRunner().invoke(build(), ["pacs", "list", "--json"], catch_exceptions=False).stdout
    assert "s3cret" not in told
    assert json.loads(told)["facts"]["servers"][0]["web"]["user"] == "acus"


HOSTILE = {
    "two pictures for one": lambda files: part_of(files[0], files[0]),
    "no end": lambda files: part_of(files[0], end=b""),
    "no mark": lambda files: (200, {"Content-Type": "multipart/related"}, part_of(files[0])[2]),
    "nothing": lambda files: (200, {"Content-Type": "application/dicom"}, b""),
    "another picture": lambda files: part_of(files[1]),
    "no DICOM": lambda files: part_of(b"<html>sign in</html>"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_is_not_the_one_picture_that_was_asked_for_is_refused(server, name):
    contents = [file.read_bytes() for file in server.files.values()]
    first = next(iter(server.files))
    server.answers[f"{server.place}/{first}"] = HOSTILE[name](contents)
    settings = settings_of(server.url)
    with pytest.raises(PacsDataError, match=r"^web: it sent .*; nothing was taken"):
        retrieved(settings)
    assert not list(Incoming(settings, SERIES, STUDY).folder.glob("*.spooled"))


def test_an_object_without_parts_around_it_is_taken(server):
    first, file = next(iter(server.files.items()))
    plain = (200, {"Content-Type": "application/dicom"}, file.read_bytes())
    server.answers[f"{server.place}/{first}"] = plain
    assert retrieved(settings_of(server.url)).count() == 4


@pytest.mark.parametrize(
    ("answer", "error", "message"),
    [
        ((401, {}, b""), PacsRefusedError, "does not let 'acus' in"),
        ((302, {"Location": "https://elsewhere.example/x"}, b""), PacsRefusedError, "sends on to"),
        ((500, {}, b"patient Secret"), PacsError, "refuses with 500"),
        ((200, {}, b"<html>"), PacsDataError, "before /studies"),
        ((200, {}, b"[1]"), PacsDataError, "before /studies"),
        ((200, {}, b"[" * 100_000), PacsDataError, "before /studies"),
        ((200, {}, b"x" * (5 << 20)), PacsUnreachableError, "not to the end"),
    ],
)
def test_an_answer_that_is_none_is_one_line_that_says_what_to_do(server, answer, error, message):
    server.answers["/dicom-web/studies"] = answer
    with pytest.raises(error, match=message) as caught:
        archive_of(settings_of(server.url, user="acus")).find_studies(Query(patient_id="A"))
    assert "\n" not in str(caught.value)
    assert "Secret" not in str(caught.value)


@pytest.mark.parametrize("drips", [True, False])
def test_a_silent_or_dripping_server_is_left_and_a_cancel_does_not_wait_for_it(server, drips):
    def slowly():
        while not server.stop.wait(0.05):
            yield b" " if drips else b""

    server.answers["/dicom-web/studies"] = (200, {}, slowly())
    settings = settings_of(server.url, timeout_s=0.6)
    with pytest.raises(PacsUnreachableError, match=r"within 0\.6 s"):
        archive_of(settings).find_studies(Query(patient_id="A"))
    server.answers["/dicom-web/studies"] = (200, {}, slowly())
    progress = Progress()
    threading.Timer(0.3, progress.cancel).start()
    with pytest.raises(Cancelled):
        archive_of(settings_of(server.url, timeout_s=60.0)).echo(progress)


def test_a_uid_that_is_none_asks_for_nothing(server):
    server.answers["/dicom-web/studies"] = (
        200, JSON, json.dumps([tagged(study="../../admin")]).encode(),
    )  # fmt: skip
    archive = archive_of(settings_of(server.url))
    (study,) = archive.find_studies(Query(patient_id="A"))
    with pytest.raises(PacsDataError, match="is no UID"):
        archive.find_series(study)
    assert len(server.asked) == 1


def test_addresses_and_fields_that_cannot_be_used_are_named(tmp_path):
    with pytest.raises(ConfigurationError, match="plain http"):
        settings_of("http://pacs.school.example/dicom-web")
    with pytest.raises(ConfigurationError, match="say where by web"):
        parse(
            {"name": "a", "host": "b", "port": 1, "title": "C", "retrieve": "web"},
            PacsSettings,
            "test",
        )
    known = settings_of("https://pacs.school.example/dicom-web")
    assert (known.host, known.port, known.title) == ("pacs.school.example", 443, "DICOMWEB")
    told = CliRunner().invoke(build(), ["pacs", "add", "a", "--host", "b"])
    assert "--web" in told.output


def test_a_name_that_nobody_has_and_a_port_where_nothing_listens_are_said_apart():
    nobody = settings_of("https://pacs.invalid/dicom-web")
    with pytest.raises(PacsUnreachableError, match=r"no computer pacs\.invalid is known"):
        archive_of(nobody).echo()
    with Scripted() as gone:
        pass
    with pytest.raises(PacsUnreachableError, match="nothing listens at 127"):
        archive_of(settings_of(gone.url)).echo()
