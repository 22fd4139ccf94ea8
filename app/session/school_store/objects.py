"""Files of packets outside the database: in a folder or an S3-like store, by fsspec.

Each lies under its SHA-256, so that writing it twice is writing it once, and what is read is
checked.
"""

from __future__ import annotations

import hashlib
from typing import Any

from app.core.extras import not_installed
from app.core.messages import sentence
from app.session.school_store.errors import StoreError, UnreachableStoreError


class Objects:
    """A place for files by digest.

    Args:
        url: of fsspec, such as `s3://bucket/acus`, or `file:///mnt/school/objects`.
        options: of its file system, such as `endpoint_url`.

    Raises:
        StoreError: if there is no such kind of place, or what it needs is not installed.
    """

    def __init__(self, url: str, **options: Any) -> None:
        try:
            import fsspec
        except ImportError as error:
            raise not_installed(StoreError, "fsspec", "school") from error
        try:
            self._files, self._root = fsspec.core.url_to_fs(url, **options)
        except (ImportError, ValueError) as error:
            raise StoreError(
                sentence(
                    "{url} is no place for objects: {reason}",
                    url=url.partition("://")[0],
                    reason=error,
                )
            ) from error

    def put(self, digest: str, data: bytes) -> None:
        """Keep a file; one that is there is not written again.

        Raises:
            UnreachableStoreError: if it cannot be written.
        """
        path = self._path(digest)
        try:
            if self._files.exists(path) and self._files.size(path) == len(data):
                return
            self._files.makedirs(path.rpartition("/")[0], exist_ok=True)
            part = f"{path}.part"
            self._files.pipe_file(part, data)
            self._files.mv(part, path)
        except Exception as error:  # each file system has errors of its own
            raise _unreachable(error) from error

    def get(self, digest: str) -> bytes:
        """Return a file.

        Raises:
            StoreError: if it is missing, or not what was kept.
            UnreachableStoreError: if it cannot be read.
        """
        try:
            data = bytes(self._files.cat_file(self._path(digest)))
        except FileNotFoundError as error:
            raise StoreError(_lost(digest)) from error
        except Exception as error:
            raise _unreachable(error) from error
        if hashlib.sha256(data).hexdigest() != digest:
            raise StoreError(_lost(digest))
        return data

    def remove(self, digest: str) -> None:
        """Delete a file; one that is not there was deleted already.

        Raises:
            UnreachableStoreError: if it cannot be deleted.
        """
        try:
            self._files.rm_file(self._path(digest))
        except FileNotFoundError:
            return
        except Exception as error:
            raise _unreachable(error) from error

    def _path(self, digest: str) -> str:
        return f"{self._root}/{digest[:2]}/{digest}"


def _lost(digest: str) -> str:
    return sentence(
        "the object {digest} of the school's store is missing or damaged: its administrator brings "
        "it back from a backup; the rest was taken",
        digest=digest[:16],
    )


def _unreachable(error: Exception) -> UnreachableStoreError:
    return UnreachableStoreError(
        sentence(
            "the objects of the school's store cannot be used: this station goes on and tries "
            "again ({reason})",
            reason=str(error)[:200],
        )
    )
