"""Grid on the skin, electrodes, zones, margins in 3D: where they are, only when asked for."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PySide6.QtWidgets import QWidget
from test_views_ablation import done
from vtkmodules.util.numpy_support import vtk_to_numpy

from app.imaging.body import find_body
from app.imaging.series import Series
from app.imaging.skin_grid import GridSpec, SkinGrid
from app.imaging.volume import Volume
from app.session.ablation_shown import AblationShown
from app.session.procedure import Step, perform
from app.views.exercise.target_motion import GridScene
from app.views.scene.display import Display
from app.views.scene.guide_actors import union
from app.views.scene.guides import ABLATION, GRID, LASER, WIRE, ablation_guides, grid_guides
from app.views.scene.orbit import Orbit
from app.views.scene.renderer import SceneRenderer
from app.views.scene.stage import Stage
from app.views.scene.view import SceneView
from app.views.slices.zones import BARE, ENOUGH, LITTLE
from tests.ablation_rig import begin, liver, needle, placed

RADIUS = 90.0
SPEC = GridSpec((10.0, -20.0, 60.0), (0.0, -1.0), 11, 10.0, 150.0)


@pytest.fixture(scope="module")
def grid():
    """A grid on a patient as round as a pipe, 120 mm high, shorter than its lines."""
    _, j, i = np.mgrid[0:60, 0:110, 0:110]
    x, y = -109.0 + 2.0 * i, -109.0 + 2.0 * j
    edge = np.clip((RADIUS - np.hypot(x, y)) / 2.0 + 0.5, 0.0, 1.0)
    affine = np.diag([2.0, 2.0, 2.0, 1.0])
    affine[:2, 3] = -109.0
    series = Series("1", "CT", "", (110, 110, 60), None, None, None, True, "", (), "CT-1", "", ())
    volume = Volume(np.rint(-1000.0 + 1040.0 * edge).astype(np.int16), affine, series)
    return SkinGrid(find_body(volume), SPEC)


@pytest.fixture
def stage():
    stage = Stage()
    stage.open()
    yield stage
    stage.close()


def actors_of(stage, part):
    return stage._guides[part]


def points_of(line):
    return vtk_to_numpy(line.data.GetPoints().GetData())


def place_of(solid):
    matrix = solid._actors[0].GetUserMatrix()
    return np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])


def visible(solid):
    return all(actor.GetVisibility() for actor in solid._actors)


def test_the_grids_lines_lie_on_the_skin_as_far_as_the_ct_goes_and_ten_millimetres_apart(
    stage, grid
):
    stage.set_guides(GRID, grid_guides(grid, 52.0))
    lines = {line._mark: points_of(line) for line in actors_of(stage, GRID).lines}
    assert {mark.colour for mark in lines} == {WIRE.colour, LASER.colour}
    assert len(lines) == 3, "thin lines, each fifth thick, the laser"
    for points in lines.values():
        assert np.abs(np.hypot(points[:, 0], points[:, 1]) - RADIUS).max() < 1.0
        assert points[:, 2].min() >= 0.0
        assert points[:, 2].max() <= 118.0, "beyond it the CT knows no skin"
    assert_allclose(lines[LASER][:, 2], 52.0)
    wires = np.vstack([points for mark, points in lines.items() if mark.colour == WIRE.colour])
    assert np.ptp(wires[:, 2]) > 110.0
    arcs = RADIUS * np.unique(np.round(np.arctan2(wires[:, 0], -wires[:, 1]), 3))
    assert len(arcs) >= SPEC.lines
    middle = wires[np.argmin(np.abs(wires[:, 0] - 10.0))]
    assert middle[0] == pytest.approx(10.0, abs=0.05)
    thick = next(points for mark, points in lines.items() if mark.width > WIRE.width)
    between = RADIUS * np.ptp(np.arctan2(thick[:, 0], -thick[:, 1]))
    assert between == pytest.approx(50.0, abs=1.0), "lines 5 and 10"


def test_electrodes_stand_where_they_were_left_and_the_zone_is_what_they_cover(stage):
    state, _ = done()
    shown = AblationShown.of_state(state.ablation)
    stage.set_guides(ABLATION, ablation_guides(shown))
    actors = actors_of(stage, ABLATION)
    tips = np.array([one.tip_mm for one in state.ablation.electrodes])
    assert len(tips) == 3
    colour = actors.tips[0]._actors[0].GetProperty().GetColor()
    assert min(colour) > 0.9, "white, as on the slices, on a dark background too"
    assert_allclose([place_of(tip)[:3, 3] for tip in actors.tips], tips, atol=0.1)
    for shaft, electrode in zip(actors.shafts, state.ablation.electrodes, strict=True):
        matrix = place_of(shaft)  # of a cylinder along y, one high, about its middle
        ends = matrix[:3, 3] + np.array([[-0.5], [0.5]]) * matrix[:3, 1]
        assert_allclose(ends, [electrode.entry_mm, electrode.tip_mm], atol=0.1)
    mesh = union(shown.reached.zones)
    deepest = np.max([zone.depths_mm(mesh.points) for zone in shown.reached.zones], axis=0)
    assert np.abs(deepest).max() < 0.5
    assert np.sqrt(np.mean(deepest**2)) < 0.15
    assert actors.covered is not None
    assert_allclose(actors.ring._actors[0].GetCenter(), shown.reached.at_mm[shown.reached.least_at],
                    atol=0.1)  # fmt: skip


def test_what_is_planned_is_dashes_on_the_zones_surface_and_covers_nothing_yet(stage):
    shown = AblationShown.of_state(begin(liver()).ablation)
    stage.set_guides(ABLATION, ablation_guides(shown))
    actors = actors_of(stage, ABLATION)
    assert actors.covered is None
    assert actors.shafts == ()
    points = points_of(actors.lines[0])
    depths = np.array([zone.depths_mm(points) for zone in shown.planned.zones])
    assert np.abs(depths).min(axis=0).max() < 1e-6


def test_a_margins_class_has_a_colour_and_a_size_and_the_least_is_said():
    reached = done()[0].ablation
    whole = AblationShown.of_state(reached)
    margins = whole.reached.margin_mm - np.linspace(0.0, 12.0, len(whole.reached.margin_mm))
    least = float(margins.min())
    shown = replace(whole, reached=replace(whole.reached, margin_mm=margins, least_mm=least))
    guides = ablation_guides(shown)
    found = {one.mark: len(one.points_mm) for one in guides.dots}
    counted = {
        ENOUGH: int((margins >= shown.wanted_mm).sum()),
        LITTLE: int(((margins >= 0.0) & (margins < shown.wanted_mm)).sum()),
        BARE: int((margins < 0.0).sum()),
    }
    assert found == {mark: count for mark, count in counted.items() if count}
    assert len(found) == 3
    sizes = [one.radius_mm for one in guides.dots]
    assert len(set(sizes)) == len(sizes)
    assert f"least {shown.reached.least_mm:.1f} mm" in guides.legend[0][1]


def test_each_electrode_appears_when_it_is_left_there():
    state, counts = begin(liver()), []
    for plan in state.ablation.plans:
        counts.append(len(ablation_guides(AblationShown.of_state(state.ablation)).shafts_mm))
        look, field = needle(plan, (0.0, 0.0, 0.0)), state.ablation.lesion.field
        state, _, _ = perform(state, Step.PLACE_ELECTRODE, look, placed(), field)
    assert counts == [0, 1, 2]


@pytest.mark.parametrize("moving", [False, True])
def test_they_are_seen_switched_off_and_gone(stage, moving):
    shown = AblationShown.of_state(done()[0].ablation)
    orbit = Orbit.from_side("A", np.zeros(3), 40.0)

    def bright():
        return int((stage.render(orbit, (160, 120), moving)[:, :, :3].max(axis=2) > 60).sum())

    assert bright() == 0
    stage.set_guides(ABLATION, ablation_guides(shown))
    assert bright() > 1000
    stage.set_display(Display(guides=False))
    assert bright() == 0
    stage.set_guides(ABLATION, ablation_guides(shown))
    assert bright() == 0, "what comes while it is switched off stays hidden"
    stage.set_display(Display())
    assert bright() > 1000
    stage.set_guides(ABLATION, None)
    assert bright() == 0


def test_the_grid_is_looked_for_beside_the_window_and_goes_with_the_exercise(
    application, grid, settle
):
    scene = SceneView(SceneRenderer())
    parent = QWidget()
    shower = GridScene(scene, parent)
    for table in (40.0, 41.0, 42.0):
        shower.show(grid, table)
    while shower._task is not None:
        settle()
    assert list(scene.guides) == [GRID]
    laser = [line for line in scene.guides[GRID].lines if line.mark == LASER]
    assert_allclose(laser[0].points_mm[:, 2], 42.0)
    shower.show(None, None)
    assert not scene.guides
    shower.close()
    scene.close_renderer()
