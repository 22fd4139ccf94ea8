"""`python -m tests.fuzz [COUNT [SEED]]`: mutated files through the reader (`make fuzz`)."""

import sys
import tempfile
import time
from pathlib import Path

from app.core.progress import Progress
from tests.fuzz.campaign import MOST_CHILD_BYTES, MOST_SECONDS, campaign


def main() -> None:
    """Run a campaign and end with an error if a file broke the rule."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else int(time.time())
    print(f"{count} mutated files, seed {seed}", flush=True)
    begin = time.monotonic()

    def tell(fraction: float, text: str) -> None:
        if int(text.split()[0]) % 500 == 0:
            print(f"  {text}, {time.monotonic() - begin:.0f} s", flush=True)

    with tempfile.TemporaryDirectory(prefix="acus-fuzz-") as folder:
        tally = campaign(Path(folder), count, seed, Progress(tell))
    for outcome, times in tally.outcomes.most_common():
        print(f"  {outcome:26} {times}")
    print(f"  children lost              {tally.lost}")
    print(f"  slowest                    {tally.slowest_s:.2f} s (each file: {MOST_SECONDS})")
    print(f"  most memory of a child     {tally.child_bytes >> 20} MB")
    for text in tally.wrong:
        print(f"  WRONG {text}")
    sys.exit(bool(tally.wrong) or tally.child_bytes > MOST_CHILD_BYTES)


if __name__ == "__main__":
    main()
