"""`acus store connect`, `sync`: the store that the stations of a school share."""

from typing import Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each
from app.core.messages import counted, joined, sentence


def add_to(store: Commands) -> None:
    """Add the commands to the group `store`."""
    store.command("connect")(connect)
    store.command("sync")(sync)


def connect(
    url: Annotated[
        str, typer.Argument(metavar="URL", help="postgresql+psycopg://… or sqlite:////…")
    ] = "",
    objects: Annotated[
        str, typer.Option("--objects", metavar="URL", help="Keep the files there (fsspec).")
    ] = "",
    options: Annotated[
        list[str] | None,
        typer.Option("--objects-option", metavar="NAME=VALUE", help="Of that place; repeatable."),
    ] = None,
    gives: Annotated[
        bool, typer.Option("--gives-course", help="People and courses of this station go there.")
    ] = False,
    pins: Annotated[bool, typer.Option("--pins", help="Hashes of the PINs too.")] = False,
    names: Annotated[bool, typer.Option("--names", help="Names too.")] = False,
    forget: Annotated[bool, typer.Option("--forget", help="Disconnect this station.")] = False,
) -> Answer:
    """Connect this station to the school's store (instructor).

    Without URL it says where the store is and how many attempts wait. The tables are made where
    they are missing. One station gives the course: its people and courses come to the others.
    """
    from contextlib import closing

    from app.session.people import People
    from app.session.school_store import StorePlace, place_of_store, put_place, require_password
    from app.session.school_store.synchronising import waiting
    from app.session.station import StationKey

    people = People()
    instructor(people)
    if forget:
        put_place(None, people.folder)
    elif url:
        require_password(people)
        said = dict(one.partition("=")[::2] for one in options or ())
        place = StorePlace(url, objects, said, gives, pins, names)
        with closing(place.store()) as store:
            store.open()
        put_place(place, people.folder)
    known = place_of_store(people.folder)
    number = waiting(people, StationKey.of(people.folder)) if known else 0
    facts = {
        "store": known and known.store().name,
        "objects": (known and known.objects) or None,
        "gives_course": bool(known and known.gives_course),
        "waiting": number,
    }
    shown = (
        template("{store:?the school's store is {store}|this station shares no store}"),
        template("{gives_course:?people and courses of this station go there|}"),
    )
    lines = []
    if number:
        lines.append(
            counted(
                "{n} attempt waits to be sent: `acus store sync`",
                "{n} attempts wait to be sent: `acus store sync`",
                number,
            )
        )
    return Answer(facts, lines, shown=shown)


def sync(
    trust: Annotated[
        bool, typer.Option("--trust", help="Let stations in that are not known here.")
    ] = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Exchange what is new with the school's store (instructor).

    The window does it by itself while it runs. What was sent before a network broke off stays
    sent; the rest follows the next time. Ends with code 3 if something is refused or waits.
    """
    from app.commands.calibrate_parts import with_progress
    from app.session.errors import SessionError
    from app.session.gathering import told_of
    from app.session.people import People
    from app.session.school_store import place_of_store, synchronise
    from app.session.store import records_folder

    people, records = People(), records_folder(folder)
    instructor(people)
    place = place_of_store(people.folder)
    if place is None:
        raise SessionError(
            sentence("this station shares no store: `acus store connect URL` connects it")
        )
    done = with_progress(lambda progress: synchronise(place, records, people, trust, progress))
    got = done.gathered
    facts = {
        "store": done.store,
        "sent": done.sent,
        "attempts": got.attempts,
        "remarks": got.remarks,
        "people": got.people,
        "courses": got.courses,
        "erased": got.erased,
        "taken_out": done.erased,
        "excess": got.excess,
        "strangers": got.strangers,
        "unknown": [one._asdict() for one in done.unknown],
        "refused": [*done.refused, *got.different],
    }
    shown = (
        template(
            "{sent:#1 packet|# packets} sent; {attempts:#1 attempt|# attempts}, "
            "{remarks:#1 remark|# remarks}, {people:#1 student|# students}, "
            "{courses:#1 course|# courses} came; {erased} erased"
        ),
        Each(
            "unknown",
            template(
                "✖ the station {name} is not known here: compare {fingerprint} with `acus store "
                "stations` there, then let it in (`acus store sync --trust`)"
            ),
        ),
        Each("refused", template("✖ left out: {}")),
    )
    lines = told_of([got])
    if done.erased:
        lines.append(
            joined(
                " ",
                (
                    counted("{n} packet", "{n} packets", done.erased),
                    sentence("of erased people taken out of the store"),
                ),
            )
        )
    return Answer(facts, lines, yes=not (done.unknown or facts["refused"]), shown=shown)
