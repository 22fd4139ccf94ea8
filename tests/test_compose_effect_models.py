"""An effect is computed by another model while an attempt runs: at one tick, told, replayed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_replay import PLAN, attempt

from app.compose.recomputed import replay_recording
from app.compose.trainer import Rig, TrainerSetup, device_of
from app.core import state_vector as sv
from app.core.clock import SystemClock, VirtualClock
from app.core.errors import AcusError
from app.device.control import Loop, Table, machine_stages
from app.device.links.link import Link
from app.exercises.errors import ExerciseError
from app.exercises.locks import Lock
from app.exercises.parts import EffectPart
from app.exercises.scene import placed_plan_of
from app.exercises.schema import Purpose
from app.session.effect_models import choices_of
from app.session.errors import ControlLockedError
from app.session.recording import Recording
from app.session.trainer import Trainer
from app.session.verify import conditions
from app.simulation.errors import SimulationError
from app.views.reading.lock_words import why_locked
from tests.layered import layered


class Chooser:
    """Chooses models at given moments of an attempt."""

    def __init__(self, folder: Path, clock: Any, moments: dict[float, str]) -> None:
        chosen = layered("thick-tissue")
        effects = {**chosen.effects, "breathing": EffectPart(organ="lung")}  # of another organ
        chosen = chosen.model_copy(update={"effects": effects})
        profile = device_of(chosen)
        placed = placed_plan_of(chosen, profile, PLAN)
        self.setup = TrainerSetup(chosen, placed, seed=3, sessions=folder, clock=clock)
        self.profile, self.moments, self.rig = profile, dict(moments), None

    def __call__(self, trainer: Trainer, elapsed: float) -> None:
        """Choose what is due."""
        if self.rig is None:
            self.rig = Rig(self.setup, self.profile, trainer._loop, None, trainer)
        for moment in [m for m in self.moments if m <= elapsed + 1e-9]:
            self.rig = self.rig.compute_by("lateral_tissue", self.moments.pop(moment))


@pytest.fixture(scope="module")
def virtual(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    folder, clock = tmp_path_factory.mktemp("virtual"), VirtualClock(5.0)
    chooser = Chooser(folder, clock, {0.8: "winkler", 1.3: "beam"})
    return attempt(folder, clock, 2.0, tell=chooser)


def test_a_model_is_chosen_at_one_tick_told_and_replayed_bit_for_bit(virtual: Recording) -> None:
    first, second = choices_of(virtual.events)
    assert (first.model, second.model) == ("winkler", "beam")
    assert second.tick - first.tick == 500
    report = replay_recording(virtual)
    assert report.identical, report.sentences()
    assert report.every_slot
    assert report.ticks > 1900
    ticks = virtual.inputs.column("tick")
    assert (np.diff(ticks) == 1.0).all()


def test_a_score_made_under_a_chosen_model_says_so(virtual: Recording, tmp_path: Path) -> None:
    found = conditions(virtual, None)
    assert found.models == ("lateral_tissue: beam", "lateral_tissue: winkler")
    plain = conditions(attempt(tmp_path, VirtualClock(5.0), 0.5), None)
    assert plain.models == ()


def test_the_next_attempt_is_recorded_with_the_model_that_was_chosen(tmp_path: Path) -> None:
    clock = VirtualClock(5.0)
    chooser = Chooser(tmp_path, clock, {0.2: "winkler"})
    kept: list[Trainer] = []

    def tell(trainer: Trainer, elapsed: float) -> None:
        chooser(trainer, elapsed)
        kept.append(trainer)

    attempt(tmp_path, clock, 0.5, tell=tell)
    trainer = kept[-1]
    (said,) = (a for a in trainer._context.attachments if a.name == "exercise.json")
    assert b'"winkler"' in said.data
    assert trainer._exercise.effects["lateral_tissue"].model == "winkler"


@pytest.mark.long("machine")
def test_a_running_loop_goes_on_through_a_choice_in_real_time(tmp_path: Path) -> None:
    clock = SystemClock()
    recording = attempt(tmp_path, clock, 2.0, tell=Chooser(tmp_path, clock, {1.0: "winkler"}))
    report = replay_recording(recording)
    assert report.identical, report.sentences()
    assert not report.gaps
    (choice,) = choices_of(recording.events)
    ticks = recording.inputs.column("tick")
    near = np.abs(ticks - choice.tick) < 100
    assert recording.inputs.column("enabled")[near].all()


def test_an_assessment_and_a_locked_exercise_keep_their_models(tmp_path: Path) -> None:
    clock = VirtualClock(5.0)
    chooser, refused = Chooser(tmp_path, clock, {}), []

    def tell(trainer: Trainer, elapsed: float) -> None:
        if refused:
            return
        trainer._exercise = trainer._exercise.model_copy(update={"purpose": Purpose.ASSESSMENT})
        chooser(trainer, elapsed)
        before = trainer._loop.table
        with pytest.raises(ControlLockedError, match="keeps the models"):
            chooser.rig.compute_by("lateral_tissue", "winkler")
        refused.append(trainer._loop.table is before)

    recording = attempt(tmp_path, clock, 0.1, tell=tell)
    assert refused == [True]
    assert choices_of(recording.events) == ()


def test_what_cannot_be_chosen_is_named_and_nothing_changes(tmp_path: Path) -> None:
    clock, said = VirtualClock(5.0), []
    chooser = Chooser(tmp_path, clock, {})

    def tell(trainer: Trainer, elapsed: float) -> None:
        chooser(trainer, elapsed)
        for effect, model, kind in (
            ("lateral_tissue", "fem", SimulationError),
            ("breathing", "lujan", ExerciseError),
            ("tremor", "sine", ExerciseError),
        ):
            with pytest.raises(kind) as caught:
                chooser.rig.compute_by(effect, model)
            said.append(str(caught.value))

    attempt(tmp_path, clock, 0.02, tell=tell)
    assert "it has beam, winkler" in said[0]
    assert "effect breathing is not simulated in thick-tissue" in said[1]
    assert "has no effect 'tremor'; it has" in said[2]


def test_a_carry_that_fails_leaves_the_loop_as_it_was() -> None:
    chosen = layered("first-insertion")
    table = machine_stages(device_of(chosen), [], [], Link.of([], []))

    def fail() -> None:
        raise AcusError("no")

    for clock in (VirtualClock(1.0), SystemClock()):
        with Loop(table, 1000.0, clock) as loop:
            if isinstance(clock, VirtualClock):
                loop.step(5)
            with pytest.raises(AcusError, match="no"):
                loop.exchange(Table.of(table.compute), fail)
            assert loop.table is table
            first = loop.exchange(Table(table.compute, table.write))
            assert first >= 1
            assert loop.checkpoint().state.shape == (sv.SLOTS,)
        assert loop.rows()[-1, sv.TORQUE_LEFT] == 0.0


def test_every_lock_has_words() -> None:
    exercise = layered("scans-only")
    assert all(why_locked(exercise, lock) for lock in Lock)
