"""Force closure: whether contacts can resist every wrench, and by how much.

A contact pushes with its inward normal and, within friction, sideways. Per newton along the normal
its wrenches are the convex hull of a few rays: two edges of the cone in the plane, m edges of a
polyhedron inscribed in it in space (never more than the real cone gives), each with a torque of
±a N·m per newton about the normal if the finger is soft. Torques are taken about the mean of the
contacts and divided by a length, the **torque scale**, so that a wrench has one unit: by default
the largest distance of a contact from that mean; for points that coincide it must be given.

Closure is strict: the origin lies inside the convex hull of all rays, not on its face. The
**margin** is the radius of the largest ball about the origin inside that hull: the largest wrench
[N] that is resisted from any direction while the normal forces sum to 1 N.

Ways to find it (`ClosureWay`): the hull's facets; linear programmes that shoot rays and walk from
facet to facet, an upper bound that is the margin in all but a few grasps; and for two contacts in
the plane the four faces of a tetrahedron, in closed form. The rank is asked first: wrenches that do
not span the space close nothing, whatever a hull or a programme says.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import atan, atan2, inf, pi, sqrt
from typing import Any, Final

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, QhullError

from app.arm.hand.errors import GraspError
from app.core.arrays import FloatArray, frozen, unit
from app.core.compiled import njit
from app.core.messages import sentence

EDGES: Final = 8
"""Edges of the friction cone in space, unless asked otherwise."""

_RANK: Final = 1e-12
"""Singular values below this share of the largest count as none."""

_STRICT: Final = 1e-12
"""The origin is inside if every facet is further than this, in wrenches of unit variance."""

_PROGRAMME: Final = 1e-9
"""The same for linear programmes, whose solver promises no more."""

_MOST_STEPS: Final = 50
_TURN: Final = 5  # seed of the frame in which programmes start


class ClosureWay(StrEnum):
    """How closure and margin are found."""

    HULL = "hull"
    PROGRAMME = "programme"
    PAIR = "pair"


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """Where an object is touched, and what the contacts can do.

    Attributes:
        points: [m], shape (n, 2) in the plane or (n, 3) in space.
        normals: inward, from the finger into the object; any length, kept at one; same shape.
        friction: coefficient μ ≥ 0.
        soft: torque about the normal per normal force, a [m]; 0 for a hard finger; 0 in the plane.

    Raises:
        GraspError: for another shape, no contact, a negative or endless coefficient, or `soft` in
            the plane.
        NumericalError: if a number is not finite, or a normal has no direction.
    """

    points: FloatArray
    normals: FloatArray
    friction: float
    soft: float = 0.0

    def __post_init__(self) -> None:
        points = frozen(self.points, name="points")
        normals = frozen(self.normals, name="normals")
        if points.ndim != 2 or points.shape[1] not in (2, 3) or len(points) == 0:
            raise GraspError(
                sentence(
                    "points have shape {points_shape}; (n, 2) or (n, 3) is needed",
                    points_shape=points.shape,
                )
            )
        if normals.shape != points.shape:
            raise GraspError(
                sentence(
                    "{points_shape} points have normals of shape {normals_shape}",
                    points_shape=points.shape,
                    normals_shape=normals.shape,
                )
            )
        for name in ("friction", "soft"):
            if not 0.0 <= (value := getattr(self, name)) < inf:
                raise GraspError(
                    sentence("{name} is {bound}; give 0 or more", name=name, bound=value)
                )
        if self.soft and points.shape[1] == 2:
            raise GraspError(
                sentence("in the plane no contact turns about its normal; leave soft at 0")
            )
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "normals", frozen([unit(n, "normal") for n in normals]))

    @property
    def planar(self) -> bool:
        """Return whether the contacts lie in a plane of two coordinates."""
        return bool(self.points.shape[1] == 2)


@dataclass(frozen=True, slots=True, eq=False)
class Wrenches:
    """Rays of all contacts, each for 1 N along its normal.

    Attributes:
        rays: force, then torque / scale [N], shape (k, 3) in the plane or (k, 6).
        scale: length by which torques are divided [m].
    """

    rays: FloatArray
    scale: float


@dataclass(frozen=True, slots=True)
class Closure:
    """What was found.

    Attributes:
        closed: whether every wrench can be resisted.
        margin: largest ball of wrenches about the origin [N per N of normal forces]; 0 if open.
        rank: dimensions that the wrenches span; 3 or 6 are needed.
        scale: the torque scale [m].
        reason: why it is open; empty if closed.
    """

    closed: bool
    margin: float
    rank: int
    scale: float
    reason: str = ""

    def squeeze(self, wrench: float) -> float:
        """Sum of normal forces [N] that surely holds a wrench of this size [N], as scaled here.

        Raises:
            GraspError: if the grasp is open: no force holds it.
        """
        if not self.closed:
            raise GraspError(sentence("no force holds the tool: {reason}", reason=self.reason))
        return wrench / self.margin


def wrenches(contacts: Contacts, edges: int = EDGES, scale: float | None = None) -> Wrenches:
    """Rays of the contacts.

    Args:
        contacts: where and how.
        edges: of the friction cone in space, at least 3; the plane's cone has two.
        scale: torque scale [m]; by default the largest distance of a contact from their mean.

    Raises:
        GraspError: for too few edges, a scale that is not positive, or points that coincide
            without one.
    """
    if not contacts.planar and edges < 3:
        raise GraspError(
            sentence("a friction cone in space with {edges} edges; give 3 or more", edges=edges)
        )
    levers = contacts.points - contacts.points.mean(axis=0)
    if scale is None:
        scale = float(np.linalg.norm(levers, axis=1).max())
        if not scale > 0.0:
            raise GraspError(
                sentence("all contacts are one point: torques have no scale; give scale=...")
            )
    if not 0.0 < scale < inf:
        raise GraspError(
            sentence("the torque scale is {scale} m; a positive length is needed", scale=scale)
        )
    mu, soft = contacts.friction, contacts.soft
    found = []
    for lever, normal in zip(levers, contacts.normals, strict=True):
        if contacts.planar:
            across = np.array([-normal[1], normal[0]])
            for force in (normal + mu * across, normal - mu * across)[: 2 if mu else 1]:
                torque = lever[0] * force[1] - lever[1] * force[0]
                found.append([*force, torque / scale])
            continue
        for along in _edges(normal, edges) if mu else np.zeros((1, 3)):
            force = normal + mu * along
            torque = np.cross(lever, force)
            for twist in (soft, -soft)[: 2 if soft else 1]:
                found.append([*force, *((torque + twist * normal) / scale)])
    return Wrenches(frozen(found), scale)


def force_closure(
    contacts: Contacts,
    edges: int = EDGES,
    scale: float | None = None,
    way: ClosureWay = ClosureWay.HULL,
) -> Closure:
    """Return whether the contacts close, and their margin.

    Args:
        contacts: where and how.
        edges: of the friction cone in space.
        scale: torque scale [m], as `wrenches`.
        way: `PAIR` only for two contacts in the plane.

    Raises:
        GraspError: as `wrenches`, for `PAIR` with other contacts, or a programme without an end.
    """
    made = wrenches(contacts, edges, scale)
    needed = made.rays.shape[1]
    rank = _rank(made.rays)
    if rank < needed:
        reason = f"the wrenches span {rank} of {needed} dimensions"
        return Closure(False, 0.0, rank, made.scale, reason)
    margin = {
        ClosureWay.HULL: hull_margin,
        ClosureWay.PROGRAMME: programme_margin,
        ClosureWay.PAIR: pair_margin,
    }[way](made.rays)
    if margin > 0.0:
        return Closure(True, margin, rank, made.scale)
    reason = "a wrench exists against which no contact pushes"
    return Closure(False, 0.0, rank, made.scale, reason)


def hull_margin(rays: FloatArray) -> float:
    """Margin by the facets of the convex hull of rays that span their space, shape (k, d).

    The hull is built of wrenches stretched to unit variance, so that small friction or levers make
    it no flatter; its facets are then measured where they belong. 0 if the origin is not inside.
    """
    _, spread, axes = np.linalg.svd(rays, full_matrices=False)
    stretch = np.sqrt(len(rays)) / spread
    try:
        facets = ConvexHull((rays @ axes.T) * stretch).equations
    except QhullError:
        return 0.0  # all in one hyperplane beside the origin: nothing pushes against its far side
    inside = -facets[:, -1]
    if not (inside > _STRICT).all():
        return 0.0
    normals = (facets[:, :-1] / inside[:, None] * stretch) @ axes
    return float(1.0 / np.linalg.norm(normals, axis=1).max())


def programme_margin(rays: FloatArray) -> float:
    """Margin by linear programmes, of rays that span their space, shape (k, d).

    First whether the origin is a sum of all rays with weights that are all positive. Then, from
    both ends of each axis of a turned frame: how far the hull reaches that way, and, by the dual,
    in which facet it ends; from there along the facet's normal, until no facet is nearer. The
    frame is turned because a ray into an edge has no facet to tell, and contacts like to be
    symmetric. Never below the margin.
    """
    if not positively_spanned(rays):
        return 0.0
    d, least = rays.shape[1], inf
    turned = np.linalg.qr(np.random.default_rng(_TURN).normal(size=(d, d))).Q
    for start in np.vstack([turned, -turned]):
        direction, before = start, inf
        for _ in range(_MOST_STEPS):
            reach, normal = shot(rays, direction)
            size = float(np.linalg.norm(normal))
            distance = reach / size
            if not distance < before * (1.0 - 1e-9):
                break
            before, direction = distance, normal / size
        least = min(least, before)
    return least


def positively_spanned(rays: FloatArray) -> bool:
    """Return whether the origin is a sum of all rays with positive weights; strictly, of full rank.

    Raises:
        GraspError: if the solver finds no end.
    """
    k, d = rays.shape
    size = np.abs(rays).max(axis=0)
    equal = np.zeros((d + 1, k + 1))
    equal[:d, :k] = (rays / size).T
    equal[d, :k] = 1.0
    ahead = np.hstack([-np.eye(k), np.ones((k, 1))])  # t - λ ≤ 0
    cost, right = np.zeros(k + 1), np.zeros(d + 1)
    cost[k], right[d] = -1.0, 1.0
    found = _solved(cost, equal, right, ahead)
    return found is not None and -float(found.fun) > _PROGRAMME


def shot(rays: FloatArray, direction: FloatArray) -> tuple[float, FloatArray]:
    """Return how far the hull reaches from the origin along a unit vector (d,), and the facet's
    normal.

    The normal (d,) is scaled so that the facet is where normal · w equals that reach.

    Raises:
        GraspError: if the origin is outside: the ray has no end in the hull.
    """
    k, d = rays.shape
    equal = np.zeros((d + 1, k + 1))
    equal[:d, :k] = rays.T
    equal[:d, k] = -direction
    equal[d, :k] = 1.0
    cost, right = np.zeros(k + 1), np.zeros(d + 1)
    cost[k], right[d] = -1.0, 1.0
    found = _solved(cost, equal, right)
    if found is None:
        raise GraspError(sentence("the origin is outside the wrenches' hull: no ray ends in it"))
    return -float(found.fun), np.asarray(found.eqlin.marginals[:d], np.float64)


def pair_margin(rays: FloatArray) -> float:
    """Margin of two contacts in the plane in closed form: four rays (4, 3) are a tetrahedron.

    The distance of a face from the origin is the triple product of its corners over the length of
    its normal. For contacts exactly opposed at distance 2 r it is 1/√(1 + 1/μ² + (scale/(r μ))²).

    Raises:
        GraspError: for other rays than four in the plane, which friction 0 does not give.
    """
    if rays.shape != (4, 3):
        raise GraspError(
            sentence(
                "no closed form for {rays} rays of {dimensions} dimensions, only "
                "for two contacts in the plane",
                rays=len(rays),
                dimensions=rays.shape[1],
            )
        )
    return float(pair_kernel(rays))


@njit
def pair_kernel(rays: FloatArray) -> float:
    """Least distance of the origin from a tetrahedron's faces, corners (4, 3); 0 if not inside."""
    least = inf
    for i in range(4):
        a, b, c = rays[(i + 1) % 4], rays[(i + 2) % 4], rays[(i + 3) % 4]
        ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        off = nx * a[0] + ny * a[1] + nz * a[2]
        # The fourth corner lies on the origin's side of the face, or the origin is outside.
        if off * (nx * rays[i, 0] + ny * rays[i, 1] + nz * rays[i, 2] - off) >= 0.0:
            return 0.0
        least = min(least, abs(off) / sqrt(nx * nx + ny * ny + nz * nz))
    return least


def pair_closed(contacts: Contacts) -> bool:
    """Return whether two contacts in the plane close: the line between them is strictly inside both
    cones.

    Squeezing, each has the other before it; or both have the other behind them, and spread the
    object apart from within.

    Raises:
        GraspError: for other contacts, or points that coincide.
    """
    if not contacts.planar or len(contacts.points) != 2:
        raise GraspError(sentence("this test is for two contacts in the plane"))
    line = contacts.points[1] - contacts.points[0]
    if not line.any():
        raise GraspError(sentence("both contacts are one point: no line joins them"))
    half = atan(contacts.friction)
    one, other = contacts.normals
    return any(
        abs(_turned(one, way * line)) < half and abs(_turned(other, -way * line)) < half
        for way in (1.0, -1.0)
    )


def _turned(a: FloatArray, b: FloatArray) -> float:
    return atan2(float(a[0] * b[1] - a[1] * b[0]), float(a @ b))


def _edges(normal: FloatArray, count: int) -> FloatArray:
    # Unit vectors across the normal, evenly about it; the first where the least coordinate leads.
    axis = np.eye(3)[int(np.abs(normal).argmin())]
    u = unit(axis - normal * (normal @ axis))
    v = np.cross(normal, u)
    turn = 2.0 * pi * np.arange(count) / count
    return np.asarray(np.outer(np.cos(turn), u) + np.outer(np.sin(turn), v))


def _rank(rays: FloatArray) -> int:
    values = np.linalg.svd(rays, compute_uv=False)
    return int((values > _RANK * values[0]).sum())


def _solved(
    cost: FloatArray, equal: FloatArray, right: FloatArray, ahead: FloatArray | None = None
) -> Any:
    """Return scipy's answer, weights ≥ 0 and the last unknown free below 0; None if there is none.

    Raises:
        GraspError: if the solver finds neither an answer nor that there is none.
    """
    unequal = {} if ahead is None else {"A_ub": ahead, "b_ub": np.zeros(len(ahead))}
    bounds = [(0.0, None)] * (len(cost) - 1) + [(None, None) if ahead is not None else (0.0, None)]
    precise = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}
    found = linprog(
        cost, A_eq=equal, b_eq=right, bounds=bounds, method="highs", options=precise, **unequal
    )
    if found.status == 2:
        return None
    if found.status != 0:
        raise GraspError(
            sentence(
                "a linear programme of {unknowns} unknowns ended with: {ending}",
                unknowns=len(cost),
                ending=found.message,
            )
        )
    return found
