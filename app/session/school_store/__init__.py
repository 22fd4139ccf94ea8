"""The store that the stations of a school share, by URL (extra `school`).

A station keeps what it has in its own files and goes on without the store. What it made it puts
there as *packets*: small files of results, signed by it, about one attempt, or one student's
remarks, or one erasure; the station that gives the course puts that there too. It takes in what
others put there, by the rules of `gathering`, so that in whatever order and however often, all
stations end with the same. The store itself is trusted with nothing but keeping them.

The door: `SchoolStore`, `synchronise`, and `place_of_store`, where it is.
"""

from app.session.school_store.errors import StoreError, UnreachableStoreError
from app.session.school_store.place import (
    StorePlace,
    place_of_store,
    put_place,
    require_password,
)
from app.session.school_store.store import SchoolStore
from app.session.school_store.synchronising import Synchronised, synchronise

__all__ = [
    "SchoolStore",
    "StoreError",
    "StorePlace",
    "Synchronised",
    "UnreachableStoreError",
    "place_of_store",
    "put_place",
    "require_password",
    "synchronise",
]
