"""What can go wrong with a sign-in by the hospital."""

from app.exchange.errors import ExchangeError


class OpenIdError(ExchangeError):
    """The provider refuses, does not answer, or answers what cannot be trusted; says what to do."""
