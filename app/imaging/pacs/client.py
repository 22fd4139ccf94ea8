"""Asking a PACS: is it there, what has it, send this series. Nothing is ever written to it."""

import time
from collections.abc import Iterator, Sequence
from contextlib import closing
from typing import Any

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.pacs import statuses
from app.imaging.pacs.association import association, lost, network, receiving, require
from app.imaging.pacs.errors import PacsDataError, PacsError
from app.imaging.pacs.incoming import (
    COMPRESSED,
    MOST_PICTURES,
    PLAIN,
    STORAGE_CLASSES,
    Incoming,
    PictureCounter,
    handler,
)
from app.imaging.pacs.limits import RequestLimits
from app.imaging.pacs.query import (
    FoundSeries,
    FoundStudy,
    Query,
    by_number,
    found_series,
    found_study,
    image_keys,
    newest_first,
    series_keys,
    study_keys,
    wanted_keys,
)
from app.imaging.pacs.settings import PacsSettings

_VERIFICATION = "1.2.840.10008.1.1"
_FIND = "1.2.840.10008.5.1.4.1.2.2.1"
_MOVE = "1.2.840.10008.5.1.4.1.2.2.2"
_GET = "1.2.840.10008.5.1.4.1.2.2.3"


class Pacs:
    """One PACS, read only; every call is one connection of its own.

    Args:
        settings: where it is and who we are.
    """

    def __init__(self, settings: PacsSettings) -> None:
        self.settings = settings

    def echo(self, progress: Progress | None = None) -> float:
        """Ask whether it is there (C-ECHO); returns the time of the answer [s].

        Raises:
            PacsError: see `association`, or the answer is a failure.
        """
        with association(self.settings, [(_VERIFICATION, ())], progress or Progress()) as linked:
            start = time.perf_counter()
            require(linked, linked.send_c_echo(), self.settings, "being asked whether it is there")
            return time.perf_counter() - start

    def find_studies(self, query: Query, progress: Progress | None = None) -> list[FoundStudy]:
        """Return the studies that match, newest first.

        Raises:
            PacsError: see `association`; or there are more than 200 of them.
        """
        with association(self.settings, [(_FIND, ())], progress or Progress()) as linked:
            answers = self._answers(linked, study_keys(query), "looking for studies")
            return newest_first(found_study(answer) for answer in answers)

    def find_series(
        self, study: FoundStudy, modality: str = "CT", progress: Progress | None = None
    ) -> list[FoundSeries]:
        """Return the series of a study, by number.

        Raises:
            PacsError: see `association`.
        """
        with association(self.settings, [(_FIND, ())], progress or Progress()) as linked:
            keys = series_keys(study.uid, modality)
            answers = self._answers(linked, keys, "looking for series")
            return by_number(found_series(answer, study) for answer in answers)

    def instances(
        self,
        study_uid: str,
        series_uid: str,
        progress: Progress,
        limits: RequestLimits | None = None,
    ) -> tuple[str, ...]:
        """Return the SOPInstanceUIDs of a series; empty where the PACS does not list them.

        Raises:
            PacsDataError: if it has no such series, or lists more than any has.
            PacsError: see `association`.
        """
        with association(self.settings, [(_FIND, ())], progress, limits=limits) as linked:
            keys = image_keys(study_uid, series_uid)
            answers = self._answers(linked, keys, "listing the pictures")
            found = [str(answer.get("SOPInstanceUID", "")) for answer in answers]
            keys = series_keys(study_uid, "", series_uid)
            known = found or list(self._answers(linked, keys, "looking for the series"))
        if not known:
            raise PacsDataError(
                sentence(
                    "{settings_name} has no such study or series", settings_name=self.settings.name
                )
            )
        return tuple(dict.fromkeys(uid for uid in found if uid))

    def retrieve(
        self, study_uid: str, series_uid: str, incoming: Incoming, progress: Progress
    ) -> None:
        """Fetch what has not come yet of a series, by C-GET or C-MOVE as configured.

        Raises:
            PacsError: it refuses, falls silent, sends something else, or not everything. What has
                come stays in `incoming`, and the next call fetches the rest only.
            Cancelled: if `progress` was cancelled; likewise.
        """
        limits = RequestLimits(self.settings, progress, incoming.folder)
        with closing(limits):
            self._retrieve(study_uid, series_uid, incoming, progress, limits)

    def _retrieve(
        self,
        study_uid: str,
        series_uid: str,
        incoming: Incoming,
        progress: Progress,
        limits: RequestLimits,
    ) -> None:
        listed = self.instances(study_uid, series_uid, progress.part(0.0, 0.05), limits)
        incoming.expect(listed)
        missing = tuple(uid for uid in listed if not incoming.has(uid))
        if listed and not missing:
            return
        part = () if len(missing) == len(listed) else missing
        counter = PictureCounter(progress.part(0.05, 1.0), len(listed), incoming)
        keys = wanted_keys(study_uid, series_uid, part)
        fetch = self._move if self._moves() else self._get
        try:
            failed = fetch(keys, counter, limits)
        except PacsError:
            incoming.require_right(
                self.settings.name
            )  # what was wrong says more than that it was ended
            raise
        self._check(listed, incoming, failed, tuple(limits.strangers))

    def _moves(self) -> bool:
        return self.settings.retrieve == "move"

    def _get(self, keys: Any, counter: PictureCounter, limits: RequestLimits) -> int:
        pynetdicom = network()
        contexts: list[tuple[str, Sequence[str]]] = [(_GET, ())]
        contexts += [(kind, PLAIN) for kind in STORAGE_CLASSES]
        contexts += [(kind, (one,)) for kind in STORAGE_CLASSES[:1] for one in COMPRESSED]
        roles = [pynetdicom.build_role(kind, scp_role=True) for kind in STORAGE_CLASSES]
        handlers = [(pynetdicom.evt.EVT_C_STORE, handler(counter.incoming, counter, limits))]
        asked = (self.settings, contexts, counter.progress, roles, handlers, limits)
        with association(*asked) as linked:
            return self._follow(linked.send_c_get(keys, _GET), linked, counter)

    def _move(self, keys: Any, counter: PictureCounter, limits: RequestLimits) -> int:
        asked = (self.settings, [(_MOVE, ())], counter.progress)
        with (
            receiving(self.settings, counter.incoming, counter, limits),
            association(*asked, limits=limits) as linked,
        ):
            own = self.settings.own_title
            return self._follow(linked.send_c_move(keys, own, _MOVE), linked, counter)

    def _follow(self, answers: Any, linked: Any, counter: PictureCounter) -> int:
        """Read the answers of a retrieval; returns how many pictures the PACS failed to send."""
        for status, _ in answers:
            code = require(linked, status, self.settings, "sending the pictures")
            if code not in statuses.PENDING:
                if code == statuses.CANCELLED:
                    raise PacsError(
                        sentence(
                            "{settings_name} cancelled the retrieval",
                            settings_name=self.settings.name,
                        )
                    )
                return int(status.get("NumberOfFailedSuboperations", 0) or 0)
        raise lost(self.settings, sentence("sending the pictures"))

    def _check(
        self, listed: tuple[str, ...], incoming: Incoming, failed: int, strangers: tuple[str, ...]
    ) -> None:
        name = self.settings.name
        incoming.require_right(self.settings.name)
        refused = ""
        if strangers:
            refused = (
                f"; a connection from {', '.join(strangers)} was refused: pictures are taken from "
                f"{self.settings.host} only; list it under senders if it is the archive's"
            )
        missing = sum(not incoming.has(uid) for uid in listed)
        if missing or failed:
            raise PacsDataError(
                sentence(
                    "{name} did not send {missing_pictures} of {listed_pictures} pictures; "
                    "repeat the retrieval: only those are fetched{refused}",
                    name=name,
                    missing_pictures=max(missing, failed),
                    listed_pictures=len(listed) or "the",
                    refused=refused,
                )
            )
        if incoming.count() == 0:
            raise PacsDataError(
                sentence("{name} sent nothing{refused}", name=name, refused=refused)
            )

    def _answers(self, linked: Any, keys: Any, doing: str) -> Iterator[Any]:
        given = 0
        for status, answer in linked.send_c_find(keys, _FIND):
            code = require(linked, status, self.settings, doing)
            if code in statuses.PENDING and answer is not None:
                given += 1
                if given > MOST_PICTURES:
                    raise PacsDataError(
                        sentence(
                            "{settings_name} gave more than {most_pictures} answers while {doing}",
                            settings_name=self.settings.name,
                            most_pictures=MOST_PICTURES,
                            doing=doing,
                        )
                    )
                yield answer
