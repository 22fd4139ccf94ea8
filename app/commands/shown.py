"""Lines for people out of the facts of an answer, by templates.

A template is a text, marked by `template("…")` where it holds words, and translated before it is
filled, with fields in braces, as `str.format` has them; a key within a key, or the
place in a list, comes after a dot: `{ct.digest:.12}`, `{size.0}`. Beside Python's formats:

- `{share:.0%}`: a share in per cent, with a blank before the sign;
- `{groups:24}`: what a list holds, between commas; `-` where it is empty;
- `{pins:#}`: the number of things; `{pins:#1 PIN|# PINs}` in words, with a third text for none;
- `{title:~}`: a text that ships with the program, in the reader's language;
- `{started:@}`: a moment in ISO 8601, as the reader's language writes dates;
- `{shipped:?yes|no}`: the one text or the other, each with fields of its own. Nothing is a key that
  is not there, None, False, an empty text or list; the number 0 is something.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from string import Formatter
from typing import Any, TypeAlias

from app.commands.reader_language import language

Shown: TypeAlias = "str | Each | Sequence[str | Each]"
"""A template of a line, rows, or several of them."""
Facts: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Each:
    """Lines for each entry of a list or a mapping among the facts.

    Args:
        key: of the list; "" for the facts themselves.
        shown: of an entry. Its fields are the entry's keys, `{}` is an entry without any; those of
            a mapping have `{key}` and `{value}`.
        none: in place of them where there is no entry; its fields are those around the list.
    """

    key: str
    shown: Shown = "{}"
    none: Shown = ()


def lines(shown: Shown, facts: Facts) -> Iterator[str]:
    """Yield the lines; an empty one is left out.

    Raises:
        KeyError: if the facts lack a key.
    """
    if isinstance(shown, str):
        if line := _text(language().text(shown), facts):
            yield line
    elif isinstance(shown, Each):
        entries = _entries(_value(shown.key, facts))
        for entry in entries:
            yield from lines(shown.shown, entry)
        if not entries:
            yield from lines(shown.none, facts)
    else:
        for part in shown:
            yield from lines(part, facts)


def _entries(value: Any) -> list[Facts]:
    if isinstance(value, Mapping):
        return [{"key": key, "value": inner} for key, inner in value.items()]
    return [entry if isinstance(entry, Mapping) else {"": entry} for entry in value]


def _text(template: str, facts: Facts) -> str:
    text = ""
    for literal, name, form, _ in Formatter().parse(template):
        text += literal
        if name is None:
            continue
        if form and form[0] == "?":
            yes, no = (*_alternatives(form[1:]), "")[:2]
            text += _text(yes if _is_something(name, facts) else no, facts)
        elif form and form[0] == "#":
            text += _counted(_value(name, facts), *_alternatives(form[1:]))
        else:
            text += _formatted(_value(name, facts), form or "")
    return text


def _counted(value: Any, single: str, several: str = "#", none: str | None = None) -> str:
    number = value if isinstance(value, int) else len(value)
    if number == 0 and none is not None:
        return none
    return (single if number == 1 and single else several).replace("#", str(number))


def _formatted(value: Any, form: str) -> str:
    here = language()
    if isinstance(value, (list, tuple)):
        value = ", ".join(map(str, value)) or "-"
    if form == "~":
        return here.text(value) if value else ""
    if form == "@":
        return here.moment(datetime.fromisoformat(value).astimezone())
    if form.endswith("%"):
        return f"{here.number(100.0 * value, f'{form[:-1]}f')} %"
    return (
        here.number(value, form)
        if isinstance(value, float)
        else format(here.translated(value) if isinstance(value, str) else value, form)
    )


def _alternatives(form: str) -> list[str]:
    """Return the texts between the `|` that stand in no field of theirs."""
    texts, depth = [""], 0
    for sign in form:
        depth += (sign == "{") - (sign == "}")
        if sign == "|" and depth == 0:
            texts.append("")
        else:
            texts[-1] += sign
    return texts


def _value(name: str, facts: Facts) -> Any:
    if not name:
        return facts.get("", facts)
    value: Any = facts
    for part in name.split("."):
        value = value[part] if isinstance(value, Mapping) else value[int(part)]
    return value


def _is_something(name: str, facts: Facts) -> bool:
    try:
        value = _value(name, facts)
    except LookupError:
        return False
    return bool(value) or (value == 0 and value is not False)
