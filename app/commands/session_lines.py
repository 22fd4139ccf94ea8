"""What `acus session` prints of attempts: the table, and one of them in lines."""

from datetime import datetime
from typing import Any

from app.commands.reader_language import cell, known, language, local, tell
from app.core.messages import joined, sentence
from app.core.words import printable


def details(recording: Any, summary: dict[str, Any]) -> dict[str, Any]:
    """Return a summary with what the record holds besides, as JSON."""
    from app.scoring.odds import published_risks
    from app.session.tissues import tissues_met

    samples, inputs = recording.samples, recording.inputs
    met = tissues_met(recording.events)
    radius = samples.tip_radius()
    return summary | {
        "file": str(recording.path),
        "complete": recording.complete,
        "metadata": dict(recording.metadata),
        "tip_radius_95_mm": None if radius is None else 1e3 * radius,
        "published_risks": [risk.document() for risk in published_risks(met)],
        "attachments": sorted(recording.attachments),
        "samples": len(samples.time),
        "ticks": len(inputs.values),
        "ticks_lost": inputs.lost,
        "events": [
            {
                "time_s": e.time - recording.origin,
                "kind": e.kind,
                "message": e.message,
                "data": dict(e.data),
            }
            for e in recording.events
        ],
    }


def print_table(summaries: list[Any], note: str) -> None:
    """Print attempts as a table, then a note where there is one."""
    from rich.table import Table

    from app.commands.output import console as open_console

    table = Table(box=None, pad_edge=False)
    table.add_column("id", no_wrap=True, min_width=max(len(s.id) for s in summaries))
    for title in (
        sentence("student"),
        sentence("exercise"),
        sentence("state"),
        sentence("duration"),
        sentence("score"),
        sentence("signature"),
    ):
        table.add_column(local(title), no_wrap=True)
    table.add_column("", min_width=12)
    for s in summaries:
        whose = nobodys(s.conditions)
        remark = joined("; ", filter(None, (whose, known(s.reason) or joined("; ", s.problems))))
        cells = (
            s.id,
            s.student,
            s.exercise_id,
            _state(s.state),
            f"{s.duration:.0f} s",
            total_words(s.score, s.signature),
            known(s.signature),
            remark,
        )
        table.add_row(*(_plain(cell) for cell in cells))
    console = open_console()
    if not console.is_terminal:  # a file or a pipe has no width to wrap to
        console.width = console.measure(table, options=console.options.update(width=10**4)).maximum
    console.print(table)
    if note:
        tell(note)


def _plain(text: str) -> Any:
    """Text that no markup is read from: pseudonyms and reasons are other people's words."""
    from rich.text import Text

    return Text(printable(local(text)))


def total_words(score: Any, signature: str) -> str:
    """Return the points of a score in words."""
    if signature == "altered":
        return sentence("— altered")
    if not score:
        return "-"
    if score.get("total") is None:
        return sentence("void")
    if score.get("passed"):
        return sentence("{total:.0f} % passed", total=score["total"])
    return sentence("{total:.0f} %", total=score["total"])


def nobodys(conditions: Any) -> str:
    """Say that an attempt is nobody's, and what held the needle; empty for a person's."""
    if conditions is None or conditions.by_person:
        return ""
    hands = known(conditions.hand or "script")
    if conditions.taken_over:
        later = known(conditions.taken_over)
        hands = sentence("{first} then {later}", first=hands, later=later)
    return sentence("no student's attempt: {hands}", hands=hands)


def detail_lines(document: dict[str, Any], whose: str) -> list[str]:
    """Return what `details` gives as lines; `whose`: what `nobodys` says of it."""
    from app.scoring.rows import shown_sd
    from app.scoring.unit_words import unit_words

    score, metadata = document["score"] or {}, document["metadata"]
    radius, exercise = document["tip_radius_95_mm"], document["exercise"]
    hand = metadata.get("trainee", {}).get("hand")
    certainty = sentence("± {radius:.1f} mm (95 %), median", radius=radius or 0.0)
    heads = (
        ("id", document["id"]),
        (sentence("started"), datetime.fromisoformat(document["started"]).astimezone()),
        (sentence("student"), document["student"]),
        (sentence("state"), _state(document["state"])),
        (sentence("reason"), known(document["reason"])),
        (sentence("duration"), sentence("{seconds:.1f} s", seconds=document["duration_s"])),
        (sentence("scans"), document["scans"]),
        (sentence("file"), document["file"]),
        (sentence("exercise"), _titled(exercise)),
        (sentence("hand"), hand or sentence("not recorded")),
        (sentence("whose"), whose or None),
        (sentence("calibration"), document["calibration"] or None),
        (sentence("tip known to"), None if radius is None else certainty),
        (sentence("score"), total_words(document["score"], document.get("signature", ""))),
        (sentence("void"), known(score.get("void_reason") or "") or None),
    )
    lines = [_head(name, value) for name, value in heads if value is not None]
    for row in score.get("rows", []):
        sd = shown_sd(row["name"], row["value"], row.get("sd"))
        unsure = f" ± {language().number(sd, '.1g')}" if sd else ""
        value, unit = "-", local(unit_words(row["unit"]))
        if row["value"] is not None:
            value = f"{language().number(row['value'], '.4g')}{unsure} {unit}"
        band = row["band"] if score.get("total") is not None else ""  # a void one is not judged
        label = known(row["label"])
        lines.append(f"  {label:32} {value:>20}  {known(band or row['note'] or '')}")
    for risk in document["published_risks"]:
        source = f" ({risk['source']})" if risk["source"] else ""
        lines.append(_head(sentence("published"), joined("", (risk["statement"], source))))
    for event in document["events"]:
        time = language().number(event["time_s"], "12.3f")
        lines.append(f"  {time} s  {known(event['message'])}")
    lines += [_head(sentence("problem"), problem) for problem in document["problems"]]
    return [*lines, known(document["note"])]


def _state(state: str) -> str:
    """Return the word for a recorded state; the window has it with a capital."""
    word = known(state.capitalize())
    return state if word == state.capitalize() else word


def _head(name: str, value: Any) -> str:
    """Return a line of a table of two columns in the reader's language."""
    return f"{local(name):12} {cell(value)}".rstrip()


def _titled(exercise: dict[str, Any]) -> str:
    return f"{known(exercise['title'] or '')} ({exercise['id']})"
