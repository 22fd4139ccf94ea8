import threading

import pytest

from app.core import state_vector
from app.core.arrays import angle_between, frozen, unit
from app.core.clock import SystemClock, VirtualClock
from app.core.errors import NumericalError
from app.core.events import Event, EventQueue
from app.core.latest import Latest
from app.core.progress import Cancelled, Progress


def test_the_latest_value_carries_its_own_time():
    latest = Latest()
    assert latest.read() is None
    latest.publish("a", 1.0)
    latest.publish("b", 2.5)
    assert latest.read().value == "b"
    assert latest.read().age(4.0) == pytest.approx(1.5)


def test_events_are_seen_once_and_a_loss_is_counted():
    queue = EventQueue(capacity=2)
    for time in (1.0, 2.0, 3.0):
        queue.put(Event(time, "scan", ""))
    assert [event.time for event in queue.drain()] == [2.0, 3.0]
    assert queue.drain() == []
    assert queue.lost == 1


def test_cancelling_from_another_thread_stops_the_work_and_its_parts():
    progress = Progress()
    threading.Thread(target=progress.cancel).start()
    with pytest.raises(Cancelled):
        _work_for_ever(progress)


def _work_for_ever(progress):
    while True:
        progress.part(0.2, 0.4).report(0.5)


def test_a_part_maps_onto_its_share():
    seen = []
    Progress(lambda fraction, text: seen.append((fraction, text))).part(0.5, 1.0).report(
        0.5, "half"
    )
    assert seen == [(0.75, "half")]


def test_virtual_time_moves_only_when_told():
    clock = VirtualClock(3.0)
    clock.sleep(0.5)
    assert clock.now() == 3.5
    assert SystemClock().now() <= SystemClock().now()


def test_every_slot_has_its_own_place_and_inputs_come_first():
    places = sorted(state_vector.INDEX.values())
    assert len(set(places)) == len(places)
    assert max(places) < state_vector.SLOTS == len(state_vector.empty_state())
    assert state_vector.INDEX["hold_breath"] < state_vector.INPUTS <= state_vector.INDEX["time"]


@pytest.mark.parametrize("bad", [[0, 0, 0], [float("nan"), 0, 1], [float("inf"), 0, 0]])
def test_what_has_no_direction_is_refused(bad):
    with pytest.raises(NumericalError, match="no direction"):
        unit(bad)


@pytest.mark.parametrize("scale", [1e-290, 1e-12, 1.0, 1e12, 1e290])
def test_directions_of_any_size_become_unit(scale):
    assert unit([3 * scale, 0, 4 * scale]) == pytest.approx([0.6, 0, 0.8], rel=1e-14)


@pytest.mark.parametrize("angle", [1e-12, 1e-8, 1.0, 3.14159265])
def test_small_and_flat_angles_keep_their_digits(angle):
    import numpy as np

    assert angle_between([1, 0, 0], [np.cos(angle), np.sin(angle), 0]) == pytest.approx(
        angle, rel=1e-9
    )


def test_frozen_arrays_are_copies_that_cannot_be_written():
    import numpy as np

    source = np.ones(3)
    array = frozen(source, (3,))
    source[0] = 5.0
    assert array[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 2.0
