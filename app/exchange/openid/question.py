"""One sign-in from its beginning to its end: asked in the browser, answered to this computer."""

from __future__ import annotations

import base64
import hashlib
import secrets
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final
from urllib.parse import urlencode

from app.core.messages import sentence
from app.core.progress import Progress
from app.exchange.openid.errors import OpenIdError
from app.exchange.openid.listener import Listener
from app.exchange.openid.place import OpenIdPlace
from app.exchange.openid.provider import (
    Provider,
    discover,
    published_keys,
    redeemed,
    short_fault,
)
from app.exchange.openid.roles import HospitalIdentity, role_by_groups
from app.exchange.openid.tokens import claims_of, require_joserfc

PATIENCE: Final = 300.0
"""A question waits so long for its answer [s]."""

_LOOK_S: Final = 0.1


@dataclass(frozen=True)
class Question:
    """A sign-in that waits for its answer.

    Attributes:
        place: of the provider.
        provider: what it offers.
        listener: that waits.
        nonce: that the token has to hold.
        verifier: of PKCE; known here alone until the code is redeemed.
        begun: when it was asked, wall-clock [s].
    """

    place: OpenIdPlace
    provider: Provider
    listener: Listener
    begun: float
    nonce: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)
    verifier: str = field(default_factory=lambda: secrets.token_urlsafe(48), repr=False)

    @property
    def address(self) -> str:
        """Return what the browser opens."""
        digest = hashlib.sha256(self.verifier.encode()).digest()
        fields = {
            "response_type": "code",
            "client_id": self.place.client,
            "redirect_uri": self.listener.redirect,
            "scope": "openid",
            "state": self.listener.state,
            "nonce": self.nonce,
            "code_challenge": base64.urlsafe_b64encode(digest).rstrip(b"=").decode(),
            "code_challenge_method": "S256",
            "prompt": "login",  # a station is shared: whoever was there before has gone
        }
        sign = "&" if "?" in self.provider.authorize else "?"
        return f"{self.provider.authorize}{sign}{urlencode(fields)}"

    def identity(
        self, progress: Progress | None = None, patience: float = PATIENCE
    ) -> HospitalIdentity:
        """Wait for the answer, redeem it, and return who that is; ends the question.

        Args:
            progress: asked again and again whether to go on waiting.
            patience: seconds to wait for the answer.

        Raises:
            OpenIdError: if none comes, the provider refuses, or what it says is not believed.
            Cancelled: if that was asked for.
        """
        try:
            answer = self._answer(progress or Progress(), patience)
        finally:
            self.close()
        if self.provider.names_itself or "iss" in answer:
            self._hold_issuer(answer)
        if "error" in answer:
            raise OpenIdError(
                sentence(
                    "{name} did not sign you in ({fault}): try again, or sign in by pseudonym and "
                    "PIN",
                    name=self.place.name,
                    fault=short_fault(answer["error"]),
                )
            )
        redirect = self.listener.redirect
        token = redeemed(self.place, self.provider, answer["code"], self.verifier, redirect)
        keys = published_keys(self.place, self.provider)
        claims = claims_of(token, keys, self.place, self.nonce, self.begun, time.time())
        allowed = role_by_groups(claims, self.place.claim, self.place.groups)
        return HospitalIdentity(self.place.issuer, claims["sub"], allowed)

    def close(self) -> None:
        """Wait no more; idempotent."""
        self.listener.close()

    def _answer(self, progress: Progress, patience: float) -> Mapping[str, str]:
        end = time.monotonic() + patience
        while time.monotonic() < end:
            progress.check()
            answer = self.listener.wait(_LOOK_S)
            if answer is not None:
                return answer
        if self.listener.refused:
            raise OpenIdError(
                sentence(
                    "no answer of {name} came, but what belongs to another question, and was "
                    "refused: try again, and sign in on the page that opens then",
                    name=self.place.name,
                )
            )
        raise OpenIdError(
            sentence(
                "nobody signed in at {name} within {minutes:g} min: try again, or sign in by "
                "pseudonym and PIN",
                name=self.place.name,
                minutes=patience / 60.0,
            )
        )

    def _hold_issuer(self, answer: Mapping[str, str]) -> None:
        """Refuse an answer that says it is another provider's (RFC 9207)."""
        if answer.get("iss") != self.place.issuer:
            raise OpenIdError(
                sentence(
                    "the answer in the browser is not of {issuer}: nobody was signed in; try "
                    "again, and if it stays so ask who runs it",
                    issuer=self.place.issuer,
                )
            )


def ask(place: OpenIdPlace, done: str, wrong: str) -> Question:
    """Begin a sign-in: ask what the provider offers, and listen for the browser.

    Args:
        place: of the provider.
        done: what the browser shows in the end, in the user's language.
        wrong: what it shows of anything else.

    Raises:
        OpenIdError: if the provider cannot be asked, or this computer cannot listen.
    """
    require_joserfc()
    begun, provider = time.time(), discover(place)
    listener = Listener(done, wrong)
    try:
        listener.open()
    except OSError as error:
        raise OpenIdError(
            sentence(
                "this computer cannot listen for the browser ({reason}): sign in by pseudonym and "
                "PIN",
                reason=error.strerror or error,
            )
        ) from error
    return Question(place, provider, listener, begun)
