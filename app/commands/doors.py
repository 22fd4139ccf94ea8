"""What the command line opens only to the instructor: what the window opens only to him as well.

Both ask `session.access`. Whoever runs a command has not signed in, or is the instructor: his
password stands in the variable `ACUS_INSTRUCTOR_PASSWORD`, or is asked for.
"""

import os
import sys
from collections.abc import Iterable
from contextlib import redirect_stdout
from typing import TYPE_CHECKING

import typer

from app.commands.reader_language import local
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.session.access import Visitor
    from app.session.people import People
    from app.session.summary import Summary

PASSWORD = "ACUS_INSTRUCTOR_PASSWORD"
PASSPHRASE = "ACUS_BACKUP_PASSPHRASE"


def instructor(people: "People | None" = None) -> None:
    """Let only the instructor go on, where one is set: the password is asked for.

    Where tries cannot be kept (a full disk) that is said on standard error, and it goes on.

    Args:
        people: the list of people; that of the user's data folder without one.

    Raises:
        PeopleError: for a wrong password.
    """
    from app.session.audit import INSTRUCTOR, act_as

    if people is None:
        from app.session.people import People

        people = People()
    if not people.has_instructor():
        return
    given = os.environ.get(PASSWORD)
    if given is None:
        given = secret(sentence("Instructor's password"))
    if unkept := people.check_instructor(given):
        typer.echo(f"acus: {local(unkept)}", err=True)
    act_as(INSTRUCTOR)


def secret(question: str, confirm: bool = False) -> str:
    """Ask for a secret, which a terminal does not show; without one, read it as a line."""
    try:
        os.close(os.open("/dev/tty", os.O_RDWR))
        hidden = True
    except OSError:  # `getpass` would warn that it may be shown, where nothing shows anything
        hidden = False
    with redirect_stdout(sys.stderr):  # `input` writes the end of its question to the answer
        answer = typer.prompt(
            local(question), hide_input=hidden, confirmation_prompt=confirm, err=True
        )
    return str(answer)


def passphrase(confirm: bool = False) -> str:
    """Return the passphrase of encrypted backups: of its variable, or asked for."""
    given = os.environ.get(PASSPHRASE)
    return secret(sentence("Passphrase of the backups"), confirm) if given is None else given


def visitor() -> "Visitor":
    """Return who runs the command, without asking: the instructor by his password's variable.

    Raises:
        PeopleError: for a wrong password.
    """
    from app.session.access import Known, Visitor
    from app.session.people import People

    people = People()
    known = Known.of(people)
    if known.guarded and PASSWORD in os.environ:
        instructor(people)
        return Visitor(known, instructor=True)
    return Visitor(known)


def see(summaries: "Iterable[Summary]") -> None:
    """Go on where these attempts are open to who runs the command.

    Else the instructor's password is asked for. What a course holds back is a student's, and so it
    is the instructor's to see in any case.

    Raises:
        PeopleError: for a wrong password.
    """
    here = visitor()
    if not all(here.may_see(one.student) for one in summaries):
        instructor()
