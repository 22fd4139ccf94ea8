"""A series de-identified into a folder, in the worker process: the originals are foreign files."""

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from app.core.descriptors import hold
from app.core.progress import Cancelled, Progress
from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.privacy import dates
from app.imaging.privacy.actions import Rules
from app.imaging.privacy.burned_in import Box, check_numbers, of_picture
from app.imaging.privacy.deidentified import LOCK, Deidentified, file_name
from app.imaging.privacy.errors import PrivacyError
from app.imaging.privacy.files import convert, read_original
from app.imaging.privacy.key import installation_key
from app.imaging.privacy.profile import profile
from app.imaging.privacy.pseudonyms import patient_pseudonym, pseudonym
from app.imaging.privacy.report import Tally
from app.imaging.privacy.uids import UidMap
from app.imaging.privacy.verify import Secrets, verify

_Made = TypeVar("_Made")


def deidentify_series(
    headers: tuple[SliceHeader, ...],
    key: str,
    staging: Path,
    boxes: tuple[Box, ...],
    settings: Path,
    progress: Progress,
) -> Deidentified:
    """Job of the worker: write every file of a series anew and look through what was written.

    Args:
        headers: one for each file, in the order of the series.
        key: of the series, see `Series.key`.
        staging: folder to write to; it holds a lock file.
        boxes: pixels to blacken.
        settings: folder with the key of the pseudonyms.
        progress: told of each file.

    Raises:
        PrivacyError, FileDamagedError: naming a file by its number only; quoting nothing of it.
        OSError: if a file cannot be written.
    """
    os.environ["ACUS_SETTINGS"] = str(settings)
    with _held(staging):
        return _deidentified(headers, key, staging, boxes, progress)


@contextmanager
def _held(staging: Path) -> Iterator[None]:
    """Hold the lock of the folder too: nobody sweeps it while there is still somebody writing."""
    lock = os.open(staging / LOCK, os.O_RDWR)
    try:
        hold(lock)
        yield
    finally:
        os.close(lock)


def _deidentified(
    headers: Sequence[SliceHeader],
    key: str,
    staging: Path,
    boxes: Sequence[Box],
    progress: Progress,
) -> Deidentified:
    count = len(headers)
    progress.report(0.0, f"file 1 of {count}")
    check_numbers(boxes, count)
    rules = _counted(1, count, lambda: _rules(headers[0]))
    secrets, tally, digests = Secrets(rules.profile), Tally(), []
    for number, header in enumerate(headers, 1):
        progress.report(0.7 * (number - 1) / count, f"file {number} of {count}")
        to, drawn = staging / file_name(number), of_picture(boxes, number)
        write = _writer(header, to, rules, drawn, secrets, tally)
        digests.append(_counted(number, count, write))
    for number, digest in enumerate(digests, 1):
        share = 0.7 + 0.3 * (number - 1) / count
        progress.report(share, f"checking file {number} of {count}")
        verify(staging / file_name(number), secrets, rules.uids.old, digest)
    return Deidentified(tally.report(), rules.study, rules.uids.new(key))


def _writer(
    header: SliceHeader, to: Path, rules: Rules, boxes: Sequence[Box], secrets: Secrets,
    tally: Tally,
) -> Callable[[], str]:  # fmt: skip
    return lambda: convert(header, to, rules, boxes, secrets, tally)


def _counted(number: int, count: int, work: Callable[[], _Made]) -> _Made:
    """Name a file by its number: the names of files and folders may tell who the patient is."""
    try:
        return work()
    except Cancelled:
        raise
    except (PrivacyError, FileDamagedError) as error:
        raise type(error)(f"file {number} of {count}: {error}") from None


def _rules(first: SliceHeader) -> Rules:
    original = read_original(first)
    key = installation_key()
    patient = str(original.get("PatientID", "") or "").strip(" \0")
    study = str(original.get("StudyInstanceUID", "") or "").strip(" \0")
    return Rules(
        profile(),
        UidMap(key),
        dates.shift_of(key, patient, study),
        patient_pseudonym(key, patient, study),
        pseudonym(patient, study),
    )
