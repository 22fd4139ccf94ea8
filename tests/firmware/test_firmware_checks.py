"""What is said of the C program by programs that are not ours: compilers, cppcheck, gcov, SPIN."""

import json
import os
import re
import subprocess
import sys

import pytest
from firmware_rig import FIRMWARE, OUT, ROOT, Bench, built, make, need
from model_table import TABLE, table

from app.device.faults import Fault

SAFETY = ("board.c", "encoder.c", "frame.c", "states.c")
UNCOVERED: dict[str, str] = {}
"""Branches that no test takes: `file:line:number` -> why none can."""


@pytest.mark.long("journey")
@pytest.mark.parametrize("device", ["icube", "tensegrity"])
def test_cppcheck_and_misras_rules_find_nothing(device):
    need("cppcheck")
    make("check", device, f"OUT={OUT / device}")


def test_every_deviation_has_its_reason():
    lines = (FIRMWARE / "deviations.txt").read_text(encoding="utf-8").splitlines()
    for rule in (line for line in lines if not line.startswith("#")):
        number = rule.split(":")[0].rpartition("-")[2]
        assert any(line.startswith("#") and number in line for line in lines), rule


@pytest.mark.long("journey")
def test_the_deepest_chain_of_calls_takes_less_than_a_kilobyte_of_stack():
    need("arm-none-eabi-gcc")
    out = OUT / "stack"
    make("stm32f405", "icube", f"OUT={out}")
    said = make("stack", "icube", f"OUT={out}")
    print(said)
    total = int(re.search(r"(\d+) bytes  all of them", said)[1])
    assert 100 < total < 1024
    usage = "".join(file.read_text() for file in out.glob("stm32f405.elf-*.su"))
    assert "board_poll" in usage
    assert "dynamic" not in usage


def branches(folder):
    """Return of each branch of the core how often it was taken: `file:line:number` -> count."""
    taken = {}
    for name in SAFETY:
        note = f"bench.so-{name.removesuffix('.c')}.gcda"
        command = ["gcov", "--json-format", "--stdout", "--branch-probabilities", note]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
        for file in json.loads(done.stdout)["files"]:
            for line in file["lines"] if file["file"].endswith(name) else ():
                counts = [line["count"], *(one["count"] for one in line["branches"])]
                for k, count in enumerate(counts):
                    taken[f"{name}:{line['line_number']}:{k}"] = count
    return taken


@pytest.mark.long("journey")
def test_every_branch_of_the_core_is_taken_by_its_tests(tmp_path):
    need("gcov")
    given, taken = [], {}
    for device in ("icube", "tensegrity"):
        make("bench", device, f"OUT={tmp_path / device}", "MORE=--coverage -O0")
        given.append(f"{device}={tmp_path / device / 'bench.so'}")
    tests = ROOT / "tests" / "firmware" / "test_firmware_core.py"
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tests)],
        cwd=ROOT, env=os.environ | {"ACUS_FIRMWARE_BENCH": os.pathsep.join(given)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:]
    for device in ("icube", "tensegrity"):
        for place, count in branches(tmp_path / device).items():
            taken[place] = taken.get(place, 0) + count
    missed = {place for place, count in taken.items() if not count}
    print(f"{len(taken) - len(missed)} of {len(taken)} lines and branches")
    assert len(taken) > 300
    assert missed == set(UNCOVERED), sorted(missed)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("device", ["icube", "tensegrity"])
def test_no_script_of_bytes_times_and_faults_breaks_what_must_hold(device):
    make("seeds", device, f"OUT={OUT / device}", "SEEDS=60000")


def test_the_models_table_is_the_programs():
    assert TABLE.read_text(encoding="utf-8") == table(Bench())


@pytest.mark.long("journey")
def test_the_model_holds_in_every_order_of_messages_ticks_and_faults():
    need("spin")
    said = make("model", "icube", f"OUT={OUT / 'icube'}")
    for what in ("fresh", "safe", "kept", "held", "greeting", "ends"):
        assert f"{what} holds" in said


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("line", "wrong"),
    [
        ("s == ENABLED && e == LATE -> s = IDLE", "s == ENABLED && e == LATE -> s = ENABLED"),
        ("s == ENABLED && e == BROKEN -> s = FAULT", "s == ENABLED && e == BROKEN -> s = IDLE"),
        ("s == FAULT && e == ESTRANGED -> s = BOOT", "s == FAULT && e == ENABLE -> s = ENABLED"),
        ("s == BOOT && e == GREETED -> s = IDLE", "s == BOOT && e == ENABLE -> s = ENABLED"),
        ("s == FAULT && e == GREETED -> s = IDLE", "s == FAULT && e == HOMED -> s = IDLE"),
    ],
)
def test_a_wrong_table_does_not_pass_the_model(tmp_path, line, wrong):
    need("spin")
    model = tmp_path / "model"
    model.mkdir()
    text = TABLE.read_text(encoding="utf-8")
    assert text.count(line) == 1
    (model / "table.pml").write_text(text.replace(line, wrong))
    (model / "board.pml").write_text((FIRMWARE / "model" / "board.pml").read_text())
    command = ["make", "-C", str(FIRMWARE), "model", f"OUT={tmp_path / 'out'}", f"MODEL={model}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0, done.stdout


@pytest.mark.long("journey")
def test_all_programs_are_built_without_a_warning():
    need("arm-none-eabi-gcc")
    for target in ("host", "bench", "stm32f405", "qemu"):
        assert built(target).exists()


def test_every_line_of_the_table_of_failures_names_faults_and_a_test_that_exist():
    page = (ROOT / "docs" / "firmware.md").read_text(encoding="utf-8")
    rows = re.search(r"## What fails.*?\n\n", page + "\n\n", re.DOTALL)[0].splitlines()[3:-1]
    tests = "".join(
        file.read_text(encoding="utf-8") for file in (ROOT / "tests" / "firmware").glob("test_*.py")
    )
    assert len(rows) == 9
    for row in rows:
        *_, faults, test = (cell.strip() for cell in row.strip("| ").split("|"))
        for name in re.findall(r"`([A-Z_]+)`", faults):
            assert name in Fault.__members__, name
        assert faults == "none" or "`" in faults
        assert f"def {test.strip('`')}(" in tests, test
