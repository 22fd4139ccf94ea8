"""Sign-in by the hospital: OpenID Connect beside the PIN, where a station is told of a provider.

The authorization code flow of a native app (RFC 8252): PKCE (RFC 7636), the system's browser, a
listener on this computer that takes one answer. What stays is a salted digest of who somebody is
there; no name, no address, no token.

The door: `OpenIdPlace`, where the provider is and what its groups mean; `ask`, which begins a
sign-in; `enter`, `link` and `give_role`, which make somebody of this station of it.
"""

from app.exchange.openid.errors import OpenIdError
from app.exchange.openid.links import (
    Entered,
    enter,
    give_role,
    link,
    linked_keys,
    unlink,
)
from app.exchange.openid.place import OpenIdPlace, is_configured, place_of_openid, put_openid
from app.exchange.openid.provider import discover, published_keys
from app.exchange.openid.question import PATIENCE, Question, ask
from app.exchange.openid.roles import HospitalIdentity, StationRole
from app.exchange.openid.tokens import require_joserfc

__all__ = [
    "PATIENCE",
    "Entered",
    "HospitalIdentity",
    "OpenIdError",
    "OpenIdPlace",
    "Question",
    "StationRole",
    "ask",
    "discover",
    "enter",
    "give_role",
    "is_configured",
    "link",
    "linked_keys",
    "place_of_openid",
    "published_keys",
    "put_openid",
    "require_joserfc",
    "unlink",
]
