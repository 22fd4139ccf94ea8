"""Errors of the device room."""

from app.core.errors import AcusError


class DeviceError(AcusError):
    """The robot or its loop cannot do what was asked."""


class LoopError(DeviceError):
    """The control loop is in the wrong state for the call, or has ended with an error."""


class LinkError(DeviceError):
    """Port, wire or board cannot be used; the message says how to mend it."""


class LawError(DeviceError):
    """A force law does not exist, its file is broken, or a parameter cannot be used."""


class BoardVersionError(LinkError):
    """The board speaks another version of the protocol than the program."""


class UnknownInputError(DeviceError, KeyError):
    """A name that is not an input of the loop."""

    def __str__(self) -> str:
        """Return the message without the quotes that KeyError adds."""
        return str(self.args[0])


class RerunError(DeviceError):
    """A table does not fit the checkpoint that it shall continue from."""


class CommissioningError(DeviceError):
    """A routine found something wrong; the message says what, and what to do."""


class RecordError(DeviceError):
    """The record of a device cannot be read or written; the file stays as it is."""
