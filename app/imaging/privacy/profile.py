"""The tables of de-identification, read from resources/dicom."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property

from pydicom.datadict import tag_for_keyword

from app.core import paths
from app.core.configuration import read_yaml
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.imaging.privacy.known_words import body_parts

KINDS = ("number", "uid", "date", "age", "kernel", "tag", "items", "pixels")
BODY_PART = "body part"
"""Form of an attribute whose words stand in a list of their own."""

ACTIONS = ("X", "Z", "D", "U", "X/Z", "X/D", "Z/D", "X/Z/D", "X/Z/U*")


@dataclass(frozen=True, slots=True)
class KeptAttribute:
    """One attribute that is kept.

    Attributes:
        keyword: DICOM keyword.
        kind: the form its value must have, one of `KINDS`, or `words`.
        words: the valid values, of kind `words`.
    """

    keyword: str
    kind: str
    words: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Profile:
    """What happens to an attribute.

    Attributes:
        actions: action of the Basic Profile by tag (PS3.15 table E.1-1).
        kept: what is kept, by tag.
    """

    actions: Mapping[int, str]
    kept: Mapping[int, KeptAttribute]

    @cached_property
    def vocabulary(self) -> frozenset[str]:
        """Every word that may stand in a written file; none of them can be anybody's name."""
        return frozenset().union(*(kept.words for kept in self.kept.values()))


@cache
def profile() -> Profile:
    """Read both tables.

    Raises:
        ConfigurationError: at a row that is not understood.
    """
    return Profile(_actions(), _kept())


def _actions() -> dict[int, str]:
    path = paths.resources() / "dicom" / "basic-profile.csv"
    with path.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    for row in rows:
        if row["action"] not in ACTIONS:
            raise ConfigurationError(
                sentence(
                    "{path}: {tag}: no action {action!r}",
                    path=path,
                    tag=row["tag"],
                    action=row["action"],
                )
            )
    return {int(row["tag"], 16): row["action"] for row in rows}


def _kept() -> dict[int, KeptAttribute]:
    path = paths.resources() / "dicom" / "kept.yaml"
    found = {}
    for keyword, form in read_yaml(path).items():
        tag = tag_for_keyword(keyword)
        if tag is None or not (isinstance(form, list) or form in (*KINDS, BODY_PART)):
            raise ConfigurationError(
                sentence(
                    "{path}: {keyword}: {form}: no such keyword or form",
                    path=path,
                    keyword=keyword,
                    form=form,
                )
            )
        if isinstance(form, list):
            found[tag] = KeptAttribute(keyword, "words", frozenset(map(str, form)))
        elif form == BODY_PART:
            found[tag] = KeptAttribute(keyword, "words", body_parts())
        else:
            found[tag] = KeptAttribute(keyword, form)
    return found
