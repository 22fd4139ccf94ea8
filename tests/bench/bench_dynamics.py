"""The dynamics term alone: M, h and g together, compiled, at random states in the workspace.

The peer in the same run is the same mechanism written with numpy arrays: body Jacobians of links,
tool and needle, M = Σ m JᵀJ, h from their rates, g from their heights. Goal: 300 ns.

Run as `python -m tests.bench.bench_dynamics`.
"""

from time import perf_counter

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.pantograph import dynamic_terms, forward, inverse, jacobian, jacobian_rate
from app.mechanisms.pantograph.dynamics import dynamics_kernel
from app.mechanisms.profile import load_profile

LIMIT_NS = 300.0
STATES = 1000
CHUNK = 200
CHUNKS = 50
PROFILE = load_profile("icube")
GEOMETRY, MODEL = PROFILE.pantograph, PROFILE.dynamic_model


def states() -> FloatArray:
    """Rows of (q1, q2, v1, v2, x, y, depth, depth rate)."""
    rng = np.random.default_rng(1)
    rows = []
    for _ in range(STATES):
        tilt, turn = rng.uniform(0.0, PROFILE.tilt_limit), rng.uniform(-np.pi, np.pi)
        lean = GEOMETRY.fulcrum[2] * np.tan(tilt) * np.array([np.cos(turn), np.sin(turn)])
        q = inverse(GEOMETRY, GEOMETRY.fulcrum[:2] + lean)
        rows.append(
            [*q, *rng.uniform(-2, 2, 2), *forward(GEOMETRY, q), rng.uniform(-0.03, 0.12), 0.1]
        )
    return np.array(rows)


@njit(cache=False)
def _walk(rows: FloatArray, p: FloatArray, calls: int) -> float:
    total = 0.0
    for k in range(calls):
        q1, q2, v1, v2, x, y, depth, rate = rows[k % len(rows)]
        found = dynamics_kernel(q1, q2, v1, v2, x, y, depth, rate, p, 0)
        total += found[0] + found[1] + found[2] + found[3] + found[4] + found[5] + found[6]
    return total


def numpy_terms(row: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Compute M, h and g of one state with numpy arrays."""
    q, qd, p3, depth, rate = row[:2], row[2:4], row[4:6], row[6], row[7]
    part, lengths, gravity = PROFILE.inertia, PROFILE.geometry, MODEL.gravity
    j, jd = jacobian(GEOMETRY, q), jacobian_rate(GEOMETRY, q, qd)
    mass = part.tool_mass * j.T @ j
    velocity = part.tool_mass * j.T @ jd @ qd
    fall = -part.tool_mass * j.T @ gravity[:2]
    for k, side in enumerate((-1.0, 1.0)):
        along = np.array([np.cos(q[k]), np.sin(q[k])])
        elbow = np.array([0.5 * side * lengths.base, 0.0]) + lengths.proximal * along
        je, jed = np.zeros((2, 2)), np.zeros((2, 2))
        je[:, k] = lengths.proximal * np.array([-along[1], along[0]])
        jed[:, k] = -lengths.proximal * along * qd[k]
        share = part.distal_centre / lengths.distal
        jc, jcd = je + share * (j - je), jed + share * (jd - jed)
        turn = np.array([[0.0, -1.0], [1.0, 0.0]]) @ (p3 - elbow) / lengths.distal**2
        spin = turn @ (j - je)
        spin_rate = turn @ (jd - jed)  # the part along the link drops out: it keeps its length
        near = part.proximal_centre / lengths.proximal
        mass += part.distal_mass * jc.T @ jc + part.distal_inertia * np.outer(spin, spin)
        mass += part.proximal_mass * near**2 * je.T @ je
        mass[k, k] += part.proximal_inertia + part.reflected_rotor
        velocity += part.distal_mass * jc.T @ (jcd @ qd)
        velocity += part.distal_inertia * spin * (spin_rate @ qd)
        fall -= part.distal_mass * jc.T @ gravity[:2]
        fall -= part.proximal_mass * near * je.T @ gravity[:2]
    lever = np.array([*p3, 0.0]) - GEOMETRY.fulcrum
    l_in = np.linalg.norm(lever)
    d = lever / l_in
    across = ((np.eye(3) - np.outer(d, d)) / l_in)[:, :2]
    s = depth + part.needle_centre - lengths.needle_length
    inertia = part.needle_inertia + part.needle_mass * s**2
    turning = across @ j
    v = np.array([*(j @ qd), 0.0])
    bend = across @ (jd @ qd) - 2.0 * (d @ v) / l_in * (turning @ qd)
    mass += inertia * turning.T @ turning
    velocity += inertia * turning.T @ bend
    velocity += 2.0 * part.needle_mass * s * rate * turning.T @ (turning @ qd)
    fall -= part.needle_mass * s * turning.T @ gravity
    return mass, velocity, fall


def check(rows: FloatArray) -> float:
    """Largest relative difference of the two ways over some states."""
    worst = 0.0
    for row in rows[:50]:
        terms = dynamic_terms(MODEL, row[:2], row[2:4], row[6], row[7])
        ours = terms.mass, terms.velocity, terms.gravity
        for mine, theirs in zip(ours, numpy_terms(row), strict=True):
            scale = max(np.abs(mine).max(), 1e-6)
            worst = max(worst, float(np.abs(mine - theirs).max() / scale))
    return worst


def main() -> None:
    """Print the time of one call, its spread, and that of the numpy version."""
    rows, p = states(), MODEL.values
    print(f"numpy and compiled differ by {check(rows):.1e} at most")
    _walk(rows, p, CHUNK)
    times = []
    for k in range(CHUNKS):
        start = perf_counter()
        _walk(np.roll(rows, k, axis=0), p, CHUNK)
        times.append((perf_counter() - start) / CHUNK)
    start = perf_counter()
    for row in rows[:200]:
        numpy_terms(row)
    peer = (perf_counter() - start) / 200
    median, best, worst = float(np.median(times)), min(times), max(times)
    print(
        f"M, h and g compiled   {median * 1e9:8.0f} ns median of {CHUNKS} chunks"
        f" (best {best * 1e9:.0f}, worst {worst * 1e9:.0f})"
    )
    print(f"M, h and g with numpy {peer * 1e9:8.0f} ns, {peer / median:.0f} times as long")
    print(f"goal {LIMIT_NS:.0f} ns: {'reached' if median * 1e9 <= LIMIT_NS else 'NOT reached'}")


if __name__ == "__main__":
    main()
