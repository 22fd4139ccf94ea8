"""`python -m tests.careless [--minutes 10] [--seed 1] [--plant CHECK]`: a careless user at work.

Starts the window on an X server of its own, again whenever the user has closed it. After a failure
the list of actions is halved as long as it still fails, and printed with the seed and how often it
repeats. Exit code 0: nothing failed; 3: something did; 2: it could not be run.
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
from pathlib import Path

from tests.careless.actions import Action, read_actions

ROOT = Path(__file__).resolve().parents[2]
REPEATS = 3
DONE, NOT_POSSIBLE, FAILED = 0, 2, 3


def main() -> int:
    """Read the options, use the window, tell."""
    parser = argparse.ArgumentParser(prog="python -m tests.careless", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--plant", help="a defect to be found, by the name of its check")
    parser.add_argument("--keep", type=Path, help="folder for actions and pictures")
    parser.add_argument("--whole", action="store_true", help="do not look for a shorter list")
    parser.add_argument("--busy", action="store_true", help="beside others: answers may take 5 s")
    parser.add_argument("--go-on", action="store_true", help="collect failures, shorten none")
    options = parser.parse_args()
    missing = [tool for tool in ("xvfb-run", "xdotool") if shutil.which(tool) is None]
    if missing:
        print(f"{', '.join(missing)} not found: `make setup` installs it", file=sys.stderr)
        return NOT_POSSIBLE
    folder = options.keep or Path(tempfile.mkdtemp(prefix="acus-careless-"))
    folder.mkdir(parents=True, exist_ok=True)
    end, part, count = time.monotonic() + 60.0 * options.minutes, 0, 0
    while time.monotonic() < end:
        run = folder / f"part-{part}"
        left = end - time.monotonic()
        code = use(
            run,
            options.seed * 1000 + part,
            left,
            options.plant,
            go_on=options.go_on,
            busy=options.busy,
        )
        if not (run / "actions.jsonl").exists():
            print(f"seed {options.seed}, part {part}: the window did not open (exit code {code})")
            print((run / "stderr.txt").read_text()[-4000:])
            return NOT_POSSIBLE
        actions = read_actions(run / "actions.jsonl")
        count += len(actions)
        if code != 0:
            tell(run, options.seed, part, actions, code)
            if not (options.whole or options.go_on):
                shorten(folder, actions, failures(run, code), options.plant)
            return FAILED
        part += 1
    print(f"seed {options.seed}: {count} actions in {options.minutes:g} min, nothing failed")
    return DONE


def use(
    folder: Path,
    seed: int,
    seconds: float,
    plant: str | None,
    replay: Path | None = None,
    go_on: bool = False,
    busy: bool = False,
) -> int:
    """Let the user at a fresh window with folders of its own; returns the window's exit code."""
    shutil.rmtree(folder, ignore_errors=True)
    home = folder / "home"
    home.mkdir(parents=True)
    own = {"ACUS_DATA": "data", "ACUS_SETTINGS": "settings", "ACUS_SESSIONS": "sessions"}
    environment = os.environ | {name: str(folder / place) for name, place in own.items()}
    environment |= {"HOME": str(home), "PYTHONPATH": str(ROOT), "PYTHONFAULTHANDLER": "1"}
    environment.setdefault("ACUS_CACHE", str(_cache()))
    for name in ("DISPLAY", "QT_QPA_PLATFORM"):
        environment.pop(name, None)
    command = ["xvfb-run", "--auto-servernum", "--server-args=-screen 0 1920x1080x24"]
    command += [sys.executable, "-m", "tests.careless.window", str(folder), "--seed", str(seed)]
    command += ["--seconds", f"{seconds:.0f}"]
    command += ["--plant", plant] if plant else []
    command += ["--replay", str(replay)] if replay is not None else []
    command += ["--go-on"] if go_on else []
    command += ["--answer", "5"] if busy else []
    for ct in _patients():
        command += ["--ct", str(ct)]
    with (folder / "stderr.txt").open("w") as said:
        try:
            done = subprocess.run(
                command,
                cwd=home,
                env=environment,
                stdout=said,
                stderr=said,
                timeout=seconds + 400.0,
            )
        except subprocess.TimeoutExpired:
            return -1
    return done.returncode


def failures(folder: Path, code: int) -> set[str]:
    """Return the names of the checks that failed in a run."""
    lines = (json.loads(line) for line in (folder / "actions.jsonl").read_text().splitlines())
    found = {line["failed"] for line in lines if "failed" in line}
    return found or ({f"exit {code}"} if code != 0 else set())


def tell(folder: Path, seed: int, part: int, actions: list[Action], code: int) -> None:
    """Print what failed, and where the list of actions lies."""
    print(f"seed {seed}, part {part}: failed after {len(actions)} actions (exit code {code})")
    for line in (folder / "actions.jsonl").read_text().splitlines():
        value = json.loads(line)
        if "failed" in value:
            print(f"  {value['failed']}: {value['words']}")
    if code not in (0, FAILED):
        print((folder / "stderr.txt").read_text()[-4000:])
    print("last actions:", *(f"  {action.text()}" for action in actions[-8:]), sep="\n")
    print(f"all of them, and a picture: {folder}")


def shorten(folder: Path, actions: list[Action], wanted: set[str], plant: str | None) -> None:
    """Halve the list of actions as long as one half still fails alike, and print what is left."""
    trial = 0

    def fails(some: list[Action]) -> bool:
        nonlocal trial
        trial += 1
        file = folder / f"trial-{trial}.jsonl"
        file.write_text("\n".join(action.text() for action in some))
        run = folder / f"trial-{trial}"
        code = use(run, 0, 2.0 * len(some) + 60.0, plant, file)
        return bool(failures(run, code) & wanted)

    halving = True
    while halving and len(actions) > 1:
        middle = len(actions) // 2
        halving = False
        for half in (actions[middle:], actions[:middle]):
            if fails(half):
                actions, halving = half, True
                break
    count = sum(fails(actions) for _ in range(REPEATS))
    print(f"repeats {count} of {REPEATS} with these {len(actions)} actions:")
    print(*(f"  {action.text()}" for action in actions), sep="\n")


def _patients() -> list[Path]:
    data = Path(os.environ.get("ACUS_TEST_DATA", ROOT.parent / "shared" / "data"))
    return [path for name in ("ct_chest_lidc0314", "ct_phantom_study", "ct_enhanced")
            if (path := data / name).is_dir()]  # fmt: skip


def _cache() -> Path:
    from app.core import paths

    return paths.cache()


if __name__ == "__main__":
    sys.exit(main())
