"""A child of the worker that crashes while it writes the third file of an import."""

import os
import sys

from app.imaging.privacy import deidentifying
from app.imaging.worker import child

_convert = deidentifying.convert


def convert(header, to, *rest):
    if to.name.startswith("000003"):
        os.abort()
    return _convert(header, to, *rest)


if __name__ == "__main__":
    deidentifying.convert = convert
    child.main(sys.argv[1])
