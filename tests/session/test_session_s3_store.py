"""Packets' files in an S3-like store, against moto's server, which is another project's."""

import hashlib
import os
import socket
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from s3_rig import KEYS, S3
from school_stations import headed, pool
from test_session_school_store import made, meet

from app.session.index import Index
from app.session.people import People
from app.session.school_store import StorePlace
from app.session.school_store.errors import StoreError, UnreachableStoreError
from app.session.school_store.objects import Objects
from app.session.school_store.synchronising import waiting
from app.session.station import StationKey

pytestmark = pytest.mark.long("journey")


@pytest.fixture
def server() -> Iterator[S3]:
    server = S3()
    server.start()
    yield server
    server.kill()


def objects_at(endpoint: str, bucket: str = "school", seconds: float = 10.0) -> Objects:
    return Objects(f"s3://{bucket}/acus", seconds, endpoint=endpoint, **KEYS)


def test_what_is_put_is_got_once_and_gone_when_removed(server: S3) -> None:
    objects, data = objects_at(server.endpoint), os.urandom(3_000_000)
    digest = hashlib.sha256(data).hexdigest()
    for _ in range(2):
        objects.put(digest, data)
    assert objects.get(digest) == data
    objects.remove(digest)
    objects.remove(digest)
    with pytest.raises(StoreError, match="missing or damaged"):
        objects.get(digest)


def test_stations_meet_in_a_store_whose_files_are_there_and_a_lost_server_loses_nothing(
    server: S3, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = {"endpoint": server.endpoint, **KEYS}
    url = f"sqlite:///{tmp_path / 'school.sqlite'}"
    place = made(StorePlace(url, "s3://school/acus", options, seconds=3.0))
    head = headed(tmp_path / "head", monkeypatch)
    for key in sorted(pool()[1]):
        head.record(key)
    number = len(list(head.folder.glob("*.mcap")))
    server.kill()
    with pytest.raises(UnreachableStoreError, match="this station goes on") as refused:
        meet(head, place)
    assert "\n" not in str(refused.value)
    assert waiting(head.enter(), StationKey.of()) == number
    server.start()
    meet(head, place)
    assert waiting(head.enter(), StationKey.of()) == 0
    second = type(head)(tmp_path / "second", "second", monkeypatch)
    second.enter().set_instructor("correct horse battery")
    meet(second, place)
    index = Index(second.folder)
    index.refresh()
    assert [one.verdict.partition(" (")[0] for one in index.attempts()] == ["verified"] * number
    assert People().everybody()


def test_a_server_that_is_killed_in_a_write_is_one_line_and_the_next_try_is_whole(
    server: S3,
) -> None:
    objects, data = objects_at(server.endpoint, seconds=3.0), os.urandom(120_000_000)
    digest = hashlib.sha256(data).hexdigest()
    killer = threading.Timer(0.15, server.kill)
    killer.start()
    with pytest.raises(UnreachableStoreError) as refused:
        objects.put(digest, data)
    killer.join()
    assert "\n" not in str(refused.value)
    server.start()
    objects = objects_at(server.endpoint)
    with pytest.raises(StoreError, match="missing or damaged"):
        objects.get(digest)
    objects.put(digest, data[:1000])  # what was cut by whom ever is written anew
    objects.put(digest, data)
    assert objects.get(digest) == data


def test_a_server_that_does_not_answer_is_left_after_the_time_that_is_allowed() -> None:
    with socket.create_server(("127.0.0.1", 0)) as silent:
        endpoint = f"http://127.0.0.1:{silent.getsockname()[1]}"
        began = time.monotonic()
        with pytest.raises(UnreachableStoreError, match="this station goes on"):
            objects_at(endpoint, seconds=1.0).put("ab" * 32, b"data")
        assert time.monotonic() - began < 10.0


def test_no_such_bucket_and_a_wrong_key_are_one_line_each(server: S3) -> None:
    with pytest.raises(UnreachableStoreError, match="no such bucket"):
        objects_at(server.endpoint, "nobucket").put("ab" * 32, b"data")
    strict = S3(checks_keys=True)
    strict.start()
    try:
        with pytest.raises(UnreachableStoreError, match="does not know this key"):
            objects_at(strict.endpoint).put("ab" * 32, b"data")
    finally:
        strict.kill()


def test_a_place_says_its_options_to_no_message(server: S3, tmp_path: Path) -> None:
    options = {"endpoint": server.endpoint, **KEYS, "secret_access_key": "very secret"}
    place = replace(made(StorePlace(f"sqlite:///{tmp_path / 's'}")), objects="s3://nobucket/a")
    place = replace(place, options=options)
    objects = Objects(place.objects, **place.options)
    with pytest.raises(UnreachableStoreError) as refused:
        objects.put("ab" * 32, b"data")
    assert "very secret" not in str(refused.value)
