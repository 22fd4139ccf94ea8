"""Files of packets outside the database: in a folder or an S3-like store, by fsspec.

Each lies under its SHA-256, so that writing it twice is writing it once, and what is read is
checked.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from datetime import timedelta
from typing import Any, Final

from app.core.extras import not_installed
from app.core.messages import sentence
from app.session.school_store.errors import StoreError, UnreachableStoreError


class Objects:
    """A place for files by digest.

    Args:
        url: of fsspec, such as `s3://bucket/acus`, or `file:///mnt/school/objects`.
        seconds: that an answer may take, of an S3-like store.
        options: of its file system; of an S3-like store `endpoint`, `access_key_id`,
            `secret_access_key`, `region`, which else come from the variables `AWS_…`.

    Raises:
        StoreError: if there is no such kind of place, or what it needs is not installed.
    """

    def __init__(self, url: str, seconds: float = 10.0, **options: Any) -> None:
        try:
            import fsspec
        except ImportError as error:
            raise not_installed(StoreError, "fsspec", "school") from error
        self._whole = url.startswith("s3://")  # what is put there is there whole, or not at all
        try:
            if self._whole:
                self._files, self._root = _s3(seconds, options), url.removeprefix("s3://")
            else:
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
            if self._whole:
                self._files.pipe_file(path, data)
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


def _s3(seconds: float, options: Mapping[str, Any]) -> Any:
    """Return the file system of an S3-like store; nothing is asked there yet."""
    try:
        from obstore.fsspec import FsspecStore
    except ImportError as error:
        raise not_installed(StoreError, "obstore", "school") from error
    store: Any = FsspecStore  # what it passes on to fsspec is not in its types
    plain = str(options.get("endpoint", "")).startswith("http://")
    return store(
        "s3",
        config={"region": "us-east-1", **options},
        client_options={
            "allow_http": plain,
            "timeout": f"{seconds:g}s",
            "connect_timeout": f"{seconds / 2:g}s",
        },
        retry_config={"max_retries": 1, "retry_timeout": timedelta(seconds=seconds)},
        skip_instance_cache=True,
    )


def _lost(digest: str) -> str:
    return sentence(
        "the object {digest} of the school's store is missing or damaged: its administrator brings "
        "it back from a backup; the rest was taken",
        digest=digest[:16],
    )


_REFUSED: Final = ("InvalidAccessKeyId", "SignatureDoesNotMatch", "AccessDenied", "403", "401")
_NO_BUCKET: Final = ("NoSuchBucket",)
_FULL: Final = ("No space left", "Errno 122", "Disk quota")
_SLOW: Final = ("timed out", "timeout", "TimedOut")


def _unreachable(error: Exception) -> UnreachableStoreError:
    text = f"{type(error).__name__}: {error}"
    why: str = str(error).strip().partition("\n")[0][:200]
    if any(each in text for each in _NO_BUCKET):
        why = sentence("there is no such bucket: its administrator makes it")
    elif any(each in text for each in _REFUSED):
        why = sentence("it does not know this key: give that of its administrator")
    elif any(each in text for each in _FULL):
        why = sentence("they have no room left: their administrator makes some; nothing is lost")
    elif any(each in text for each in _SLOW):
        why = sentence("it takes too long to answer")
    return UnreachableStoreError(
        sentence(
            "the objects of the school's store cannot be used: this station goes on and tries "
            "again ({reason})",
            reason=why,
        )
    )
