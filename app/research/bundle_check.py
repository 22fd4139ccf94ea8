"""Checks a bundle by itself: hashes, the committed list, each allocation, each score."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from app.core.configuration import parse_yaml
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.progress import Progress
from app.research.allocation_list import allocation_lists, commitment
from app.research.bundle import FORM, MANIFEST
from app.research.bundle_figures import FOLDER as FIGURES
from app.research.bundle_figures import bundle_figures, matplotlib_version
from app.research.bundle_tables import FOLDER as PARQUET
from app.research.bundle_tables import differing_tables
from app.research.design import ResearchDesign
from app.research.errors import ResearchError
from app.research.series import BROKEN, differences

_LARGEST: Final = 1 << 28
"""Bytes of one file when it is unpacked."""


@dataclass(frozen=True, slots=True)
class BundleReport:
    """What a bundle says of itself.

    Attributes:
        study: id.
        digest: SHA-256 of its manifest.
        files: how many have the hash that the manifest states.
        scores: how many were computed again and are as written.
        made_again: how many Parquet tables and figures were made again and are as written.
        problems: what is not as it should be, one line each.
        notes: what could not be looked at here, one line each.
    """

    study: str
    digest: str
    files: int
    scores: int
    made_again: int
    problems: tuple[str, ...]
    notes: tuple[str, ...]


def check_bundle(path: Path, progress: Progress | None = None) -> BundleReport:
    """Check a bundle.

    Raises:
        ResearchError: if it is none, or cannot be read.
        Cancelled: if that was asked for.
    """
    progress = progress or Progress()
    try:
        with zipfile.ZipFile(path) as archive:
            return _checked(_Bundle(path, archive), progress)
    except (*BROKEN, zipfile.BadZipFile, NotImplementedError, RuntimeError) as error:
        raise ResearchError(
            sentence(
                "{path} cannot be read: {reason}; fetch it again",
                path=path,
                reason=getattr(error, "strerror", None) or error,
            )
        ) from error


class _Bundle:
    """An opened bundle.

    Args:
        path: for messages.
        archive: opened.
    """

    def __init__(self, path: Path, archive: zipfile.ZipFile) -> None:
        self.path, self._archive = path, archive
        self.names = {info.filename: info.file_size for info in archive.infolist()}

    def read(self, name: str) -> bytes:
        """Return the content of a file.

        Raises:
            ResearchError: if it is not there or too large.
        """
        size = self.names.get(name)
        if size is None or size > _LARGEST:
            raise ResearchError(
                sentence("{path} has no usable {file}", path=self.path.name, file=name)
            )
        return self._archive.read(name)

    def table(self, name: str) -> list[dict[str, str]]:
        """Return the rows of a table."""
        text = self.read(name).decode("utf-8", "replace")
        return list(csv.DictReader(io.StringIO(text, newline="")))


def _checked(bundle: _Bundle, progress: Progress) -> BundleReport:
    raw = bundle.read(MANIFEST)
    try:
        manifest = json.loads(raw)
        stated: Mapping[str, str] = dict(manifest["files"])
        study, form = str(manifest["study"]), manifest["form"]
    except BROKEN as error:
        raise ResearchError(
            sentence("{path} is no bundle of a research study", path=bundle.path.name)
        ) from error
    if form != FORM:
        raise ResearchError(
            sentence(
                "{path} has the form {form!r}; this version of Acus knows {known}",
                path=bundle.path.name,
                form=form,
                known=FORM,
            )
        )
    problems = _hash_problems(bundle, stated)
    sound = len(stated) - len(problems)
    problems += [
        sentence("{file} stands in no manifest", file=name)
        for name in sorted(set(bundle.names) - set(stated) - {MANIFEST})
    ]
    problems += _allocation_problems(bundle)
    scores = 0
    rows = bundle.table("attempts.csv")
    for number, row in enumerate(rows):
        progress.report(number / len(rows), row.get("attempt") or "")
        found = _attempt_problems(bundle, row)
        scores += bool(row.get("series")) and not found
        problems += found
    again, wrong, notes = _made_again(bundle, stated)
    return BundleReport(
        study=study,
        digest=hashlib.sha256(raw).hexdigest(),
        files=sound,
        scores=scores,
        made_again=again,
        problems=(*problems, *wrong),
        notes=tuple(notes),
    )


def _made_again(bundle: _Bundle, stated: Mapping[str, str]) -> tuple[int, list[str], list[str]]:
    """Make Parquet tables and figures again from the CSV files: how many, what differs, notes."""
    plain = ("design.yaml", "software.json", ".csv", ".csv.gz")
    there = {name: bundle.read(name) for name in stated if name in bundle.names}
    files = {name: data for name, data in there.items() if name.endswith(plain)}
    parquet = {name: data for name, data in there.items() if name.startswith(PARQUET)}
    figures = {name: data for name, data in there.items() if name.startswith(FIGURES)}
    wrong, notes, count = list[str](), list[str](), 0
    if parquet:
        try:
            differing = differing_tables(files, parquet)
            wrong += [sentence("{file} is not what the tables hold", file=one) for one in differing]
            count += len(parquet) - len(differing)
        except ResearchError as error:
            notes.append(sentence("Parquet was not compared: {reason}", reason=error))
    if figures:
        try:
            drawn_by, here = json.loads(files["software.json"])["matplotlib"], matplotlib_version()
            if drawn_by != here:
                words = sentence(
                    "figures were drawn by matplotlib {there}, here is {here}: not compared",
                    there=drawn_by,
                    here=here,
                )
                return count, wrong, [*notes, words]
            drawn = bundle_figures(files)
            differing = sorted(n for n in {*figures, *drawn} if figures.get(n) != drawn.get(n))
            wrong += [sentence("{file} is not what the tables give", file=one) for one in differing]
            count += len(figures) - len(differing)
        except ResearchError as error:
            notes.append(sentence("figures were not drawn again: {reason}", reason=error))
        except (AcusError, *BROKEN) as error:
            wrong.append(sentence("figures cannot be drawn again: {reason}", reason=error))
    return count, wrong, notes


def _hash_problems(bundle: _Bundle, stated: Mapping[str, str]) -> list[str]:
    problems: list[str] = []
    for name, digest in stated.items():
        try:
            actual = hashlib.sha256(bundle.read(name)).hexdigest()
        except (ResearchError, zipfile.BadZipFile, *BROKEN) as error:
            problems.append(sentence("{file}: {reason}", file=name, reason=error))
            continue
        if actual != digest:
            problems.append(sentence("{file} was changed after the bundle was made", file=name))
    return problems


def _allocation_problems(bundle: _Bundle) -> list[str]:
    """Say where arms are not those of the list that was committed to."""
    try:
        text = bundle.read("design.yaml").decode()
        design = ResearchDesign.model_validate(parse_yaml(text, "design.yaml"))
        stated = json.loads(bundle.read("allocation.json"))
        lists = allocation_lists(design, bytes.fromhex(stated["seed"]))
        committed = commitment(lists, bytes.fromhex(stated["nonce"])) == stated["commitment"]
    except (AcusError, *BROKEN) as error:
        return [sentence("the list of allocations cannot be read: {reason}", reason=error)]
    problems: list[str] = []
    if not committed or lists != stated.get("lists"):
        problems.append(sentence("the list of allocations is not the one that was committed to"))
    for row in bundle.table("participants.csv"):
        try:
            place = lists[row["stratum"]][int(row["slot"]) - 1]
        except (LookupError, ValueError, TypeError):
            place = -1
        if place < 0 or design.arms[place].name != row.get("arm"):
            problems.append(
                sentence(
                    "{participant} is not in the arm that the list gives",
                    participant=row.get("participant"),
                )
            )
    return problems


def _attempt_problems(bundle: _Bundle, row: Mapping[str, Any]) -> list[str]:
    """Say what of an attempt is not what its series gives."""
    name = str(row.get("attempt"))
    if not row.get("series"):
        return []
    try:
        document = json.loads(bundle.read(f"attempts/{name}.json"))
        found = differences(document, bundle.read(str(row["series"])))
        total = document["score"]["total"]
    except (AcusError, zipfile.BadZipFile, *BROKEN) as error:
        return [sentence("attempt {attempt}: {reason}", attempt=name, reason=error)]
    lines: list[str] = [
        sentence("attempt {attempt}: {change}", attempt=name, change=change.sentence())
        for change in found
    ]
    if row["score_total"] != ("" if total is None else repr(float(total))):
        lines.append(
            sentence("attempt {attempt}: its score in attempts.csv is another", attempt=name)
        )
    return lines
