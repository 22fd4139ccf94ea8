"""The root of every error that Acus raises on purpose."""


class AcusError(Exception):
    """Something the user can act on.

    The message says what happened, the value, the limit or the valid names, and what to do. The
    families stand beside the code that raises them (`imaging.errors`, `device.errors`, ...). The
    command line prints the message in one line and ends with exit code 2; the window shows it.
    """


class ConfigurationError(AcusError, ValueError):
    """A settings, profile or exercise file says something that cannot be used."""


class NumericalError(AcusError, ArithmeticError):
    """An input for which no finite answer exists (NaN, infinite or outside the domain)."""
