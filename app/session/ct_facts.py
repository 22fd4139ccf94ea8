"""The CT of an attempt as its record names it: a pseudonym, and what was done to the files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from app.core.messages import joined, sentence
from app.imaging.remedies import is_word
from app.imaging.series import Recipe
from app.imaging.volume import Volume


@dataclass(frozen=True, slots=True)
class CtFacts:
    """Which CT, and how it was read.

    Attributes:
        pseudonym: stands for patient and study; empty if not known.
        made: what was done to the files' own values, in words; empty where nothing was.
        recipe: the same as values; None in records that do not say it.
        frame: stands for its frame of reference, see `Series.frame`; empty if not known.
        digest: `Volume.digest` of the voxels and their places; empty in records that do not say it.
    """

    pseudonym: str = ""
    made: tuple[str, ...] = ()
    recipe: Recipe | None = None
    frame: str = ""
    digest: str = ""

    @classmethod
    def of_volume(cls, volume: Volume) -> CtFacts:
        """Facts of a volume."""
        return cls(volume.series.pseudonym, volume.made, volume.recipe, volume.series.frame)

    @classmethod
    def of_metadata(cls, record: Mapping[str, str]) -> CtFacts:
        """Read the metadata record `ct`; what an old or damaged one does not say stays unknown."""
        made = _parsed(record.get("made", "[]"))
        words = tuple(word for word in made if isinstance(word, str)) if made else ()
        return cls(
            record.get("pseudonym", ""),
            words,
            _recipe(record),
            record.get("frame", ""),
            record.get("digest", ""),
        )

    def is_of(self, volume: Volume) -> bool:
        """Return whether it is this CT, read in this way: by its digest, which takes a second a
        gigabyte.

        A record that does not say its digest is told by patient, study and frame of reference.
        """
        if self.digest:
            return self.digest == volume.digest
        series = volume.series
        known = bool(self.pseudonym) and self.pseudonym == series.pseudonym
        return known and self.frame in ("", series.frame)

    def metadata(self) -> dict[str, str]:
        """Return it as a metadata record, values as text."""
        facts = {"pseudonym": self.pseudonym}
        if self.frame:
            facts["frame"] = self.frame
        if self.digest:
            facts["digest"] = self.digest
        if self.recipe is None:
            return facts
        return facts | {
            "made": json.dumps(self.made, ensure_ascii=False),
            "remedy": self.recipe.remedy,
            "factors": json.dumps(self.recipe.factors),
            "spacing_mm": json.dumps(self.recipe.spacing_mm),
        }

    def words(self) -> str:
        """Say how it was read, in one line."""
        return joined("; ", self.made) if self.made else sentence("as its files are")

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        recipe = self.recipe
        return {
            "pseudonym": self.pseudonym,
            "made": list(self.made),
            "remedy": None if recipe is None else recipe.remedy,
            "factors": None if recipe is None else list(recipe.factors),
            "spacing_mm": None if recipe is None else recipe.spacing_mm,
        }


UNKNOWN_CT = CtFacts()
"""Nothing is known of it."""


def _recipe(record: Mapping[str, str]) -> Recipe | None:
    try:
        i, j, k = (int(factor) for factor in json.loads(record["factors"]))
        spacing = json.loads(record["spacing_mm"])
        step = None if spacing is None else float(spacing)
        remedy = record["remedy"]
        if min(i, j, k) < 1 or not is_word(remedy):
            return None
        return Recipe(remedy, (i, j, k), step)
    except (KeyError, TypeError, ValueError):
        return None


def _parsed(text: str) -> list[Any]:
    try:
        values = json.loads(text)
    except ValueError:
        return []
    return values if isinstance(values, list) else []
