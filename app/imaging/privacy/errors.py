"""Why a file is not taken into the library, or a key not used."""

from app.imaging.errors import ImagingError


class PrivacyError(ImagingError):
    """Root of the errors of de-identification; no message quotes a header's value."""


class KeyDamagedError(PrivacyError, ValueError):
    """The key of this installation cannot be read, written or used."""


class BurnedInError(PrivacyError, ValueError):
    """The picture itself carries, or may carry, writing about the patient."""


class AnnotatedError(BurnedInError):
    """The files say that there is writing in the pictures, and nobody has drawn over it."""


class NotCleanError(PrivacyError, ValueError):
    """The second pass found in a written file what should not be there."""
