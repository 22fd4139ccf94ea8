"""Answers of the command line in the language of whoever reads them; JSON and `--help` have none.

What is answered is made of `sentence("…", name=value)` and `counted("…", "…", n)` of
`core.messages`, and of templates of lines (`shown.py`), which are marked by `template("…")`.
`tools.translations` collects them all.
"""

from __future__ import annotations

import sys
from datetime import datetime
from typing import Any

import typer

from app.core.language import ENGLISH, code, texts
from app.core.messages import Sentence
from app.core.texts import Texts


def template(text: str) -> str:
    """Return a template of a line as it stands: it is translated before it is filled."""
    return text


def language() -> Texts:
    """Return the texts of the language in which this run answers people."""
    return texts(ENGLISH if "--json" in sys.argv else code())


def local(message: str | BaseException) -> str:
    """Return a sentence, or an error with one, in the language of whoever reads it."""
    return language().translated(message)


def known(text: str) -> str:
    """Return a text of a record or a file in the reader's language, where it is one of ours."""
    here = language()
    return here.translated(text) if isinstance(text, Sentence) else here.text(text)


def tell(message: str | BaseException, err: bool = False) -> None:
    """Print a line in the language of whoever reads it."""
    typer.echo(local(message), err=err)


def cell(value: Any) -> str:
    """Return a value of a table: a sentence, a number or a date as the reader's language has it."""
    here = language()
    if isinstance(value, float):
        return here.number(value, "")
    return (
        here.moment(value)
        if isinstance(value, datetime)
        else here.translated(value if isinstance(value, str) else str(value))
    )
