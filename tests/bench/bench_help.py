"""`acus --help`, in turn with an empty interpreter and with the help drawn by rich, as before.

Each run is a process of its own.
"""

import subprocess
import sys
from functools import partial

from tests.bench.in_turn import compare

LIMIT_S, RUNS = 0.25, 20
WAYS = {
    "acus --help": ["-m", "app", "--help"],
    "interpreter alone": ["-c", "pass"],
    "the same drawn by rich": [
        "-c",
        "from app.commands import build; root = build(); root.rich_markup_mode = 'markdown';"
        "root(['--help'], prog_name='acus')",
    ],
}


def main() -> None:
    """Print the times of all ways."""
    start = partial(subprocess.run, stdout=subprocess.DEVNULL, check=True)
    compare(
        {name: partial(start, [sys.executable, *words]) for name, words in WAYS.items()},
        RUNS,
        LIMIT_S,
    )


if __name__ == "__main__":
    main()
