"""The derivatives of the band's picture, as derived in docs/band-fit.md, against differences."""

import numpy as np
import pytest

from app.tracking.band.equations import MOVES, solve_colours, step_equations
from app.tracking.band.fit import SHADING_PRIOR, rest_prior
from app.tracking.band.model import BAND, SPLINES, design, no_rows
from app.tracking.band.outline import strips, trace
from app.tracking.band.pixels import gather
from tests.tracking.test_tracking_band_fit import CENTRE, _axis, _drawn

NOISE, STEP = 4.0, 1e-3
POSES = ((10.0, 40.0), (25.0, 200.0), (40.0, 300.0))


class Picture:
    """A drawn picture with the model's rows as a function of the four moves."""

    def __init__(self, rig, camera, tilt, azimuth, blunt):
        self.model, self.shape, self.blur = rig.models[camera], rig.needle.shape, rig.blur_px
        if blunt:  # a shaft that goes on beyond the band as it comes
            self.shape = self.shape._replace(tip=0.04, point=1e-5)
        axis = _axis(tilt, azimuth)
        image = _drawn(self.model, self.shape, axis, 3, edge=True)
        p, a = self.model.T_camera_world @ CENTRE, self.model.T_camera_world.rotate(axis)
        count = strips(p, self.shape, self.model.intrinsics, self.blur)
        seen, self.outline = trace(
            p, a, self.shape, self.model.intrinsics, self.model.distortion, count
        )
        assert seen
        self.pixels = gather(image, self.outline, self.blur, NOISE)
        self.prior = np.asarray(rest_prior(*self.pixels.uneven))

    def rows(self, moves):
        """Rows with the pixels moved by n and e [px], width and length by their relative change."""
        n, e = moves[:2]
        along = np.array([self.outline.eu, self.outline.ev])
        shift = -e * along - n * np.array([-along[1], along[0]])
        rows = no_rows(len(self.pixels.places))
        stretch = np.array([1.0 + moves[2], 1.0 + moves[3]])
        design(self.pixels.places, self.outline, self.shape, self.blur, shift, stretch, rows)
        rows.values[~rows.seen] = 0.0
        return rows

    def paint(self):
        """Mean colour where the band alone is seen."""
        full = self.rows(np.zeros(MOVES)).values[:, 0, 0] > 0.97
        return self.pixels.colours[full].mean(axis=0)

    def least(self, moves, good, paint):
        """Half the sum of squares, priors included, with the best colours for these moves."""
        rows = self.rows(moves)
        solved, colours = solve_colours(self.pixels, rows, good, paint, self.prior, SHADING_PRIOR)
        assert solved
        equations = step_equations(self.pixels, rows, good, paint, colours)
        rest = np.tril(self.prior) + np.tril(self.prior, -1).T
        total = 3.0 * equations.squares[good].sum()
        total += np.einsum("ac,ab,bc->", colours.rest, rest, colours.rest)
        total += SHADING_PRIOR @ colours.shading**2
        return 0.5 * total, equations


@pytest.fixture(scope="module", params=[(camera, *pose) for camera in (0, 1) for pose in POSES])
def blunt(wide, request):
    return Picture(wide, *request.param, blunt=True)


@pytest.fixture(scope="module", params=POSES)
def pointed(wide, request):
    return Picture(wide, 0, *request.param, blunt=False)


def _differences(function, move):
    ahead, behind = np.zeros(MOVES), np.zeros(MOVES)
    ahead[move], behind[move] = STEP, -STEP
    return (function(ahead) - function(behind)) / (2.0 * STEP)


def _error(picture, move, columns):
    """Largest error of a derivative in some columns, over the largest derivative there."""
    found = picture.rows(np.zeros(MOVES)).values[:, 1 + move, columns]
    wanted = _differences(lambda moves: picture.rows(moves).values[:, 0, columns], move)
    return np.abs(found - wanted).max() / np.abs(wanted).max()


@pytest.mark.long("statistics")
@pytest.mark.parametrize("move", range(MOVES))
def test_every_derivative_of_the_shares_is_the_quotient_of_differences(blunt, move):
    for columns in (slice(0, BAND), slice(BAND, BAND + SPLINES), slice(BAND + SPLINES, None)):
        assert _error(blunt, move, columns) < 0.01


def test_of_a_needle_that_tapers_only_the_points_own_shares_leave_a_part_out(pointed):
    for move in range(MOVES):
        assert _error(pointed, move, slice(0, BAND + SPLINES)) < 0.01
    assert 0.01 < _error(pointed, 1, slice(BAND + SPLINES, None)) < 0.6


@pytest.mark.long("statistics")
def test_the_gradient_with_the_colours_eliminated_is_that_of_the_least_sum_of_squares(blunt):
    good, paint = blunt.pixels.usable, blunt.paint()
    _, equations = blunt.least(np.zeros(MOVES), good, paint)
    for move in range(MOVES):
        wanted = -_differences(lambda moves, to=blunt: to.least(moves, good, paint)[0], move)
        scale = np.sqrt(equations.information[move, move])
        assert equations.right[move] == pytest.approx(wanted, abs=0.1 * scale, rel=0.005)
