"""The command line: `acus …` and `python -m app …` are the same thing."""

import os
import sys

from app.commands import build
from app.core import paths
from app.core.errors import AcusError
from app.core.exits import Exit


def main() -> None:
    """Run the command line; a bad input is one line on stderr (`core.exits`)."""
    paths.keep_private()
    try:
        code = build()(prog_name="acus", standalone_mode=False)
        sys.exit(code if isinstance(code, int) else Exit.DONE)
    except AcusError as error:
        fail(str(error))
    except KeyboardInterrupt:
        sys.exit(Exit.BROKEN_OFF)
    except BrokenPipeError:  # who reads has gone, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(Exit.DONE)
    except Exception as error:  # typer raises click's usage errors; click is typer's own part
        if type(error).__name__ == "NoArgsIsHelpError":
            sys.stdout.write(f"{error}\n")
            sys.exit(Exit.DONE)
        if type(error).__name__ == "Abort":
            fail("a question was not answered; nothing was done")
        message = getattr(error, "format_message", None)
        if message is None:
            raise
        fail(message().replace("Value error, ", ""))  # of the library, about our own words


def fail(message: str) -> None:
    """End with one line on stderr: it could not be done."""
    sys.stderr.write(f"acus: {' '.join(message.split())}\n")
    sys.exit(Exit.NOT_DONE)


if __name__ == "__main__":
    main()
