"""Deterministic replay of whole attempts: virtual and real time, and records that are not right."""

import json
import struct
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from mcap.writer import Writer
from typer.testing import CliRunner

from app.commands import build as command_line
from app.compose.cameras import AttachedCameras
from app.compose.recomputed import replay_recording
from app.compose.trainer import TrainerSetup, _context, build_loop, device_of
from app.core import state_vector as sv
from app.core.build import BUILD
from app.core.clock import Clock, SystemClock, VirtualClock
from app.core.paths import resources
from app.exercises.library import library
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.ct_facts import CtFacts
from app.session.errors import ReplayError, SessionError
from app.session.recording import Recording, read_recording
from app.session.replay import contents
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import load_rig
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")


def attempt(
    folder: Path,
    clock: Clock,
    seconds: float,
    exercise: str = "thick-tissue",
    skill: Any = None,
    tell: Callable[[Trainer, float], None] = lambda trainer, elapsed: None,
) -> Recording:
    """An attempt on the composed loop with guidance, the depth measured without cameras.

    `tell` is called every 20 ms with the trainer and the time since the beginning.
    """
    chosen = layered(exercise)
    profile = device_of(chosen)
    placed = placed_plan_of(chosen, profile, PLAN)
    setup = TrainerSetup(chosen, placed, CtFacts("ct-1"), skill, 3, folder, clock)
    loop = build_loop(setup, profile)

    def measure(now: float) -> None:
        state = loop.latest()
        tip = profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    context = _context(setup, profile, AttachedCameras((), load_rig(chosen.rig), {}), None)
    trainer = Trainer(loop, None, placed, chosen, context, clock, measure, dial=0.7)
    virtual = isinstance(clock, VirtualClock)
    loop.open() if virtual else trainer.open()
    end = time.monotonic() + 60.0
    while not virtual and loop.latest().tick == 0 and time.monotonic() < end:
        time.sleep(0.01)
    trainer.heartbeat()
    trainer.step(300) if virtual else time.sleep(0.2)
    trainer.begin("tester")
    for k in range(round(seconds / 0.02)):
        if skill is None:
            trainer.hand(0.1 * np.sin(0.05 * k), 0.05, 0.0004 * k)
        tell(trainer, 0.02 * k)
        if virtual:
            trainer.step()
        else:
            trainer.heartbeat()
            measure(clock.now())
            time.sleep(0.02)
    result = trainer.end()
    trainer.close()
    loop.close()
    assert result.record is not None
    return read_recording(result.record)


@pytest.fixture(scope="module")
def virtual(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    folder = tmp_path_factory.mktemp("virtual")
    return attempt(folder, VirtualClock(100.0), 12.0, skill="novice")


def spoilt(recording: Recording, **changes: Any) -> Recording:
    return replace(recording, inputs=replace(recording.inputs, **changes))


def with_value(recording: Recording, tick: int, name: str, value: float) -> Recording:
    values = recording.inputs.values.copy()
    row = int(np.flatnonzero(recording.inputs.column("tick") == tick)[0])
    values[row, recording.inputs.columns.index(name)] = value
    return spoilt(recording, values=values)


def other_build(recording: Recording, **values: str) -> Recording:
    known = recording.metadata
    changed = dict(known) | {BUILD: known[BUILD] | values}
    return replace(recording, metadata=MappingProxyType(changed))


@pytest.mark.promise("docs/sessions.md: On the same build it never differs")
def test_a_whole_scripted_attempt_is_recomputed_to_the_last_bit(virtual: Recording) -> None:
    report = replay_recording(virtual)
    assert report.identical
    assert report.every_slot
    assert report.same_build
    assert report.ticks == 12_000
    assert report.sentences() == ["identical over 12000 ticks (12.0 s)"]
    assert np.abs(virtual.inputs.column("torque_left")).max() > 0.0, "forces acted"
    acts = np.isnan(virtual.inputs.column("hand_x"))
    assert acts.mean() > 0.9, "the trainee's hand is recomputed, not recorded"


@pytest.mark.parametrize("exercise", [exercise.id for exercise in library()])
def test_a_hand_led_attempt_at_any_exercise_is_recomputed_to_the_last_bit(
    tmp_path: Path, exercise: str
) -> None:
    recording = attempt(tmp_path, VirtualClock(50.0), 3.0, exercise)
    assert not np.isnan(recording.inputs.column("hand_x")).any()
    assert replay_recording(recording).identical


@pytest.mark.long("journey")
def test_a_breath_held_on_command_is_told_recorded_and_recomputed(tmp_path: Path) -> None:
    seen: dict[float, Any] = {}

    def tell(trainer: Trainer, elapsed: float) -> None:
        wishes = {1.0: True, 32.0: False, 33.0: True, 42.0: False}
        if round(elapsed, 2) in wishes:
            trainer.hold_breath(wishes[round(elapsed, 2)])
        seen[round(elapsed, 2)] = trainer.snapshot().breath

    recording = attempt(tmp_path, VirtualClock(50.0), 43.0, "hold-the-breath", tell=tell)
    assert not seen[0.5].asked
    assert seen[1.5].asked
    assert not seen[1.5].held  # he breathes out first
    assert seen[8.0].held
    assert seen[8.0].left - seen[12.0].left == pytest.approx(4.0, abs=0.05)
    assert seen[30.0].spent  # asked, and not able to any longer
    assert seen[40.0].held
    assert not seen[42.9].asked
    told = [event.message.split(",")[0] for event in recording.events if event.kind == "breath"]
    hold = ["the patient is told to hold", "the patient holds the breath"]
    may = "the patient may breathe"
    assert told == [
        *hold,
        "the patient could hold no longer and breathes: release him",
        may,
        *hold,
        may,
    ]
    left = [seen[time].left for time in sorted(seen) if seen[time].held]
    assert left[0] == pytest.approx(19.0, abs=0.3)
    assert min(left) < 0.2
    shift = recording.samples.target - recording.samples.target[0]
    assert np.linalg.norm(shift, axis=1).max() > 0.011
    report = replay_recording(recording)
    assert report.identical
    assert report.every_slot


def test_a_bevelled_needle_that_is_turned_is_recorded_and_recomputed(tmp_path: Path) -> None:
    text = (resources() / "exercises" / "thick-tissue.yaml").read_text(encoding="utf-8")
    file = tmp_path / "bevelled.yaml"
    effects = "needle: {gauge: 20}\neffects:\n  bevel: {model: drifting}"
    file.write_text(text.replace("effects:", effects, 1), encoding="utf-8")
    rolls = []

    def tell(trainer: Trainer, elapsed: float) -> None:
        if elapsed > 2.0:
            trainer.roll(0.02)
        rolls.append(trainer.snapshot().roll)

    recording = attempt(tmp_path, VirtualClock(50.0), 5.0, str(file), tell=tell)
    roll = recording.inputs.column("needle_roll")
    assert rolls[0] == roll[0] == 0.0
    assert roll[-1] == pytest.approx(0.02 * 149)
    assert rolls[-1] == pytest.approx(roll[-1], abs=0.021)  # the snapshot of the tick before
    assert recording.samples.bend is not None
    offset = np.linalg.norm(recording.samples.bend[-1, :3])
    assert offset > 1e-4
    report = replay_recording(recording)
    assert report.identical
    assert report.every_slot


def test_only_a_patient_who_holds_on_command_can_be_told_to(tmp_path: Path) -> None:
    def tell(trainer: Trainer, _: float) -> None:
        assert trainer.snapshot().breath is None
        with pytest.raises(SessionError, match="does not hold the breath on command"):
            trainer.hold_breath(True)

    attempt(tmp_path, VirtualClock(50.0), 0.04, "breathing-liver", tell=tell)


@pytest.mark.long("journey")
def test_an_attempt_in_real_time_is_recomputed_to_the_last_bit(tmp_path: Path) -> None:
    recording = attempt(tmp_path, SystemClock(), 1.5)
    report = replay_recording(recording)
    assert report.identical, report.sentences()
    assert report.ticks > 700
    assert recording.inputs.column("lateness").max() > 0.0
    assert np.abs(recording.inputs.column("torque_left")).max() > 0.0


def test_a_changed_torque_is_found_at_its_tick_and_slot(virtual: Recording) -> None:
    before = virtual.inputs.column("torque_left")[4321 - 301]
    spoilt_one = with_value(virtual, 4321, "torque_left", np.nextafter(before, 1.0))
    found = replay_recording(spoilt_one).first_difference
    assert found is not None
    assert (found.tick, found.slot, found.seen_at) == (4321, "torque_left", 4321)
    assert found.recorded == np.nextafter(before, 1.0)
    assert found.recomputed == before
    assert found.time == pytest.approx(100.0 + 4.321)


def test_a_changed_input_is_found_at_its_tick(virtual: Recording) -> None:
    report = replay_recording(with_value(virtual, 5000, "path_x", 0.01))
    assert report.first_difference is not None
    assert report.first_difference.tick == 5000
    assert report.first_difference.slot
    assert not report.identical
    assert "differs from tick 5000 on" in report.sentences()[0]


def test_a_changed_bit_of_any_computed_slot_is_found_by_the_digest(virtual: Recording) -> None:
    digests = virtual.inputs.digests.copy()
    digests[777] ^= 1
    found = replay_recording(spoilt(virtual, digests=digests)).first_difference
    assert found is not None
    assert (found.tick, found.slot) == (301 + 777, "")
    assert (
        "not recorded in every tick"
        in replay_recording(spoilt(virtual, digests=digests)).sentences()[0]
    )


def test_a_changed_memory_of_a_stage_is_found(virtual: Recording) -> None:
    recorded = virtual.inputs.checkpoint
    assert recorded is not None
    start = sum(recorded.checkpoint.sizes[: recorded.checkpoint.names.index("kinematics")])
    values = recorded.checkpoint.parameters.copy()
    values[start + 1] *= 1.5  # y of the remote centre
    changed = replace(recorded, checkpoint=replace(recorded.checkpoint, parameters=values))
    report = replay_recording(spoilt(virtual, checkpoint=changed))
    assert not report.identical
    assert report.largest_difference is not None
    assert report.largest_difference.size > 0.0


def test_another_build_that_gives_the_same_is_said_to_be_another(virtual: Recording) -> None:
    report = replay_recording(other_build(virtual, numba="0.1", cpu="zx81"))
    assert report.identical
    assert not report.same_build
    assert any("numba: 0.1, now" in line for line in report.sentences())
    assert not any("expected" in line for line in report.sentences())


def test_a_difference_of_another_build_is_said_to_be_expected_and_how_large(
    virtual: Recording,
) -> None:
    changed = with_value(other_build(virtual, cpu="zx81"), 900, "torque_left", 1e-12)
    text = " ".join(replay_recording(changed).sentences())
    assert "differs from tick 900" in text
    assert "differences in the last digits are expected" in text
    assert "by 1e-12" in text or "by " in text


def test_a_gap_ends_the_replay_and_is_said(virtual: Recording) -> None:
    inputs = virtual.inputs
    keep = np.ones(len(inputs.values), dtype=bool)
    keep[2000:2050] = False
    before = inputs.state_rows < 2000
    cut = spoilt(
        virtual,
        values=inputs.values[keep],
        digests=inputs.digests[keep],
        state_rows=inputs.state_rows[before],
        states=inputs.states[before],
    )
    report = replay_recording(cut)
    assert (report.identical, report.ticks) == (True, 2000)
    assert report.gaps == ((2301, 50),)
    text = " ".join(report.sentences())
    assert "50 ticks from tick 2301 on are not in the record" in text
    assert "9950 recorded ticks were not recomputed" in text


def test_a_record_without_checkpoint_cannot_be_replayed_and_says_so(virtual: Recording) -> None:
    old = spoilt(virtual, checkpoint=None)
    with pytest.raises(ReplayError, match="no checkpoint"):
        replay_recording(old)
    assert "no checkpoint" in contents(old).why_not


def test_ticks_missing_at_the_beginning_cannot_be_replayed(virtual: Recording) -> None:
    inputs = virtual.inputs
    cut = spoilt(virtual, values=inputs.values[100:], digests=inputs.digests[100:])
    with pytest.raises(ReplayError, match="ticks 301 to 400 are missing"):
        replay_recording(cut)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda r: replace(r, attachments=MappingProxyType({})), "has no exercise.json"),
        (
            lambda r: replace(
                r, attachments=MappingProxyType(dict(r.attachments) | {"device.json": b"{"})
            ),
            "device.json is damaged",
        ),
    ],
)
def test_what_the_table_cannot_be_built_from_is_named(
    virtual: Recording, change: Callable[[Recording], Recording], said: str
) -> None:
    with pytest.raises(ReplayError, match=said):
        replay_recording(change(virtual))


def test_a_record_whose_ct_was_in_a_folder_can_be_replayed(virtual: Recording) -> None:
    exercise = json.loads(virtual.attachments["exercise.json"])
    exercise["ct"] = {"phantom": None, "folder": None, "series": None}
    exercise["plan"] = {"entry_mm": [0, -90, 300], "target_mm": [5, -20, 300]}
    files = dict(virtual.attachments) | {"exercise.json": json.dumps(exercise).encode()}
    own = replace(virtual, attachments=MappingProxyType(files))
    assert replay_recording(own).first_difference is None


def test_the_record_says_what_can_be_replayed(virtual: Recording) -> None:
    held = contents(virtual)
    assert held.why_not == ""
    assert held.ticks == 12_000
    assert held.rate_hz == pytest.approx(1000.0)
    assert list(held.stages)[:2] == ["trainee", "encoders"]
    assert "heartbeat" in held.changing
    assert {"kernels", "numba", "numpy", "python", "llvmlite", "cpu"} <= held.build.keys()


def test_the_command_says_identical_and_leaves_with_zero_or_three(
    virtual: Recording, tmp_path: Path
) -> None:
    runner, folder = CliRunner(), str(virtual.path.parent)
    shown = runner.invoke(command_line(), ["session", "replay", virtual.id, "--folder", folder])
    assert shown.exit_code == 0
    assert "can be replayed" in shown.output
    ask = ["session", "replay", virtual.id, "--check", "--folder"]
    checked = runner.invoke(command_line(), [*ask, folder])
    assert checked.exit_code == 0
    assert "identical over 12000 ticks" in checked.output
    rewritten(virtual.path, tmp_path / virtual.path.name)
    wrong = runner.invoke(command_line(), [*ask, str(tmp_path), "--json"])
    assert wrong.exit_code == 3
    found = json.loads(wrong.output)["facts"]
    assert not found["identical"]
    assert found["first_difference"]["tick"] == 301


def rewritten(path: Path, to: Path) -> None:
    """Copy a record with the state of its checkpoint changed by one thousandth."""
    from app.session.scan import scan

    content = scan(path)
    (data,) = content.messages["/loop/checkpoint"]
    length = struct.unpack_from("<4sHI", data)[2]
    numbers = np.frombuffer(data[10 + length :], dtype="<f8").copy()
    numbers[sv.PLANT_Q_LEFT] *= 1.001
    with to.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        for name, values in content.metadata.items():
            writer.add_metadata(name, values)
        for name, blob in content.attachments.items():
            writer.add_attachment(0, 0, name, "application/json", blob)
        for topic, messages in content.messages.items():
            channel = writer.register_channel(topic, "x", 0, content.channels[topic])
            for message in messages:
                changed = data[: 10 + length] + numbers.tobytes()
                body = changed if topic == "/loop/checkpoint" else message
                writer.add_message(channel, 1, body, 1)
        writer.finish()
