"""What a provider is asked: its discovery document, its keys, and a token for a code.

Nothing that it writes is repeated in messages but its own address and the short names of faults
that RFC 6749 lists: a description may hold a name.
"""

from __future__ import annotations

import json
import re
import ssl
from collections.abc import Mapping
from dataclasses import dataclass
from http.client import HTTPException
from ipaddress import ip_address
from typing import Any, Final
from urllib.parse import quote_plus, urlencode, urlsplit

from app.core.messages import sentence
from app.core.web import WebAnswer, basic, exchange, fault_of_address
from app.core.words import printable
from app.exchange.openid.errors import OpenIdError
from app.exchange.openid.place import OpenIdPlace

ALGORITHMS: Final = ("RS256", "ES256", "EdDSA", "Ed25519")
"""Signatures that are taken; Ed25519 is the name that RFC 9864 gives EdDSA of that curve."""

WELL_KNOWN: Final = "/.well-known/openid-configuration"

_FAULT: Final = re.compile(r"[a-z_]{1,40}")
_MANY_KEYS: Final = 64


@dataclass(frozen=True, slots=True)
class Provider:
    """What the discovery document says.

    Attributes:
        authorize: address that the browser opens.
        token: address that gives a token for a code.
        keys: address of the public keys.
        names_itself: whether answers to the browser say who answers (RFC 9207).
    """

    authorize: str
    token: str
    keys: str
    names_itself: bool


def discover(place: OpenIdPlace) -> Provider:
    """Ask a provider what it offers (OpenID Connect Discovery 1.0, section 4).

    Raises:
        OpenIdError: if it does not answer, is another one than was configured, or lacks something.
    """
    where = place.issuer.rstrip("/") + WELL_KNOWN
    document = _document(place, where, _asked(place, "GET", where))
    issuer = document.get("issuer")
    if issuer != place.issuer:
        raise OpenIdError(
            sentence(
                "{where} is the document of the issuer {other!r}, not of {issuer!r}: if that is "
                "the hospital's, give it letter by letter",
                where=where,
                other=_shown(issuer),
                issuer=place.issuer,
            )
        )
    authorize, token, keys = (
        _endpoint(place, document, name)
        for name in ("authorization_endpoint", "token_endpoint", "jwks_uri")
    )
    for name, taken in (
        ("id_token_signing_alg_values_supported", ALGORITHMS),
        ("code_challenge_methods_supported", ("S256",)),
        ("response_types_supported", ("code",)),
    ):
        offered = document.get(name, list(taken))  # what it does not say is tried
        if not isinstance(offered, list) or not set(map(str, offered)) & set(taken):
            raise OpenIdError(
                sentence(
                    "{name} offers none of {taken} ({field}): ask who runs it to allow one for "
                    "this client",
                    name=place.name,
                    taken=", ".join(taken),
                    field=name,
                )
            )
    names_itself = document.get("authorization_response_iss_parameter_supported") is True
    return Provider(authorize, token, keys, names_itself)


def published_keys(place: OpenIdPlace, provider: Provider) -> list[Mapping[str, Any]]:
    """Return the public keys (RFC 7517) that signatures are held against; asked for each time.

    Raises:
        OpenIdError: if it does not answer, or with no list of keys.
    """
    answer = _asked(place, "GET", provider.keys)
    keys = _document(place, provider.keys, answer).get("keys")
    if not isinstance(keys, list):
        raise _no_answer(place, provider.keys, answer)
    return [key for key in keys[:_MANY_KEYS] if isinstance(key, Mapping)]


def redeemed(
    place: OpenIdPlace, provider: Provider, code: str, verifier: str, redirect: str
) -> str:
    """Return the ID token that the provider gives for a code; the other tokens are let go.

    Args:
        place: of the provider.
        provider: what it offers.
        code: that the browser brought.
        verifier: whose digest went with the question (PKCE).
        redirect: where the browser brought it.

    Raises:
        OpenIdError: if it does not answer, refuses, or gives none.
    """
    form = {
        "grant_type": "authorization_code",
        "code": code,
        "redirect_uri": redirect,
        "client_id": place.client,
        "code_verifier": verifier,
    }
    answer = _asked(place, "POST", provider.token, urlencode(form).encode(), (200, 400, 401))
    document = _document(place, provider.token, answer)
    if answer.status != 200:
        raise OpenIdError(
            sentence(
                "{name} gives no token ({fault}): sign in again; if it stays so, ask who runs it "
                "whether {client!r} is a client with PKCE there, and whether it has a secret",
                name=place.name,
                fault=short_fault(document.get("error")),
                client=place.client,
            )
        )
    token = document.get("id_token")
    if not isinstance(token, str) or not token:
        raise OpenIdError(
            sentence(
                "{name} gives no ID token: ask who runs it to allow {client!r} the scope openid",
                name=place.name,
                client=place.client,
            )
        )
    return token


def short_fault(text: object) -> str:
    """Return the short name of a fault (RFC 6749, 5.2); a question mark for anything else."""
    return text if isinstance(text, str) and _FAULT.fullmatch(text) else "?"


# --- inside ---------------------------------------------------------------------------------------
def _asked(
    place: OpenIdPlace,
    method: str,
    where: str,
    body: bytes | None = None,
    statuses: tuple[int, ...] = (200,),
) -> WebAnswer:
    """Send one request; return an answer that has one of these statuses."""
    headers = {"Accept": "application/json"}
    if body is not None:
        headers["Content-Type"] = "application/x-www-form-urlencoded"
        if place.secret:  # each of both as in a form (RFC 6749, 2.3.1)
            headers |= basic(quote_plus(place.client), quote_plus(place.secret))
    try:
        answer = exchange(method, where, headers, body, place.seconds)
    except ssl.SSLCertVerificationError as error:
        raise OpenIdError(
            sentence(
                "{name} shows a certificate that is not trusted ({reason}): nothing was sent; ask "
                "who runs it, or name its authority by SSL_CERT_FILE",
                name=urlsplit(where).netloc,
                reason=error.verify_message,
            )
        ) from error
    except (OSError, HTTPException) as error:
        raise OpenIdError(
            sentence(
                "{where} does not answer, or not to the end, within {seconds:g} s: sign in by "
                "pseudonym and PIN, and try again later",
                where=where,
                seconds=place.seconds,
            )
        ) from error
    if 300 <= answer.status < 400:
        raise OpenIdError(
            sentence(
                "{where} sends on to {other}: it was not followed; if the provider is there, give "
                "that address as issuer",
                where=where,
                other=answer.elsewhere,
            )
        )
    if answer.status not in statuses:
        raise _no_answer(place, where, answer)
    return answer


def _document(place: OpenIdPlace, where: str, answer: WebAnswer) -> Mapping[str, Any]:
    try:
        document = json.loads(answer.body)
    except (ValueError, RecursionError):
        document = None
    if not isinstance(document, Mapping):
        raise _no_answer(place, where, answer)
    return document


def _endpoint(place: OpenIdPlace, document: Mapping[str, Any], name: str) -> str:
    """Return an address of the document, held to what the issuer's own is held to."""
    address = document.get(name)
    text = address if isinstance(address, str) else ""
    fault = fault_of_address(text.partition("?")[0])
    here = _is_here(place.issuer)
    if not fault and _is_here(text) and not here:
        fault = sentence(
            "{address} is this computer, which the provider is not", address=_shown(text)
        )
    if not fault and urlsplit(text).scheme == "http" and not here:
        fault = sentence("{address} is plain http", address=_shown(text))
    if fault or "#" in text:
        raise OpenIdError(
            sentence(
                "the document of {issuer} cannot be used, its {field}: {fault}; ask who runs it",
                issuer=place.issuer,
                field=name,
                fault=fault or _shown(text),
            )
        )
    return text


def _is_here(address: str) -> bool:
    host = urlsplit(address).hostname or ""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def _no_answer(place: OpenIdPlace, where: str, answer: WebAnswer) -> OpenIdError:
    return OpenIdError(
        sentence(
            "what answers at {where} is no provider of OpenID Connect, or cannot now ({status}): "
            "sign in by pseudonym and PIN; if it stays so, look at the issuer {issuer}",
            where=where,
            status=answer.status,
            issuer=place.issuer,
        )
    )


def _shown(text: object) -> str:
    return printable(str(text))[:120]
