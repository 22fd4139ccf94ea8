"""Peers that mean harm: strangers, replaced pictures, endless lengths, drips and floods."""

import socket
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pydicom
import pytest
from dicom_factory import SERIES, Slices
from pacs_rig import PENDING, SILENCE_S, FakePacs, free_port
from pydicom.dataset import Dataset
from pynetdicom import AE, evt
from pynetdicom.sop_class import CTImageStorage

from app.core.progress import Progress
from app.imaging.library import CtLibrary
from app.imaging.pacs import client, limits
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.errors import PacsDataError, PacsError
from app.imaging.pacs.incoming import Incoming
from app.imaging.pacs.limits import may_send
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.taking import take
from app.imaging.reading import load_ct

STUDY = "2.25.1"
STRANGER = "127.0.0.2"
WITHIN_S = 10.0
MOST_MEMORY = 60 << 20


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    Slices().write(tmp_path / "stored")
    return tmp_path / "stored"


def fetch(settings: PacsSettings):
    return take(Pacs(settings), STUDY, SERIES, CtLibrary(), Progress())


def nothing_is_left(settings: PacsSettings) -> bool:
    library, aside = CtLibrary().folder, Incoming(settings, SERIES).folder
    return not (library.exists() and list(library.iterdir())) and not aside.exists()


@contextmanager
def bounded(seconds: float = WITHIN_S) -> Iterator[None]:
    """What happens inside takes little time and little memory beside what there is."""
    Path("/proc/self/clear_refs").write_text("5")  # the peak begins anew
    before, started = resident("VmRSS"), time.monotonic()
    yield
    assert time.monotonic() - started < seconds
    assert resident("VmHWM") - before < MOST_MEMORY


def resident(name: str) -> int:
    text = Path("/proc/self/status").read_text().split(f"{name}:")[1]
    return 1024 * int(text.split()[0])


def forged(path: Path) -> Dataset:
    """A picture with the names of a genuine one and other pixels."""
    copy = pydicom.dcmread(path)
    copy.PixelData = b"\7" * len(copy.PixelData)
    return copy


class Meddling(FakePacs):
    """One that lets somebody else do something before it sends its pictures."""

    def __init__(self, folder: Path, meddle, ill: str = "") -> None:
        super().__init__(folder, ill)
        self._meddle = meddle

    def _send(self, event):
        for number, answer in enumerate(super()._send(event)):
            if number == 2:
                self._meddle(self)
            yield answer


def send(pacs: FakePacs, pictures: list[Dataset], address: str = STRANGER) -> list[int | None]:
    """Send pictures to our port under the titles that we expect; the answers."""
    entity = AE("FAKE")
    entity.add_requested_context(CTImageStorage)
    sockets: list[socket.socket] = []
    opened = [(evt.EVT_CONN_OPEN, lambda event: sockets.append(event.assoc.dul.socket.socket))]
    linked = entity.associate(
        "127.0.0.1", pacs.own_port, ae_title="ACUS", bind_address=(address, 0), evt_handlers=opened
    )
    found: list[int | None] = []
    for picture in pictures if linked.is_established else ():
        found.append(linked.send_c_store(picture).get("Status"))
    if linked.is_established:
        linked.release()
    for one in sockets:
        one.close()
    return found


@pytest.mark.long("journey")
def test_a_stranger_who_knows_both_titles_replaces_no_picture(stored: Path) -> None:
    answers: list[int | None] = []
    pictures = [forged(path) for path in sorted(stored.iterdir())]
    with Meddling(stored, lambda pacs: answers.extend(send(pacs, pictures))) as pacs:
        imported = fetch(pacs.settings(retrieve="move"))
    assert answers == []
    np.testing.assert_array_equal(load_ct(stored).hu, load_ct(imported.entry.folder).hu)


@pytest.mark.long("journey")
def test_a_refusal_names_the_address_and_what_to_do(stored: Path) -> None:
    pictures = [pydicom.dcmread(path) for path in sorted(stored.iterdir())]
    with Meddling(stored, lambda pacs: send(pacs, pictures), "forgets") as pacs:
        words = "did not send 1 of 5.*a connection from 127.0.0.2 was refused.*under senders"
        with pytest.raises(PacsDataError, match=words):
            fetch(pacs.settings(retrieve="move"))


@pytest.mark.long("journey")
def test_an_address_that_is_listed_may_send(stored: Path) -> None:
    answers: list[int | None] = []
    pictures = [pydicom.dcmread(path) for path in sorted(stored.iterdir())]
    with Meddling(stored, lambda pacs: answers.extend(send(pacs, pictures)), "forgets") as pacs:
        imported = fetch(pacs.settings(retrieve="move", senders=(STRANGER,)))
    assert answers == [0] * 5
    assert imported.entry.files == 5


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_picture_that_has_come_is_never_written_over(stored: Path, way: str) -> None:
    with FakePacs(stored) as pacs:
        pacs.files.insert(4, forged(sorted(stored.iterdir())[0]))
        settings = pacs.settings(retrieve=way)
        with pytest.raises(PacsDataError, match="two different pictures under one name"):
            fetch(settings)
        assert nothing_is_left(settings)


@pytest.mark.long("journey")
def test_thirty_thousand_pictures_that_nobody_listed_end_with_the_first(stored: Path) -> None:
    class Flooding(FakePacs):
        def _send(self, event):
            yield 30_000
            copy = pydicom.dcmread(self.files[0].filename)
            for number in range(30_000):
                copy.SOPInstanceUID = copy.file_meta.MediaStorageSOPInstanceUID = f"2.25.7{number}"
                self.sent.append(number)
                yield PENDING, copy

    with Flooding(stored) as pacs, bounded():
        settings = pacs.settings(retrieve="move")
        with pytest.raises(PacsDataError, match="it sent a picture that it had not listed"):
            fetch(settings)
    assert len(pacs.sent) < 1000
    assert nothing_is_left(settings)


def test_a_listing_without_an_end_is_refused(stored: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Endless(FakePacs):
        def _find(self, event):
            for number in range(100_000):
                answer = Dataset()
                answer.SOPInstanceUID = f"2.25.{number}"
                self.sent.append(number)
                yield PENDING, answer

    monkeypatch.setattr(client, "MOST_PICTURES", 50)
    with (
        Endless(stored) as pacs,
        bounded(),
        pytest.raises(PacsError, match="more than 50 answers while listing the pictures"),
    ):
        fetch(pacs.settings())
    assert len(pacs.sent) < 10_000


@pytest.mark.long("journey")
def test_answers_that_drip_past_every_silence_end_with_the_clock_of_the_request(
    stored: Path,
) -> None:
    class Dripping(FakePacs):
        def _find(self, event):
            while not self._over.wait(0.2):
                answer = Dataset()
                answer.StudyInstanceUID = "2.25.5"
                yield PENDING, answer

    with (
        Dripping(stored) as pacs,
        bounded(),
        pytest.raises(PacsError, match=r"it took longer than 2 s for 0\.0 MB"),
    ):
        Pacs(pacs.settings(timeout_s=0.5)).find_studies(Query(name="S*"))


# --- peers that speak bytes, not DICOM


@contextmanager
def raw_peer(say) -> Iterator[PacsSettings]:
    """Something that listens and does what `say` does with each connection."""
    port, over = free_port(), threading.Event()
    threads: list[threading.Thread] = []

    def serve(connection: socket.socket) -> None:
        with connection:
            try:
                if connection.recv(1 << 16):  # the first connection only looks whether it is there
                    say(connection, over)
            except OSError:
                pass  # let go

    def listen() -> None:
        while not over.is_set():
            try:
                connection = listening.accept()[0]
            except OSError:
                continue
            threads.append(threading.Thread(target=serve, args=(connection,)))
            threads[-1].start()

    with socket.create_server(("127.0.0.1", port)) as listening:
        listening.settimeout(0.1)
        threads.append(threading.Thread(target=listen))
        threads[0].start()
        yield PacsSettings(name="raw", host="127.0.0.1", port=port, title="FAKE", timeout_s=0.5)
        over.set()
        for thread in threads:
            thread.join(SILENCE_S)


def endless(kind: int):
    def say(connection: socket.socket, over: threading.Event) -> None:
        connection.sendall(struct.pack(">BBL", kind, 0, 0xFFFF_FFFF))
        while not over.is_set():
            connection.sendall(bytes(1 << 20))

    return say


def test_a_greeting_of_four_gigabytes_is_not_read() -> None:
    with (
        raw_peer(endless(2)) as settings,
        bounded(),
        pytest.raises(PacsDataError, match=r"announced a PDU of 4295\.0 MB; 0\.1 is the most"),
    ):
        Pacs(settings).echo()


@pytest.mark.long("journey")
def test_a_greeting_that_drips_past_every_timeout_ends_with_the_clock() -> None:
    def drip(connection: socket.socket, over: threading.Event) -> None:
        connection.sendall(struct.pack(">BBL", 2, 0, 100_000))
        while not over.wait(0.05):
            connection.sendall(b"\0")

    with raw_peer(drip) as settings, bounded(), pytest.raises(PacsError):
        Pacs(settings).echo()


class Raw(FakePacs):
    """One that answers C-ECHO with bytes of its own choice."""

    def __init__(self, folder: Path, says) -> None:
        super().__init__(folder)
        self._says = says

    def _echo(self, event):
        self._says(event.assoc.dul.socket.socket, self._over)
        return 0


def test_a_pdu_of_four_gigabytes_is_not_read(stored: Path) -> None:
    with (
        Raw(stored, lambda to, _: to.sendall(struct.pack(">BBL", 4, 0, 0xFFFF_FFFF))) as pacs,
        bounded(),
        pytest.raises(PacsDataError, match=r"announced a PDU of 4295\.0 MB"),
    ):
        Pacs(pacs.settings()).echo()


def pdu(context: int, header: int, data: bytes) -> bytes:
    item = struct.pack(">LBB", len(data) + 2, context, header) + data
    return struct.pack(">BBL", 4, 0, len(item)) + item


def test_a_message_without_an_end_is_not_kept(stored: Path) -> None:
    """Fragments of a data set that belongs to no picture, each as short as can be wished."""

    def say(to: socket.socket, over: threading.Event) -> None:
        try:
            while not over.is_set():
                to.sendall(pdu(1, 0, bytes(10_000)))
        except OSError:
            pass  # let go

    with (
        Raw(stored, say) as pacs,
        bounded(),
        pytest.raises(PacsDataError, match="it sent a message of more than 1 MB"),
    ):
        Pacs(pacs.settings()).echo()


# --- pictures that are too large


class Large(FakePacs):
    """One whose third picture has so many bytes of pixels."""

    size = 0

    def _spoilt(self, file, index):
        copy = pydicom.dcmread(file.filename)
        if index == 2:
            copy.PixelData = bytes(self.size)
        return copy


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_picture_larger_than_any_is_refused_while_it_comes(
    stored: Path, way: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "LARGEST_PICTURE", 8_000_000)
    with Large(stored) as pacs:
        pacs.size = 40_000_000
        settings = pacs.settings(retrieve=way)
        with pytest.raises(PacsDataError, match="it sent a picture of more than 8 MB"):
            fetch(settings)
    aside = Incoming(settings, SERIES).folder
    assert not aside.exists() or not [p for p in aside.iterdir() if p.suffix != ".dcm"]


ELSEWHERE = """
import sys
sys.path[:0] = [sys.argv[1]]
from pathlib import Path
from test_imaging_pacs_hostile import Large
with Large(Path(sys.argv[2])) as pacs:
    pacs.size = 100_000_000
    print(pacs.port, pacs.own_port, flush=True)
    sys.stdin.readline()
"""


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_large_picture_goes_to_the_disk_as_it_comes(stored: Path, way: str) -> None:
    """The archive is another process: what it takes itself counts nothing."""
    command = [sys.executable, "-c", ELSEWHERE, str(Path(__file__).parent), str(stored)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as archive:
        assert archive.stdout is not None
        port, own_port = map(int, archive.stdout.readline().split())
        settings = PacsSettings(
            name="a", host="127.0.0.1", port=port, title="FAKE", retrieve=way,
            own_host="127.0.0.1", own_port=own_port,
        )  # fmt: skip
        incoming = Incoming(settings, SERIES, STUDY).open()
        with bounded(30.0):
            Pacs(settings).retrieve(STUDY, SERIES, incoming, Progress())
        sizes = sorted(path.stat().st_size for path in incoming.folder.iterdir())
        archive.communicate(b"\n")
    assert len(sizes) == 5
    assert sizes[-1] > 100_000_000


def test_a_picture_on_its_way_is_in_the_folder_of_its_request_and_nowhere_else(
    stored: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    seen: list[str] = []

    def look(pacs: FakePacs) -> None:
        seen.extend(p.name for p in (tmp_path / "temporary").iterdir())

    with Meddling(stored, look, "cut") as pacs:
        settings = pacs.settings()
        with pytest.raises(PacsError):
            fetch(settings)
    assert seen == []
    assert not list((tmp_path / "temporary").iterdir())


@pytest.mark.parametrize(
    ("host", "senders", "address", "may"),
    [
        ("127.0.0.1", (), "127.0.0.1", True),
        ("127.0.0.1", (), "::ffff:127.0.0.1", True),
        ("127.0.0.1", (), "127.0.0.2", False),
        ("127.0.0.1", ("127.0.0.2",), "127.0.0.2", True),
        ("localhost", (), "127.0.0.1", True),
        ("no-such-host.invalid", (), "127.0.0.1", False),
    ],
)
def test_pictures_come_from_the_archive_and_what_is_listed_for_it(
    host: str, senders: tuple[str, ...], address: str, may: bool
) -> None:
    settings = PacsSettings(name="a", host=host, port=104, title="A", senders=senders)
    assert may_send(settings, address) is may
