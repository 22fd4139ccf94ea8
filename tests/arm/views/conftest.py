"""The window of the tests of the views, and an arm that is made up."""

import threading
from types import SimpleNamespace

import pytest
from performance_rig import performance_of

from app.arm.features.arm import ArmFeature
from tests.views.conftest import (
    application,
    beginning,
    destroy,
    no_window_is_left_open,
    nothing_waits_for_a_person,
    patient,
    real,
    services,
    settle,
    volume,
    window,
)

__all__ = [
    "application",
    "beginning",
    "destroy",
    "no_window_is_left_open",
    "nothing_waits_for_a_person",
    "patient",
    "real",
    "services",
    "settle",
    "volume",
    "window",
]


@pytest.fixture(autouse=True)
def carrying(monkeypatch):
    """What the arm was asked for; `cannot` is raised; it waits where `waits` is cleared.

    `really` is what the arm itself does.
    """
    really = ArmFeature.carry_out
    asked = SimpleNamespace(carried=[], cannot=None, waits=threading.Event(), really=really)
    asked.waits.set()

    def carry_out(placed, seed, stands_deg, progress):
        asked.carried.append((placed, seed, stands_deg))
        while not asked.waits.wait(0.01):
            progress.report(0.5, "looking for the tool")
        if asked.cannot is not None:
            raise asked.cannot
        return performance_of(placed)

    monkeypatch.setattr(ArmFeature, "carry_out", staticmethod(carry_out))
    return asked
