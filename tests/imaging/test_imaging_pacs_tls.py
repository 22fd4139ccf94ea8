"""A PACS over TLS: both ways of retrieving, and what goes wrong said with the file's name."""

import socket
import ssl
import time
from pathlib import Path

import pytest
from dicom_factory import Slices
from pacs_rig import FakePacs
from typer.testing import CliRunner

from app.commands import build as command_line
from app.core.errors import ConfigurationError
from app.core.progress import Progress
from app.imaging.library import CtLibrary
from app.imaging.pacs.association import own_address
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.errors import PacsError, PacsUnreachableError
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import TlsSettings, configured
from app.imaging.pacs.taking import take

CERTIFICATES = Path(__file__).parent / "certificates"


def file(name):
    return str(CERTIFICATES / name)


OURS = {
    "authority": file("authority.pem"),
    "certificate": file("acus.pem"),
    "key": file("acus.key"),
}


def contexts(wants_ours):
    """The archive's contexts: as a server, and as the client that C-MOVE makes of it."""
    server, client = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER), ssl.create_default_context()
    for context in (server, client):
        context.load_verify_locations(file("authority.pem"))
        context.load_cert_chain(file("pacs.pem"), file("pacs.key"))
    if wants_ours:
        server.verify_mode = ssl.CERT_REQUIRED
    return server, client


@pytest.fixture
def stored(tmp_path):
    Slices().write(tmp_path / "stored")
    return tmp_path / "stored"


@pytest.fixture
def encrypted(stored):
    with FakePacs(stored, tls=contexts(wants_ours=True)) as pacs:
        yield pacs


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_series_is_found_and_retrieved_over_an_encrypted_connection(encrypted, way):
    settings = encrypted.settings(retrieve=way, tls=TlsSettings(**OURS), timeout_s=10.0)
    client = Pacs(settings)
    assert client.echo() < 10.0
    study = client.find_studies(Query(patient_id="SECRET*"))[0]
    series = client.find_series(study)[0]
    assert take(client, study.uid, series.uid, CtLibrary(), Progress()).entry.files == 5


def test_an_archive_with_a_certificate_of_somebody_else_is_refused(encrypted):
    settings = encrypted.settings(
        tls=TlsSettings(**(OURS | {"authority": file("stranger.pem")})), timeout_s=5.0
    )
    with pytest.raises(PacsUnreachableError, match="certificate is not trusted"):
        Pacs(settings).echo()


@pytest.mark.long("journey")
def test_a_certificate_for_another_host_is_refused_unless_that_is_asked_for(stored):
    with FakePacs(stored, tls=contexts(wants_ours=False)) as pacs:
        settings = pacs.settings(tls=TlsSettings(authority=file("authority.pem")), host="127.0.0.2")
        with pytest.raises(PacsUnreachableError, match=r"certificate is not trusted.*127\.0\.0\.2"):
            Pacs(settings).echo()
        tls = TlsSettings(authority=file("authority.pem"), check_name=False)
        Pacs(pacs.settings(tls=tls, host="127.0.0.2")).echo()


@pytest.mark.long("journey")
def test_a_plain_archive_asked_with_tls_and_the_other_way_round_are_told(stored, encrypted):
    with FakePacs(stored) as plain:
        settings = plain.settings(tls=TlsSettings(**OURS), timeout_s=2.0)
        with pytest.raises(PacsUnreachableError, match="TLS"):
            Pacs(settings).echo()
    with pytest.raises(PacsUnreachableError, match="wants TLS"):
        Pacs(encrypted.settings(timeout_s=2.0)).echo()


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/pacs.md: with C-MOVE the archive, which then connects to us, must show one of the same "
    "authority"
)
@pytest.mark.parametrize("shown", ["none", "a stranger's"])
def test_whoever_connects_for_a_move_without_a_certificate_of_the_authority_brings_nothing(
    stored, shown
):
    server, _ = contexts(wants_ours=True)
    client = ssl.create_default_context(cafile=file("authority.pem"))
    if shown == "a stranger's":
        client.load_cert_chain(file("unknown.pem"), file("unknown.key"))
    with FakePacs(stored, tls=(server, client)) as pacs:
        settings = pacs.settings(retrieve="move", tls=TlsSettings(**OURS), timeout_s=5.0)
        with pytest.raises(PacsError):
            take(Pacs(settings), "2.25.1", "2.25.1000", CtLibrary(), Progress())
    assert CtLibrary().entries() == ()


def test_an_archive_that_wants_our_certificate_and_gets_none_is_told(encrypted):
    settings = encrypted.settings(tls=TlsSettings(authority=file("authority.pem")), timeout_s=2.0)
    with pytest.raises(PacsUnreachableError, match="certificate of our own"):
        Pacs(settings).echo()


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"authority": "/nowhere/ca.pem"}, "authority /nowhere/ca.pem: it cannot be read: No such"),
        ({"authority": "README.md"}, "README.md: it holds no certificate"),
        ({"certificate": "/nowhere/c.pem"}, "certificate /nowhere/c.pem: it cannot be read"),
        ({"key": "/nowhere/k.pem"}, "key /nowhere/k.pem: it cannot be read"),
        ({"key": "pacs.key"}, "pacs.key: it does not belong to the certificate"),
        ({"key": "README.md"}, "README.md: certificate and key must be PEM"),
        ({"key": "locked.key"}, "locked.key: certificate and key must be PEM, the key without"),
        ({"key": ""}, "acus.pem: certificate and key must be PEM"),
    ],
)
def test_a_file_that_cannot_be_used_is_named(encrypted, changed, words):
    ((name, value),) = changed.items()
    if value and not value.startswith("/"):
        value = file(value)
    tls = TlsSettings(**(OURS | {name: value}))
    with pytest.raises(ConfigurationError, match=words):
        Pacs(encrypted.settings(tls=tls)).echo()


@pytest.mark.long("journey")
def test_a_move_without_a_certificate_of_our_own_is_refused_with_the_remedy(stored):
    with FakePacs(stored, tls=contexts(wants_ours=False)) as pacs:
        tls = TlsSettings(authority=file("authority.pem"))
        settings = pacs.settings(retrieve="move", tls=tls, timeout_s=5.0)
        with pytest.raises(ConfigurationError, match="certificate of our own"):
            take(Pacs(settings), "2.25.1", "2.25.1000", CtLibrary(), Progress())
    assert CtLibrary().entries() == ()


@pytest.mark.long("journey")
def test_pictures_come_to_the_address_that_leads_to_the_archive(stored):
    with FakePacs(stored) as pacs:
        assert own_address(pacs.settings(own_host="")) == "127.0.0.1"
        assert own_address(pacs.settings(own_host="0.0.0.0")) == "0.0.0.0"
        settings = pacs.settings(own_host="", retrieve="move")
        assert take(Pacs(settings), "2.25.1", "2.25.1000", CtLibrary(), Progress()).entry.files == 5


@pytest.mark.long("journey")
def test_the_command_line_adds_an_encrypted_archive_with_whole_paths(encrypted, monkeypatch):
    monkeypatch.chdir(CERTIFICATES)
    said = CliRunner().invoke(
        command_line(),
        ["pacs", "add", "secure", "--host", "localhost", "--port", str(encrypted.port),
         "--title", "FAKE", "--tls-authority", "authority.pem", "--tls-certificate", "acus.pem",
         "--tls-key", "acus.key"],
    )  # fmt: skip
    assert said.exit_code == 0, said.output
    (one,) = configured()
    assert one.tls == TlsSettings(**OURS)
    assert "TLS" in CliRunner().invoke(command_line(), ["pacs", "list"]).output
    assert "answers in" in CliRunner().invoke(command_line(), ["pacs", "echo"]).output


@pytest.mark.long("journey")
def test_a_stranger_who_connects_and_says_nothing_keeps_nobody_waiting(stored):
    """The network library shakes hands with whoever connects, one after the other."""
    silent = []

    def connect(pacs):
        silent.append(
            socket.create_connection(("127.0.0.1", pacs.own_port), source_address=("127.0.0.2", 0))
        )

    class Meddling(FakePacs):
        def _move(self, event):
            connect(self)
            yield from super()._move(event)

    with Meddling(stored, tls=contexts(wants_ours=True)) as pacs:
        settings = pacs.settings(retrieve="move", tls=TlsSettings(**OURS), timeout_s=10.0)
        started = time.monotonic()
        client = Pacs(settings)
        study = client.find_studies(Query(patient_id="SECRET*"))[0]
        series = client.find_series(study)[0]
        assert take(client, study.uid, series.uid, CtLibrary(), Progress()).entry.files == 5
        assert time.monotonic() - started < 8.0
    silent[0].close()
