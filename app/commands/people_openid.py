"""`acus people openid`: which provider signs people in, and what its groups mean."""

import os
import threading
import webbrowser
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands.answer import Answer, Commands
from app.commands.doors import instructor, secret
from app.commands.reader_language import local, template
from app.core.messages import counted, sentence

if TYPE_CHECKING:
    from app.exchange.openid import OpenIdPlace

SECRET = "ACUS_OPENID_SECRET"
Groups = list[str] | None


def add_to(people: Commands) -> None:
    """Add the command to the group `people`."""
    people.command("openid")(openid)


def openid(
    issuer: Annotated[
        str, typer.Option("--issuer", metavar="URL", help="The provider, as it names itself.")
    ] = "",
    client: Annotated[str, typer.Option("--client", help="What it knows Acus by.")] = "",
    has_secret: Annotated[
        bool, typer.Option("--secret", help="The client has a secret: it is asked for.")
    ] = False,
    claim: Annotated[str, typer.Option("--claim", help="Claim that holds groups.")] = "groups",
    student: Annotated[
        Groups, typer.Option("--student", metavar="GROUP", help="No more than a student.")
    ] = None,
    as_instructor: Annotated[
        Groups, typer.Option("--instructor", metavar="GROUP", help="Up to instructor; repeatable.")
    ] = None,
    technician: Annotated[
        Groups, typer.Option("--technician", metavar="GROUP", help="Up to technician; repeatable.")
    ] = None,
    trial: Annotated[
        bool, typer.Option("--try", help="Sign in once; says what would be, changes nothing.")
    ] = False,
    undo: Annotated[
        str, typer.Option("--unlink", metavar="PSEUDONYM", help="Undo a link and its role.")
    ] = "",
    forget: Annotated[
        bool, typer.Option("--forget", help="Ask nobody any more; all links go.")
    ] = False,
) -> Answer:
    """Let the hospital sign people in too (instructor).

    By OpenID Connect. Without options it says who is asked and how many are linked. What answers is
    asked whether it is a provider before it is kept. Who is in no group that is mapped is a
    student, who is in several has the least of their roles; and no group gives a role that this
    station has not given. A secret may stand in ACUS_OPENID_SECRET.
    """
    from app.exchange.openid import (
        OpenIdError,
        OpenIdPlace,
        discover,
        linked_keys,
        place_of_openid,
        published_keys,
        put_openid,
        require_joserfc,
        unlink,
    )
    from app.session.people import People

    people = People()
    instructor(people)
    tried = None
    if forget:
        put_openid(None, people)
    elif issuer or client:
        wanted = OpenIdPlace(
            issuer.strip(),
            client.strip(),
            claim,
            tuple(student or ()),
            tuple(as_instructor or ()),
            tuple(technician or ()),
            secret=_secret() if has_secret else "",
        ).checked()
        require_joserfc()  # before anybody at the station meets its absence
        published_keys(wanted, discover(wanted))
        put_openid(wanted, people)
    if undo:
        unlink(people, people.find(undo).key)
    place = place_of_openid(people.folder)
    if trial:
        if place is None:
            raise OpenIdError(
                sentence("no provider is named: `acus people openid --issuer URL --client ID`")
            )
        tried = _tried(place)
    number = len(linked_keys(people))
    facts = {
        "issuer": place and place.issuer,
        "client": place and place.client,
        "claim": place and place.claim,
        "groups": {role.value: list(some) for role, some in place.groups.items()} if place else {},
        "linked": number,
        "tried": tried,
    }
    shown = template("{issuer:?{issuer} signs people in too|only this station signs people in}")
    lines = []
    if number:
        lines.append(counted("{n} person is linked", "{n} persons are linked", number))
    if tried is not None:
        lines.append(
            sentence(
                "it works: the groups allow the role {role} at most; nobody was signed in here",
                role=tried,
            )
        )
    return Answer(facts, lines, shown=shown)


def _tried(place: "OpenIdPlace") -> str:
    """Sign in once by the browser; return the role that the groups allow."""
    from app.exchange.openid import ask

    done = local(sentence("That is all here: go back to Acus, and close this page."))
    wrong = local(sentence("This is no answer to a sign-in that Acus waits for. Go back to Acus."))
    question = ask(place, done, wrong)
    try:
        asked = sentence("sign in on the page that opens: {address}", address=question.address)
        typer.echo(local(asked), err=True)
        threading.Thread(target=webbrowser.open, args=(question.address,), daemon=True).start()
        return question.identity().allowed.value
    finally:
        question.close()


def _secret() -> str:
    """Return the client's secret: of its variable, or asked for."""
    given = os.environ.get(SECRET)
    return secret(sentence("Secret of the client")) if given is None else given
