"""What each column of a bundle's tables means: unit, definition, source, version.

The tables are written by these declarations, and a test reads them back by them.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from app.research.series import SERIES
from app.scoring.metrics import available


class Column(NamedTuple):
    """A column of a table.

    Attributes:
        name: as in its first line.
        kind: `text`, `number`, `whole` or `yes_no` (1 or 0).
        unit: of a number; empty without one.
        definition: in words.
        source: where the value comes from.
    """

    name: str
    kind: str
    unit: str
    definition: str
    source: str


_CODE: Final = Column(
    "participant", "text", "", "code of the participant, drawn at random", "study"
)
_ATTEMPT: Final = Column(
    "attempt", "text", "", "code of the attempt; its files are named so", "study"
)

PARTICIPANTS: Final = (
    _CODE,
    Column("arm", "text", "", "arm that the participant was allocated to", "sealed list"),
    Column("stratum", "text", "", "list that the allocation was taken from", "design"),
    Column("slot", "whole", "", "place in that list, from 1", "sealed list"),
    Column("consent_version", "text", "", "version of the text consented to", "ledger"),
    Column("left", "yes_no", "", "whether the participant left the study", "ledger"),
    Column("left_day", "whole", "d", "day of leaving; day 0 is that of enrolment", "ledger"),
    Column("left_reason", "text", "", "reason as it was given", "ledger"),
    Column("withdrawn", "yes_no", "", "whether the data may not be used: there are none", "ledger"),
)

ATTEMPTS: Final = (
    _ATTEMPT,
    _CODE,
    Column("arm", "text", "", "arm of the participant", "sealed list"),
    Column("visit", "text", "", "visit in whose window the day lies; empty in none", "design"),
    Column("day", "whole", "d", "day of the attempt; day 0 is that of enrolment", "record"),
    Column("number", "whole", "", "of the attempt within participant and visit, from 1", "record"),
    Column("exercise", "text", "", "id of the exercise", "record"),
    Column("exercise_version", "whole", "", "version of the exercise", "record"),
    Column("state", "text", "", "ended, aborted, unfinished or broken", "record"),
    Column("duration_s", "number", "s", "duration without pauses", "record"),
    Column("score_total", "number", "points", "0 to 100; empty without a score", "score"),
    Column("score_sd", "number", "points", "standard deviation that the cameras leave", "score"),
    Column("passed", "yes_no", "", "whether the score passes", "score"),
    Column("void", "text", "", "why there is no score; empty if there is one", "score"),
    Column("hand", "text", "", "what held the needle", "record"),
    Column("device_kind", "text", "", "real, emulated or simulated robot, or a pen", "record"),
    Column("device", "text", "", "profile of the device", "record"),
    Column("assistance_start", "number", "", "dial that the exercise sets, -1 to 1", "record"),
    Column("assistance_mean", "number", "", "mean of the dial over time, -1 to 1", "record"),
    Column("software", "text", "", "version of Acus that recorded", "record"),
    Column("calibration", "text", "", "id of the cameras' calibration", "record"),
    Column("agreement_mm", "number", "mm", "screen and needle at the target, 95 %", "record"),
    Column("scoring_version", "whole", "", "version of the scoring rules", "score"),
    Column("series", "text", "", "file of the series; empty without one", "bundle"),
)

METRICS: Final = (
    _ATTEMPT,
    Column("metric", "text", "", "name; defined in metrics_codebook.csv", "score"),
    Column("value", "number", "see unit", "empty where it could not be computed", "score"),
    Column("unit", "text", "", "unit of value and sd", "score"),
    Column("sd", "number", "see unit", "standard deviation that the cameras leave", "score"),
    Column("utility", "number", "", "0 to 1, by the exercise's tolerances", "score"),
    Column("band", "text", "", "green, yellow or red, by the exercise's tolerances", "score"),
    Column("note", "text", "", "why there is no value", "score"),
)

ANSWERS: Final = (
    _CODE,
    Column("visit", "text", "", "visit that the answers belong to", "ledger"),
    Column("questionnaire", "text", "", "id of the questionnaire", "ledger"),
    Column("questionnaire_version", "text", "", "version of the questionnaire", "ledger"),
    Column("item", "text", "", "item, or a score that its rule makes", "ledger"),
    Column("value", "number", "points", "answer, or score", "ledger"),
)

CONSORT: Final = (
    Column("stage", "text", "", "stage of the flow (CONSORT 2010)", "ledger"),
    Column("arm", "text", "", "arm; `all` over all of them", "sealed list"),
    Column("n", "whole", "", "participants", "ledger"),
)

METRICS_CODEBOOK: Final = (
    Column("metric", "text", "", "name of the metric", "program"),
    Column("label", "text", "", "short name for people", "program"),
    Column("unit", "text", "", "unit of its values", "program"),
    Column("higher_is_better", "yes_no", "", "direction", "program"),
    Column("definition", "text", "", "what is measured", "program"),
)

_AXES: Final = {"x": "to the right motor", "y": "away from the motors", "z": "up"}
_OF_SERIES: Final = {
    "time_s": "since the attempt's first sample",
    "phase": "state of the attempt: ready, aligning, inserting, holding, ended, aborted, paused",
    "tip": "needle tip",
    "axis": "unit vector from hub to tip",
    "depth_m": "tip beyond the entry along the needle",
    "depth_valid": "whether the depth came from the cameras, at most 0.2 s ago",
    "felt": "force at the hub point after all limits",
    "hub": "hub point, where the hand is",
    "guide": "share of the virtual fixture in the force",
    "target_shift": "displacement of the target from its place at rest",
    "sd_along_m": "standard deviation of the tip along the needle",
    "sd_across_m": "standard deviation of the tip across the needle",
    "picture_age_s": "age of the picture that the tip comes from",
    "clamped": "whether the force was at the robot's limit",
}


def _series_column(name: str) -> Column:
    unit = {"s": "s", "m": "m", "n": "N"}.get(name.rpartition("_")[2], "")
    kind = "yes_no" if name in ("depth_valid", "clamped") else "number"
    if name == "phase":
        kind = "text"
    for letter, way in _AXES.items():
        for end in (f"_{letter}_m", f"_{letter}_n", f"_{letter}"):
            if name.endswith(end) and (words := _OF_SERIES.get(name.removesuffix(end))):
                return Column(name, kind, unit, f"{words}, {letter}: {way}", "record")
    return Column(name, kind, unit, _OF_SERIES[name], "record")


SERIES_FILES: Final = "series/*.csv.gz"

TABLES: Final = {
    "participants.csv": PARTICIPANTS,
    "attempts.csv": ATTEMPTS,
    "metrics.csv": METRICS,
    "answers.csv": ANSWERS,
    "consort.csv": CONSORT,
    "metrics_codebook.csv": METRICS_CODEBOOK,
    SERIES_FILES: tuple(map(_series_column, SERIES)),
}
"""Columns by file."""

CODEBOOK: Final = ("table", "column", "kind", "unit", "definition", "source", "version")


def codebook_rows(version: str) -> list[tuple[str, ...]]:
    """Return a row for each column of each table.

    Args:
        version: of the program, which defines them.
    """
    return [
        (table, one.name, one.kind, one.unit, one.definition, one.source, version)
        for table, columns in TABLES.items()
        for one in columns
    ]


def metric_rows() -> list[tuple[object, ...]]:
    """Return a row for each metric that the program has."""
    return [
        (name, one.title, one.unit, one.higher_is_better, " ".join(one.definition.split()))
        for name, one in available().items()
    ]
