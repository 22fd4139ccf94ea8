"""Arrays of parameters of an effect, at its defaults but for what a test gives."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace

from app.core.arrays import FloatArray
from app.simulation.effects import declaration, parameters_of
from app.simulation.scene import DEFAULT_LAYERS, Binding, EffectRequest, Scene, TissueLayer


def memory_of(name: str, given: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array; what is given is not held to its range."""
    defaults = {key: limit.default for key, limit in declaration(name).parameters.items()}
    return parameters_of(name, defaults | dict(given), binding)  # type: ignore[arg-type]


def whole_scene(requests: Sequence[EffectRequest], bone_depth: float) -> Scene:
    """Return a scene that has whatever an effect may need: all layers, and bone at a depth [m]."""
    *above, last = DEFAULT_LAYERS
    thickness = bone_depth - sum(layer.thickness for layer in above)
    layers = [*above, replace(last, thickness=thickness)]
    if "rigid" in (field.name for field in fields(TissueLayer)):
        layers.append(TissueLayer("bone", 0.1, rigid=True))  # type: ignore[call-arg,unused-ignore]
    return Scene(effects=tuple(requests), layers=tuple(layers))
