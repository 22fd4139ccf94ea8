"""What a command answers with, and the one printer: lines for people, or JSON (docs/json.md)."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from functools import wraps
from inspect import Parameter, signature
from typing import Annotated, Any, TypeVar

import typer
from typer.core import TyperCommand

from app.commands.reader_language import tell
from app.commands.shown import Shown, lines
from app.core.exits import Exit

Function = TypeVar("Function", bound=Callable[..., Any])

FORM = 2
"""Number of the JSON's root form."""

_wanted: ContextVar[bool] = ContextVar("whether JSON was asked for, not text", default=False)


@dataclass(frozen=True, slots=True)
class Answer:
    """What a command has found.

    Args:
        facts: the keys of its JSON, as docs/json.md lists them.
        lines: for people, where they say something else; or a function that prints them.
        yes: the answer where the command asks a question; False ends it with exit code 3.
        crashed: something broke that the command went on after; ends it with exit code 1.
        shown: the facts for people, as templates of lines; they come before `lines`.
    """

    facts: Mapping[str, Any]
    lines: Sequence[str] | Callable[[], object] = ()
    yes: bool | None = None
    crashed: bool = False
    shown: Shown = ()


AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object (docs/json.md).")]


class AnsweringCommand(TyperCommand):
    """A command that returns an `Answer`."""

    def invoke(self, ctx: Any) -> None:
        """Run the command, print its answer; end with code 3 where the answer is no."""
        as_json: bool = ctx.params["as_json"]
        token = _wanted.set(as_json)
        try:
            found: Answer = super().invoke(ctx)
        finally:
            _wanted.reset(token)
        if as_json:
            typer.echo(_text(found, ctx.command_path.partition(" ")[2]))
        elif callable(found.lines):
            found.lines()
        else:
            for line in (*lines(found.shown, found.facts), *found.lines):
                tell(line)
        if found.crashed:
            raise SystemExit(Exit.CRASHED)
        if found.yes is False:
            raise SystemExit(Exit.NO)


class Commands(typer.Typer):
    """A group of commands whose help is plain text; one that returns an `Answer` takes `--json`."""

    def __init__(self, **options: Any) -> None:
        # Plain words need no library, fit into 80 columns, and [mm] is no style in them.
        plain = {"rich_markup_mode": None, "pretty_exceptions_enable": False}
        super().__init__(**({"no_args_is_help": True, "add_completion": False} | plain | options))

    def command(self, name: str | None = None, **options: Any) -> Callable[[Function], Function]:
        """Register a function under a name."""

        def register(function: Function) -> Function:
            add = super(Commands, self).command
            if signature(function).return_annotation in (Answer, Answer.__name__):
                add(name, cls=AnsweringCommand, **options)(_with_json(function))
            else:
                add(name, **options)(function)
            return function

        return register


def wants_json() -> bool:
    """Return whether the command that is running was asked for JSON: then it says nothing on the
    way.
    """
    return _wanted.get()


def _with_json(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """Return the function with the option `--json` at the end of its parameters."""

    @wraps(function)
    def call(*args: Any, as_json: bool, **options: Any) -> Answer:
        return function(*args, **options)

    known = signature(function, eval_str=True)
    flag = Parameter("as_json", Parameter.KEYWORD_ONLY, default=False, annotation=AsJson)
    call.__signature__ = known.replace(parameters=[*known.parameters.values(), flag])  # type: ignore[attr-defined]
    call.__annotations__ = {one.name: one.annotation for one in known.parameters.values()} | {
        "as_json": AsJson
    }
    return call


def _text(result: Answer, name: str) -> str:
    from app import __version__
    from app.core.json_values import finite

    document = {
        "acus": __version__,
        "form": FORM,
        "command": name,
        "answer": result.yes,
        "facts": result.facts,
    }
    return json.dumps(finite(document), indent=1, ensure_ascii=False, allow_nan=False)
