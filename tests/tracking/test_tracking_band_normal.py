"""The band's normal equations, compiled and sparse, against dense ones in plain numpy."""

import math

import numpy as np
import pytest

from app.tracking.band.equations import MOVES, REST, colour_sums, move_sums
from app.tracking.band.model import BAND, COLUMNS, PARTIALS, SPLINES, Rows, _gauss
from app.tracking.band.pixels import CURVE, SIDE, BandPixels

COUNT = 300


@pytest.fixture(scope="module")
def pixels():
    """Random rows with the zeros of real ones: band, and shaft at either end or none at all."""
    rng = np.random.default_rng(5)
    rows = np.zeros((COUNT, PARTIALS, COLUMNS))
    seen = rng.random(COUNT) < 0.8
    for i in np.flatnonzero(seen):
        if rng.random() < 0.7:
            rows[i, :, :BAND] = rng.normal(0.0, 0.2, (PARTIALS, BAND))
        if rng.random() < 0.7:
            k = BAND + rng.integers(0, 2) * SPLINES + rng.integers(0, SPLINES - 4)
            rows[i, :, k : k + 5] = rng.normal(0.0, 0.1, (PARTIALS, 5))
    first = rng.integers(0, CURVE - 2, COUNT) + SIDE * rng.integers(0, 2, COUNT)
    weights, colours = rng.random((COUNT, 4)), rng.normal(20.0, 9.0, (COUNT, 3))
    good = rng.random(COUNT) < 0.9
    nowhere, even = np.zeros((COUNT, 2)), np.zeros(2, dtype=bool)
    return BandPixels(nowhere, colours, good, first, weights, even), Rows(rows, seen), good


def _unpacked(pixels, rows):
    return rows.values, rows.seen, pixels.first, pixels.weights, pixels.colours


def _dense(rows, seen, first, weights):
    """Rest's columns of the pixels and of their derivatives, and the free share and its change."""
    free = np.zeros((COUNT, PARTIALS))
    free[:, 0] = 1.0
    covered = rows[:, :, 0] + rows[:, :, BAND:].sum(axis=2)
    free[seen] -= covered[seen]
    rest = np.zeros((COUNT, PARTIALS, REST))
    rest[seen, :, : 2 * SPLINES] = rows[seen][:, :, BAND:]
    ground = np.zeros((COUNT, REST))
    for i in range(COUNT):
        ground[i, 2 * SPLINES + first[i] + np.arange(3)] = weights[i, :3]
        slope = CURVE + (SIDE if first[i] >= SIDE else 0)
        ground[i, 2 * SPLINES + slope] = weights[i, 3]
    rest += free[:, :, None] * ground[:, None]
    band = np.where(seen[:, None, None], rows[:, :, :BAND], 0.0)
    return band, rest, free


def test_the_equations_of_the_colours_are_those_of_dense_matrices(pixels):
    near, model, good = pixels
    rows, seen, first, weights, colours = _unpacked(near, model)
    band, rest, _ = _dense(rows, seen, first, weights)
    normal = np.zeros((REST, REST))
    cross, shared = colour_sums(near, model, good, normal)
    a, right = rest[good, 0], np.hstack([band[good, 0], colours[good]])
    some = good & (rows[:, 0, 0] != 0.0)  # a pixel without a share of the band has no shading
    assert np.tril(normal) == pytest.approx(np.tril(a.T @ a), rel=1e-9, abs=1e-9)
    assert cross == pytest.approx(a.T @ right, rel=1e-9, abs=1e-9)
    wanted = band[some, 0].T @ np.hstack([band[some, 0], colours[some]])
    assert shared == pytest.approx(wanted, rel=1e-9, abs=1e-9)


@pytest.mark.long("statistics")
def test_the_equations_of_the_moves_are_those_of_dense_matrices(pixels):
    near, model, good = pixels
    rows, seen, first, weights, colours = _unpacked(near, model)
    rng = np.random.default_rng(6)
    band, rest, free = _dense(rows, seen, first, weights)
    paint, shading = rng.normal(30.0, 9.0, 3), rng.normal(0.0, 0.3, BAND)
    values = rng.normal(10.0, 4.0, (REST, 3))
    squares, cross, moves, right = move_sums(near, model, good, paint, shading, values)
    drawn = (band @ shading)[:, :, None] * paint + rest @ values  # (pixels, PARTIALS, 3)
    residual = colours - drawn[:, 0]
    assert squares == pytest.approx(np.mean(residual**2, axis=1), rel=1e-9)
    count = seen & good & ~((rows[:, 0, 0] == 0.0) & (free[:, 0] > 0.9999))
    slopes, residual = drawn[count, 1:], residual[count]
    assert right == pytest.approx(np.einsum("imc,ic->m", slopes, residual), rel=1e-9)
    wanted = np.einsum("ia,imc->amc", rest[count, 0], slopes).reshape(REST, -1)
    assert cross == pytest.approx(wanted, rel=1e-9, abs=1e-7)
    assert moves[:, :MOVES] == pytest.approx(np.einsum("imc,iqc->mq", slopes, slopes), rel=1e-9)
    painted = np.einsum("imc,c,ik->mk", slopes, paint, band[count, 0])
    assert moves[:, MOVES:] == pytest.approx(painted, rel=1e-9, abs=1e-6)


def test_the_tables_of_a_gaussian_cut_off_at_three_deviations_hold_to_a_millionth():
    inside = math.erf(3.0 / math.sqrt(2.0))
    for z in np.linspace(-2.99, 2.99, 1777):
        below, bell = _gauss(z)
        assert below == pytest.approx(0.5 + 0.5 * math.erf(z / math.sqrt(2.0)) / inside, abs=1e-6)
        wanted = math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi) / inside
        assert bell == pytest.approx(wanted, abs=1e-6)
    assert _gauss(np.nan) == (0.0, 0.0)
    assert _gauss(-np.inf) == (0.0, 0.0)
    assert _gauss(np.inf) == (1.0, 0.0)
    assert _gauss(3.001) == (1.0, 0.0)
