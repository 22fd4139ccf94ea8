"""Slicer: pyigtl as a client of OpenIGTLink. `python -m tests.twin.slicer PORT OUT`.

Each message is a line of JSON: when it came, its device and its stamp [s since 1970], its matrix.
"""

from __future__ import annotations

import json
import sys
import time

import pyigtl

SILENT = 3.0
"""After so long without a word [s] it connects anew: it is told a STATUS every second."""


def main(port: str, out: str) -> None:
    with open(out, "a", buffering=1) as told:
        while True:
            client = pyigtl.OpenIGTLinkClient("127.0.0.1", int(port))
            heard = time.monotonic()
            while time.monotonic() - heard < SILENT:
                for one in client.get_latest_messages():
                    heard = time.monotonic()
                    line = {"at": time.time(), "name": one.device_name, "stamp": one.timestamp}
                    if hasattr(one, "matrix"):
                        line["matrix"] = one.matrix.tolist()
                    if hasattr(one, "string"):
                        line["words"] = one.string
                    told.write(json.dumps(line) + "\n")
                time.sleep(0.003)
            client.stop()


if __name__ == "__main__":
    print("listens", flush=True)
    main(*sys.argv[1:])
