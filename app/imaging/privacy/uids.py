"""New UIDs for old ones: consistent over files, series and imports, and not to be traced back."""

from app.imaging.privacy.key import derived

_STANDARD = "1.2.840.10008."


class UidMap:
    """Maps UIDs with a key; remembers which it has mapped.

    Args:
        key: of this installation.
    """

    def __init__(self, key: bytes) -> None:
        self._key = key
        self._new: dict[str, str] = {}

    @property
    def old(self) -> frozenset[str]:
        """UIDs that were replaced so far: none of them may stand in a written file."""
        return frozenset(self._new)

    def new(self, uid: str) -> str:
        """UID to write in place of one: `2.25.` and 128 bits (PS3.5 B.2), always the same.

        UIDs of the standard itself (SOP classes, syntaxes) stay.
        """
        if uid.startswith(_STANDARD):
            return uid
        if uid not in self._new:
            digest = derived(self._key, "uid", uid)
            self._new[uid] = f"2.25.{int.from_bytes(digest[:16], 'big')}"
        return self._new[uid]
