"""Errors of reading and writing other people's formats."""

from app.core.errors import AcusError


class ExchangeError(AcusError):
    """Root of the exchange errors."""


class MarkupsError(ExchangeError, ValueError):
    """A markups file that holds no usable plan; names the file, the field and the value."""


class ExportError(ExchangeError):
    """An export that cannot be written."""


class UrdfError(ExchangeError, ValueError):
    """A URDF that does not describe a needle pantograph; names the file, the part and the value."""


class TransformError(ExchangeError, ValueError):
    """A transform file that holds no rigid transform; names the file and what is wrong."""


class MarkSheetError(ExchangeError, ValueError):
    """A sheet of judges or examiners that cannot be used; names file, row, column and value."""


class LinkAddressError(ExchangeError, ValueError):
    """An address, port, token or list of a live link that cannot be used."""


class LinkMessageError(ExchangeError, ValueError):
    """A message of a peer that is not as its protocol says; names the field and the value."""
