"""Tables of studies that are kept with the program: measured once, read by everyone.

    found = kept("velocity")
    found.points, found.default, found.sweet_spot, found.exception

One JSON file per study in the folder `tables` beside the study, written by
`acus study NAME --write`. It holds what `table.document` says, and when and by which version it was
measured, with how many repeats; nothing of the machine. Times are processor time of one call,
medians: ratios hold elsewhere, seconds do not. Reading needs none of what running a study needs.
"""

import json
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any, Final

from app import __version__
from app.core import plugin_folders
from app.core.files import write_atomically
from app.core.messages import sentence
from app.studies.errors import StudyError
from app.studies.findings import Findings, Sheet
from app.studies.rule import departure, sweet_spot
from app.studies.study import Case, Failure, Limit, Point, Prepared, Result, Setting, Study, Way
from app.studies.table import document

_DIGITS: Final = 5
"""Of numbers that are kept; the next digits are noise."""


@dataclass(frozen=True, slots=True)
class Kept:
    """A study as it was measured.

    Attributes:
        result: its points, failures and tables; the study in it can be looked at, not run.
        date: when it was measured, YYYY-MM-DD.
        version: of the program.
        repeats: timings per way and setting.
    """

    result: Result
    date: str
    version: str
    repeats: int

    @property
    def points(self) -> tuple[Point, ...]:
        """Return every way in every setting."""
        return self.result.points

    @property
    def default(self) -> str:
        """Name of the way that the program uses."""
        return self.result.study.default

    @property
    def sweet_spot(self) -> str | None:
        """Name of the way that the rule chooses, if any."""
        return sweet_spot(self.result)

    @property
    def exception(self) -> str:
        """Return why the default is not the sweet spot, with its number; empty where it is."""
        return departure(self.result)


def kept_names() -> tuple[str, ...]:
    """Names of the studies whose tables are kept, sorted."""
    return tuple(sorted(path.stem for folder in _folders() for path in folder.glob("*.json")))


def kept(name: str) -> Kept:
    """Read the table of a study that is kept with the program.

    Raises:
        StudyError: for a name without a table, listing the names, or a file that is no such table.
    """
    path = place(name)
    if not path.is_file():
        raise StudyError(
            sentence(
                "no table of study {name!r} is kept; there are {names}",
                name=name,
                names=", ".join(kept_names()),
            )
        )
    return read(path)


def place(name: str) -> Path:
    """Return the file of a study's table that comes with the program."""
    return (
        next((f for f in _folders() if (f.parent / f"{name}.py").exists()), _OWN) / f"{name}.json"
    )


_OWN: Final = Path(__file__).with_name("tables")


def _folders() -> tuple[Path, ...]:
    shared = (folder.path / "studies" / "tables" for folder in plugin_folders.folders())
    return (_OWN, *shared)


def read(path: Path) -> Kept:
    """Read a table that `keep` wrote.

    Raises:
        StudyError: if it cannot be read or lacks something; names the file.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return Kept(_result(data), **data["measured"])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise StudyError(
            sentence(
                "{path} is no table of a study ({error_name}: {error}); "
                "write it anew with: acus study NAME --write",
                path=path,
                error_name=type(error).__name__,
                error=error,
            )
        ) from error


def keep(result: Result, repeats: int, path: Path) -> Path:
    """Write a result with today's date and the program's version.

    Raises:
        OSError: if the file cannot be written.
    """
    data = _rounded(kept_document(result, repeats))
    write_atomically(path, json.dumps(data, indent=1, ensure_ascii=False) + "\n")
    return path


def kept_document(result: Result, repeats: int) -> dict[str, Any]:
    """Return what `table.document` says and all else that `read` needs, for JSON."""
    data = document(result) | {
        "exception_reason": result.study.exception,
        "settings": [setting.name for setting in result.study.settings],
        "measured": measured(repeats),
    }
    if result.findings is not None:
        data["table_titles"] = {sheet.name: sheet.title for sheet in result.findings.sheets}
    return data


def measured(repeats: int) -> dict[str, str | int]:
    """Return when and by which version, for JSON: today, by this one."""
    return {"date": date.today().isoformat(), "version": __version__, "repeats": repeats}


def was_of(outcome: Kept, study: Study) -> tuple[str, ...]:
    """Name what differs between a kept table's study and one as it is now; nothing if it is it."""
    was = outcome.result.study
    texts = ("title", "question", "reference", "error_label", "default", "because", "exception")
    apart = [name for name in (*texts, "deadline", "perception") if _differ(was, study, name)]
    for kind in ("ways", "settings"):
        if [one.name for one in getattr(was, kind)] != [one.name for one in getattr(study, kind)]:
            apart.append(kind)
    return tuple(apart)


def _differ(was: Study, now: Study, name: str) -> bool:
    return bool(getattr(was, name) != getattr(now, name))


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}")
    if isinstance(value, dict):
        return {key: _rounded(one) for key, one in value.items()}
    return [_rounded(one) for one in value] if isinstance(value, list) else value


def _result(data: dict[str, Any]) -> Result:
    study = Study(
        name=data["study"],
        title=data["title"],
        question=data["question"],
        reference=data["reference"],
        error_label=data["error_label"],
        ways=tuple(Way(w["way"], w["family"], _cannot, w["description"]) for w in data["ways"]),
        settings=tuple(Setting(name, {}) for name in data["settings"]),
        case=_no_case,
        deadline=Limit(data["deadline_s"], data["deadline_label"]),
        perception=Limit(data["perception"], data["perception_label"]),
        default=data["default"],
        because=data["because"],
        exception=data["exception_reason"],
    )
    points = tuple(Point(**point) for point in data["points"])
    failures = tuple(Failure(**failure) for failure in data["failures"])
    return Result(study, points, failures, _findings(data))


def _findings(data: dict[str, Any]) -> Findings | None:
    if "tables" not in data:
        return None
    sheets = tuple(
        Sheet(
            name,
            data["table_titles"][name],
            tuple(rows[0]) if rows else (),
            tuple(tuple(row.values()) for row in rows),
        )
        for name, rows in data["tables"].items()
    )
    return Findings(sheets, (), tuple(data["lines"]))


def _cannot(case: Case) -> Prepared:
    raise StudyError(sentence("a kept table cannot be measured again; run the study of its name"))


def _no_case(setting: Setting) -> Case:
    raise StudyError(sentence("a kept table cannot be measured again; run the study of its name"))
