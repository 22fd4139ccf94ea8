"""Calibration files: what goes out comes back; what is wrong is named."""

import random
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml

from app.core.configuration import parse_yaml
from app.core.errors import ConfigurationError
from app.tracking.calibration.formats.own import load_calibration, save_calibration
from app.tracking.calibration.formats.reading import read_calibration
from app.tracking.calibration.formats.ros import documents, ros_paths, write_ros
from app.tracking.calibration.formats.storage import read_matrices
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.lens import LensModel
from app.tracking.optics.rig import load_rig
from tests.tracking.calibration_samples import sample

ICUBE_LEFT = """\
image_width: 640
image_height: 480
camera_name: cam_0
camera_matrix:
  rows: 3
  cols: 3
  data: [1088.60442, 0.0, 314.54243, 0.0, 1090.75158, 220.77703, 0.0, 0.0, 1.0]
distortion_model: plum_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.091006, 2.735876, -0.001135, -0.004749, -20.789586]
projection_matrix:
  rows: 3
  cols: 4
  data: [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
single camera reprojection error (mean squared):
  data: 0.29903504166474704
stereo reprojection error (mean squared):
  data: 0.3822677852778425
"""

ICUBE_RIGHT = """\
image_width: 640
image_height: 480
camera_name: cam_1
camera_matrix:
  rows: 3
  cols: 3
  data: [1066.01844, 0.0, 300.32019, 0.0, 1068.37404, 235.42159, 0.0, 0.0, 1.0]
distortion_model: plum_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.117272, 2.996853, 0.000220, -0.011057, -22.742781]
projection_matrix:
  rows: 3
  cols: 4
  data: [-0.2089, -0.04576, 0.97687, -14.41294, 0.02555, 0.99831, 0.05223, -1.19696,
         -0.9776, 0.03587, -0.20738, 17.04343]
single camera reprojection error (mean squared):
  data: 0.23064712215628463
stereo reprojection error (mean squared):
  data: 0.3822677852778425
"""

INTRINSICS = """\
intrinsic:
903.2545392417838 0.0 638.4867270329387
0.0 904.8591527878028 358.98011401394757
0.0 0.0 1.0
distortion:
0.07131 -0.03204 -0.00215 -0.00148 -0.33213
"""

FIRST_POSE = "R:\n1.0 0.0 0.0\n0.0 1.0 0.0\n0.0 0.0 1.0\nT:\n0.0\n0.0\n0.0\n"

SECOND_POSE = """\
R:
0.9262679714049468 0.0406054944162962 0.37467164153772436
0.011960496214397523 0.9905103615701789 -0.1369166540360191
-0.3766757115605813 0.13130277013575037 0.91699236140494
T:
-30.11817812152031
8.814552136551228
-1.0275385147439609
"""


@pytest.fixture
def calibration() -> StereoCalibration:
    return sample(load_rig("thesis"))


@pytest.fixture
def icube(tmp_path: Path) -> tuple[Path, Path]:
    left, right = tmp_path / "cam_0_info.yaml", tmp_path / "cam_1_info.yaml"
    left.write_text(ICUBE_LEFT)
    right.write_text(ICUBE_RIGHT)
    return left, right


@pytest.fixture
def temuge(tmp_path: Path) -> Path:
    for i, pose in enumerate((FIRST_POSE, SECOND_POSE)):
        (tmp_path / f"camera{i}_intrinsics.dat").write_text(INTRINSICS)
        (tmp_path / f"camera{i}_rot_trans.dat").write_text(pose)
    return tmp_path


def test_the_own_file_brings_back_every_number(
    tmp_path: Path, calibration: StereoCalibration
) -> None:
    path = tmp_path / "one.yaml"
    save_calibration(path, calibration)
    assert load_calibration(path) == calibration
    assert read_calibration([path]) == calibration
    assert [p.name for p in tmp_path.iterdir()] == ["one.yaml"]


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("rms_px", -1.0, "rms_px"),
        ("id", "../x", "id"),
        ("format", "other", "acus-stereo-calibration"),
        ("pose", {"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 2]], "translation_mm": [1, 2, 3]},
         "not orthonormal"),
        ("created", "yesterday", "created"),
    ],
)  # fmt: skip
def test_a_wrong_field_of_the_own_file_is_named(
    tmp_path: Path, calibration: StereoCalibration, field: str, value: object, words: str
) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(yaml.safe_dump(calibration.model_dump(mode="json") | {field: value}))
    with pytest.raises(CalibrationError, match=words) as error:
        load_calibration(path)
    assert str(path) in str(error.value)


def test_the_pair_of_icube_is_read_with_centimetres_and_no_camera_matrix_in_its_projection(
    icube: tuple[Path, Path],
) -> None:
    found = read_calibration(icube)
    assert found.baseline == pytest.approx(0.2235, abs=1e-4)
    assert found.cameras[1].focal_px == (1066.01844, 1068.37404)
    assert found.cameras[0].distortion[4] == -20.789586
    assert found.cameras[1].rms_px == pytest.approx(0.2306, abs=1e-4)
    assert found.rms_px == pytest.approx(0.3823, abs=1e-4)
    angle = np.degrees(np.arccos((np.trace(found.pose.transform.rotation) - 1.0) / 2.0))
    assert angle == pytest.approx(102.1, abs=0.1)
    assert found.world is None
    assert any("uncertainty" in note for note in found.notes)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("image_width: 640", "image_width: wide", "image_width.*'wide'"),
        ("image_height: 480\n", "", "image_height is missing"),
        ("plum_bob", "equidistant", "distortion_model.*plumb_bob.*'equidistant'"),
        ("-22.742781]", "-22.742781, 0.1]", "distortion_coefficients.data.*6 values"),
        ("-22.742781]", ".nan]", "finite"),
        ("[-0.2089,", "[0.9,", "projection_matrix.*no rotation"),
        ("[1066.01844,", "[-1066.01844,", "camera_matrix.*positive focal"),
        ("rows: 1", "rows: 2", "distortion_coefficients"),
        ("  data: 0.23", "  data: -0.23", "at least 0"),
    ],
)
def test_a_wrong_field_of_icubes_file_is_named(
    icube: tuple[Path, Path], old: str, new: str, words: str
) -> None:
    assert old in ICUBE_RIGHT
    icube[1].write_text(ICUBE_RIGHT.replace(old, new, 1))
    with pytest.raises(CalibrationError, match=words) as error:
        read_calibration(icube)
    assert "cam_1_info.yaml" in str(error.value)


def test_the_same_file_given_twice_is_refused(icube: tuple[Path, Path]) -> None:
    with pytest.raises(CalibrationError, match="same place"):
        read_calibration([icube[1], icube[1]])


def test_the_text_files_of_temuge_are_read_in_their_unit(temuge: Path) -> None:
    found = read_calibration([temuge], unit=0.01, image_size=(1280, 720))
    assert found.baseline == pytest.approx(np.linalg.norm([0.3012, 0.0881, 0.0103]), abs=1e-4)
    assert found.cameras[0].image_size == (1280, 720)
    assert found.cameras[0].focal_px[1] == 904.8591527878028
    inches = read_calibration([temuge], unit=0.0254, image_size=(1280, 720))
    assert inches.baseline == pytest.approx(2.54 * found.baseline)


def test_text_files_without_a_unit_or_a_size_are_refused(temuge: Path) -> None:
    with pytest.raises(CalibrationError, match="--unit"):
        read_calibration([temuge])


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("camera1_rot_trans.dat", "R:\n1 0 0\n0 1 0\nT:\n0\n0\n0\n", "camera1_rot_trans.dat: R:"),
        ("camera1_rot_trans.dat", SECOND_POSE.replace("-30.1", "far"), "T: numbers are needed"),
        ("camera1_rot_trans.dat", SECOND_POSE.replace("0.92", "1.92"), "no rotation"),
        ("camera0_intrinsics.dat", INTRINSICS.replace("distortion:", "d:"), "'distortion:'"),
        (
            "camera0_intrinsics.dat",
            INTRINSICS.replace("-0.33213", "1 2 3"),
            "coefficients are possible",
        ),
        ("camera0_intrinsics.dat", INTRINSICS.replace("638.48", "nan 638.48"), "finite"),
    ],
)
def test_a_wrong_section_of_temuges_files_is_named(
    temuge: Path, name: str, text: str, words: str
) -> None:
    (temuge / name).write_text(text)
    with pytest.raises(CalibrationError, match=words):
        read_calibration([temuge], unit=0.01, image_size=(1280, 720))


def test_a_camera_without_its_pose_is_named(temuge: Path) -> None:
    (temuge / "camera1_rot_trans.dat").unlink()
    with pytest.raises(CalibrationError, match=r"camera1_intrinsics.dat: its pose is missing"):
        read_calibration([temuge], unit=0.01, image_size=(1280, 720))


@pytest.mark.parametrize("rig", ["thesis", "wide"])
def test_ros_camera_info_brings_the_pair_back(tmp_path: Path, rig: str) -> None:
    calibration = sample(load_rig(rig))
    left, right = ros_paths(tmp_path, calibration)
    write_ros(left, right, calibration)
    found = read_calibration([left, right])
    np.testing.assert_allclose(
        found.pose.transform.matrix(), calibration.pose.transform.matrix(), atol=1e-12
    )
    for ours, theirs in zip(found.cameras, calibration.cameras, strict=True):
        assert ours.focal_px == theirs.focal_px
        assert ours.centre_px == theirs.centre_px
        assert ours.distortion == theirs.distortion
        assert ours.image_size == theirs.image_size


def test_both_rectified_pictures_of_a_point_lie_on_one_row(calibration: StereoCalibration) -> None:
    left, right = documents(calibration)
    point = np.array([0.01, 0.02, 0.25])
    other = calibration.pose.transform @ point
    pixels = []
    for document, p in ((left, point), (right, other)):
        rotation = np.reshape(document["rectification_matrix"]["data"], (3, 3))
        projection = np.reshape(document["projection_matrix"]["data"], (3, 4))
        base = 0.0 if document is left else calibration.baseline
        rectified = np.append(rotation @ p + [base, 0.0, 0.0], 1.0)
        u, v, w = projection @ rectified
        pixels.append((u / w, v / w))
    assert pixels[0][1] == pytest.approx(pixels[1][1], abs=1e-9)


def test_files_of_two_formats_or_too_many_are_refused(
    tmp_path: Path, icube: tuple[Path, Path], calibration: StereoCalibration
) -> None:
    left, right = ros_paths(tmp_path / "ros", calibration)
    write_ros(left, right, calibration)
    with pytest.raises(CalibrationError, match="different formats"):
        read_calibration([icube[0], right])
    with pytest.raises(CalibrationError, match="3 files were given"):
        read_calibration([left, right, right])


def storage(path: Path, **matrices: np.ndarray) -> Path:
    """Write a file as OpenCV's samples do."""
    out = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in matrices.items():
        out.write(name, np.asarray(value, dtype=np.float64))
    out.release()
    return path


@pytest.fixture
def opencv(tmp_path: Path, calibration: StereoCalibration) -> tuple[Path, Path]:
    """What stereo_calib writes of the sample: squares typed in centimetres."""
    matrices = {}
    for i, camera in enumerate(calibration.cameras, start=1):
        (fx, fy), (cx, cy) = camera.focal_px, camera.centre_px
        matrices[f"M{i}"] = [[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
        matrices[f"D{i}"] = [camera.distortion]
    pose = calibration.pose.transform
    outer = {"R": pose.rotation, "T": pose.translation[:, None] / 0.01, "Q": np.eye(4)}
    return (
        storage(tmp_path / "intrinsics.yml", **matrices),
        storage(tmp_path / "extrinsics.yml", **outer),
    )


@pytest.mark.parametrize("turned", [False, True])
def test_the_pair_of_opencvs_stereo_sample_is_read_in_its_unit_in_either_order(
    opencv: tuple[Path, Path], calibration: StereoCalibration, turned: bool
) -> None:
    files = opencv[::-1] if turned else opencv
    found = read_calibration(files, unit=0.01, image_size=(640, 480))
    np.testing.assert_allclose(
        found.pose.transform.matrix(), calibration.pose.transform.matrix(), atol=1e-9
    )
    for ours, theirs in zip(found.cameras, calibration.cameras, strict=True):
        assert ours.focal_px == theirs.focal_px
        assert ours.distortion == theirs.distortion
        assert ours.image_size == (640, 480)
    assert not found.uncertainty_known
    assert calibration.uncertainty_known


MATRIX = np.array([[600.0, 0.0, 320.0], [0.0, 600.0, 240.0], [0.0, 0.0, 1.0]])
LONGER = {
    8: [0.3, -0.07, 1e-3, -5e-4, -0.003, 0.66, -0.05, -0.017],
    12: [-0.2, 0.05, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 3e-3, -1e-3, 2e-3, 1e-3],
    14: [0.9, 0.12, 2e-4, -1e-4, 0.004, 1.25, 0.35, 0.02, 1e-3, 0.0, 1e-3, 0.0, 0.0, 0.0],
}


def points_ahead() -> np.ndarray:
    return np.random.default_rng(1).uniform([-0.5, -0.38, 1.0], [0.5, 0.38, 1.0], (200, 3))


@pytest.mark.parametrize("count", LONGER)
def test_opencvs_longer_models_are_read_as_they_are(
    tmp_path: Path, opencv: tuple[Path, Path], count: int
) -> None:
    given = LONGER[count]
    files = storage(tmp_path / "both.yml", M1=MATRIX, M2=MATRIX, D1=[given], D2=[[0.0] * 14])
    found = read_calibration([files, opencv[1]], unit=0.01, image_size=(640, 480))
    assert [c.lens for c in found.cameras] == [LensModel.RATIONAL, LensModel.BROWN]
    assert found.covariance.shape == (31, 31)
    nothing = np.zeros(3)
    theirs = cv2.projectPoints(points_ahead(), nothing, nothing, MATRIX, np.array(given))[0][:, 0]
    ours, ok = found.models()[0].project(points_ahead())
    assert ok.all()
    assert np.abs(ours - theirs).max() < 1e-9


def test_a_fisheye_pair_of_opencv_is_read_where_its_model_is_named(
    tmp_path: Path, opencv: tuple[Path, Path]
) -> None:
    four = np.array([[-0.02], [0.004], [-0.003], [0.0005]])
    files = storage(tmp_path / "both.yml", M1=MATRIX, M2=MATRIX, D1=four, D2=four)
    found = read_calibration(
        [files, opencv[1]], unit=0.01, image_size=(640, 480), lens=LensModel.FISHEYE
    )
    nothing = np.zeros(3)
    theirs = cv2.fisheye.projectPoints(points_ahead()[:, None], nothing, nothing, MATRIX, four)[0]
    assert np.abs(found.models()[0].project(points_ahead())[0] - theirs[:, 0]).max() < 1e-9
    assert read_calibration([files, opencv[1]], unit=0.01, image_size=(640, 480)).cameras[
        0
    ].distortion == (-0.02, 0.004, -0.003, 0.0005, 0.0)


@pytest.mark.parametrize(
    ("given", "lens", "words"),
    [
        ([*[0.0] * 12, 0.01, 0.02], None, "tilted sensor"),
        ([0.1] * 6, None, "4, 5, 8, 12, 14 coefficients are possible, got 6"),
        ([0.1] * 5, LensModel.FISHEYE, "4 coefficients of the model equidistant"),
        ([0.1] * 6, LensModel.RATIONAL, "8, 12, 14 coefficients of the model rational"),
        ([0.1] * 8, LensModel.BROWN, "4, 5 coefficients of the model plumb_bob"),
        ([1e9] * 8, None, "no lens has a coefficient beyond"),
    ],
)
def test_a_lens_that_cannot_be_is_refused_with_the_reason(
    tmp_path: Path,
    opencv: tuple[Path, Path],
    given: list[float],
    lens: LensModel | None,
    words: str,
) -> None:
    files = storage(tmp_path / "both.yml", M1=MATRIX, M2=MATRIX, D1=[given], D2=[given])
    with pytest.raises(CalibrationError, match=words) as caught:
        read_calibration([files, opencv[1]], unit=0.01, image_size=(640, 480), lens=lens)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("lens", [LensModel.RATIONAL, LensModel.FISHEYE])
@pytest.mark.parametrize("mixed", [False, True])
def test_other_lenses_go_through_the_own_file_and_that_of_ros(
    tmp_path: Path, calibration: StereoCalibration, lens: LensModel, mixed: bool
) -> None:
    given = tuple(LONGER[12]) if lens is LensModel.RATIONAL else (-0.02, 0.004, -0.003, 0.0005)
    size = len(lens.parameters)
    other = calibration.cameras[0].model_dump() | {
        "lens": lens,
        "distortion": given,
        "estimated": lens.parameters,
        "covariance": (1e-6 * np.eye(size)).tolist(),
    }
    right = calibration.cameras[1].model_dump() if mixed else other | {"name": "right"}
    document = calibration.model_dump() | {"cameras": (other, right)}
    changed = StereoCalibration.model_validate(document)
    save_calibration(tmp_path / "one.yaml", changed)
    assert load_calibration(tmp_path / "one.yaml") == changed
    assert len(changed.covariance) == size + len(changed.cameras[1].lens.parameters) + 6
    files = ros_paths(tmp_path / "ros", changed)
    write_ros(*files, changed)
    found = read_calibration(files)
    assert [c.lens for c in found.cameras] == [c.lens for c in changed.cameras]
    assert found.cameras[0].distortion == given
    files[0].write_text(files[0].read_text().replace(lens.value, "fish_eye"))
    with pytest.raises(CalibrationError, match="plumb_bob, rational_polynomial, equidistant"):
        read_calibration(files)


def test_the_own_file_with_coefficients_of_another_lens_is_refused(
    tmp_path: Path, calibration: StereoCalibration
) -> None:
    save_calibration(tmp_path / "one.yaml", calibration)
    text = (tmp_path / "one.yaml").read_text()
    for old, new, words in (
        ("lens: plumb_bob", "lens: equidistant", "lens equidistant has 4"),
        ("lens: plumb_bob", "lens: wide", "lens"),
    ):
        (tmp_path / "two.yaml").write_text(text.replace(old, new, 1))
        with pytest.raises(CalibrationError, match=words):
            load_calibration(tmp_path / "two.yaml")
    kept = [line for line in text.splitlines() if "lens:" not in line]
    (tmp_path / "old.yaml").write_text("\n".join(kept))
    assert load_calibration(tmp_path / "old.yaml") == calibration


def test_a_lens_of_opencv_and_half_a_pair_are_told_in_one_line(
    tmp_path: Path, opencv: tuple[Path, Path]
) -> None:
    lens = storage(tmp_path / "lens.yml", camera_matrix=np.eye(3), distortion_coefficients=[[0.0]])
    for files, words in (
        ([lens], "does not say how two cameras stand"),
        ([lens, lens], "does not say how two cameras stand"),
        ([opencv[0]], r"R, T \(extrinsics.yml\), found M1, D1, M2, D2; give both"),
        ([opencv[0], opencv[1]], "--unit 1cm"),
    ):
        with pytest.raises(CalibrationError, match=words) as caught:
            read_calibration(files)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["%YAML:1.0\n---\nM1: [", "%YAML:1.0\nM1: !!opencv-matrix\n  x"])
def test_a_damaged_file_of_opencv_is_named_in_one_line(tmp_path: Path, text: str) -> None:
    path = tmp_path / "intrinsics.yml"
    path.write_text(text)
    with pytest.raises(CalibrationError, match=r"intrinsics.yml") as caught:
        read_calibration([path], unit=0.01, image_size=(640, 480))
    assert "\n" not in str(caught.value)


def test_a_text_file_that_cannot_be_read_is_named_with_what_to_do(temuge: Path) -> None:
    path = temuge / "camera1_rot_trans.dat"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(CalibrationError, match=r"camera1_rot_trans.dat is no text file; one of"):
        read_calibration([temuge], unit=0.01, image_size=(1280, 720))
    path.unlink()
    path.mkdir()
    (temuge / "world_to_camera1_rot_trans.dat").symlink_to(temuge / "nowhere")
    with pytest.raises(CalibrationError, match="its pose is missing"):
        read_calibration([temuge], unit=0.01, image_size=(1280, 720))
    with pytest.raises(CalibrationError, match=r"cannot read .*none.yaml: No such file"):
        read_calibration([temuge / "none.yaml"])


def test_a_real_file_of_opencvs_samples_asks_for_its_other_half(shared_data: Path) -> None:
    folder = shared_data / "stereo_opencv"
    with pytest.raises(CalibrationError, match="found M1, D1, M2, D2; give both files"):
        read_calibration([folder / "intrinsics.yml"])
    with pytest.raises(CalibrationError, match="a lens of OpenCV's one-camera sample"):
        read_calibration([folder / "left_intrinsics.yml"])


@pytest.mark.parametrize("suffix", ["yml", "xml", "json"])
def test_every_form_of_opencvs_files_is_read_as_opencv_reads_it(
    tmp_path: Path, suffix: str
) -> None:
    rng = np.random.default_rng(5)
    wanted = {
        "M1": rng.normal(size=(3, 3)) * 1e3,
        "D1": np.array([[0.0, -1e-7, 3e25, 5.0, 1.0]]),
        "T": rng.normal(size=(3, 1)),
    }
    path = storage(tmp_path / f"one.{suffix}", **wanted)
    found = read_matrices(path, ("M1", "D1", "T", "R"))
    assert set(found) == set(wanted)
    theirs = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    for key, value in found.items():
        np.testing.assert_array_equal(value, theirs.getNode(key).mat())
    theirs.release()


@pytest.mark.parametrize("suffix", ["yml", "xml", "json"])
def test_damaged_files_of_opencv_end_in_a_named_error_and_never_end_the_program(
    tmp_path: Path, opencv: tuple[Path, Path], suffix: str
) -> None:
    matrices = {}
    for path, keys in zip(opencv, (("M1", "D1", "M2", "D2"), ("R", "T")), strict=True):
        matrices |= read_matrices(path, keys)
    path = storage(tmp_path / f"both.{suffix}", **matrices)
    whole, dice = path.read_bytes(), random.Random(18)
    outcomes = {"right": 0, "named": 0}
    for _ in range(250):
        data = bytearray(whole)
        for _ in range(dice.randint(1, 4)):
            at, length = dice.randrange(len(data)), dice.randint(1, 12)
            piece = dice.choice(
                (b"", dice.randbytes(length), bytes(data[:length]), b"[", b"]", b":", b"\0")
            )
            data[at : at + dice.randint(0, length)] = piece
        path.write_bytes(data)
        try:
            read_calibration([path], unit=0.01, image_size=(640, 480))
            outcomes["right"] += 1
        except CalibrationError as error:
            outcomes["named" if "\n" not in str(error) else "in lines"] += 1
    assert min(outcomes.values()) > 5


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    "text",
    [
        "<?xml version='1.0'?><!DOCTYPE a [<!ENTITY b 'c'>]><opencv_storage/>",
        "<?xml version='1.0'?><opencv_storage><M1 type_id='opencv-matrix'/></opencv_storage>",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 1, dt: d, data: [.Nan]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 99999999, cols: 9999, dt: d, data: [1.]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 1, dt: d, data: '$base64$AA'}",
        '{"M1": ' + "[" * 5000,
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 2, dt: d, data: [1.]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 9999, cols: 9999, dt: d, data: [1.]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 1, dt: d, data: [one]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 1, dt: d, data: [[1.]]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 1, dt: q, data: [1.]}",
        "%YAML:1.0\nM1: !!opencv-matrix\n  {rows: 1, cols: 1, dt: d, data: [99999999999999999999]}",
        "%YAML:1.0\nM1: 5",
    ],
)
def test_what_is_no_matrix_in_a_file_of_opencv_is_named(tmp_path: Path, text: str) -> None:
    path = tmp_path / "intrinsics.yml"
    path.write_text(text + "\n# opencv-matrix\n")
    with pytest.raises(CalibrationError, match=r"intrinsics.yml") as caught:
        read_calibration([path], unit=0.01, image_size=(640, 480))
    assert "\n" not in str(caught.value)
    assert "opencv/modules" not in str(caught.value)


ONE = "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: 1\n   cols: 1\n   dt: d\n   data: [ 1. ]\n"


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ONE.replace("   dt", "\tdt"), "line 6: Tabs are prohibited"),
        (ONE + ONE[14:], "M1 is given twice"),
        (ONE.replace("   dt", "   cols: 2\n   dt"), "cols is given twice"),
        (ONE + "\0" + ONE, "control characters"),
        (ONE.replace("1. ", "1e999"), "M1: a matrix of finite numbers is needed, got inf"),
        (ONE.replace("1. ", "one"), "M1: a matrix of finite numbers is needed, got 'one'"),
        (ONE.replace("rows: 1", "rows: 0"), "M1: rows: a whole number from 1 to 10000"),
        (ONE + " " * (1 << 20), "larger than 1 MB"),
        ('{"M1": ' + "[" * 500_000 + "opencv-matrix", "process that read it was ended by SIGSEGV"),
        ("%YAML:1.0\n---\nM1: " + "[" * 500_000, "process that read it was ended by SIGSEGV"),
    ],
)
def test_a_file_that_opencv_takes_for_something_else_or_crashes_on_is_named(
    tmp_path: Path, text: str, words: str
) -> None:
    path = tmp_path / "both.yml"
    path.write_text(text)
    with pytest.raises(CalibrationError, match=words) as caught:
        read_matrices(path, ("M1", "R"))
    assert str(caught.value).startswith(f"{path}: ")
    path.write_text(ONE)  # and the next file is read
    assert read_matrices(path, ("M1", "R"))["M1"].tolist() == [[1.0]]


def test_opencv_parses_none_of_it_in_the_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = storage(tmp_path / "one.yml", M1=MATRIX)
    monkeypatch.delattr(cv2, "FileStorage")
    assert read_matrices(path, ("M1",))["M1"].tolist() == MATRIX.tolist()


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    path = tmp_path / "none.yml"
    with pytest.raises(CalibrationError, match=r"cannot read .*none.yml: No such file"):
        read_matrices(path, ("M1",))


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    "text",
    [
        "a: &a [x, x, x, x, x, x, x, x, x, x]\n"
        + "".join(
            f"{b}: &{b} [{', '.join(10 * ['*' + a])}]\n"
            for a, b in zip("abcdefgh", "bcdefghi", strict=True)
        ),
        "a: &a [*a]",
        "a: " + "1:" * 300 + "1.0",
        "[" * 3000,
    ],
)
def test_yaml_that_stands_for_more_than_it_says_is_refused_by_name(text: str) -> None:
    with pytest.raises(ConfigurationError, match="bomb is not valid YAML"):
        parse_yaml(text, "bomb")


@pytest.mark.parametrize("lens", [[0.0, 0.0, 0.0, 0.0, -1e-320], [1e300, 0.0, 0.0, 0.0, 0.0]])
def test_coefficients_that_vanish_or_no_lens_has_are_read_or_named(
    tmp_path: Path, opencv: tuple[Path, Path], lens: list[float]
) -> None:
    matrix = np.array([[600.0, 0.0, 320.0], [0.0, 600.0, 240.0], [0.0, 0.0, 1.0]])
    file = storage(tmp_path / "both.yml", M1=matrix, M2=matrix, D1=[lens], D2=[[0.0] * 5])
    if abs(lens[0]) > 1.0:
        with pytest.raises(CalibrationError, match="no lens has a coefficient beyond"):
            read_calibration([file, opencv[1]], unit=0.01, image_size=(640, 480))
    else:
        found = read_calibration([file, opencv[1]], unit=0.01, image_size=(640, 480))
        assert found.models()[0].fold > 1e6


def test_cameras_that_stand_beyond_any_room_are_named(temuge: Path) -> None:
    (temuge / "camera1_rot_trans.dat").write_text(
        SECOND_POSE.replace("-30.11817812152031", "1e308")
    )
    with pytest.raises(CalibrationError, match=r"camera1_rot_trans.dat.*translation"):
        read_calibration([temuge], unit=0.01, image_size=(1280, 720))
