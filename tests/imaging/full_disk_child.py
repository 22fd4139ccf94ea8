"""A child of the worker on a disk that is full after a few files."""

import errno
import sys

import pydicom

from app.imaging import sources
from app.imaging.worker import child

FILES = 2
_save = pydicom.dataset.FileDataset.save_as
_saved = []


def extract(*arguments):
    raise OSError(errno.ENOSPC, "No space left on device")


def save(self, path, **how):
    if len(_saved) >= FILES:
        raise OSError(errno.ENOSPC, "No space left on device")
    _saved.append(path)
    return _save(self, path, **how)


if __name__ == "__main__":
    sources._extract = extract
    pydicom.dataset.FileDataset.save_as = save
    child.main(sys.argv[1])
