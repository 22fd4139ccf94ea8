"""A PACS in this process, for tests: it behaves, or misbehaves as it is told."""

import os
import socket
import threading
from itertools import count
from pathlib import Path

import pydicom
from pydicom.dataset import Dataset
from pynetdicom import AE, evt
from pynetdicom.sop_class import (
    CTImageStorage,
    StudyRootQueryRetrieveInformationModelFind,
    StudyRootQueryRetrieveInformationModelGet,
    StudyRootQueryRetrieveInformationModelMove,
    Verification,
)

from app.imaging.pacs.settings import PacsSettings

PENDING, SUCCESS = 0xFF00, 0x0000
SILENCE_S = 60.0
"""How long one that says nothing would be silent; it ends with the test."""

_numbers = count(20_000 + 1000 * int(os.environ.get("PYTEST_XDIST_WORKER", "gw0")[2:]))
"""Below the ports that the system gives away, and others in every process of the tests."""


def free_port() -> int:
    for number in _numbers:
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", number))
            except OSError:
                continue
            return number
    raise AssertionError("there are always numbers left")


def _another(file: Dataset) -> Dataset:
    """Return a picture of the same series that nobody listed."""
    copy = pydicom.dcmread(file.filename)
    copy.SOPInstanceUID = copy.file_meta.MediaStorageSOPInstanceUID = f"{file.SOPInstanceUID}.9"
    return copy


class FakePacs:
    """Serves the files of a folder; `ill` names what it does wrong."""

    def __init__(
        self, folder: Path, ill: str = "", calling: tuple[str, ...] = (), tls: tuple | None = None
    ) -> None:
        self._tls = tls
        self.files = [pydicom.dcmread(path) for path in sorted(folder.glob("*"))]
        self.ill, self.asked, self.sent = ill, [], []
        self.port, self.own_port = free_port(), free_port()
        self._over, self._sockets = threading.Event(), []
        self._ae = AE("FAKE")
        self._ae.require_called_aet = True
        self._ae.require_calling_aet = list(calling)
        for model in (
            Verification,
            StudyRootQueryRetrieveInformationModelFind,
            StudyRootQueryRetrieveInformationModelGet,
            StudyRootQueryRetrieveInformationModelMove,
        ):
            if not (ill == "no find" and model == StudyRootQueryRetrieveInformationModelFind):
                self._ae.add_supported_context(model)
        self._ae.add_supported_context(CTImageStorage, scu_role=True, scp_role=True)
        self._ae.add_requested_context(CTImageStorage)

    def __enter__(self):
        handlers = [
            (evt.EVT_CONN_OPEN, self._opened),
            (evt.EVT_C_ECHO, self._echo), (evt.EVT_C_FIND, self._find),
            (evt.EVT_C_GET, self._get), (evt.EVT_C_MOVE, self._move),
        ]  # fmt: skip
        self._server = self._ae.start_server(
            ("127.0.0.1" if self._tls is None else "0.0.0.0", self.port), block=False,
            evt_handlers=handlers, ssl_context=None if self._tls is None else self._tls[0],
        )  # fmt: skip
        return self

    def __exit__(self, *_):
        self._over.set()
        self._server.shutdown()
        for one in self._sockets:  # pynetdicom forgets to close where the other end has gone
            one.close()

    def _opened(self, event):
        self._sockets.append(event.assoc.dul.socket.socket)

    def settings(self, **changed) -> PacsSettings:
        given = {
            "name": "fake", "host": "127.0.0.1", "port": self.port, "title": "FAKE",
            "own_host": "127.0.0.1", "own_port": self.own_port, "timeout_s": 30.0,
        }  # fmt: skip
        return PacsSettings(**(given | changed))

    def _echo(self, event):
        if self.ill == "silent":
            self._over.wait(SILENCE_S)
        return 0x0124 if self.ill == "not authorized" else SUCCESS

    def _find(self, event):
        keys = event.identifier
        self.asked.append(keys)
        if self.ill == "slow find":
            self._over.wait(SILENCE_S)
        if self.ill == "find fails":
            yield 0xA700, None
            return
        if self.ill == "junk find":
            answer = Dataset()
            answer.PatientID = "no study UID here"
            yield PENDING, answer
            return
        level = keys.QueryRetrieveLevel
        for file in self.files if level == "IMAGE" else self.files[:1]:
            answer = Dataset()
            for element in keys:
                value = file.get(element.keyword, "")
                setattr(answer, element.keyword, value)
            answer.QueryRetrieveLevel = level
            if level != "IMAGE":
                answer.NumberOfStudyRelatedInstances = len(self.files)
                answer.NumberOfSeriesRelatedInstances = len(self.files)
            yield PENDING, answer
        if self.ill == "many":
            for number in range(500):
                answer = Dataset()
                answer.StudyInstanceUID = f"2.25.{number + 5}"
                yield PENDING, answer

    def _wanted(self, event):
        uids = event.identifier.get("SOPInstanceUID")
        if not uids:
            return self.files
        uids = [uids] if isinstance(uids, str) else list(uids)
        return [file for file in self.files if file.SOPInstanceUID in uids]

    def _send(self, event):
        wanted = self._wanted(event)
        if self.ill == "get fails":
            yield 1
            yield 0xA702, None
            return
        yield len(wanted) * (2 if self.ill == "too much" else 1)
        if self.ill == "too much":
            wanted = [*wanted, *map(_another, wanted)]
        for index, file in enumerate(wanted):
            if self.ill == "cut" and index == 2:
                event.assoc.abort()
                return
            if self.ill == "stalls" and index == 2:
                self._over.wait(SILENCE_S)
            if self.ill == "forgets" and index == 2:
                continue
            self.sent.append(file.SOPInstanceUID)
            yield PENDING, self._spoilt(file, index)

    def _spoilt(self, file, index):
        if index != 2 or self.ill == "too much":
            return file
        copy = pydicom.dcmread(file.filename)
        if self.ill == "other series":
            copy.SeriesInstanceUID = "2.25.999"
        if self.ill == "other patient":
            copy.PatientID = "SOMEBODY-ELSE"
        if self.ill == "other study":
            copy.StudyInstanceUID = "2.25.998"
        if self.ill == "garbage":
            copy = Dataset()
            copy.SOPClassUID, copy.SOPInstanceUID = file.SOPClassUID, file.SOPInstanceUID
            copy.file_meta = file.file_meta
        if self.ill == "damaged":
            copy.PixelData = copy.PixelData[:10]
        return copy

    def _get(self, event):
        yield from self._send(event)

    def _move(self, event):
        if self.ill == "unknown destination" or event.move_destination != "ACUS":
            yield None, None
            return
        given = {} if self._tls is None else {"tls_args": (self._tls[1], "127.0.0.1")}
        given["evt_handlers"] = [(evt.EVT_CONN_OPEN, self._opened)]
        yield "127.0.0.1", self.own_port, given
        yield from self._send(event)
