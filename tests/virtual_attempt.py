"""A whole attempt on a CT of a folder in virtual time, with its record, report and plan.

`python -m tests.virtual_attempt CT_FOLDER OUT`: what the window would leave behind, at the same
numbers on a busy machine as on a quiet one.
"""

import sys
from pathlib import Path

import numpy as np

from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exchange.markups import write_plan
from app.exercises.scene import placed_plan_of
from app.imaging.body import find_body
from app.imaging.reading import load_ct
from app.planning.paths import demonstration_plan
from app.session.ct_facts import CtFacts
from app.session.review import review_of_result
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.views.debrief.report import write_report
from app.views.shell.application import start
from tests.layered import layered

START, SECONDS, ARRIVED = 100.0, 60.0, 9.0


def attempt(ct: Path, sessions: Path):
    """Guided insertion by the scripted expert; returns its result and the plan."""
    volume = load_ct(ct)
    plan = demonstration_plan(volume, find_body(volume))
    exercise, clock = layered("first-insertion"), VirtualClock(START)
    exercise = exercise.model_copy(
        update={"ct": exercise.ct.model_copy(update={"phantom": None, "folder": ct})}
    )
    rig = build_rig(
        TrainerSetup(
            exercise, placed_plan_of(exercise, device_of(exercise), plan),
            ct=CtFacts.of_volume(volume), skill="expert", sessions=sessions, clock=clock,
        )
    )  # fmt: skip

    def measure(now: float) -> None:
        state = rig.loop.latest()
        tip = rig.profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    context = rig.trainer._context
    trainer = Trainer(rig.loop, None, rig.setup.placed, exercise, context, clock, measure)
    rig.loop.open()
    trainer.step()
    trainer.assistance(0.7)
    trainer.begin("tester")
    while clock.now() < START + SECONDS:
        if trainer.step().device.row[sv.TRAINEE_PHASE] == ARRIVED:
            break
    result = trainer.end()
    rig.loop.close()
    return result, plan


def main(ct: Path, out: Path) -> None:
    """Write `sessions/`, `report.pdf` and `plan.mrk.json`."""
    application = start(offscreen=True)
    result, plan = attempt(ct, out / "sessions")
    write_report(review_of_result(result), out / "report.pdf")
    write_plan(out / "plan.mrk.json", plan)
    print(f"score {result.score.total:.0f}")
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
