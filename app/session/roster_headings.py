"""Headings of a roster: this program's own, and those of Moodle in English, German and French.

Moodle's participants and grades leave with the headings of its language (`First name`, `Last name`
or, before 4.0, `Surname`, `Email address`, `ID number`, `Username`, `Groups`); its upload of users
has short ones (`firstname`, `lastname`, `group1`). Whatever else such a file holds is left alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.session.accounts import Account

FIELDS: Final = ("pseudonym", "name", "pin", "group")
OWN: Final = (*FIELDS, *Account)

_MOODLE: Final[Mapping[str, tuple[str, ...]]] = {
    "first": ("first name", "firstname", "vorname", "prénom"),
    "last": ("last name", "lastname", "surname", "nachname", "nom de famille", "nom"),
    Account.USERNAME: ("username", "anmeldename", "nom d'utilisateur"),
    Account.EMAIL: (
        *("email address", "email", "e-mail-adresse", "e-mail", "adresse e-mail"),
        *("adresse de courriel", "courriel"),
    ),
    Account.IDNUMBER: ("id number", "idnumber", "id-nummer", "numéro d'identification"),
    "groups": ("groups", "group", "group1", "gruppen", "gruppe", "groupes", "groupe"),
    "pseudonym": ("pseudonym",),
    "pin": ("pin",),
}
_FIELD_OF: Final = {heading: field for field, some in _MOODLE.items() for heading in some}
_FIRST_AND_LAST: Final = {heading for field in ("first", "last") for heading in _MOODLE[field]}


@dataclass(frozen=True, slots=True)
class Columns:
    """What each column of a roster holds.

    Attributes:
        fields: of `FIELDS` and `Account`, `first`, `last`, `groups`, or empty for a column that is
            left alone.
        by: the field whose value is the pseudonym.
        errors: why the heading cannot be used, one line each; empty if it can.
    """

    fields: tuple[str, ...] = ()
    by: str = "pseudonym"
    errors: tuple[str, ...] = ()

    def cells(self, row: Sequence[str]) -> dict[str, str]:
        """Return the cells of a row by field; first and last name as one name."""
        cells = {field: cell for field, cell in zip(self.fields, row, strict=True) if field}
        cells["pseudonym"] = cells.get(self.by, "")
        first, last = cells.pop("first", ""), cells.pop("last", "")
        if first or last:
            cells["name"] = f"{first} {last}".strip()
        return cells

    @property
    def between_groups(self) -> str:
        """Return what separates groups in a cell."""
        return "," if "groups" in self.fields else "|"


def columns_of(heading: Sequence[str]) -> Columns:
    """Return what the columns of a roster hold, by its heading."""
    names = [name.casefold().replace("’", "'") for name in heading]
    if _FIRST_AND_LAST.isdisjoint(names) and (
        "pseudonym" in names or not {"username", "email address"} & set(names)
    ):
        return _own(names)
    fields = [_FIELD_OF.get(name, "") for name in names]
    twice = next((names[at] for at, f in enumerate(fields) if f and f in fields[:at]), None)
    if twice is not None:
        line = sentence(
            "line 1: the column {column!r} holds what another one does: delete one", column=twice
        )
        return Columns(errors=(line,))
    for by in ("pseudonym", Account.USERNAME, Account.IDNUMBER):
        if by in fields:
            return Columns(tuple(fields), by)
    line = sentence(
        "line 1: this is a table of Moodle without user names and ID numbers, and screens show "
        "neither names nor e-mail addresses: add a column pseudonym, or export it with Username"
    )
    return Columns(errors=(line,))


def _own(names: Sequence[str]) -> Columns:
    if "pseudonym" not in names:
        wanted = ", ".join(OWN)
        line = sentence(
            "line 1: the heading needs the column pseudonym; columns are {wanted}", wanted=wanted
        )
        return Columns(errors=(line,))
    errors = tuple(
        sentence(
            "line 1: column {column!r} is not known; columns are {wanted}",
            column=name,
            wanted=", ".join(OWN),
        )
        for name in names
        if name and name not in OWN
    )
    return Columns(tuple(name if name in OWN else "" for name in names), errors=errors)
