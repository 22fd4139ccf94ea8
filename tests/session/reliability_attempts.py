"""Attempts of people whose points are given, as the index has them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

from app.scoring.conditions import Conditions, DeviceKind
from app.session.index import Indexed
from app.session.people import People, Person
from app.session.roster import RosterLine


def attempt(who: str, exercise: str, number: int, total: float, **other: object) -> Indexed:
    """Make an attempt of a person; the number gives it its place in time."""
    scripted, mark = str(other.pop("scripted", "")), other.pop("mark", None)
    version = int(other.pop("version", 1))  # type: ignore[call-overload]
    known = Conditions(
        exercise, version, hand="script" if scripted else "mouse", scripted=scripted,
        kind=DeviceKind.SIMULATED, scoring_version=7,
    )  # fmt: skip
    name = f"{exercise}-{who}-{number:03}"
    rules: dict[str, object] = {"pass_mark": 60.0}
    if mark is not None:
        rules |= {"pass_mark": mark["points"], "mark": mark}  # type: ignore[index]
    document = {
        "version": 2, "started": f"2026-11-{1 + number // 24:02}T{number % 24:02}:00:00+00:00",
        "student": who, "exercise": {"id": exercise, "title": exercise}, "state": "ended",
        "reason": "", "duration_s": 60.0, "scans": 0, "problems": [], "software": "1",
        "score": {"total": total, "passed": total >= 60.0, "rules": rules, "rows": []},
        "conditions": known.document(),
    }  # fmt: skip
    values = {
        "id": name, "started": document["started"], "student": who, "exercise": exercise,
        "version": version, "state": "ended", "duration": 60.0, "total": total,
        "passed": total >= 60.0, "verdict": "verified", "counts": not scripted,
        "under": json.dumps(known.document()), "document": json.dumps(document),
    }  # fmt: skip
    return Indexed(**(values | other))  # type: ignore[arg-type]


def attempts(points: Mapping[tuple[str, str], Sequence[float]], **other: object) -> list[Indexed]:
    """Make the attempts of several people at several exercises, oldest first."""
    made = [
        attempt(who, exercise, number, total, **other)
        for (who, exercise), totals in points.items()
        for number, total in enumerate(totals)
    ]
    return sorted(made, key=lambda one: one.started)


def students(count: int, group: str = "A") -> list[Person]:
    """Take some students into the list of people."""
    People().take_roster([RosterLine(f"{group}{n:02}", groups=(group,)) for n in range(count)])
    return [one for one in People().everybody() if group in one.groups]
