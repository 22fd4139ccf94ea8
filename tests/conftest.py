"""What every test may rely on: no display, own user folders, the shared data or a reason."""

import gc
import itertools
import os
import socket
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("ACUS_ROLE", "technician")  # windows of tests have everything
os.environ["LC_ALL"] = "C.UTF-8"  # answers and windows of tests are English, whoever runs them
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")  # tests are not heard
os.environ.setdefault("MUJOCO_GL", "egl")
# Each process of the tests shares the cores with the others: threads of its linear algebra would
# only wait for each other, and take the processor meanwhile. Read when numpy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parents[1]

# A kernel of a test's rig is cached under the name by which its module was imported first;
# whichever tests run, and in which order, that name must be found again.
sys.path.extend(str(folder) for folder in sorted((ROOT / "tests").iterdir()) if folder.is_dir())

# Drawn examples are the same in every run: a test is not red by chance, and what it found stays.
settings.register_profile("seeded", derandomize=True, deadline=None)
settings.load_profile("seeded")

FIRST = (
    "arm/views/test_arm_view.py",
    "arm/test_arm_run.py",
    "test_compose_trial.py",
    "careless/test_careless_user.py",
    "arm/test_arm_scene.py",
    "studies/test_studies_coverage.py",
    "arm/test_arm_packages.py",
    "imaging/test_imaging_pacs.py",
    "views/test_views_author.py",
    "tracking/test_tracking_marker_coverage.py",
    "views/test_views_beginning.py",
    "test_other_systems.py",
    "device/test_device_link_test.py",
    "hard/test_hard_needle_axis.py",
    "test_privacy_leaks.py",
    "studies/test_studies_batch.py",
    "fuzz/test_fuzz.py",
    "views/test_views_again.py",
    "imaging/test_imaging_orthanc.py",
    "tracking/test_tracking_moved_camera.py",
    "exercises/test_exercises_shipped.py",
    "test_compose_hand.py",
    "views/test_views_scaling.py",
    "views/test_views_room.py",
    "mechanisms/test_mechanisms_contract.py",
    "imaging/test_imaging_pacs_hostile.py",
    "session/test_session_seals.py",
    "hard/test_hard_depth.py",
)
"""These take longest and begin first, so that no process is left with one of them at the end."""


@pytest.hookimpl(trylast=True)
def pytest_configure(config: pytest.Config) -> None:
    """Send at once what each process says of a test's runs: it is two packets and an answer for
    every test, and the second would wait 40 ms for the system to acknowledge the first."""
    sock = getattr(getattr(config, "failures_db", None), "sock", None)  # of pytest-rerunfailures
    if sock is not None:
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    if not hasattr(config, "workerinput"):  # each process of the run inherits the moment
        os.environ.pop("ACUS_TESTS_UNTIL", None)  # of a run around this one
        if seconds := os.environ.pop("ACUS_TESTS_SECONDS", ""):
            os.environ["ACUS_TESTS_UNTIL"] = str(time.time() + float(seconds))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Begin with the files that take longest, each as a whole; the others stay in their order.

    With `ACUS_TESTS_TURN` begin with the file of that number instead, and go round. What the file
    of `ACUS_TESTS_LEFT_OUT` names has passed already and is left out.
    """
    rank = {ROOT / "tests" / name: place for place, name in enumerate(FIRST)}
    if turn := os.environ.get("ACUS_TESTS_TURN"):
        files = list(dict.fromkeys(item.path for item in items))
        rank = {path: (k - int(turn)) % len(files) for k, path in enumerate(files)}
    items.sort(key=lambda item: rank.get(item.path, len(rank)))
    if file := os.environ.get("ACUS_TESTS_LEFT_OUT"):
        passed = set(Path(file).read_text(encoding="utf-8").splitlines())
        out = [item for item in items if item.nodeid in passed]
        config.hook.pytest_deselected(items=out)
        items[:] = [item for item in items if item.nodeid not in passed]


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup() -> None:
    """Skip what is left when the time of `ACUS_TESTS_SECONDS` is over."""
    until = os.environ.get("ACUS_TESTS_UNTIL")
    if until and time.time() > float(until):
        pytest.skip("the time of this run was over")


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Write a test of another process that passed into the file of `ACUS_TESTS_PASSED`."""
    file = os.environ.get("ACUS_TESTS_PASSED")  # of tools/twice-if-killed
    if file and hasattr(report, "node") and report.when == "call" and report.passed:
        with open(file, "a", encoding="utf-8") as passed:
            passed.write(report.nodeid + "\n")


# A program that is killed has its files as the system has them, and waiting for the disk would take
# longer than all else about a record. What it keeps when the power fails is looked at by
# `test_session_synced` alone, which sees who would have waited.
os.fsync = lambda _: None

# What hundreds of test files import stays to the end: no collection of garbage looks at it.
gc.disable()


def pytest_collection_finish() -> None:
    """Leave modules and tests to themselves: no collection walks them again."""
    gc.freeze()


FULL_EVERY = 100
"""One in so many tests ends with a full collection; what is left then stays, and is not walked."""
_ended = itertools.count(1)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_teardown() -> Iterator[None]:
    """Collect garbage between two tests only, on the main thread, when their widgets are destroyed.

    Left to Python, a collection begins in whichever thread happens to allocate, and takes Qt's
    objects apart there, the items before the scenes that hold them: Qt crashes, now and then. The
    window has the same rule (`app.views.shell.collector`), but many tests build a page alone.
    """
    yield
    if next(_ended) % FULL_EVERY:
        gc.collect(1)
    else:
        gc.collect()
        gc.freeze()


@pytest.fixture(autouse=True)
def own_user_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Settings and recordings of a test stay in the test's folder; caches are shared."""
    monkeypatch.setenv("ACUS_SETTINGS", str(tmp_path / "settings"))
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path / "sessions"))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real CT and stereo data (`ACUS_TEST_DATA`)."""
    folder = Path(os.environ.get("ACUS_TEST_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"real data not found in {folder}: set ACUS_TEST_DATA")
    return folder
