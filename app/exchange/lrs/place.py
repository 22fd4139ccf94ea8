"""Where the learning record store is, and as whom: kept by the station, for its user only."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Final
from urllib.parse import urlsplit

from app.core.errors import writing
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.web import fault_of_address
from app.exchange.lrs.errors import LrsError
from app.exchange.xapi import checked_home
from app.session.people import people_folder

FILE: Final = "lrs.json"
_SECONDS: Final = (1.0, 600.0)


@dataclass(frozen=True, slots=True)
class LrsPlace:
    """A learning record store.

    Attributes:
        endpoint: URL before `/statements`.
        home: address that ids of statements begin with.
        user: name, or key, that it knows this station by; empty where it asks for none.
        password: or secret, that goes with it; in no message and no log.
        seconds: that an answer may take, as a whole.
        batch: statements in one request.
    """

    endpoint: str
    home: str
    user: str = ""
    password: str = field(default="", repr=False)
    seconds: float = 20.0
    batch: int = 50

    @property
    def name(self) -> str:
        """Return host and port, which messages call it by."""
        return urlsplit(self.endpoint).netloc

    def checked(self) -> LrsPlace:
        """Return it as it is used: without a slash at the end, nor `/statements`.

        Raises:
            LrsError: if the endpoint is none, or would show password and pseudonyms to a network.
            ExportError: if no id can begin with the address.
        """
        endpoint = self.endpoint.strip().rstrip("/").removesuffix("/statements").rstrip("/")
        if fault := fault_of_address(endpoint):
            raise LrsError(sentence("record store: {fault}", fault=fault))
        return replace(self, endpoint=endpoint, home=checked_home(self.home))


def place_of_lrs(folder: Path | None = None) -> LrsPlace | None:
    """Return where the store is; None for a station that tells none.

    Args:
        folder: of the people.

    Raises:
        LrsError: naming the file, if it cannot be used.
    """
    path = (folder or people_folder()) / FILE
    if not path.exists():
        return None
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        texts = {name: str(document[name]) for name in ("endpoint", "home", "user", "password")}
        seconds = min(max(float(document.get("seconds", 20.0)), _SECONDS[0]), _SECONDS[1])
        batch = min(max(int(document.get("batch", 50)), 1), 500)
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise LrsError(
            sentence(
                "{path} does not say where the record store is: give it again, "
                "`acus results lrs URL --home ADDRESS`",
                path=path,
            )
        ) from error
    return LrsPlace(**texts, seconds=seconds, batch=batch).checked()


def put_lrs(place: LrsPlace | None, folder: Path | None = None) -> None:
    """Keep where the store is, readable by this user only; None forgets it.

    Raises:
        LrsError: if it is none, or cannot be written.
        ExportError: if no id can begin with its `home`.
    """
    path = (folder or people_folder()) / FILE
    with writing(path, LrsError):
        if place is None:
            path.unlink(missing_ok=True)
            return
        document = asdict(place.checked())
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        write_atomically(path, json.dumps(document, indent=1) + "\n")
        path.chmod(0o600)
