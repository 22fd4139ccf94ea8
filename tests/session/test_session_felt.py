"""The force felt is that of the last trusted lever, between its bounds; a guess is never valid."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from app.core import state_vector as sv
from app.session.felt import felt_force
from app.session.machine import State
from app.session.needle import DepthSource, NeedlePose
from app.session.sample import Sample
from app.session.samples import SampleHistory

LENGTH = 0.29  # of the needle holder's needle [m]


@dataclass
class Device:
    row: np.ndarray

    @property
    def felt(self):
        return self.row[sv.FELT]


def device(depth, felt=7.67, least=-0.03, most=0.12):
    row = sv.empty_state()
    row[sv.DEPTH], row[sv.L_OUT] = depth, LENGTH - depth
    row[sv.DEPTH_LEAST], row[sv.DEPTH_MOST] = least, most
    row[sv.FELT_X] = felt
    return Device(row)


def pose(depth, source=DepthSource.MODEL, trusted=-0.015):
    return NeedlePose(
        p_tip=np.array([0.0, 0.16, 0.09 - depth]),
        axis=np.array([0.0, 0.0, -1.0]),
        depth=depth,
        time=1.0,
        orientation_age=0.0,
        depth_age=0.0,
        depth_source=source,
        valid=True,
        covariance=1e-6 * np.eye(3),
        trusted_depth=trusted,
    )


def test_a_guessed_depth_of_90_mm_does_not_make_7_67_n_of_5():
    felt = felt_force(device(0.0901), pose(0.0901))
    size = float(np.linalg.norm(felt.force))
    assert size == pytest.approx(7.67 * (LENGTH - 0.0901) / (LENGTH + 0.015))
    assert size == pytest.approx(5.03, abs=0.01)  # 4.9 to 5.1 N in the simulated hand
    assert felt.least <= size <= felt.most
    assert felt.most == pytest.approx(7.67 * (LENGTH - 0.0901) / (LENGTH - 0.12))


def test_a_measured_depth_leaves_the_loops_own_force():
    felt = felt_force(
        device(0.05, 3.0, 0.0475, 0.0525), pose(0.05, DepthSource.TRACKED, trusted=0.05)
    )
    assert felt.force[0] == 3.0
    assert 2.9 < felt.least < 3.0 < felt.most < 3.1


def test_a_depth_that_nobody_ever_measured_counts_at_its_worst_end():
    felt = felt_force(device(0.09), pose(0.09, trusted=None))
    assert float(np.linalg.norm(felt.force)) == pytest.approx(felt.most)


def test_without_an_interval_there_are_no_bounds():
    felt = felt_force(device(0.09, most=np.nan), pose(0.09))
    assert np.isnan(felt.least)
    assert np.isnan(felt.most)


def test_samples_of_a_guess_are_not_valid_but_keep_direction_and_source():
    history = SampleHistory()
    base = Sample(0.0, State.INSERTING, pose(0.05, DepthSource.TRACKED), None, np.zeros(3))
    for k, source in enumerate((DepthSource.TRACKED, DepthSource.HELD, DepthSource.MODEL)):
        history.add(replace(base, time=0.01 * k, pose=pose(0.05, source)))
    samples = history.arrays()
    assert samples.valid.tolist() == [True, True, False]
    assert samples.depth_source[2] == "model"
    assert np.isnan(samples.depth[2])
    assert np.isnan(samples.tip[2]).all()
    assert np.isfinite(samples.axis).all()
