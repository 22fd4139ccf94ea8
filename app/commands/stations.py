"""`acus store stations`, `revoke`, `renew`, `results`, `station`, `gather`: several stations."""

from pathlib import Path
from typing import Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.shown import Each
from app.core.messages import sentence

FolderOption = Annotated[Path | None, typer.Option("--folder", help="Folder of the records.")]


def add_to(store: Commands) -> None:
    """Add the commands to the group `store`."""
    store.command("stations")(stations)
    store.command("revoke")(revoke)
    store.command("renew")(renew)


def stations(
    name: Annotated[str, typer.Option("--name", help="Name this station.")] = "",
) -> Answer:
    """Show this station and those known here (instructor).

    Each has a fingerprint, which two people compare before one lets the other's station in.
    """
    from app.session.people import People
    from app.session.station import StationKey
    from app.session.stations import fingerprint, name_of_station, set_name, stations_of

    people = People()
    instructor(people)
    if name:
        set_name(name, people)
    key = StationKey.of(people.folder)
    known = sorted(stations_of(people).values(), key=lambda one: (one.name, one.public))
    facts = {
        "station": key.station,
        "name": name_of_station(people, key),
        "fingerprint": fingerprint(key.public),
        "known": [
            {
                "station": one.station,
                "name": one.name,
                "fingerprint": fingerprint(one.public),
                "revoked": one.revoked,
            }
            for one in known
        ],
    }
    row = template("{name:20} {fingerprint} {revoked:?revoked|}")
    none = template("no other station is known here")
    this = template("this station is {name}: {fingerprint}")
    return Answer(facts, shown=(this, Each("known", row, none)))


def revoke(
    station: Annotated[str, typer.Argument(metavar="STATION", help="Its name or id.")],
) -> Answer:
    """Trust a known station no longer (instructor).

    It cannot be undone. Its files are refused, and its attempts count here only where the instructor admits them.
    """
    from app.session.people import People
    from app.session.stations import revoke as revoke_station

    people = People()
    instructor(people)
    one = revoke_station(station, people)
    shown = template("{name} is revoked: what it signed counts here only once admitted")
    return Answer({"station": one.station, "name": one.name}, shown=shown)


def renew() -> Answer:
    """Give this station a new key (instructor).

    What the one before signed stays verified. Lists read every record once more after it. Where a password is set a new recovery key is
    printed, and the one before is worth nothing any more.
    """
    from app.session.people import People
    from app.session.station import StationKey
    from app.session.stations import fingerprint, renew_key

    people = People()
    instructor(people)
    recovery = renew_key(people)
    print_it = sentence("Print it and lock it away: it opens the station's key in a backup.")
    lines = [sentence("recovery key: {key}", key=recovery), print_it] if recovery else []
    facts = {
        "recovery_key": recovery or None,
        "fingerprint": fingerprint(StationKey.of(people.folder).public),
    }
    return Answer(facts, lines, shown=template("this station has a new key: {fingerprint}"))
