"""Exit codes of every command; the table in docs/command-line.md says the same."""

from enum import IntEnum


class Exit(IntEnum):
    """What the shell is told."""

    DONE = 0
    """Done; where a question was asked, the answer is yes."""

    CRASHED = 1
    """A fault of the program: nothing but an unforeseen exception ends with it."""

    NOT_DONE = 2
    """Could not be done: a bad input or a missing file; one line on stderr says what and why."""

    NO = 3
    """Done, and the answer is no: a score that is not confirmed, a check that was not passed."""

    BROKEN_OFF = 130
    """Ctrl-C, as every shell has it."""
