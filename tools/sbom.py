"""Write what the trainer consists of as CycloneDX 1.6: `make sbom`, out/acus.cdx.json.

Read is what pip reports when it resolves the trainer with the pinned versions (`pip install
--dry-run --ignore-installed --report`): name, version, file, SHA-256, licence and needs of every
package. Nothing is installed, and the versions are those of constraints.txt.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping
from contextlib import suppress
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Any, Final
from uuid import UUID, uuid5

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from app.core.files import write_atomically

ROOT: Final = Path(__file__).resolve().parents[1]
OUT: Final = ROOT / "out" / "acus.cdx.json"
SPACE: Final = UUID("5b1f9a3e-7a55-4b0e-9d3a-0d1c6f6f2a11")
Json = dict[str, Any]


def licences(metadata: Mapping[str, Any]) -> list[Json]:
    """Return a package's licence as CycloneDX has it: its expression, else the words that it gives.

    An older pip does not report expressions: then that of the same version is taken, if it is
    installed here.
    """
    if expression := metadata.get("license_expression") or _installed_expression(metadata):
        return [{"expression": expression}]
    short = (metadata.get("license") or "").strip().splitlines()
    if len(short) == 1 and short[0] != "UNKNOWN":
        return [{"license": {"name": short[0]}}]
    found = [c for c in metadata.get("classifier") or () if c.startswith("License :: ")]
    named = [c.rpartition(" :: ")[2] for c in found]
    return [{"license": {"name": name}} for name in named if name != "OSI Approved"]


def _installed_expression(metadata: Mapping[str, Any]) -> str | None:
    with suppress(PackageNotFoundError):
        found = distribution(metadata["name"])
        if found.version == metadata["version"]:
            stated: list[str] = found.metadata.get_all("License-Expression") or []
            return stated[0] if stated else None
    return None


def component(entry: Mapping[str, Any], top: str) -> Json:
    """Return a package of pip's report as a component; `top` is the program itself."""
    metadata, file = entry["metadata"], entry["download_info"]
    name, version = canonicalize_name(metadata["name"]), metadata["version"]
    found: Json = {
        "type": "application" if name == top else "library",
        "bom-ref": f"pkg:pypi/{name}@{version}",
        "name": metadata["name"],
        "version": version,
        "purl": f"pkg:pypi/{name}@{version}",
    }
    if summary := metadata.get("summary"):
        found["description"] = summary
    if known := licences(metadata):
        found["licenses"] = known
    if digest := file.get("archive_info", {}).get("hashes", {}).get("sha256"):
        found["hashes"] = [{"alg": "SHA-256", "content": digest}]
        found["properties"] = [{"name": "acus:file", "value": file["url"].rpartition("/")[2]}]
    return found


def needs(entry: Mapping[str, Any], refs: Mapping[str, str]) -> list[str]:
    """Return what a package needs of those in the report, here and with the extras asked for."""
    metadata, asked = entry["metadata"], entry.get("requested_extras") or [""]
    found = set()
    for text in metadata.get("requires_dist") or ():
        one = Requirement(text)
        here = [{"extra": extra} for extra in ("", *asked)]
        if one.marker is None or any(one.marker.evaluate(place) for place in here):
            found.add(refs.get(canonicalize_name(one.name), ""))
    return sorted(found - {""})


def bill(report: Mapping[str, Any], moment: datetime, top: str = "acus") -> Json:
    """Return pip's report as a bill of materials.

    Raises:
        ValueError: if the program itself is not in the report.
    """
    entries: list[Mapping[str, Any]] = sorted(
        report["install"], key=lambda one: canonicalize_name(one["metadata"]["name"])
    )
    made: dict[str, Json] = {
        canonicalize_name(e["metadata"]["name"]): component(e, top) for e in entries
    }
    if top not in made:
        raise ValueError(f"pip's report does not have {top}; it has {', '.join(made)}")
    refs: dict[str, str] = {name: one["bom-ref"] for name, one in made.items()}
    listed = json.dumps(made, sort_keys=True)
    return {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "serialNumber": f"urn:uuid:{uuid5(SPACE, listed)}",
        "version": 1,
        "metadata": {
            "timestamp": moment.astimezone(UTC).isoformat(timespec="seconds"),
            "component": made[top],
        },
        "components": [one for name, one in made.items() if name != top],
        "dependencies": [
            {
                "ref": refs[canonicalize_name(entry["metadata"]["name"])],
                "dependsOn": needs(entry, refs),
            }
            for entry in entries
        ],
    }


def report(wanted: Iterable[str]) -> Json:
    """Let pip resolve what is wanted, without installing it, and return its report.

    Raises:
        subprocess.CalledProcessError: if pip cannot; it has said why.
    """
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        how = ["--dry-run", "--ignore-installed", "--report", str(file)]
        subprocess.run([*pip, *how, *wanted], check=True, cwd=ROOT)
        found: Json = json.loads(file.read_text(encoding="utf-8"))
    return found


def main() -> None:
    """Write the bill."""
    parser = argparse.ArgumentParser(prog="python -m tools.sbom")
    parser.add_argument("--out", type=Path, default=OUT)
    target = parser.parse_args().out
    target.parent.mkdir(parents=True, exist_ok=True)
    found = bill(report(["-c", "constraints.txt", ".[trainer]"]), datetime.now(UTC))
    write_atomically(target, json.dumps(found, indent=1, ensure_ascii=False) + "\n")
    print(f"wrote {target}: {len(found['components'])} packages")


if __name__ == "__main__":
    main()
