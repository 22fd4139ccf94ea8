import numpy as np
import pytest

from app.core import paths
from app.tracking.simulated.background import kept_or_traced

SHAPE = (4, 5, 3)


@pytest.fixture
def traced(tmp_path, monkeypatch):
    """Calls of the tracer; the cache is an empty folder."""
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path))
    return []


def tracer(calls, value=7.0):
    def trace():
        calls.append(1)
        return np.full(SHAPE, value, np.float32)

    return trace


def files():
    return list((paths.cache() / "backgrounds").glob("*.npy"))


def test_a_background_is_traced_once(traced):
    first = kept_or_traced((b"rig",), SHAPE, tracer(traced))
    second = kept_or_traced((b"rig",), SHAPE, tracer(traced))
    assert len(traced) == 1
    assert np.array_equal(first, second)
    assert second.dtype == np.float32


def test_another_camera_is_another_background(traced):
    kept_or_traced((b"a", b"bc"), SHAPE, tracer(traced))
    kept_or_traced((b"ab", b"c"), SHAPE, tracer(traced))
    assert len(traced) == len(files()) == 2


@pytest.mark.parametrize(
    "damage",
    [
        lambda path: path.write_bytes(b""),
        lambda path: path.write_bytes(b"not an array"),
        lambda path: path.write_bytes(path.read_bytes()[:-7]),
        lambda path: np.save(path, np.zeros((2, 2), np.float32)),
        lambda path: np.save(path, np.zeros(SHAPE)),
        lambda path: np.save(path, np.full(SHAPE, np.nan, np.float32)),
    ],
)
def test_a_damaged_file_is_traced_again(traced, damage):
    kept_or_traced((b"rig",), SHAPE, tracer(traced))
    damage(files()[0])
    again = kept_or_traced((b"rig",), SHAPE, tracer(traced))
    assert len(traced) == 2
    assert np.array_equal(again, np.full(SHAPE, 7.0))


def test_a_cache_that_cannot_be_written_is_no_reason_to_stop(traced, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ACUS_CACHE", str(tmp_path / "file"))
    assert kept_or_traced((b"rig",), SHAPE, tracer(traced)).shape == SHAPE


def test_only_the_newest_backgrounds_are_kept(traced):
    for number in range(20):
        kept_or_traced((b"%d" % number,), SHAPE, tracer(traced))
    assert len(files()) == 12
