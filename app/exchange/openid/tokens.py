"""An ID token is believed if its signature and each of its claims hold (OpenID Connect, 3.1.3.7).

`joserfc` verifies; this says against which key, by which algorithms, and with what is expected.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from app.core.extras import not_installed
from app.core.messages import sentence
from app.exchange.openid.errors import OpenIdError
from app.exchange.openid.place import OpenIdPlace
from app.exchange.openid.provider import ALGORITHMS

if TYPE_CHECKING:
    from joserfc.jwk import KeySet

LEEWAY: Final = 60
"""So far the clocks of station and provider may be apart [s]."""

_KEY_TYPES: Final = {"RSA": "RS256", "EC": "ES256", "OKP": "EdDSA"}
_LEAST_BITS: Final = 2048
_LONGEST_SUBJECT: Final = 255  # OpenID Connect, section 2


def claims_of(
    token: str,
    keys: Sequence[Mapping[str, Any]],
    place: OpenIdPlace,
    nonce: str,
    begun: float,
    now: float,
) -> Mapping[str, Any]:
    """Return the claims of an ID token that holds in every respect.

    Args:
        token: compact (RFC 7515).
        keys: that the provider publishes, as JWK.
        place: whose issuer and client it has to name.
        nonce: that went with the question.
        begun: when the question was asked, wall-clock [s]: who signed in long before was not asked.
        now: wall-clock [s].

    Raises:
        OpenIdError: naming what does not hold.
    """
    require_joserfc()
    from joserfc import errors, jwt
    from joserfc.jws import JWSRegistry

    registry = JWSRegistry(algorithms=ALGORITHMS, strict_check_header=False)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", errors.SecurityWarning)  # EdDSA's name is an older one
            decoded = jwt.decode(token, _key_set(keys), ALGORITHMS, registry)
        claims = decoded.claims
        expected = jwt.JWTClaimsRegistry(
            now=int(now),
            leeway=LEEWAY,
            iss={"essential": True, "value": place.issuer},
            sub={"essential": True},
            aud={"essential": True, "value": place.client},
            exp={"essential": True},
            iat={"essential": True},
            nonce={"essential": True, "value": nonce},
        )
        expected.validate(claims)
    except errors.MissingClaimError as error:
        raise _lacks(place, error.claim) from None
    except errors.ClaimError as error:
        raise _claim(place, error.claim, isinstance(error, errors.ExpiredTokenError)) from None
    except errors.UnsupportedAlgorithmError:
        raise _untrusted(
            place,
            sentence("it is not signed by any of {taken}", taken=", ".join(ALGORITHMS)),
        ) from None
    except (errors.JoseError, ValueError, TypeError, LookupError, RecursionError, OverflowError):
        raise _untrusted(
            place, sentence("no key that it publishes has signed it, or it is damaged")
        ) from None
    _check_rest(claims, place, nonce, begun)
    return claims


def require_joserfc() -> None:
    """Do nothing where tokens can be checked.

    Raises:
        OpenIdError: naming the extra, where the package is missing.
    """
    try:
        import joserfc  # noqa: F401
    except ImportError as error:
        instead = sentence("sign in by pseudonym and PIN")
        raise not_installed(OpenIdError, "joserfc", "school", instead) from error


def _check_rest(claims: Mapping[str, Any], place: OpenIdPlace, nonce: str, begun: float) -> None:
    """Hold what a registry of claims does not know: who asked, when, and for whom."""
    subject, audience = claims["sub"], claims["aud"]
    if not isinstance(subject, str) or not 0 < len(subject) <= _LONGEST_SUBJECT:
        raise _lacks(place, "sub")
    if claims["nonce"] != nonce:  # a registry of claims takes a list that holds it
        raise _claim(place, "nonce")
    if "azp" in claims and claims["azp"] != place.client:
        raise _claim(place, "azp")
    if isinstance(audience, list) and len(audience) > 1 and "azp" not in claims:
        raise _claim(place, "aud")
    asked = claims.get("auth_time")
    if asked is None:
        return
    if isinstance(asked, bool) or not isinstance(asked, int | float):
        raise _lacks(place, "auth_time")
    if not asked >= begun - LEEWAY:
        raise OpenIdError(
            sentence(
                "{name} did not ask who is here, but took who had signed in before (auth_time): "
                "sign out there in the browser, and try again",
                name=place.name,
            )
        )


def _key_set(keys: Sequence[Mapping[str, Any]]) -> KeySet:
    """Return the keys that may have signed: public ones of the right kind, long enough."""
    from joserfc.errors import JoseError, MissingKeyError
    from joserfc.jwk import JWKRegistry, KeySet, RSAKey

    usable = []
    for key in keys:
        kind = key.get("kty")
        if kind not in _KEY_TYPES or key.get("use", "sig") != "sig":
            continue
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of short keys, which are left out below
                public = JWKRegistry.import_key({name: key[name] for name in key if name != "d"})
                if isinstance(public, RSAKey) and public.public_key.key_size < _LEAST_BITS:
                    continue
        except (JoseError, ValueError, TypeError, LookupError):
            continue  # a key that nobody can use is no fault of the others
        usable.append(public)
    if not usable:
        raise MissingKeyError
    return KeySet(usable)


def _claim(place: OpenIdPlace, name: str, expired: bool = False) -> OpenIdError:
    """Return what to say of a claim that does not hold."""
    if expired or name in ("iat", "nbf", "exp"):
        reason = sentence(
            "its time is over or not yet come ({name}): look at this computer's clock", name=name
        )
    elif name == "nonce":
        reason = sentence("it answers another question ({name})", name=name)
    elif name in ("aud", "azp"):
        reason = sentence("it is for another program ({name})", name=name)
    elif name == "iss":
        reason = sentence("another provider made it ({name})", name=name)
    else:
        return _lacks(place, name)
    return _untrusted(place, reason)


def _lacks(place: OpenIdPlace, name: str) -> OpenIdError:
    return _untrusted(place, sentence("it lacks {name}, or holds nonsense there", name=name))


def _untrusted(place: OpenIdPlace, reason: str) -> OpenIdError:
    return OpenIdError(
        sentence(
            "the token of {name} is not believed: {reason}; nobody was signed in: try again, and "
            "if it stays so ask who runs it",
            name=place.name,
            reason=reason,
        )
    )
