"""The bill of materials, against CycloneDX' own schema and digests that hashlib computes.

Schema: that of the standard's owners, as `cyclonedx-python-lib` carries it. The report is pip's
own, of wheels made here; nothing is asked of a network.
"""

import hashlib
import json
import os
import zipfile
from datetime import UTC, datetime
from pathlib import Path

import pytest

from tools import sbom

ROOT = Path(__file__).resolve().parents[1]
MOMENT = datetime(2026, 1, 2, 3, 4, 5, tzinfo=UTC)


def wheel(folder, name, version, *fields):
    """Write a wheel of nothing but metadata, by PEP 427."""
    file = folder / f"{name}-{version}-py3-none-any.whl"
    info = f"{name}-{version}.dist-info"
    head = [f"Name: {name}", f"Version: {version}", *fields]
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(f"{info}/METADATA", "\n".join(["Metadata-Version: 2.1", *head]) + "\n")
        tag = "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        archive.writestr(f"{info}/WHEEL", tag)
        archive.writestr(f"{info}/RECORD", "")
    return file


@pytest.fixture
def found(tmp_path):
    """What pip reports of a program, two packages that it needs, and one that it does not."""
    program = wheel(
        tmp_path, "acus", "1.0", "License: Apache-2.0", "Requires-Dist: first_part",
        'Requires-Dist: second-part; extra == "more"',
        'Requires-Dist: third-part; extra == "other"', "Provides-Extra: more",
    )  # fmt: skip
    wheel(tmp_path, "first_part", "2.0", "Classifier: License :: OSI Approved :: MIT License")
    wheel(tmp_path, "second_part", "3.0", "License: LGPL-3.0-only", "Requires-Dist: first-part>1")
    wheel(tmp_path, "third_part", "4.0")
    where = ["--no-index", "--find-links", str(tmp_path)]
    return tmp_path, sbom.bill(sbom.report([*where, f"{program}[more]"]), MOMENT)


@pytest.mark.long("journey")
def test_it_lists_what_pip_installs_with_the_digests_of_the_files(found):
    folder, bill = found
    assert [one["name"] for one in bill["components"]] == ["first_part", "second_part"]
    for one in bill["components"]:
        (file,) = folder.glob(f"{one['name']}*.whl")
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        assert one["hashes"] == [{"alg": "SHA-256", "content": digest}]
    assert bill["metadata"]["component"]["name"] == "acus"


@pytest.mark.long("journey")
def test_it_says_licences_and_what_needs_what(found):
    _, bill = found
    named = {one["name"]: one["licenses"] for one in bill["components"]}
    assert named["first_part"] == [{"license": {"name": "MIT License"}}]
    assert named["second_part"] == [{"license": {"name": "LGPL-3.0-only"}}]
    needs = {one["ref"]: one["dependsOn"] for one in bill["dependencies"]}
    first, second = "pkg:pypi/first-part@2.0", "pkg:pypi/second-part@3.0"
    assert needs == {"pkg:pypi/acus@1.0": [first, second], first: [], second: [first]}


@pytest.mark.long("journey")
def test_the_same_report_gives_the_same_serial_number_and_another_another(found):
    folder, bill = found
    program = next(iter(folder.glob("acus*.whl")))
    where = ["--no-index", "--find-links", str(folder)]
    assert sbom.bill(sbom.report([*where, f"{program}[more]"]), MOMENT) == bill
    fewer = sbom.bill(sbom.report([*where, str(program)]), MOMENT)
    assert fewer["serialNumber"] != bill["serialNumber"]


def test_a_report_without_the_program_is_refused():
    with pytest.raises(ValueError, match="does not have acus"):
        sbom.bill({"install": []}, MOMENT)


@pytest.mark.long("journey")
def test_it_obeys_the_schema_of_cyclonedx(found):
    if os.environ.get("CI") != "true":
        pytest.importorskip("cyclonedx", reason="cyclonedx-python-lib is not installed")
    import cyclonedx.schema
    from jsonschema import Draft7Validator
    from referencing import Registry, Resource

    folder = Path(cyclonedx.schema.__file__).parent / "_res"
    schemas = {
        name: json.loads((folder / f"{name}.SNAPSHOT.schema.json").read_text("utf-8"))
        for name in ("bom-1.6", "spdx", "jsf-0.82")
    }
    base = "http://cyclonedx.org/schema/"
    registry = Registry().with_resources(
        (f"{base}{name}.SNAPSHOT.schema.json", Resource.from_contents(one))
        for name, one in schemas.items()
    )
    registry = registry.with_resources(
        (f"{base}{name}.schema.json", Resource.from_contents(one)) for name, one in schemas.items()
    )
    check = Draft7Validator(schemas["bom-1.6"], registry=registry)
    _, bill = found
    assert [error.message for error in check.iter_errors(bill)] == []
    for broken in ({"bomFormat": "Other"}, {"serialNumber": "7"}, {"components": [{"name": "x"}]}):
        assert list(check.iter_errors(bill | broken))  # it would say so


@pytest.mark.long("journey")
def test_everything_pinned_for_the_trainer_names_its_licence():
    """Of what is installed here: a package whose licence nobody states must be looked at."""
    from importlib.metadata import distributions

    pinned = {
        line.partition("==")[0].lower().replace("_", "-")
        for line in (ROOT / "constraints.txt").read_text("utf-8").split()
    }
    nameless = []
    for one in distributions():
        name = one.metadata["Name"]
        known = {
            "name": name,
            "version": one.version,
            "license": one.metadata.get("License"),
            "classifier": one.metadata.get_all("Classifier"),
        }
        trainers = name.lower().replace("_", "-") in pinned and not name.startswith(
            "cmeel"
        )  # the arm's
        if trainers and not sbom.licences(known):
            nameless.append(name)
    assert nameless == []
