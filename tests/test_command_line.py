import subprocess
import sys


def acus(*arguments, **options):
    command = [sys.executable, "-m", "app", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def one_line(text):
    return text.count("\n") == 1 and text.startswith("acus: ")


def test_help_names_every_noun():
    result = acus("--help")
    assert result.returncode == 0
    for noun in ("ct", "demo", "device", "explain", "run", "session", "study"):
        assert f" {noun} " in result.stdout


def test_help_loads_no_room():
    code = (
        "import sys; from app.commands import build; build();"
        "print([m for m in sys.modules if m.split('.')[0] in"
        " ('numpy', 'numba', 'PySide6', 'pydicom', 'cv2', 'vtkmodules')])"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == "[]"


def test_an_unknown_command_is_one_line_and_exit_code_2():
    result = acus("dance")
    assert result.returncode == 2
    assert one_line(result.stderr)


def test_a_path_that_does_not_exist_is_one_line_and_exit_code_2(tmp_path):
    result = acus("ct", "list", tmp_path / "nowhere")
    assert result.returncode == 2
    assert one_line(result.stderr)
    assert "nowhere" in result.stderr
    assert "Traceback" not in result.stderr


def test_a_demonstration_on_a_folder_without_ct_is_refused_at_once(tmp_path):
    (tmp_path / "note.txt").write_text("no CT here")
    result = acus("demo", "--headless", "--ct", tmp_path, "--out", tmp_path / "out")
    assert result.returncode == 2
    assert one_line(result.stderr)
    assert "note.txt" in result.stderr
