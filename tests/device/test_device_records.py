"""Records of devices, and the clearance that follows from them."""

from datetime import UTC, datetime

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.device.commissioning.force_scale import fit, fit_gauge, refusal
from app.device.commissioning.pulses import dead_time
from app.device.commissioning.records import (
    DeviceRecord,
    device_key,
    load_record,
    records_folder,
    save_record,
)
from app.device.commissioning.results import ForceScale, Gauge, Homing, RoutineName, Signs
from app.device.errors import CommissioningError, RecordError
from app.device.links.link import BoardInfo
from app.device.readiness import Readiness
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
INFO = BoardInfo("icube", "A-001", "1.0", "acus 1", boot=7)
DATE = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
HOMING = Homing(offsets=(0.1, -0.2), change=(0.1, -0.2))
SIGNS = Signs(response=((1.0, 0.0), (0.0, 1.0)), by_hand=True)
SCALE = ForceScale(
    commanded=(0.2, 0.5, 1.0),
    readings_g=(20.4, 51.0, 102.0),
    factor=1.0003,
    residual=0.001,
    profile="icube",
)


def record(*results, boot=7):
    full = DeviceRecord(device="A-001")
    for result in results:
        full = full.added(result, boot, DATE)
    return full


def test_a_record_comes_back_from_its_file_as_it_was(tmp_path):
    gauge = Gauge(zero=0.1, scale=1.2, residual=0.01, weights_g=(0.0, 100.0))
    full = record(HOMING, SIGNS, SCALE, gauge)
    save_record(full, tmp_path)
    assert load_record(INFO, tmp_path) == full


def test_a_device_without_a_file_has_an_empty_record(tmp_path):
    assert load_record(INFO, tmp_path).entries == ()


def test_records_lie_in_the_users_data_folder(monkeypatch, tmp_path):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    assert records_folder() == tmp_path / "devices"
    save_record(record(HOMING))
    assert (tmp_path / "devices" / "A-001.yaml").is_file()


@pytest.mark.parametrize(
    "text", ["", "[1, 2", "version: 2\ndevice: A-001\n", "device: A-001\nentries: [{date: x}]\n"]
)
def test_a_damaged_record_is_named_and_left_alone(tmp_path, text):
    path = tmp_path / "A-001.yaml"
    path.write_text(text)
    with pytest.raises(RecordError, match=r"damaged.*A-001"):
        load_record(INFO, tmp_path)
    assert path.read_text() == text


def test_a_record_of_another_device_is_refused(tmp_path):
    save_record(record(HOMING), tmp_path)
    (tmp_path / "A-001.yaml").rename(tmp_path / "B-002.yaml")
    with pytest.raises(RecordError, match="belongs to device 'A-001'"):
        load_record(BoardInfo("icube", "B-002", "1", "acus 1", 1), tmp_path)


@pytest.mark.parametrize("serial", ["../evil", "a/b", ".hidden", "x" * 65, "é"])
def test_a_serial_number_that_is_no_plain_name_is_refused(serial):
    with pytest.raises(RecordError, match="serial number"):
        device_key(BoardInfo("icube", serial, "1", "acus 1", 1))


def test_a_device_without_serial_number_is_kept_by_its_profile():
    assert device_key(BoardInfo("haply-2diy", "", "1", "haply", 1)) == "unnumbered-haply-2diy"


def test_a_folder_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordError, match="ACUS_DATA"):
        save_record(record(HOMING), tmp_path / "file")


def test_undo_takes_the_last_result_back_and_keeps_it_in_the_history():
    better = HOMING.model_copy(update={"offsets": (0.3, 0.3)})
    full = record(HOMING, better)
    assert full.offsets(7) == (0.3, 0.3)
    back = full.undo()
    assert back.offsets(7) == (0.1, -0.2)
    assert len(back.entries) == 2
    with pytest.raises(RecordError, match="undone"):
        back.undo().undo()


def test_undo_can_be_limited_to_a_routine():
    assert record(SCALE, HOMING).undo(RoutineName.FORCE).newest(RoutineName.HOMING) is not None
    assert record(SCALE, HOMING).undo(RoutineName.FORCE).newest(RoutineName.FORCE) is None


def test_offsets_count_in_their_own_power_cycle_only():
    assert record(HOMING).offsets(8) == (0.0, 0.0)


def clearance(*results, boot=7, info=INFO, profile=PROFILE):
    return record(*results, boot=boot).readiness().clearance(info, profile)


def test_clearance_grows_with_each_routine():
    assert clearance().homed == 0.0
    assert clearance(HOMING).homed == 0.0
    assert "--step signs" in clearance(HOMING).reason
    assert clearance(HOMING, SIGNS).inputs() == {"homed": 1.0, "force_cap": 1.0}
    assert "--step force" in clearance(HOMING, SIGNS).reason
    full = clearance(HOMING, SIGNS, SCALE)
    assert (full.homed, full.force_cap, full.reason, full.full) == (1.0, 5.0, "", True)


def test_the_force_scale_outlives_the_power_cycle_and_homing_does_not():
    info = BoardInfo("icube", "A-001", "1.0", "acus 1", boot=8)
    assert clearance(HOMING, SIGNS, SCALE, info=info).homed == 0.0
    assert record(SCALE).readiness().force_factor == SCALE.factor


def test_a_sign_check_by_pulses_needs_homing_against_the_stops():
    pulses = SIGNS.model_copy(update={"by_hand": False})
    jig = Homing(step=RoutineName.OFFSETS, reference="jig", offsets=(0.0, 0.0), change=(0.0, 0.0))
    assert clearance(HOMING, pulses).homed == 1.0
    assert clearance(jig, SIGNS).homed == 1.0
    assert clearance(jig, pulses).homed == 0.0
    assert "directions" in clearance(jig, pulses).reason


def test_a_scale_of_another_profile_or_out_of_tolerance_keeps_the_cap():
    other = SCALE.model_copy(update={"profile": "haply-2diy"})
    assert "haply-2diy" in clearance(HOMING, SIGNS, other).reason
    off = SCALE.model_copy(update={"factor": 1.2})
    assert clearance(HOMING, SIGNS, off).force_cap == 1.0


@pytest.mark.promise(
    "docs/hardware.md: A board that does not number its power cycles is never taken as "
    "homed from its record"
)
def test_a_board_that_does_not_number_its_power_cycles_is_never_homed_by_its_record():
    info = BoardInfo("haply-2diy", "", "1", "haply", boot=0)
    readiness = Readiness(homed_boot=0, signs_boot=0, force_factor=1.0)
    assert readiness.clearance(info, PROFILE).homed == 0.0


def test_a_simulated_board_is_cleared_for_everything():
    info = BoardInfo("icube", "s", "1", "memory", 1, simulated=True)
    assert Readiness().clearance(info, PROFILE).full


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (10.0, "missing"),
        (8.2, "missing"),
        (0.1, "applied twice"),
        (-1.0, "sign"),
        (-10.0, "sign"),
        (0.01, "does not feel"),
        (0.7, "torque constant"),
        (1.11, "torque constant"),
    ],
)
def test_a_wrong_force_scale_is_refused_with_the_likely_reason(factor, words):
    assert words in refusal(factor, 0.0, 10.0)


def test_a_right_force_scale_is_refused_only_if_it_scatters():
    assert refusal(1.09, 0.01, 10.0) == ""
    assert refusal(0.91, 0.01, 1.0) == ""
    assert "scatter" in refusal(1.0, 0.2, 10.0)


@given(st.floats(0.05, 20.0))
def test_the_slope_through_zero_finds_the_factor(factor):
    forces = (0.2, 0.5, 1.0)
    found, residual = fit(forces, [1000.0 * factor * f / 9.80665 for f in forces])
    assert found == pytest.approx(factor, rel=1e-12)
    assert residual < 1e-12 * 20


@pytest.mark.parametrize("readings", [[], [1.0], [1.0, float("nan"), 2.0], [float("inf")] * 3])
def test_readings_that_are_missing_or_no_numbers_are_refused(readings):
    with pytest.raises(CommissioningError, match="Force scale"):
        fit((0.2, 0.5, 1.0), readings)


@pytest.mark.parametrize(
    ("weights", "readings"),
    [
        ([], []),
        ([0.0, 100.0], [0.0]),
        ([100.0, 100.0], [1.0, 1.0]),
        ([0.0, 100.0], [0.0, float("nan")]),
        ([0.0, 100.0], [0.0, -1.0]),
        ([0.0, 100.0], [0.0, 0.0]),
        ([0.0, 100.0, 200.0], [0.0, 3.0, 2.0]),
    ],
)
def test_a_gauge_that_cannot_be_calibrated_is_refused(weights, readings):
    with pytest.raises(CommissioningError, match="Gauge calibration"):
        fit_gauge(weights, readings)


@pytest.mark.parametrize("delay", [0.0, 0.004, 0.015])
def test_the_dead_time_comes_out_of_a_rounded_parabola(delay):
    time, count = np.arange(0.0, 0.1, 1e-3), 3.14e-4
    after = np.clip(time - 0.02 - delay, 0.0, None)
    angle = np.round(0.5 * 10.0 * after**2 / count) * count
    torque = np.where(time >= 0.02 - 1e-9, 0.02, 0.0)
    assert dead_time(time, torque, angle, count) == pytest.approx(delay, abs=6e-4)


def test_a_dead_time_without_motion_is_refused():
    with pytest.raises(CommissioningError, match="Latency"):
        dead_time(np.arange(10.0), np.ones(10), np.zeros(10), 1e-3)
