"""Questions to a PACS and what it finds (PS3.4 C.6.2, study root)."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice
from typing import Any

from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.imaging.pacs.errors import PacsError

_DATES = re.compile(r"(\d{8})?(-(\d{8})?)?")
STUDY_WANTED = (
    "StudyInstanceUID",
    "StudyDate",
    "StudyTime",
    "AccessionNumber",
    "PatientName",
    "PatientID",
    "PatientBirthDate",
    "StudyDescription",
    "ModalitiesInStudy",
    "NumberOfStudyRelatedInstances",
)
SERIES_WANTED = (
    "SeriesInstanceUID",
    "SeriesNumber",
    "Modality",
    "SeriesDescription",
    "BodyPartExamined",
    "NumberOfSeriesRelatedInstances",
)


@dataclass(frozen=True, slots=True)
class Query:
    """What to look for; empty fields match everything.

    Attributes:
        patient_id: PatientID, `*` and `?` as wildcards.
        name: patient's name, with wildcards.
        date: of the study, `YYYYMMDD` or a range `YYYYMMDD-YYYYMMDD`, open at either end.
        accession: accession number.
        modality: of the series.
        study_uid: one study.
    """

    patient_id: str = ""
    name: str = ""
    date: str = ""
    accession: str = ""
    modality: str = "CT"
    study_uid: str = ""

    def __post_init__(self) -> None:
        if not _DATES.fullmatch(self.date):
            raise ConfigurationError(
                sentence(
                    "date {date!r}: use YYYYMMDD, or a range YYYYMMDD-YYYYMMDD", date=self.date
                )
            )
        if not (self.patient_id or self.name or self.date or self.accession or self.study_uid):
            raise ConfigurationError(
                sentence(
                    "say what to look for: a patient, a date, an accession number or a study; a "
                    "list of everything would be thousands of patients"
                )
            )


@dataclass(frozen=True, slots=True)
class FoundStudy:
    """A study as the PACS lists it. Names are for the screen in front of the instructor only."""

    uid: str
    date: str
    patient_name: str
    patient_id: str
    birth_date: str
    description: str
    modalities: tuple[str, ...]
    instances: int | None


@dataclass(frozen=True, slots=True)
class FoundSeries:
    """A series as the PACS lists it, with its study."""

    uid: str
    study: FoundStudy
    number: str
    modality: str
    description: str
    body_part: str
    instances: int | None


MOST_STUDIES = 200


def newest_first(studies: Iterable[FoundStudy]) -> list[FoundStudy]:
    """Return studies as they are listed; no more is read than may be.

    Raises:
        PacsError: if there are more than 200 of them.
    """
    result = list(islice(studies, MOST_STUDIES + 1))
    if len(result) > MOST_STUDIES:
        raise PacsError(
            sentence(
                "more than {most_studies} studies match; narrow the search by date or patient",
                most_studies=MOST_STUDIES,
            )
        )
    return sorted(result, key=lambda study: study.date, reverse=True)


def by_number(series: Iterable[FoundSeries]) -> list[FoundSeries]:
    """Return series as they are listed."""
    return sorted(series, key=lambda one: (len(one.number), one.number))


def study_keys(query: Query) -> Any:
    """Return the data set that asks for studies."""
    keys = _blank("STUDY", STUDY_WANTED)
    keys.StudyInstanceUID, keys.StudyDate = query.study_uid, query.date
    keys.PatientID, keys.PatientName = query.patient_id, query.name
    keys.AccessionNumber, keys.ModalitiesInStudy = query.accession, query.modality
    return keys


def series_keys(study_uid: str, modality: str, series_uid: str = "") -> Any:
    """Return the data set that asks for the series of a study, or for one of them."""
    keys = _blank("SERIES", SERIES_WANTED)
    keys.StudyInstanceUID, keys.Modality = study_uid, modality
    keys.SeriesInstanceUID = series_uid
    return keys


def image_keys(study_uid: str, series_uid: str) -> Any:
    """Return the data set that asks for the instances of a series."""
    keys = _blank("IMAGE", ("SOPInstanceUID",))
    keys.StudyInstanceUID, keys.SeriesInstanceUID = study_uid, series_uid
    return keys


def wanted_keys(study_uid: str, series_uid: str, instances: tuple[str, ...] = ()) -> Any:
    """Return the data set that asks to send a series, or some of its instances."""
    keys = _blank("IMAGE" if instances else "SERIES", ())
    keys.StudyInstanceUID, keys.SeriesInstanceUID = study_uid, series_uid
    if instances:
        keys.SOPInstanceUID = list(instances)
    return keys


def found_study(answer: Any) -> FoundStudy:
    """Read an answer at study level."""
    modalities = answer.get("ModalitiesInStudy") or ()
    if isinstance(modalities, str):
        modalities = (modalities,)
    return FoundStudy(
        _text(answer, "StudyInstanceUID"),
        _text(answer, "StudyDate"),
        _text(answer, "PatientName"),
        _text(answer, "PatientID"),
        _text(answer, "PatientBirthDate"),
        _text(answer, "StudyDescription"),
        tuple(str(one) for one in modalities),
        _count(answer, "NumberOfStudyRelatedInstances"),
    )


def found_series(answer: Any, study: FoundStudy) -> FoundSeries:
    """Read an answer at series level."""
    return FoundSeries(
        _text(answer, "SeriesInstanceUID"),
        study,
        _text(answer, "SeriesNumber"),
        _text(answer, "Modality"),
        _text(answer, "SeriesDescription"),
        _text(answer, "BodyPartExamined"),
        _count(answer, "NumberOfSeriesRelatedInstances"),
    )


def _blank(level: str, wanted: tuple[str, ...]) -> Any:
    from pydicom.dataset import Dataset

    keys = Dataset()
    keys.QueryRetrieveLevel = level
    for keyword in wanted:
        setattr(keys, keyword, "")
    return keys


def _text(answer: Any, keyword: str) -> str:
    value = answer.get(keyword)
    return "" if value is None else str(value).strip()


def _count(answer: Any, keyword: str) -> int | None:
    try:
        return int(answer.get(keyword))
    except (TypeError, ValueError):
        return None
