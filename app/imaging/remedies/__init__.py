"""Ways to read a CT that cannot, or need not, be read as it is: one file each.

A remedy says for which series it is offered, and reads one of them into a volume. It is never
applied unasked. See 'How to add a CT remedy' in docs/extending.md.
"""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.plugins import TEXT, Declaration, Field, PluginKind
from app.imaging.errors import ImagingError
from app.imaging.series import NO_REMEDY, Recipe, Series

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.imaging.volume import Volume

_LAST = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy(Declaration):
    """What the file of a remedy says about itself.

    Attributes:
        title: what the button says that opens a series with it.
        help: what it does to the values, in a sentence.
        against: what it helps against, in a word or two.
        rank: those of least rank are named and offered first; of one rank, by name.
    """

    help: str
    against: str
    rank: int = _LAST


def _whole(value: Any) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise TypeError
    return value


KIND: PluginKind[Remedy] = PluginKind(
    noun="a CT remedy",
    declares=Remedy,
    fields={"title": TEXT, "help": TEXT, "against": TEXT},
    optional={"rank": Field("a whole number", _whole)},
    error=ImagingError,
    package=__name__,
    folder="remedies",
    functions=("offers", "read"),
)


def remedies() -> tuple[Remedy, ...]:
    """Return every remedy that can be used, in the order in which they are named and offered.

    Files that cannot be used are left out; `refused` names them.
    """
    usable = []
    for name in KIND.names():
        try:
            declared = KIND.find(name)
            _check(declared)
        except ImagingError:
            continue
        usable.append(declared)
    return tuple(sorted(usable, key=lambda one: (one.rank, one.name)))


def words() -> tuple[str, ...]:
    """Return every word that may stand for how a series is read: `NO_REMEDY`, then the names."""
    return (NO_REMEDY, *(one.name for one in remedies()))


def is_word(text: object) -> bool:
    """Return whether a text is one of `words`; quicker than to look through them."""
    return text == NO_REMEDY or text in KIND.names()


def refused() -> dict[Path, str]:
    """Files of others that cannot be used, and why."""
    return KIND.refused(_check)


def _check(declared: Remedy) -> None:
    if declared.name == NO_REMEDY:
        raise ImagingError(
            sentence(
                "{declared_path}: {no_remedy!r} means that a series is read as it is; rename the "
                "file",
                declared_path=declared.path,
                no_remedy=NO_REMEDY,
            )
        )


class RemedyOffer(NamedTuple):
    """Which remedies are offered for a series.

    Attributes:
        names: of those that are, the first one first.
        faults: what somebody's remedies failed with that could not say whether they are.
    """

    names: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()


def offered(series: Series) -> RemedyOffer:
    """Ask every remedy whether it is offered for a series."""
    if not series.slices:  # one file that holds a whole volume
        return RemedyOffer()
    names, faults = [], []
    for remedy in remedies():
        try:
            module = KIND.load(remedy)
            with _blamed(remedy, "offers() does not work"):
                if module.offers(series):
                    names.append(remedy.name)
        except AcusError as error:
            if KIND.is_own(remedy.path):
                raise
            faults.append(str(error))
    return RemedyOffer(tuple(names), tuple(faults))


def read(series: Series, recipe: Recipe, progress: Progress) -> Volume:
    """Read a series by the remedy that its recipe names.

    Raises:
        ImagingError: for an unknown name, listing the known ones, or a file that cannot be used.
        AcusError: whatever keeps the remedy from reading the series.
    """
    remedy = KIND.find(recipe.remedy)
    module = KIND.load(remedy)
    with _blamed(remedy, "read() does not work"):
        volume: Volume = module.read(series, recipe, progress)
        if volume.recipe.remedy == remedy.name:
            return volume
        return replace(volume, recipe=recipe, made=volume.made or (remedy.title,))


def _blamed(remedy: Remedy, doing: str) -> AbstractContextManager[None]:
    """Name the file of somebody else in whatever it raises."""
    return nullcontext() if KIND.is_own(remedy.path) else KIND.blamed(remedy.path, doing)
