"""What a trainer would have made of the samples of an attempt that ran without one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.scoring.touches import Touches
from app.session import machine
from app.session.machine import AttemptEvent, State
from app.session.needle import DepthSource
from app.session.samples import Samples
from app.session.touching import Touching
from app.session.transitions import Classifier, classify


@dataclass(frozen=True, slots=True, eq=False)
class TrialCourse:
    """What a trainer would have made of the samples of an attempt, one after the other.

    Attributes:
        states: at each sample, shape (n,).
        unseen: longest time in the body without a depth [s].
        target: at each sample [m], shape (n, 3).
        touches: targets that were to be touched; None where there were none.
    """

    states: NDArray[np.str_]
    unseen: float
    target: FloatArray
    touches: Touches | None = None

    @classmethod
    def of(
        cls,
        samples: Samples,
        begin: float,
        touching: Touching | None = None,
        aside: FloatArray | None = None,
    ) -> TrialCourse:
        """Judge samples that are all taken for `aligning`, of an attempt from `begin` [s] on.

        `aside` is from the target of the samples to the one at hand [m], shape (n, 3).
        """
        attempt = machine.advance(machine.Attempt(), AttemptEvent.BEGIN, begin)
        memory = Classifier()
        seen = (samples.depth_source == DepthSource.TRACKED.value) & samples.valid
        shift = samples.target - samples.target[0] if touching else None
        target, depths, states = samples.target.copy(), samples.depth.tolist(), []
        since, unseen, times = begin, 0.0, []
        for k, time in enumerate(samples.time.tolist()):
            if touching is not None and shift is not None:
                target[k] = touching.state.aim.p_target + shift[k]
            depth = depths[k] if seen[k] else None
            there = target[k] if aside is None else target[k] + aside[k]
            away = float(np.linalg.norm(samples.tip[k] - there))
            memory, event = classify(memory, attempt.state, time, depth, away)
            if event is not None:
                attempt = machine.advance(attempt, event, time)
            if depth is not None or attempt.state is State.ALIGNING:
                since = time
            unseen = max(unseen, time - since)
            states.append(attempt.state.value)
            if touching is not None and samples.spread is not None:
                inside = depth is not None and attempt.state in (State.INSERTING, State.HOLDING)
                at = time - float(samples.spread[k, 2]) if inside else None
                if touching.take(samples.tip[k], at):
                    times.append(time)
        of = 0 if touching is None else len(touching.state.task)
        return cls(np.array(states), unseen, target, Touches(of, tuple(times)) if of else None)
