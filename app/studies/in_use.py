"""What the running program really calls, found in its own code: for `Study.in_use`.

A name in a table of defaults can be changed while the code goes on calling something else; so the
object is taken from where the calling function finds it.
"""

from collections.abc import Callable
from inspect import signature
from typing import Any

from app.core.messages import sentence
from app.studies.errors import StudyError


def called(caller: Callable[..., Any], name: str) -> object:
    """Return the very object that a function's code finds under a global name.

    Args:
        caller: the function that calls; a compiled one is looked at through its Python source.
        name: as written there.

    Raises:
        StudyError: if its code does not use that name, or the name is bound to nothing.
    """
    function: Any = getattr(caller, "py_func", caller)
    if name not in function.__code__.co_names or name not in function.__globals__:
        raise StudyError(
            sentence(
                "{function_qualname} does not call {name}",
                function_qualname=function.__qualname__,
                name=name,
            )
        )
    return function.__globals__[name]


def default_of(caller: Callable[..., Any], parameter: str) -> object:
    """Return what a function takes where this parameter is not given.

    Raises:
        StudyError: if it has no such parameter, or no default for it.
    """
    found = signature(getattr(caller, "py_func", caller)).parameters.get(parameter)
    if found is None or found.default is found.empty:
        raise StudyError(
            sentence(
                "{caller!r} has no default for {parameter}", caller=caller, parameter=parameter
            )
        )
    return found.default
