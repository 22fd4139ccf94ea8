"""Errors of the mechanisms: a pose that the mechanism cannot take, or a map that does not exist."""

from app.core.errors import AcusError, NumericalError


class MechanismError(AcusError):
    """A mechanism cannot do what was asked of it."""


class UnreachableError(MechanismError):
    """No joint angles reach the point, or the links cannot meet."""


class SingularError(MechanismError):
    """The mechanism stands where its Jacobian or its assembly is not defined."""


class NoGripError(MechanismError):
    """Nothing of the needle is left above the fulcrum to hold (L_in ≥ needle length)."""


class DegenerateError(MechanismError):
    """The needle has no direction, or lies in the plane of its tool point."""


class NotFiniteError(MechanismError, NumericalError):
    """An angle, a point or a force is NaN or infinite."""
