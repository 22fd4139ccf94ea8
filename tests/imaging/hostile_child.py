"""A child of the worker that misbehaves at files of certain names, as hostile ones make it."""

import os
import sys
import time

from app.imaging.series import Ignored
from app.imaging.worker import child


def examine(path):
    if path.name == "crash":
        os.abort()
    if path.name == "exit":
        os._exit(3)
    while path.name == "hang":
        pass
    if path.name == "sleep":
        time.sleep(60)
    if path.name == "nonsense":
        os.write(int(sys.argv[1]), b"\x04\0\0\0nope")
    if path.name == "huge":
        os.write(int(sys.argv[1]), b"\xff\xff\xff\xff")
    if path.name == "memory":
        return Ignored(path, str(len(bytearray(1 << 40))))
    if path.name == "surprise":
        raise KeyError("surprise")
    if path.name == "wrong":
        return (Ignored(path, "no header"),)
    return Ignored(path, f"read {path.name}")


if __name__ == "__main__":
    child.examine = examine
    child.main(int(sys.argv[1]))
