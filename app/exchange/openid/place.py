"""Which provider a station asks, as which client, and what its groups mean."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final
from urllib.parse import urlsplit

from app.core.errors import writing
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.web import fault_of_address
from app.exchange.openid.errors import OpenIdError
from app.exchange.openid.links import unlink
from app.exchange.openid.roles import StationRole
from app.session.audit import note
from app.session.people import People, people_folder

FILE: Final = "openid.json"

_LONGEST: Final = 512
_SECONDS: Final = (1.0, 120.0)


@dataclass(frozen=True, slots=True)
class OpenIdPlace:
    """A provider of sign-ins.

    Attributes:
        issuer: its address, letter by letter as it names itself.
        client: what it knows Acus by.
        claim: of the ID token that holds groups.
        students: groups that allow no more than a student's role.
        instructors: groups that allow an instructor's.
        technicians: groups that allow a technician's.
        seconds: that an answer may take, as a whole.
        secret: of a client that has one; empty for a public one. In no message and no log.
    """

    issuer: str
    client: str
    claim: str = "groups"
    students: tuple[str, ...] = ()
    instructors: tuple[str, ...] = ()
    technicians: tuple[str, ...] = ()
    seconds: float = 20.0
    secret: str = field(default="", repr=False)

    @property
    def name(self) -> str:
        """Return host and port, which messages call it by."""
        return urlsplit(self.issuer).netloc

    @property
    def groups(self) -> dict[StationRole, tuple[str, ...]]:
        """Return the groups that each role is mapped to."""
        every = (self.students, self.instructors, self.technicians)
        return dict(zip(StationRole, every, strict=True))

    def checked(self) -> OpenIdPlace:
        """Return it if it can be used.

        Raises:
            OpenIdError: if the issuer is no address, or would be asked by plain http; if the client
                or a name of a group is empty, too long or not printable; if a group stands for two
                roles.
        """
        if fault := fault_of_address(self.issuer):
            raise OpenIdError(sentence("issuer: {fault}", fault=fault))
        if urlsplit(self.issuer).fragment:
            raise OpenIdError(
                sentence(
                    "issuer: {issuer} has a part behind #: give the address without it",
                    issuer=self.issuer,
                )
            )
        named: dict[str, tuple[str, ...]] = {"client": (self.client,), "claim": (self.claim,)}
        named |= {str(role): some for role, some in self.groups.items()}
        for setting, texts in named.items():
            for text in texts:
                if not text.strip() or len(text) > _LONGEST or not text.isprintable():
                    raise OpenIdError(
                        sentence(
                            "{setting}: {entered!r} cannot be one: give 1 to {longest} printable "
                            "letters",
                            setting=setting,
                            entered=text[:40],
                            longest=_LONGEST,
                        )
                    )
        every = [group for some in self.groups.values() for group in dict.fromkeys(some)]
        for group in every:
            if every.count(group) > 1:
                raise OpenIdError(
                    sentence("the group {group!r} stands for two roles: map it to one", group=group)
                )
        return self


def is_configured(folder: Path | None = None) -> bool:
    """Return whether this station was told of a provider; `folder` is that of the people."""
    return ((folder or people_folder()) / FILE).exists()


def place_of_openid(folder: Path | None = None) -> OpenIdPlace | None:
    """Return which provider is asked; None for a station that asks none.

    Args:
        folder: of the people.

    Raises:
        OpenIdError: naming the file, if it cannot be used.
    """
    path = (folder or people_folder()) / FILE
    if not path.exists():
        return None
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        named = ("issuer", "client", "claim", "secret")
        issuer, client, claim, secret = (str(document[name]) for name in named)
        students, instructors, technicians = (
            _texts(document["groups"].get(role.value, [])) for role in StationRole
        )
        seconds = min(max(float(document.get("seconds", 20.0)), _SECONDS[0]), _SECONDS[1])
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise OpenIdError(
            sentence(
                "{path} does not say who signs people in: give it again, "
                "`acus people openid --issuer URL --client ID`",
                path=path,
            )
        ) from error
    groups = students, instructors, technicians
    return OpenIdPlace(issuer, client, claim, *groups, seconds, secret).checked()


def put_openid(place: OpenIdPlace | None, people: People) -> None:
    """Keep which provider is asked, readable by this user only; None forgets it, and all links.

    Links with another provider go as well: no sign-in would ever meet them.

    Raises:
        OpenIdError: if it cannot be used or written, or no instructor's password is set: without
            one anybody could name a provider who lets himself in.
        PeopleError: if the links cannot be read or written.
    """
    path = people.folder / FILE
    if place is not None and not people.has_instructor():
        raise OpenIdError(
            sentence(
                "set the instructor's password first (`acus people instructor`): a role is given "
                "with it, and digests need the station's key"
            )
        )
    try:
        before = place_of_openid(people.folder)
    except OpenIdError:
        before = None
    if path.exists() and (place is None or before is None or before.issuer != place.issuer):
        unlink(people)
    with writing(path, OpenIdError):
        if place is None:
            path.unlink(missing_ok=True)
        else:
            place.checked()
            document = {
                "issuer": place.issuer,
                "client": place.client,
                "claim": place.claim,
                "groups": {role.value: list(some) for role, some in place.groups.items()},
                "seconds": place.seconds,
                "secret": place.secret,
            }
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            write_atomically(path, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
            path.chmod(0o600)
    note("sign-in configured", folder=people.folder)


def _texts(some: Any) -> tuple[str, ...]:
    if not isinstance(some, list) or not all(isinstance(text, str) for text in some):
        raise TypeError(some)
    return tuple(some)
