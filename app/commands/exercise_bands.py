"""`acus exercise bands`: what counts as good with mouse, tablet or gamepad, from people's runs."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands import completion
from app.commands.answer import Answer
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.exercises.locks import HandName

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.session.people import Person

Name = Annotated[
    str,
    typer.Argument(
        metavar="EXERCISE",
        autocompletion=completion.exercises,
        help="Name, name@version, or file of an exercise.",
    ),
]


Others = Annotated[
    str, typer.Option("--others", metavar="GROUP", help="The others; else everybody else.")
]
Hand = Annotated[HandName, typer.Option("--hand", help="What moved the needle.")]
NewTitle = Annotated[str, typer.Option("--title", help="Keep it as a new exercise of this title.")]
Save = Annotated[bool, typer.Option("--save", help="Keep it as a new version.")]


def bands(
    exercise: Name,
    experienced: Annotated[
        str, typer.Option("--experienced", metavar="GROUP", help="Group of the experienced.")
    ],
    others: Others = "",
    hand: Hand = HandName.MOUSE,
    title: NewTitle = "",
    save: Save = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Fit bands to experienced people (instructor). Printed; kept if asked."""
    from app.exercises.library import load_exercise
    from app.session.index import Index
    from app.session.people import People
    from app.session.people_bands import attempts_of, fit
    from app.session.people_marks import refuse_scripts
    from app.session.store import records_folder

    people = People()
    instructor(people)
    refuse_both(title, save)
    refuse_scripts(filter(None, (experienced, others)))
    chosen, index = load_exercise(exercise), Index(records_folder(folder))
    index.refresh()
    everybody, attempts, remarks = people.everybody(), index.attempts(), people.remarks()
    groups = [
        attempts_of(name, group, chosen, hand, attempts, remarks)
        for name, group in two_groups(everybody, experienced, others)
    ]
    fitted = fit(chosen, hand, *groups)
    changed = chosen.model_copy(update={"bands": {**chosen.bands, hand: fitted.bands}})
    kept = kept_as(changed, title, save)
    facts = {
        "exercise": chosen.id,
        "version": chosen.version,
        "hand": hand.value,
        "experienced": {"people": groups[0].people, "attempts": len(groups[0].scores)},
        "others": {"people": groups[1].people, "attempts": len(groups[1].scores)},
        "metrics": [
            {"metric": name, **own.model_dump(by_alias=True)}
            for name, own in fitted.bands.metrics.items()
        ],
        "alike": list(fitted.alike),
        "kept": None if kept is None else {"id": kept.id, "version": kept.version},
    }
    rows = Each(
        "metrics", "{metric:28} expert {expert:g}, good {good:g}, pass {pass:g}, zero {zero:g}"
    )
    return Answer(
        facts,
        shown=(
            template(
                "{exercise}, version {version}, {hand}: {experienced.people} experienced people "
                "({experienced.attempts} attempts), {others.people} others ({others.attempts})"
            ),
            rows,
            Each("alike", template("{}: the others are no worse, its tolerance stays")),
            template("{kept:?kept: {kept.id}, version {kept.version}|not kept: --save or --title}"),
        ),
    )


def refuse_both(title: str, save: bool) -> None:
    """Let only one of the two ways of keeping an exercise be asked for.

    Raises:
        ConfigurationError: if both are.
    """
    if title and save:
        raise ConfigurationError(
            sentence("--title keeps a new exercise and --save a new version: give one of them")
        )


def two_groups(
    everybody: "Sequence[Person]", experienced: str, others: str
) -> "list[tuple[str, list[Person]]]":
    """Return the experienced and the others, each with the name that people read."""
    those = [person for person in everybody if experienced in person.groups]
    rest = [
        person
        for person in everybody
        if person not in those and (not others or others in person.groups)
    ]
    return [(experienced, those), (others or sentence("everybody else"), rest)]


def kept_as(changed: "Exercise", title: str, save: bool) -> "Exercise | None":
    """Keep an exercise under a new title, or as a new version; None where neither was asked for."""
    from app.exercises.writing import free_id, taken_ids
    from app.exercises.writing import save as keep

    if title:
        changed = changed.model_copy(
            update={"id": free_id(title, taken_ids()), "version": 1, "title": title}
        )
    return keep(changed) if title or save else None
