"""The start page comes up before anything heavy is loaded; each case in a fresh interpreter."""

import os
import subprocess
import sys
from importlib.util import find_spec

import pytest

from app.compose.desktop import HEAVY_MODULES

HEAVY = ("numba", "llvmlite", "vtkmodules", "scipy", "pydicom", "cv2")
OF_PEOPLE = ("sqlalchemy", "argon2", "cryptography")

START = """
import sys
from app.compose.desktop import Desktop
from app.views.shell.application import start
from app.views.shell.window import MainWindow
application = start(offscreen=True)
window = MainWindow(Desktop())
application.processEvents()
"""

LOADED = "print(*sorted({name.split('.')[0] for name in sys.modules}))"

PREPARE = """
import threading
import time
from app.core.progress import Progress
from app.planning.patient import load_phantom
failures = []
def guarded(work):
    try:
        work()
    except BaseException as error:
        failures.append(repr(error))
def load_patient():
    stopped = Progress()
    stopped.cancel()
    from app.core.progress import Cancelled
    try:
        load_phantom(1, stopped)
    except Cancelled:
        pass
from app.compose.desktop import HEAVY_MODULES
from app.core.loading import load_modules
rooms = ("core", "imaging", "views")  # the others compile for a minute where nothing is cached
names = [name for name in HEAVY_MODULES if name.split(".")[1] in rooms]
works = (lambda: load_modules(names, Progress()), load_patient, load_patient)
threads = [threading.Thread(target=guarded, args=(work,)) for work in works]
for thread in threads: thread.start()
while any(thread.is_alive() for thread in threads):
    application.processEvents()
    time.sleep(0.005)
if failures: sys.exit("; ".join(failures))
"""


def run(code, tmp_path):
    environment = os.environ | {"ACUS_SETTINGS": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"}
    command = [sys.executable, "-c", code]
    out = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=110)
    assert out.returncode == 0, out.stderr
    return set(out.stdout.split())


def test_the_window_s_modules_load_nothing_heavy(tmp_path):
    code = "import sys, app.views.shell.window, app.compose.desktop\n"
    assert not run(code + LOADED, tmp_path) & {*HEAVY, *OF_PEOPLE}


@pytest.mark.long("journey")
def test_the_start_page_loads_nothing_heavy(tmp_path):
    assert not run(START + LOADED, tmp_path) & {*HEAVY, *OF_PEOPLE}


@pytest.mark.long("journey")
def test_heavy_parts_load_beside_the_window_from_several_threads(tmp_path):
    assert set(HEAVY) - {"cv2"} <= run(START + PREPARE + LOADED, tmp_path)


def test_every_heavy_module_exists():
    assert all(find_spec(name) is not None for name in HEAVY_MODULES)
