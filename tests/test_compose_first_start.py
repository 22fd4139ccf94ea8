"""The tracker's kernels on a first start: a process of their own, shown, given up, not left."""

import subprocess
import sys

import pytest

from app.compose import first_start
from app.compose.first_start import COMMAND, TrackerKernels
from app.core.child_process import environment
from app.core.progress import Cancelled, Progress

READ_CAMERAS = "distortion", "packed", "silhouette", "kernels"
"""Files of kernels that are compiled for one kind of array."""

THREE = "for _ in range(3): print(flush=True)\nimport sys; sys.stdin.read()"


@pytest.fixture
def rehearsed(tmp_path, monkeypatch):
    """The file that says that the cache holds the kernels; it does not."""
    file = tmp_path / "rehearsed"
    monkeypatch.setattr(first_start, "rehearsed_file", lambda: file)
    return file


def nothing_to_wait_for(*_):
    pytest.fail("there was nothing to wait for")


def test_a_cache_that_holds_the_kernels_needs_no_process(rehearsed):
    rehearsed.touch()
    kernels = TrackerKernels(("no", "such", "program"))
    kernels.start()
    kernels.wait(Progress(nothing_to_wait_for))


def test_whoever_waits_sees_how_many_are_compiled_and_can_cancel(rehearsed):
    kernels, shares = TrackerKernels((sys.executable, "-c", THREE)), []
    kernels.start()
    kernels.start()  # the same process

    def listen(share, _text):
        shares.append(share)
        if share >= 3 / first_start.ABOUT:
            progress.cancel()

    progress = Progress(listen)
    with pytest.raises(Cancelled):
        kernels.wait(progress)
    assert shares == sorted(shares)
    kernels.close()
    kernels.close()
    kernels.wait(Progress(nothing_to_wait_for))


def test_a_process_that_fails_is_not_waited_for(rehearsed):
    kernels = TrackerKernels((sys.executable, "-c", "raise SystemExit(1)"))
    kernels.start()
    kernels.wait(Progress())
    kernels.close()
    assert not rehearsed.exists()


def test_the_process_ends_with_whoever_started_it():
    with subprocess.Popen(
        COMMAND, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, env=environment()
    ) as child:
        child.stdin.close()
        assert child.wait(60) == first_start.PARENT_ENDED == 75


@pytest.mark.long("journey")
@pytest.mark.timeout(1200)  # two cores may be busy
def test_a_first_start_fills_an_empty_cache_and_compiles_about_what_its_bar_goes_by(tmp_path):
    """One kernel a line; the second start finds the file that says so, and compiles none."""
    surroundings = environment(ACUS_CACHE=str(tmp_path))
    surroundings.pop("NUMBA_CACHE_DIR", None)
    lines = []
    for _ in range(2):
        with subprocess.Popen(
            COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=surroundings
        ) as child:
            lines.append(child.stdout.read().count(b"\n"))
            assert child.wait() == 0
        (complete,) = tmp_path.glob("kernels/*/rehearsed-*")
        compiled = [file.name for file in complete.parent.rglob("*.nbc")]
        assert compiled
        twice = [name for name in compiled if name.endswith(".2.nbc")]
        assert not [name for name in twice if name.split(".")[0] in READ_CAMERAS]
    assert 0.75 <= lines[0] / first_start.ABOUT <= 1.25
    assert lines[1] == 0
