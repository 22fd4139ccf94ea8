"""Files that a PACS sends: checked one by one, kept aside until they are de-identified.

They still carry the patient's data, so their folder is readable by its owner only, is named by a
digest, and is deleted as soon as the series is in the library, or after a day.
"""

import filecmp
import os
import shutil
import threading
import time
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path
from typing import Any

import pydicom

from app.core import paths
from app.core.files import sync
from app.core.messages import sentence
from app.core.progress import Cancelled, Progress
from app.imaging.errors import FileDamagedError, WorkerError
from app.imaging.pacs.errors import PacsDataError
from app.imaging.pacs.limits import LARGEST_PICTURE, SPARE_BYTES, SPOOLED, RequestLimits
from app.imaging.pacs.settings import PacsSettings
from app.imaging.privacy.key import derived, installation_key
from app.imaging.worker.jobs import Job
from app.imaging.worker.limits import PACKAGE_SECONDS, for_file, size_of
from app.imaging.worker.pool import shared_worker

Identity = tuple[str, str, str, str, str]
_IDENTIFY: Job[Identity] = Job(f"{__name__}:identity", Identity)
_IDENTITY = (
    "SOPClassUID",
    "SOPInstanceUID",
    "SeriesInstanceUID",
    "StudyInstanceUID",
    "PatientID",
)


def identity(path: Path, progress: Progress) -> tuple[str, str, str, str, str]:
    """Job of the worker: class, instance, series, study and patient of a file, "" if not said."""
    head = pydicom.dcmread(path, stop_before_pixels=True, specific_tags=list(_IDENTITY))
    kind, instance, series, study, patient = (str(head.get(name, "") or "") for name in _IDENTITY)
    return kind, instance, series, study, patient


ACCEPTED = 0x0000
NO_ROOM = 0xA700
WRONG_CLASS = 0xA900
NOT_UNDERSTOOD = 0xC000
STORAGE_CLASSES = (
    "1.2.840.10008.5.1.4.1.1.2",  # CT
    "1.2.840.10008.5.1.4.1.1.2.1",  # enhanced CT
    "1.2.840.10008.5.1.4.1.1.2.2",  # legacy converted enhanced CT
    "1.2.840.10008.5.1.4.1.1.4",  # MR
)
PLAIN = ("1.2.840.10008.1.2.1", "1.2.840.10008.1.2")
COMPRESSED = (
    "1.2.840.10008.1.2.4.57",
    "1.2.840.10008.1.2.4.70",
    "1.2.840.10008.1.2.4.80",
    "1.2.840.10008.1.2.4.81",
    "1.2.840.10008.1.2.4.90",
    "1.2.840.10008.1.2.4.91",
    "1.2.840.10008.1.2.5",
    "1.2.840.10008.1.2.4.50",
    "1.2.840.10008.1.2.4.51",
    "1.2.840.10008.1.2.1.99",
    "1.2.840.10008.1.2.2",
)
_KEPT_S = 24 * 3600.0
MOST_PICTURES = 20_000
"""Pictures of one series; no scanner makes more."""


class Incoming:
    """Files of one series on their way in; they stay after a failure, to be resumed.

    Args:
        settings: of the PACS they come from.
        series_uid: SeriesInstanceUID that was asked for.
        study_uid: StudyInstanceUID that was asked for; any where empty.
    """

    def __init__(self, settings: PacsSettings, series_uid: str, study_uid: str = "") -> None:
        key = installation_key()
        name = derived(key, "incoming", settings.title, settings.host, series_uid).hex()[:16]
        self.series_uid, self.study_uid = series_uid, study_uid
        self._listed: frozenset[str] = frozenset()
        self._patient: str | None = None  # of the first picture; the others must be of the same
        self.folder = _root() / name
        self._key, self._lock = key, threading.Lock()
        self._again = 0
        self.problems: list[str] = []

    def open(self) -> "Incoming":
        """Make the folder, and delete what others left behind a day ago or more."""
        sweep()
        self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        os.utime(self.folder)
        for path in self.folder.glob(f"*{SPOOLED}"):  # of a program that was killed
            path.unlink(missing_ok=True)
        for path in sorted(self.folder.glob("*.dcm"))[:1]:
            self._patient = self._said(path)[4]
        return self

    def expect(self, listed: Collection[str]) -> None:
        """Refuse instances that the PACS has not listed; where it lists none, all are taken."""
        self._listed = frozenset(listed)

    def has(self, sop_uid: str) -> bool:
        """Return whether an instance has come, now or at an earlier try."""
        return self._path(sop_uid).exists()

    def count(self) -> int:
        """Return how many instances have come."""
        return sum(1 for _ in self.folder.glob("*.dcm"))

    def take(self, sop_class: str, sop_uid: str, file: Path) -> int:
        """Check one file and keep it; returns the status to answer with.

        What was not asked for is refused before it is looked at. After a problem nothing more is
        taken; a picture that has come already stays as it is.

        Args:
            sop_class: as the request names it.
            sop_uid: as the request names it.
            file: the whole file, in any folder of the same disk; it is moved, or left there.
        """
        with self._lock:
            if self.problems:
                return NOT_UNDERSTOOD
            status, problem = self._room(sop_class, sop_uid, file)
            if not problem and self.has(sop_uid):
                status, problem = self._repeated(sop_uid, file)
            elif not problem:
                status, problem = self._kept(sop_class, sop_uid, file)
            if problem:
                self.problems.append(problem)
        return status

    def require_right(self, sender: str) -> None:
        """Do nothing where all that came was right.

        Args:
            sender: name of the archive, for the message.

        Raises:
            PacsDataError: saying what was wrong.
        """
        if self.problems:
            raise PacsDataError(
                sentence(
                    "{settings_name}: {problem}; nothing was taken into the library",
                    settings_name=sender,
                    problem=self.problems[0],
                )
            ) from None

    def forget(self) -> None:
        """Delete everything that has come; idempotent."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def _room(self, sop_class: str, sop_uid: str, file: Path) -> tuple[int, str]:
        if sop_class not in STORAGE_CLASSES:
            return WRONG_CLASS, sentence("it sent an object that is no CT or MR picture")
        if self._listed and sop_uid not in self._listed:
            return WRONG_CLASS, sentence("it sent a picture that it had not listed")
        if not self._listed and self.count() >= MOST_PICTURES:
            return WRONG_CLASS, sentence(
                "it sent more than {most_pictures} pictures", most_pictures=MOST_PICTURES
            )
        if size_of(file) > LARGEST_PICTURE:
            return NO_ROOM, sentence(
                "it sent a file of more than {largest_picture} GB",
                largest_picture=LARGEST_PICTURE // 1024**3,
            )
        if shutil.disk_usage(self.folder).free < SPARE_BYTES:
            return NO_ROOM, sentence("the disk is full")
        return ACCEPTED, ""

    def _repeated(self, sop_uid: str, file: Path) -> tuple[int, str]:
        """Leave what has come as it is; the same once more is no harm, another one is."""
        self._again += 1
        if not filecmp.cmp(file, self._path(sop_uid), shallow=False):
            return WRONG_CLASS, sentence("it sent two different pictures under one name")
        if self._again > max(len(self._listed), self.count()):
            return WRONG_CLASS, sentence("it sent the same pictures again and again")
        return ACCEPTED, ""

    def _kept(self, sop_class: str, sop_uid: str, file: Path) -> tuple[int, str]:
        """Have a file looked at, and move it to its place if it is right."""
        try:
            status, problem = self._judged(file, sop_class, sop_uid)
            if not problem:
                sync(file)
                os.replace(file, self._path(sop_uid))
            return status, problem
        except OSError as error:
            return NO_ROOM, sentence(
                "a picture cannot be kept: {error_strerror}",
                error_strerror=error.strerror or "disk error",
            )

    def _judged(self, path: Path, sop_class: str, sop_uid: str) -> tuple[int, str]:
        try:
            said = self._said(path)
        except FileDamagedError:  # whatever bytes came, they are no DICOM data set
            return NOT_UNDERSTOOD, sentence("it sent something that is no DICOM data set")
        except WorkerError as error:
            return NO_ROOM, str(error)
        problem = self._mistaken(sop_class, sop_uid, said)
        return (WRONG_CLASS, problem) if problem else (ACCEPTED, "")

    def _said(self, path: Path) -> Identity:
        allowed = for_file(size_of(path), least=PACKAGE_SECONDS)
        return shared_worker().call(_IDENTIFY, (path.absolute(),), allowed, Progress())

    def _mistaken(self, sop_class: str, sop_uid: str, answer: Identity) -> str:
        """Say what of a picture's identity is not what was asked for; empty where all is."""
        if answer[:2] != (sop_class, sop_uid):
            return sentence("it sent a picture under another one's name")
        if answer[2] != self.series_uid:
            return sentence("it sent a picture of another series")
        if self.study_uid and answer[3] != self.study_uid:
            return sentence("it sent a picture of another study")
        if self._patient not in (None, answer[4]):
            return sentence("it sent pictures of several patients")
        self._patient = answer[4]
        return ""

    def _path(self, sop_uid: str) -> Path:
        return self.folder / f"{derived(self._key, 'instance', sop_uid).hex()[:24]}.dcm"


class PictureCounter:
    """Progress of a retrieval, counted in pictures.

    Args:
        progress: told.
        total: pictures of the series; 0 where nobody knows.
        incoming: takes them.
    """

    def __init__(self, progress: Progress, total: int, incoming: Incoming) -> None:
        self.progress, self.incoming, self._total = progress, incoming, total
        self._done = incoming.count()

    def arrived(self) -> None:
        """Count one more picture; a cancel is met by whoever waits for pictures, not here."""
        self._done += 1
        share = self._done / self._total if self._total else 0.5
        with suppress(Cancelled):  # the network library would swallow it: the watcher acts on it
            self.progress.report(
                min(share, 1.0),
                sentence(
                    "{ready} of {total} pictures received", ready=self._done, total=self._total
                )
                if self._total
                else sentence("{ready} pictures received", ready=self._done),
            )


def sweep(now: float | None = None) -> int:
    """Delete what was retrieved a day ago or more and never finished; returns how many."""
    limit = (time.time() if now is None else now) - _KEPT_S
    old = [folder for folder in _root().glob("*") if folder.stat().st_mtime < limit]
    for folder in old:
        shutil.rmtree(folder, ignore_errors=True)
    return len(old)


def handler(incoming: Incoming, progress: Any, limits: RequestLimits) -> Any:
    """Return pynetdicom's handler of a C-STORE request; the first problem ends the request."""

    def store(event: Any) -> int:
        request = event.request
        file = Path(event.dataset_path)
        try:
            status = incoming.take(
                str(request.AffectedSOPClassUID), str(request.AffectedSOPInstanceUID), file
            )
        finally:
            file.unlink(missing_ok=True)
        if incoming.problems:
            limits.fail(incoming.problems[0])
        progress.arrived()
        return status

    return store


def _root() -> Path:
    return paths.data() / "incoming"
