"""Effects along the needle in a field give out no more than was stored and breathing supplied.

Counted are both ports of the hand, along the needle and, where bone turns the tip aside, across
it, law by law. Breathing works where it carries the tissue at the tip along the needle: the force
times that way. From outside on nothing is ever given out by all of them together. From any moment
on a law gives out at most what it says that it can hold; cutting and pressing, whose force P comes
and goes over a way λ, P λ (1 - ln 2) more each time that they are pushed by λ ln 2 and drawn back
(0.07 mJ in liver): that little is no law's own, and paid for by what the membrane before took. From
within a push, where they hold f λ, it is that besides. Only pushes are counted, as the tip goes
against the tissue.
"""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from simulation.field_rig import field_of, scene_in, slab, stages_in

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.parameters import Stage
from app.simulation.along_needle import approach
from app.simulation.effects import declaration, load

AXIAL = ("puncture", "cutting", "relaxation", "shaft_friction", "bone_contact")
LENGTH = 0.2
FASTEST = 0.04  # [m/s] of tip or tissue within a segment, on average
JUMP = 3e-4  # [m]
STRONGEST = 30.0  # [N] no hand pushes harder: what stops it ends a segment
STILL = 1e-8  # [m] in a tick
STRONGEST_PRESSING = 0.040  # [m] deep, in the tissue with the largest pressing
ROUNDING = 2e-5  # [J] of forces that are known at ticks alone
WAYS = np.array([0.0, 1e-4, 3e-4, 0.0, 0.0])  # [m] λ of cutting and of pressing, as shipped
BY_WAY = np.array([name in ("cutting", "relaxation") for name in AXIAL])


def body() -> object:
    """Skin, fat and muscle that stay; liver with a vessel that breathes; a slanted rib behind."""
    into = unit(np.array([0.5, 0.0, -1.0]), "rib")
    vessel = lambda p: 6.0 - np.hypot(p[:, 0], p[:, 2] + 45.0)  # noqa: E731
    rib = lambda p: p @ into - 62.0  # noqa: E731

    def liver(p: FloatArray) -> FloatArray:
        return np.minimum(np.minimum(-28.0 - p[:, 2], -vessel(p)), -rib(p))

    return field_of(
        [
            ("air", "", slab(100.0, 0.0)),
            ("skin", "", slab(0.0, -2.0)),
            ("fat", "", slab(-2.0, -14.0)),
            ("muscle", "", slab(-14.0, -28.0)),
            ("organ", "liver", liver),
            ("vessel", "", vessel),
            ("bone", "rib", rib),
        ],
        low=(-60.0, -60.0, -110.0),
        high=(60.0, 60.0, 20.0),
        spacing=1.0,
    )


FIELD = body()


class PushedNeedle:
    """A needle whose hub a hand moves, and what has come out of it [J], law by law.

    Of bone, what is felt across the needle counts with what is felt along it.
    """

    def __init__(self) -> None:
        scene = scene_in(FIELD, "tissue_field", *AXIAL, "bone_slide")
        self.stages: list[Stage] = stages_in(scene)
        arrays = {stage.name: stage.parameters for stage in self.stages}
        self.bound = np.array(
            [load(declaration(name)).axial_energy_bound(arrays[name]) for name in AXIAL]
        )
        self.state, self.forces = sv.empty_state(), np.zeros(len(AXIAL))
        self.axis, self.depth, self.breath = np.array([0.0, 0.0, -1.0]), -0.004, 0.0
        self.out, self.supplied = np.zeros(len(AXIAL)), np.zeros(len(AXIAL))
        self.jumped, self.most = True, 0.0
        self.pushes, self.pushes_then, self.goes_in = 0, np.zeros(len(AXIAL)), False
        self.held = self.bound.copy()
        self.lowest, self.worst = np.zeros(len(AXIAL)), np.zeros(len(AXIAL))
        self.tick(self.axis, self.depth, 0.0)

    def tick(self, axis: FloatArray, depth: float, breath: float) -> None:
        """Go on by a tick; by trapezoids of the forces before and now.

        Where the tissue jumps along the needle (before bone that stays, the rest of a breath is
        cut off at once) the force at the end counts: the laws go over that way, not the tick.
        """
        state, across = self.state, self.state[sv.FORCE].copy()
        tissue, carried = float(state[sv.TISSUE]), state[sv.CARRIED].copy()
        forces = np.zeros(len(AXIAL))
        state[sv.SUMS,] = 0.0
        state[sv.AXIS], state[sv.TIP] = axis, depth * axis
        state[sv.DEPTH] = state[sv.PLANT_DEPTH] = depth
        state[sv.DEPTH_SOURCE], state[sv.L_OUT], state[sv.DT] = 1.0, LENGTH - depth, 1e-3
        before = 0.0
        for name, function, parameters in self.stages:
            function(state, parameters)
            if name == "clear_effects":
                state[sv.BREATH] = (0.0, 0.3 * breath, breath)
            elif name in AXIAL:
                forces[AXIAL.index(name)] = state[sv.AXIAL_FORCE] - before
            before = float(state[sv.AXIAL_FORCE])
        way = float(state[sv.CARRIED] @ axis - carried @ self.axis)
        jumps = abs(way) > JUMP or tissue != state[sv.TISSUE]
        mean = forces if jumps or self.jumped else 0.5 * (self.forces + forces)
        self.jumped = jumps
        travel = depth - self.depth - way
        self.pushes += travel > STILL and not self.goes_in
        self.goes_in = travel > STILL or (self.goes_in and travel >= -STILL)
        hub = -(LENGTH - 0.5 * (self.depth + depth)) * (axis - self.axis)
        self.out -= mean * (depth - self.depth)
        self.out[AXIAL.index("bone_contact")] += float(0.5 * (across + state[sv.FORCE]) @ hub)
        if tissue == state[sv.TISSUE]:
            self.supplied -= mean * way
        self.axis, self.depth, self.breath, self.forces = axis, depth, breath, forces
        gained = self.out - self.supplied
        self.pushes_then = np.where(gained <= self.lowest, self.pushes, self.pushes_then)
        now = np.where(BY_WAY, np.abs(forces) * WAYS, self.bound)  # what is held: f λ
        self.held = np.where(gained <= self.lowest, now, self.held)
        self.lowest = np.minimum(self.lowest, gained)
        each = self.bound * BY_WAY * (1.0 - np.log(2.0))
        allowed = self.held + each * (1.0 + self.pushes - self.pushes_then)
        self.worst = np.maximum(self.worst, gained - self.lowest - allowed)
        self.worst = np.maximum(self.worst, gained - each * self.pushes)
        self.most = max(self.most, float(gained.sum()))

    def move(self, depth: float, axis: FloatArray, breath: float) -> int:
        """Go to a depth [m], a direction and a breath [m], as smoothly as a hand; ticks taken."""
        way = max(abs(depth - self.depth), 0.1 * float(np.linalg.norm(axis - self.axis)))
        way = max(way, abs(breath - self.breath))
        ticks = max(20, round(way / FASTEST / 1e-3))
        start, before = (self.depth, self.axis, self.breath), 0.0
        for k in range(1, ticks + 1):
            s = k / ticks
            share = s * s * (3.0 - 2.0 * s)
            direction = unit(start[1] + share * (axis - start[1]), "direction")
            self.tick(
                direction,
                start[0] + share * (depth - start[0]),
                start[2] + share * (breath - start[2]),
            )
            push = float(np.hypot(self.state[sv.AXIAL_FORCE], np.linalg.norm(self.state[sv.FORCE])))
            if push > max(STRONGEST, before):
                return k
            before = push
        return ticks


def leaning(x: float, y: float) -> FloatArray:
    return unit(np.array([x, y, -1.0]), "needle")


SEGMENTS = st.lists(
    st.tuples(
        st.sampled_from(["push", "tilt", "breathe", "all"]),
        st.floats(-0.005, 0.085),
        st.floats(-0.25, 0.25),
        st.floats(-0.25, 0.25),
        st.floats(-0.012, 0.012),
    ),
    min_size=1,
    max_size=12,
)


def gone(segments: list[tuple[str, float, float, float, float]]) -> PushedNeedle:
    needle = PushedNeedle()
    for kind, depth, x, y, breath in segments:
        needle.move(
            depth if kind in ("push", "all") else needle.depth,
            leaning(x, y) if kind in ("tilt", "all") else needle.axis,
            breath if kind in ("breathe", "all") else needle.breath,
        )
    return needle


def is_passive(needle: PushedNeedle) -> bool:
    return bool((needle.worst <= ROUNDING).all() and needle.most <= ROUNDING)


@pytest.mark.long("machine")
@settings(max_examples=12, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(SEGMENTS)
def test_pushes_pulls_and_tilts_give_out_no_more_than_was_stored_and_breathing_supplied(
    segments: list[tuple[str, float, float, float, float]],
) -> None:
    assert is_passive(gone(segments))


@pytest.mark.long("statistics")
@settings(
    max_examples=200, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
@given(SEGMENTS)
def test_two_hundred_hands_get_out_no_more_than_was_stored(
    segments: list[tuple[str, float, float, float, float]],
) -> None:
    assert is_passive(gone(segments))


@pytest.mark.long("statistics")
def test_a_million_ticks_along_and_across_give_out_no_more_than_was_stored() -> None:
    needle, rng, ticks = PushedNeedle(), np.random.default_rng(5), 0
    while ticks < 1_000_000:
        some = rng.random(3) < 0.6
        ticks += needle.move(
            rng.uniform(-0.005, 0.085) if some[0] else needle.depth,
            leaning(*rng.uniform(-0.25, 0.25, 2)) if some[1] else needle.axis,
            rng.uniform(-0.012, 0.012) if some[2] else needle.breath,
        )
        assert is_passive(needle)
    assert needle.out.sum() < 0.0
    assert needle.state[sv.PUNCTURES] > 100.0


@pytest.mark.long("machine")
def test_the_count_of_energy_would_see_a_law_that_gives_out() -> None:
    """Cutting that pulls the needle in with 0.5 N besides, and costs nothing on the way out."""
    needle = PushedNeedle()
    number = next(n for n, stage in enumerate(needle.stages) if stage.name == "cutting")
    before = needle.stages[number]

    def pull(state: FloatArray, parameters: FloatArray) -> None:
        before.function(state, parameters)
        state[sv.AXIAL_FORCE] -= 0.5 if state[sv.PLANT_DEPTH] > needle.depth else 0.0

    needle.stages[number] = Stage(before.name, pull, before.parameters)
    for _ in range(3):
        needle.move(0.06, needle.axis, 0.0)
        needle.move(0.0, needle.axis, 0.0)
    assert not is_passive(needle)


def test_the_count_of_energy_would_see_a_tenth_of_a_millijoule() -> None:
    """Pressing that gives out 0.1 mJ more than it holds on 5 mm of a way back."""
    for fault, passive in ((0.0, True), (1e-4, False)):
        needle = PushedNeedle()
        number = next(n for n, stage in enumerate(needle.stages) if stage.name == "relaxation")
        before = needle.stages[number]

        def give(
            state: FloatArray,
            parameters: FloatArray,
            needle: PushedNeedle = needle,
            before: Stage = before,
            force: float = fault / 0.005,
        ) -> None:
            before.function(state, parameters)
            state[sv.AXIAL_FORCE] += force if state[sv.PLANT_DEPTH] < needle.depth else 0.0

        needle.stages[number] = Stage(before.name, give, before.parameters)
        needle.move(STRONGEST_PRESSING, needle.axis, 0.0)
        needle.move(STRONGEST_PRESSING - 0.005, needle.axis, 0.0)
        assert is_passive(needle) is passive


@pytest.mark.parametrize("u", [0.1, 0.6931471805599453, 1.0, 1.5, 1.7, 5.0])
def test_a_push_by_way_and_back_gives_out_the_derived_part_of_what_it_holds(u: float) -> None:
    """By quadrature of both ways, with scipy: most at ln 2, none from 1.59 on."""
    took = quad(lambda x: 1.0 - np.exp(-x), 0.0, u)[0]
    gives = quad(lambda x: (1.0 - np.exp(-u)) * np.exp(-x), 0.0, np.inf)[0]
    assert gives - took == pytest.approx(2.0 * (1.0 - np.exp(-u)) - u, abs=1e-9)
    assert gives - took <= 1.0 - np.log(2.0) + 1e-12
    assert (gives > took) == (u < 1.5936)
    force, given_out = 0.0, 0.0
    for travel in (*np.full(2000, u / 2000), *np.full(20000, -1e-3)):
        after = approach(force, 1.0 if travel > 0.0 else 0.0, abs(travel))
        given_out -= 0.5 * (force + after) * travel
        force = after
    assert given_out == pytest.approx(gives - took, abs=1e-4)
