"""Arrays of parameters of an effect, at its defaults but for what a test gives."""

from collections.abc import Mapping

from app.core.arrays import FloatArray
from app.simulation.effects import declaration, parameters_of
from app.simulation.scene import Binding


def memory_of(name: str, given: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array; what is given is not held to its range."""
    defaults = {key: limit.default for key, limit in declaration(name).parameters.items()}
    return parameters_of(name, defaults | dict(given), binding)  # type: ignore[arg-type]
