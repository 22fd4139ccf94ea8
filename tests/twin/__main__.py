"""`python -m tests.twin [--minutes 10] [--seed 1] [--parts robot,slicer]`: the twin laboratory.

The firmware's host port as the robot, two cameras as streams, the trainer, Slicer, the laboratory's
GUI, an Orthanc and a record store, all as programs of their own; a scripted hand practises. Then
each part is killed, hung and restarted. Exit code 0: every listener heard what the records hold,
force ended in time, nothing was lost, it was said, and all was back by itself; 1: it was not so.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from contextlib import suppress

from tests.twin.laboratory import PARTS
from tests.twin.part import FAULTS
from tests.twin.run import Twin

AHEAD = -10
"""Niceness of all parts, where the system lets it; trainer and cameras come before the others."""


def main() -> int:
    """Run, and print the table."""
    parser = argparse.ArgumentParser(prog="python -m tests.twin", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="at least; all faults are done")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--parts", default=",".join(PARTS), help="which are there and have faults")
    parser.add_argument("--faults", default=",".join(FAULTS))
    parser.add_argument("--calm", type=float, default=30.0, help="seconds before the first fault")
    asked = parser.parse_args()
    parts = [one.strip() for one in asked.parts.split(",") if one.strip()]
    faults = [one.strip() for one in asked.faults.split(",") if one.strip()]
    if unknown := (set(parts) - set(PARTS)) | (set(faults) - set(FAULTS)):
        parser.error(f"{', '.join(sorted(unknown))}: there are {', '.join((*PARTS, *FAULTS))}")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # all parts are ended then too
    with suppress(OSError):  # a laboratory's computer does nothing else: not so where tests run
        os.setpriority(os.PRIO_PROCESS, 0, AHEAD)
    began = time.monotonic()
    twin = Twin(parts, faults, asked.seed, asked.calm, tell=lambda line: print(line, flush=True))
    outcome = twin.run(60.0 * asked.minutes)
    print(outcome.table())
    load = ", ".join(f"{one:.1f}" for one in os.getloadavg())
    print(f"\n{time.monotonic() - began:.0f} s; load {load} on {os.cpu_count()} processors")
    for line in outcome.broken:
        print(f"NO  {line}")
    print("every rule is kept" if not outcome.broken else f"{len(outcome.broken)} rules are broken")
    return 1 if outcome.broken else 0


if __name__ == "__main__":
    sys.exit(main())
