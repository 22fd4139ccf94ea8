"""Effects of a scene on pictures: shares and bursts, spreads, light; each camera its own."""

from types import SimpleNamespace

import numpy as np
import pytest

from app.core.clock import VirtualClock
from app.simulation.effects import declaration, effect_names
from app.tracking.errors import TrackingError
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.cameras import SimulatedCamera
from app.tracking.simulated.picture_effects import (
    Blur,
    Losses,
    line_kernel,
    picture_effects,
)
from app.tracking.simulated.sampled import DIMMER, WIDER, Spoiled

RNG = np.random.default_rng
POINT = np.zeros((61, 61, 3), np.uint8)
POINT[30, 30] = 255


def made(name, *values, image=POINT, seed=1):
    ((effect, memory),) = picture_effects({name: np.array(values, float)})
    return effect(image.copy(), memory, RNG(seed))


def test_every_effect_on_pictures_that_is_declared_is_made_here():
    asked = {}
    for name in effect_names():
        declared = declaration(name)
        if declared.pictures:
            defaults = [row.default for row in declared.parameters.values()]
            asked[name] = np.array([1.0, *defaults])
    assert len(picture_effects(asked)) == 5
    with pytest.raises(TrackingError, match="no effect on pictures is called 'fog'"):
        picture_effects({"fog": np.zeros(1)})


def lengths(lost):
    edges = np.flatnonzero(np.diff(np.concatenate([[0], np.asarray(lost, int), [0]])))
    return edges[1::2] - edges[::2]


@pytest.mark.parametrize(("share", "burst"), [(0.05, 6.0), (0.3, 20.0), (0.5, 1.0), (0.0, 3.0)])
def test_pictures_are_lost_in_their_share_and_in_bursts_of_their_length(share, burst):
    losses, random = Losses.of(np.array([0.0, share, burst])), RNG(3)
    lost = [losses.next(random.random()) for _ in range(200_000)]
    assert np.mean(lost) == pytest.approx(share, rel=0.06, abs=1e-9)
    if share:
        assert np.mean(lengths(lost)) == pytest.approx(burst, rel=0.05)


def test_single_losses_do_not_remember():
    losses, random = Losses.of(np.array([1.0, 0.2, 50.0])), RNG(3)
    lost = [losses.next(random.random()) for _ in range(100_000)]
    assert np.mean(lost) == pytest.approx(0.2, rel=0.03)
    assert np.mean(lengths(lost)) == pytest.approx(1.25, rel=0.02)


def test_a_lost_picture_is_black_and_another_is_as_it_was():
    seen = [made("camera_dropout", 1, 0.5, 1, seed=seed) for seed in range(20)]
    assert {int(image.max()) for image in seen} == {0, 255}


def spread_of(image):
    """Standard deviations of a spread point along its rows and its columns [px]."""
    weights = image[..., 0].astype(float)
    y, x = np.mgrid[-30:31, -30:31]
    return tuple(float(np.sqrt((weights * axis**2).sum() / weights.sum())) for axis in (x, y))


BRIGHT = POINT.copy()
BRIGHT[28:33, 28:33] = 255


@pytest.mark.parametrize(("model", "defocus"), [(0, 1.5), (0, 3.0), (1, np.sqrt(2.0)), (1, 2.0)])
def test_defocus_widens_by_its_standard_deviation(model, defocus):
    before = spread_of(BRIGHT)[0]
    after = spread_of(made("camera_blur", model, defocus, 0, 0, image=BRIGHT))
    assert np.sqrt(np.square(after) - before**2) == pytest.approx([defocus] * 2, rel=0.05)


def test_both_models_have_the_same_spread_at_whole_odd_widths():
    for square in (3, 5, 7):
        sd = np.sqrt((square**2 - 1) / 12.0)
        box, gaussian = (Blur.of(np.array([model, sd, 0.0, 0.0])) for model in (1, 0))
        assert box.square == square
        assert box.spread == pytest.approx(gaussian.spread, rel=1e-12)


@pytest.mark.parametrize("direction", [0.0, 0.5 * np.pi, 0.7])
@pytest.mark.parametrize("length", [0.3, 4.0, 9.5])
def test_a_motion_smears_along_its_line_alone(length, direction):
    kernel = line_kernel(length, direction)
    reach = kernel.shape[0] // 2
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    along = x * np.cos(direction) + y * np.sin(direction)
    across = y * np.cos(direction) - x * np.sin(direction)
    assert kernel.sum() == pytest.approx(1.0)
    assert (kernel * x).sum() == pytest.approx(0.0, abs=1e-12)
    # Bilinear weights add up to 1/4 px² in each direction.
    assert (kernel * along**2).sum() == pytest.approx(length**2 / 12.0, rel=0.05, abs=0.26)
    assert (kernel * across**2).sum() < 0.26


def test_light_is_dimmer_from_one_side_and_flickers():
    grey = np.full((10, 101, 3), 100, np.uint8)
    even = made("camera_light", 1, 0.6, 0.5, 0.4, image=grey)
    assert even[:, 0].mean() == pytest.approx(30, abs=1)
    assert even[:, 50].mean() == pytest.approx(60, abs=1)
    assert even[:, 100].mean() == pytest.approx(90, abs=1)
    ((effect, memory),) = picture_effects({"camera_light": np.array([0, 0.6, 0.0, 0.1])})
    random = RNG(5)
    levels = [float(effect(grey.copy(), memory, random).mean()) for _ in range(500)]
    assert np.mean(levels) == pytest.approx(60, rel=0.01)
    assert np.std(levels) == pytest.approx(6, rel=0.15)
    assert max(levels) <= 60 * 1.2 + 1


class _Grey:
    model = SimpleNamespace(name="grey")

    def render(self, scene):
        return np.full((4, 4, 3), 90, np.uint8)


def pictures(seed, effects, count=200):
    clock = VirtualClock(1.0)
    camera = SimulatedCamera(_Grey(), lambda _: None, clock, effects=effects, seed=seed)
    camera.open()
    return [int(camera.read().image.max()) for _ in range(count)], camera


def test_each_camera_loses_its_own_pictures_and_opened_again_the_same():
    effects = picture_effects({"camera_dropout": np.array([0.0, 0.4, 4.0])})
    left, camera = pictures(1, effects)
    right, _ = pictures(2, effects)
    assert left != right
    assert effects[0][1].lost is False  # what they share is never written
    camera.open()
    assert [int(camera.read().image.max()) for _ in range(200)] == left


def test_where_no_pictures_are_made_a_lost_one_hides_and_worse_ones_are_noisier():
    def spoiled(**asked):
        return Spoiled.by({name: np.array(row, float) for name, row in asked.items()}, 0.7)

    missed = spoiled(camera_dropout=(0, 0.3, 5)).misses(4)
    assert np.mean([missed() for _ in range(50_000)]) == pytest.approx(0.3, abs=0.02)
    assert spoiled().noise == spoiled().found == 1.0
    dim, soft = spoiled(camera_light=(1, 0.6, 0, 0)), spoiled(camera_blur=(0, 0.5, 0, 0))
    assert dim.noise > 1.1
    assert soft.noise > 1.05
    both = spoiled(camera_light=(1, 0.6, 0, 0), camera_blur=(0, 0.5, 0, 0))
    assert both.noise == pytest.approx(dim.noise * soft.noise)
    assert spoiled(camera_blur=(0, 4.2, 0, 0)).found == 0.0


def test_a_rigs_own_delivery_changes_nothing_where_no_pictures_are_made():
    asked = {"camera_tone": np.array([0.0, 4000.0, 8.0]), "camera_jpeg": np.array([0.0, 90.0])}
    spoiled = Spoiled.by(asked, 0.7)
    assert (spoiled.losses, spoiled.found, spoiled.noise) == (None, 1.0, 1.0)


def test_the_tables_of_what_was_measured_are_in_order():
    for table in (WIDER, DIMMER):
        assert np.all(np.diff(table[0]) > 0.0)
        assert 0.0 <= min(table[1]) <= max(table[1]) <= 1.0


def test_the_rig_whose_figures_they_are_has_the_blur_that_they_are_for():
    assert load_rig("wide").blur_px == 0.7
