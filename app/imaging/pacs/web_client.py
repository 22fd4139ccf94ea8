"""Asking an archive by DICOMweb: QIDO-RS finds, WADO-RS fetches (PS3.18 10.6 and 10.4).

It may take of time, memory and disk what a PACS may, and every picture is checked as one of a PACS.
"""

from __future__ import annotations

import mmap
import re
import time
from collections.abc import Iterator, Mapping
from contextlib import closing
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote, urlencode
from uuid import uuid4

from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.web import WebAnswer
from app.imaging.pacs.encryption import client_context
from app.imaging.pacs.errors import PacsDataError, PacsError, PacsUnreachableError
from app.imaging.pacs.incoming import MOST_PICTURES, Incoming, PictureCounter
from app.imaging.pacs.limits import LARGEST_PICTURE, SPOOLED, RequestLimits
from app.imaging.pacs.query import (
    MOST_STUDIES,
    SERIES_WANTED,
    STUDY_WANTED,
    FoundSeries,
    FoundStudy,
    Query,
    by_number,
    found_series,
    found_study,
    newest_first,
)
from app.imaging.pacs.settings import PacsSettings
from app.imaging.pacs.web import WebArchive, document_of

_JSON: Final = {"Accept": "application/dicom+json"}
_ONE: Final = {"Accept": 'multipart/related; type="application/dicom"; transfer-syntax=*'}
_UID: Final = re.compile(r"[0-9.]{1,64}")
_NOBODY: Final = "2.25.0"
_PAGE: Final = 1000
_HEAD: Final = 4096
"""Bytes within which the head of the one part of an answer ends."""


class WebPacs:
    """One archive by the web, read only.

    Args:
        settings: where it is and who we are.

    Raises:
        ConfigurationError: if they do not say where it speaks DICOMweb, or a file of the encryption
            cannot be used.
    """

    def __init__(self, settings: PacsSettings) -> None:
        self.settings = settings
        self._archive = web_archive(settings)

    def echo(self, progress: Progress | None = None) -> float:
        """Ask for a study that nobody has; return the time of the answer [s].

        Raises:
            PacsError: as `WebArchive.ask`, or the answer is a failure.
        """
        start = time.perf_counter()
        limits = RequestLimits(self.settings, progress or Progress())
        self._asked((), {"StudyInstanceUID": _NOBODY, "limit": "1"}, limits)
        return time.perf_counter() - start

    def find_studies(self, query: Query, progress: Progress | None = None) -> list[FoundStudy]:
        """Return the studies that match, newest first.

        Raises:
            PacsError: as `WebArchive.ask`; or there are more than 200 of them.
        """
        asked = {
            "StudyInstanceUID": query.study_uid,
            "StudyDate": query.date,
            "PatientID": query.patient_id,
            "PatientName": query.name,
            "AccessionNumber": query.accession,
            "ModalitiesInStudy": query.modality,
        }
        wanted = {name: value for name, value in asked.items() if value}
        wanted |= {"includefield": ",".join(STUDY_WANTED), "limit": str(MOST_STUDIES + 1)}
        limits = RequestLimits(self.settings, progress or Progress())
        return newest_first(found_study(answer) for answer in self._asked((), wanted, limits))

    def find_series(
        self, study: FoundStudy, modality: str = "CT", progress: Progress | None = None
    ) -> list[FoundSeries]:
        """Return the series of a study, by number.

        Raises:
            PacsError: as `WebArchive.ask`.
        """
        wanted = {"Modality": modality} if modality else {}
        wanted |= {"includefield": ",".join(SERIES_WANTED)}
        limits = RequestLimits(self.settings, progress or Progress())
        path = (self._uid(study.uid), "series")
        answers = self._asked(path, wanted, limits)
        return by_number(found_series(answer, study) for answer in answers)

    def retrieve(
        self, study_uid: str, series_uid: str, incoming: Incoming, progress: Progress
    ) -> None:
        """Fetch what has not come yet of a series, one picture after the other.

        Raises:
            PacsError: it refuses, falls silent, sends something else, or not everything. What has
                come stays in `incoming`, and the next call fetches the rest only.
            Cancelled: if `progress` was cancelled; likewise.
        """
        limits = RequestLimits(self.settings, progress, incoming.folder)
        with closing(limits):
            path = (self._uid(study_uid), "series", self._uid(series_uid), "instances")
            listed = dict(self._listed(path, limits))
            if not listed:
                raise PacsDataError(
                    sentence("{settings_name} has no such study or series", settings_name=self.name)
                )
            incoming.expect(listed)
            counter = PictureCounter(progress.part(0.05, 1.0), len(listed), incoming)
            for uid, kind in listed.items():
                if not incoming.has(uid):
                    self._take((*path, self._uid(uid)), kind, uid, incoming, limits)
                    incoming.require_right(self.name)
                    counter.arrived()
                    limits.check()

    @property
    def name(self) -> str:
        """Return what the archive is called here."""
        return self.settings.name

    def _listed(self, path: tuple[str, ...], limits: RequestLimits) -> Iterator[tuple[str, str]]:
        """Yield instances and their classes, a page at a time.

        An archive may give less than a page, or all of it whatever page is asked for.
        """
        known: set[str] = set()
        while len(known) <= MOST_PICTURES:
            page = {"limit": str(_PAGE), "offset": str(len(known))}
            answers = self._asked(path, page, limits)
            before = len(known)
            for answer in answers:
                uid = str(answer.get("SOPInstanceUID"))
                known.add(uid)
                yield uid, str(answer.get("SOPClassUID"))
            if len(known) == before:
                return
        raise PacsDataError(
            sentence(
                "{name} lists more than {most_pictures} pictures",
                name=self.name,
                most_pictures=MOST_PICTURES,
            )
        )

    def _take(
        self,
        path: tuple[str, ...],
        kind: str,
        uid: str,
        incoming: Incoming,
        limits: RequestLimits,
    ) -> None:
        """Fetch one picture and have it checked."""
        come = incoming.folder / f"{uuid4().hex}{SPOOLED}"
        part = come.with_suffix(f".part{SPOOLED}")
        try:
            with come.open("wb") as file:

                def count(size: int) -> None:
                    limits.count(size, is_picture=True)
                    limits.require_room()
                    if file.tell() > LARGEST_PICTURE:
                        limits.fail(sentence("it sent a picture that is too large"))

                try:
                    address = self._archive.address(*path)
                    answer = self._archive.fetch(address, _ONE, file, limits.over, count)
                except PacsUnreachableError as error:
                    raise self._ended(limits, error) from error
            self._require(answer)
            if _only_part(come, answer, part):
                incoming.take(kind, uid, part)
            else:
                incoming.problems.append(
                    sentence("it sent something else than one picture for one picture")
                )
        finally:
            come.unlink(missing_ok=True)
            part.unlink(missing_ok=True)

    def _asked(
        self, path: tuple[str, ...], wanted: Mapping[str, str], limits: RequestLimits
    ) -> list[_Answer]:
        # wildcards and carets as they are: Orthanc looks for "%2A"
        query = urlencode(wanted, safe="*?,^", quote_via=quote)
        address = f"{self._archive.address(*path)}?{query}"
        try:
            answer = self._archive.ask("GET", address, _JSON, over=limits.over)
        except PacsUnreachableError as error:
            raise self._ended(limits, error) from error
        if answer.status == 204:
            return []
        self._require(answer)
        document = document_of(answer)
        if not isinstance(document, list) or not all(isinstance(one, dict) for one in document):
            raise PacsDataError(
                sentence(
                    "{name} does not answer as an archive by the web: its address must be the one "
                    "before /studies",
                    name=self.name,
                )
            )
        return [_Answer(one) for one in document]

    def _require(self, answer: WebAnswer) -> None:
        if answer.status in (404, 410):
            raise PacsDataError(
                sentence("{settings_name} has no such study or series", settings_name=self.name)
            )
        if answer.status != 200:
            raise PacsError(
                sentence(
                    "{name} refuses with {status}; try again, and ask who runs it if it stays",
                    name=self.name,
                    status=answer.status,
                )
            )

    def _ended(self, limits: RequestLimits, error: PacsUnreachableError) -> PacsError:
        """Return why a request was cut; raise where it was cancelled."""
        limits.check()
        if limits.problem:
            return PacsDataError(
                sentence(
                    "{settings_name}: {limits_problem}; nothing was taken into the library",
                    settings_name=self.name,
                    limits_problem=limits.problem,
                )
            )
        return error

    def _uid(self, uid: str) -> str:
        if not _UID.fullmatch(uid):
            raise PacsDataError(
                sentence("{name}: {uid!r} is no UID of DICOM", name=self.name, uid=uid[:80])
            )
        return uid


class _Answer:
    """One answer in DICOM's JSON (PS3.18 annex F), read by keyword."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        self._document = document

    def get(self, keyword: str) -> str | list[str] | None:
        """Return the value of an element as text, several as a list; None where there is none."""
        from pydicom.datadict import tag_for_keyword

        element = self._document.get(f"{tag_for_keyword(keyword):08X}")
        values = element.get("Value") if isinstance(element, dict) else None
        texts = [_text(value) for value in values if value] if isinstance(values, list) else []
        return texts if len(texts) > 1 else next(iter(texts), None)


def _text(value: object) -> str:
    return str(value.get("Alphabetic", "")) if isinstance(value, dict) else str(value)


def _only_part(file: Path, answer: WebAnswer, part: Path) -> bool:
    """Write the one part of an answer to a file of its own; return False where it is not one.

    A server may also send the object without any parts around it.
    """
    kind = answer.headers.get("Content-Type", "")
    with file.open("rb") as opened:
        if not kind.lower().startswith("multipart/"):
            _copied(opened.read, part)
            return part.stat().st_size > 0
        matched = re.search(r'boundary="?([^";,]{1,70})"?', kind)
        if matched is None or file.stat().st_size == 0:
            return False
        mark = b"--" + matched.group(1).encode("latin-1", "replace")
        with mmap.mmap(opened.fileno(), 0, access=mmap.ACCESS_READ) as data:
            first = data.find(mark, 0, _HEAD)
            start = data.find(b"\r\n\r\n", first, _HEAD) + 4 if first >= 0 else 3
            end = data.find(b"\r\n" + mark, start)
            if start < 4 or end < 0 or data[end + 2 + len(mark) :][:2] != b"--":
                return False
            opened.seek(start)
            left = end - start

            def read(size: int) -> bytes:
                nonlocal left
                piece = opened.read(min(size, left))
                left -= len(piece)
                return piece

            _copied(read, part)
    return True


def _copied(read: Any, part: Path) -> None:
    with part.open("wb") as written:
        while piece := read(1 << 20):
            written.write(piece)


def web_archive(settings: PacsSettings) -> WebArchive:
    """Return an archive by the web of its settings.

    Raises:
        ConfigurationError: if they do not say where it is.
    """
    if settings.web is None:
        raise ConfigurationError(
            sentence(
                "PACS {name} has no web address: `acus pacs add {name} --web https://…`",
                name=settings.name,
            )
        )
    web = settings.web
    context = client_context(settings)
    return WebArchive(
        web.url, web.user, web.password, settings.timeout_s, context, known_as=settings.name
    )
