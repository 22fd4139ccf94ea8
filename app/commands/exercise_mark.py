"""`acus exercise mark`: the pass mark as people set it, with its standard error."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer
from app.commands.doors import instructor
from app.commands.exercise_bands import (
    Hand,
    Name,
    NewTitle,
    Others,
    Save,
    kept_as,
    refuse_both,
    two_groups,
)
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each, Shown
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.exercises.locks import HandName

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.scoring.standard_setting import PassMark
    from app.session.index import Indexed
    from app.session.people import Person, Remarks

Attempts = tuple["list[Person]", Sequence["Indexed"], "dict[str, Remarks]"]
"""Everybody, all attempts, and what was said of them."""


def mark(
    exercise: Name,
    angoff: Annotated[
        Path | None, typer.Option("--angoff", help="CSV: judge, and a column per exercise.")
    ] = None,
    borderline: Annotated[
        Path | None, typer.Option("--borderline", help="CSV: attempt, rating, examiner.")
    ] = None,
    experienced: Annotated[
        str, typer.Option("--experienced", metavar="GROUP", help="Group of the experienced.")
    ] = "",
    others: Others = "",
    at: Annotated[float, typer.Option("--at", help="Rating that means borderline.")] = 2.0,
    hand: Hand = HandName.MOUSE,
    title: NewTitle = "",
    save: Save = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Set the pass mark by people (instructor). Printed; kept if asked.

    By judges' estimates (--angoff), examiners' global ratings (--borderline), or where attempts of
    the experienced and of others part (--experienced). Scripts set none.
    """
    from app.exercises.library import load_exercise
    from app.scoring.pass_line import pass_lines, published_shares
    from app.session.index import Index
    from app.session.people import People
    from app.session.people_marks import points_of_people, set_mark, with_mark
    from app.session.store import records_folder

    people = People()
    instructor(people)
    if [bool(one) for one in (angoff, borderline, experienced)].count(True) != 1:
        raise ConfigurationError(
            sentence(
                "give one way to set the mark: --angoff FILE, --borderline FILE or --experienced "
                "GROUP"
            )
        )
    refuse_both(title, save)
    chosen, index = load_exercise(exercise), Index(records_folder(folder))
    index.refresh()
    there = people.everybody(), index.attempts(), dict(people.remarks())
    if angoff is not None:
        result, judged = _by_judges(angoff, chosen)
    elif borderline is not None:
        result, judged = _by_ratings(borderline, chosen, at, there), {}
    else:
        result, judged = _by_groups(chosen, experienced, others, hand, there), {}
    points = points_of_people(chosen, *there)
    own = set_mark(result, points)
    kept = kept_as(with_mark(chosen, own), title, save)
    newest = [some[-1] for some in points]
    facts: dict[str, Any] = {
        "exercise": chosen.id,
        "version": chosen.version,
        **own.model_dump(mode="json"),
        "attempts": result.attempts or None,
        "before": chosen.rules.pass_mark,
        "judges_agreement": judged.get("agreement"),
        "people_here": len(newest),
        "people_reach_it": sum(total >= own.points for total in newest),
        "published": [
            {"hands": one.hands, "share": one.share}
            for one in published_shares(chosen.tolerances, with_mark(chosen, own).rules)
        ],
        "pass_lines": pass_lines(chosen.tolerances),
        "kept": None if kept is None else {"id": kept.id, "version": kept.version},
    }
    return Answer(facts, shown=SHOWN)


SHOWN: Shown = (
    template(
        "{exercise}, version {version}: pass mark {points:.1f} ± {standard_error:.1f} points by "
        "{method} ({people:#1 person|# people}{attempts:?, {attempts} attempts|}); it was "
        "{before:g}"
    ),
    template(
        "{judges_agreement:?judges agree over the exercises of the sheet: ICC(2,k) "
        "{judges_agreement.value:.2f} ({judges_agreement.lower:.2f} … "
        "{judges_agreement.upper:.2f})|}"
    ),
    template(
        "{score_error:?a single score is good to ± {score_error:.1f} points (of people who "
        "repeated it): a score within that of the mark is told as within the error of measurement"
        "|the standard error of a score is not known: 2 people with 2 attempts that count are "
        "needed}"
    ),
    template("{people_here:?{people_reach_it} of {people_here} people here reach it now|}"),
    Each(
        "published",
        template("published hands, {hands}: {share:.0%} would pass, were all else perfect"),
    ),
    Each("pass_lines", template("{metric} passes to {pass:g}: {words}")),
    template("{kept:?kept: {kept.id}, version {kept.version}|not kept: --save or --title}"),
)


def _by_judges(path: Path, chosen: "Exercise") -> "tuple[PassMark, dict[str, Any]]":
    """Return the mark of a sheet of judges, and how far they agree over its exercises."""
    import numpy as np

    from app.exchange.mark_sheets import read_angoff
    from app.exercises.library import library
    from app.scoring.errors import ReliabilityError
    from app.scoring.reliability import intraclass
    from app.scoring.standard_setting import angoff
    from app.session.people_marks import refuse_scripts
    from app.session.reliability import agreement_document

    sheet = read_angoff(path, {*library().ids(), chosen.id})
    refuse_scripts(sheet.judges)
    if chosen.id not in sheet.estimates:
        raise ConfigurationError(
            sentence(
                "{file} has no column {exercise}: give each judge's estimate of it",
                file=path.name,
                exercise=chosen.id,
            )
        )
    result = angoff(sheet.estimates[chosen.id])
    try:
        forms = intraclass(np.array(list(sheet.estimates.values())))
    except ReliabilityError:
        return result, {}
    return result, {"agreement": agreement_document(forms[4])}


def _by_ratings(path: Path, chosen: "Exercise", at: float, there: Attempts) -> "PassMark":
    from app.exchange.mark_sheets import read_ratings
    from app.scoring.standard_setting import borderline
    from app.session.people_marks import rated_attempts

    rated = rated_attempts(read_ratings(path), chosen, there[1], there[2])
    return borderline(rated.ratings, rated.points, rated.people, at)


def _by_groups(
    chosen: "Exercise", experienced: str, others: str, hand: HandName, there: Attempts
) -> "PassMark":
    from app.scoring.contrasting import contrasted_mark
    from app.session.people_bands import attempts_of
    from app.session.people_marks import refuse_scripts

    refuse_scripts(filter(None, (experienced, others)))
    everybody, attempts, remarks = there
    first, second = (
        attempts_of(name, group, chosen, hand, attempts, remarks)
        for name, group in two_groups(everybody, experienced, others)
    )
    return contrasted_mark(first.points, second.points)
