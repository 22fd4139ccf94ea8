"""Compile a scene: keep the effects that somebody consumes, say why, put them in order.

Demand is walked back from the consumers: an effect is kept when it writes a slot that a consumer
reads, and what a kept effect reads is then itself demanded. Nothing is imported here.
"""

from collections.abc import Sequence
from graphlib import CycleError, TopologicalSorter

from app.core import state_vector as sv
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.effects import Effect, declaration
from app.simulation.errors import SimulationError
from app.simulation.plan import DroppedEffect, KeptEffect, SimulationPlan
from app.simulation.scene import EffectRequest, Scene


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
    declared = {request.name: declaration(request.name) for request in scene.effects}
    checked = {r.name: _checked(r, declared[r.name]) for r in scene.effects}
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


def _checked(request: EffectRequest, declared: Effect) -> tuple[str, dict[str, float]]:
    return declared.model(request.model), declared.checked(request.parameters)


def _senseless(request: EffectRequest, declared: Effect, scene: Scene) -> str:
    """Why the scene itself has no use for an effect; empty if it has."""
    for need in declared.needs:
        if not getattr(scene, need):
            return f"dropped: it needs {need}, and the scene has none"
    if request.organ and scene.target_organ and request.organ != scene.target_organ:
        return f"dropped: it acts on {request.organ}, and the target lies in {scene.target_organ}"
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
                c.label for c in reading if set(c.reads) & set(d.writes) and c.label != _feeds(name)
            )
            for name, d in candidates.items()
        }
        grown = {name: who for name, who in labels.items() if who}
        if grown == found:
            return found
        found = grown
        reading = [*consumers, *(Consumer(_feeds(name), candidates[name].reads) for name in found)]


def _feeds(name: str) -> str:
    return f"effect {name} builds on it"


def _because(declared: Effect, consumers: tuple[str, ...]) -> str:
    return f"simulated: it writes {_slots(declared.writes)}; {'; '.join(consumers)}"


def _nobody(declared: Effect, device: DevicePort) -> str:
    axes = ", ".join(sorted(device.renders)) or "no"
    return (
        f"dropped: it writes {_slots(declared.writes)}, which nobody reads: device {device.name} "
        f"renders {axes} force, and no view, metric or other effect asks for it"
    )


def _slots(names: Sequence[str]) -> str:
    """`force_x, force_y, force_z` -> `force`; the axes of one vector are one thing."""
    stems = [name[:-2] if name.endswith(("_x", "_y", "_z")) else name for name in names]
    return ", ".join(dict.fromkeys(stems))


def _ordered(kept: dict[str, Effect]) -> list[str]:
    """Writers before readers; otherwise in the scene's order.

    Raises:
        SimulationError: naming the effects that need each other's results.
    """
    sorter: TopologicalSorter[str] = TopologicalSorter()
    for name, reader in kept.items():
        writers = [
            other
            for other, d in kept.items()
            if other != name and set(d.writes) & set(reader.reads)
        ]
        sorter.add(name, *writers)
    try:
        return list(sorter.static_order())
    except CycleError as error:
        circle = " -> ".join(error.args[1])
        raise SimulationError(
            f"effects need each other's results in a circle: {circle}; take one of them out"
        ) from error
