"""Objects of an attempt to archives: one in this process that misbehaves, and a real Orthanc."""

import json
import sys
import urllib.request
from io import BytesIO
from pathlib import Path

import pydicom
import pytest
from dicom_factory import Slices
from orthanc_rig import Orthanc
from pacs_rig import free_port
from pynetdicom import AE, evt
from pynetdicom.sop_class import (
    Comprehensive3DSRStorage,
    GrayscaleSoftcopyPresentationStateStorage,
    RTStructureSetStorage,
    SegmentationStorage,
)
from test_imaging_results import TAGS, folder, structures, told, volume  # noqa: F401 - fixtures

sys.path.append(str(Path(__file__).parents[1] / "exchange"))
from lrs_server import CLOSE, HANG, ScriptedLrs, answer

from app.core.progress import Cancelled, Progress
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.errors import PacsDataError, PacsRefusedError, PacsUnreachableError
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.storing import store
from app.imaging.pacs.stow import stow
from app.imaging.pacs.web import WebArchive

KINDS = (SegmentationStorage, RTStructureSetStorage, Comprehensive3DSRStorage,
         GrayscaleSoftcopyPresentationStateStorage)  # fmt: skip


class Archive:
    """A storage service that answers the statuses it is told; `None` ends the connection."""

    def __init__(self, *statuses, kinds=KINDS, title="ARCHIVE"):
        self.statuses, self.port, self.held = list(statuses), free_port(), []
        self._ae = AE(title)
        self._ae.require_called_aet = True
        for kind in kinds:
            self._ae.add_supported_context(kind)

    def __enter__(self):
        handlers = [(evt.EVT_C_STORE, self._store)]
        where = ("127.0.0.1", self.port)
        self._server = self._ae.start_server(where, block=False, evt_handlers=handlers)
        return self

    def __exit__(self, *_):
        self._server.shutdown()

    def settings(self, **other):
        given = {"name": "archive", "host": "127.0.0.1", "port": self.port, "title": "ARCHIVE",
                 "timeout_s": 3.0}  # fmt: skip
        return PacsSettings(**(given | other))

    def _store(self, event):
        status = self.statuses.pop(0) if self.statuses else 0x0000
        if status is None:
            event.assoc.abort()
            return 0x0110
        if status in (0x0000, 0xB000):
            held = event.dataset
            held.file_meta = event.file_meta
            self.held.append(held)
        return status


@pytest.fixture
def files(folder):  # noqa: F811
    return sorted(folder.iterdir())


@pytest.mark.long("journey")
def test_all_are_taken_as_they_are(files):
    with Archive(0x0000, 0xB000, 0x0111) as archive:
        assert store(archive.settings(), files) == 4
    for held, path in zip(archive.held, [files[0], files[1], files[3]], strict=True):
        assert held == pydicom.dcmread(path)


@pytest.mark.parametrize(
    ("statuses", "kind", "words"),
    [
        ((0x0000, 0xA700), PacsDataError, r"out of resources.*; 1 of 4 were taken"),
        ((0xC001,), PacsDataError, r"cannot process the request.*; 0 of 4 were taken"),
        ((0x0000, 0x0000, None), PacsUnreachableError, r"was gone.*2 of 4 were taken"),
    ],
)
def test_what_goes_wrong_in_the_middle_is_said_and_can_be_sent_again(files, statuses, kind, words):
    with Archive(*statuses) as archive:
        with pytest.raises(kind, match=words):
            store(archive.settings(), files)
        assert store(archive.settings(), files) == 4
    assert len({one.SOPInstanceUID for one in archive.held}) == 4


def test_an_archive_that_takes_no_such_objects_or_does_not_know_us_says_so(files):
    with Archive(kinds=KINDS[:1]) as archive:
        with pytest.raises(PacsRefusedError, match=r"takes no objects of the kind of gsps\.dcm"):
            store(archive.settings(), files)
        with pytest.raises(PacsRefusedError, match="has another AE title than the one configured"):
            store(archive.settings(title="OTHER"), files)
    with pytest.raises(PacsUnreachableError):
        store(archive.settings(), files)


def test_a_cancel_ends_it(files):
    progress = Progress()
    progress.cancel()
    with Archive() as archive, pytest.raises(Cancelled):
        store(archive.settings(), files, progress)
    assert archive.held == []


TAKEN = {"00081199": {"vr": "SQ", "Value": [{}, {}, {}, {}]}}
PART = {
    "00081199": {"vr": "SQ", "Value": [{}, {}, {}]},
    "00081198": {"vr": "SQ", "Value": [{"00081197": {"vr": "US", "Value": [0xA700]}}]},
}


def test_the_web_takes_all_in_one_request(files):
    with ScriptedLrs(answer(200, TAKEN)) as server:
        assert stow(WebArchive(f"http://127.0.0.1:{server.port}/dw", "a", "b"), files) == 4
    ((method, target, headers, body),) = server.requests
    assert (method, target) == ("POST", "/dw/studies")
    assert headers["Content-Type"].startswith('multipart/related; type="application/dicom"; bound')
    mark = headers["Content-Type"].partition("boundary=")[2].encode()
    parts = body.split(b"--" + mark)[1:-1]
    assert [part.partition(b"\r\n\r\n")[2][:-2] for part in parts] == [
        path.read_bytes() for path in files
    ]


@pytest.mark.parametrize(
    ("said", "kind", "words"),
    [
        (answer(202, PART), PacsDataError, r"took 3 of 4 objects \(202, 0xA700\)"),
        (answer(200, {}), PacsDataError, "took 0 of 4"),
        (answer(200, b"<html>"), PacsDataError, "took 0 of 4"),
        (answer(413), PacsDataError, r"took 0 of 4 objects \(413\)"),
        (answer(500), PacsDataError, r"\(500\)"),
        (answer(401), PacsRefusedError, "does not let 'acus' in"),
        (answer(302, Location="https://else.example/"), PacsRefusedError, "on to else.example"),
        (HANG, PacsUnreachableError, "within 0.3 s"),
        (CLOSE, PacsUnreachableError, "kept once"),
        (answer(200, b"{", Content_Length=9), PacsUnreachableError, "not to the end"),
    ],
)
def test_a_web_archive_that_misbehaves_is_told_of_in_one_line(files, said, kind, words):
    with ScriptedLrs(said) as server:
        archive = WebArchive(f"http://127.0.0.1:{server.port}/dw", "acus", "secret", 0.3)
        with pytest.raises(kind, match=words) as caught:
            stow(archive, files)
    assert "secret" not in str(caught.value) + repr(archive)


def test_a_web_archive_that_has_them_already_is_content(files):
    there = {"00081198": {"vr": "SQ", "Value": [{"00081197": {"Value": [0x0111]}}] * 4}}
    with ScriptedLrs(answer(409, there)) as server:
        assert stow(WebArchive(f"http://127.0.0.1:{server.port}/dw"), files) == 4


def test_a_web_archive_elsewhere_is_told_nothing_by_plain_http(files):
    with pytest.raises(PacsRefusedError, match="plain http"):
        stow(WebArchive("http://pacs.school.example/dicom-web"), files)


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["dimse", "web"])
def test_orthanc_takes_them_and_gives_back_what_went_in(tmp_path, way, files):
    with Orthanc(tmp_path / "orthanc", web=True) as orthanc:
        ct = Slices(offsets=(0.0, 2.0), tags=TAGS)
        ct.write(tmp_path / "ct")
        orthanc.store(tmp_path / "ct")
        for _ in range(2):
            if way == "dimse":
                assert store(orthanc.settings(), files) == 4
            else:
                assert stow(WebArchive(orthanc.web), files) == 4
        study = pydicom.dcmread(files[0]).StudyInstanceUID
        client = Pacs(orthanc.settings())
        (known,) = [s for s in client.find_studies(Query(patient_id="*")) if s.uid == study]
        found = client.find_series(known, modality="")
        assert {one.instances for one in found if one.number in ("300", "301", "302", "303")} == {1}
        for path in files:
            ours = pydicom.dcmread(path)
            theirs = _wado(orthanc, ours)
            assert theirs == ours


def _wado(orthanc, ours):
    """Fetch an object by Orthanc's own address, read by pydicom."""
    where = f"http://127.0.0.1:{orthanc.http}"
    asked = json.dumps({"Level": "Instance", "Query": {"SOPInstanceUID": ours.SOPInstanceUID}})
    with urllib.request.urlopen(f"{where}/tools/find", asked.encode()) as reply:
        (name,) = json.loads(reply.read())
    with urllib.request.urlopen(f"{where}/instances/{name}/file") as reply:
        return pydicom.dcmread(BytesIO(reply.read()))
