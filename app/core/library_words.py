"""What libraries and the operating system say, as sentences of ours: they speak English alone.

A text that is not listed comes as it stands.
"""

import errno
import os
import re
from collections.abc import Mapping
from functools import cache
from typing import Any

from app.core.messages import Sentence, sentence, sentence_of


@cache
def _of_system() -> dict[str, Sentence]:
    """Return what the system says of each error -> the same as a sentence."""
    common = (
        (errno.ENOENT, sentence("No such file or directory")),
        (errno.EACCES, sentence("Permission denied")),
        (errno.EPERM, sentence("Operation not permitted")),
        (errno.EEXIST, sentence("File exists")),
        (errno.ENOTDIR, sentence("Not a directory")),
        (errno.EISDIR, sentence("Is a directory")),
        (errno.ENOTEMPTY, sentence("Directory not empty")),
        (errno.ENOSPC, sentence("No space left on device")),
        (errno.EROFS, sentence("Read-only file system")),
        (errno.EFBIG, sentence("File too large")),
        (errno.EIO, sentence("Input/output error")),
        (errno.ENAMETOOLONG, sentence("File name too long")),
        (errno.EMFILE, sentence("Too many open files")),
        (errno.EINVAL, sentence("Invalid argument")),
        (errno.EBUSY, sentence("Device or resource busy")),
        (errno.ENODEV, sentence("No such device")),
        (errno.ENXIO, sentence("No such device or address")),
        (errno.ENOMEM, sentence("Cannot allocate memory")),
        (errno.EPIPE, sentence("Broken pipe")),
        (errno.ENOEXEC, sentence("Exec format error")),
        (errno.EADDRINUSE, sentence("Address already in use")),
        (errno.EADDRNOTAVAIL, sentence("Cannot assign requested address")),
        (errno.ECONNREFUSED, sentence("Connection refused")),
        (errno.ECONNRESET, sentence("Connection reset by peer")),
        (errno.ETIMEDOUT, sentence("Connection timed out")),
        (errno.EHOSTUNREACH, sentence("No route to host")),
        (errno.ENETUNREACH, sentence("Network is unreachable")),
    )
    named = {os.strerror(number): said for number, said in common}
    return named | {"Name or service not known": sentence("Name or service not known")}


_NUMBERED = re.compile(r"\[Errno \d+\] (?P<why>.+?)(?:: '(?P<file>.*)')?")


def system_words(text: str) -> str:
    """Return what the system says of an error as a sentence; any other text as it stands.

    Args:
        text: of an error of the system, alone or with its number and a file.
    """
    whole = _NUMBERED.fullmatch(text)
    if whole is None:
        return _of_system().get(text, text)
    why = system_words(whole["why"])
    if not isinstance(why, Sentence) or not whole["file"]:
        return why
    return sentence("{file}: {why}", file=whole["file"], why=why)


@cache
def _of_checks() -> dict[str, Sentence]:
    """Return kinds of errors of a check of fields -> what is said of them, without its values."""
    return {
        "extra_forbidden": sentence("Extra inputs are not permitted"),
        "int_type": sentence("Input should be a valid integer"),
        "int_parsing": sentence(
            "Input should be a valid integer, unable to parse string as an integer"
        ),
        "int_from_float": sentence(
            "Input should be a valid integer, got a number with a fractional part"
        ),
        "float_type": sentence("Input should be a valid number"),
        "float_parsing": sentence(
            "Input should be a valid number, unable to parse string as a number"
        ),
        "finite_number": sentence("Input should be a finite number"),
        "string_type": sentence("Input should be a valid string"),
        "bool_type": sentence("Input should be a valid boolean"),
        "bool_parsing": sentence("Input should be a valid boolean, unable to interpret input"),
        "list_type": sentence("Input should be a valid list"),
        "tuple_type": sentence("Input should be a valid tuple"),
    }


def check_words(kind: str, message: str, values: Mapping[str, Any]) -> str:
    """Return what a check of fields (pydantic) says of one of them, as a sentence.

    Args:
        kind: of the error.
        message: of the library.
        values: of the message; an error of ours among them speaks for itself.
    """
    own = values.get("error")
    if isinstance(own, Exception):
        return sentence_of(own)
    if kind in _of_checks():
        made: str = _of_checks()[kind]
    else:
        made = _with_values(kind, values)
    return made if made == message else message


def _with_values(kind: str, values: Mapping[str, Any]) -> str:
    """Return a message that holds values; empty for a kind that is not listed."""
    if kind in ("literal_error", "enum"):
        return _one_of(str(values["expected"]))
    if kind == "greater_than_equal":
        return sentence(
            "Input should be greater than or equal to {limit:g}", limit=float(values["ge"])
        )
    if kind == "less_than_equal":
        return sentence(
            "Input should be less than or equal to {limit:g}", limit=float(values["le"])
        )
    if kind == "greater_than":
        return sentence("Input should be greater than {limit:g}", limit=float(values["gt"]))
    if kind == "less_than":
        return sentence("Input should be less than {limit:g}", limit=float(values["lt"]))
    if kind == "string_pattern_mismatch":
        return sentence("String should match pattern '{pattern}'", pattern=values["pattern"])
    if kind in ("too_short", "too_long"):
        return _of_length(kind, values)
    return ""


def _one_of(expected: str) -> str:
    *most, last = expected.split(" or ")
    if not most:
        return sentence("Input should be {last}", last=last)
    return sentence("Input should be {names} or {last}", names=" or ".join(most), last=last)


def _of_length(kind: str, values: Mapping[str, Any]) -> str:
    limit = int(values["min_length" if kind == "too_short" else "max_length"])
    facts = {"kind": values["field_type"], "items": limit, "n": values["actual_length"]}
    if kind == "too_short" and limit != 1:
        return sentence(
            "{kind} should have at least {items} items after validation, not {n}", **facts
        )
    if kind == "too_long" and limit != 1:
        return sentence(
            "{kind} should have at most {items} items after validation, not {n}", **facts
        )
    return ""
