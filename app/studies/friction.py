"""Study: which law of friction is calm in a still hand and right in a moving one.

The depth is measured in counts of 33 µm. A hand that has come to the edge of a count rests there
with a tremor of 5 µm; or it inserts, or turns back and forth. The friction slides at 1 N. The same
laws hold the needle in its ball joints, felt at the hub when it tilts in counts of the encoders: of
both designs, without the play of the printed one.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.simulation import dry_friction
from app.simulation.effects import ball_joint, declaration, shaft_friction
from app.studies.findings import Findings, Sheet
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Friction along the needle: Kikuuwe, Dahl, LuGre, and the sign of the speed",
    "question": "Which law of friction stands a depth that is measured in counts?",
    "reference": (
        "dry friction behind a spring, stepped through the motion of the hand without counts and "
        "tremor at a hundredth of the tick"
    ),
}

COUNT: Final = shaft_friction.COUNT
TREMOR: Final = 5e-6  # [m]
LEVEL: Final = 1.0  # [N]
HUB: Final = 0.110  # of the hub from the fulcrum [m]
STEP: Final = 1e-3  # [s]
_FINE: Final = 100
_STILL: Final = 2000  # ticks

kikuuwe = dry_friction.kikuuwe
dahl = dry_friction.dahl


@njit
def by_kikuuwe(depth: FloatArray, level: float, stiffness: float, out: FloatArray) -> None:
    """Spring that slides at the level."""
    f = 0.0
    for i in range(1, len(depth)):
        f = kikuuwe(f, depth[i] - depth[i - 1], level, stiffness)
        out[i] = f


@njit
def by_dahl(depth: FloatArray, level: float, stiffness: float, out: FloatArray) -> None:
    """Dahl's law, exact over each displacement."""
    f = 0.0
    for i in range(1, len(depth)):
        f = dahl(f, depth[i] - depth[i - 1], level, stiffness)
        out[i] = f


@njit
def by_lugre(depth: FloatArray, level: float, stiffness: float, out: FloatArray) -> None:
    """LuGre: the same with bristles damped by σ · 0.3 ms, within the level."""
    f = 0.0
    for i in range(1, len(depth)):
        before = f
        f = dahl(f, depth[i] - depth[i - 1], level, stiffness)
        out[i] = min(max(f + 0.3 * (f - before), -level), level)


@njit
def by_sign(depth: FloatArray, level: float, stiffness: float, out: FloatArray) -> None:
    """Level times the sign of the speed."""
    for i in range(1, len(depth)):
        out[i] = level * np.sign(depth[i] - depth[i - 1])


@njit
def by_euler(depth: FloatArray, level: float, stiffness: float, out: FloatArray) -> None:
    """Dahl's law by explicit Euler: unstable for steps longer than 2 g / σ."""
    f = 0.0
    for i in range(1, len(depth)):
        travel = depth[i] - depth[i - 1]
        f += stiffness * (travel - abs(travel) * f / level)
        out[i] = f


LAWS: Final[dict[str, tuple[str, Callable[..., None], str]]] = {
    "kikuuwe": ("implicit", by_kikuuwe, "a spring that slides at the level, closed form"),
    "dahl": ("bristle", by_dahl, "exponential update, exact over a displacement"),
    "lugre": ("bristle", by_lugre, "the same with damped bristles"),
    "sign of the speed": ("control", by_sign, "level times sign"),
    "Dahl, explicit Euler": ("control", by_euler, "unstable beyond 2 g / σ a tick"),
}


def motion(kind: str, count: float = COUNT) -> FloatArray:
    """Way of the hand [m] at a hundredth of the tick, without tremor, from a rest on the way."""
    edge = 3030.0 * count
    if kind == "still":
        come = np.linspace(edge - 5e-3, edge, 500 * _FINE, endpoint=False)
        return np.concatenate([come, np.full(_STILL * _FINE, edge)])
    times = np.arange(1000 * _FINE) * STEP / _FINE
    if kind == "insertion":
        return np.asarray(0.05 + 0.02 * times)
    if kind == "fast":
        return np.asarray(0.05 + 0.3 * times)
    return np.asarray(0.05 + 0.01 * np.sin(2.0 * np.pi * times / 0.5))


def seen(depths: FloatArray, seed: int = 4, count: float = COUNT) -> FloatArray:
    """Return what is measured of a motion once a tick: with tremor, in counts [m]."""
    ticks = depths[::_FINE]
    shaken = ticks + np.random.default_rng(seed).normal(0.0, TREMOR, len(ticks))
    return np.asarray(count * np.floor(shaken / count))


def at_the_hub(design: int) -> dict[str, float]:
    """Friction of both ball joints as the hub feels it, `HUB` from the fulcrum.

    Args:
        design: `ball_joint.PRINTED` or `ball_joint.REDESIGNED`.

    Returns:
        `level` [N] without break-away, `stiffness` [N/m] before it slides, `count` [m] of the
        encoders; of the effect's own numbers.
    """
    name, radius = {
        ball_joint.PRINTED: ("printed_coefficient", ball_joint.PRINTED_RADIUS),
        ball_joint.REDESIGNED: ("redesigned_coefficient", ball_joint.REDESIGNED_RADIUS),
    }[design]
    of = {key: given[0] for key, given in ball_joint.DECLARATION["parameters"].items()}
    level = 2.0 * of[name] * of["clamping"] * radius / HUB
    return {
        "level": level,
        "stiffness": level / (of["presliding_angle"] * HUB),
        "count": ball_joint.COUNT * HUB,
    }


def _rms(values: FloatArray) -> float:
    with np.errstate(all="ignore"):  # the control overflows
        return float(np.sqrt(np.mean(values**2)))


def _case(setting: Setting) -> Case:
    name = setting.name.split(": ")[-1].split(",")[0]
    given = {"level": LEVEL, "count": COUNT, **setting.values}
    level, stiffness, count = given["level"], given["stiffness"], given["count"]
    path = motion(name, count)
    truth = np.zeros(len(path))
    by_kikuuwe(path, level, stiffness, truth)
    truth = truth[::_FINE]
    first = 500 if name == "still" else 50
    return Case(
        data=(seen(path, count=count), level, stiffness),
        error=lambda found: _rms((found - truth)[first:]),
        perception=0.1,
    )


def _way(kernel: Callable[..., None]) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        depths, level, stiffness = case.data
        out = np.zeros(len(depths))

        def run() -> FloatArray:
            kernel(depths, level, stiffness, out)
            return out

        return Prepared(run, len(depths))

    return prepare


def still_hand(law: str, stiffness: float) -> tuple[int, float]:
    """Sign changes and rms force [N] of 2 s on the edge of a count."""
    depths = seen(motion("still"))
    out = np.zeros(len(depths))
    LAWS[law][1](depths, LEVEL, stiffness, out)
    still = out[500:]
    changes = np.sign(np.nan_to_num(still))
    return int(np.count_nonzero(np.diff(changes))), _rms(still)


SHARES: Final = (0.03, 0.3, 0.99, 3.0, 30.0)
"""σ Δ / F_c of the still hand."""


def _still_table() -> Findings:
    rows = []
    for share in SHARES:
        for law in LAWS:
            changes, rms = still_hand(law, share * LEVEL / COUNT)
            rows.append((share, law, changes, f"{rms:.3g}"))
    columns = ("σ Δ / F_c", "law", "sign changes in 2 s", "rms force [N]")
    return Findings((Sheet("still", "A still hand on the edge of a count", columns, tuple(rows)),))


_STIFFNESS: Final = 1e4  # [N/m] of 100 mm in tissue at 1e5 N/m²

STUDY: Final = Study(
    error_label="rms error of the force [N]",
    ways=tuple(
        Way(name, family, _way(kernel), words, used=name)
        for name, (family, kernel, words) in LAWS.items()
    ),
    settings=(
        *(
            Setting(f"still, σΔ = {share:g} F_c", {"stiffness": share * LEVEL / COUNT})
            for share in SHARES
        ),
        *(
            Setting(f"{kind}, σ = {_STIFFNESS:g} N/m", {"stiffness": _STIFFNESS})
            for kind in ("insertion", "fast", "back and forth")
        ),
        *(
            Setting(f"ball joint, {name}: {kind}", at_the_hub(design))
            for name, design in (
                ("printed", ball_joint.PRINTED),
                ("redesigned", ball_joint.REDESIGNED),
            )
            for kind in ("still", "back and forth")
        ),
    ),
    case=_case,
    deadline=Limit(1e-6, "1 µs: 0.1 % of the 1 ms tick"),
    perception=Limit(0.1, "0.1 N: felt"),
    default="kikuuwe",
    because="The only one whose force keeps its sign in a still hand while σΔ ≤ F_c.",
    exception=(
        "From 0.1 F_c on no law stays below 0.1 N at the edge of a count (0.21 N at 0.3 F_c); "
        "beyond F_c `acus explain` warns."
    ),
    in_use=lambda: declaration("shaft_friction").model(""),
    findings=_still_table,
)
