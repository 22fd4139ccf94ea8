"""The language in which people are answered, read without Qt.

A language is one file, `resources/translations/acus_<code>.ts`, as Qt's own tools write it; the
window loads it compiled (`views/kit/language`), the command line reads it as it is. Files of
others (`translations/` in the per-user data folder and in folders of plug-ins) bring further
languages, and to one that is there the texts that it lacks, those of their own panels above all.
Chosen is what the window remembers, else the first of the system's languages that there is, else
English.
"""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Final

from app.core import paths, plugin_folders
from app.core.texts import Lookup, Texts

ENGLISH: Final = "en"
"""The language of the source, which needs no file."""

PREFIX: Final = "acus_"

_VARIABLES: Final = ("LC_ALL", "LC_MESSAGES", "LANG")
_REMEMBERED: Final = re.compile(r'(?ms)^\[General\]\s*$[^\[]*?^language="?(\w*)')
_FIRST_FORM: Final[Mapping[str, tuple[int, ...]]] = {"fr": (0, 1), "pt_BR": (0, 1)}
"""Counts whose form is a language's first, where it is not 1 alone (CLDR, plural rules)."""


def folder() -> Path:
    """Return the folder of the shipped `acus_<code>.ts` files."""
    return paths.resources() / "translations"


def own_files() -> list[Path]:
    """Return the files of others, in the order in which they are asked for a text."""
    shared = (one.path / "translations" for one in plugin_folders.folders())
    places = (*paths.plugin_places("translations"), *shared)
    return [path for place in places for path in sorted(place.glob(f"{PREFIX}*.ts"))]


def files(within: Path | None = None) -> dict[str, list[Path]]:
    """Return code -> the files of a language, the one to be asked first before the others.

    Args:
        within: the one folder that is looked at; those of the program and of others by default.
    """
    shipped = sorted((within or folder()).glob(f"{PREFIX}*.ts"))
    languages: dict[str, list[Path]] = {}
    for path in shipped if within else (*shipped, *own_files()):
        languages.setdefault(path.stem.removeprefix(PREFIX), []).append(path)
    return languages


def code(within: Path | None = None) -> str:
    """Return the code of the language in which people are answered."""
    there = files(within)
    for wanted in (_remembered(), *_of_system()):
        if wanted == ENGLISH or wanted in there:
            return wanted
    return ENGLISH


@cache
def texts(language: str, within: Path | None = None) -> Texts:
    """Return the texts of a language; English where its file cannot be read: the log says why."""
    forms: dict[str, tuple[str, ...]] = {}
    for file in [] if language == ENGLISH else files(within).get(language, []):
        try:
            forms = read(file) | forms
        except (OSError, SyntaxError) as error:  # an XML that is none is a syntax error
            logging.getLogger(__name__).warning("%s cannot be used: %s", file, error)
    if forms:
        return Texts(_lookup(forms, _FIRST_FORM.get(language, (1,)))).begin(english=False)
    return Texts(lambda english, _: english).begin(english=True)


def read(file: Path) -> dict[str, tuple[str, ...]]:
    """Return English text -> its translation's forms, of each that has one.

    Raises:
        OSError: if the file cannot be read.
        SyntaxError: if it is no XML.
    """
    from xml.etree import ElementTree  # only who reads a language pays for it

    forms: dict[str, tuple[str, ...]] = {}
    for message in ElementTree.parse(file).iter("message"):
        translation = message.find("translation")
        if translation is not None:
            several = [form.text or "" for form in translation.iter("numerusform")]
            known = tuple(several or [translation.text or ""])
            if all(known):
                forms[message.findtext("source") or ""] = known
    return forms


def _lookup(forms: Mapping[str, tuple[str, ...]], first: tuple[int, ...]) -> Lookup:
    def translation(english: str, count: int) -> str:
        known = forms.get(english)
        return english if known is None else known[0 if count in first else -1]

    return translation


def _remembered() -> str:
    """Return the code that was chosen in the window; empty where none was."""
    try:
        text = (paths.settings() / "window.ini").read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return ""
    match = _REMEMBERED.search(text)
    return match[1] if match else ""


def _of_system() -> Iterator[str]:
    """Yield the codes of the system's languages, as Qt takes them: `LANGUAGE`, then the locale."""
    locale = next(filter(None, map(os.environ.get, _VARIABLES)), "")
    if locale.split(".")[0] in ("", "C", "POSIX"):
        return
    for name in (*os.environ.get("LANGUAGE", "").split(":"), locale):
        whole = name.split(".")[0].split("@")[0]
        yield from (whole, whole.split("_")[0])
