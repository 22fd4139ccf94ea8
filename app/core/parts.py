"""The parts that the program is built of, with their licences, as the installation says."""

from dataclasses import dataclass
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from re import match
from typing import Final

_PROGRAM: Final = "acus"
_STATED: Final = {"vtk": "BSD-3-Clause", "python-gdcm": "BSD-3-Clause"}
"""Licences that a part's own metadata leave out."""

_LONGEST = 60


@dataclass(frozen=True, slots=True)
class Part:
    """A library: name, version and licence as its metadata have them."""

    name: str
    version: str
    licence: str


def parts() -> tuple[Part, ...]:
    """Return the installed libraries that the program needs, and those that these need, by name."""
    found: dict[str, Part] = {}
    waiting = [_PROGRAM]
    seen: set[str] = set()
    while waiting:
        name = _key(waiting.pop())
        if name in seen:
            continue
        seen.add(name)
        try:
            library = distribution(name)
        except PackageNotFoundError:
            continue
        if name != _PROGRAM:
            found[name] = Part(library.metadata["Name"], library.version, licence(library))
        waiting += [each for each in map(_needed, library.requires or ()) if each]
    return tuple(found[name] for name in sorted(found))


def licence(library: Distribution) -> str:
    """Return the licence of a library in a line; "not stated" where its metadata are silent."""
    data = library.metadata
    if text := data["License-Expression"]:
        return str(text)
    if stated := _STATED.get(_key(data["Name"])):
        return stated
    classes = [
        line.rpartition(" :: ")[2]
        for line in data.get_all("Classifier") or ()
        if line.startswith("License ::") and not line.endswith("OSI Approved")
    ]
    words = str(data["License"] or "").strip()
    if words and "\n" not in words and len(words) <= _LONGEST:
        return words
    return ", ".join(classes) or "not stated"


def _key(name: str) -> str:
    return name.lower().replace("_", "-").replace(".", "-")


def _needed(requirement: str) -> str:
    """Name of what is required, "" where an extra asks for it."""
    name = match(r"[A-Za-z0-9._-]+", requirement)
    return "" if name is None or "extra ==" in requirement else name.group()
