"""What was tried at an exercise, line by line in the cache folder: a search goes on where it was.

A file belongs to one exercise as it is, one program as it is and one seed; after any change another
file is begun. It holds genes and verdicts and nothing of the patient but what the verdicts name.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any, Final

from app.core import paths, plugin_folders
from app.core.messages import sentence
from app.studies.attacks.search import AttackVerdict, TriedAttack
from app.studies.errors import StudyError

FORMAT: Final = "acus-attacks/1"


def key_of(*parts: Any) -> str:
    """Return a digest of JSON-ready values, of the program's files and of its profiles and rigs."""
    digest = hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode())
    for path in sorted(plugin_folders.APP.rglob("*.py")):
        digest.update(str(path.relative_to(plugin_folders.APP)).encode() + path.read_bytes())
    for path in sorted(paths.resources().rglob("*.yaml")):
        digest.update(str(path.relative_to(paths.resources())).encode() + path.read_bytes())
    return digest.hexdigest()[:16]


class AttackJournal:
    """What was tried at one exercise.

    Args:
        name: of the exercise.
        key: digest of all that a verdict depends on beside the genes.
        folder: where it lies; the cache folder if left out.

    Raises:
        StudyError: if it cannot be written.
    """

    def __init__(self, name: str, key: str, folder: Path | None = None) -> None:
        self._file = (folder or paths.cache() / "adversary") / f"{name}-{key}.jsonl"
        self._known: dict[tuple[float, ...], AttackVerdict] = {}
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            lines = self._file.read_text("utf-8").splitlines() if self._file.exists() else []
            if not lines:
                self._append({"format": FORMAT, "exercise": name})
        except OSError as error:
            raise StudyError(
                sentence(
                    "{file} cannot be written, so that what is tried would be lost: {error}",
                    file=self._file,
                    error=error,
                )
            ) from error
        for line in lines[1:]:
            try:
                document = json.loads(line)
                genes = tuple(float(one) for one in document["genes"])
                self._known[genes] = AttackVerdict.of(document["verdict"])
            except (LookupError, TypeError, ValueError):
                continue  # a line that was not finished when the run was broken off

    def __len__(self) -> int:
        """Return how many attacks are known."""
        return len(self._known)

    def known(self, genes: tuple[float, ...]) -> AttackVerdict | None:
        """Return what came of genes; None if they have not been tried."""
        return self._known.get(genes)

    def tell(self, tried: TriedAttack) -> None:
        """Keep one more, at once."""
        self._known[tried.genes] = tried.verdict
        self._append({"genes": list(tried.genes), "verdict": tried.verdict.document()})

    def _append(self, document: dict[str, Any]) -> None:
        new = "" if not self._file.exists() or self._ended() else "\n"
        with self._file.open("a", encoding="utf-8") as file:
            file.write(new + json.dumps(document, ensure_ascii=False) + "\n")

    def _ended(self) -> bool:
        content = self._file.read_bytes()[-1:]
        return content in (b"", b"\n")
