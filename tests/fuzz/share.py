"""The share of a campaign that one process does."""

import os
import time
import warnings
from pathlib import Path

from tests.fuzz.campaign import Tally, campaign


def share(folder: Path, count: int, seed: int, numbers: range, tells: bool) -> Tally:
    """Read a share of the files in this process."""
    os.environ["ACUS_SETTINGS"] = str(folder / "settings")
    os.environ["ACUS_DATA"] = str(folder / "data")
    warnings.simplefilter("ignore")  # what pydicom says of a value while it writes the seeds
    begin = time.monotonic()

    def tell(done: int) -> None:
        if tells and done % 250 == 0:
            share = f"{done} of {len(numbers)}"
            print(f"  {share}, {time.monotonic() - begin:.0f} s", flush=True)

    return campaign(folder, count, seed, numbers, tell)
