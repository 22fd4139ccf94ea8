import json
import threading
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QSignalSpy, QTest
from scipy.spatial import cKDTree
from window_rig import plan

import app.views.scene.surfaces as surfaces_module
from app.core.progress import Cancelled, Progress
from app.core.transform import RigidTransform
from app.imaging.body import find_body
from app.imaging.phantom.anatomy import anatomy, organ_fields
from app.imaging.reformat import Frame
from app.imaging.structures.structure import Structure
from app.imaging.window import WindowLevel
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import load_profile
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.planning.patient import Patient
from app.planning.placement import Placement
from app.views.kit import theme
from app.views.scene import mesh as meshes
from app.views.scene import surfaces as extraction
from app.views.scene.display import LIGHT_BACKGROUND, ORGAN_COLOURS, Display, Section
from app.views.scene.feature import SceneFeature
from app.views.scene.mesh import coarser, isosurface, structure_mesh
from app.views.scene.orbit import Orbit
from app.views.scene.renderer import SceneRenderer, Shot, moving_size
from app.views.scene.robot import RobotShape
from app.views.scene.shape import Hoop, ScenePiece, SceneShape
from app.views.scene.stage import SceneError, Stage
from app.views.scene.surfaces import BONE_HU, Surfaces, extract_surfaces, reduced, without_marrow
from app.views.scene.view import SceneView
from app.views.scene.words import compass_ends

SIZE = (120, 90)


def ball(radius=10.0, n=30):
    grid = np.indices((n, n, n)) - (n - 1) / 2
    return (radius - np.sqrt((grid**2).sum(axis=0))).astype(np.float32)


@pytest.fixture(scope="module")
def surfaces():
    mesh = isosurface(ball(), np.eye(4), 0.0, 4000)
    return Surfaces(mesh, coarser(mesh, 300), mesh, coarser(mesh, 300))


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_surface_faces_outwards_whether_or_not_the_grid_is_mirrored(mirror):
    mesh = isosurface(ball(), np.diag([1.0, 1.0, mirror, 1.0]), 0.0, 100_000)
    outwards = mesh.points - mesh.points.mean(axis=0)
    assert (np.einsum("ij,ij->i", mesh.normals, outwards) > 0).all()
    corners = mesh.points[mesh.triangles]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    middles = corners.mean(axis=1) - mesh.points.mean(axis=0)
    assert (np.einsum("ij,ij->i", facing, middles) > 0).all()


def test_a_surface_lies_at_its_level_and_within_its_bound():
    mesh = isosurface(ball(), np.eye(4), 0.0, 1000)
    radius = np.linalg.norm(mesh.points - 14.5, axis=1)
    assert mesh.count <= 1000
    assert_allclose(radius, 10.0, atol=0.5)
    assert coarser(mesh, 200).count <= 200


def open_edges(mesh):
    """Number of edges that belong to one triangle only."""
    pairs = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, count = np.unique(pairs, axis=0, return_counts=True)
    return int((count == 1).sum())


def test_surfaces_are_closed_also_where_the_scan_cuts_them(volume):
    found = extract_surfaces(volume, find_body(volume), Progress())
    assert open_edges(found.skin) == 0
    assert open_edges(found.bone) == 0


def test_smoothing_moves_a_surface_by_less_than_half_a_voxel(monkeypatch):
    i, j, k = np.indices((60, 60, 60))
    bumpy = (ball(20.0, 60) + 1.5 * np.sin(0.6 * i) * np.sin(0.5 * j) * np.sin(0.4 * k)).astype(
        "f4"
    )
    smooth = isosurface(bumpy, np.eye(4), 0.0, 1_000_000)
    monkeypatch.setattr(meshes, "ITERATIONS", 0)
    rough = isosurface(bumpy, np.eye(4), 0.0, 1_000_000)
    corners = rough.points[rough.triangles]
    places = np.vstack([rough.points, corners.mean(axis=1)])
    apart, _ = cKDTree(places).query(smooth.points)
    assert np.median(apart) <= 0.5
    assert np.percentile(apart, 99) <= 1.5


def test_light_falls_on_a_thinned_ball_as_on_a_ball():
    mesh = isosurface(ball(20.0, 50), np.eye(4), 0.0, 800)
    outwards = mesh.points - 24.5
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    assert np.einsum("ij,ij->i", mesh.normals, outwards).min() > np.cos(np.radians(3.0))


def test_marrow_behind_a_shell_with_gaps_is_filled_and_a_foramen_is_not():
    values = np.full((30, 30, 30), -50.0, np.float32)
    values[5:20, 5:20, 5:20] = 500.0
    values[7:18, 7:18, 7:18] = 40.0
    values[12, 12, 5:7] = 40.0  # a gap of the shell
    values[25:27, 5:20, 5:20] = 500.0
    values[25:27, 9:16, 9:16] = 40.0  # a plate with a hole
    filled = without_marrow(values, np.eye(4))
    assert (filled[5:20, 5:20, 5:20] > BONE_HU).all()
    assert (filled[25:27, 9:16, 9:16] < BONE_HU).all()
    assert (filled[:4] < BONE_HU).all()


def test_marrow_at_the_end_of_the_scan_leaves_the_layer_around_it_outside():
    values = np.full((12, 20, 20), -1000.0, np.float32)
    values[1:-1, 4:16, 4:16] = 500.0
    values[1:-1, 6:14, 6:14] = 40.0  # a tube of bone, cut at both ends
    filled = without_marrow(values, np.eye(4))
    assert (filled[[0, -1]] == -1000.0).all()


def test_an_empty_volume_gives_an_empty_surface():
    mesh = isosurface(np.zeros((5, 5, 5), np.float32), np.eye(4), 0.5, 100)
    assert mesh.count == 0
    assert coarser(mesh, 10).count == 0


def test_block_means_keep_their_place(volume):
    values = np.broadcast_to(np.arange(volume.size[0], dtype=float), volume.hu.shape)
    small, affine = reduced(lambda k: values[k], volume, 4.0)
    middle = small[5, 5, 6]
    place = affine @ [6, 5, 5, 1]
    assert volume.voxel(place[:3])[0] == pytest.approx(middle, abs=0.01)


def test_a_taller_patient_has_larger_cells_not_more(volume, monkeypatch):
    monkeypatch.setattr(surfaces_module, "MOST_CELLS", 2000)
    small, affine = reduced(lambda k: volume.hu[k], volume, 4.0)
    cell = np.linalg.norm(affine[:3, :3], axis=0)
    assert small.size <= 2.5 * 2000  # whole voxels to a cell
    assert cell.prod() > 4.0**3


def test_skin_and_bone_of_a_block_stay_where_the_block_is(volume):
    found = extract_surfaces(volume, find_body(volume), Progress())
    low, high = found.skin.points.min(axis=0), found.skin.points.max(axis=0)
    corners = volume.lps_mm([(9.5, 11.5, 1.5), (53.5, 47.5, 37.5)])
    assert_allclose(low, corners[0], atol=3.0)
    assert_allclose(high, corners[1], atol=3.0)
    assert found.bone.count > 0
    assert found.count <= 200_000


def test_extraction_can_be_cancelled(volume):
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        extract_surfaces(volume, find_body(volume), progress)


@given(st.lists(st.tuples(st.floats(-500, 500), st.floats(-500, 500)), max_size=20))
@settings(derandomize=True, deadline=None, max_examples=50)
def test_the_eye_stays_square_however_it_is_turned(turns):
    orbit = Orbit.from_side("A", np.zeros(3), 100.0)
    for right, down in turns:
        orbit = orbit.turned(right, down)
    basis = np.array([orbit.right, orbit.up, orbit.backwards])
    assert_allclose(basis @ basis.T, np.eye(3), atol=1e-9)


@pytest.mark.parametrize("size", [(300, 900), (900, 300), (500, 500)])
def test_a_fitted_eye_shows_every_point_in_a_tall_and_in_a_wide_pane(size):
    points = np.random.default_rng(3).uniform(-200.0, 300.0, (40, 3)) * [1.0, 0.4, 2.0]
    orbit = Orbit.from_side("A", np.zeros(3), 10.0).turned(-50, 30).fitted(points)
    seen = (points - orbit.focus_mm) / orbit.mm_per_px(size)
    assert np.abs(seen @ orbit.right).max() < size[0] / 2
    assert np.abs(seen @ orbit.up).max() < size[1] / 2
    assert np.abs(seen @ orbit.up).max() > 0.9 * min(size) / 2


@pytest.mark.parametrize("letter", list("APLRSI"))
def test_each_letter_points_at_the_viewer_on_its_own_side(letter):
    orbit = Orbit.from_side("A", np.zeros(3), 100.0).seen_from(letter)
    assert compass_ends(orbit)[-1][0] == letter


def test_the_line_of_sight_through_the_middle_goes_through_the_focus():
    focus = np.array([1.0, 2.0, 3.0])
    orbit = Orbit.from_side("L", focus, 50.0).turned(30, 20)
    point, direction = orbit.ray(50.0, 40.0, (100, 80))
    assert_allclose(point, focus, atol=1e-12)
    assert_allclose(direction, -orbit.backwards)
    assert_allclose(orbit.ray(50, 0, (100, 80))[0], focus + 50.0 * orbit.up, atol=1e-12)


def test_the_links_have_their_lengths_and_meet_at_the_tool():
    geometry = load_profile("icube").pantograph
    shape = RobotShape.of(load_profile("icube"), inverse(geometry, [0.01, 0.15]))
    lengths = [np.linalg.norm(end - start) for start, end in shape.links()]
    expected = [geometry.base, *[geometry.proximal] * 2, *[geometry.distal] * 2]
    assert_allclose(lengths, expected, atol=1e-9)
    assert_allclose(shape.drawing.points["tool point"], [0.01, 0.15, 0.0], atol=1e-9)


@pytest.mark.parametrize("q", [None, [np.nan, 1.0], [np.inf, 0.0]])
def test_without_usable_angles_only_the_base_is_drawn(q):
    shape = RobotShape.of(load_profile("icube"), q)
    assert len(shape.links()) == 1


def test_angles_that_do_not_close_show_the_driven_links_only():
    shape = RobotShape.of(load_profile("icube"), [np.pi, 0.0])
    assert len(shape.links()) in (3, 5)
    assert all(np.isfinite(point).all() for rod in shape.links() for point in rod)


@pytest.fixture
def stage():
    stage = Stage()
    stage.open()
    yield stage
    stage.close()
    stage.close()


def test_a_picture_shows_what_stands_on_the_stage(stage, surfaces):
    orbit = Orbit.from_side("A", np.full(3, 14.5), 20.0)
    empty = stage.render(orbit, SIZE, moving=False)
    assert empty.shape == (90, 120, 4)
    assert empty[:, :, :3].max() == 0
    stage.set_surfaces(surfaces)
    for moving in (False, True):
        shown = stage.render(orbit, SIZE, moving)
        assert shown[45, 60, :3].max() > 60
        assert shown[2, 2, :3].max() == 0
    stage.set_surfaces(None)
    assert stage.render(orbit, SIZE, moving=False)[:, :, :3].max() == 0


def test_needle_plan_and_robot_appear_and_go(stage):
    orbit = Orbit.from_side("A", np.zeros(3), 60.0)
    stage.set_needle(NeedleOverlay([0, 0, 50], [0, 0, 0]))
    upper = stage.render(orbit, SIZE, False)[20, 55:65, :3].astype(int)
    assert (upper[:, 0] > upper[:, 2] + 60).any()  # orange
    stage.set_needle(None)
    assert stage.render(orbit, SIZE, False)[:, :, :3].max() == 0
    stage.set_plan(DraftPlan((0, 0, 20), (0, 0, -20)))
    assert stage.render(orbit, SIZE, False)[:, :, :3].max() > 60
    stage.set_plan(DraftPlan())
    geometry = load_profile("icube").pantograph
    robot = RobotShape.of(load_profile("icube"), inverse(geometry, [0.0, 0.15]))
    stage.set_robot(robot, RigidTransform.from_translation([0.0, 0.0, -0.1]))
    assert stage.render(Orbit.from_side("S", np.zeros(3), 300.0), SIZE, False)[:, :, :3].max() > 60
    stage.set_robot(None, RigidTransform.identity())
    assert stage.render(orbit, SIZE, False)[:, :, :3].max() == 0


def test_what_a_feature_puts_into_the_picture_appears_and_goes_also_for_another(stage):
    orbit = Orbit.from_side("A", np.zeros(3), 60.0)

    def rod(x, rounded, mark=theme.ROBOT):
        ends = np.array([[x, 0.0, -20.0], [x, 0.0, 20.0]])
        hoop = Hoop(np.array([x, 0.0, 30.0]), np.array([0.0, 1.0, 0.0]), (4.0, 8.0), theme.ENTRY)
        return SceneShape((ScenePiece(ends, 4.0, mark, rounded),), (hoop,))

    def halves():
        seen = stage.render(orbit, SIZE, False)[:, :, :3].max(axis=(0, 2))
        return bool(seen[:60].max() > 60), bool(seen[60:].max() > 60)

    stage.set_shape(rod(-30.0, True))
    (one_side,) = [side for side in (0, 1) if halves()[side]]
    stage.set_shape(rod(30.0, True))
    assert halves()[1 - one_side]
    assert not halves()[one_side]
    stage.set_shape(rod(-30.0, False))  # of another kind: the solids of the first go
    assert halves()[one_side]
    assert not halves()[1 - one_side]
    stage.set_shape(None)
    assert halves() == (False, False)
    shape = rod(0.0, True)
    assert shape.points_mm.shape == (3, 3)
    assert shape.moved_mm(None) == np.inf
    assert shape.moved_mm(rod(2.0, True)) == pytest.approx(2.0)
    assert len(shape.near_mm(np.array([0.0, 0.0, 30.0]), 11.0)) == 2


def test_a_needle_without_length_is_not_drawn(stage):
    stage.set_needle(NeedleOverlay([0, 0, 0], [0, 0, 0]))
    assert np.isfinite(stage.render(Orbit.from_side("A", np.zeros(3), 9.0), SIZE, False)).all()


def test_the_needle_is_seen_at_every_zoom_and_through_what_hides_it(stage, surfaces):
    orbit = Orbit.from_side("A", np.full(3, 14.5), 400.0)
    stage.set_needle(NeedleOverlay([14.5, 14.5, 114.5], [14.5, 14.5, 14.5]))
    orange = stage.render(orbit, SIZE, False)[35, :, :3].astype(int)
    assert (orange[:, 0] > orange[:, 2] + 60).sum() >= 3
    near = Orbit.from_side("A", np.full(3, 14.5), 20.0)
    stage.set_needle(None)
    stage.set_surfaces(surfaces)
    alone = stage.render(near, SIZE, False)[30, 60, :3].astype(int)
    stage.set_needle(NeedleOverlay([14.5, 14.5, 114.5], [14.5, 14.5, 14.5]))
    through = stage.render(near, SIZE, False)[30, 60, :3].astype(int)
    assert through[0] - through[2] > alone[0] - alone[2] + 30


def test_a_closed_stage_says_so():
    with pytest.raises(SceneError, match="closed"):
        Stage().render(Orbit.from_side("A", np.zeros(3), 10.0), SIZE, False)


def shot(half=20.0, moving=False):
    return Shot(Orbit.from_side("A", np.full(3, 14.5), half), SIZE, moving)


def test_the_render_thread_answers_with_the_newest_request(surfaces):
    before = set(threading.enumerate())
    renderer = SceneRenderer()
    renderer.open()
    renderer.open()
    renderer.change("surfaces", lambda stage: stage.set_surfaces(None))
    renderer.change("surfaces", lambda stage: stage.set_surfaces(surfaces))
    for half in (500.0, 100.0, 20.0):
        renderer.request(shot(half))
    assert renderer.wait(20.0)
    picture = renderer.take()
    assert picture is not None
    assert picture[45, 60, :3].max() > 60
    assert renderer.take() is None
    renderer.close()
    renderer.close()
    assert not {t for t in threading.enumerate() if t.name == "acus-scene"} - before


def test_a_fault_in_the_3d_view_is_told_and_stops_only_it():
    renderer = SceneRenderer()
    renderer.open()

    def broken(_):
        raise SceneError("the graphics are gone")

    renderer.change("x", broken)
    renderer.request(shot())
    assert renderer.wait(10.0)
    assert renderer.error == "the graphics are gone"
    renderer.close()


@pytest.fixture
def view(application, surfaces, volume):
    view = SceneView(SceneRenderer())
    view.resize(*SIZE)
    view.set_volume(volume)
    view.set_surfaces(surfaces)
    view.show()
    yield view
    view.close_renderer()


def test_the_pane_shows_a_picture_of_its_own_size(view, settle):
    assert settle(lambda: not view.picture().isNull())
    assert settle(lambda: view.picture().width() == view.width())
    assert view.grab().width() == view.width()


def test_a_view_in_which_nothing_changes_or_that_nobody_sees_is_not_looked_at(view, settle):
    timer = view._feed._timer
    assert settle(lambda: view.is_settled and not timer.isActive())
    view.set_orbit(view.orbit.turned(40, 0))
    assert timer.isActive()
    view.hide()
    assert settle(lambda: not timer.isActive())
    view.set_orbit(view.orbit.turned(40, 0))
    assert not timer.isActive()
    old = view.picture()
    view.show()
    assert settle(lambda: view.is_settled and view.picture() != old and not timer.isActive())


@pytest.mark.long("journey")
def test_a_view_that_stands_still_is_drawn_only_for_who_turns_or_changes_it_and_goes_on_afterwards(
    view, settle
):
    shots, request = [], view._feed._renderer.request

    def count(shot):
        shots.append(shot)
        request(shot)

    assert settle(lambda: view.is_settled)
    view._feed._renderer.request = count
    view.set_still(True)
    assert view.is_settled
    for _ in range(5):
        view.set_needle(None)
        settle(lambda: False, 0.1)
    assert shots == []
    view.set_orbit(view.orbit.turned(40, 0))
    assert settle(lambda: shots)
    assert settle(lambda: not view._feed._timer.isActive())
    assert all(shot.moving for shot in shots)
    shots.clear()
    view.set_display(Display(light=not view.display.light))
    assert settle(lambda: shots)
    view.set_still(False)
    assert settle(lambda: view.is_settled)
    assert not shots[-1].moving


def test_mouse_and_keys_turn_pan_zoom_and_reset(view):
    home = view.orbit
    view.set_orbit(home.turned(40, 0))
    QTest.keyClick(view, Qt.Key.Key_S)
    assert_allclose(view.orbit.backwards, [0, 0, 1], atol=1e-12)
    QTest.keyClick(view, "r")
    assert_allclose(view.orbit.backwards, home.backwards)
    moved = view.orbit.panned(10, 0, (120, 90)).focus_mm - home.focus_mm
    assert moved @ home.right < 0.0
    assert home.zoomed(2.0).half_mm == pytest.approx(home.half_mm / 2)


def test_a_click_in_place_gives_the_line_of_sight(view):
    spy = QSignalSpy(view.clicked)
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, pos=QPointF(60, 45).toPoint())
    point, direction = spy.at(0)
    assert_allclose(direction, -view.orbit.backwards)
    assert np.linalg.norm(point - view.orbit.focus_mm) < 5.0


def test_the_home_view_takes_the_robot_in_until_one_looks_elsewhere(view):
    geometry = load_profile("icube").pantograph
    shape = RobotShape.of(load_profile("icube"), inverse(geometry, [0.01, 0.15]))
    alone = view.orbit
    view.set_robot(shape, RigidTransform.identity())
    assert view.orbit.half_mm > alone.half_mm
    ends = np.array([end for rod in shape.links() for end in rod]) * 1e3
    seen = (ends - view.orbit.focus_mm) / view.orbit.mm_per_px(SIZE)
    assert np.abs(seen @ view.orbit.right).max() < SIZE[0] / 2
    assert np.abs(seen @ view.orbit.up).max() < SIZE[1] / 2
    elsewhere = view.orbit.turned(40, 0)
    view.set_orbit(elsewhere)
    view.set_robot(shape, RigidTransform(np.eye(3), [0.0, 0.0, 0.5]))
    assert view.orbit is elsewhere


@pytest.mark.long("journey")
@pytest.mark.parametrize("share", [0.05, 0.25, 0.6, 0.9])
def test_a_cancel_is_obeyed_inside_the_filters(share):
    """The first report past `share` cancels; the last one heard shows how much was still done."""
    i, j, k = np.indices((60, 60, 60))
    bumpy = (np.sin(0.5 * i) * np.sin(0.5 * j) * np.sin(0.5 * k)).astype(np.float32)
    heard = []

    def listen(fraction, _):
        heard.append(fraction)
        if fraction >= share:
            progress.cancel()

    progress = Progress(listen)
    with pytest.raises(Cancelled):
        isosurface(bumpy, np.eye(4), 0.3, 2_000, progress)
    assert heard[-1] < min(1.0, share + 0.25)


def test_a_structure_is_a_surface_where_its_voxels_end(volume):
    mask = np.zeros(volume.hu.shape, bool)
    mask[10:30, 15:45, 20:50] = True
    one = Structure.of("box", mask, volume)
    mesh = structure_mesh(one, 5_000)
    low, high = one.box_mm.min(axis=0), one.box_mm.max(axis=0)
    assert 0 < mesh.count <= 5_000
    assert np.abs(mesh.points.min(axis=0) - low).max() < 2.5
    assert np.abs(mesh.points.max(axis=0) - high).max() < 2.5
    dot = np.zeros(volume.hu.shape, bool)
    dot[20, 30, 30] = True
    assert structure_mesh(Structure.of("dot", dot, volume), 5_000).count > 0


# --- how it is shown --------------------------------------------------------------------------
def plane_of(volume, body, normal_axis=1):
    """A section through the middle of the block, along a patient axis."""
    right, down = [np.eye(3)[axis] for axis in range(3) if axis != normal_axis]
    middle = volume.lps_mm((np.array(volume.size) - 1) / 2)
    patient = Patient(volume, body, "CT-TEST")
    return patient, Section(patient, Frame(middle, right, down), WindowLevel(400, 40))


MATRICES = {  # Machado, Oliveira and Fernandes 2009, severity 1, on linear RGB
    "protanopia": [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]],
    "deuteranopia": [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]],
}


def lab(name, matrix):
    """CIELAB of `#rrggbb` as somebody sees it."""
    values = np.array([int(name[at : at + 2], 16) for at in (1, 3, 5)]) / 255.0
    linear = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    linear = np.clip(np.array(matrix) @ linear, 0.0, 1.0)
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    x, y, z = np.cbrt(np.array(to_xyz) @ linear / [0.9505, 1.0, 1.089])
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


@pytest.mark.parametrize("sight", [*MATRICES, "usual"])
def test_organs_are_told_apart_by_colour_blind_people_too(sight):
    matrix = MATRICES.get(sight, np.eye(3))
    seen = {name: lab(colour, matrix) for name, colour in ORGAN_COLOURS.items()}
    apart = {pair: np.linalg.norm(seen[pair[0]] - seen[pair[1]]) for pair in combinations(seen, 2)}
    assert min(apart.values()) > 9.0, min(apart, key=apart.get)


def test_what_is_chosen_is_read_back_and_nonsense_is_left():
    display = Display(light=True, xray=True, cut=True, volume="bone")
    assert Display.of_document(json.loads(json.dumps(display.document()))) == display
    assert Display.of_document({"light": "yes", "volume": 3, "new": 1}) == Display()


def test_the_organs_of_the_built_in_patient_hold_the_points_that_are_known():
    truth, fields = anatomy(1), organ_fields(1, 4.0)
    inside = {"liver": "liver", "right kidney": "kidneys", "left kidney": "kidneys",
              "spleen": "spleen", "aorta": "arteries", "vena cava": "veins"}  # fmt: skip
    for point, organ in inside.items():
        values, affine = fields[organ]
        at = np.linalg.inv(affine) @ [*truth.organs[point], 1.0]
        i, j, k = np.rint(at[:3]).astype(int)
        assert values[k, j, i] > -1.0, point
    values, affine = fields["lesion"]
    points = isosurface(values, affine, 0.0, 2000).points
    assert_allclose(points.mean(axis=0), truth.lesion_mm, atol=1.5)


def test_lungs_are_an_organ_and_gas_outside_the_body_is_not(volume, monkeypatch):
    monkeypatch.setattr(extraction, "LUNG_ML", 5.0)
    hu = np.full((40, 100, 110), -1000, np.int16)
    hu[2:-2, 12:-12, 10:-10] = 40
    hu[10:30, 30:70, 30:80] = -840
    lunged = type(volume)(hu, volume.affine_mm, volume.series)
    found = extract_surfaces(lunged, find_body(lunged), Progress())
    fine, coarse = found.organs["lungs"]
    assert open_edges(fine) == 0
    assert coarse.count <= fine.count
    assert_allclose(fine.points.min(axis=0), volume.lps_mm((29.5, 29.5, 9.5)), atol=2.0)
    assert "lungs" not in extract_surfaces(volume, find_body(volume), Progress()).organs


def test_the_background_is_light_and_marks_are_dark_on_it(stage):
    orbit = Orbit.from_side("A", np.zeros(3), 60.0)
    stage.set_needle(NeedleOverlay([0, 0, 50], [0, 0, 0]))
    stage.set_display(Display(light=True))
    picture = stage.render(orbit, SIZE, False)[:, :, :3].astype(int)
    assert picture[2, 2].tolist() == [int(LIGHT_BACKGROUND[at : at + 2], 16) for at in (1, 3, 5)]
    shaft = picture[25, 55:65]
    assert (np.abs(shaft - picture[2, 2]).max(axis=1) > 80).any()
    stage.set_display(Display())
    assert stage.render(orbit, SIZE, False)[2, 2, :3].max() == 0


@pytest.mark.parametrize("light", [False, True])
def test_another_needle_stands_out_from_either_background(stage, light):
    stage.set_ghost(NeedleOverlay([0, 0, 50], [0, 0, 0]))
    stage.set_display(Display(light=light))
    orbit = Orbit.from_side("A", np.zeros(3), 60.0)
    picture = stage.render(orbit, SIZE, False)[:, :, :3].astype(int)
    assert np.abs(picture - picture[2, 2]).max() > 120


@pytest.mark.promise("docs/reading.md: needle, path and target are never hidden")
def test_in_an_x_ray_the_needle_is_never_hidden_and_three_pixels_wide(stage, surfaces):
    size = (420, 330)  # the 3D view of a window of 1366 × 768
    orbit = Orbit.from_side("A", np.full(3, 14.5), 300.0)
    stage.set_surfaces(surfaces)
    stage.set_needle(NeedleOverlay([14.5, 60.0, 214.5], [14.5, 14.5, 4.5]))
    stage.set_display(Display(xray=True))
    picture = stage.render(orbit, size, False)[:, :, :3].astype(int)
    orange = (picture[58:158, :, 0] - picture[58:158, :, 2]) > 100
    assert (orange.sum(axis=1) >= 3).all()
    near = Orbit.from_side("A", np.full(3, 14.5), 20.0)
    inside = stage.render(near, SIZE, False)[38, 60, :3].astype(int)
    assert inside[0] - inside[2] > 100  # solid orange in the middle of the ball


@pytest.mark.parametrize("peels", [True, False])
def test_what_is_nearer_lies_over_what_is_farther_in_whatever_order_it_came(stage, peels):
    def sheet(y):
        mesh = isosurface(ball(), np.eye(4), 0.0, 4000)
        return meshes.Mesh(mesh.points + np.float32([0, y, 0]), mesh.triangles, mesh.normals)

    red, blue = (220, 20, 20), (20, 20, 220)
    orbit = Orbit.from_side("A", np.full(3, 14.5), 20.0)
    stage.peels = peels
    seen = []
    for shown in (((red, sheet(0)), (blue, sheet(40))), ((blue, sheet(40)), (red, sheet(0)))):
        stage.set_structures(shown)
        stage.set_display(Display(xray=True))
        seen.append(stage.render(orbit, SIZE, False)[45, 60, :3].astype(int))
    assert seen[0][0] > seen[0][2] > 0
    assert_allclose(seen[0], seen[1], atol=2)


def test_path_and_tolerance_are_seen_through_the_body(stage, surfaces):
    orbit = Orbit.from_side("A", np.full(3, 14.5), 20.0)
    stage.set_surfaces(surfaces)
    plain = stage.render(orbit, SIZE, False)[:, :, :3].astype(int)
    stage.set_plan(DraftPlan((14.5, 14.5, 34.5), (14.5, 14.5, 14.5)))
    stage.set_tolerances((2.0, 5.0))
    planned = stage.render(orbit, SIZE, False)[:, :, :3].astype(int)
    changed = np.abs(planned - plain).max(axis=2) > 12
    assert changed[20:44, 58:63].any(axis=1).all()  # the path, inside the ball
    ring = changed[43:48, 45:76].any(axis=0)
    assert ring[[4, 26]].any()  # 5 mm beside the target, across the path
    stage.set_plan(DraftPlan())
    assert np.abs(stage.render(orbit, SIZE, False)[:, :, :3] - plain).max() <= 2


def test_slices_stand_where_they_are_with_the_values_of_the_ct(stage, volume):
    _, section = plane_of(volume, find_body(volume))
    orbit = Orbit.from_side("A", section.frame.origin_mm, 40.0)
    stage.set_sections((section,))
    picture = stage.render(orbit, (160, 160), False)[:, :, :3]
    assert picture[80, 80].min() > 250  # bone
    assert_allclose(picture[80, 80 + 24], 127, atol=6)  # tissue of 40 HU at level 40
    assert picture[80, 2].max() == 0
    stage.set_sections(())
    assert stage.render(orbit, (160, 160), False)[:, :, :3].max() == 0


def test_a_cut_takes_away_what_lies_before_it_from_either_side(stage, volume):
    body = find_body(volume)
    _, section = plane_of(volume, body)
    stage.set_surfaces(extract_surfaces(volume, body, Progress()))
    for side in "AP":
        orbit = Orbit.from_side(side, section.frame.origin_mm, 40.0)
        stage.set_cut(None)
        whole = stage.render(orbit, (160, 160), False)[80, 80 + 24, :3].astype(int)
        stage.set_cut(section)
        cut = stage.render(orbit, (160, 160), False)[80, 80 + 24, :3].astype(int)
        assert whole[0] - whole[2] > 8  # skin
        assert_allclose(cut, 127, atol=6)  # the CT
    beside = Orbit.from_side("R", section.frame.origin_mm, 40.0)
    picture = stage.render(beside, (160, 160), False)[80, :, :3].max(axis=1)
    assert picture.max() > 30


@pytest.mark.parametrize("preset", ["bone", "skin", "lung", "vessels"])
def test_the_volume_is_rendered_where_it_is_asked_for(monkeypatch, volume, preset):
    monkeypatch.setenv("ACUS_VOLUME", "1")
    stage = Stage()
    stage.open()
    patient, section = plane_of(volume, find_body(volume))
    orbit = Orbit.from_side("A", section.frame.origin_mm, 40.0)
    try:
        stage.set_patient(patient)
        stage.set_display(Display(volume=preset))
        shown = stage.render(orbit, (64, 64), False)[:, :, :3]
        stage.set_display(Display())
        assert stage.render(orbit, (64, 64), False)[:, :, :3].max() == 0
        assert shown[32, 32].max() > 20
        assert shown[2, 2].max() == 0
        stage.set_patient(None)
    finally:
        stage.close()


def test_without_a_graphics_card_surfaces_stay(monkeypatch, stage, surfaces, volume):
    monkeypatch.setenv("ACUS_VOLUME", "0")
    assert stage.driver
    stage.set_patient(Patient(volume, find_body(volume), "CT-TEST"))
    stage.set_surfaces(surfaces)
    stage.set_display(Display(volume="bone"))
    assert not stage.has_volume
    shown = stage.render(Orbit.from_side("A", np.full(3, 14.5), 20.0), SIZE, False)
    assert shown[45, 60, :3].max() > 60


# --- from where one looks -----------------------------------------------------------------------
@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda way: np.linalg.norm(way) > 0.1))
@settings(derandomize=True, deadline=None, max_examples=60)
def test_one_can_look_along_every_direction(way):
    orbit = Orbit.towards(way, (0.0, 0.0, 1.0), np.zeros(3), 50.0)
    basis = np.array([orbit.right, orbit.up, orbit.backwards])
    assert_allclose(basis @ basis.T, np.eye(3), atol=1e-9)
    assert_allclose(orbit.backwards, -np.asarray(way) / np.linalg.norm(way), atol=1e-9)


def test_the_operator_sees_the_motors_right_on_the_right_and_looks_down():
    R_world_patient = Placement().rotation
    orbit = Orbit.from_operator(R_world_patient, np.zeros(3), 50.0)
    assert_allclose(R_world_patient @ orbit.right, [1.0, 0.0, 0.0], atol=1e-9)
    eye = R_world_patient @ orbit.backwards
    assert eye[1] < 0.0 < eye[2]


def test_keys_look_along_the_needle_and_back(view):
    home = view.orbit
    QTest.keyClick(view, Qt.Key.Key_N)
    assert view.orbit is home  # neither needle nor path
    view.set_plan(DraftPlan((0.0, 0.0, 50.0), (0.0, 30.0, 0.0)))
    QTest.keyClick(view, Qt.Key.Key_N)
    way = np.array([0.0, 30.0, -50.0]) / np.hypot(30.0, 50.0)
    assert_allclose(view.orbit.backwards, -way, atol=1e-9)
    view.set_needle(NeedleOverlay([10.0, 0.0, 0.0], [0.0, 0.0, 0.0]))
    QTest.keyClick(view, Qt.Key.Key_N)
    assert_allclose(view.orbit.backwards, [1.0, 0.0, 0.0], atol=1e-9)
    QTest.keyClick(view, Qt.Key.Key_W)
    for _ in range(3):
        QTest.keyClick(view, Qt.Key.Key_Backspace)
    assert view.orbit is home
    QTest.keyClick(view, Qt.Key.Key_Backspace)
    assert view.orbit is home


@pytest.mark.parametrize(("key", "part"), [
    (Qt.Key.Key_X, "xray"), (Qt.Key.Key_C, "cut"), (Qt.Key.Key_M, "slices"),
    (Qt.Key.Key_Y, "organs"), (Qt.Key.Key_Q, "light"), (Qt.Key.Key_Z, "guides"),
])  # fmt: skip
def test_a_key_switches_what_is_shown(view, key, part):
    spy = QSignalSpy(view.display_changed)
    before = getattr(view.display, part)
    QTest.keyClick(view, key)
    assert getattr(view.display, part) is not before
    QTest.keyClick(view, key)
    assert view.display == Display()
    assert spy.count() == 2


@pytest.mark.long("journey")
def test_the_menu_of_the_3d_view_says_what_each_entry_does_and_is_remembered(
    window, patient, settle
):
    feature = window.feature(SceneFeature)
    window.show_patient(patient)
    plan(window)
    scene, menu = window.workspace.scene, feature.menu
    entries = (*menu.standpoints.values(), *menu.switches.values())
    assert all(action.toolTip() and "\t" in action.text() for action in entries)
    menu.standpoints["S"].trigger()
    assert_allclose(scene.orbit.backwards, [0, 0, 1], atol=1e-12)
    menu.switches["Q"].trigger()
    menu.switches["M"].trigger()
    menu.switches["C"].trigger()
    assert scene.display == Display(light=True, slices=True, cut=True)
    assert settle(lambda: scene.is_settled, 30.0)
    assert scene.picture().pixelColor(1, 1).name() == LIGHT_BACKGROUND
    again = SceneFeature(feature.context)
    assert again.context.views.scene.display == scene.display
    menu.refresh()
    if scene.why_no_volume:
        assert not menu.presets["bone"].isEnabled()
        assert "graphics card" in menu.presets["bone"].toolTip()
    feature.forget()
    scene.set_display(Display())


def test_pictures_of_a_turn_get_as_small_as_the_machine_needs_and_grow_again():
    size, taken = 1.0, []
    for _ in range(12):
        taken.append(0.24 * size**2 + 0.02)  # 260 ms at full size
        size = moving_size(size, taken[-1])
    assert taken[-1] <= 0.1
    assert 0.4 <= size < 0.6
    for _ in range(20):
        size = moving_size(size, 0.02)
    assert size == 1.0
    assert moving_size(0.7, 0.0) == 0.7


def test_cables_are_coloured_by_tension_dashed_when_slack_and_the_reading_is_said():
    profile = load_profile("tensegrity")
    q = profile.machine.usable((0.2, -0.1, -0.95))
    shape = RobotShape.of(profile, q, (0.1, 2.0, 50.0, 200.0))
    assert [cable.slack for cable in shape.cables()] == [True, False, False, False]
    assert len({cable.mark.colour for cable in shape.cables()}) == 4
    assert shape.cables()[3].mark.colour == "#ffa000"
    assert len(shape.links()) == 9
    said = [words for _, words in shape.legend()]
    assert any("one rhombus" in words for words in said)
    assert any("slack" in words for words in said)
    assert RobotShape.of(load_profile("icube"), None).legend() == ()
    assert RobotShape.of(profile, q).cables()[0].slack is False


def test_a_slack_cable_is_drawn_as_dashes(stage):
    profile = load_profile("tensegrity")
    q = profile.machine.usable((0.2, -0.1, -0.95))
    stage.set_robot(RobotShape.of(profile, q, (30.0,) * 4), RigidTransform.identity())
    taut = len(stage._cables)
    stage.set_robot(RobotShape.of(profile, q, (0.0, *(30.0,) * 3)), RigidTransform.identity())
    assert taut == 4
    assert len(stage._cables) > 6
