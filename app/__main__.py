"""The command line: `acus …` and `python -m app …` are the same thing."""

import errno
import os
import sys
from typing import Final

from app.commands import build
from app.commands.output import printable_output
from app.commands.reader_language import local
from app.core import paths
from app.core.errors import AcusError
from app.core.exits import Exit
from app.core.messages import Sentence, sentence

_OUTPUT_FULL: Final = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO}


def main() -> None:
    """Run the command line; a bad input is one line on stderr (`core.exits`)."""
    paths.keep_private()
    with printable_output():
        _main()


def _main() -> None:
    try:
        _run()
    except BrokenPipeError:  # who reads has gone, as `head` does
        _drop_output()
        sys.exit(Exit.DONE)
    except OSError as error:
        if error.filename is not None or error.errno not in _OUTPUT_FULL:
            raise
        _drop_output()
        fail(
            local(
                sentence(
                    "the output could not be written: {reason}; free some space there",
                    reason=error.strerror,
                )
            )
        )


def _run() -> None:
    try:
        code = build()(prog_name="acus", standalone_mode=False)
        sys.stdout.flush()  # here, not while the interpreter ends: there nobody catches its errors
        sys.exit(code if isinstance(code, int) else Exit.DONE)
    except SystemExit:
        if type(sys.stdout).__name__ == "PacifyFlushWrapper":  # click ends a broken pipe with 1
            raise BrokenPipeError from None
        sys.stdout.flush()
        raise
    except AcusError as error:
        fail(local(error))
    except KeyboardInterrupt:
        sys.exit(Exit.BROKEN_OFF)
    except OSError:
        raise  # of the output: see `main`
    except Exception as error:  # typer raises click's usage errors; click is typer's own part
        if type(error).__name__ == "NoArgsIsHelpError":
            sys.stdout.write(f"{error}\n")
            sys.exit(Exit.DONE)
        if type(error).__name__ == "Abort":
            fail(local(sentence("a question was not answered; nothing was done")))
        message = getattr(error, "format_message", None)
        if message is None:
            raise
        own = getattr(error, "message", None)
        if isinstance(own, Sentence):
            fail(local(sentence("Invalid value: {reason}", reason=own)))
        fail(message().replace("Value error, ", ""))  # of the library, about our own words


def _drop_output() -> None:
    """Let go of what is still to be written: the interpreter would try again as it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def fail(message: str) -> None:
    """End with one line on stderr: it could not be done."""
    sys.stderr.write(f"acus: {' '.join(message.split())}\n")
    sys.exit(Exit.NOT_DONE)


if __name__ == "__main__":
    main()
