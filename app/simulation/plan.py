"""Compile a scene: keep the effects that somebody consumes, say why, put them in order.

Demand is walked back from the consumers: an effect is kept when it writes a slot that a consumer
reads, and what a kept effect reads is then itself demanded. Nothing is imported here.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.parameters import Stage
from app.simulation.consumers import IN_WORDS, Consumer, DevicePort
from app.simulation.effects import Effect, array_of, declaration, load
from app.simulation.errors import SimulationError
from app.simulation.scene import Binding, EffectRequest, Scene

TISSUE_FIELD: Final = "tissue_field"
"""Effect that looks the tissue up where the scene has a field of it."""


@dataclass(frozen=True, slots=True)
class KeptEffect:
    """An effect that is simulated: with which model, which parameters, for whom, and why."""

    declaration: Effect
    model: str
    parameters: dict[str, float]
    consumers: tuple[str, ...]
    why: str

    @property
    def name(self) -> str:
        """Name of the effect."""
        return self.declaration.name

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for each parameter outside its range in the literature."""
        return self.declaration.unpublished(self.parameters)


@dataclass(frozen=True, slots=True)
class DroppedEffect:
    """An effect that was asked for and is not simulated, and why."""

    name: str
    why: str


@dataclass(frozen=True, slots=True)
class SimulationPlan:
    """What is simulated, in the order in which it runs, and what is not.

    Attributes:
        scene: what was compiled.
        kept: effects in running order.
        dropped: effects without a consumer, in the scene's order.
        depth_slot: slot that effects along the needle take the depth from.
    """

    scene: Scene
    kept: tuple[KeptEffect, ...]
    dropped: tuple[DroppedEffect, ...]
    depth_slot: int

    def stages(self) -> list[Stage]:
        """Import what is kept in the tick and return its stages, each with fresh memory.

        They add to FORCE_*, which the device's table clears, and to AXIAL_FORCE and
        TARGET_SHIFT_*, which the first of these stages clears. Nothing kept: no stages.
        """
        ticking = [kept for kept in self.kept if not kept.declaration.pictures]
        if not ticking:
            return []
        from app.simulation.clearing import clear  # compiled; the plan itself is needed sooner

        first = Stage("clear_effects", clear, np.zeros(1))
        stages = [first, *(self.stage(kept) for kept in ticking)]
        return [*stages, *(_behind(stage) for stage in stages if stage.name == TISSUE_FIELD)]

    def pictures(self) -> dict[str, FloatArray]:
        """Return what acts on the pictures of simulated cameras, in order: name -> parameters.

        `tracking.simulated.picture_effects` knows by the name what to do with them.
        """
        return {
            kept.name: array_of(kept.declaration, kept.parameters, self._binding(kept, kept.model))
            for kept in self.kept
            if kept.declaration.pictures
        }

    def energy_bound(self) -> float:
        """Return the most energy that the kept effects can store behind FORCE_* together [J].

        An effect that does not say (no function `energy_bound(parameters)` in its file) counts as
        active: it gets no share, and what it gives out is paid by the others.

        Raises:
            SimulationError: if an effect's own bound is no finite number of 0 or more.
        """
        return sum(self._bound(kept) for kept in self.kept)

    def warnings(self) -> dict[str, tuple[str, ...]]:
        """Return for each kept effect what to know of it before its forces are believed.

        Parameters outside their range in the literature, and what its file says of this scene
        (a function `warnings(values, binding)`).
        """
        found = {}
        for kept in self.kept:
            if kept.declaration.pictures:
                found[kept.name] = kept.warnings
                continue
            module, binding = load(kept.declaration), self._binding(kept, kept.model)
            own = module.warnings(kept.parameters, binding) if hasattr(module, "warnings") else ()
            found[kept.name] = (*kept.warnings, *own)
        return found

    def _bound(self, stored: KeptEffect) -> float:
        if stored.declaration.pictures:
            return 0.0
        module = load(stored.declaration)
        if not hasattr(module, "energy_bound"):
            return 0.0
        bound = float(module.energy_bound(self.stage(stored)[2]))
        if not 0.0 <= bound < math.inf:
            raise SimulationError(
                sentence(
                    "effect {stored_name}: energy_bound is {bound} J; give a finite number of 0 "
                    "or more",
                    stored_name=stored.name,
                    bound=bound,
                )
            )
        return bound

    def _binding(self, stored: KeptEffect, model: str) -> Binding:
        return Binding(self.scene, self.depth_slot, model)

    def stage(self, stored: KeptEffect, model: str = "") -> Stage:
        """Import a kept effect and return its stage with fresh memory, by its own or another model.

        Raises:
            SimulationError: if its file cannot be used.
        """
        binding = self._binding(stored, model or stored.model)
        array = array_of(stored.declaration, stored.parameters, binding)
        return Stage(stored.name, load(stored.declaration).step, array)


def compile(
    scene: Scene,
    device: DevicePort,
    views: Sequence[Consumer] = (),
    scoring: Sequence[Consumer] = (),
) -> SimulationPlan:
    """Return what has to be simulated for this device, these views and this scoring.

    Raises:
        SimulationError: for an unknown effect, model or parameter, a value out of range, or
            effects that need each other's results in a circle.
    """
    consumers = (*device.consumers(), *views, *scoring)
    read = {request.name: declaration(request.name) for request in scene.effects}
    checked = {r.name: _checked(r, read[r.name]) for r in scene.effects}
    declared = {name: one.by(checked[name][0]) for name, one in read.items()}
    dropped = {
        request.name: why
        for request in scene.effects
        if (why := _senseless(request, declared[request.name], scene))
    }
    candidates = {name: d for name, d in declared.items() if name not in dropped}
    demanded = _demanded(candidates, consumers)
    for name in candidates:
        if name not in demanded:
            dropped[name] = _nobody(candidates[name], device)
    kept = [
        KeptEffect(
            declared[name], *checked[name], demanded[name], _because(declared[name], demanded[name])
        )
        for name in _ordered({name: declared[name] for name in candidates if name in demanded})
    ]
    return SimulationPlan(
        scene=scene,
        kept=tuple(kept),
        dropped=tuple(
            DroppedEffect(r.name, dropped[r.name]) for r in scene.effects if r.name in dropped
        ),
        depth_slot=sv.PLANT_DEPTH if device.simulated else sv.DEPTH,
    )


def _behind(stage: Stage) -> Stage:
    """Return what keeps the bend of a tick for the next one's look into the field."""
    from app.simulation.effects.tissue_field import keep_bend  # compiled

    return Stage("keep_bend", keep_bend, stage.parameters)


def _checked(request: EffectRequest, declared: Effect) -> tuple[str, dict[str, float]]:
    return declared.model(request.model), declared.checked(request.parameters)


def _senseless(request: EffectRequest, declared: Effect, scene: Scene) -> str:
    """Return why the scene itself has no use for an effect; empty if it has."""
    for need in declared.needs:
        if not getattr(scene, need):
            return sentence("dropped: it needs {need}, and the scene has none", need=need)
    if request.organ and scene.target_organ and request.organ != scene.target_organ:
        return sentence(
            "dropped: it acts on {request_organ}, and the target lies in {scene_target_organ}",
            request_organ=request.organ,
            scene_target_organ=scene.target_organ,
        )
    return ""


def _demanded(
    candidates: dict[str, Effect], consumers: Sequence[Consumer]
) -> dict[str, tuple[str, ...]]:
    """Effect -> labels of its consumers, for the effects that have one, walked to the fixpoint."""
    found: dict[str, tuple[str, ...]] = {}
    reading = list(consumers)
    while True:
        labels = {
            name: tuple(
                c.label for c in reading if set(c.reads) & set(d.gives) and c.label != _feeds(name)
            )
            for name, d in candidates.items()
        }
        grown = {name: who for name, who in labels.items() if who}
        if grown == found:
            return found
        found = grown
        reading = [*consumers, *(Consumer(_feeds(name), candidates[name].reads) for name in found)]


def _feeds(name: str) -> str:
    return sentence("effect {name} builds on it", name=name)


def _because(declared: Effect, consumers: tuple[str, ...]) -> str:
    return sentence(
        "simulated: it gives {in_words}; {consumers}",
        in_words=_in_words(declared.gives),
        consumers="; ".join(consumers),
    )


def _nobody(declared: Effect, device: DevicePort) -> str:
    if declared.pictures:
        return sentence(
            "dropped: it changes the pictures of simulated cameras, and there are none: the"
            " cameras are real, and so are their pictures"
        )
    axes = ", ".join(sorted(device.renders)) or "no"
    return sentence(
        "dropped: it gives {in_words}, and nobody asks for that: device {device_name} "
        "renders {axes} force, and no view that is shown, no metric that is scored and no "
        "other effect needs it",
        in_words=_in_words(declared.writes),
        device_name=device.name,
        axes=axes,
    )


def _in_words(slots: Sequence[str]) -> str:
    """Say what slots hold, each thing once; the axes of one vector are one thing."""
    stems = [name[:-2] if name.endswith(("_x", "_y", "_z")) else name for name in slots]
    words = [IN_WORDS.get(stem, stem.replace("_", " ")) for stem in stems]
    named = [word for word in dict.fromkeys(words) if word] or [
        sentence("nothing but its own account")
    ]
    return " and ".join([", ".join(named[:-1]), named[-1]] if len(named) > 1 else named)


def _ordered(stored: dict[str, Effect]) -> list[str]:
    """Writers before readers; otherwise in the scene's order.

    Raises:
        SimulationError: naming the effects that need each other's results.
    """
    sorter: TopologicalSorter[str] = TopologicalSorter()
    for name, reader in stored.items():
        writers = [
            other
            for other, d in stored.items()
            if other != name and set(d.writes) & set(reader.reads)
        ]
        sorter.add(name, *writers)
    try:
        return list(sorter.static_order())
    except CycleError as error:
        circle = " -> ".join(error.args[1])
        raise SimulationError(
            sentence(
                "effects need each other's results in a circle: {circle}; take one of them out",
                circle=circle,
            )
        ) from error
