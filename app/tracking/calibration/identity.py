"""Names of calibrations: what an attempt stores and the history keeps them under."""

import secrets
from datetime import UTC, datetime


def new_id(created: datetime) -> str:
    """Return a new id: UTC date and time, and four random hexadecimal digits."""
    return f"{created.astimezone(UTC):%Y%m%d-%H%M%S}-{secrets.token_hex(2)}"
