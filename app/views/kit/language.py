"""The window's language: which there are, which is chosen, and how one is put on.

A language is one file, `resources/translations/acus_<code>.ts`, as Qt's own tools write and read
it, and what files of others add to it (`core.language`). Qt loads them compiled: the compiled file
is made by `lrelease`, which comes with Qt, when it is first asked for, and kept in the user's cache
under the digest of its source. Without `lrelease` the window stays English.
"""

from __future__ import annotations

import hashlib
import logging
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

import PySide6
from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QSettings, QTranslator

from app.core import paths
from app.core.language import ENGLISH, files
from app.views.kit.text import begin_language, tr

KEY: Final = "language"
"""Of the settings: a code; empty or absent for the system's language."""

_LONGEST_S: Final = 30.0


def languages(within: Path | None = None) -> dict[str, str]:
    """Return code -> the language's name in itself, English first."""
    return {ENGLISH: "English"} | {code: _name(code) for code in sorted(files(within))}


def chosen(settings: QSettings) -> str:
    """Return the code that the user chose; empty where the system's language is taken."""
    code = str(settings.value(KEY) or "")
    return code if code in languages() else ""


def choose(settings: QSettings, code: str) -> None:
    """Remember a choice; empty for the system's language."""
    settings.setValue(KEY, code)
    settings.sync()


def code_for(choice: str, within: Path | None = None) -> str:
    """Return the language of a choice: itself, else the first of the system's that there is."""
    there = languages(within)
    for wanted in (choice, *_of_system()):
        if wanted in there:
            return wanted
    return ENGLISH


def use_language(
    application: QCoreApplication, choice: str = "", within: Path | None = None
) -> str:
    """Let all texts that are made from now on be in a language; return its code.

    Args:
        application: whose translations they are; those of before go.
        choice: a code of `languages`; empty for the system's.
        within: the one folder of the languages; those of the program and of others by default.
    """
    for old in application.findChildren(_Translation):
        application.removeTranslator(old)
        old.setParent(None)
    code = code_for(choice, within)
    locale = QLocale(code) if code != ENGLISH or choice else QLocale.system()
    QLocale.setDefault(locale)
    if code == ENGLISH:
        begin_language(english=True)
        return code
    own = map(_compiled, reversed(files(within)[code]))
    qt = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)) / f"qtbase_{code}.qm"
    application.installTranslator(_Lacking(application))
    for file in (qt, *own):  # the last one is asked first
        translation = _Translation(application)
        if file is not None and file.is_file() and translation.load(str(file)):
            application.installTranslator(translation)
    begin_language(english=False)
    return code


class _Translation(QTranslator):
    """One that this file put on."""


class _Lacking(_Translation):
    """Answers for texts of Qt's own dialogs that Qt has not in a language."""

    def isEmpty(self) -> bool:
        """Return that it holds something: Qt asks no other."""
        return False

    def translate(  # None is a null string of Qt, "" would be one
        self,
        context: str,
        sourceText: str,
        disambiguation: str | None = None,
        n: int = -1,
    ) -> str | None:
        """Return our own translation of a text; None where there is none."""
        return lacking_in_qt().get(sourceText) if context.startswith("Q") else None


def lacking_in_qt() -> dict[str, str]:
    """Return texts of Qt's dialogs that some language of Qt lacks, with our own translation."""
    return {"&Look in:": tr("&Look in:"), "Files of &type:": tr("Files of &type:")}


def _name(code: str) -> str:
    name = QLocale(code).nativeLanguageName()
    return name[:1].upper() + name[1:] if name else code


def _of_system() -> list[str]:
    wanted = [name.replace("-", "_") for name in QLocale.system().uiLanguages()]
    return [form for name in wanted for form in (name, name.split("_")[0])]


def _compiled(source: Path) -> Path | None:
    """Return a language compiled for Qt; None where that cannot be done: the log says why."""
    tool = "lrelease.exe" if sys.platform == "win32" else "lrelease"
    try:
        digest = hashlib.sha256(source.read_bytes()).hexdigest()[:16]
        made = paths.cache() / "translations" / f"{source.stem}-{digest}.qm"
        if made.is_file():
            return made
        made.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=made.parent) as place:
            fresh = Path(place) / made.name
            subprocess.run(
                [Path(PySide6.__file__).parent / tool, "-silent", source, "-qm", fresh],
                check=True,
                capture_output=True,
                timeout=_LONGEST_S,
            )
            fresh.replace(made)
    except (OSError, subprocess.SubprocessError) as error:
        logging.getLogger(__name__).warning("%s cannot be used: %s", source.name, error)
        return None
    return made
