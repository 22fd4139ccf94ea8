"""`acus results lrs`, `send`: attempts told to a learning record store."""

import os
from typing import Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.doors import instructor, secret
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.results_reliability import results_at
from app.commands.shown import Each
from app.core.messages import counted, sentence

PASSWORD = "ACUS_LRS_PASSWORD"


def add_to(results: Commands) -> None:
    """Add the commands to the group `results`."""
    results.command("lrs")(lrs)
    results.command("send")(send)


def lrs(
    url: Annotated[
        str, typer.Argument(metavar="URL", help="What stands before /statements; https.")
    ] = "",
    home: Annotated[
        str, typer.Option("--home", help="Address that you own: ids begin with it, at every time.")
    ] = "",
    user: Annotated[str, typer.Option("--user", help="Name, or key, that it gave you.")] = "",
    forget: Annotated[bool, typer.Option("--forget", help="Tell nothing any more.")] = False,
) -> Answer:
    """Tell attempts to a record store (LRS) (instructor).

    Without URL it says where it is and how many statements wait. The password is asked for, or
    stands in ACUS_LRS_PASSWORD. What answers is asked whether it is a record store before it is
    kept; the window sends from then on, and `acus results send`.
    """
    from app.exchange.lrs import Lrs, LrsPlace, place_of_lrs, put_lrs
    from app.session.people import People
    from app.session.statement_queue import FOLDER, StatementQueue

    people = People()
    instructor(people)
    known = None if forget else place_of_lrs(people.folder) if not url else None
    if forget:
        put_lrs(None, people.folder)
    elif url:
        if not home:
            raise typer.BadParameter(sentence("give --home: ids of statements begin with it"))
        known = LrsPlace(url, home, user).checked()
        if user:
            given = os.environ.get(PASSWORD)
            password = secret(sentence("Password")) if given is None else given
            known = LrsPlace(known.endpoint, known.home, user, password)
        Lrs(known).about()
        put_lrs(known, people.folder)
    number = len(StatementQueue(people.folder / FOLDER).waiting())
    facts = {
        "lrs": known and known.endpoint,
        "home": known and known.home,
        "user": (known and known.user) or None,
        "waiting": number,
    }
    shown = template("{lrs:?attempts are told to {lrs}|this station tells no record store}")
    lines = []
    if number:
        lines.append(
            counted(
                "{n} statement waits to be sent: `acus results send`",
                "{n} statements wait to be sent: `acus results send`",
                number,
            )
        )
    return Answer(facts, lines, shown=shown)


def send(
    folder: RecordsFolder = None,
) -> Answer:
    """Send attempts to the record store (instructor).

    The window does it by itself while it runs. What the store has taken leaves the queue; all else
    stays in it. Ends with code 3 if the store refuses a statement.
    """
    from app.commands.calibrate_parts import with_progress
    from app.exchange.lrs import LrsError, deliver, place_of_lrs, tell_attempts
    from app.session.people import People
    from app.session.statement_queue import FOLDER, StatementQueue

    people = People()
    instructor(people)
    place, queue = place_of_lrs(people.folder), StatementQueue(people.folder / FOLDER)
    if place is None:
        raise LrsError(
            sentence(
                "this station tells no record store: `acus results lrs URL --home ADDRESS` does"
            )
        )
    results = results_at("", "", folder, names=False)
    new = with_progress(lambda progress: tell_attempts(results, place, queue, progress=progress))
    done = with_progress(lambda progress: deliver(place, queue, progress))
    facts = {
        "lrs": place.endpoint,
        "new": new,
        "sent": done.sent,
        "waiting": done.waiting,
        "refused": list(done.refused),
    }
    shown = (
        template("{sent:#1 statement|# statements} sent; {waiting:#1 waits|# wait}"),
        Each("refused", template("✖ {}")),
    )
    return Answer(facts, yes=not done.refused, shown=shown)
