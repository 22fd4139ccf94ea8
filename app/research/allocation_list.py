"""The list of allocations: made from a seed, sealed, opened one place at a time.

Draws come from HMAC-SHA256 in counter mode (as in NIST SP 800-90A, without reseeding), so that a
list is the same on every machine and with every version of every library, and nobody who knows a
part of it can go on with it. The sealed file holds no seed in the clear, and every place is
encrypted by itself to the same length: without the station's key it tells how long the lists are
and nothing else. Its commitment, SHA-256 of the whole list and a random nonce, can be registered
before the first student: seed and nonce, in the bundle at the end, show that it was this list.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import math
import secrets
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from app.core.messages import sentence
from app.research.design import Method, ResearchDesign
from app.research.errors import ResearchError
from app.session.station import StationKey

FORM: Final = "acus-allocation/1"
_NONCE: Final = 12
_SEED: Final = 32
_PLACE: Final = 2


class Draws:
    """Whole numbers, uniform and reproducible.

    Args:
        seed: 32 bytes.
        purpose: draws for another purpose are others.
    """

    def __init__(self, seed: bytes, purpose: str) -> None:
        self._key = hmac.digest(seed, b"acus allocation\0" + purpose.encode(), "sha256")
        self._counter = 0

    def below(self, n: int) -> int:
        """Return a number from 0 to n - 1, without bias: what would make one is drawn again."""
        limit = (1 << 64) - (1 << 64) % n
        while True:
            text = self._counter.to_bytes(8, "big")
            self._counter += 1
            value = int.from_bytes(hmac.digest(self._key, text, "sha256")[:8], "big")
            if value < limit:
                return value % n

    def shuffled(self, items: Sequence[int]) -> list[int]:
        """Return items in an order drawn at random (Fisher and Yates; Knuth's algorithm P)."""
        order = list(items)
        for last in range(len(order) - 1, 0, -1):
            other = self.below(last + 1)
            order[last], order[other] = order[other], order[last]
        return order


def allocation_lists(design: ResearchDesign, seed: bytes) -> dict[str, list[int]]:
    """Return for each list the places of the arms, as long as all participants could need.

    All lists have one length, whatever their blocks.
    """
    needed = design.participants
    if design.randomisation.method is Method.BLOCKS:
        needed += max(design.block_sizes)
    return {label: _list(design, seed, label, needed) for label in design.randomisation.labels()}


def _list(design: ResearchDesign, seed: bytes, label: str, needed: int) -> list[int]:
    draws = Draws(seed, label)
    shares = [place for place, arm in enumerate(design.arms) for _ in range(arm.ratio)]
    if design.randomisation.method is Method.SIMPLE:
        return [shares[draws.below(len(shares))] for _ in range(needed)]
    places: list[int] = []
    sizes = design.block_sizes
    while len(places) < needed:
        size = sizes[draws.below(len(sizes))]
        places += draws.shuffled(shares * (size // design.unit))
    return places[:needed]


def seed_of(number: int | None) -> bytes:
    """Return the seed of 32 bytes that a number stands for; one drawn at random without it."""
    if number is None:
        return secrets.token_bytes(_SEED)
    return hashlib.sha256(f"acus seed {number}".encode()).digest()


@dataclass(frozen=True, slots=True)
class Opened:
    """What the sealed file hides.

    Attributes:
        seed: of the list.
        nonce: of the commitment.
        salt: of the digests that stand for students.
    """

    seed: bytes
    nonce: bytes
    salt: bytes


def seal(design: ResearchDesign, seed: bytes, key: StationKey) -> dict[str, Any]:
    """Return the sealed list as a JSON-ready mapping."""
    from cryptography.hazmat.primitives.ciphers.aead import AESGCM

    lists = allocation_lists(design, seed)
    cipher = AESGCM(key.derived(_purpose(design.id)))
    opened = Opened(seed, secrets.token_bytes(_SEED), secrets.token_bytes(_SEED))

    def sealed(value: bytes, what: str) -> str:
        nonce = secrets.token_bytes(_NONCE)
        return (nonce + cipher.encrypt(nonce, value, _context(design.id, what))).hex()

    places = {
        label: [
            sealed(place.to_bytes(_PLACE, "big"), f"{label}#{slot}")
            for slot, place in enumerate(places)
        ]
        for label, places in lists.items()
    }
    return {
        "form": FORM,
        "study": design.id,
        "design": design.digest,
        "commitment": commitment(lists, opened.nonce),
        "hidden": sealed(opened.seed + opened.nonce + opened.salt, "hidden"),
        "lists": places,
    }


def commitment(lists: Mapping[str, Sequence[int]], nonce: bytes) -> str:
    """Return the SHA-256 of a whole list and a nonce, hexadecimal."""
    text = json.dumps(lists, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(nonce + text.encode()).hexdigest()


def open_place(document: Mapping[str, Any], label: str, slot: int, key: StationKey) -> int | None:
    """Return the place of the arm in one slot of a list; None beyond its end.

    Raises:
        ResearchError: if the file is damaged, or another station has sealed it.
    """
    try:
        places = document["lists"][label]
        if slot >= len(places):
            return None
        plain = _plain(document, str(places[slot]), f"{label}#{slot}", key)
    except (LookupError, TypeError) as error:
        raise ResearchError(_DAMAGED) from error
    return int.from_bytes(plain, "big")


def open_hidden(document: Mapping[str, Any], key: StationKey) -> Opened:
    """Return seed, nonce and salt.

    Raises:
        ResearchError: if the file is damaged, or another station has sealed it.
    """
    try:
        plain = _plain(document, str(document["hidden"]), "hidden", key)
    except (LookupError, TypeError) as error:
        raise ResearchError(_DAMAGED) from error
    return Opened(plain[:_SEED], plain[_SEED : 2 * _SEED], plain[2 * _SEED :])


def _plain(document: Mapping[str, Any], text: str, what: str, key: StationKey) -> bytes:
    from cryptography.exceptions import InvalidTag
    from cryptography.hazmat.primitives.ciphers.aead import AESGCM

    study = str(document["study"])
    try:
        data = bytes.fromhex(text)
    except ValueError as error:
        raise ResearchError(_DAMAGED) from error
    for secret in (key.secret, *key.former):  # a renewed key opens what the one before sealed
        cipher = AESGCM(StationKey(key.station, secret).derived(_purpose(study)))
        try:
            return cipher.decrypt(data[:_NONCE], data[_NONCE:], _context(study, what))
        except (InvalidTag, ValueError):
            continue
    raise ResearchError(_DAMAGED)


def _purpose(study: str) -> str:
    return f"research {study}"


def _context(study: str, what: str) -> bytes:
    return f"acus allocation\0{study}\0{what}".encode()


def imbalance_bound(design: ResearchDesign) -> int:
    """Return how far two arms of equal ratio may be apart in one list; of blocks half the largest.

    Simple randomisation has no bound but the number of participants.
    """
    if design.randomisation.method is Method.SIMPLE:
        return design.participants
    return math.ceil(max(design.block_sizes) * max(a.ratio for a in design.arms) / design.unit)


_DAMAGED: Final = sentence(
    "the sealed list of allocations cannot be opened: it was made by another station, or is "
    "damaged; bring it back from a backup, with the station's key"
)
