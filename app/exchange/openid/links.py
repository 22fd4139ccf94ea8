"""Who of this station is whom at the provider: linked once, told again by a salted digest.

It stands in the file of names, under the student's key (`session.accounts`), and goes with the
name, whatever erases or leaves it out: HMAC-SHA256 of issuer and `sub` by a key that is derived
from the station's. Without that key nobody can try whom it stands for, and another station's is
another one. Beside it stands the role that this station gave, which the provider's groups can only
narrow.
"""

from __future__ import annotations

import hmac
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.exchange.openid.errors import OpenIdError
from app.exchange.openid.roles import HospitalIdentity, StationRole
from app.session.accounts import entry_of
from app.session.audit import INSTRUCTOR, note
from app.session.people import People, Person
from app.session.roster import RosterLine, checked_pin
from app.session.station import StationKey
from app.session.tries import WrongPasswordError

LINK: Final = "openid"
GIVEN: Final = "openid-role"
"""Kinds of entries in the file of names."""

_PURPOSE: Final = "openid link"


@dataclass(frozen=True, slots=True)
class Entered:
    """Somebody of this station whom the provider has signed in.

    Attributes:
        person: of this station.
        given: role that this station gave.
        allowed: the most that the provider's groups allow today.
    """

    person: Person
    given: StationRole
    allowed: StationRole

    @property
    def role(self) -> StationRole:
        """Return the role in which he is here: what was given, as far as the groups allow it."""
        return min(self.given, self.allowed, key=lambda role: role.rank)

    @property
    def may_be_more(self) -> bool:
        """Return whether the groups allow more than this station gave."""
        return self.allowed.rank > self.given.rank


def enter(people: People, identity: HospitalIdentity) -> Entered | None:
    """Let in whom the provider has signed in; None for somebody who is not linked yet.

    Raises:
        PeopleError, SignatureError: if the people or the station's key cannot be read.
    """
    digests, names = _digests(people, identity), people.names()
    keys = {names[entry]: entry.partition(" ")[0] for entry in names if entry.endswith(f" {LINK}")}
    key = next((keys[digest] for digest in digests if digest in keys), "")
    person = next((someone for someone in people.everybody() if someone.key == key), None)
    if person is None:
        return None
    if names[entry_of(key, LINK)] != digests[0]:  # the station's key was renewed meanwhile
        _write(people, {entry_of(key, LINK): digests[0]})
    note("signed in by hospital", [person.key], people.folder, who=person.key)
    return Entered(person, _given(names, key), identity.allowed)


def link(people: People, identity: HospitalIdentity, pseudonym: str, pin: str) -> Entered:
    """Link somebody, who chooses pseudonym and PIN, or gives those that he has here already.

    Raises:
        WrongPasswordError: if the pseudonym is known here and the PIN is not its.
        OpenIdError: if either is linked already.
        PeopleError: if the pseudonym or PIN cannot be one.
    """
    pin = checked_pin(pin.strip())
    wanted = pseudonym.strip()
    taken = {name.casefold(): key for key, name in people.pseudonyms().items()}
    known = taken.get(wanted.casefold(), "")
    if known and entry_of(known, LINK) in people.names():
        raise _linked(wanted)
    if known:
        try:
            person = people.sign_in(wanted, pin)
        except WrongPasswordError as error:
            raise WrongPasswordError(
                sentence(
                    "{pseudonym} is known here already, and {error}; if it is not yours, choose "
                    "another pseudonym",
                    pseudonym=wanted,
                    error=error.args[0],
                )
            ) from error
    else:
        person = people.add(RosterLine(wanted, "", pin))[0]
    digests = _digests(people, identity)
    with people.as_one() as (_, write_names):
        names = people.names()
        held = {value for entry, value in names.items() if entry.endswith(f" {LINK}")}
        if held & set(digests) or entry_of(person.key, LINK) in names:
            raise _linked(wanted)
        write_names(names | {entry_of(person.key, LINK): digests[0]})
    note("sign-in linked", [person.key], people.folder, who=person.key)
    note("signed in by hospital", [person.key], people.folder, who=person.key)
    return Entered(person, StationRole.STUDENT, identity.allowed)


def give_role(people: People, entered: Entered, password: str) -> Entered:
    """Give somebody the role that his groups allow, once, by the instructor's password.

    Raises:
        WrongPasswordError, PeopleError: as `People.check_instructor`.
    """
    people.check_instructor(password)
    key = entered.person.key
    _write(people, {entry_of(key, GIVEN): entered.allowed.value})
    note("role given", [key], people.folder, who=INSTRUCTOR)
    return Entered(entered.person, entered.allowed, entered.allowed)


def linked_keys(people: People) -> tuple[str, ...]:
    """Return the keys of everybody who is linked, sorted."""
    kind = f" {LINK}"
    return tuple(sorted(one.removesuffix(kind) for one in people.names() if one.endswith(kind)))


def unlink(people: People, key: str = "") -> int:
    """Take back a person's link and role, or everybody's; return how many links that were.

    Raises:
        PeopleError: if the file of names cannot be read or written.
    """
    keys = [linked for linked in linked_keys(people) if key in ("", linked)]
    if not keys:
        return 0
    gone = {entry_of(linked, kind) for linked in keys for kind in (LINK, GIVEN)}
    with people.as_one() as (_, write_names):
        names = people.names()
        write_names({entry: value for entry, value in names.items() if entry not in gone})
    note("sign-in unlinked", keys, people.folder)
    return len(keys)


# --- inside ---------------------------------------------------------------------------------------
def _digests(people: People, identity: HospitalIdentity) -> list[str]:
    """Return what somebody is told by, with the station's key and with those before it."""
    key = StationKey.of(people.folder)
    text = json.dumps([identity.issuer, identity.subject]).encode()
    every = (StationKey(key.station, secret) for secret in (key.secret, *key.former))
    return [hmac.digest(each.derived(_PURPOSE), text, "sha256").hex() for each in every]


def _given(names: Mapping[str, str], key: str) -> StationRole:
    """Return the role that was given; a student's where none was, or nonsense stands there."""
    text = names.get(entry_of(key, GIVEN), "")
    return StationRole(text) if text in set(StationRole) else StationRole.STUDENT


def _write(people: People, entries: Mapping[str, str]) -> None:
    with people.as_one() as (_, write_names):
        write_names(people.names() | dict(entries))


def _linked(pseudonym: str) -> OpenIdError:
    return OpenIdError(
        sentence(
            "{pseudonym}, or who you are at the hospital, is linked already: choose another "
            "pseudonym, or ask the instructor to undo the link (`acus people openid --unlink`)",
            pseudonym=pseudonym,
        )
    )
