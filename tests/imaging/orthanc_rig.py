"""A real Orthanc, started by the tests on loopback with free ports, ended by its process."""

import json
import os
import shutil
import socket
import subprocess
import time
from pathlib import Path

import pytest
from pacs_rig import free_port

from app.imaging.pacs.settings import PacsSettings

STARTS_WITHIN_S = 60.0
WEB = Path("/usr/share/orthanc/plugins/libOrthancDicomWeb.so")


def binary() -> str | None:
    """Debian puts it where a plain user's PATH does not look."""
    return shutil.which("Orthanc", path=os.environ.get("PATH", "") + ":/usr/sbin:/usr/local/sbin")


class Orthanc:
    """One archive with its own storage; anonymous, nobody but this computer may ask it.

    With `web` it speaks DICOMweb too, by Debian's plug-in.
    """

    def __init__(self, root: Path, web: bool = False) -> None:
        self.root, self.title, self._web = root, "ORTHANC", web
        self.port, self.http, self.own_port = free_port(), free_port(), free_port()

    def __enter__(self) -> "Orthanc":
        found = binary()
        if found is None:
            if os.environ.get("CI"):
                pytest.fail("Orthanc is not installed: tools/install-system installs it")
            pytest.skip("Orthanc is not installed: apt-get install orthanc")
        if self._web and not WEB.exists():
            if os.environ.get("CI"):
                pytest.fail("orthanc-dicomweb is not installed: tools/install-system installs it")
            pytest.skip("DICOMweb is not installed: apt-get install orthanc-dicomweb")
        self.root.mkdir(parents=True, exist_ok=True)
        configuration = self.root / "orthanc.json"
        configuration.write_text(json.dumps(self._document()))
        self._log = (self.root / "log.txt").open("wb")
        self._process = subprocess.Popen(
            [found, str(configuration)], stdout=self._log, stderr=subprocess.STDOUT, cwd=self.root
        )
        self._wait()
        return self

    def __exit__(self, *_: object) -> None:
        self._process.terminate()
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._log.close()

    def kill(self) -> None:
        """End it as a power cut would."""
        self._process.kill()
        self._process.wait()

    def settings(self, **changed: object) -> PacsSettings:
        given = {
            "name": "orthanc", "host": "127.0.0.1", "port": self.port, "title": self.title,
            "own_host": "127.0.0.1", "own_port": self.own_port, "timeout_s": 20.0,
        }  # fmt: skip
        return PacsSettings(**(given | changed))

    @property
    def web(self) -> str:
        """Where it speaks DICOMweb."""
        return f"http://127.0.0.1:{self.http}/dicom-web"

    def store(self, folder: Path) -> None:
        """Fill it as a scanner would (C-STORE)."""
        import pydicom
        from pynetdicom import AE

        files = [pydicom.dcmread(path) for path in sorted(folder.iterdir())]
        entity = AE("SCANNER")
        for kind, syntax in {(f.SOPClassUID, f.file_meta.TransferSyntaxUID) for f in files}:
            entity.add_requested_context(kind, syntax)
        linked = entity.associate("127.0.0.1", self.port, ae_title=self.title)
        assert linked.is_established
        statuses = [linked.send_c_store(file).Status for file in files]
        linked.release()
        assert set(statuses) == {0}

    def _document(self) -> dict[str, object]:
        return {
            "Name": "test", "StorageDirectory": str(self.root / "storage"),
            "IndexDirectory": str(self.root / "storage"),
            "DicomAet": self.title, "DicomPort": self.port, "DicomCheckCalledAet": True,
            "HttpPort": self.http, "HttpServerEnabled": True, "RemoteAccessAllowed": False,
            "AuthenticationEnabled": False, "Plugins": [str(WEB)] if self._web else [],
            "DicomAlwaysAllowEcho": True, "DicomAlwaysAllowStore": True,
            "DicomAlwaysAllowFind": False, "DicomAlwaysAllowGet": False,
            "DicomModalities": {
                "acus": {"AET": "ACUS", "Host": "127.0.0.1", "Port": self.own_port,
                         "AllowFind": True, "AllowGet": True, "AllowMove": True},
            },
        }  # fmt: skip

    def _wait(self) -> None:
        limit = time.monotonic() + STARTS_WITHIN_S
        while time.monotonic() < limit:
            if self._process.poll() is not None:
                break
            try:
                for port in (self.port, self.http):
                    socket.create_connection(("127.0.0.1", port), 1.0).close()
                return
            except OSError:
                time.sleep(0.1)
        said = (self.root / "log.txt").read_text(errors="replace")[-2000:]
        pytest.fail(f"Orthanc did not start:\n{said}")
