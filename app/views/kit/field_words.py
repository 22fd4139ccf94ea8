"""What is wrong with a field of a form, in words for people and not for programmers."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Final

from app.core.configuration import FieldProblem
from app.views.kit.text import tr

_Words = Callable[[str, str], str]
"""From the value that was given and the limit that the check names to what is said."""


def _rules() -> tuple[tuple[str, _Words], ...]:
    """Beginnings of what the checks say, each with the words for it."""
    return (
        (
            r"String should have at least 1 character",
            lambda _value, _limit: tr("is empty: type something"),
        ),
        (
            r"String should have at most (\d+) characters?",
            lambda _value, limit: tr("is too long: at most {n} characters", n=limit),
        ),
        (
            r"String should match pattern '\^\[a-z0-9\]\+\(-\[a-z0-9\]\+\)\*\$'",
            lambda value, _: (
                tr(
                    "{value} cannot be used: small letters, digits and single hyphens, "
                    "such as autumn-2026",
                    value=value,
                )
                if value != "''"
                else tr("is empty: small letters, digits and hyphens, such as autumn-2026")
            ),
        ),
        (
            r"Input should be a valid number|a number is needed",
            lambda value, _: tr("{value} is no number: type one, such as 2.5", value=value),
        ),
        (
            r"Input should be a valid integer",
            lambda value, _: tr("{value} is no whole number: type one, such as 2", value=value),
        ),
        (
            r"Input should be a valid date",
            lambda value, _: tr(
                "{value} is no day: write year-month-day, such as 2026-11-30", value=value
            ),
        ),
        (
            r"Input should be greater than or equal to (\S+?)(?=,|$)",
            lambda value, limit: tr("{value} is too small: at least {n}", value=value, n=limit),
        ),
        (
            r"Input should be less than or equal to (\S+?)(?=,|$)",
            lambda value, limit: tr("{value} is too large: at most {n}", value=value, n=limit),
        ),
        (
            r"Input should be greater than (\S+?)(?=,|$)",
            lambda value, limit: tr("{value} is too small: more than {n}", value=value, n=limit),
        ),
        (
            r"Input should be less than (\S+?)(?=,|$)",
            lambda value, limit: tr("{value} is too large: less than {n}", value=value, n=limit),
        ),
        (
            r"Input should be ('.*')(?=, got)",
            lambda value, limit: tr("{value} cannot be used: {n}", value=value, n=limit),
        ),
    )


_GOT: Final = re.compile(r", got (.*)$", re.DOTALL)
_GROUP: Final = re.compile(r"^a (mapping|list) of \d+$")


def problem_words(problem: FieldProblem) -> str:
    """Say what is wrong with a field and what would be valid, without naming the field."""
    if problem.missing:
        return tr("is missing: fill it in")
    text = problem.text
    got = _GOT.search(text)
    value = got.group(1) if got is not None else ""
    for beginning, words in _rules():
        found = re.match(beginning, text)
        if found is not None:
            return words(value, found.group(1) if found.groups() else "")
    return text[: got.start()] if got is not None and _GROUP.match(value) else text


def place_words(parts: Sequence[str | int]) -> str:
    """Say where within a field something stands: rows count from 1."""
    return ", ".join(
        tr("row {n}", n=part + 1) if isinstance(part, int) else part.replace("_", " ")
        for part in parts
    )
