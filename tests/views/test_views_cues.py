"""What of an attempt is told to the ear."""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.core.arrays import read_only
from app.planning.off_path import Offset
from app.session.machine import State
from app.views.sounds.feature import Cue, CueKind, Cues

REST = np.zeros(3)
ZERO = read_only(np.zeros(3))


@dataclass(frozen=True)
class Moment:
    """What cues look at of a snapshot."""

    depth: float = -0.01
    lateral: float = 0.0
    state: State = State.INSERTING
    measured: bool = True
    p_target: np.ndarray = field(default_factory=lambda: np.zeros(3))
    touch: object = None

    @property
    def pose(self):
        return SimpleNamespace(measured=self.measured, depth=self.depth)

    @property
    def offset(self):
        remaining = 0.08 - self.depth
        distance = float(np.hypot(self.lateral, remaining))
        return Offset(self.lateral, remaining, distance, 0.0, ZERO, ZERO)


@pytest.fixture
def cues():
    return Cues(length=0.08, off_path=0.005, at_target=0.002, along=0.002)


def told(cues, *moments):
    return [cue.kind.value for moment in moments for cue in cues.of(moment, REST)]


def test_each_five_millimetres_deeper_are_heard_once_and_higher(cues):
    found = [c for mm in np.arange(-4.9, 77, 0.5) for c in cues.of(Moment(mm / 1000), REST)]
    assert [c.kind for c in found] == [CueKind.DEEPER] * 15
    assert [int(c.depth * 1000) for c in found] == list(range(5, 80, 5))
    assert np.all(np.diff([c.share for c in found]) > 0)


def test_a_hand_that_trembles_at_a_step_is_not_heard_again_and_again(cues):
    tremble = [Moment(0.02 + 0.0003 * (-1) ** n) for n in range(40)]
    assert told(cues, *tremble) == ["deeper"]
    assert told(cues, Moment(0.012), Moment(0.0201)) == ["deeper"]


def test_leaving_the_path_and_coming_back_are_heard_with_a_margin(cues):
    inside, at_limit, outside = Moment(0.01), Moment(0.01, 0.0051), Moment(0.01, 0.006)
    assert told(cues, inside) == ["deeper"]
    assert told(cues, at_limit, Moment(0.01, 0.0049), at_limit) == ["off_path"]
    assert told(cues, Moment(0.01, 0.0039), outside) == ["on_path", "off_path"]


def test_before_the_skin_a_needle_beside_the_path_is_not_told(cues):
    assert told(cues, Moment(-0.01, 0.02)) == []


def test_the_target_is_told_once_and_too_deep_as_well(cues):
    assert told(cues, Moment(0.0785)) == ["at_target"]
    assert told(cues, Moment(0.0778), Moment(0.0785)) == []
    assert told(cues, Moment(0.0823), Moment(0.0821), Moment(0.0823)) == ["too_deep"]
    assert told(cues, Moment(0.07), Moment(0.08)) == ["at_target"]


def test_nothing_is_told_of_a_depth_that_nobody_measures(cues):
    assert told(cues, Moment(0.03, 0.02, measured=False)) == []


def test_nothing_is_told_outside_an_attempt_and_it_begins_anew(cues):
    assert told(cues, Moment(0.03)) == ["deeper"]
    assert told(cues, Moment(0.04, state=State.PAUSED), Moment(0.04, state=State.READY)) == []
    assert told(cues, Moment(0.03)) == ["deeper"]


def test_each_breath_is_told_once_where_it_rests(cues):
    moments = [
        Moment(-0.01, p_target=np.array([0.0, 0.0, 0.012 * np.sin(np.pi * t / 4.0) ** 4]))
        for t in np.arange(0.0, 40.0, 1 / 60)
    ]
    assert told(cues, *moments) == ["breath_rests"] * 10


def test_a_target_at_rest_does_not_breathe(cues):
    still = [replace(Moment(), p_target=np.full(3, 1e-4 * (n % 2))) for n in range(50)]
    assert told(cues, *still) == []


def test_a_cue_without_numbers_says_so():
    assert np.isnan(Cue(CueKind.SCAN).depth)
