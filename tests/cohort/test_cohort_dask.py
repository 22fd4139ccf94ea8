"""Workers of Dask: the same bytes by any number; killed ones lose nothing; errors of one line."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from shutil import copyfile

import pytest

from app.cohort import CohortError, crew_of
from app.cohort.dask_crew import check_address
from tests.cohort.dask_rig import (
    ROOT,
    Dask,
    acus,
    begun,
    environment,
    free_port,
    parts,
    wait_for_parts,
)
from tests.layered import layered

RECORDS = sorted((Path(__file__).parents[1] / "data").glob("records*/*.mcap"))


def records(folder, number):
    """Fill a folder with so many records, each file of another name."""
    folder.mkdir()
    for k in range(number):
        copyfile(RECORDS[k % len(RECORDS)], folder / f"2026{k:04d}-copy.mcap")
    return folder


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "address",
    ["tcp://10.1.2.3:8786", "10.1.2.3:8786", "tcp://nowhere.invalid:8786", "tcp://[2001:db8::1]:1"],
)
def test_a_scheduler_elsewhere_is_refused_without_tls_for_it_runs_what_it_is_sent(
    address,
):
    with pytest.raises(CohortError, match="Dask runs what it is sent") as refused:
        crew_of(address)
    assert "tls://" in str(refused.value)
    check_address(f"tls://{address.removeprefix('tcp://')}")


@pytest.mark.parametrize("address", ["", "head", "tcp://:1", "http://127.0.0.1:1", "tcp://a:99999"])
def test_what_is_no_address_of_a_scheduler_is_refused_with_one_that_is(address):
    with pytest.raises(CohortError, match=r"write tcp://127\.0\.0\.1:8786"):
        check_address(address)


@pytest.mark.parametrize("address", ["127.0.0.1:8786", "tcp://localhost:8786", "tcp://[::1]:8786"])
def test_the_loopback_is_taken_as_it_is(address):
    check_address(address)


@pytest.mark.long("journey")
def test_a_scheduler_that_is_not_there_is_one_line_with_what_to_do(tmp_path):
    place = records(tmp_path / "records", 1)
    words = "cohort", "rescore", "--folder", place, "--out", "a.parquet", "--scheduler"
    for scheme in ("tcp", "tls"):
        code, out, err = acus(*words, f"{scheme}://127.0.0.1:{free_port()}", folder=tmp_path)
        assert (code, out, len(err.strip().splitlines())) == (2, "", 1), err
        assert ("no scheduler answers" if scheme == "tcp" else "no certificates") in err


HIDDEN = """
import sys
for name in ("distributed", "dask", "pyarrow"):
    if name in sys.argv[1]:
        sys.modules[name] = None
sys.argv = ["acus", *sys.argv[2:]]
from app.__main__ import main
main()
"""


@pytest.mark.long("journey")
@pytest.mark.parametrize(("missing", "local"), [("distributed", 2), ("pyarrow", 1)])
def test_a_missing_package_is_one_line_that_names_the_extra(tmp_path, missing, local):
    place = records(tmp_path / "records", 1)
    words = "cohort", "rescore", "--folder", place, "--out", "a.parquet", "--local", local
    done = subprocess.run(
        [sys.executable, "-P", "-c", HIDDEN, missing, *map(str, words)],
        cwd=tmp_path, env=environment(), capture_output=True, text=True,
    )  # fmt: skip
    assert (done.returncode, len(done.stderr.strip().splitlines())) == (2, 1), done.stderr
    assert "cohort" in done.stderr.split("extra")[1]


@pytest.mark.long("journey")
def test_one_process_needs_no_dask(tmp_path):
    place = records(tmp_path / "records", 1)
    words = "cohort", "rescore", "--folder", place, "--out", tmp_path / "a.parquet"
    done = subprocess.run(
        [sys.executable, "-P", "-c", HIDDEN, "distributed,dask", *map(str, words)],
        cwd=tmp_path, env=environment(), capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.parquet").exists()


@pytest.mark.long("journey")
@pytest.mark.timeout(900)
def test_one_process_two_and_two_workers_of_a_scheduler_write_the_same_bytes(tmp_path):
    place = records(tmp_path / "records", 40)
    words = "cohort", "rescore", "--folder", place
    with Dask(tmp_path) as dask:
        dask.worker()
        dask.worker()
        dask.has_workers(2)
        ways = {"here": (), "two": ("--local", 2), "far": ("--scheduler", dask.address)}
        tables = []
        for name, way in ways.items():
            out = tmp_path / f"{name}.parquet"
            code, _, err = acus(*words, "--out", out, *way, folder=tmp_path)
            assert code == 0, err
            tables.append(out.read_bytes())
    assert tables[0] == tables[1] == tables[2]


@pytest.mark.long("journey")
@pytest.mark.timeout(900)
def test_killed_workers_and_a_killed_scheduler_lose_nothing(tmp_path):
    exercise = tmp_path / "layered.yaml"
    exercise.write_text(layered("first-insertion").model_dump_json(by_alias=True))
    (tmp_path / "grid.yaml").write_text(
        f"{{exercise: {exercise}, skills: [expert], seeds: 1, registration_error_mm: "
        f"{list(range(12))}}}"
    )
    words = "cohort", "sweep", "--grid", "grid.yaml", "--out"
    with Dask(tmp_path) as dask:
        first = dask.worker()
        dask.has_workers(1)
        running = begun(*words, "cut/a.parquet", "--scheduler", dask.address, folder=tmp_path)
        wait_for_parts(tmp_path / "cut", 2, running)
        dask.worker()
        dask.has_workers(2)
        first.send_signal(signal.SIGKILL)  # its part is done by the other
        wait_for_parts(tmp_path / "cut", 5, running)
        dask.scheduler.send_signal(signal.SIGKILL)
        _, err = running.communicate(timeout=120)
    assert running.returncode == 2, err
    assert "is gone: what is done is kept" in err
    assert len(err.strip().splitlines()) == 1
    done = {file: file.read_bytes() for file in parts(tmp_path / "cut")}
    assert 5 <= len(done) < 12
    code, out, err = acus(*words, "cut/a.parquet", folder=tmp_path)
    assert code == 0, err
    assert f"of which {len(done)} were there" in out
    assert {file: file.read_bytes() for file in done} == done
    assert acus(*words, "whole.parquet", folder=tmp_path)[0] == 0
    whole = (tmp_path / "whole.parquet").read_bytes()
    assert (tmp_path / "cut" / "a.parquet").read_bytes() == whole


@pytest.mark.long("journey")
@pytest.mark.timeout(900)
def test_a_worker_of_another_version_and_a_scheduler_in_the_open_are_refused(tmp_path):
    place = records(tmp_path / "records", 1)
    other = tmp_path / "other"
    other.mkdir()
    # As if its version had been written so; a copy of the program would compile all its kernels.
    version = "import app.scoring.version as one\none.SCORING_VERSION = 97\n"
    (other / "sitecustomize.py").write_text(version)
    words = "cohort", "rescore", "--folder", place, "--out", "a.parquet", "--scheduler"
    with Dask(tmp_path) as dask:
        code, _, err = acus(*words, dask.address, folder=tmp_path)
        assert (code, "has no worker" in err) == (2, True), err
        dask.worker(PYTHONPATH=f"{other}{os.pathsep}{ROOT}")
        dask._wait(
            lambda: "no worker" not in acus(*words, dask.address, folder=tmp_path)[2], "none"
        )
        code, _, err = acus(*words, dask.address, folder=tmp_path)
        assert (code, len(err.strip().splitlines())) == (2, 1), err
        assert "has another Acus" in err
        assert "scoring 97" in err
    with Dask(tmp_path, host="0.0.0.0") as dask:
        code, _, err = acus(*words, dask.address, folder=tmp_path)
        assert (code, "Dask runs what it is sent" in err) == (2, True), err
    assert not (tmp_path / "a.parquet").exists()
