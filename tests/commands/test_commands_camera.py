"""`acus camera` on folders of pictures: no camera is needed."""

import json

import cv2
import numpy as np
import pytest

from app.__main__ import main
from app.tracking.cameras.ports import CameraPort
from app.tracking.cameras.settings import (
    CameraSettings,
    keep_colour,
    load_settings,
    parse_cameras,
)
from app.tracking.markers.colour import ColourModel


@pytest.fixture
def folders(tmp_path):
    rng = np.random.default_rng(1)
    for side in ("left", "right"):
        (tmp_path / side).mkdir()
        for number in range(3):
            image = rng.integers(80, 160, (48, 64, 3)).astype(np.uint8)
            assert cv2.imwrite(str(tmp_path / side / f"{number}.png"), image)
    return tmp_path


def run(monkeypatch, capsys, *words):
    monkeypatch.setattr("sys.argv", ["acus", *map(str, words)])
    with pytest.raises(SystemExit) as end:
        main()
    said = capsys.readouterr()
    return end.value.code, said.out, said.err


def test_sources_are_chosen_remembered_and_listed(monkeypatch, capsys, folders):
    words = ("camera", "use", "--left", f"folder:{folders}/left", "--right", "usb:1-1.2",
             "--size", "64x48", "--exposure-ms", "5")  # fmt: skip
    assert run(monkeypatch, capsys, *words)[0] == 0
    settings = load_settings()
    assert settings.right.source == "usb:1-1.2"
    assert settings.size == (64, 48)
    assert settings.left.exposure_ms == 5.0
    code, out, _ = run(monkeypatch, capsys, "camera", "list", "--json")
    assert code == 0
    assert json.loads(out)["facts"]["chosen"]["right"]["source"] == "usb:1-1.2"
    assert run(monkeypatch, capsys, "camera", "latency")[1].count("not measured") == 2


@pytest.mark.parametrize(
    ("words", "message"),
    [(("use", "--left", "usb:1-1"), "one camera is real and one simulated"),
     (("use", "--left", "usb:1", "--right", "usb:1"), "left and right are the same source"),
     (("use", "--left", "webcam"), "valid are: usb:PORT"),
     (("use", "--size", "big"), "give for example 640x480"),
     (("use", "--rate", "0"), "rate_hz"),
     (("latency", "--display"), "no latency to measure"),
     (("latency", "--display", "--side", "top"), "there is no 'top' camera"),
     (("test",), "the cameras are simulated"),
     (("test", "--source", "usb:9-9"), "no camera at usb:9-9"),
     (("test", "--cameras", "left=a"), "names no cameras|valid are"),
     (("test", "--cameras", "sideways"), "left=SOURCE,right=SOURCE"),
     (("aim", "--depths", "deep"), "give for example -30,120"),
     (("aim", "--depths", "9,3"), "swap depth_min_mm"),
     (("aim", "--tilt", "120"), "tilt_max_deg"),
     (("aim", "--rig", "narrow"), "no camera rig is called 'narrow'")],
)  # fmt: skip
def test_a_bad_choice_is_one_line_that_says_what_to_do(monkeypatch, capsys, words, message):
    code, _, err = run(monkeypatch, capsys, "camera", *words)
    assert code == 2
    assert err.count("\n") == 1
    assert any(part in err for part in message.split("|"))


def test_it_says_what_two_folders_deliver(monkeypatch, capsys, folders):
    cameras = f"left=folder:{folders}/left,right=folder:{folders}/right"
    run(monkeypatch, capsys, "camera", "use", "--size", "64x48")
    words = ("camera", "test", "--cameras", cameras, "--seconds", "0.4", "--json")
    code, out, err = run(monkeypatch, capsys, *words, "--out", folders / "out")
    assert code == 0, err
    shown = json.loads(out)["facts"]
    assert [camera["size"] for camera in shown["cameras"]] == [[64, 48]] * 2
    assert abs(shown["skew_ms"]) < 40.0
    assert "no calibration yet" in shown["order"]
    assert (folders / "out" / "right.png").is_file()


@pytest.mark.long("journey")
def test_a_learned_colour_is_kept_with_its_cameras_shown_and_forgotten(
    monkeypatch, capsys, folders
):
    blue = ColourModel(bgr=(200.0, 40.0, 30.0), angle_deg=12.0)
    sources = ("--left", f"folder:{folders}/left", "--right", f"folder:{folders}/right")
    assert run(monkeypatch, capsys, "camera", "use", *sources, "--size", "64x48")[0] == 0
    assert keep_colour(CameraSettings(), blue) is None  # simulated: theirs is always red
    once = parse_cameras(f"left=folder:{folders}/right,right=folder:{folders}/left")
    assert keep_colour(once, blue) is None
    assert load_settings().marker_colour is None
    assert keep_colour(load_settings(), blue).is_file()
    assert load_settings().marker_colour == blue

    examine = ("camera", "test", "--seconds", "0.3")
    assert "learned, red 30 green 40 blue 200" in run(monkeypatch, capsys, *examine)[1]
    shown = json.loads(run(monkeypatch, capsys, *examine, "--json")[1])["facts"]
    assert shown["marker_colour"]["angle_deg"] == 12.0
    assert parse_cameras(f"right=usb:0,left=folder:{folders}/left").marker_colour is None

    assert run(monkeypatch, capsys, "camera", "use", "--forget-colour")[0] == 0
    assert load_settings().marker_colour is None
    assert "the usual red" in run(monkeypatch, capsys, *examine)[1]


def test_pictures_of_another_size_are_refused_by_name(monkeypatch, capsys, folders):
    cameras = f"left=folder:{folders}/left,right=folder:{folders}/right"
    code, _, err = run(monkeypatch, capsys, "camera", "test", "--cameras", cameras)
    assert code == 2
    assert "camera left" in err
    assert "64x48" in err


def test_the_aim_of_a_rig_is_said_without_a_camera(monkeypatch, capsys, tmp_path):
    code, out, _ = run(monkeypatch, capsys, "camera", "aim", "--rig", "wide", "--json")
    assert code == 0
    assert json.loads(out)["facts"]["share"] == 1.0
    words = ("camera", "aim", "--rig", "thesis", "--depths", "-30,120", "--json")
    assert 0.25 < json.loads(run(monkeypatch, capsys, *words)[1])["facts"]["share"] < 0.4
    words = ("camera", "aim", "--rig", "thesis", "--out", tmp_path / "aim")
    code, out, _ = run(monkeypatch, capsys, *words)
    assert code == 0
    assert "both cameras see 100 %" in out
    assert (tmp_path / "aim" / "left.png").is_file()


def test_the_latency_test_is_refused_without_a_screen(monkeypatch, capsys, folders):
    words = ("camera", "use", "--left", f"folder:{folders}/left",
             "--right", f"folder:{folders}/right")  # fmt: skip
    assert run(monkeypatch, capsys, *words)[0] == 0
    code, _, err = run(monkeypatch, capsys, "camera", "latency", "--display")
    assert code == 2
    assert "needs a real screen" in err


def test_it_names_every_picture_of_a_folder_that_cannot_be_used(monkeypatch, capsys, folders):
    (folders / "left" / "1.png").write_bytes(b"\x89PNG, cut off")
    (folders / "left" / "notes.jpg").write_bytes(b"")
    assert cv2.imwrite(str(folders / "left" / "3.png"), np.full((24, 32, 3), 90, np.uint8))
    words = ("camera", "test", "--source", f"folder:{folders}/left", "--seconds", "0.3")
    code, out, err = run(monkeypatch, capsys, *words)
    assert code == 0, err
    assert "left/1.png is no picture or is damaged" in out
    assert "left/notes.jpg is no picture or is damaged" in out
    assert "different sizes: 64x48 (0.png …), 32x24 (3.png …)" in out
    document = json.loads(run(monkeypatch, capsys, *words, "--json")[1])
    advice = document["facts"]["cameras"][0]["advice"]
    assert sum("is no picture or is damaged" in line for line in advice) == 2


def test_a_source_that_is_not_there_is_saved_with_a_word_about_what_is(
    monkeypatch, capsys, folders
):
    port = CameraPort("1-1.2", "1-1.2:1.0", "/dev/video0", "Webcam")
    monkeypatch.setattr("app.tracking.cameras.ports.camera_ports", lambda: (port,))
    words = ("camera", "use", "--left", "usb:77", "--right", "usb:1-1.2")
    code, out, err = run(monkeypatch, capsys, *words)
    assert code == 0
    assert "saved in" in out
    assert err.count("\n") == 1
    assert "left: no camera at usb:77; plugged in are: usb:1-1.2 (Webcam); saved all the" in err
    assert load_settings().left.source == "usb:77"
    code, _, err = run(monkeypatch, capsys, "camera", "use", "--left", f"folder:{folders}/nobody")
    assert (code, "there is no folder" in err) == (0, True)
