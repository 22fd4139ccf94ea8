"""Garbage collection that keeps nobody waiting."""

import gc
import weakref
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QObject

from app.core.progress import Progress
from app.mechanisms.pantograph import kernels
from app.mechanisms.profile import load_profile
from app.planning import patient
from app.planning.placement import PatientOrientation, Placement
from app.planning.plan import Plan
from app.planning.reach import reach
from app.views.kit.background import run_in_background
from app.views.shell.collector import FULL_EVERY, TRIMS, Collector, give_back


@pytest.fixture
def generations() -> Iterator[list[int]]:
    """Generations that were collected."""
    seen: list[int] = []

    def note(phase: str, info: dict[str, int]) -> None:
        if phase == "stop":
            seen.append(info["generation"])

    gc.callbacks.append(note)
    yield seen
    gc.callbacks.remove(note)


@pytest.fixture
def busy() -> list[bool]:
    return [False]


@pytest.fixture
def collector(application, busy) -> Iterator[Collector]:
    collector = Collector(lambda: busy[0])
    collector.open()
    collector.settle()
    yield collector
    collector.close()


def test_no_allocation_starts_a_collection_while_the_window_collects(collector, generations):
    kept = [[] for _ in range(20_000)]
    assert not gc.isenabled()
    assert generations == []
    assert len(kept) == 20_000


def test_a_window_takes_the_collection_over_from_python(application):
    before = gc.isenabled()
    gc.enable()  # the tests themselves have it off
    fresh = Collector(lambda: False)
    try:
        fresh.open()
        assert not gc.isenabled()
    finally:
        fresh.close()
        (gc.enable if before else gc.disable)()


def test_a_full_collection_waits_for_the_end_of_the_attempt(collector, busy, generations):
    busy[0] = True
    for _ in range(2 * FULL_EVERY):
        collector.collect()
    assert set(generations) == {1}
    busy[0] = False
    collector.collect()
    assert generations[-1] == 2


def test_nothing_is_walked_in_full_before_the_kernels_are_loaded(application):
    fresh = Collector(lambda: False)
    fresh.open()
    young = gc.get_stats()[2]["collections"]
    for _ in range(2 * FULL_EVERY):
        fresh.collect()
    assert gc.get_stats()[2]["collections"] == young
    fresh.close()


def test_full_collections_are_rare(collector, generations):
    for _ in range(3 * FULL_EVERY):
        collector.collect()
    assert generations.count(2) == 3


@pytest.mark.long("journey")
def test_what_was_settled_is_not_walked_again(collector):
    built = [[] for _ in range(1000)]
    before = gc.get_freeze_count()
    collector.settle()
    assert gc.get_freeze_count() >= before + len(built)


def test_a_cycle_that_dies_is_collected(collector):
    class Node:
        pass

    node = Node()
    node.me = node
    gone = weakref.ref(node)
    del node
    collector.collect()
    assert gone() is None


def test_a_window_that_closes_leaves_threads_that_still_stop_without_a_collection(collector):
    collector.close()
    collector.close()
    assert not gc.isenabled()


def test_reading_a_patient_loads_the_verdict_so_that_the_window_never_compiles(application):
    patient._load_verdict(Progress())
    compiled = {
        name: len(kernel.signatures)
        for name, kernel in vars(kernels).items()
        if hasattr(kernel, "signatures")
    }
    plan = Plan((-70.0, -110.0, 180.0), (-73.9, -25.5, 185.2))
    for orientation in PatientOrientation:
        reach(plan, Placement(orientation, (20.0, 0.0, 5.0)), load_profile("icube"))
    assert compiled == {name: len(vars(kernels)[name].signatures) for name in compiled}
    assert any(compiled.values())


class Ct:
    """Stands for a patient's hundreds of megabytes."""


@pytest.mark.long("journey")
def test_a_circle_that_was_left_out_of_the_walk_goes_with_the_patient_it_holds(collector, busy):
    class Circle:
        pass

    circle = Circle()
    circle.itself, circle.ct = circle, Ct()
    ct = weakref.ref(circle.ct)
    gc.freeze()  # as when a robot was started
    del circle
    gc.collect()
    assert ct() is not None
    busy[0] = True
    collector.leave()
    collector.collect()
    assert collector.waits
    assert ct() is not None
    busy[0] = False
    collector.collect()
    assert ct() is None
    assert collector.waits  # until what is free is given back as well
    for _ in range(TRIMS):
        collector.collect()
    assert not collector.waits


def test_a_task_that_is_over_holds_nothing_of_what_it_brought(application, settle):
    parent, brought = QObject(), []

    def take(ct):
        brought.append(weakref.ref(ct))

    gc.disable()
    run_in_background(parent, lambda _: Ct(), take, pytest.fail)
    assert settle(lambda: brought)
    assert settle(lambda: brought[0]() is None)
    gc.enable()


def test_freed_memory_is_given_back_without_an_error_on_every_system(monkeypatch):
    give_back()
    monkeypatch.setattr("sys.platform", "win32")
    give_back()
