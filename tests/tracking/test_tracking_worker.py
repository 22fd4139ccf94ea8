"""The tracker's thread: what it says when it outlives its end, and what it does not do after it."""

import threading

from app.tracking.tracker import Worker


def test_a_thread_that_outlives_its_end_is_named_and_publishes_nothing_more():
    told, published = [], []
    begun, release = threading.Event(), threading.Event()

    def step(stopped):
        begun.set()
        release.wait(30.0)
        if not stopped():
            published.append(1)

    worker = Worker(step, lambda kind, message: told.append((kind, message)))
    worker.open()
    assert worker.is_open
    assert begun.wait(30.0)
    worker.stop()
    worker.join(patience=0.02)
    assert not worker.is_open
    assert told[0][0] == "tracker"
    assert "does not count" in told[0][1]
    worker.open()  # the one left behind stays stopped
    first = [thread for thread in threading.enumerate() if thread.name == "tracker"]
    worker.stop()
    release.set()
    worker.join()
    for thread in first:
        thread.join(30.0)
    assert not any(thread.is_alive() for thread in first)
    assert published == []
    assert len(told) == 1
    worker.join()  # closing twice is fine


def test_a_step_that_fails_is_told_once_until_one_succeeds():
    told, count, done = [], [0], threading.Event()

    def step(stopped):
        count[0] += 1
        if count[0] < 4:
            raise ValueError("no picture")
        worker.fault = ""
        done.set()

    worker = Worker(step, lambda kind, message: told.append((kind, message)))
    worker.open()
    assert done.wait(30.0)
    worker.stop()
    worker.join()
    assert told == [("fault", "the tracker failed: ValueError: no picture")]
    assert worker.fault == ""
