"""An exercise as an environment of Gymnasium (extra `env`): a hand inserts a needle, step by step.

    import acus.env

    env = acus.env.Insertion("first-insertion", action="velocity")
    seen, _ = env.reset(seed=1)
    seen, reward, ended, cut_off, info = env.step(env.action_space.sample())

Robot, laws, tissue, cameras and scoring are the program's own, in virtual time, as in
`acus.try_exercise`; a step is 20 ms. `acus.env.Insertion` and its arguments are promised, the
numbers that it gives may change with the exercise's version and the scoring's.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from acus._program import load_program

load_program()

from app.core.extras import not_installed  # noqa: E402
from app.core.messages import sentence  # noqa: E402
from app.exercises.errors import ExerciseError  # noqa: E402
from app.exercises.library import load_exercise  # noqa: E402
from app.exercises.schema import Exercise  # noqa: E402

try:
    import gymnasium
except ImportError as error:
    raise not_installed(ImportError, "gymnasium, which acus.env needs,", "env") from error

if TYPE_CHECKING:
    from app.compose.stepped_loop import SteppedLoop

__all__ = ["ACTIONS", "OBSERVED", "REWARDS", "Insertion"]

ACTIONS: Final = ("velocity", "force")
REWARDS: Final = ("score", "score+distance")
OBSERVED: Final = (
    *("axis_x", "axis_y", "depth_m", "depth_measured"),
    *("to_target_x_m", "to_target_y_m", "to_target_z_m"),
    *("force_x_N", "force_y_N", "force_z_N", "elapsed"),
)
"""What each number of an observation is, in the robot's frame (`world`)."""

STEP_S: Final = 0.020
ACROSS_M_S: Final = 0.05
ALONG_M_S: Final = 0.02
ACROSS_N: Final = 3.0
ALONG_N: Final = 10.0
"""What 1 of an action is: the hub's speed across the needle, and along it; the same of forces."""

ENDS: Final = 0.9
"""The fourth number of an action above this ends the attempt."""

_TILTED: Final = 0.15
_BOUNDS: Final = (1.0, 1.0, 0.3, 1.0, 0.5, 0.5, 0.5, 30.0, 30.0, 30.0, 1.0)


class Insertion(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """One exercise. Each episode is one attempt, from the needle above the skin to its end.

    An action is four numbers within -1 and 1: across the needle along the robot's x and y, along
    it (positive inwards), and whether the attempt is ended (above 0.9). With `velocity` the first
    three move the hand's wish, with `force` they are what the hand presses with at most: what
    resists with more stands, what resists with less yields at the hand's own speed. The observation
    is `OBSERVED`: what a student could know, so depth and error as the cameras measure them, late
    and with their noise, and the force that is felt.

    The reward is the score of the attempt when it ends, of 100 as 1, and 0 before; an attempt that
    cannot be scored gives 0, and `info["unscored"]` is true. With `score+distance` each step adds
    what it brought the true tip nearer to the target, as a share of the way from entry to target:
    a shaping by a potential, which changes no optimal policy but by where an episode ends.

    Args:
        exercise: its id, file or itself.
        action: one of `ACTIONS`.
        reward: one of `REWARDS`.
        seconds: after which an attempt is cut off, and scored as it stands; None for the time at
            which the exercise gives no points for time any more, else 300 s.
        tilted: how far the needle leans at the beginning at most: sine of its tilt, drawn anew at
            each reset from the seed.

    Raises:
        AcusError: if the exercise or a name cannot be used; says what can.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 - as Gymnasium has it
        "render_modes": [],
        "render_fps": 50,
    }

    def __init__(
        self,
        exercise: Exercise | str | Path = "first-insertion",
        *,
        action: str = "velocity",
        reward: str = "score",
        seconds: float | None = None,
        tilted: float = _TILTED,
    ) -> None:
        for given, known in ((action, ACTIONS), (reward, REWARDS)):
            if given not in known:
                raise ExerciseError(
                    sentence(
                        "{given!r} is no choice here: {known}", given=given, known=", ".join(known)
                    )
                )
        from app.compose.skill_scores import Resolved, risks_of
        from app.compose.trial import Trials

        on = Resolved.of(exercise if isinstance(exercise, Exercise) else load_exercise(exercise))
        self.exercise, self._placed = on.exercise, on.placed
        self._trials = Trials(on.exercise, on.placed, risks_of(on.exercise), on.tissues)
        self._force, self._shaped = action == "force", reward == "score+distance"
        self._limit = round((_slowest(on.exercise) if seconds is None else seconds) / STEP_S)
        self._tilted = tilted
        self._loop: SteppedLoop | None = None
        self._length = on.placed.length
        self._high = high = np.array(_BOUNDS, np.float32)
        self.observation_space = gymnasium.spaces.Box(-high, high, dtype=np.float32)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (4,), np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an attempt; the same for one seed, which is of the start and the cameras' noise."""
        from app.compose.stepped_loop import WAITS

        super().reset(seed=seed)
        self.close()
        lean, around = (
            self.np_random.uniform(0.0, self._tilted),
            self.np_random.uniform(0.0, 6.2832),
        )
        x, y = lean * np.cos(around), lean * np.sin(around)
        axis = np.array([x, y, -np.sqrt(1.0 - lean * lean)])
        noise = int(self.np_random.integers(1, 2**31))
        self._loop = self._trials.stepped(None, noise, self.exercise.assistance, axis)
        self._wish = float(x), float(y), WAITS
        seen = self._seen()
        self._left = self._distance()
        return seen, {}

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Let the hand act for 20 ms.

        Raises:
            gymnasium.error.ResetNeeded: if no attempt is running.
        """
        loop = self._loop
        if loop is None:
            raise gymnasium.error.ResetNeeded("no attempt is running: call reset() first")
        across_x, across_y, along, ends = (min(max(float(part), -1.0), 1.0) for part in action)
        self._act(across_x, across_y, along)
        loop.step()
        seen, reward = self._seen(), 0.0
        if self._shaped:
            before, self._left = self._left, self._distance()
            reward = before - self._left
        ended, cut_off = ends > ENDS, len(loop.rows) >= self._limit
        info: dict[str, Any] = {}
        if ended or cut_off:
            trial = self._trials.judged(loop)
            score = None if trial is None else trial.score
            total = None if score is None else score.total
            reward += 0.0 if total is None else total / 100.0
            info = {
                "unscored": total is None,
                "score": total,
                "seconds": loop.now - loop.begin,
                "passed": bool(score is not None and score.passed),
            }
            self.close()
        return seen, float(reward), ended, cut_off and not ended, info

    def close(self) -> None:
        """End the attempt that runs, if one does; idempotent."""
        if self._loop is not None:
            self._loop.close()
            self._loop = None

    # --- inside -----------------------------------------------------------------------------------
    def _act(self, across_x: float, across_y: float, along: float) -> None:
        loop = self._loop
        assert loop is not None  # noqa: S101 - step has looked
        if self._force:
            wish = loop.pressing(ACROSS_N * across_x, ACROSS_N * across_y, ALONG_N * along)
        else:
            (x, y, depth), turn = self._wish, ACROSS_M_S * STEP_S / loop.lever
            wish = x + turn * across_x, y + turn * across_y, depth + ALONG_M_S * STEP_S * along
            wish = self._wish = loop.within_reach(*wish)
        loop.hand(*wish)

    def _distance(self) -> float:
        """Return how far the true tip is from the target, of the way from entry to target."""
        return float(np.linalg.norm(self._known.true_tip - self._placed.p_target)) / self._length

    def _seen(self) -> NDArray[np.float32]:
        loop = self._loop
        assert loop is not None  # noqa: S101 - it runs
        self._known = known = loop.seen()
        x, y, _ = known.axis.tolist()
        seen = np.array(
            (
                *(x, y, known.depth, float(known.measured)),
                *(self._placed.p_target - known.tip).tolist(),
                *loop.felt.tolist(),
                len(loop.rows) / self._limit,
            ),
            np.float32,
        )
        bounded: NDArray[np.float32] = np.minimum(np.maximum(seen, -self._high), self._high)
        return bounded


def _slowest(exercise: Exercise) -> float:
    """Return the time [s] from which an exercise gives no points for it."""
    limits = exercise.tolerances.get("total_time")
    return 300.0 if limits is None else float(limits.knots[-1])
