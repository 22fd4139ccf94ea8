"""Print the deepest chain of calls of a program and what it takes of the stack: `make stack`.

Reads what gcc writes with `-fcallgraph-info=su`: functions with their bytes, and who calls whom.
Fails where a function's share is not known before it runs, or one calls itself.
"""

import re
import sys
from pathlib import Path

FRAME = 104
"""Bytes that a Cortex-M4 puts on the stack for an interrupt, with the floats and aligned."""

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "[^"]*?\\n(\d+) bytes \((\w+)\)')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')


def read(files: list[Path]) -> tuple[dict[str, int], dict[str, set[str]]]:
    """Return bytes of each function, and whom it calls, by plain names.

    Raises:
        ValueError: for a function whose bytes depend on what it is given.
    """
    sizes: dict[str, int] = {}
    calls: dict[str, set[str]] = {}
    for file in files:
        text = file.read_text(encoding="utf-8")
        for title, size, kind in NODE.findall(text):
            if kind != "static":
                raise ValueError(f"{title}: its stack is {kind}")
            sizes[title.rpartition(":")[2]] = int(size)
        for source, target in EDGE.findall(text):
            calls.setdefault(source.rpartition(":")[2], set()).add(target.rpartition(":")[2])
    return sizes, calls


def deepest(
    name: str, sizes: dict[str, int], calls: dict[str, set[str]], above: tuple[str, ...] = ()
) -> tuple[int, tuple[str, ...]]:
    """Return the bytes of the deepest chain from a function, and the chain.

    Raises:
        ValueError: for a function that calls itself, or one of which nothing is known.
    """
    if name in above:
        raise ValueError(f"{name} calls itself, by {' > '.join(above)}")
    if name not in sizes:
        raise ValueError(
            f"nothing is known of {name}, called by {above[-1] if above else 'nobody'}"
        )
    below = [deepest(one, sizes, calls, (*above, name)) for one in calls.get(name, ())]
    size, chain = max(below, default=(0, ()))
    return sizes[name] + size, (name, *chain)


def worst(folder: Path, roots: tuple[str, ...] = ("reset", "on_tick", "on_serial")) -> int:
    """Print the chain of each way in; return the bytes of all of them on top of each other."""
    sizes, calls = read(sorted(folder.glob("stm32f405.elf-*.ci")))
    total = 0
    for place, root in enumerate(roots):
        size, chain = deepest(root, sizes, calls)
        total += size + (FRAME if place else 0)
        print(f"{size:5} bytes  {' > '.join(chain)}")
    print(f"{total:5} bytes  all of them, with {FRAME} for each interrupt")
    return total


if __name__ == "__main__":
    worst(Path(sys.argv[1]))
