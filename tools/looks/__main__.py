"""Takes every page and state of the window as pictures, judges them and compares: `make looks`.

`python -m tools.looks [--only PATTERN] [--sizes …] [--languages …] [--themes …] [--keep]` writes
`out/looks` with `index.html`, and ends with 1 if a rule is broken or a picture differs from the one
kept in `tests/data/looks` (English, dark, 1366×768). `--keep` puts the new ones there. The language
`pseudo` has words 40 % longer. Each language has a process, settings and data of its own.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Final

from tools.looks.gallery import KEPT, SIZES, THEMES, Gallery, Look, Wish, size_of
from tools.looks.page import write

ROOT: Final = Path(__file__).resolve().parents[2]
OUT: Final = ROOT / "out" / "looks"
STORE: Final = ROOT / "tests" / "data" / "looks"
LANGUAGES: Final = ("en", "de", "fr", "pseudo")
SHOWN: Final = 12


def take(folder: Path, wish: Wish) -> None:
    """Take the pictures of one language in this process, and write what was found of them."""
    from app.core.language import ENGLISH
    from app.views.kit.language import choose, use_language
    from app.views.shell.application import start
    from app.views.shell.settings import open_settings
    from tools.looks.pseudo import Longer
    from tools.looks.states import taken

    application = start()
    pseudo = wish.language == "pseudo"
    code = ENGLISH if pseudo else wish.language
    choose(open_settings(), code)
    use_language(application, code)
    longer = Longer(application)
    if pseudo:
        application.installTranslator(longer)
    gallery = taken(folder, lambda sessions: Gallery(folder, sessions, wish))
    facts = {"looks": [look.facts() for look in gallery.looks], "broken": gallery.broken}
    (folder / f"{wish.language}.json").write_text(json.dumps(facts, indent=1), encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)  # what Qt would take apart at the end is left as it is


def beside(folder: Path, wish: Wish) -> tuple[list[Look], list[str]]:
    """Take the pictures of one language in a process of its own."""
    order = [sys.executable, "-m", "tools.looks", "--child", "--languages", wish.language]
    order += ["--sizes", *wish.sizes, "--themes", *wish.themes, "--only", *wish.only]
    order += ["--out", str(folder)]
    found = folder / f"{wish.language}.json"
    found.unlink(missing_ok=True)
    with tempfile.TemporaryDirectory() as own:
        around = {
            "ACUS_SETTINGS": f"{own}/settings",
            "ACUS_DATA": f"{own}/data",
            "QT_QPA_PLATFORM": f"offscreen:configfile={screen(Path(own))}",
            "LC_ALL": "C.UTF-8",
        }
        ended = subprocess.run(order, cwd=ROOT, env=os.environ | around, check=False)
    if not found.is_file():
        return [], [f"{wish.language}: ended with {ended.returncode}"]
    facts = json.loads(found.read_text(encoding="utf-8"))
    return [Look(**one) for one in facts["looks"]], facts["broken"]


def screen(folder: Path) -> Path:
    """Write for Qt how large the screen in memory is; return the file.

    Qt's own would be 800 by 800, to which dialogs would be cut.
    """
    size = size_of(SIZES[0])
    one = {"name": "looks", "x": 0, "y": 0, "width": size.width(), "height": size.height()}
    one |= {"logicalDpi": 96, "logicalBaseDpi": 96, "dpr": 1}
    file = folder / "screen.json"
    file.write_text(json.dumps({"screens": [one]}), encoding="utf-8")
    return file


def compare(looks: Iterable[Look], folder: Path) -> None:
    """Note how much the pictures differ from those that are kept."""
    from tools.looks.measure import difference

    for look in looks:
        kept = STORE / f"{look.state}.png"
        if (look.language, look.size, look.theme) == KEPT and kept.is_file():
            look.differs = difference(kept, folder / look.file)


def keep(looks: Iterable[Look], folder: Path) -> int:
    """Put the pictures that are kept in their place; return their bytes."""
    STORE.mkdir(parents=True, exist_ok=True)
    for look in looks:
        if (look.language, look.size, look.theme) == KEPT:
            shutil.copyfile(folder / look.file, STORE / f"{look.state}.png")
    return sum(path.stat().st_size for path in STORE.glob("*.png"))


def main() -> int:
    """Take, judge, compare, and write the page."""
    parser = argparse.ArgumentParser(prog="python -m tools.looks", description=__doc__)
    parser.add_argument("--only", nargs="*", default=[], metavar="PATTERN", help="names of states")
    parser.add_argument("--sizes", nargs="+", default=list(SIZES))
    parser.add_argument("--languages", nargs="+", default=list(LANGUAGES))
    parser.add_argument("--themes", nargs="+", default=list(THEMES), help="dark, light, large")
    parser.add_argument("--keep", action="store_true", help="keep the new pictures")
    parser.add_argument("--out", type=Path, default=OUT)
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    folder = given.out.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    many = (tuple(given.sizes), tuple(given.themes), tuple(given.only))
    if given.child:
        take(folder, Wish(given.languages[0], *many))
    begin = time.monotonic()
    looks: list[Look] = []
    broken: list[str] = []
    for language in given.languages:
        wish = Wish(language, *many)
        if language == "pseudo":
            wish = Wish(language, SIZES[:1], THEMES[:1], wish.only)
        some, reasons = beside(folder, wish)
        looks, broken = looks + some, broken + reasons
    if not looks and not broken:
        broken = [f"no state is called {' or '.join(given.only)}: nothing was judged"]
    if given.keep:
        print(f"{keep(looks, folder) / 1e6:.1f} MB are kept in {STORE.relative_to(ROOT)}")
    compare(looks, folder)
    page = write(looks, folder, STORE)
    return told(looks, broken, page, time.monotonic() - begin)


def told(looks: list[Look], broken: list[str], page: Path, seconds: float) -> int:
    """Print what was found; return 1 if something is wrong."""
    from tools.looks.measure import TOLERANCE

    where: dict[tuple[str, str, str], list[Look]] = {}
    for look in looks:
        for fault in look.faults:
            where.setdefault((fault["rule"], fault["where"], fault["words"]), []).append(look)
    rules = Counter(rule for rule, _, _ in where)
    for (rule, widget, words), seen in sorted(where.items()):
        states = Counter(f"{look.state} ({look.language})" for look in seen)
        more = f" and {len(states) - 1} more" if len(states) > 1 else ""
        print(f"{rule}: {widget}: {words}: {next(iter(states))}{more}")
    other = [look for look in looks if look.differs is not None and look.differs > TOLERANCE]
    for look in other:
        print(f"differs: {look.state}: {100 * (look.differs or 0.0):.1f} % of it")
    print("\n".join(broken))
    words = ", ".join(f"{count} {rule}" for rule, count in sorted(rules.items())) or "none"
    names = {look.state for look in looks}
    print(f"{len(looks)} pictures of {len(names)} states in {seconds:.0f} s; faults: {words}")
    print(f"{len(other)} differ from what is kept; {page}")
    return int(bool(where or other or broken))


if __name__ == "__main__":
    sys.exit(main())
